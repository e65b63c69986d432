//! Potentials V(q, t) and generalised, velocity-dependent potentials V(q, q̇, t).

use piola_numerics::Real;

/// A potential, written once for any scalar.
///
/// ```text
/// Q_Δ = d/dt(∂V/∂q̇^Δ) − ∂V/∂q^Δ                                                       W(7.2)
/// ```
///
/// # Example
/// ```
/// use piola_lagrangian::Potential;
/// use piola_numerics::Real;
/// /// A spring of stiffness k (N/m) on the first coordinate.
/// struct Spring { stiffness: f64 }
/// impl Potential for Spring {
///     fn potential<T: Real>(&self, q: &[T], _v: &[T], _t: T) -> T {
///         T::lit(0.5 * self.stiffness) * q[0] * q[0]
///     }
/// }
/// assert_eq!(Spring { stiffness: 3.0 }.potential(&[2.0], &[0.0], 0.0), 6.0);
/// ```
pub trait Potential {
    /// Whether V depends on the velocities. One that does not is never differentiated with respect to them.
    const VELOCITY_DEPENDENT: bool = false;
    /// Whether a velocity-dependent V is of first degree in the velocities at most, as that of a charge in a
    /// magnetic field: then it adds nothing to the mass matrix, and its second derivatives with respect to the
    /// velocities are not formed. [`check`](super::Lagrangian::check) finds out what is declared wrongly.
    const LINEAR_IN_VELOCITIES: bool = false;
    /// Whether there is a potential at all.
    const PRESENT: bool = true;
    /// V(q, q̇, t), J. `v` is empty unless the potential declares itself velocity-dependent.
    fn potential<T: Real>(&self, q: &[T], v: &[T], t: T) -> T;
}

/// No potential: costs nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoPotential;

impl Potential for NoPotential {
    const PRESENT: bool = false;
    fn potential<T: Real>(&self, _q: &[T], _v: &[T], _t: T) -> T {
        T::zero()
    }
}
