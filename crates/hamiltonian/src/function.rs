//! Functions on phase space: Hamiltonians, momenta, candidates for integrals.

use piola_numerics::Real;

/// A function K(q, p, t) on phase space, written once for any scalar; a Hamiltonian is one.
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | q | `q` | n | \[q\] |
/// | p | `p` | n | J s/\[q\] |
/// | t | `t` | scalar | s |
///
/// # Example
/// ```
/// use piola_hamiltonian::PhaseFunction;
/// use piola_numerics::Real;
/// /// H = (p² + q²)/2.
/// struct Oscillator;
/// impl PhaseFunction for Oscillator {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * (p[0] * p[0] + q[0] * q[0])
///     }
/// }
/// assert_eq!(Oscillator.value(&[3.0], &[4.0], 0.0), 12.5);
/// ```
///
/// # Source
/// W(9.7), W(9.20).
pub trait PhaseFunction {
    /// K(q, p, t).
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T;
}

impl<K: PhaseFunction> PhaseFunction for &K {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        (**self).value(q, p, t)
    }
}
