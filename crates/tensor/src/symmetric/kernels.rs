//! Kernels on arrays of rows whose result is symmetric.

use piola_numerics::Real;
use piola_numerics::linear::matrix3::dot;

use super::Symmetric;
use crate::rows::Rows;

/// sym(A Bᵀ).
///
/// # Example
/// ```
/// use piola_tensor::internal::product_symmetrized;
/// let one = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let a = [[1.0, 4.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// assert_eq!(product_symmetrized(a, one).components[3], 3.0);
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn product_symmetrized<T: Real>(a: Rows<T>, b: Rows<T>) -> Symmetric<T> {
    let half = T::lit(0.5);
    Symmetric {
        components: [
            dot(a[0], b[0]),
            dot(a[1], b[1]),
            dot(a[2], b[2]),
            half * (dot(a[0], b[1]) + dot(a[1], b[0])),
            half * (dot(a[1], b[2]) + dot(a[2], b[1])),
            half * (dot(a[0], b[2]) + dot(a[2], b[0])),
        ],
    }
}
