//! Any regular Lagrangian, given as one function L(q, q̇, t).

use piola_kinematics::{Holonomic, Placement};
use piola_numerics::Real;

use super::{Lagrangian, NoForces, Potential};

/// A Lagrangian L(q, q̇, t), written once for any scalar.
///
/// ```text
/// d/dt(∂L/∂q̇^Δ) − ∂L/∂q^Δ = Q_Δ                                                        W(7.3)
/// ```
///
/// It is regular where the Hessian ∂²L/∂q̇∂q̇ is; there the accelerations exist.
///
/// # Example
/// A relativistic particle of unit mass and unit speed of light, falling in a uniform field: its momentum
/// v/√(1 − v²) grows at the rate of the force.
/// ```
/// use piola_lagrangian::{Lagrangian, LagrangianFunction};
/// use piola_numerics::Real;
/// struct Relativistic;
/// impl LagrangianFunction for Relativistic {
///     fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
///         -(T::one() - v[0] * v[0]).sqrt() + q[0]
///     }
/// }
/// let particle = Lagrangian::from_function(Relativistic);
/// let speed = 0.6_f64;
/// let acceleration = particle.acceleration(&[0.0], &[speed], 0.0)?;
/// // dp/dv = (1 − v²)^(−3/2), so v̇ = (1 − v²)^(3/2) = 0.512.
/// assert!((acceleration[0] - 0.512).abs() < 1e-15);
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
pub trait LagrangianFunction {
    /// L(q, q̇, t), J.
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], t: T) -> T;
}

/// A system without parts: its mechanics is all in its Lagrangian function.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoParts;

impl Holonomic for NoParts {
    fn place<T: Real>(&self, _q: &[T], _t: T, _bodies: &mut impl Placement<T>) {}
}

/// The generalised potential −L of a Lagrangian function.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Negative<L>(L);

impl<L: LagrangianFunction> Potential for Negative<L> {
    const VELOCITY_DEPENDENT: bool = true;
    fn potential<T: Real>(&self, q: &[T], v: &[T], t: T) -> T {
        -self.0.lagrangian(q, v, t)
    }
}

impl<L: LagrangianFunction> Lagrangian<NoParts, Negative<L>> {
    /// A system given by its Lagrangian function alone.
    ///
    /// It has accelerations, momenta, the Jacobi integral, a Hamiltonian, driving forces, an action, motions in (q, q̇),
    /// in (q, p) and in quasi-velocities, small motions and constraints. Its energies are counted as potential, V = −L.
    ///
    /// It has no parts, and nothing that is said of parts:
    ///
    /// | call | returns |
    /// |---|---|
    /// | [`reactions`](Lagrangian::reactions) | no reactions |
    /// | [`system_momentum`](Lagrangian::system_momentum), kinetic energy | zero |
    /// | [`with_gravity`](Lagrangian::with_gravity), forces on parts | no effect: nothing is there to pull |
    /// | [`inertia_metric`](Lagrangian::inertia_metric), that of [`InFrame`](crate::anholonomic::InFrame), Christoffel symbols | [`LagrangianError::NoParts`](crate::LagrangianError::NoParts) |
    /// | [`equations_into`](Lagrangian::equations_into) | the mass matrix ∂²L/∂q̇∂q̇, which stands for the metric |
    ///
    /// [`geodesic`](Lagrangian::geodesic) refuses every direction: none has a length.
    pub const fn from_function(function: L) -> Self {
        Self { system: NoParts, gravity: [0.0; 3], potential: Negative(function), forces: NoForces }
    }
}
