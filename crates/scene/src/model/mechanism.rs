//! Trees of joints from checked records.

use nalgebra::Matrix3;
use piola_document::{Mistake, Record};
use piola_kinematics::{Inertia, KinematicsError, RigidBody};
use piola_simulation::SimulationError;
use piola_simulation::joints::{Coordinate, DEEPEST, Joint, JointMotion, Mechanism, Part, PartKind};

use super::Builder;
use super::forces::Surroundings;

impl Builder<'_> {
    pub(super) fn mechanism(&mut self, scene: &Record, table: &Record) -> Option<Mechanism> {
        let lists = [scene.records("joint"), scene.records("particle"), scene.records("rigid_body")];
        self.unique_names(&lists);
        for record in lists.into_iter().flatten().filter(|record| record.text("name") == Some("ground")) {
            self.refuse(record.place_of("name"), "the name `ground` is taken", "another name");
        }
        let [joints, particles, bodies] = lists;
        if particles.is_empty() && bodies.is_empty() && !scene.has("particle") && !scene.has("rigid_body") {
            self.refuse(
                table.place.clone(),
                "[mechanism] without parts",
                "at least one [[particle]] or [[rigid_body]] on a [[joint]]",
            );
        }
        let names: Vec<&str> = joints.iter().map(|joint| joint.text("name").unwrap_or("")).collect();
        let drafts: Vec<Option<Joint>> = joints.iter().map(|record| self.joint(record, &names)).collect();
        let mut parts: Vec<Option<Part>> = particles.iter().map(|record| self.particle(record, &names)).collect();
        parts.extend(bodies.iter().map(|record| self.rigid_body(record, &names)));
        let drafts: Vec<Joint> = drafts.into_iter().collect::<Option<_>>()?;
        if !self.grounded(joints, &names, &drafts) {
            return None;
        }
        let parts: Vec<Part> = parts.into_iter().collect::<Option<_>>()?;
        let mechanism = Mechanism::new(drafts, parts, table.vector("gravity")?).map_err(|error| {
            self.refuse(table.place.clone(), error.to_string(), "joints and parts of finite numbers");
        });
        let mechanism = mechanism.ok()?;
        if !self.independent(scene, joints, &mechanism) {
            return None;
        }
        let moves_freely = scene.records("force").is_empty() && scene.records("constraint").is_empty();
        let (forces, constraints) = if moves_freely && self.is_kept() {
            (Some(Vec::new()), Some(Vec::new()))
        } else {
            let surroundings = Surroundings::of(self, scene, &mechanism);
            (self.forces(scene, &surroundings), self.constraints(scene, &surroundings))
        };
        let reactions = scene.record("output").and_then(|output| output.flag("reactions")).unwrap_or(false);
        let questions = self.mechanism_questions(scene)?;
        let (forces, constraints) = (forces?, constraints?);
        let built = mechanism.with_forces(forces).and_then(|mechanism| mechanism.with_constraints(constraints));
        let refused = |error: SimulationError| match &error {
            SimulationError::RateAgainstRolling { coordinate, .. } => {
                let (name, rest) = coordinate.split_once('.').unwrap_or((coordinate, ""));
                let joint = joints.iter().find(|joint| joint.text("name") == Some(name));
                let keys = if rest.starts_with("shift") { ["velocity"; 3] } else { ["rates", "rate", "speed"] };
                let key = keys.into_iter().find(|key| joint.is_some_and(|joint| joint.has(key))).unwrap_or_default();
                let place = joint.map_or(table.place.clone(), |joint| joint.place_of(key));
                Mistake::new(place, error.to_string()).valid("the rate that follows, or none")
            }
            SimulationError::DiscFlat { constraint } => {
                let records = scene.records("constraint");
                let record = records.iter().find(|record| record.text("name") == Some(constraint));
                let place = record.map_or(table.place.clone(), |record| record.place_of("axis"));
                Mistake::new(place, error.to_string()).valid("a disc that stands on its edge, or leans")
            }
            _ => Mistake::new(table.place.clone(), error.to_string()).valid("forces and constraints of finite numbers"),
        };
        let mechanism = built.map_err(|error| self.wrong(refused(error))).ok()?;
        if mechanism.rolls() && (questions.equilibrium || questions.modes) {
            let place = scene.record("questions").map_or(table.place.clone(), |questions| questions.place.clone());
            return self.refused(
                place,
                "equilibria and modes of bodies that roll",
                "energies = true, or no [questions]",
            );
        }
        let simplify = scene.record("integrator").and_then(|integrator| integrator.flag("simplify")).unwrap_or(true);
        Some(Mechanism { simplify, reactions, questions, ..mechanism })
    }

    fn joint(&mut self, record: &Record, names: &[&str]) -> Option<Joint> {
        let name = record.text("name")?.to_string();
        let parent =
            if record.text("parent")? == "ground" { None } else { Some(self.find(record, "parent", "joint", names)?) };
        let kind = record.text("type")?.to_string();
        let mut coordinates = Vec::new();
        let mut coordinate = |name: String, angular, position, velocity| {
            coordinates.push(Coordinate { name, angular, position, velocity });
        };
        let axis = self.axis(record, "axis");
        let motion = match kind.as_str() {
            "fixed" => JointMotion::Fixed,
            "revolute" => {
                coordinate(name.clone(), true, record.number("angle")?, record.number("rate")?);
                JointMotion::Revolute(axis?)
            }
            "prismatic" => {
                coordinate(name.clone(), false, record.number("displacement")?, record.number("speed")?);
                JointMotion::Prismatic(axis?)
            }
            kind => {
                let count = if kind == "universal" { 2 } else { 3 };
                let (angles, rates) = self.angles(record, count)?;
                if kind == "free" {
                    let (shift, velocity) = (record.vector("shift")?, record.vector("velocity")?);
                    for i in 0..3 {
                        coordinate(format!("{name}.shift[{i}]"), false, shift[i], velocity[i]);
                    }
                }
                for i in 0..count {
                    coordinate(format!("{name}.angles[{i}]"), true, angles[i], rates[i]);
                }
                match kind {
                    "universal" => JointMotion::Universal(axis?, self.axis(record, "second_axis")?),
                    "free" => JointMotion::Free,
                    _ => JointMotion::Spherical,
                }
            }
        };
        Some(Joint { parent, offset: record.vector("offset")?, motion, coordinates })
    }

    fn angles(&mut self, record: &Record, count: usize) -> Option<(Vec<f64>, Vec<f64>)> {
        let angles = record.numbers("angles").map(<[f64]>::to_vec);
        let rates =
            if record.has("rates") { record.numbers("rates").map(<[f64]>::to_vec) } else { Some(vec![0.0; count]) };
        let mut valid = true;
        for (key, numbers) in [("angles", &angles), ("rates", &rates)] {
            let found = numbers.as_ref().map_or(count, Vec::len);
            if found != count {
                valid = false;
                self.refuse(
                    record.place_of(key),
                    format!("`{key}` is a list of {found}"),
                    format!("a list of {count} for this type of joint"),
                );
            }
        }
        if valid { Some((angles?, rates?)) } else { None }
    }

    /// A direction of any length, made a unit vector.
    fn axis(&mut self, record: &Record, key: &str) -> Option<[f64; 3]> {
        let axis = record.vector(key)?;
        let largest = axis.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
        if largest <= 0.0 {
            return self.refused(record.place_of(key), format!("`{key}` is zero"), "a direction, as [0, 1, 0]");
        }
        // Divided by the largest component first: squares neither overflow nor vanish.
        let scaled = axis.map(|x| x / largest);
        let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
        Some(scaled.map(|x| x / length))
    }

    fn particle(&mut self, record: &Record, names: &[&str]) -> Option<Part> {
        let joint = self.find(record, "joint", "joint", names)?;
        let (at, kind) = (record.vector("at")?, PartKind::Particle(record.number("mass")?));
        Some(Part { joint, name: record.text("name")?.to_string(), at, kind })
    }

    fn rigid_body(&mut self, record: &Record, names: &[&str]) -> Option<Part> {
        let joint = self.find(record, "joint", "joint", names);
        let inertia = self.inertia(record);
        let body = RigidBody::new(record.number("mass")?, inertia?).ok()?;
        let (at, kind) = (record.vector("at")?, PartKind::Body(body));
        Some(Part { joint: joint?, name: record.text("name")?.to_string(), at, kind })
    }

    fn inertia(&mut self, record: &Record) -> Option<Inertia> {
        let numbers = record.numbers("inertia")?;
        let inertia = match *numbers {
            [a, b, c] => Inertia::principal([a, b, c]),
            [a, b, c, d, e, f] => Inertia::new(Matrix3::new(a, d, f, d, b, e, f, e, c)),
            _ => Inertia::new(Matrix3::from_row_slice(numbers)),
        };
        inertia
            .map_err(|error| {
                let valid = match error {
                    KinematicsError::InertiaTriangleInequality { .. } => {
                        "principal moments of which none exceeds the sum of the other two"
                    }
                    KinematicsError::InertiaNotSymmetric { .. } => "a symmetric matrix, by rows",
                    _ => "positive principal moments; a thin rod is placed as particles",
                };
                self.refuse(record.place_of("inertia"), format!("no body has this inertia: {error}"), valid);
            })
            .ok()
    }

    /// Whether parents lead to the ground; reports cycles and paths of too many joints.
    fn grounded(&mut self, records: &[Record], names: &[&str], drafts: &[Joint]) -> bool {
        let mut depth = vec![0; drafts.len()];
        let mut reported = vec![false; drafts.len()];
        let mut valid = true;
        for start in 0..drafts.len() {
            let mut path = Vec::new();
            let mut at = Some(start);
            while let Some(joint) = at.filter(|joint| depth[*joint] == 0 && !reported[*joint]) {
                if let Some(first) = path.iter().position(|seen| *seen == joint) {
                    let mut cycle: Vec<&str> = path[first..].iter().map(|j: &usize| names[*j]).collect();
                    cycle.push(names[joint]);
                    self.refuse(
                        records[joint].place_of("parent"),
                        format!("the joints form a cycle: {}", cycle.join(" on ")),
                        "parents that lead to the ground",
                    );
                    valid = false;
                    for &j in &path {
                        reported[j] = true;
                    }
                    break;
                }
                path.push(joint);
                at = drafts[joint].parent;
            }
            if let Some(joint) = at.filter(|joint| reported[*joint]) {
                // Hangs on a cycle that is reported already.
                for &j in path.iter().chain([&joint]) {
                    reported[j] = true;
                }
                continue;
            }
            for &joint in path.iter().rev() {
                depth[joint] = drafts[joint].parent.map_or(0, |parent| depth[parent]) + 1;
                if depth[joint] == DEEPEST + 1 {
                    valid = false;
                    self.refuse(
                        records[joint].place_of("parent"),
                        format!("more than {DEEPEST} joints between `{}` and the ground", names[joint]),
                        format!("at most {DEEPEST}"),
                    );
                }
            }
        }
        valid
    }

    /// Reports coordinates that move nothing or of which some combination moves nothing.
    fn independent(&mut self, scene: &Record, joints: &[Record], mechanism: &Mechanism) -> bool {
        let Mechanism { tree, coordinates, position, .. } = mechanism;
        let dependent = tree.dependent_coordinates(position);
        if dependent.is_empty() {
            return true;
        }
        let owner = |coordinate: usize| {
            let name = coordinates[coordinate].split('.').next().unwrap_or_default();
            joints.iter().find(|joint| joint.text("name") == Some(name)).unwrap_or(scene)
        };
        for group in dependent {
            let names: Vec<String> = group.iter().map(|i| format!("`{}`", coordinates[*i])).collect();
            let found = match group.as_slice() {
                [_] => format!("nothing with mass moves with {} at the start", names.join("")),
                _ => format!(
                    "the coordinates {} are dependent at the start: together they can change without moving anything",
                    names.join(", ")
                ),
            };
            let last = group.last().copied().unwrap_or_default();
            self.refuse(owner(last).place.clone(), found, "as many coordinates as there are motions: a joint less, a mass at the end, or angles away from where the Eulerian angles are singular");
        }
        false
    }
}
