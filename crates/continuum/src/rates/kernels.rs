//! Kernels of rates on arrays of rows.

use piola_numerics::Real;

use crate::Symmetric;
use crate::tensor::rows::{Rows, product};

/// The skew tensor Ω of an axial vector ω: Ω v = ω × v.
///
/// # Example
/// ```
/// use piola_continuum::rates::kernels::skew_of_axial;
/// assert_eq!(skew_of_axial([0.0, 0.0, 2.0])[1][0], 2.0); // turning about z takes x to y
/// ```
#[inline(always)]
#[must_use]
pub fn skew_of_axial<T: Real>(w: [T; 3]) -> Rows<T> {
    let o = T::zero();
    [[o, -w[2], w[1]], [w[2], o, -w[0]], [-w[1], w[0], o]]
}

/// The axial vector of A − Aᵀ, twice that of the skew part.
///
/// # Example
/// ```
/// use piola_continuum::rates::kernels::axial_of_difference;
/// assert_eq!(axial_of_difference([[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, 0.0]]), [0.0, 0.0, 3.0]);
/// ```
#[inline(always)]
#[must_use]
pub fn axial_of_difference<T: Real>(a: Rows<T>) -> [T; 3] {
    [a[2][1] - a[1][2], a[0][2] - a[2][0], a[1][0] - a[0][1]]
}

/// A + Aᵀ.
///
/// # Example
/// ```
/// use piola_continuum::rates::kernels::doubled_symmetric_part;
/// let a = [[1.0, 2.0, 0.0], [4.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
/// assert_eq!(doubled_symmetric_part(a).components, [2.0, 0.0, 0.0, 6.0, 0.0, 0.0]);
/// ```
#[inline(always)]
#[must_use]
pub fn doubled_symmetric_part<T: Real>(a: Rows<T>) -> Symmetric<T> {
    Symmetric {
        components: [
            a[0][0] + a[0][0],
            a[1][1] + a[1][1],
            a[2][2] + a[2][2],
            a[0][1] + a[1][0],
            a[1][2] + a[2][1],
            a[0][2] + a[2][0],
        ],
    }
}

/// A S + S Aᵀ for a symmetric S: the rate of S carried by a flow or a spin A.
///
/// # Example
/// ```
/// use piola_continuum::{Symmetric, rates::kernels::transported};
/// let shear = [[0.0, 2.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
/// let carried = transported(shear, &Symmetric::diagonal([0.0, 3.0, 0.0]));
/// assert_eq!(carried.components, [0.0, 0.0, 0.0, 6.0, 0.0, 0.0]);
/// ```
#[inline(always)]
#[must_use]
pub fn transported<T: Real>(a: Rows<T>, s: &Symmetric<T>) -> Symmetric<T> {
    doubled_symmetric_part(product(a, s.rows()))
}
