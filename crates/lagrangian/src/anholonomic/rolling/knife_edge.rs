//! A body on ice that rests on a blade: the knife edge, Chaplygin's sleigh.

use nalgebra::Vector3;
use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_numerics::Real;

use super::OnPlane;
use crate::LagrangianError;
use crate::anholonomic::{AnholonomicFrame, Nonholonomic};
use crate::check::check_finite;
use crate::{Holonomic, Lagrangian, Placement};

/// A body that slides on the plane z = 0 and touches it by a blade, which moves only along itself.
///
/// ```text
/// ẋ sin φ = ẏ cos φ
/// ```
///
/// q = (x, y, φ): the blade's point and angle; the centre of mass is a distance `ahead` (m, any sign) along the
/// blade. The quasi-velocities are the speed along the blade, that across it, which is held at zero, and φ̇; the
/// reaction is the force across the blade, N.
///
/// # Example
/// With the centre of mass ahead by a, the speed grows by a φ̇² and the turning dies away.
/// ```
/// use piola_lagrangian::anholonomic::rolling::KnifeEdge;
/// let sleigh = KnifeEdge::new(2.0, 0.5, 0.5)?.on_plane([0.0, 0.0, -10.0]);
/// let rates = sleigh.acceleration(&[0.0; 3], &[1.5, 2.0], 0.0)?;
/// // v̇ = a φ̇²,   φ̈ = −M a v φ̇ / (J + M a²)
/// assert_eq!(rates.as_slice(), [2.0, -3.0]);
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Unchecked"))]
pub struct KnifeEdge {
    body: RigidBody,
    ahead: f64,
}

impl KnifeEdge {
    /// The quasi-velocity that is held: the speed across the blade.
    pub const HELD: [usize; 1] = [1];

    /// A body of the given mass (kg) and moment of inertia about the vertical through its centre of mass
    /// (kg m²), which is `ahead` of the blade (m).
    ///
    /// # Errors
    /// [`LagrangianError::Kinematics`] for mass or moment that are not positive, [`LagrangianError::NotFinite`].
    pub fn new(mass: f64, moment: f64, ahead: f64) -> Result<Self, LagrangianError> {
        // Only the moment about the vertical plays a role.
        Self::of_body(RigidBody::new(mass, Inertia::principal([moment; 3])?)?, ahead)
    }

    /// A body whose third axis is vertical.
    ///
    /// # Errors
    /// [`LagrangianError::NotFinite`].
    pub fn of_body(body: RigidBody, ahead: f64) -> Result<Self, LagrangianError> {
        check_finite("distance of the centre of mass", &[ahead])?;
        Ok(Self { body, ahead })
    }

    /// The body on its plane under uniform gravity (m/s², any direction).
    #[must_use]
    pub fn on_plane(self, gravity: [f64; 3]) -> OnPlane<Self> {
        let free = Lagrangian::of(self).with_uniform_gravity(gravity).in_frame(self);
        Nonholonomic::at_rest(free, &Self::HELD)
    }
}

impl Holonomic for KnifeEdge {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let ((s, c), ahead) = (q[2].sin_cos(), T::lit(self.ahead));
        let centre = Vector3::new(q[0] + ahead * c, q[1] + ahead * s, T::zero());
        bodies.body(&self.body, centre, Attitude::about_z(q[2]));
    }
}

impl AnholonomicFrame for KnifeEdge {
    fn frame<T: Real>(&self, q: &[T], _t: T, rows: &mut [T]) {
        let ((s, c), zero) = (q[2].sin_cos(), T::zero());
        rows.copy_from_slice(&[c, s, zero, -s, c, zero, zero, zero, T::one()]);
    }
}

/// What is read, before it is checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    body: RigidBody,
    ahead: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for KnifeEdge {
    type Error = LagrangianError;
    fn try_from(edge: Unchecked) -> Result<Self, LagrangianError> {
        Self::of_body(edge.body, edge.ahead)
    }
}
