//! Systems given by a Lagrangian and forces.

use piola_numerics::Real;

/// A system with the Lagrangian L(q, v, t) and forces F(q, v, t), written once for any scalar.
///
/// ```text
/// d/dt ∂L/∂v − ∂L/∂q = F
/// ```
///
/// # Example
/// ```
/// use piola_geometric::VariationalSystem;
/// use piola_numerics::Real;
/// /// A spherical pendulum of unit mass, length and gravity, in spherical angles.
/// struct SphericalPendulum;
/// impl VariationalSystem for SphericalPendulum {
///     fn freedom(&self) -> usize {
///         2
///     }
///     fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
///         let (s, c) = q[0].sin_cos();
///         T::lit(0.5) * (v[0] * v[0] + s * s * v[1] * v[1]) + c
///     }
/// }
/// assert_eq!(SphericalPendulum.lagrangian(&[0.0, 0.0], &[2.0, 1.0], 0.0), 3.0);
/// ```
pub trait VariationalSystem {
    /// Whether there are forces beside those of the Lagrangian.
    const FORCED: bool = false;
    /// The number n of coordinates.
    fn freedom(&self) -> usize;
    /// L(q, v, t), J.
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], t: T) -> T;
    /// Writes F(q, v, t), J/\[q\]. It is called only if [`FORCED`](Self::FORCED).
    fn force<T: Real>(&self, _q: &[T], _v: &[T], _t: T, force: &mut [T]) {
        force.fill(T::zero());
    }
}
