//! F = Fₑ Fᵢ with an isotropic spring: what all laws of inelastic flow share.
//!
//! ```text
//! M = Cₑ Sₑ        Fᵢ,ₙ₊₁ = exp(Δ) Fᵢ,ₙ,   Δ = Δt D(M) symmetric: no inelastic spin        tr Δ = 0 ⟹ det Fᵢ stays 1
//! ```

use nalgebra::Matrix3;
use piola_continuum::internal::strain::right_cauchy_green;
use piola_continuum::rates::logarithm;
use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, inverse_and_determinant, rows_of};
use piola_solids::Hyperelastic;
use piola_tensor::internal::rows::{Rows, difference, identity, product, product_transposed};

/// Fᵢ of the first nine internal variables.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn inelastic<T: Real, const S: usize>(state: &[T; S]) -> Rows<T> {
    let mut rows = identity();
    for (row, three) in rows.iter_mut().zip(state.chunks(3)) {
        for (entry, value) in row.iter_mut().zip(three) {
            *entry = *value;
        }
    }
    rows
}

/// The state with another Fᵢ.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn with_inelastic<T: Real, const S: usize>(mut state: [T; S], rows: &Rows<T>) -> [T; S] {
    for (value, entry) in state.iter_mut().zip(rows.as_flattened()) {
        *value = *entry;
    }
    state
}

/// The unit of the group: the first nine internal variables of the body as it was made, zeros after them.
pub(crate) fn virgin<const S: usize>() -> [f64; S] {
    with_inelastic([0.0; S], &identity())
}

/// The symmetric tensor of the first six unknowns: 11, 22, 33, 12, 23, 13.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn increment<T: Real, const X: usize>(unknowns: &[T; X]) -> Symmetric<T> {
    let mut components = [T::zero(); 6];
    for (component, unknown) in components.iter_mut().zip(unknowns) {
        *component = *unknown;
    }
    Symmetric { components }
}

/// A F⁻¹.
#[cfg_attr(not(debug_assertions), inline(always))]
fn divided<T: Real>(a: &Rows<T>, f: &Rows<T>) -> Rows<T> {
    product(*a, inverse_and_determinant(*f).0)
}

/// exp Δ.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn exponential<T: Real>(increment: &Symmetric<T>) -> Rows<T> {
    piola_continuum::rates::exponential_rows(increment.rows())
}

/// Fₑ = F Fᵢ,ₙ⁻¹ exp(−Δ).
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn elastic<T: Real>(f: &Rows<T>, inelastic: &Rows<T>, increment: &Symmetric<T>) -> Rows<T> {
    product(divided(f, inelastic), exponential(&(-*increment)))
}

/// Mandel's stress M = Cₑ Sₑ of an isotropic spring, which is symmetric.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn mandel<T: Real, L: Hyperelastic>(spring: &L, elastic: &Rows<T>) -> Symmetric<T> {
    let stress = spring.second_piola(&DeformationGradient::trusted(*elastic)).0;
    Symmetric::symmetric_part(product(right_cauchy_green(*elastic).rows(), stress.rows()))
}

/// P = Pₑ Fᵢ⁻ᵀ of a spring behind Fᵢ.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn first_piola<T: Real, L: Hyperelastic>(spring: &L, f: &Rows<T>, inelastic: &Rows<T>) -> Rows<T> {
    let (inverse, _) = inverse_and_determinant(*inelastic);
    let stress = spring.first_piola(&DeformationGradient::trusted(product(*f, inverse)));
    product_transposed(rows_of(&stress.0), inverse)
}

/// Ω = ln(Fᵢ Fᵢ,₀⁻¹) in place of Fᵢ, differences of the other variables.
pub(crate) fn coordinates<T: Real, const S: usize>(about: &[T; S], state: &[T; S]) -> [T; S] {
    let ratio = divided(&inelastic(state), &inelastic(about));
    let nothing = Matrix3::from_element(T::lit(f64::NAN));
    let exponent = logarithm(&from_rows(difference(ratio, identity()))).unwrap_or(nothing);
    let mut coordinates = *state;
    for (x, y) in coordinates.iter_mut().zip(about) {
        *x -= *y;
    }
    with_inelastic(coordinates, &rows_of(&exponent))
}

/// exp(Ω) Fᵢ,₀, and sums of the other variables; of a flow that keeps the volume the trace of Ω is rounding, and left out.
pub(crate) fn at_coordinates<T: Real, const S: usize>(about: &[T; S], coordinates: &[T; S], isochoric: bool) -> [T; S] {
    let mut state = *about;
    for (x, y) in state.iter_mut().zip(coordinates) {
        *x += *y;
    }
    let mut coordinates = *coordinates;
    if isochoric {
        let mean = (coordinates[0] + coordinates[4] + coordinates[8]) * T::lit(1.0 / 3.0);
        for place in [0, 4, 8] {
            coordinates[place] -= mean;
        }
    }
    let exponent = piola_continuum::rates::exponential_rows(inelastic(&coordinates));
    with_inelastic(state, &product(exponent, inelastic(about)))
}

/// M : Δ at the end of a step, Δ the symmetric part of ln(Fᵢ Fᵢ,₀⁻¹).
pub(crate) fn dissipated<L: Hyperelastic, const S: usize>(
    spring: &L,
    from: &[f64; S],
    f: &Rows<f64>,
    state: &[f64; S],
) -> f64 {
    let change = inelastic(&coordinates(from, state));
    let stress = mandel(spring, &divided(f, &inelastic(state)));
    stress.double_contraction(&Symmetric::symmetric_part(change))
}

/// M : M of a deviator, never zero: of nothing at all a part of `scale`² that nothing feels.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn square<T: Real>(deviator: &Symmetric<T>, scale: f64) -> T {
    deviator.double_contraction(deviator) + T::lit(1e-40 * scale * scale)
}

/// tr(Fᵢᵀ Fᵢ).
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn trace_of_square<T: Real>(inelastic: &Rows<T>) -> T {
    right_cauchy_green(*inelastic).trace()
}
