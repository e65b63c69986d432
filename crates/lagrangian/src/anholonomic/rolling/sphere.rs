//! A sphere on a plane, which may turn like a record.

use nalgebra::Vector3;
use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_numerics::Real;

use super::{OnPlane, check_length};
use crate::LagrangianError;
use crate::anholonomic::{AnholonomicFrame, Nonholonomic};
use crate::{Holonomic, Lagrangian, Placement};

/// A sphere that rolls on the plane z = 0, which may turn about the z axis with a constant rate Ω.
///
/// ```text
/// v = R ω×e₃ + Ω e₃×x
/// ```
///
/// Its attitude is a quaternion of any length, so that no attitude is singular: q = (x, y, w, i, j, k) with the
/// centre at (x, y, R). The quasi-velocities are ω in space components, the slip of the contact along x and y,
/// and the relative rate of the quaternion's length; the last three are held at zero.
///
/// The centre of mass is that of the sphere; the body need not be homogeneous.
///
/// # Example
/// On a turning table the centre runs on circles, with 2/7 of the table's rate for a homogeneous sphere:
/// a = 2/7 Ω e₃×v.
/// ```
/// use piola_lagrangian::anholonomic::rolling::RollingSphere;
/// let sphere = RollingSphere::homogeneous(1.0, 0.5)?.on_turntable(7.0)?.on_plane([0.0, 0.0, -10.0]);
/// let (q, w) = (RollingSphere::coordinates(1.0, 0.0), [2.0, 0.0, 3.0]);
/// let v = sphere.velocities(&q, &w, 0.0)?; // (0, −R ω_x + Ω x)
/// assert_eq!((v[0], v[1]), (0.0, 6.0));
/// let a = sphere.coordinate_acceleration(&q, &w, 0.0)?;
/// assert!((a[0] + 2.0 * v[1]).abs() < 1e-14 && (a[1] - 2.0 * v[0]).abs() < 1e-14);
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Unchecked"))]
pub struct RollingSphere {
    body: RigidBody,
    radius: f64,
    table_rate: f64,
}

impl RollingSphere {
    /// The quasi-velocities that are held: slip along x and y, and the rate of the quaternion's length.
    pub const HELD: [usize; 3] = [3, 4, 5];

    /// A sphere of the given radius (m).
    ///
    /// # Errors
    /// [`AnholonomicError::InvalidLength`](crate::AnholonomicError::InvalidLength).
    pub fn new(body: RigidBody, radius: f64) -> Result<Self, LagrangianError> {
        Ok(Self { body, radius: check_length("radius", radius)?, table_rate: 0.0 })
    }

    /// A homogeneous sphere, I = 2/5 M R².
    ///
    /// # Errors
    /// [`AnholonomicError::InvalidLength`](crate::AnholonomicError::InvalidLength); [`LagrangianError::Kinematics`] for a mass that is not positive.
    pub fn homogeneous(mass: f64, radius: f64) -> Result<Self, LagrangianError> {
        let moment = 0.4 * mass * check_length("radius", radius)?.powi(2);
        Self::new(RigidBody::new(mass, Inertia::principal([moment; 3])?)?, radius)
    }

    /// The plane turns about the z axis with Ω (rad/s).
    ///
    /// # Errors
    /// [`LagrangianError::NotFinite`].
    pub fn on_turntable(mut self, rate: f64) -> Result<Self, LagrangianError> {
        crate::check::check_finite("rate of the table", &[rate])?;
        self.table_rate = rate;
        Ok(self)
    }

    /// The sphere on its plane under uniform gravity (m/s², any direction).
    #[must_use]
    pub fn on_plane(self, gravity: [f64; 3]) -> OnPlane<Self> {
        let free = Lagrangian::of(self).with_uniform_gravity(gravity).in_frame(self);
        Nonholonomic::at_rest(free, &Self::HELD)
    }

    /// The coordinates of a sphere at (x, y) whose axes are those of space.
    #[must_use]
    pub const fn coordinates(x: f64, y: f64) -> [f64; 6] {
        [x, y, 1.0, 0.0, 0.0, 0.0]
    }

    /// The radius, m.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }
}

impl Holonomic for RollingSphere {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let attitude = Attitude { w: q[2], x: q[3], y: q[4], z: q[5] }.normalise();
        bodies.body(&self.body, Vector3::new(q[0], q[1], T::lit(self.radius)), attitude);
    }
}

impl AnholonomicFrame for RollingSphere {
    const DRIFT: bool = true;

    fn frame<T: Real>(&self, q: &[T], _t: T, rows: &mut [T]) {
        let (zero, half, radius) = (T::zero(), T::lit(0.5), T::lit(self.radius));
        let [w, x, y, z] = [q[2] * half, q[3] * half, q[4] * half, q[5] * half];
        let one = T::one();
        rows.copy_from_slice(&[
            // ω along the axes of space: the quaternion (0, ω) q / 2, the centre R ω×e₃.
            zero, -radius, -x, w, -z, y, //
            radius, zero, -y, z, w, -x, //
            zero, zero, -z, -y, x, w, //
            // Slip, and the length of the quaternion.
            one, zero, zero, zero, zero, zero, //
            zero, one, zero, zero, zero, zero, //
            zero, zero, q[2], q[3], q[4], q[5],
        ]);
    }

    fn drift<T: Real>(&self, q: &[T], _t: T, drift: &mut [T]) {
        let rate = T::lit(self.table_rate);
        drift[0] = -rate * q[1];
        drift[1] = rate * q[0];
    }
}

/// What is read, before it is checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    body: RigidBody,
    radius: f64,
    #[serde(default)]
    table_rate: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for RollingSphere {
    type Error = LagrangianError;
    fn try_from(sphere: Unchecked) -> Result<Self, LagrangianError> {
        Self::new(sphere.body, sphere.radius)?.on_turntable(sphere.table_rate)
    }
}
