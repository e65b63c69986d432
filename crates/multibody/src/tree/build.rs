//! How bodies and joints become links.

use super::{BodyIndex, BodyInertia, FrameIndex, JointKind, JointPlace, Mounted, RigidTree, TreeJoint};
use crate::error::MultibodyError;
use crate::freedoms::Relatives;
use crate::link::{Kind, Link};
use crate::spatial::{add, cross, dot, product, scaled, times, transposed};

/// The identity matrix.
const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Collects the bodies of a tree, parents before children.
///
/// # Example
/// A cart on rails with a pendulum.
/// ```
/// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
/// let mut builder = RigidTree::builder();
/// let cart = builder.attach(
///     BodyIndex::GROUND,
///     TreeJoint::new("rails", JointKind::Prismatic { axis: [1.0, 0.0, 0.0] }),
///     "cart",
///     BodyInertia::particle(3.0, [0.0; 3])?,
/// )?;
/// builder.attach(
///     cart,
///     TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] }),
///     "bob",
///     BodyInertia::particle(1.0, [0.0, 0.0, -2.0])?,
/// )?;
/// let tree = builder.build()?;
/// assert_eq!((tree.freedoms(), tree.total_mass()), (2, 4.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct RigidTreeBuilder {
    tree: RigidTree,
}

impl Default for RigidTreeBuilder {
    fn default() -> Self {
        let ground = Mounted { name: "ground".to_owned(), link: 0, origin: [0.0; 3], axes: IDENTITY };
        let tree = RigidTree {
            gravity: [0.0, 0.0, -9.81],
            links: Vec::new(),
            bodies: vec![ground],
            inertias: vec![BodyInertia::MASSLESS],
            parents: vec![BodyIndex::GROUND],
            frames: Vec::new(),
            joints: Vec::new(),
            armature: Vec::new(),
            coordinates: 0,
            freedoms: 0,
            squares: 0,
            quaternions: Vec::new(),
            relatives: Relatives::default(),
        };
        Self { tree }
    }
}

/// A frame on a link: where the next elementary joint goes.
struct Cursor {
    link: usize,
    origin: [f64; 3],
    axes: [[f64; 3]; 3],
}

impl RigidTreeBuilder {
    /// Sets gravity (m/s², space components).
    ///
    /// # Errors
    /// [`MultibodyError::NotFinite`].
    pub fn with_gravity(mut self, gravity: [f64; 3]) -> Result<Self, MultibodyError> {
        self.tree.set_gravity(gravity)?;
        Ok(self)
    }

    /// Attaches a body to a parent by a joint.
    ///
    /// # Errors
    /// [`MultibodyError::DuplicateName`], [`MultibodyError::NoSuchIndex`], [`MultibodyError::AxisNotUnit`],
    /// [`MultibodyError::InvalidJointData`]. Nothing is attached then.
    pub fn attach(
        &mut self,
        parent: BodyIndex,
        joint: TreeJoint,
        body: impl Into<String>,
        inertia: BodyInertia,
    ) -> Result<BodyIndex, MultibodyError> {
        self.attach_in_series(parent, vec![joint], body, inertia)
    }

    /// Attaches a body to a parent by several joints, one after the other. Each joint's frame is placed in that which the one
    /// before it moves.
    ///
    /// # Errors
    /// As [`attach`](Self::attach).
    pub fn attach_in_series(
        &mut self,
        parent: BodyIndex,
        joints: Vec<TreeJoint>,
        body: impl Into<String>,
        inertia: BodyInertia,
    ) -> Result<BodyIndex, MultibodyError> {
        let name = body.into();
        self.check_names(&name, &joints)?;
        let mounted = self.tree.mounted(parent)?;
        let mut cursor = Cursor { link: mounted.link, origin: mounted.origin, axes: mounted.axes };
        let child = BodyIndex(self.tree.bodies.len());
        for joint in joints {
            self.add_joint(&mut cursor, joint, child);
        }
        if let Some(link) = cursor.link.checked_sub(1).and_then(|link| self.tree.links.get_mut(link)) {
            let (moment, about_origin) = inertia.seen_from(cursor.axes, cursor.origin);
            link.mass += inertia.mass();
            link.moment = add(link.moment, moment);
            for (sum, part) in link.inertia.iter_mut().zip(about_origin) {
                *sum += part;
            }
        }
        self.tree.bodies.push(Mounted { name, link: cursor.link, origin: cursor.origin, axes: cursor.axes });
        self.tree.inertias.push(inertia);
        self.tree.parents.push(parent);
        Ok(child)
    }

    /// Adds a frame on a body: its origin (m) and its attitude in the body's frame.
    ///
    /// # Errors
    /// [`MultibodyError::DuplicateName`], [`MultibodyError::NoSuchIndex`], [`MultibodyError::NotFinite`].
    pub fn add_frame(
        &mut self,
        body: BodyIndex,
        name: impl Into<String>,
        origin: [f64; 3],
        attitude: piola_kinematics::Attitude<f64>,
    ) -> Result<FrameIndex, MultibodyError> {
        let name = name.into();
        crate::error::check_finite("origin", &origin)?;
        crate::error::check_finite("attitude", &[attitude.w, attitude.x, attitude.y, attitude.z])?;
        if self.tree.frames.iter().any(|frame| frame.name == name) {
            return Err(MultibodyError::DuplicateName { what: "frames", name });
        }
        let mounted = self.tree.mounted(body)?;
        let rotation = TreeJoint::new("", JointKind::Fixed).turned(attitude).rotation();
        let frame = Mounted {
            name,
            link: mounted.link,
            origin: add(mounted.origin, times(mounted.axes, origin)),
            axes: product(mounted.axes, rotation),
        };
        self.tree.frames.push(frame);
        Ok(FrameIndex(self.tree.frames.len() - 1))
    }

    /// The tree.
    ///
    /// # Errors
    /// [`MultibodyError::NoInertia`] for a joint that moves no mass and has no reflected inertia.
    pub fn build(mut self) -> Result<RigidTree, MultibodyError> {
        let count = self.tree.links.len();
        let mut last_child = vec![0; count + 1];
        let mut beyond: Vec<f64> = self.tree.links.iter().map(|link| link.mass).collect();
        for state in (1..=count).rev() {
            let parent = self.tree.links[state - 1].parent;
            if parent != 0 {
                beyond[parent - 1] += beyond[state - 1];
            }
            last_child[parent] = last_child[parent].max(state);
        }
        for state in 1..=count {
            let link = &mut self.tree.links[state - 1];
            link.is_leaf = last_child[state] == 0;
            link.is_first_met = last_child[link.parent] == state;
        }
        for (link, mass) in self.tree.links.iter().zip(beyond) {
            let armature = &self.tree.armature[link.v..link.v + link.kind.freedoms()];
            if mass <= 0.0 && armature.iter().any(|&armature| armature <= 0.0) {
                return Err(MultibodyError::NoInertia { joint: self.tree.joint_of(link), inertia: mass });
            }
        }
        self.tree.relatives = Relatives::of_links(&self.tree.links, self.tree.freedoms);
        Ok(self.tree)
    }

    fn check_names(&self, body: &str, joints: &[TreeJoint]) -> Result<(), MultibodyError> {
        if self.tree.bodies.iter().any(|other| other.name == body) {
            return Err(MultibodyError::DuplicateName { what: "bodies", name: body.to_owned() });
        }
        for (i, joint) in joints.iter().enumerate() {
            joint.check()?;
            let mut others = self.tree.joints.iter().map(|place| &place.joint).chain(&joints[..i]);
            if others.any(|other| other.name == joint.name) {
                return Err(MultibodyError::DuplicateName { what: "joints", name: joint.name.clone() });
            }
        }
        Ok(())
    }

    /// Adds the elementary joints of a joint and moves the cursor to the frame behind it.
    fn add_joint(&mut self, cursor: &mut Cursor, joint: TreeJoint, child: BodyIndex) {
        cursor.origin = add(cursor.origin, times(cursor.axes, joint.origin));
        cursor.axes = product(cursor.axes, joint.rotation());
        let (kind, armature) = (joint.kind, joint.armature);
        let [first_coordinate, first_freedom] = [self.tree.coordinates, self.tree.freedoms];
        self.tree.joints.push(JointPlace { joint, child, first_coordinate, first_freedom });
        match kind {
            JointKind::Fixed => {}
            JointKind::Revolute { axis } => self.add_revolute(cursor, axis, armature),
            JointKind::Prismatic { axis } => self.add_prismatic(cursor, axis, armature),
            JointKind::Helical { axis, pitch } => self.add_helical(cursor, axis, pitch, armature),
            JointKind::Universal { first, second } => {
                self.add_revolute(cursor, first, armature);
                self.add_revolute(cursor, second, armature);
            }
            JointKind::Cylindrical { axis } => {
                self.add_prismatic(cursor, axis, armature);
                self.add_revolute(cursor, axis, armature);
            }
            JointKind::Planar => {
                self.add_prismatic(cursor, IDENTITY[0], armature);
                self.add_prismatic(cursor, IDENTITY[1], armature);
                self.add_revolute(cursor, IDENTITY[2], armature);
            }
            JointKind::Spherical => self.add_turned(cursor, Kind::Spherical, armature),
            JointKind::Free => self.add_turned(cursor, Kind::Free, armature),
        }
    }

    fn add_revolute(&mut self, cursor: &mut Cursor, axis: [f64; 3], armature: f64) {
        let axis = unit(times(cursor.axes, axis));
        if let Some((kind, sign)) = aligned(axis) {
            let mut link = self.link(kind, cursor);
            link.sign = sign;
            self.push(cursor, link, armature);
            return;
        }
        let turn = frame_along(axis);
        let mut link = self.link(Kind::RevoluteTurned, cursor);
        link.turn = turn;
        cursor.axes = product(transposed(turn), cursor.axes);
        self.push(cursor, link, armature);
    }

    fn add_prismatic(&mut self, cursor: &mut Cursor, axis: [f64; 3], armature: f64) {
        let mut link = self.link(Kind::Prismatic, cursor);
        link.axis = unit(times(cursor.axes, axis));
        self.push(cursor, link, armature);
    }

    fn add_helical(&mut self, cursor: &mut Cursor, axis: [f64; 3], pitch: f64, armature: f64) {
        let mut link = self.link(Kind::Helical, cursor);
        link.axis = unit(times(cursor.axes, axis));
        link.pitch = pitch;
        link.turn = frame_along(link.axis);
        cursor.axes = product(transposed(link.turn), cursor.axes);
        self.push(cursor, link, armature);
    }

    fn add_turned(&mut self, cursor: &mut Cursor, kind: Kind, armature: f64) {
        let mut link = self.link(kind, cursor);
        link.turn = cursor.axes;
        cursor.axes = IDENTITY;
        self.tree.quaternions.push(self.tree.links.len());
        self.push(cursor, link, armature);
    }

    /// A massless link at the cursor.
    fn link(&self, kind: Kind, cursor: &Cursor) -> Link {
        let state = self.tree.links.len() + 1;
        let is_next = cursor.link != 0 && cursor.link + 1 == state;
        let run = if is_next { self.tree.links[cursor.link - 1].run } else { state };
        Link {
            kind,
            is_leaf: true,
            is_first_met: false,
            parent: cursor.link,
            q: self.tree.coordinates,
            v: self.tree.freedoms,
            square: self.tree.squares,
            run,
            origin: cursor.origin,
            turn: IDENTITY,
            axis: [0.0; 3],
            pitch: 0.0,
            sign: 1.0,
            mass: 0.0,
            moment: [0.0; 3],
            inertia: [0.0; 6],
            joint: self.tree.joints.len() - 1,
        }
    }

    fn push(&mut self, cursor: &mut Cursor, link: Link, armature: f64) {
        let freedoms = link.kind.freedoms();
        self.tree.coordinates += link.kind.coordinates();
        self.tree.freedoms += freedoms;
        self.tree.squares += freedoms * freedoms;
        self.tree.armature.extend(std::iter::repeat_n(armature, freedoms));
        self.tree.links.push(link);
        cursor.link = self.tree.links.len();
        cursor.origin = [0.0; 3];
    }
}

/// A vector of nearly unit length, with unit length.
fn unit(a: [f64; 3]) -> [f64; 3] {
    scaled(dot(a, a).sqrt().recip(), a)
}

/// The coordinate axis, and its sign, that an axis is to rounding.
fn aligned(axis: [f64; 3]) -> Option<(Kind, f64)> {
    let kinds = [Kind::RevoluteX, Kind::RevoluteY, Kind::RevoluteZ];
    let is_small = |k: usize| axis[k].abs() <= 4.0 * f64::EPSILON;
    let k = (0..3).find(|&k| is_small((k + 1) % 3) && is_small((k + 2) % 3))?;
    Some((kinds[k], 1.0_f64.copysign(axis[k])))
}

/// A right-handed basis, in columns, whose third vector is the axis.
fn frame_along(axis: [f64; 3]) -> [[f64; 3]; 3] {
    let least = (0..3).fold(0, |least, k| if axis[k].abs() < axis[least].abs() { k } else { least });
    let second = unit(cross(axis, IDENTITY[least]));
    let first = cross(second, axis);
    transposed([first, second, axis])
}
