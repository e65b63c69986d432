//! Kernels of strains on arrays of rows: without a branch, inlined, so that they run in lanes.
//!
//! ```text
//! C = Fᵀ F        B = F Fᵀ        2E = C − 1 = H + Hᵀ + Hᵀ H        B − 1 = H + Hᵀ + H Hᵀ        H = ∇u
//! e = ½ (1 − B⁻¹) = ½ (G + Gᵀ − Gᵀ G)        G = F⁻¹ H
//! ```

use piola_numerics::Real;
use piola_tensor::internal::product_symmetrized;
use piola_tensor::internal::rows::{Rows, product, scaled, transpose};

use crate::Symmetric;

/// C = Fᵀ F.
///
/// # Example
/// ```
/// use piola_continuum::internal::strain::right_cauchy_green;
/// let shear = [[1.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// assert_eq!(right_cauchy_green(shear).components, [5.0, 1.0, 1.0, 2.0, 0.0, 0.0]);
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn right_cauchy_green<T: Real>(f: Rows<T>) -> Symmetric<T> {
    Symmetric::gram(transpose(f))
}

/// B = F Fᵀ.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn left_cauchy_green<T: Real>(f: Rows<T>) -> Symmetric<T> {
    Symmetric::gram(f)
}

/// C − 1 = H + Hᵀ + Hᵀ H, of a displacement gradient, without cancellation.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn right_cauchy_green_minus_one<T: Real>(h: Rows<T>) -> Symmetric<T> {
    // Grouped so that for a rotation, too, each rounding is one of a small number.
    let two = T::lit(2.0);
    Symmetric::new(
        h[0][0] * (two + h[0][0]) + (h[1][0] * h[1][0] + h[2][0] * h[2][0]),
        h[1][1] * (two + h[1][1]) + (h[0][1] * h[0][1] + h[2][1] * h[2][1]),
        h[2][2] * (two + h[2][2]) + (h[0][2] * h[0][2] + h[1][2] * h[1][2]),
        (h[0][1] + h[1][0]) + ((h[0][0] * h[0][1] + h[1][0] * h[1][1]) + h[2][0] * h[2][1]),
        (h[1][2] + h[2][1]) + ((h[1][1] * h[1][2] + h[2][1] * h[2][2]) + h[0][1] * h[0][2]),
        (h[0][2] + h[2][0]) + ((h[0][0] * h[0][2] + h[2][0] * h[2][2]) + h[1][0] * h[1][2]),
    )
}

/// B − 1 = H + Hᵀ + H Hᵀ, of a displacement gradient, without cancellation.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn left_cauchy_green_minus_one<T: Real>(h: Rows<T>) -> Symmetric<T> {
    right_cauchy_green_minus_one(transpose(h))
}

/// E = ½ (C − 1) of a displacement gradient.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn green<T: Real>(h: Rows<T>) -> Symmetric<T> {
    right_cauchy_green_minus_one(h) * T::lit(0.5)
}

/// e = ½ (G + Gᵀ − Gᵀ G) of G = 1 − F⁻¹.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn almansi<T: Real>(g: Rows<T>) -> Symmetric<T> {
    right_cauchy_green_minus_one(scaled(g, -T::one())) * T::lit(-0.5)
}

/// sym(Fᵀ δF), the change of E.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn green_derivative<T: Real>(f: Rows<T>, direction: Rows<T>) -> Symmetric<T> {
    product_symmetrized(transpose(f), transpose(direction))
}

/// 2 sym(δF Fᵀ), the change of B.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn left_cauchy_green_derivative<T: Real>(f: Rows<T>, direction: Rows<T>) -> Symmetric<T> {
    product_symmetrized(direction, f) * T::lit(2.0)
}

/// sym(F⁻ᵀ F⁻¹ l) with l = δF F⁻¹, the change of e = ½ (1 − B⁻¹).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn almansi_derivative<T: Real>(inverse: Rows<T>, direction: Rows<T>) -> Symmetric<T> {
    // F⁻ᵀ (F⁻¹ δF) F⁻¹, symmetrised: both factors F⁻ᵀ, F⁻¹ outermost keep the result's own scale.
    let middle = Symmetric::symmetric_part(product(inverse, direction));
    middle.transposed_congruence(inverse)
}
