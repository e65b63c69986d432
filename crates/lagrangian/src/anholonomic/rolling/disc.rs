//! A disc, hoop or coin that rolls on its sharp edge.

use nalgebra::Vector3;
use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_numerics::Real;

use super::{OnPlane, check_length};
use crate::LagrangianError;
use crate::anholonomic::{AnholonomicFrame, Nonholonomic};
use crate::{Holonomic, Lagrangian, Placement};

/// A thin disc of radius R that rolls on the plane z = 0.
///
/// ```text
/// n = f₃,   e_θ = ∂n/∂θ² (down the disc's steepest line),   e_ν = −sin θ¹ e₁ + cos θ¹ e₂ (along the track)
/// centre = contact − R e_θ,        ẋ = R θ̇³ sin θ¹,   ẏ = −R θ̇³ cos θ¹
/// ```
///
/// q = (x, y, θ¹, θ², θ³): the point of contact and the Eulerian angles z–y–z of the disc, whose axis is f₃:
/// θ² is the angle between axis and vertical, π/2 for an upright disc. The quasi-velocities are θ̇¹, θ̇², θ̇³ and
/// the velocity of the disc's material point in contact, along e_ν and along n's horizontal direction
/// cos θ¹ e₁ + sin θ¹ e₂; the last two are held at zero. Their reactions are the components of friction, N.
///
/// Any body may be the disc whose centre of mass is the centre of its rim. Flat on the plane (θ² = 0, π) the
/// motion has no inertia in θ¹ + θ³, and no single point of contact: [`LagrangianError::SingularMetric`].
///
/// # Example
/// An upright disc that rolls straight on carries its weight and needs no friction.
/// ```
/// use piola_lagrangian::anholonomic::rolling::RollingDisc;
/// let disc = RollingDisc::homogeneous(2.0, 0.5)?.on_plane([0.0, 0.0, -10.0]);
/// let (q, w) = ([0.0, 0.0, 0.0, std::f64::consts::FRAC_PI_2, 0.0], [0.0, 0.0, -6.0]);
/// assert_eq!(disc.velocities(&q, &w, 0.0)?[1], 3.0); // −R θ̇³ along y
/// let contact = disc.part_reactions(&q, &w, 0.0)?[0];
/// assert!((contact.force().z - 20.0).abs() < 1e-14);
/// assert!(disc.reactions(&q, &w, 0.0)?.amax() < 1e-14);
/// // Inclined, it goes round evenly if it spins as fast as this.
/// let spin = RollingDisc::homogeneous(2.0, 0.5)?.steady_spin(1.0, 3.0, 10.0)?;
/// assert!(disc.acceleration(&[0.0, 0.0, 0.0, 1.0, 0.0], &[3.0, 0.0, spin], 0.0)?.amax() < 1e-13);
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Unchecked"))]
pub struct RollingDisc {
    body: RigidBody,
    radius: f64,
}

impl RollingDisc {
    /// The quasi-velocities that are held: slip along and across the track.
    pub const HELD: [usize; 2] = [3, 4];

    /// A body with a rim of the given radius (m) about its third axis.
    ///
    /// # Errors
    /// [`AnholonomicError::InvalidLength`](crate::AnholonomicError::InvalidLength).
    pub fn new(body: RigidBody, radius: f64) -> Result<Self, LagrangianError> {
        Ok(Self { body, radius: check_length("radius", radius)? })
    }

    /// A homogeneous disc: I = M R²/4 (1, 1, 2).
    ///
    /// # Errors
    /// [`AnholonomicError::InvalidLength`](crate::AnholonomicError::InvalidLength); [`LagrangianError::Kinematics`] for a mass that is not positive.
    pub fn homogeneous(mass: f64, radius: f64) -> Result<Self, LagrangianError> {
        let moment = 0.25 * mass * check_length("radius", radius)?.powi(2);
        Self::new(RigidBody::new(mass, Inertia::principal([moment, moment, 2.0 * moment])?)?, radius)
    }

    /// A hoop: I = M R²/2 (1, 1, 2).
    ///
    /// # Errors
    /// As [`homogeneous`](Self::homogeneous).
    pub fn hoop(mass: f64, radius: f64) -> Result<Self, LagrangianError> {
        let moment = 0.5 * mass * check_length("radius", radius)?.powi(2);
        Self::new(RigidBody::new(mass, Inertia::principal([moment, moment, 2.0 * moment])?)?, radius)
    }

    /// The disc on its plane under uniform gravity (m/s², any direction).
    #[must_use]
    pub fn on_plane(self, gravity: [f64; 3]) -> OnPlane<Self> {
        let free = Lagrangian::of(self).with_uniform_gravity(gravity).in_frame(self);
        Nonholonomic::at_rest(free, &Self::HELD)
    }

    /// The body.
    #[must_use]
    pub const fn body(&self) -> &RigidBody {
        &self.body
    }

    /// The radius, m.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// The spin θ̇³ with which the disc turns steadily on a level plane: its inclination θ² and its rate of turn
    /// θ̇¹ = Ω stay, and the contact runs on a circle of radius R |θ̇³/Ω|.
    ///
    /// ```text
    /// (C + M R²) Ω sin θ² (θ̇³ + Ω cos θ²) = A Ω² sin θ² cos θ² − M g R cos θ²,   A = I₁₁ = I₂₂,  C = I₃₃
    /// ```
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | θ² | `inclination` | rad |
    /// | Ω | `turn` | rad/s |
    /// | g | `gravity` | m/s² |
    /// | θ̇³ | returned | rad/s |
    ///
    /// Euler's equation of the moment about e_ν; it holds for bodies that are symmetric about their axis. With
    /// Ω → 0 there is no such motion but the upright one.
    ///
    /// # Errors
    /// [`LagrangianError::NotFinite`] for Ω sin θ² = 0.
    pub fn steady_spin(&self, inclination: f64, turn: f64, gravity: f64) -> Result<f64, LagrangianError> {
        let (s, c) = inclination.sin_cos();
        let (inertia, mass, radius) = (self.body.inertia().matrix(), self.body.mass(), self.radius);
        let moment = inertia[(0, 0)] * turn * turn * s * c - mass * gravity * radius * c;
        let spin = moment / ((inertia[(2, 2)] + mass * radius * radius) * turn * s) - turn * c;
        crate::check::check_finite("steady spin", &[spin])?;
        Ok(spin)
    }
}

impl Holonomic for RollingDisc {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let ((s1, c1), (s2, c2), radius) = (q[2].sin_cos(), q[3].sin_cos(), T::lit(self.radius));
        let centre = Vector3::new(q[0] - radius * c2 * c1, q[1] - radius * c2 * s1, radius * s2);
        bodies.body(&self.body, centre, Attitude::from_euler_zyz([q[2], q[3], q[4]]));
    }
}

impl AnholonomicFrame for RollingDisc {
    fn frame<T: Real>(&self, q: &[T], _t: T, rows: &mut [T]) {
        let ((s, c), radius) = (q[2].sin_cos(), T::lit(self.radius));
        let (zero, one) = (T::zero(), T::one());
        rows.copy_from_slice(&[
            zero,
            zero,
            one,
            zero,
            zero, //
            zero,
            zero,
            zero,
            one,
            zero, //
            radius * s,
            -radius * c,
            zero,
            zero,
            one, //
            -s,
            c,
            zero,
            zero,
            zero, //
            c,
            s,
            zero,
            zero,
            zero,
        ]);
    }
}

/// What is read, before it is checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    body: RigidBody,
    radius: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for RollingDisc {
    type Error = LagrangianError;
    fn try_from(disc: Unchecked) -> Result<Self, LagrangianError> {
        Self::new(disc.body, disc.radius)
    }
}
