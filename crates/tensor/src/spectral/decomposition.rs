//! Eigenvalues and eigenvectors of a symmetric tensor.

use piola_numerics::Real;
use piola_numerics::linear::matrix3::dot;
#[cfg(feature = "serde")]
use piola_numerics::linear::matrix3::from_rows;

use super::frame::{axes_in_order, combination, components_in, in_order, separated_frame};
use crate::Symmetric;
use crate::rows::Rows;
#[cfg(feature = "serde")]
use crate::{
    TensorError,
    error::{check_finite, check_range},
    rotation::check_rotation,
};

/// Principal values and axes of a symmetric tensor: A = Σ λₖ vₖ ⊗ vₖ.
///
/// What is read is checked: finite values that descend, right-handed orthonormal vectors to 64 ulp.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "Unchecked<T>",
        bound(serialize = "T: serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct SpectralDecomposition<T = f64> {
    /// The eigenvalues λₖ, descending.
    pub values: [T; 3],
    /// `vectors[k]` is the unit eigenvector of `values[k]`; together they are right-handed.
    pub vectors: Rows<T>,
}

/// The fields before validation.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked<T> {
    values: [T; 3],
    vectors: Rows<T>,
}

#[cfg(feature = "serde")]
impl<T: Real> TryFrom<Unchecked<T>> for SpectralDecomposition<T> {
    type Error = TensorError;

    fn try_from(Unchecked { values, vectors }: Unchecked<T>) -> Result<Self, TensorError> {
        check_principal(&values, vectors)?;
        Ok(Self { values, vectors })
    }
}

/// Refuses values that are not finite or do not descend, and axes that are not orthonormal and right-handed.
///
/// # Errors
/// `NotFinite`, `NotARotation`.
#[cfg(feature = "serde")]
pub fn check_principal<T: Real>(values: &[T; 3], axes: Rows<T>) -> Result<(), TensorError> {
    check_finite("principal value", values)?;
    check_rotation(&from_rows(axes))?;
    for pair in values.windows(2) {
        check_range("difference of principal values", pair[0] - pair[1], f64::INFINITY)?;
    }
    Ok(())
}

/// Eigenvalues and eigenvectors of A, W(14.12–14.13), without a branch.
///
/// ```text
/// A vₖ = λₖ vₖ,   λ₁ ≥ λ₂ ≥ λ₃,   vₖ · vₗ = δₖₗ
/// ```
/// Any finite A may be given: entries of 1e±300, coalescent values and A = 0 are no special cases.
///
/// # Accuracy
/// Values within 4 ulp of the largest modulus; vectors orthonormal within 2 ulp, each within a few ulp of ‖dev A‖ over its
/// gap; for coalescent values some orthonormal vectors of their plane or space.
///
/// # Derivatives
/// Over scalars with derivatives the values and vectors have theirs to every order, as far as they exist: where two
/// values coalesce, single vectors have none and are treated as if they did not turn towards one another. A function of A that
/// treats all directions alike does have derivatives there: see [`tensor_function`](super::tensor_function).
///
/// # Example
/// ```
/// use piola_tensor::{Symmetric, spectral};
/// // [[2, 1], [1, 2]] has the eigenvalues 3 and 1, along (1, 1) and (1, −1).
/// let decomposition = spectral::decompose(&Symmetric::new(2.0, 2.0, -4.0, 1.0, 0.0, 0.0));
/// assert!((decomposition.values[0] - 3.0_f64).abs() < 1e-15);
/// assert!((decomposition.values[1] - 1.0).abs() < 1e-15);
/// assert!((decomposition.vectors[0][0] - decomposition.vectors[0][1]).abs() < 1e-15);
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn decompose<T: Real>(a: &Symmetric<T>) -> SpectralDecomposition<T> {
    let frozen = Symmetric { components: a.components.map(T::frozen) };
    let (axes, first) = separated_frame(if T::ORDER == 0 { a } else { &frozen });
    let axes = if T::ORDER == 0 { axes } else { axes.map(|axis| axis.map(T::frozen)) };
    let m = components_in(&axes, a);
    if T::ORDER == 0 {
        let values = descending(in_order(first, [m[0], m[1], m[2]]));
        return SpectralDecomposition { values, vectors: axes_in_order(first, axes) };
    }
    let (values, turns) = lifted(m);
    SpectralDecomposition { values: in_order(first, values), vectors: axes_in_order(first, turned(&axes, turns)) }
}

/// The values in descending order: within rounding they are already.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn descending<T: Real>([a, b, c]: [T; 3]) -> [T; 3] {
    let (a, b) = ordered(a, b);
    let (b, c) = ordered(b, c);
    let (a, b) = ordered(a, b);
    [a, b, c]
}

/// The larger and the smaller, each with its own derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn ordered<T: Real>(a: T, b: T) -> (T, T) {
    let swap = a.less_than(b);
    (T::select(swap, b, a), T::select(swap, a, b))
}

/// Eigenvalues of a tensor whose components off the diagonal consist of derivatives and rounding, and its
/// eigenvectors before normalisation: row k is vₖ with vₖₖ = 1.
///
/// Each pass of vₖⱼ = (Mₖⱼ + Mⱼᵢ vₖᵢ)/(μₖ − Mⱼⱼ) brings in one order of derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn lifted<T: Real>(m: [T; 6]) -> ([T; 3], Rows<T>) {
    let diagonal = [m[0], m[1], m[2]];
    let off = |i: usize, j: usize| m[[[0, 3, 5], [3, 1, 4], [5, 4, 2]][i][j]];
    let size = diagonal[0].abs().max(diagonal[1].abs()).max(diagonal[2].abs()).frozen();
    let closest = size * T::lit(16.0 * piola_numerics::sums::unit_in_last_place::<T>());
    let mut values = diagonal;
    let mut vectors = crate::rows::identity::<T>();
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        for _ in 0..T::ORDER {
            let (vi, vj) = (vectors[k][i], vectors[k][j]);
            let turn = |to: usize, other: usize, v_other: T| {
                let gap = values[k] - diagonal[to];
                let apart = closest.less_than(gap.abs());
                let safe = T::select(apart, gap, T::one());
                T::select(apart, (off(k, to) + off(to, other) * v_other) / safe, T::zero())
            };
            let (ti, tj) = (turn(i, j, vj), turn(j, i, vi));
            vectors[k][i] = ti;
            vectors[k][j] = tj;
            values[k] = diagonal[k] + off(k, i) * ti + off(k, j) * tj;
        }
    }
    (values, vectors)
}

/// Σ tₖₗ qₗ, normalised: the axes turned by what [`lifted`] found.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn turned<T: Real>(axes: &Rows<T>, turns: Rows<T>) -> Rows<T> {
    turns.map(|t| {
        let scale = dot(t, t).sqrt().recip();
        let sum = combination(T::one(), combination(t[0], axes[0], t[1], axes[1]), t[2], axes[2]);
        sum.map(|x| x * scale)
    })
}
