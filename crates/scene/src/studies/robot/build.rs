//! Robots from checked records.

use piola_document::{Mistake, Record, words};
use piola_kinematics::Attitude;
use piola_multibody::{
    BodyIndex, BodyPoint, ClosedTree, FileInertias, JointKind, JointPlace, LoopClosure, MultibodyError, RobotFile,
    UrdfBase, UrdfOptions,
};

use super::{JointDrive, RobotStudy};
use crate::model::Builder;

/// Gravity with a URDF file, m/s².
const STANDARD: [f64; 3] = [0.0, 0.0, -9.80665];

/// Numbers that are recorded at most: about a gigabyte with their tables.
const MOST_NUMBERS: usize = 25_000_000;

impl Builder<'_> {
    pub(in crate::studies) fn robot(&mut self, scene: &Record, table: &Record, samples: u32) -> Option<RobotStudy> {
        let time = self.time(scene, None);
        let integrator = self.integrator(scene);
        if let Some(record) = scene.record("integrator") {
            let adaptive = ["auto", "dormand-prince-853"].contains(&integrator.method.as_str());
            for (key, wrong) in [("method", !adaptive), ("step", adaptive && record.has("step"))] {
                if wrong {
                    self.wrong(
                        Mistake::new(record.place_of(key), format!("`{key}` in a scene of [robot]"))
                            .valid("tolerance: the method is dormand-prince-853"),
                    );
                }
            }
        }
        let file = self.document.folder().join(table.text("file")?);
        let options = UrdfOptions {
            base: if table.text("base")? == "free" { UrdfBase::Free } else { UrdfBase::Fixed },
            inertias: if table.text("inertias")? == "checked" { FileInertias::Checked } else { FileInertias::AsGiven },
        };
        let robot = RobotFile::read(&file, options);
        let robot = self.sound(table, "file", robot, "a URDF or MJCF file, relative to the scene")?;
        let (mut closed, mut q) = (robot.closed, robot.home);
        let gravity = if table.has("gravity") { table.vector("gravity")? } else { robot.gravity.unwrap_or(STANDARD) };
        let set = closed.set_gravity(gravity);
        self.sound(table, "gravity", set, "finite numbers")?;
        let tree = closed.tree().clone();
        let mut v = vec![0.0; tree.freedoms()];
        if options.base == UrdfBase::Free {
            let [roll, pitch, yaw] = table.vector("attitude")?;
            let turn = Attitude::about_z(yaw).product(Attitude::about_y(pitch)).product(Attitude::about_x(roll));
            q[..4].copy_from_slice(&[turn.w, turn.x, turn.y, turn.z]);
            q[4..7].copy_from_slice(&table.vector("position")?);
            v[..3].copy_from_slice(&table.vector("angular_velocity")?);
            v[3..6].copy_from_slice(&table.vector("velocity")?);
        } else {
            for key in ["attitude", "position", "angular_velocity", "velocity"] {
                if table.has(key) {
                    self.wrong(
                        Mistake::new(table.place_of(key), format!("`{key}` of a root that is fixed"))
                            .valid("base = \"free\""),
                    );
                }
            }
        }
        let has_joint_forces = table.text("joint_forces")? == "file";
        if !has_joint_forces {
            self.without_joint_forces(table, &mut closed);
        }
        let mut drives = undriven(&tree);
        self.unique_names(&[scene.records("drive"), scene.records("closure")]);
        for record in scene.records("drive") {
            self.drive(record, &mut closed, (&mut q, &mut v), &mut drives);
        }
        for record in scene.records("closure") {
            self.closure(record, &mut closed);
        }
        let given = q.clone();
        if 0 < closed.conditions() {
            let placed = closed.project(&mut closed.workspace(), &mut q, &mut v, time.map_or(0.0, |time| time.start));
            let of_error = |closure: &Record| match (&placed, closure.text("name")) {
                (Err(MultibodyError::NoClosedState { closure, .. }), Some(name)) => {
                    closure.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with(", axis "))
                }
                _ => false,
            };
            let closure = scene.records("closure").iter().find(|closure| of_error(closure));
            let (record, key) = closure.map_or((table, "file"), |closure| (closure, "name"));
            self.sound(record, key, placed, "angles at the start near those at which the loops close")?;
        }
        let names = names(&tree);
        // Time, coordinates, rates, energies and works at each instant.
        let columns = 7 + names.iter().map(Vec::len).sum::<usize>();
        if MOST_NUMBERS / columns < samples as usize {
            let place = scene.record("output").map_or(scene.place.clone(), |table| table.place_of("samples"));
            self.wrong(
                Mistake::new(place, format!("{samples} samples of {columns} numbers are more than {MOST_NUMBERS}"))
                    .valid(format!("samples = at most {}", MOST_NUMBERS / columns)),
            );
        }
        Some(RobotStudy {
            file,
            visuals: robot.visuals,
            time: time?,
            tolerance: integrator.tolerance.unwrap_or(1e-9),
            samples,
            animation: table.flag("animation")?,
            stops: table.text("singular_positions")? == "stop",
            moved: q.iter().zip(&given).fold(0.0, |most, (a, b)| (a - b).abs().max(most)),
            start: (q, v),
            drives,
            names,
            slip_rate: table.number("slip_rate")?,
            has_joint_forces,
            motors: robot.motors.into_iter().map(|motor| motor.joint).collect(),
            closed,
        })
    }

    fn sound<T>(
        &mut self,
        record: &Record,
        key: &str,
        result: Result<T, MultibodyError>,
        valid: &'static str,
    ) -> Option<T> {
        let wrong = |error: MultibodyError| {
            let what = match (key, record.text(key)) {
                ("file", Some(file)) => format!("`{file}`: {error}"),
                _ => error.to_string(),
            };
            self.wrong(Mistake::new(record.place_of(key), what).valid(valid));
        };
        result.map_err(wrong).ok()
    }

    fn drive(
        &mut self,
        record: &Record,
        closed: &mut ClosedTree,
        (q, v): (&mut [f64], &mut [f64]),
        drives: &mut [JointDrive],
    ) -> Option<()> {
        let tree = closed.tree();
        let names: Vec<&str> = tree.joints().iter().map(|place| place.joint.name.as_str()).collect();
        let index = self.find(record, "name", "joint", &names)?;
        let JointPlace { joint, first_coordinate, first_freedom, .. } = tree.joints()[index].clone();
        let (valid, foreign) = match joint.kind {
            JointKind::Revolute { .. } => ("angle, rate, torque", ["displacement", "speed", "force"]),
            JointKind::Prismatic { .. } => ("displacement, speed, force", ["angle", "rate", "torque"]),
            _ => {
                self.wrong(
                    Mistake::new(
                        record.place_of("name"),
                        format!("the joint `{}` has no single coordinate", joint.name),
                    )
                    .valid("a joint of the type revolute, continuous or prismatic"),
                );
                return None;
            }
        };
        for key in foreign.into_iter().filter(|key| record.has(key)) {
            self.wrong(
                Mistake::new(record.place_of(key), format!("`{key}` of the joint `{}`", joint.name)).valid(valid),
            );
        }
        let either = |keys: [&str; 2]| keys.into_iter().find(|key| record.has(key)).and_then(|key| record.number(key));
        q[first_coordinate] = either(["angle", "displacement"]).unwrap_or(q[first_coordinate]);
        v[first_freedom] = either(["rate", "speed"]).unwrap_or(0.0);
        let (at, [low, high]) = (q[first_coordinate], joint.limits);
        if at < low || high < at {
            let key = if record.has("angle") { "angle" } else { "displacement" };
            let (low, high) = (words::number(low), words::number(high));
            self.wrong(
                Mistake::new(
                    record.place_of(key),
                    format!("the joint `{}` starts at {at}, outside its limits", joint.name),
                )
                .valid(format!("from {low} to {high}, in SI units")),
            );
        }
        let drive = &mut drives[first_freedom];
        drive.effort = either(["torque", "force"]).unwrap_or(0.0);
        let number = |key: &str, of_tree: f64| record.number(key).unwrap_or(of_tree);
        let current = closed.tree().joints()[index].joint.clone();
        let friction =
            closed.set_friction(index, number("damping", current.damping), number("friction", current.friction));
        self.sound(record, "damping", friction, "numbers that are zero or more");
        let spring = closed.set_spring(index, number("stiffness", current.stiffness), number("rest", current.rest));
        self.sound(record, "stiffness", spring, "a number that is zero or more");
        if record.flag("locked")? {
            if 0.0 < v[first_freedom].abs() {
                let key = if record.has("rate") { "rate" } else { "speed" };
                self.wrong(
                    Mistake::new(record.place_of(key), format!("`{key}` of the locked joint `{}`", joint.name))
                        .valid("a locked joint without a rate or speed, or locked = false"),
                );
            }
            let lock = LoopClosure::Gear { follower: first_freedom, leader: first_freedom, ratio: 0.0, offset: at };
            let locked = closed.close(format!("{} locked", joint.name), lock);
            self.sound(record, "locked", locked, "a joint with one coordinate")?;
        }
        Some(())
    }

    /// Takes springs, dampers and friction of the file away.
    fn without_joint_forces(&mut self, table: &Record, closed: &mut ClosedTree) {
        for index in 0..closed.tree().joints().len() {
            let rest = closed.tree().joints()[index].joint.rest;
            let taken = closed.set_friction(index, 0.0, 0.0).and_then(|()| closed.set_spring(index, 0.0, rest));
            self.sound(table, "joint_forces", taken, "file or none");
        }
    }

    fn closure(&mut self, record: &Record, closed: &mut ClosedTree) -> Option<()> {
        let (name, kind) = (record.text("name")?.to_string(), record.text("type")?);
        let [first, second] = [self.link(record, "first", closed), self.link(record, "second", closed)];
        let (first, second) = (first?, second?);
        let [first_at, second_at] = [record.vector("first_at")?, record.vector("second_at")?];
        let point =
            LoopClosure::Point { first: BodyPoint::new(first, first_at), second: BodyPoint::new(second, second_at) };
        let mut parts = vec![(name.clone(), point)];
        let axes = match kind {
            "hinge" => vec![[self.unit(record, "first_axis")?, self.unit(record, "second_axis")?]],
            // Two axes: of the four conditions one depends on the others.
            "frame" => vec![[[1.0, 0.0, 0.0]; 2], [[0.0, 1.0, 0.0]; 2]],
            _ => Vec::new(),
        };
        for (number, [first_axis, second_axis]) in axes.into_iter().enumerate() {
            let axis = LoopClosure::Axis { first, first_axis, second, second_axis };
            parts.push((format!("{name}, axis {number}"), axis));
        }
        for (name, closure) in parts {
            let result = closed.close(name, closure);
            self.sound(record, "name", result, "points and axes of finite numbers, and a name unlike any other")?;
        }
        Some(())
    }

    fn link(&mut self, record: &Record, key: &str, closed: &ClosedTree) -> Option<BodyIndex> {
        let mut names = vec!["ground"];
        names.extend(closed.tree().joints().iter().map(|place| closed.tree().body_name(place.child)));
        let index = self.find(record, key, "link", &names)?;
        closed.tree().body(names[index]).ok()
    }

    /// An axis of any length as a unit vector.
    fn unit(&mut self, record: &Record, key: &str) -> Option<[f64; 3]> {
        let axis = record.vector(key)?;
        let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        if !(0.0 < length && length.is_finite()) {
            self.wrong(
                Mistake::new(record.place_of(key), format!("`{key}` has the length {length}"))
                    .valid("a direction, as [0, 1, 0]"),
            );
            return None;
        }
        Some(axis.map(|x| x / length))
    }
}

/// The freedoms without torques or forces.
fn undriven(tree: &piola_multibody::RigidTree) -> Vec<JointDrive> {
    let mut drives = Vec::new();
    for place in tree.joints() {
        let single = place.joint.kind.freedoms() == place.joint.kind.coordinates();
        drives.extend((0..place.joint.kind.freedoms()).map(|k| JointDrive {
            coordinate: single.then_some(place.first_coordinate + k),
            effort: 0.0,
            limits: place.joint.limits,
        }));
    }
    drives
}

/// The names of coordinates and of rates, by joints.
fn names(tree: &piola_multibody::RigidTree) -> [Vec<String>; 2] {
    const POSE: [&str; 7] = ["w", "x", "y", "z", "position x", "position y", "position z"];
    const TWIST: [&str; 6] = ["angular x", "angular y", "angular z", "velocity x", "velocity y", "velocity z"];
    let mut names = [Vec::new(), Vec::new()];
    for place in tree.joints() {
        let (name, kind) = (&place.joint.name, &place.joint.kind);
        let counts = [(kind.coordinates(), &POSE[..]), (kind.freedoms(), &TWIST[..])];
        for (names, (count, parts)) in names.iter_mut().zip(counts) {
            let named = |part: &&str| if count == 1 { name.clone() } else { format!("{name} {part}") };
            names.extend(parts.iter().take(count).map(named));
        }
    }
    names
}
