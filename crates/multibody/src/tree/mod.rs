//! The tree of bodies: what the passes read.

mod build;
mod inertia;
mod joint;
mod plan;

use piola_numerics::Real;

pub use build::RigidTreeBuilder;
pub use inertia::BodyInertia;
pub use joint::{JointKind, TreeJoint};
pub use plan::TreePlan;

use crate::error::MultibodyError;
use crate::freedoms::Relatives;
use crate::link::{Kind, Link};

/// A body of a tree. The ground is [`BodyIndex::GROUND`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BodyIndex(pub(crate) usize);

impl BodyIndex {
    /// The ground, on which trees stand.
    pub const GROUND: Self = Self(0);

    /// The position among the bodies; the ground is 0.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0
    }
}

/// A frame on a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FrameIndex(pub(crate) usize);

/// A body or a frame where it is on its link.
#[derive(Clone, Debug)]
pub(crate) struct Mounted {
    pub(crate) name: String,
    /// The state of the link; 0 is the ground.
    pub(crate) link: usize,
    /// The origin in the link's frame.
    pub(crate) origin: [f64; 3],
    /// Takes components in its own axes to those in the link's.
    pub(crate) axes: [[f64; 3]; 3],
}

/// A joint with its place in q and v.
///
/// # Example
/// See [`RigidTree::joints`].
#[derive(Clone, Debug, PartialEq)]
pub struct JointPlace {
    /// The joint as it was described.
    pub joint: TreeJoint,
    /// The body that it moves.
    pub child: BodyIndex,
    /// The first component of q.
    pub first_coordinate: usize,
    /// The first component of v.
    pub first_freedom: usize,
}

/// A tree of rigid bodies.
///
/// ```text
/// M(q) v̇ + b(q, v) = τ + Σ Jᵀ f        q on its manifold, v in its tangent space
/// ```
///
/// Links behind elementary joints are the unit of all passes: fixed joints are merged, and joints of several freedoms are
/// series of elementary ones, but for spherical and free joints.
///
/// # Example
/// A pendulum of 2 kg at 0.5 m, held horizontally by m g l = 9.81 N m.
/// ```
/// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
/// let mut builder = RigidTree::builder();
/// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
/// let bob = BodyInertia::particle(2.0, [0.5, 0.0, 0.0])?;
/// builder.attach(BodyIndex::GROUND, hinge, "bob", bob)?;
/// let tree = builder.build()?;
/// let mut work = tree.workspace();
/// let mut torque = [0.0];
/// tree.inverse_dynamics(&mut work, &[0.0], &[0.0], &[0.0], &mut torque)?;
/// assert_eq!(torque, [-9.81]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("multibody", "articulated system", "robot"))]
#[derive(Clone, Debug)]
pub struct RigidTree {
    pub(crate) gravity: [f64; 3],
    pub(crate) links: Vec<Link>,
    /// The ground is the first.
    pub(crate) bodies: Vec<Mounted>,
    pub(crate) inertias: Vec<BodyInertia>,
    /// The ground is its own.
    pub(crate) parents: Vec<BodyIndex>,
    pub(crate) frames: Vec<Mounted>,
    pub(crate) joints: Vec<JointPlace>,
    /// For each freedom.
    pub(crate) armature: Vec<f64>,
    pub(crate) coordinates: usize,
    pub(crate) freedoms: usize,
    /// The sum of squares of the freedoms of elementary joints.
    pub(crate) squares: usize,
    /// The links with unit quaternions.
    pub(crate) quaternions: Vec<usize>,
    pub(crate) relatives: Relatives,
}

impl RigidTree {
    /// A builder without bodies and with gravity 9.81 m/s² along −z.
    #[must_use]
    pub fn builder() -> RigidTreeBuilder {
        RigidTreeBuilder::default()
    }

    /// The components of q.
    #[must_use]
    pub const fn coordinates(&self) -> usize {
        self.coordinates
    }

    /// The components of v, n.
    #[must_use]
    pub const fn freedoms(&self) -> usize {
        self.freedoms
    }

    /// Links behind elementary joints: the units of work of every pass.
    #[must_use]
    pub fn links(&self) -> usize {
        self.links.len()
    }

    /// Bodies, without the ground.
    #[must_use]
    pub fn bodies(&self) -> usize {
        self.bodies.len() - 1
    }

    /// The joints in the order of q and v, fixed ones too.
    ///
    /// ```
    /// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
    /// let mut builder = RigidTree::builder();
    /// let ball = BodyInertia::new(1.0, [0.0; 3], [[0.4, 0.0, 0.0], [0.0, 0.4, 0.0], [0.0, 0.0, 0.4]])?;
    /// builder.attach(BodyIndex::GROUND, TreeJoint::new("free", JointKind::Free), "ball", ball)?;
    /// let tree = builder.build()?;
    /// assert_eq!(tree.joints()[0].joint.name, "free");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn joints(&self) -> &[JointPlace] {
        &self.joints
    }

    /// Gravity, m/s² in space.
    #[must_use]
    pub const fn gravity(&self) -> [f64; 3] {
        self.gravity
    }

    /// The same tree under another gravity (m/s², space components).
    ///
    /// # Errors
    /// [`MultibodyError::NotFinite`].
    pub fn set_gravity(&mut self, gravity: [f64; 3]) -> Result<(), MultibodyError> {
        crate::error::check_finite("gravity", &gravity)?;
        self.gravity = gravity;
        Ok(())
    }

    /// Gives a joint other dampers and friction (N m s or N s/m; N m or N), for each freedom: see
    /// [`joint_forces`](Self::joint_forces). `joint` is its index in [`joints`](Self::joints).
    ///
    /// # Errors
    /// [`MultibodyError::NoSuchIndex`]; [`MultibodyError::InvalidJointData`] for negative numbers and for those that are not finite.
    pub fn set_friction(&mut self, joint: usize, damping: f64, friction: f64) -> Result<(), MultibodyError> {
        self.change_joint(joint, |joint| joint.with_friction(damping, friction))
    }

    /// Gives a joint another spring, for each freedom of a joint without a quaternion: its stiffness (N m/rad or N/m) and the
    /// coordinate at which it is at rest (rad or m). `joint` is its index in [`joints`](Self::joints).
    ///
    /// # Errors
    /// As [`set_friction`](Self::set_friction).
    pub fn set_spring(&mut self, joint: usize, stiffness: f64, rest: f64) -> Result<(), MultibodyError> {
        self.change_joint(joint, |joint| joint.with_spring(stiffness, rest))
    }

    fn change_joint(
        &mut self,
        index: usize,
        change: impl FnOnce(TreeJoint) -> TreeJoint,
    ) -> Result<(), MultibodyError> {
        let count = self.joints.len();
        let place = self.joints.get_mut(index).ok_or(MultibodyError::NoSuchIndex { what: "joint", index, count })?;
        let changed = change(place.joint.clone());
        changed.check()?;
        place.joint = changed;
        Ok(())
    }

    /// The body of a name.
    ///
    /// # Errors
    /// [`MultibodyError::NoSuchName`].
    pub fn body(&self, name: &str) -> Result<BodyIndex, MultibodyError> {
        let found = self.bodies.iter().position(|body| body.name == name).map(BodyIndex);
        found.ok_or_else(|| MultibodyError::NoSuchName { what: "body", name: name.to_owned() })
    }

    /// The frame of a name.
    ///
    /// # Errors
    /// [`MultibodyError::NoSuchName`].
    pub fn frame(&self, name: &str) -> Result<FrameIndex, MultibodyError> {
        let found = self.frames.iter().position(|frame| frame.name == name).map(FrameIndex);
        found.ok_or_else(|| MultibodyError::NoSuchName { what: "frame", name: name.to_owned() })
    }

    /// The name of a body; `ground` is the ground's.
    #[must_use]
    pub fn body_name(&self, body: BodyIndex) -> &str {
        self.bodies.get(body.0).map_or("", |body| &body.name)
    }

    /// The body to which a body is attached; the ground is attached to itself.
    ///
    /// # Errors
    /// [`MultibodyError::NoSuchIndex`].
    pub fn parent_of(&self, body: BodyIndex) -> Result<BodyIndex, MultibodyError> {
        let count = self.bodies.len();
        self.parents.get(body.0).copied().ok_or(MultibodyError::NoSuchIndex { what: "body", index: body.0, count })
    }

    /// The mass of all bodies that can move, kg.
    #[must_use]
    pub fn total_mass(&self) -> f64 {
        self.links.iter().map(|link| link.mass).sum()
    }

    /// The body where it is on its link.
    pub(crate) fn mounted(&self, body: BodyIndex) -> Result<&Mounted, MultibodyError> {
        let count = self.bodies.len();
        self.bodies.get(body.0).ok_or(MultibodyError::NoSuchIndex { what: "body", index: body.0, count })
    }

    /// The frame where it is on its link.
    pub(crate) fn mounted_frame(&self, frame: FrameIndex) -> Result<&Mounted, MultibodyError> {
        let count = self.frames.len();
        self.frames.get(frame.0).ok_or(MultibodyError::NoSuchIndex { what: "frame", index: frame.0, count })
    }

    /// The name of the joint of a link.
    pub(crate) fn joint_of(&self, link: &Link) -> String {
        self.joints.get(link.joint).map_or_else(String::new, |joint| joint.joint.name.clone())
    }

    /// Whether all quaternions of a configuration have unit length, to the square root of rounding.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn has_unit_quaternions<T: Real>(&self, q: &[T]) -> bool {
        use piola_numerics::Mask;
        let mut unit = T::Mask::splat(true);
        for &link in &self.quaternions {
            let k = self.links[link].q;
            let excess = q[k] * q[k] + q[k + 1] * q[k + 1] + q[k + 2] * q[k + 2] + q[k + 3] * q[k + 3] - T::one();
            unit = unit & excess.abs().at_most(T::lit(tolerance::<T>()));
        }
        unit.all()
    }

    /// Names the first quaternion without unit length.
    pub(crate) fn check_quaternions<T: Real>(&self, q: &[T]) -> Result<(), MultibodyError> {
        for link in self.links.iter().filter(|link| matches!(link.kind, Kind::Spherical | Kind::Free)) {
            for lane in 0..T::LANES {
                let squared: f64 = q[link.q..link.q + 4].iter().map(|x| x.primal(lane).powi(2)).sum();
                if squared.is_nan() || tolerance::<T>() < (squared - 1.0).abs() {
                    return Err(MultibodyError::NotUnitQuaternion {
                        joint: self.joint_of(link),
                        length: squared.sqrt(),
                    });
                }
            }
        }
        Ok(())
    }
}

/// By how much the squared length of a quaternion may miss one: more than steps without renormalisation lose.
fn tolerance<T: Real>() -> f64 {
    piola_numerics::sums::unit_in_last_place::<T>().sqrt()
}
