//! Joints as a user describes them.

use nalgebra::Vector3;
use piola_kinematics::Attitude;

use crate::error::MultibodyError;

/// How a joint lets a body move against its parent. Axes are unit vectors in the joint's frame.
///
/// | joint | q | v |
/// |---|---|---|
/// | fixed | – | – |
/// | revolute | angle, rad | its rate |
/// | prismatic | displacement, m | its rate |
/// | helical | angle; the displacement is `pitch` (m/rad) times it | its rate |
/// | universal | angle about `first`, then about `second` as turned by it | their rates |
/// | cylindrical | displacement along the axis, then angle about it | their rates |
/// | planar | displacements along x and y, angle about z | their rates |
/// | spherical | unit quaternion (w, x, y, z), child to parent | angular velocity in the child's axes |
/// | free | unit quaternion, then position of the origin | angular velocity, velocity of the origin, in the child's axes |
///
/// # Example
/// ```
/// use piola_multibody::JointKind;
/// assert_eq!((JointKind::Free.coordinates(), JointKind::Free.freedoms()), (7, 6));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum JointKind {
    /// No motion: the body becomes a part of its parent.
    Fixed,
    /// Rotation about an axis.
    #[doc(alias("hinge", "continuous"))]
    Revolute {
        /// The axis.
        axis: [f64; 3],
    },
    /// Translation along an axis.
    #[doc(alias = "slider")]
    Prismatic {
        /// The axis.
        axis: [f64; 3],
    },
    /// A screw.
    #[doc(alias = "screw")]
    Helical {
        /// The axis.
        axis: [f64; 3],
        /// Metres a radian.
        pitch: f64,
    },
    /// Two rotations, the second about an axis that the first carries along.
    #[doc(alias("Cardan joint", "Hooke joint"))]
    Universal {
        /// The axis fixed in the parent.
        first: [f64; 3],
        /// The axis fixed in the child.
        second: [f64; 3],
    },
    /// Translation along an axis and rotation about it.
    Cylindrical {
        /// The axis.
        axis: [f64; 3],
    },
    /// Motion in the plane of the joint's x and y.
    Planar,
    /// Any rotation.
    #[doc(alias = "ball joint")]
    Spherical,
    /// Any rigid motion.
    #[doc(alias = "floating")]
    Free,
}

impl JointKind {
    /// Components of q.
    #[must_use]
    pub const fn coordinates(&self) -> usize {
        match self {
            Self::Spherical => 4,
            Self::Free => 7,
            other => other.freedoms(),
        }
    }

    /// Components of v.
    #[must_use]
    pub const fn freedoms(&self) -> usize {
        match self {
            Self::Fixed => 0,
            Self::Revolute { .. } | Self::Prismatic { .. } | Self::Helical { .. } => 1,
            Self::Universal { .. } | Self::Cylindrical { .. } => 2,
            Self::Planar | Self::Spherical => 3,
            Self::Free => 6,
        }
    }
}

/// A joint: its kind, where it is in the parent's frame, and data of its motor and its stops.
///
/// # Example
/// ```
/// use piola_multibody::{JointKind, TreeJoint};
/// let elbow = TreeJoint::new("elbow", JointKind::Revolute { axis: [0.0, 1.0, 0.0] })
///     .at([0.0, 0.0, 0.4])
///     .with_armature(0.02)
///     .with_limits(-2.0, 2.0);
/// assert_eq!(elbow.limits, [-2.0, 2.0]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TreeJoint {
    /// The name, which no other joint of the tree has.
    pub name: String,
    /// How it moves.
    pub kind: JointKind,
    /// The origin of its frame in the parent's frame, m.
    pub origin: [f64; 3],
    /// The axes of its frame in the parent's frame.
    pub attitude: Attitude<f64>,
    /// Inertia of the motor as reflected at the joint, added to the diagonal of the mass matrix, kg m² or kg; zero for a free
    /// joint.
    pub armature: f64,
    /// Viscous damping, N m s or N s/m.
    pub damping: f64,
    /// Coulomb friction, N m or N.
    pub friction: f64,
    /// Stiffness of a spring, N m/rad or N/m.
    pub stiffness: f64,
    /// The coordinate at which the spring is at rest, rad or m.
    pub rest: f64,
    /// Lower and upper limit of each coordinate: infinite where there is none.
    pub limits: [f64; 2],
    /// Largest rate, rad/s or m/s: infinite where there is none.
    pub largest_rate: f64,
    /// Largest torque or force of the motor, N m or N: infinite where there is none.
    pub largest_effort: f64,
}

impl TreeJoint {
    /// A joint whose frame is that of the parent, without motor, friction or stops.
    pub fn new(name: impl Into<String>, kind: JointKind) -> Self {
        Self {
            name: name.into(),
            kind,
            origin: [0.0; 3],
            attitude: Attitude::identity(),
            armature: 0.0,
            damping: 0.0,
            friction: 0.0,
            stiffness: 0.0,
            rest: 0.0,
            limits: [f64::NEG_INFINITY, f64::INFINITY],
            largest_rate: f64::INFINITY,
            largest_effort: f64::INFINITY,
        }
    }

    /// Puts the origin of its frame (m, parent's frame).
    #[must_use]
    pub const fn at(mut self, origin: [f64; 3]) -> Self {
        self.origin = origin;
        self
    }

    /// Turns its frame against the parent's.
    #[must_use]
    pub const fn turned(mut self, attitude: Attitude<f64>) -> Self {
        self.attitude = attitude;
        self
    }

    /// Sets the reflected inertia of the motor (kg m² or kg), for each freedom. A free joint has none.
    #[must_use]
    pub const fn with_armature(mut self, armature: f64) -> Self {
        self.armature = armature;
        self
    }

    /// Sets viscous damping (N m s or N s/m) and Coulomb friction (N m or N), for each freedom.
    #[must_use]
    pub const fn with_friction(mut self, damping: f64, friction: f64) -> Self {
        self.damping = damping;
        self.friction = friction;
        self
    }

    /// Sets a spring: its stiffness (N m/rad or N/m) and the coordinate at which it is at rest (rad or m), for each freedom of a
    /// joint without a quaternion.
    #[must_use]
    pub const fn with_spring(mut self, stiffness: f64, rest: f64) -> Self {
        self.stiffness = stiffness;
        self.rest = rest;
        self
    }

    /// Sets the limits of each coordinate.
    #[must_use]
    pub const fn with_limits(mut self, lower: f64, upper: f64) -> Self {
        self.limits = [lower, upper];
        self
    }

    /// The rows of the rotation from the joint's frame to the parent's.
    pub(crate) fn rotation(&self) -> [[f64; 3]; 3] {
        let columns = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| self.attitude.to_space(&axis));
        [0, 1, 2].map(|i| [columns[0][i], columns[1][i], columns[2][i]])
    }

    /// Refuses data that are not finite or have the wrong sign, axes that are no unit vectors.
    pub(crate) fn check(&self) -> Result<(), MultibodyError> {
        let invalid = |quantity, value, condition| {
            Err(MultibodyError::InvalidJointData { joint: self.name.clone(), quantity, value, condition })
        };
        if let Some(&value) = self.origin.iter().find(|x| !x.is_finite()) {
            return invalid("origin", value, "|x| < ∞");
        }
        let length = self.attitude.squared_length().sqrt();
        if length.is_nan() || 1e-9 < (length - 1.0).abs() {
            return invalid("length of the attitude's quaternion", length, "|q| = 1");
        }
        for (quantity, value) in [
            ("reflected inertia", self.armature),
            ("damping", self.damping),
            ("friction", self.friction),
            ("stiffness", self.stiffness),
        ] {
            if !(0.0 <= value && value < f64::INFINITY) {
                return invalid(quantity, value, "0 ≤ x < ∞");
            }
        }
        // In axes that turn it would also need ω × (armature v), which no pass has.
        if 0.0 < self.armature && self.kind == JointKind::Free {
            return invalid("reflected inertia", self.armature, "x = 0 for a free joint");
        }
        if !self.rest.is_finite() {
            return invalid("coordinate at rest", self.rest, "|x| < ∞");
        }
        if 0.0 < self.stiffness && self.kind.coordinates() != self.kind.freedoms() {
            return invalid("stiffness", self.stiffness, "x = 0 for joints with a quaternion");
        }
        for (quantity, value) in [("largest rate", self.largest_rate), ("largest effort", self.largest_effort)] {
            if value.is_nan() || value < 0.0 {
                return invalid(quantity, value, "0 ≤ x");
            }
        }
        if self.limits.iter().any(|x| x.is_nan()) || self.limits[1] < self.limits[0] {
            return invalid("lower limit", self.limits[0], "lower ≤ upper");
        }
        match self.kind {
            JointKind::Revolute { axis } | JointKind::Prismatic { axis } | JointKind::Cylindrical { axis } => {
                self.check_axis(axis)
            }
            JointKind::Helical { axis, pitch } => {
                if !pitch.is_finite() {
                    return invalid("pitch", pitch, "|x| < ∞");
                }
                self.check_axis(axis)
            }
            JointKind::Universal { first, second } => {
                self.check_axis(first)?;
                self.check_axis(second)?;
                let product = crate::spatial::cross(first, second);
                let sine = crate::spatial::dot(product, product).sqrt();
                if sine < 1e-6 {
                    return invalid("sine of the angle between the axes", sine, "10⁻⁶ ≤ x");
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn check_axis(&self, axis: [f64; 3]) -> Result<(), MultibodyError> {
        let length = crate::spatial::dot(axis, axis).sqrt();
        if (length - 1.0).abs() <= 1e-9 {
            return Ok(());
        }
        Err(MultibodyError::AxisNotUnit { joint: self.name.clone(), length })
    }
}
