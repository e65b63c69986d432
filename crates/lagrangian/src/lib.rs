//! Lagrange's equations of a holonomic system, from its placement map alone.
//!
//! ```text
//! L = E − V,   E = ½ g_ΔΓ q̇^Δ q̇^Γ + …            W(3.16), W(7.3)
//! d/dt(∂E/∂q̇^Δ) − ∂E/∂q^Δ = Q_Δ                    W(5.31)
//! ```
//!
//! A system says where its particles and bodies are ([`Holonomic`]); it may add a [`Potential`], uniform
//! gravity and applied [`Forces`]. Everything else follows by exact differentiation:
//!
//! | to get | call |
//! |---|---|
//! | q̈ | [`Lagrangian::acceleration`] |
//! | the inertia metric, Christoffel symbols | [`Lagrangian::inertia_metric`], [`Lagrangian::christoffel_first`], [`Lagrangian::christoffel_second`] |
//! | covariant acceleration, raised and lowered indices, geodesics | [`Lagrangian::covariant_acceleration`], [`Lagrangian::raise`], [`Lagrangian::lower`], [`Lagrangian::geodesic`] |
//! | energies, momenta, the Jacobi integral | [`Lagrangian::energies`], [`Lagrangian::momenta`], [`Lagrangian::jacobi_integral`] |
//! | the inverse Legendre map, with a certificate (residual, conditioning) | [`Lagrangian::velocities_into`], [`Lagrangian::legendre_certificate`] |
//! | the motion in time | [`Lagrangian::integrate`], or a field for any integrator: [`Lagrangian::motion`], [`Lagrangian::canonical_motion`] |
//! | the force and moment by which a constraint holds each part | [`Lagrangian::reactions`] |
//! | whether a constraint is ideal; the virtual work of any forces | [`Lagrangian::ideal_constraint_test`], [`Lagrangian::virtual_work`] |
//! | where power and energy come from, of drives and actuators too | [`Lagrangian::power_balance`], [`Lagrangian::actuator_powers_into`], [`Lagrangian::work_account`] |
//! | the forces that a prescribed motion needs | [`Lagrangian::driving_forces`] |
//! | momentum and angular momentum in space | [`Lagrangian::system_momentum`] |
//! | the action and its variation; Hamilton's principle on samples | [`Lagrangian::action`], [`Lagrangian::first_variation`], [`Lagrangian::stationarity_of_samples`] |
//! | the same system in other coordinates | [`Lagrangian::in_coordinates`] |
//!
//! Any other regular Lagrangian is given as one function: [`Lagrangian::from_function`].
//!
//! A call computes what it returns and nothing else: accelerations form no Christoffel symbols, a system
//! without potential, applied forces, time dependence or bodies does not pay for them.
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![expect(clippy::doc_markdown, reason = "symbols with indices, as g_ΔΓ, are not code")]
#![expect(clippy::needless_range_loop, reason = "the indices are those of the equations")]

mod acceleration;
mod action;
pub mod anholonomic;
mod change_of_coordinates;
mod check;
mod chunks;
mod collect;
mod conditioning;
pub mod constraints;
mod directions;
mod driving_forces;
mod energy;
mod error;
mod forces;
mod function;
mod geodesic;
mod hamilton_principle;
mod hamiltonian;
mod integrate;
mod legendre;
mod legendre_certificate;
mod metric;
mod momentum;
mod motion;
pub mod newton_euler;
mod parts;
mod potential;
mod power;
mod quadrature;
mod reactions;
mod record;
pub mod rigid_motion;
mod run;
pub mod small_motions;
mod virtual_work;
mod work;
mod workspace;
#[cfg(feature = "serde")]
mod written;

pub use crate::run::Run;
pub use action::{Action, FirstVariation, Path, Varied};
pub use change_of_coordinates::{ChangeOfCoordinates, InCoordinates};
pub use energy::{Energies, KineticEnergyParts};
pub use error::{AnholonomicError, ConstraintError, LagrangianError, SmallMotionsError};
pub use forces::{Forces, NoForces};
pub use function::{LagrangianFunction, Negative, NoParts};
pub use geodesic::{GeodesicEnd, GeodesicMotion};
pub use hamilton_principle::{SampledMotion, StationarityResidual};
pub use legendre_certificate::LegendreCertificate;
pub use momentum::SystemMomentum;
pub use motion::{CanonicalMotion, Motion};
pub use piola_kinematics::{Holonomic, Placement, SingularPosition};
pub use potential::{NoPotential, Potential};
pub use power::{ForceAlongTime, PartPower, PowerBalance};
pub use reactions::{PartForce, Reaction};
pub use virtual_work::{ConstraintVerdict, IdealConstraintTest};
pub use work::{MotionWithWork, WorkAccount, Works};
pub use workspace::Workspace;

use nalgebra::Vector3;
use piola_kinematics::{Attitude, RigidBody};
use piola_numerics::{Mask, Real};

use crate::check::{check_finite, check_length};

/// A holonomic system with what acts on it.
///
/// # Example
/// A pendulum of length 2 m, held horizontally: it starts with q̈ = −g/l.
/// ```
/// use nalgebra::Vector3;
/// use piola_integrators::Tolerance;
/// use piola_lagrangian::{Holonomic, Lagrangian, Placement, Workspace};
/// use piola_numerics::Real;
///
/// struct Pendulum { mass: f64, length: f64 }
///
/// impl Holonomic for Pendulum {
///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
///         let (s, c) = q[0].sin_cos();
///         let length = T::lit(self.length);
///         bodies.particle(self.mass, Vector3::new(length * s, T::zero(), -length * c));
///     }
/// }
///
/// let pendulum = Lagrangian::of(Pendulum { mass: 3.0, length: 2.0 }).with_gravity(10.0);
/// let horizontal = std::f64::consts::FRAC_PI_2;
/// let acceleration = pendulum.acceleration(&[horizontal], &[0.0], 0.0)?;
/// assert!((acceleration[0] + 5.0).abs() < 1e-15);
/// // M q̈ = f with m l² and −m g l; a motor that raises it with 1 rad/s² gives m l² q̈ + m g l.
/// let (mut mass_matrix, mut forcing) = ([0.0], [0.0]);
/// let mut work = Workspace::default();
/// pendulum.equations_into(&mut work, &[horizontal], &[0.0], 0.0, &mut mass_matrix, &mut forcing)?;
/// assert_eq!((mass_matrix, forcing), ([12.0], [-60.0]));
/// assert_eq!(pendulum.driving_forces(&[horizontal], &[0.0], &[1.0], 0.0)?[0], 72.0);
/// // Hanging, with 2 rad/s: momentum m l q̇ along x and angular momentum −m l² q̇ about y.
/// let sums = pendulum.system_momentum(&[0.0], &[2.0], 0.0, &Vector3::zeros())?;
/// assert_eq!((sums.momentum.x, sums.angular_momentum.y), (12.0, -24.0));
///
/// let run = pendulum.integrate(&[1.0], &[0.0], 0.0..60.0, Tolerance::relative(1e-10)?)?;
/// assert!(run.energy_drift() < 1e-8 && run.error_estimate() < 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Lagrangian<S, P = NoPotential, F = NoForces> {
    system: S,
    gravity: [f64; 3],
    potential: P,
    forces: F,
}

impl<S: Holonomic> Lagrangian<S> {
    /// A system on which nothing acts.
    pub const fn of(system: S) -> Self {
        Self { system, gravity: [0.0; 3], potential: NoPotential, forces: NoForces }
    }
}

impl<S, P, F> Lagrangian<S, P, F> {
    /// Uniform gravity of the given strength (m/s²) along −z of the space basis.
    #[must_use]
    pub fn with_gravity(self, strength: f64) -> Self {
        self.with_uniform_gravity([0.0, 0.0, -strength])
    }

    /// Uniform gravity g (m/s², space components).
    #[must_use]
    pub fn with_uniform_gravity(mut self, gravity: [f64; 3]) -> Self {
        self.gravity = gravity;
        self
    }

    /// Replaces the potential.
    pub fn with_potential<V: Potential>(self, potential: V) -> Lagrangian<S, V, F> {
        Lagrangian { system: self.system, gravity: self.gravity, potential, forces: self.forces }
    }

    /// Replaces the applied forces.
    pub fn with_forces<G: Forces>(self, forces: G) -> Lagrangian<S, P, G> {
        Lagrangian { system: self.system, gravity: self.gravity, potential: self.potential, forces }
    }

    /// The system.
    pub const fn system(&self) -> &S {
        &self.system
    }

    /// The potential.
    pub const fn potential(&self) -> &P {
        &self.potential
    }

    /// The applied forces.
    pub const fn forces(&self) -> &F {
        &self.forces
    }

    /// Uniform gravity, m/s².
    #[must_use]
    pub const fn gravity(&self) -> [f64; 3] {
        self.gravity
    }
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// Checks what evaluations trust: finite coordinates, time and gravity, masses 0 ≤ m < ∞, parts that are
    /// somewhere, attitudes of length one, that a placement without declared time dependence has none, and that a
    /// potential declared linear in the velocities is.
    ///
    /// [`integrate`](Self::integrate) calls it; call it once yourself before many evaluations.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`], [`LagrangianError::InvalidMass`],
    /// [`LagrangianError::AttitudeNotUnit`], [`LagrangianError::UndeclaredTimeDependence`],
    /// [`LagrangianError::NonlinearPotential`].
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Placement};
    /// # use piola_numerics::Real;
    /// struct Lift; // its floor rises with 2 m/s
    /// impl Holonomic for Lift {
    ///     fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
    ///         bodies.particle(1.0, Vector3::new(q[0], T::zero(), T::lit(2.0) * t));
    ///     }
    /// }
    /// let refused = Lagrangian::of(Lift).check(&[0.0], &[0.0], 0.0).unwrap_err();
    /// assert_eq!(
    ///     refused.to_string(),
    ///     "the placement of part 0 depends on time: declare `const TIME_DEPENDENT: bool = true`"
    /// );
    /// ```
    pub fn check(&self, q: &[f64], v: &[f64], t: f64) -> Result<(), LagrangianError> {
        check_length("q̇", q.len(), v.len())?;
        self.check_given([("q", q), ("q̇", v)], t)?;
        if !S::TIME_DEPENDENT {
            // Time that is not a number leaves no trace where it is not used.
            let mut parts = Parts { part: 0, complaint: None };
            self.system.place(q, f64::NAN, &mut parts);
            if let Some(LagrangianError::PartNowhere { part } | LagrangianError::AttitudeNotUnit { part, .. }) =
                parts.complaint
            {
                return Err(LagrangianError::UndeclaredTimeDependence { part });
            }
        }
        if P::VELOCITY_DEPENDENT
            && P::LINEAR_IN_VELOCITIES
            && !self.is_linear_in_velocities(&mut Workspace::default(), q, v, t)
        {
            return Err(LagrangianError::NonlinearPotential);
        }
        Ok(())
    }

    /// Refuses a result that is not finite, by the name of what is not finite of the state it comes from.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn finite<T: Real>(
        &self,
        state: [(&'static str, &[T]); 2],
        t: T,
        result: (&'static str, &[T]),
    ) -> Result<(), LagrangianError> {
        let all = result.1.iter().fold(T::Mask::splat(true), |all, x| all & x.is_finite());
        if all.all() { Ok(()) } else { Err(self.explain_non_finite(state, t, result)) }
    }

    /// The first thing wrong with coordinates, velocities or momenta, time, gravity or parts. The first list
    /// given is that of the coordinates.
    fn check_given<T: Real>(&self, state: [(&'static str, &[T]); 2], t: T) -> Result<(), LagrangianError> {
        for (quantity, values) in state {
            check_finite(quantity, values)?;
        }
        check_finite("t", &[t])?;
        check_finite("gravity", &self.gravity)?;
        for lane in 0..T::LANES {
            let q: Vec<f64> = state[0].1.iter().map(|q| q.primal(lane)).collect();
            let mut parts = Parts { part: 0, complaint: None };
            self.system.place(&q, t.primal(lane), &mut parts);
            if let Some(complaint) = parts.complaint {
                return Err(complaint);
            }
        }
        Ok(())
    }
}

/// How far the squared length of an attitude may be from one.
const UNIT_TO: f64 = 1e-6; // an attitude computed in f32 passes

/// The first thing that is wrong with a part.
struct Parts {
    part: usize,
    complaint: Option<LagrangianError>,
}

impl Parts {
    fn next(&mut self, complaint: Option<LagrangianError>) {
        if self.complaint.is_none() {
            self.complaint = complaint;
        }
        self.part += 1;
    }

    fn nowhere(&self, position: Vector3<f64>) -> Option<LagrangianError> {
        let somewhere = position.iter().all(|x| x.is_finite());
        (!somewhere).then_some(LagrangianError::PartNowhere { part: self.part })
    }
}

impl Placement<f64> for Parts {
    fn particle(&mut self, mass: f64, position: Vector3<f64>) {
        let part = self.part;
        let weightless = !(0.0 <= mass && mass < f64::INFINITY);
        let complaint = weightless.then_some(LagrangianError::InvalidMass { part, mass });
        self.next(complaint.or(self.nowhere(position)));
    }
    fn body(&mut self, _body: &RigidBody, centre: Vector3<f64>, attitude: Attitude<f64>) {
        let squared_length = attitude.squared_length();
        let unit = (squared_length - 1.0).abs() <= UNIT_TO;
        let complaint = (!unit).then_some(LagrangianError::AttitudeNotUnit { part: self.part, squared_length });
        self.next(self.nowhere(centre).or(complaint));
    }
}

/// For the other crates of Piola alone: no part of the interface.
#[doc(hidden)]
pub mod internal {
    pub use crate::quadrature::integrate;
    #[cfg(feature = "serde")]
    pub use crate::written::matrix;
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;
