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
/// use piola_tensor::rows;
/// assert_eq!(rows::identity::<f64>(), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
/// ```
#[inline(always)]
#[must_use]
pub fn identity<T: Real>() -> Rows<T> {
    let (o, l) = (T::zero(), T::one());
    [[l, o, o], [o, l, o], [o, o, l]]
}

/// Aᵀ.
///
/// # Example
/// ```
/// use piola_tensor::rows::transpose;
/// assert_eq!(transpose([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]])[0], [1.0, 4.0, 7.0]);
/// ```
#[inline(always)]
#[must_use]
pub fn transpose<T: Real>(a: Rows<T>) -> Rows<T> {
    [[a[0][0], a[1][0], a[2][0]], [a[0][1], a[1][1], a[2][1]], [a[0][2], a[1][2], a[2][2]]]
}

/// A B.
///
/// # Example
/// ```
/// use piola_tensor::rows::product;
/// let shear = [[1.0, 2.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// assert_eq!(product(shear, shear)[0], [1.0, 4.0, 0.0]); // shears of one plane add up
/// ```
#[inline(always)]
#[must_use]
pub fn product<T: Real>(a: Rows<T>, b: Rows<T>) -> Rows<T> {
    product_transposed(a, transpose(b))
}

/// A Bᵀ.
///
/// # Example
/// ```
/// use piola_tensor::rows::product_transposed;
/// let shear = [[1.0, 2.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// assert_eq!(product_transposed(shear, shear)[0], [5.0, 2.0, 0.0]); // F Fᵀ
/// ```
#[inline(always)]
#[must_use]
pub fn product_transposed<T: Real>(a: Rows<T>, b: Rows<T>) -> Rows<T> {
    [
        [dot(a[0], b[0]), dot(a[0], b[1]), dot(a[0], b[2])],
        [dot(a[1], b[0]), dot(a[1], b[1]), dot(a[1], b[2])],
        [dot(a[2], b[0]), dot(a[2], b[1]), dot(a[2], b[2])],
    ]
}

/// Aᵀ B.
///
/// # Example
/// ```
/// use piola_tensor::rows::transposed_product;
/// let shear = [[1.0, 2.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// assert_eq!(transposed_product(shear, shear)[1], [2.0, 5.0, 0.0]); // FᵀF
/// ```
#[inline(always)]
#[must_use]
pub fn transposed_product<T: Real>(a: Rows<T>, b: Rows<T>) -> Rows<T> {
    product_transposed(transpose(a), transpose(b))
}

/// A + B.
///
/// # Example
/// ```
/// use piola_tensor::rows::{identity, sum};
/// assert_eq!(sum(identity::<f64>(), identity())[1], [0.0, 2.0, 0.0]);
/// ```
#[inline(always)]
#[must_use]
pub fn sum<T: Real>(a: Rows<T>, b: Rows<T>) -> Rows<T> {
    [
        [a[0][0] + b[0][0], a[0][1] + b[0][1], a[0][2] + b[0][2]],
        [a[1][0] + b[1][0], a[1][1] + b[1][1], a[1][2] + b[1][2]],
        [a[2][0] + b[2][0], a[2][1] + b[2][1], a[2][2] + b[2][2]],
    ]
}

/// A − B.
///
/// # Example
/// ```
/// use piola_tensor::rows::{difference, identity};
/// assert_eq!(difference(identity::<f64>(), [[0.0, 2.0, 0.0], [0.0; 3], [0.0; 3]])[0], [1.0, -2.0, 0.0]);
/// ```
#[inline(always)]
#[must_use]
pub fn difference<T: Real>(a: Rows<T>, b: Rows<T>) -> Rows<T> {
    [
        [a[0][0] - b[0][0], a[0][1] - b[0][1], a[0][2] - b[0][2]],
        [a[1][0] - b[1][0], a[1][1] - b[1][1], a[1][2] - b[1][2]],
        [a[2][0] - b[2][0], a[2][1] - b[2][1], a[2][2] - b[2][2]],
    ]
}

/// s A.
///
/// # Example
/// ```
/// use piola_tensor::rows::{identity, scaled};
/// assert_eq!(scaled(identity::<f64>(), 3.0)[2], [0.0, 0.0, 3.0]);
/// ```
#[inline(always)]
#[must_use]
pub fn scaled<T: Real>(a: Rows<T>, s: T) -> Rows<T> {
    [
        [a[0][0] * s, a[0][1] * s, a[0][2] * s],
        [a[1][0] * s, a[1][1] * s, a[1][2] * s],
        [a[2][0] * s, a[2][1] * s, a[2][2] * s],
    ]
}

/// A v.
///
/// # Example
/// ```
/// use piola_tensor::rows::apply;
/// let shear = [[1.0, 2.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// assert_eq!(apply(shear, [0.0, 1.0, 0.0]), [2.0, 1.0, 0.0]);
/// ```
#[inline(always)]
#[must_use]
pub fn apply<T: Real>(a: Rows<T>, v: [T; 3]) -> [T; 3] {
    [dot(a[0], v), dot(a[1], v), dot(a[2], v)]
}

/// tr A.
///
/// # Example
/// ```
/// use piola_tensor::rows::trace;
/// assert_eq!(trace([[1.0, 9.0, 9.0], [9.0, 2.0, 9.0], [9.0, 9.0, 3.0]]), 6.0);
/// ```
#[inline(always)]
#[must_use]
pub fn trace<T: Real>(a: Rows<T>) -> T {
    a[0][0] + a[1][1] + a[2][2]
}

/// Cof A = det A A⁻ᵀ, the matrix of cofactors; it exists for singular A too.
///
/// # Example
/// ```
/// use piola_tensor::rows::cofactor;
/// let f = [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]];
/// assert_eq!(cofactor(f)[0], [12.0, 0.0, 0.0]); // the area of the face normal to the first axis grows 3·4 times
/// ```
#[inline(always)]
#[must_use]
pub fn cofactor<T: Real>(a: Rows<T>) -> Rows<T> {
    [cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1])]
}

/// A : B = Aᵢⱼ Bᵢⱼ.
///
/// # Example
/// ```
/// use piola_tensor::rows::double_contraction;
/// let a = [[1.0, 2.0, 0.0], [0.0; 3], [0.0; 3]];
/// assert_eq!(double_contraction(a, [[3.0, 4.0, 0.0], [5.0, 0.0, 0.0], [0.0; 3]]), 11.0);
/// ```
#[inline(always)]
#[must_use]
pub fn double_contraction<T: Real>(a: Rows<T>, b: Rows<T>) -> T {
    dot(a[0], b[0]) + dot(a[1], b[1]) + dot(a[2], b[2])
}
