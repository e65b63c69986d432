//! How long steps should be, relative to one another.

use piola_numerics::Real;

/// A relative step length σ(q), positive, written once for any scalar: its derivative along the motion is exact.
///
/// For attracting bodies take the time scale of the nearest pair, |q|^(3/2); for a spring of changing stiffness, its period.
///
/// # Example
/// ```
/// use piola_geometric::StepLength;
/// use piola_numerics::{Dual, Real};
/// struct Square; // σ = q²
/// impl StepLength for Square {
///     fn length<T: Real>(&self, q: &[T]) -> T {
///         q[0] * q[0]
///     }
/// }
/// let along = Square.length(&[Dual::new(3.0, 0.5)]); // q = 3, q̇ = ½
/// assert_eq!((along.value, along.tangent), (9.0, 3.0)); // σ̇ = 2 q q̇
/// ```
#[doc(alias("monitor function", "time transformation", "Sundman"))]
pub trait StepLength {
    /// σ(q).
    fn length<T: Real>(&self, q: &[T]) -> T;
}
