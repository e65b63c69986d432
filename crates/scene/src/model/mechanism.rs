//! Trees of joints with particles and rigid bodies: a placement map made of data.

use nalgebra::{Matrix3, Vector3};
use piola_kinematics::{Attitude, Holonomic, Inertia, KinematicsError, Placement, RigidBody};
use piola_numerics::Real;

use super::{Builder, independence};
use piola_document::{Mistake, Record};

/// A mechanism: its joints, the names of its parts and coordinates, its state at the start.
#[derive(Debug, Clone)]
pub struct Mechanism {
    /// The placement map.
    pub tree: JointTree,
    /// Names of the parts, in the order in which the tree places them.
    pub parts: Vec<PartName>,
    /// Names of the coordinates: `upper`, `pivot.angles[0]`.
    pub coordinates: Vec<String>,
    /// Whether each coordinate is an angle (rad) rather than a length (m).
    pub angular: Vec<bool>,
    /// Acceleration of gravity, m/s².
    pub gravity: [f64; 3],
    /// Coordinates at the start.
    pub position: Vec<f64>,
    /// Their rates at the start.
    pub velocity: Vec<f64>,
}

/// A part with its mass.
#[derive(Debug, Clone, PartialEq)]
pub struct PartName {
    /// Name.
    pub name: String,
    /// Mass, kg.
    pub mass: f64,
    /// Whether it has an attitude.
    pub rigid: bool,
}

/// A tree of joints as a placement map over any scalar.
///
/// ```text
/// frame(j) = frame(parent) ∘ offset ∘ motion(q_j)        part at y:  x = o + A y
/// ```
/// Frames are passed down the tree by value, so that a placement allocates nothing. Parts are placed joint by joint, the
/// parts of a joint before those of its children.
#[derive(Debug, Clone)]
pub struct JointTree {
    joints: Vec<Joint>,
    roots: Vec<usize>,
    freedom: usize,
}

#[derive(Debug, Clone)]
struct Joint {
    offset: [f64; 3],
    motion: Motion,
    /// Index of its first coordinate.
    first: usize,
    children: Vec<usize>,
    parts: Vec<Part>,
}

#[derive(Debug, Clone)]
enum Motion {
    Fixed,
    Revolute([f64; 3]),
    Prismatic([f64; 3]),
    Universal([f64; 3], [f64; 3]),
    Spherical,
    Free,
}

#[derive(Debug, Clone)]
struct Part {
    at: [f64; 3],
    kind: PartKind,
}

#[derive(Debug, Clone)]
enum PartKind {
    Particle(f64),
    Body(RigidBody),
}

impl Motion {
    fn freedom(&self) -> usize {
        match self {
            Self::Fixed => 0,
            Self::Revolute(_) | Self::Prismatic(_) => 1,
            Self::Universal(..) => 2,
            Self::Spherical => 3,
            Self::Free => 6,
        }
    }
}

impl JointTree {
    /// The number of coordinates.
    #[must_use]
    pub fn freedom(&self) -> usize {
        self.freedom
    }

    fn place_joint<T: Real>(
        &self,
        joint: &Joint,
        origin: Vector3<T>,
        attitude: Attitude<T>,
        q: &[T],
        bodies: &mut impl Placement<T>,
    ) {
        let q_j = &q[joint.first..];
        let mut origin = origin + attitude.to_space(&constant(joint.offset));
        let mut attitude = attitude;
        match &joint.motion {
            Motion::Fixed => {}
            Motion::Revolute(axis) => attitude = attitude.product(about(*axis, q_j[0])),
            Motion::Prismatic(axis) => origin += attitude.to_space(&constant(*axis).map(|x: T| x * q_j[0])),
            Motion::Universal(first, second) => {
                attitude = attitude.product(about(*first, q_j[0])).product(about(*second, q_j[1]));
            }
            Motion::Spherical => attitude = attitude.product(Attitude::from_euler_zyz([q_j[0], q_j[1], q_j[2]])),
            Motion::Free => {
                origin += attitude.to_space(&Vector3::new(q_j[0], q_j[1], q_j[2]));
                attitude = attitude.product(Attitude::from_euler_zyz([q_j[3], q_j[4], q_j[5]]));
            }
        }
        for part in &joint.parts {
            let centre = origin + attitude.to_space(&constant(part.at));
            match &part.kind {
                PartKind::Particle(mass) => bodies.particle(*mass, centre),
                PartKind::Body(body) => bodies.body(body, centre, attitude),
            }
        }
        for &child in &joint.children {
            self.place_joint(&self.joints[child], origin, attitude, q, bodies);
        }
    }
}

impl Holonomic for JointTree {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        for &root in &self.roots {
            self.place_joint(&self.joints[root], Vector3::zeros(), Attitude::identity(), q, bodies);
        }
    }
}

fn constant<T: Real>(vector: [f64; 3]) -> Vector3<T> {
    Vector3::from(vector.map(T::lit))
}

/// Rotation by an angle about a unit axis.
fn about<T: Real>(axis: [f64; 3], angle: T) -> Attitude<T> {
    let (s, c) = (angle * T::lit(0.5)).sin_cos();
    let [x, y, z] = axis.map(|x| T::lit(x) * s);
    Attitude { w: c, x, y, z }
}

/// Joints on one path from the ground: the placement recurses along it.
const DEEPEST: usize = 200;

/// A joint as its record says, before the tree is put together.
struct Draft {
    name: String,
    parent: Option<usize>,
    offset: [f64; 3],
    motion: Motion,
    coordinates: Vec<Coordinate>,
}

struct Coordinate {
    name: String,
    angular: bool,
    position: f64,
    velocity: f64,
}

impl Builder<'_> {
    pub(super) fn mechanism(&mut self, scene: &Record, table: &Record) -> Option<Mechanism> {
        let lists = [scene.records("joint"), scene.records("particle"), scene.records("rigid_body")];
        self.unique_names(&lists);
        let [joints, particles, bodies] = lists;
        if particles.is_empty() && bodies.is_empty() && !scene.has("particle") && !scene.has("rigid_body") {
            self.wrong(
                Mistake::new(table.place.clone(), "[mechanism] without parts")
                    .valid("at least one [[particle]] or [[rigid_body]] on a [[joint]]"),
            );
        }
        let names: Vec<&str> = joints.iter().map(|joint| joint.text("name").unwrap_or("")).collect();
        let drafts: Vec<Option<Draft>> = joints.iter().map(|record| self.joint(record, &names)).collect();
        let mut parts: Vec<Option<(usize, String, Part)>> =
            particles.iter().map(|record| self.particle(record, &names)).collect();
        parts.extend(bodies.iter().map(|record| self.rigid_body(record, &names)));
        let drafts: Vec<Draft> = drafts.into_iter().collect::<Option<_>>()?;
        let order = self.order(joints, &drafts)?;
        let parts: Vec<(usize, String, Part)> = parts.into_iter().collect::<Option<_>>()?;
        let mechanism = assemble(drafts, &order, parts, table.vector("gravity")?);
        self.independent(scene, joints, &mechanism).then_some(mechanism)
    }

    fn joint(&mut self, record: &Record, names: &[&str]) -> Option<Draft> {
        let name = record.text("name")?.to_string();
        if name == "ground" {
            self.wrong(Mistake::new(record.place_of("name"), "the name `ground` is taken").valid("another name"));
            return None;
        }
        let parent =
            if record.text("parent")? == "ground" { None } else { Some(self.find(record, "parent", "joint", names)?) };
        let kind = record.text("type")?.to_string();
        let mut coordinates = Vec::new();
        let mut coordinate = |name: String, angular, position, velocity| {
            coordinates.push(Coordinate { name, angular, position, velocity });
        };
        let axis = self.axis(record, "axis");
        let motion = match kind.as_str() {
            "fixed" => Motion::Fixed,
            "revolute" => {
                coordinate(name.clone(), true, record.number("angle")?, record.number("rate")?);
                Motion::Revolute(axis?)
            }
            "prismatic" => {
                coordinate(name.clone(), false, record.number("displacement")?, record.number("speed")?);
                Motion::Prismatic(axis?)
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
                    "universal" => Motion::Universal(axis?, self.axis(record, "second_axis")?),
                    "free" => Motion::Free,
                    _ => Motion::Spherical,
                }
            }
        };
        Some(Draft { name, parent, offset: record.vector("offset")?, motion, coordinates })
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
                self.wrong(
                    Mistake::new(record.place_of(key), format!("`{key}` is a list of {found}"))
                        .valid(format!("a list of {count} for this type of joint")),
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
            self.wrong(
                Mistake::new(record.place_of(key), format!("`{key}` is zero")).valid("a direction, as [0, 1, 0]"),
            );
            return None;
        }
        // Divided by the largest component first: squares neither overflow nor vanish.
        let scaled = axis.map(|x| x / largest);
        let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
        Some(scaled.map(|x| x / length))
    }

    fn particle(&mut self, record: &Record, names: &[&str]) -> Option<(usize, String, Part)> {
        let joint = self.find(record, "joint", "joint", names)?;
        let part = Part { at: record.vector("at")?, kind: PartKind::Particle(record.number("mass")?) };
        Some((joint, record.text("name")?.to_string(), part))
    }

    fn rigid_body(&mut self, record: &Record, names: &[&str]) -> Option<(usize, String, Part)> {
        let joint = self.find(record, "joint", "joint", names);
        let inertia = self.inertia(record);
        let body = RigidBody::new(record.number("mass")?, inertia?).ok()?;
        Some((joint?, record.text("name")?.to_string(), Part { at: record.vector("at")?, kind: PartKind::Body(body) }))
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
                self.wrong(
                    Mistake::new(record.place_of("inertia"), format!("no body has this inertia: {error}")).valid(valid),
                );
            })
            .ok()
    }

    /// Joints so that parents come before children; a cycle has no such order.
    fn order(&mut self, records: &[Record], drafts: &[Draft]) -> Option<Vec<usize>> {
        let mut order = Vec::with_capacity(drafts.len());
        let mut depth = vec![0; drafts.len()];
        let mut reported = vec![false; drafts.len()];
        let mut valid = true;
        for start in 0..drafts.len() {
            let mut path = Vec::new();
            let mut at = Some(start);
            while let Some(joint) = at.filter(|joint| depth[*joint] == 0 && !reported[*joint]) {
                if let Some(first) = path.iter().position(|seen| *seen == joint) {
                    let mut names: Vec<&str> = path[first..].iter().map(|j: &usize| drafts[*j].name.as_str()).collect();
                    names.push(&drafts[joint].name);
                    self.wrong(
                        Mistake::new(
                            records[joint].place_of("parent"),
                            format!("the joints form a cycle: {}", names.join(" on ")),
                        )
                        .valid("parents that lead to the ground"),
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
                order.push(joint);
                if depth[joint] == DEEPEST + 1 {
                    valid = false;
                    self.wrong(
                        Mistake::new(
                            records[joint].place_of("parent"),
                            format!("more than {DEEPEST} joints between `{}` and the ground", drafts[joint].name),
                        )
                        .valid(format!("at most {DEEPEST}")),
                    );
                }
            }
        }
        valid.then_some(order)
    }

    /// Reports coordinates that move nothing or of which some combination moves nothing.
    fn independent(&mut self, scene: &Record, joints: &[Record], mechanism: &Mechanism) -> bool {
        let Mechanism { tree, coordinates, position, .. } = mechanism;
        let dependent = independence::dependent_coordinates(tree, position);
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
            self.wrong(Mistake::new(owner(last).place.clone(), found).valid(
                "as many coordinates as there are motions: a joint less, a mass at the end, or angles away from where the Eulerian angles are singular",
            ));
        }
        false
    }
}

fn assemble(drafts: Vec<Draft>, order: &[usize], parts: Vec<(usize, String, Part)>, gravity: [f64; 3]) -> Mechanism {
    let count = drafts.len();
    let parents: Vec<Option<usize>> = drafts.iter().map(|draft| draft.parent).collect();
    let mut mechanism = Mechanism {
        tree: JointTree { joints: Vec::with_capacity(count), roots: Vec::new(), freedom: 0 },
        parts: Vec::new(),
        coordinates: Vec::new(),
        angular: Vec::new(),
        gravity,
        position: Vec::new(),
        velocity: Vec::new(),
    };
    // Coordinates are numbered as the joints are written.
    for draft in drafts {
        let first = mechanism.position.len();
        debug_assert_eq!(draft.motion.freedom(), draft.coordinates.len());
        for coordinate in draft.coordinates {
            mechanism.coordinates.push(coordinate.name);
            mechanism.angular.push(coordinate.angular);
            mechanism.position.push(coordinate.position);
            mechanism.velocity.push(coordinate.velocity);
        }
        let (offset, motion) = (draft.offset, draft.motion);
        mechanism.tree.joints.push(Joint { offset, motion, first, children: Vec::new(), parts: Vec::new() });
    }
    mechanism.tree.freedom = mechanism.position.len();
    for &joint in order {
        match parents[joint] {
            Some(parent) => mechanism.tree.joints[parent].children.push(joint),
            None => mechanism.tree.roots.push(joint),
        }
    }
    let mut names: Vec<Vec<PartName>> = vec![Vec::new(); count];
    for (joint, name, part) in parts {
        let (mass, rigid) = match &part.kind {
            PartKind::Particle(mass) => (*mass, false),
            PartKind::Body(body) => (body.mass(), true),
        };
        names[joint].push(PartName { name, mass, rigid });
        mechanism.tree.joints[joint].parts.push(part);
    }
    // Names in the order of placement.
    let mut stack: Vec<usize> = mechanism.tree.roots.iter().rev().copied().collect();
    while let Some(joint) = stack.pop() {
        mechanism.parts.append(&mut names[joint]);
        stack.extend(mechanism.tree.joints[joint].children.iter().rev());
    }
    mechanism
}
