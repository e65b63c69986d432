//! Kernels of the stress measures on arrays of rows: without a branch, inlined, so that they run in lanes.
//!
//! ```text
//! Cof F = J F⁻ᵀ        P = T Cof F        T = J⁻¹ P Fᵀ = J⁻¹ F S Fᵀ        S = J⁻¹ (Cof F)ᵀ T Cof F
//! ```
//!
//! The types of [`stress`](crate::stress) call these; so do batches, which know what their arrays mean. J is an
//! argument, because [`Deformation::jacobian`](crate::Deformation::jacobian) knows it to more digits than the
//! products of the entries of F have for large ratios of stretches.

use piola_numerics::Real;
use piola_tensor::Skew;
use piola_tensor::internal::product_symmetrized;
use piola_tensor::internal::rows::{Rows, cofactor, product, product_transposed, scaled, transposed_product};

use crate::Symmetric;

/// P = T Cof F of Cauchy's stress.
///
/// # Example
/// ```
/// use piola_continuum::{Symmetric, internal::stress::first_piola_of_cauchy};
/// let f = [[2.0, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.5]];
/// // A bar of half the width: 8 Pa on a quarter of the area are 2 Pa on the area before.
/// assert_eq!(first_piola_of_cauchy(f, &Symmetric::diagonal([8.0, 0.0, 0.0]))[0][0], 2.0);
/// ```
///
/// # Source
/// W(17.21), B(4.52).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_piola_of_cauchy<T: Real>(f: Rows<T>, cauchy: &Symmetric<T>) -> Rows<T> {
    product(cauchy.rows(), cofactor(f))
}

/// T = J⁻¹ sym(P Fᵀ) of the first Piola–Kirchhoff stress.
///
/// # Source
/// W(17.21).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn cauchy_of_first_piola<T: Real>(f: Rows<T>, jacobian: T, first_piola: Rows<T>) -> Symmetric<T> {
    product_symmetrized(first_piola, f) * jacobian.recip()
}

/// S = J⁻¹ (Cof F)ᵀ T Cof F of Cauchy's stress.
///
/// # Source
/// B(4.57).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn second_piola_of_cauchy<T: Real>(f: Rows<T>, jacobian: T, cauchy: &Symmetric<T>) -> Symmetric<T> {
    cauchy.transposed_congruence(cofactor(f)) * jacobian.recip()
}

/// T = J⁻¹ F S Fᵀ of the second Piola–Kirchhoff stress.
///
/// # Source
/// B(4.57).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn cauchy_of_second_piola<T: Real>(f: Rows<T>, jacobian: T, second_piola: &Symmetric<T>) -> Symmetric<T> {
    second_piola.congruence(f) * jacobian.recip()
}

/// S = F⁻¹ P, its symmetric part.
///
/// # Source
/// B(4.57).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn second_piola_of_first_piola<T: Real>(f: Rows<T>, jacobian: T, first_piola: Rows<T>) -> Symmetric<T> {
    Symmetric::symmetric_part(transposed_product(cofactor(f), first_piola)) * jacobian.recip()
}

/// P = F⁻ᵀ M of Mandel's stress.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_piola_of_mandel<T: Real>(f: Rows<T>, jacobian: T, mandel: Rows<T>) -> Rows<T> {
    scaled(product(cofactor(f), mandel), jacobian.recip())
}

/// P = τ F⁻ᵀ of Kirchhoff's stress.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_piola_of_kirchhoff<T: Real>(f: Rows<T>, jacobian: T, kirchhoff: &Symmetric<T>) -> Rows<T> {
    scaled(product(kirchhoff.rows(), cofactor(f)), jacobian.recip())
}

/// P Fᵀ − F Pᵀ as the vector of its entries 32, 13, 21: zero for a stress that obeys W(17.35).
///
/// # Source
/// W(17.35).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn moment_of_first_piola<T: Real>(f: Rows<T>, first_piola: Rows<T>) -> [T; 3] {
    Skew::difference_from_transpose(product_transposed(first_piola, f)).axial
}
