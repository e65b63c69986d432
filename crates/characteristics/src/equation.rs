//! The equation Φ(x, u, ξ) = 0, written once for any scalar.

use piola_numerics::Real;

/// A first-order partial differential equation in m variables.
///
/// ```text
/// Φ(x, u, ξ) = 0,    ξᵢ = ∂u/∂xⁱ                                                        W(A.34)
/// ```
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | x | `x` | m | \[x\] |
/// | u | `u` | scalar | \[u\] |
/// | ξ | `xi` | m | \[u\]/\[x\] |
///
/// An equation of evolution takes the time as its first variable, x = (t, q) and ξ = (∂u/∂t, ∂u/∂q); with
/// Φ = ∂u/∂t + …, the parameter of the characteristics is the time.
///
/// # Example
/// See [`CauchyProblem`](crate::CauchyProblem).
///
/// # Source
/// W(A.1), W(A.34).
pub trait FirstOrderPde {
    /// Whether Φ = a(x, u)·ξ − b(x, u).
    ///
    /// Set it to true for such an equation: the characteristics x′ = a, u′ = b then need no ξ, and are followed through
    /// the places where ξ becomes infinite, as where a wave breaks. Undeclared, they stop there with
    /// [`CharacteristicsError::UndeclaredQuasilinear`](crate::CharacteristicsError::UndeclaredQuasilinear). A false
    /// declaration is refused with [`StripError::NotQuasilinear`](crate::StripError::NotQuasilinear).
    const QUASILINEAR: bool = false;
    /// Φ(x, u, ξ).
    fn value<T: Real>(&self, x: &[T], u: T, xi: &[T]) -> T;
}

impl<P: FirstOrderPde> FirstOrderPde for &P {
    const QUASILINEAR: bool = P::QUASILINEAR;
    fn value<T: Real>(&self, x: &[T], u: T, xi: &[T]) -> T {
        (**self).value(x, u, xi)
    }
}
