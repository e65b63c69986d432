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
//! | energies, momenta, the Jacobi integral | [`Lagrangian::energies`], [`Lagrangian::momenta`], [`Lagrangian::jacobi_integral`] |
//! | the motion in time | [`Lagrangian::integrate`], or a field for any integrator: [`Lagrangian::motion`], [`Lagrangian::canonical_motion`] |
//!
//! Any other regular Lagrangian is given as one function: [`Lagrangian::from_function`].
//!
//! A call computes what it returns and nothing else: accelerations form no Christoffel symbols, a system
//! without potential, applied forces, time dependence or bodies does not pay for them.

mod acceleration;
mod collect;
mod directions;
mod energy;
mod forces;
mod function;
mod metric;
mod motion;
mod potential;
mod run;

pub use acceleration::Workspace;
pub use energy::{Energies, KineticEnergyParts};
pub use forces::{Forces, NoForces};
pub use function::{LagrangianFunction, Negative, NoParts};
pub use motion::{CanonicalMotion, Motion};
pub use piola_kinematics::{Holonomic, Placement};
pub use potential::{NoPotential, Potential};
pub use run::Run;

use crate::DynamicsError;

/// A holonomic system with what acts on it.
///
/// # Example
/// A pendulum of length 2 m, held horizontally: it starts with q̈ = −g/l.
/// ```
/// use nalgebra::Vector3;
/// use piola_dynamics::lagrangian::{Holonomic, Lagrangian, Placement};
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
/// # Ok::<(), piola_dynamics::DynamicsError>(())
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

    /// Uniform gravity, m/s².
    #[must_use]
    pub const fn gravity(&self) -> [f64; 3] {
        self.gravity
    }
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// Checks what the hot paths trust: finite coordinates and gravity, masses 0 ≤ m < ∞.
    ///
    /// # Errors
    /// [`DynamicsError::NonFinite`], [`DynamicsError::InvalidMass`].
    pub fn check(&self, q: &[f64], v: &[f64], t: f64) -> Result<(), DynamicsError> {
        acceleration::check_length("q̇", q.len(), v.len())?;
        acceleration::check_finite("q", q)?;
        acceleration::check_finite("q̇", v)?;
        acceleration::check_finite("t", &[t])?;
        acceleration::check_finite("gravity", &self.gravity)?;
        let mut masses = Masses { part: 0, invalid: None };
        self.system.place(q, t, &mut masses);
        match masses.invalid {
            Some((part, mass)) => Err(DynamicsError::InvalidMass { part, mass }),
            None => Ok(()),
        }
    }
}

struct Masses {
    part: usize,
    invalid: Option<(usize, f64)>,
}

impl Placement<f64> for Masses {
    fn particle(&mut self, mass: f64, _position: nalgebra::Vector3<f64>) {
        if !(0.0 <= mass && mass < f64::INFINITY) && self.invalid.is_none() {
            self.invalid = Some((self.part, mass));
        }
        self.part += 1;
    }
    fn body(
        &mut self,
        _body: &piola_kinematics::RigidBody,
        _centre: nalgebra::Vector3<f64>,
        _attitude: piola_kinematics::Attitude<f64>,
    ) {
        self.part += 1; // validated when it was made
    }
}
