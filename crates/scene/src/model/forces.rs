//! Forces on mechanisms from checked records.

use nalgebra::Vector3;
use piola_document::units::Dimension;
use piola_document::{Mistake, Record, words};
use piola_expression::Variable;
use piola_simulation::forces::{Force, ForceKind};
use piola_simulation::joints::{Anchor, Mechanism};

use super::Builder;
use piola_expression::text::{self, ExpressionNames, NameMeaning};

/// Energy, J.
const ENERGY: Dimension = Dimension::MOMENT;

/// Points of a mechanism by name, and its coordinates as expressions know them.
pub(super) struct Surroundings<'m> {
    pub(super) mechanism: &'m Mechanism,
    /// Joints, then particles and rigid bodies.
    points: Vec<Point<'m>>,
    pub(super) names: ExpressionNames,
}

/// Something with a name that has a place.
struct Point<'m> {
    name: &'m str,
    joint: Option<usize>,
    at: [f64; 3],
    /// None of a joint and of the ground.
    mass: Option<f64>,
}

impl<'m> Surroundings<'m> {
    /// The points of a scene; mistakes in the names of parameters go to the builder.
    pub(super) fn of(builder: &mut Builder, scene: &'m Record, mechanism: &'m Mechanism) -> Self {
        let joints = scene.records("joint");
        let number_of = |name: &str| joints.iter().position(|joint| joint.text("name") == Some(name));
        let ground = Point { name: "ground", joint: None, at: [0.0; 3], mass: None };
        let mut points = vec![ground];
        for (joint, record) in joints.iter().enumerate() {
            let name = record.text("name").unwrap_or_default();
            points.push(Point { name, joint: Some(joint), at: [0.0; 3], mass: None });
        }
        for part in scene.records("particle").iter().chain(scene.records("rigid_body")) {
            points.push(Point {
                name: part.text("name").unwrap_or_default(),
                joint: part.text("joint").and_then(number_of),
                at: part.vector("at").unwrap_or_default(),
                mass: part.number("mass"),
            });
        }
        let expressions = scene.records("force").iter().any(|force| force.has("drive") || force.has("energy"))
            || scene.records("constraint").iter().any(|constraint| constraint.has("motion"));
        let mut names = ExpressionNames::new(true);
        for (i, name) in mechanism.coordinates.iter().enumerate() {
            let dimension = if mechanism.angular[i] { Dimension::ANGLE } else { Dimension::LENGTH };
            let free = names.add(name, NameMeaning::Variable(Variable::Coordinate(i)), dimension);
            // A name that is taken twice by joints has a mistake already.
            let taken = ExpressionNames::new(true).add(name, NameMeaning::Number(0.0), Dimension::NONE);
            if let Some(joint) = number_of(name).filter(|_| !free && !taken && expressions) {
                let what = format!("the name `{name}` has a meaning of its own in expressions");
                builder.wrong(
                    Mistake::new(joints[joint].place_of("name"), what).valid("a name unlike t, pi and any function"),
                );
            }
            names.add_rate(name, Variable::Conjugate(i), dimension.over(Dimension::TIME));
        }
        builder.parameters(scene, &mut names);
        Self { mechanism, points, names }
    }

    /// The index of the coordinate that a key names.
    pub(super) fn coordinate(&self, record: &Record) -> Result<usize, Box<Mistake>> {
        let name = record.text("coordinate").unwrap_or_default();
        let known = &self.mechanism.coordinates;
        known.iter().position(|known| known == name).ok_or_else(|| {
            let shown: String = name.chars().take(60).collect();
            Mistake::new(record.place_of("coordinate"), format!("no coordinate is named `{shown}`"))
                .valid(words::one_of(name, known.iter().map(String::as_str)))
                .into()
        })
    }

    fn point(&self, record: &Record, key: &str) -> Result<&Point<'m>, Box<Mistake>> {
        let name = record.text(key).unwrap_or_default();
        self.points.iter().find(|point| point.name == name).ok_or_else(|| {
            Mistake::new(record.place_of(key), format!("no joint, particle or rigid body is named `{name}`"))
                .valid(words::one_of(name, self.points.iter().map(|point| point.name)))
                .into()
        })
    }

    /// A point of a key, moved by that of another one.
    pub(super) fn anchor(&self, record: &Record, key: &str, at: &str) -> Result<Anchor, Box<Mistake>> {
        let point = self.point(record, key)?;
        self.anchored(record, point, record.vector(at).unwrap_or_default())
    }

    fn anchored(&self, record: &Record, point: &Point<'_>, shift: [f64; 3]) -> Result<Anchor, Box<Mistake>> {
        let at = [0, 1, 2].map(|i| point.at[i] + shift[i]);
        let anchor = self.mechanism.tree.anchor(point.joint, at);
        Ok(anchor.map_err(|error| Mistake::new(record.place.clone(), error.to_string()).valid("finite numbers"))?)
    }

    /// The part of a record, or all parts, with their masses.
    fn parts(&self, record: &Record) -> Result<Vec<(Anchor, f64)>, Box<Mistake>> {
        let shift = record.vector("at").unwrap_or_default();
        if record.has("part") {
            let point = self.point(record, "part")?;
            let Some(mass) = point.mass else {
                return Err(Mistake::new(record.place_of("part"), format!("`{}` has no mass", point.name))
                    .valid("a particle or a rigid body")
                    .into());
            };
            return Ok(vec![(self.anchored(record, point, shift)?, mass)]);
        }
        let massive = self.points.iter().filter_map(|point| Some((point, point.mass?)));
        massive.map(|(point, mass)| Ok((self.anchored(record, point, shift)?, mass))).collect()
    }

    /// The points on which a force acts: of its part, or of all parts.
    fn points_on(&self, record: &Record) -> Result<Vec<Anchor>, Box<Mistake>> {
        if !record.has("part") {
            return Ok(self.parts(record)?.into_iter().map(|(anchor, _)| anchor).collect());
        }
        if record.text("part") == Some("ground") {
            return Err(Mistake::new(record.place_of("part"), "no force moves the ground")
                .valid("a joint, a particle or a rigid body")
                .into());
        }
        Ok(vec![self.anchor(record, "part", "at")?])
    }

    /// The places of two ends at the start.
    pub(super) fn places(&self, ends: &[Anchor; 2]) -> [Vector3<f64>; 2] {
        ends.each_ref().map(|end| self.mechanism.tree.place_of(end, &|i| self.mechanism.position[i]))
    }

    fn kind(&self, record: &Record) -> Result<Option<ForceKind>, Box<Mistake>> {
        let number = |key: &str| record.number(key);
        let built = |make: &dyn Fn() -> Option<ForceKind>| make();
        Ok(match record.text("type").unwrap_or_default() {
            "spring" => {
                let ends = [self.anchor(record, "from", "from_at")?, self.anchor(record, "to", "to_at")?];
                self.apart(record, &ends)?;
                let places = self.places(&ends);
                let directed =
                    ["length", "damping"].into_iter().any(|key| number(key).is_some_and(|value| 0.0 < value));
                // Within rounding of the places.
                if directed && (places[1] - places[0]).norm() <= 4.0 * f64::EPSILON * places[0].norm() {
                    return Err(Mistake::new(record.place_of("to"), "both ends are at one place at the start")
                        .valid("ends apart: without a direction a `length` or `damping` has no force")
                        .into());
                }
                built(&|| {
                    Some(ForceKind::Spring {
                        ends: ends.clone(),
                        stiffness: number("stiffness")?,
                        length: number("length")?,
                        damping: number("damping")?,
                    })
                })
            }
            "joint-spring" | "torsion-spring" => {
                let coordinate = self.coordinate(record)?;
                let angular = record.text("type") == Some("torsion-spring");
                if self.mechanism.angular[coordinate] != angular {
                    let name = &self.mechanism.coordinates[coordinate];
                    let (is, valid) =
                        if angular { ("a length", "joint-spring") } else { ("an angle", "torsion-spring") };
                    return Err(Mistake::new(record.place_of("coordinate"), format!("`{name}` is {is}"))
                        .valid(format!("type = \"{valid}\""))
                        .into());
                }
                let keys = if angular {
                    ["torsional_stiffness", "rest_angle", "torsional_damping"]
                } else {
                    ["stiffness", "rest", "damping"]
                };
                built(&|| {
                    let [stiffness, rest, damping] = keys.map(number);
                    Some(ForceKind::JointSpring { coordinate, stiffness: stiffness?, rest: rest?, damping: damping? })
                })
            }
            "drag" => {
                let points = self.points_on(record)?;
                built(&|| {
                    Some(ForceKind::Drag {
                        points: points.clone(),
                        linear: number("linear")?,
                        quadratic: number("quadratic")?,
                        wind: record.vector("wind")?,
                    })
                })
            }
            "uniform-field" => {
                let points = self.parts(record)?;
                built(&|| Some(ForceKind::Uniform { points: points.clone(), field: record.vector("acceleration")? }))
            }
            "constant-force" => {
                let point: Vec<_> = self.points_on(record)?.into_iter().map(|anchor| (anchor, 1.0)).collect();
                built(&|| Some(ForceKind::Uniform { points: point.clone(), field: record.vector("force")? }))
            }
            "central-field" => {
                let points = self.parts(record)?;
                built(&|| {
                    let (centre, gm) = (record.vector("centre")?, number("gm")?);
                    Some(ForceKind::Central { points: points.clone(), centre, gm })
                })
            }
            "motor" => {
                let coordinate = self.coordinate(record)?;
                let dimension = if self.mechanism.angular[coordinate] { Dimension::MOMENT } else { Dimension::FORCE };
                let force = text::of_key(record, "drive", &self.names, dimension)?;
                Some(ForceKind::Motor { coordinate, force })
            }
            _ => {
                let energy = text::of_key(record, "energy", &self.names, ENERGY)?;
                if energy.conjugates() != 0 {
                    return Err(Mistake::new(record.place_of("energy"), "the stored energy depends on a rate")
                        .valid("an expression of coordinates and t; a force of rates is a motor")
                        .into());
                }
                Some(ForceKind::Potential { energy })
            }
        })
    }

    /// Refuses two ends that the same coordinates move: their distance never changes.
    pub(super) fn apart(&self, record: &Record, ends: &[Anchor; 2]) -> Result<(), Box<Mistake>> {
        let [one, other] = ends.each_ref().map(|end| self.mechanism.tree.coordinates_of(end));
        if one.ne(other) {
            return Ok(());
        }
        Err(Mistake::new(record.place_of("to"), "both ends are on one body: their distance never changes")
            .valid("two points of two frames")
            .into())
    }
}

impl Builder<'_> {
    /// Adds `[parameters]` to the names of expressions.
    pub(crate) fn parameters(&mut self, scene: &Record, names: &mut ExpressionNames) {
        for parameter in scene.parameters("parameters") {
            if !names.add(&parameter.name, NameMeaning::Number(parameter.value), parameter.dimension) {
                self.refuse(
                    parameter.place.clone(),
                    format!("the name `{}` is taken", parameter.name),
                    "a name unlike t, pi, any coordinate and any function",
                );
            }
        }
    }

    /// The forces of a scene.
    pub(super) fn forces(&mut self, scene: &Record, surroundings: &Surroundings<'_>) -> Option<Vec<Force>> {
        if scene.has("parameters") && !scene.fields.contains_key("parameters") {
            // Expressions would lack what is wrong there.
            return None;
        }
        let records = scene.records("force");
        self.unique_names(&[records]);
        let mut forces = Vec::with_capacity(records.len());
        for record in records {
            if record.text("name") == Some("prescribed motion") {
                let what = "the name `prescribed motion` is that of the work of all drives";
                self.refuse(record.place_of("name"), what, "another name");
            }
            match surroundings.kind(record) {
                Ok(Some(kind)) => {
                    forces.push(Force { name: record.text("name").unwrap_or_default().to_string(), kind });
                }
                // A number that is missing or wrong has a mistake of its own.
                Ok(None) => {}
                Err(mistake) => self.wrong(*mistake),
            }
        }
        (forces.len() == records.len()).then_some(forces)
    }
}
