//! Whether a deformation is moderate: strains below a bound, so that series converge.

use piola_numerics::Real;
use piola_numerics::internal::Lanewise;
use piola_numerics::linear::matrix3::determinant;
use piola_tensor::internal::rows::Rows;

/// Where |∇u|² ≤ ¾ and 0 < det F, of F and ∇u: stretches differ from 1 by less than 0.87. NaN is not moderate.
///
/// In lanes it is a loop over lanes: see [`Real::lanewise`].
///
/// # Example
/// ```
/// use piola_continuum::internal::strain::is_moderate;
/// assert!(is_moderate::<f64>([[1.5, 0.0, 0.0], [0.0, 1.5, 0.0], [0.0, 0.5, 1.0]], [[0.5, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.5, 0.0]]));
/// assert!(!is_moderate::<f64>([[2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [[1.0, 0.0, 0.0], [0.0; 3], [0.0; 3]]));
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn is_moderate<T: Real>(f: Rows<T>, h: Rows<T>) -> T::Mask {
    let ([[a, b, c], [d, e, g], [i, j, k]], [[l, m, n], [o, p, q], [r, s, t]]) = (f, h);
    let [square, jacobian] = T::lanewise(&SizeAndVolume, [a, b, c, d, e, g, i, j, k, l, m, n, o, p, q, r, s, t]);
    square.at_most(T::lit(MODERATE)) & T::zero().less_than(jacobian)
}

/// The largest |∇u|² of what [`is_moderate`]. Up to it det F is positive.
pub const MODERATE: f64 = 0.75;

/// |∇u|².
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn square<T: Real>([[a, b, c], [d, e, f], [g, h, i]]: Rows<T>) -> T {
    ((a * a + b * b + c * c) + (d * d + e * e + f * f)) + (g * g + h * h + i * i)
}

/// |∇u|² and det F, which follows from it: but loops that are shorter the compiler would unroll, and mix the lanes.
struct SizeAndVolume;

impl Lanewise<18, 2> for SizeAndVolume {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, [a, b, c, d, e, f, g, h, i, l, m, n, o, p, q, r, s, t]: [T; 18]) -> [T; 2] {
        [square([[l, m, n], [o, p, q], [r, s, t]]), determinant([[a, b, c], [d, e, f], [g, h, i]])]
    }
}
