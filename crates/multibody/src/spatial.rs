//! Three-vectors, symmetric matrices and spatial inertias as plain arrays, for kernels and lanes.
//!
//! ```text
//! symmetric [T; 6]: xx xy xz yy yz zz        matrix [[T; 3]; 3]: rows
//! ```

use piola_numerics::Real;
pub(crate) use piola_numerics::linear::matrix3::{cross, dot};

pub(crate) type Vector<T> = [T; 3];
pub(crate) type Matrix<T> = [[T; 3]; 3];
pub(crate) type Symmetric<T> = [T; 6];

/// The place of entry (i, j) of a symmetric matrix.
pub(crate) const ENTRY: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];

/// Constants as scalars.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn lit<T: Real>(a: [f64; 3]) -> Vector<T> {
    [T::lit(a[0]), T::lit(a[1]), T::lit(a[2])]
}

/// Constants as scalars.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn lit_matrix<T: Real>(a: [[f64; 3]; 3]) -> Matrix<T> {
    [lit(a[0]), lit(a[1]), lit(a[2])]
}

/// Constants as scalars.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn lit_symmetric<T: Real>(a: [f64; 6]) -> Symmetric<T> {
    [T::lit(a[0]), T::lit(a[1]), T::lit(a[2]), T::lit(a[3]), T::lit(a[4]), T::lit(a[5])]
}

/// a + b.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn add<T: Real>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// a − b.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sub<T: Real>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// s a.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn scaled<T: Real>(s: T, a: Vector<T>) -> Vector<T> {
    [s * a[0], s * a[1], s * a[2]]
}

/// A x for rows A.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn times<T: Real>(a: Matrix<T>, x: Vector<T>) -> Vector<T> {
    [dot(a[0], x), dot(a[1], x), dot(a[2], x)]
}

/// Aᵀ x for rows A.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn transposed_times<T: Real>(a: Matrix<T>, x: Vector<T>) -> Vector<T> {
    [
        a[0][0] * x[0] + a[1][0] * x[1] + a[2][0] * x[2],
        a[0][1] * x[0] + a[1][1] * x[1] + a[2][1] * x[2],
        a[0][2] * x[0] + a[1][2] * x[1] + a[2][2] * x[2],
    ]
}

/// The transposed matrix.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn transposed<T: Real>(a: Matrix<T>) -> Matrix<T> {
    [[a[0][0], a[1][0], a[2][0]], [a[0][1], a[1][1], a[2][1]], [a[0][2], a[1][2], a[2][2]]]
}

/// A B for rows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn product<T: Real>(a: Matrix<T>, b: Matrix<T>) -> Matrix<T> {
    [transposed_times(b, a[0]), transposed_times(b, a[1]), transposed_times(b, a[2])]
}

/// A x for a symmetric matrix.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn symmetric_times<T: Real>(a: Symmetric<T>, x: Vector<T>) -> Vector<T> {
    [
        a[0] * x[0] + a[1] * x[1] + a[2] * x[2],
        a[1] * x[0] + a[3] * x[1] + a[4] * x[2],
        a[2] * x[0] + a[4] * x[1] + a[5] * x[2],
    ]
}

/// All entries of a symmetric matrix.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn full<T: Real>(a: Symmetric<T>) -> Matrix<T> {
    [[a[0], a[1], a[2]], [a[1], a[3], a[4]], [a[2], a[4], a[5]]]
}

/// The matrix [a]× with [a]× x = a × x.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn skew<T: Real>(a: Vector<T>) -> Matrix<T> {
    let zero = T::zero();
    [[zero, -a[2], a[1]], [a[2], zero, -a[0]], [-a[1], a[0], zero]]
}

/// [a]× A for rows A.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn skew_times<T: Real>(a: Vector<T>, b: Matrix<T>) -> Matrix<T> {
    [
        sub(scaled(a[1], b[2]), scaled(a[2], b[1])),
        sub(scaled(a[2], b[0]), scaled(a[0], b[2])),
        sub(scaled(a[0], b[1]), scaled(a[1], b[0])),
    ]
}

/// [a]× [b]× = b aᵀ − (a·b) 1.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn skew_skew<T: Real>(a: Vector<T>, b: Vector<T>) -> Matrix<T> {
    let (x, y, z) = (a[0] * b[0], a[1] * b[1], a[2] * b[2]);
    [[-(y + z), b[0] * a[1], b[0] * a[2]], [b[1] * a[0], -(x + z), b[1] * a[2]], [b[2] * a[0], b[2] * a[1], -(x + y)]]
}

/// [α]× + [ω]×²: the gradient of the field of accelerations in a rigid body.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn acceleration_gradient<T: Real>(w: Vector<T>, alpha: Vector<T>) -> Matrix<T> {
    let (xx, yy, zz) = (w[0] * w[0], w[1] * w[1], w[2] * w[2]);
    let (xy, xz, yz) = (w[0] * w[1], w[0] * w[2], w[1] * w[2]);
    [
        [-(yy + zz), xy - alpha[2], xz + alpha[1]],
        [xy + alpha[2], -(xx + zz), yz - alpha[0]],
        [xz - alpha[1], yz + alpha[0], -(xx + yy)],
    ]
}

/// The inertia m (|r|² 1 − r rᵀ) + 2 (h·r) 1 − h rᵀ − r hᵀ that a translation by r adds to one about the old origin.
///
/// m is the mass, h the first moment about the old origin.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn translated_inertia<T: Real>(mass: T, h: Vector<T>, r: Vector<T>) -> Symmetric<T> {
    // With g = h + m r: the sum is that of g and r in the places of h and r, less h r.
    let g = [h[0] + mass * r[0], h[1] + mass * r[1], h[2] + mass * r[2]];
    let p = [g[0] * r[0] + h[0] * r[0], g[1] * r[1] + h[1] * r[1], g[2] * r[2] + h[2] * r[2]];
    [
        p[1] + p[2],
        -(g[0] * r[1] + r[0] * h[1]),
        -(g[0] * r[2] + r[0] * h[2]),
        p[0] + p[2],
        -(g[1] * r[2] + r[1] * h[2]),
        p[0] + p[1],
    ]
}
