//! Kernels of rates on arrays of rows.

use piola_numerics::Real;
use piola_tensor::internal::rows::{Rows, product};

use crate::Symmetric;

/// A S + S Aᵀ for a symmetric S: the rate of S carried by a flow or a spin A.
///
/// # Example
/// ```
/// use piola_continuum::{Symmetric, internal::rates::transported};
/// let shear = [[0.0, 2.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
/// let carried = transported(shear, &Symmetric::diagonal([0.0, 3.0, 0.0]));
/// assert_eq!(carried.components, [0.0, 0.0, 0.0, 6.0, 0.0, 0.0]);
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn transported<T: Real>(a: Rows<T>, s: &Symmetric<T>) -> Symmetric<T> {
    Symmetric::sum_with_transpose(product(a, s.rows()))
}
