//! Initial manifolds of m − 1 parameters, written once for any scalar.

use piola_numerics::Real;

/// What a manifold knows of ξ = ∇u on itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Covector {
    /// Nothing: ξ is completed from the guess of the problem, and along the manifold from that of the neighbour.
    Sought,
    /// A guess at each point, from which ξ is completed.
    Guessed,
    /// ξ itself, which is checked.
    Given,
}

/// Initial data: a manifold x(τ) of m − 1 parameters with the values u(τ) on it, and ξ(τ) if it is known.
///
/// ```text
/// x = x(τ),  u = u(τ),  ξ = ξ(τ)        u_τ = ξ·x_τ,  Φ(x, u, ξ) = 0                    W(A.39), W(A.40)
/// ```
///
/// | symbol | argument | shape |
/// |---|---|---|
/// | τ | `tau` | m − 1 |
/// | x | `x` | m, written |
/// | u | returned by `place` | scalar |
/// | ξ | `xi` | m, written by `covector` unless [`COVECTOR`](Self::COVECTOR) is [`Covector::Sought`] |
///
/// # Example
/// See [`CauchyProblem`](crate::CauchyProblem).
///
/// # Source
/// W(A.21), W(A.39).
pub trait InitialManifold {
    /// What [`covector`](Self::covector) writes.
    const COVECTOR: Covector = Covector::Sought;
    /// Writes x(τ) and returns u(τ).
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T;
    /// Writes ξ(τ), or a guess of it.
    fn covector<T: Real>(&self, _tau: &[T], _xi: &mut [T]) {}
}

impl<M: InitialManifold> InitialManifold for &M {
    const COVECTOR: Covector = M::COVECTOR;
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        (**self).place(tau, x)
    }
    fn covector<T: Real>(&self, tau: &[T], xi: &mut [T]) {
        (**self).covector(tau, xi);
    }
}
