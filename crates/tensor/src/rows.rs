//! Kernels on 3×3 arrays of rows: without a branch, inlined, so that they run in lanes.
//!
//! Determinant, adjugate, inverse and cross product are in
//! [`piola_numerics::linear::matrix3`]. Inside kernels tensors are such arrays; the types with meaning stand
//! where a kernel is called.

use piola_numerics::Real;
use piola_numerics::linear::matrix3::{cross, dot};

/// A 3×3 tensor as an array of rows.
pub type Rows<T> = [[T; 3]; 3];

/// 1.
///
/// # Example
/// ```
/// use piola_tensor::internal::rows;
/// assert_eq!(rows::identity::<f64>(), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn identity<T: Real>() -> Rows<T> {
    let (o, l) = (T::zero(), T::one());
    [[l, o, o], [o, l, o], [o, o, l]]
}

/// Aᵀ.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn transpose<T: Real>(a: Rows<T>) -> Rows<T> {
    [[a[0][0], a[1][0], a[2][0]], [a[0][1], a[1][1], a[2][1]], [a[0][2], a[1][2], a[2][2]]]
}

/// A B.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn product<T: Real>(a: Rows<T>, b: Rows<T>) -> Rows<T> {
    product_transposed(a, transpose(b))
}

/// A Bᵀ.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn product_transposed<T: Real>(a: Rows<T>, b: Rows<T>) -> Rows<T> {
    [
        [dot(a[0], b[0]), dot(a[0], b[1]), dot(a[0], b[2])],
        [dot(a[1], b[0]), dot(a[1], b[1]), dot(a[1], b[2])],
        [dot(a[2], b[0]), dot(a[2], b[1]), dot(a[2], b[2])],
    ]
}

/// Aᵀ B.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn transposed_product<T: Real>(a: Rows<T>, b: Rows<T>) -> Rows<T> {
    product_transposed(transpose(a), transpose(b))
}

/// A + B.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn sum<T: Real>(a: Rows<T>, b: Rows<T>) -> Rows<T> {
    [
        [a[0][0] + b[0][0], a[0][1] + b[0][1], a[0][2] + b[0][2]],
        [a[1][0] + b[1][0], a[1][1] + b[1][1], a[1][2] + b[1][2]],
        [a[2][0] + b[2][0], a[2][1] + b[2][1], a[2][2] + b[2][2]],
    ]
}

/// A − B.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn difference<T: Real>(a: Rows<T>, b: Rows<T>) -> Rows<T> {
    [
        [a[0][0] - b[0][0], a[0][1] - b[0][1], a[0][2] - b[0][2]],
        [a[1][0] - b[1][0], a[1][1] - b[1][1], a[1][2] - b[1][2]],
        [a[2][0] - b[2][0], a[2][1] - b[2][1], a[2][2] - b[2][2]],
    ]
}

/// s A.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn scaled<T: Real>(a: Rows<T>, s: T) -> Rows<T> {
    [
        [a[0][0] * s, a[0][1] * s, a[0][2] * s],
        [a[1][0] * s, a[1][1] * s, a[1][2] * s],
        [a[2][0] * s, a[2][1] * s, a[2][2] * s],
    ]
}

/// A v.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn apply<T: Real>(a: Rows<T>, v: [T; 3]) -> [T; 3] {
    [dot(a[0], v), dot(a[1], v), dot(a[2], v)]
}

/// tr A.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn trace<T: Real>(a: Rows<T>) -> T {
    a[0][0] + a[1][1] + a[2][2]
}

/// Cof A = det A A⁻ᵀ, the matrix of cofactors; it exists for singular A too.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn cofactor<T: Real>(a: Rows<T>) -> Rows<T> {
    [cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1])]
}

/// A : B = Aᵢⱼ Bᵢⱼ.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn double_contraction<T: Real>(a: Rows<T>, b: Rows<T>) -> T {
    dot(a[0], b[0]) + dot(a[1], b[1]) + dot(a[2], b[2])
}
