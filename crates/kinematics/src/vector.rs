//! Products of three-vectors over any [`Real`]: unrolled and inlined, so that they fuse in jets and lanes.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::{Mask, Real};

/// a·b.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn dot<T: Real>(a: &Vector3<T>, b: &Vector3<T>) -> T {
    a.x * b.x + a.y * b.y + a.z * b.z
}

/// a×b.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn cross<T: Real>(a: &Vector3<T>, b: &Vector3<T>) -> Vector3<T> {
    Vector3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
}

/// s a.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn scaled<T: Real>(a: &Vector3<T>, s: T) -> Vector3<T> {
    Vector3::new(a.x * s, a.y * s, a.z * s)
}

/// A a with a constant matrix.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn constant_matrix_times<T: Real>(matrix: &Matrix3<f64>, a: &Vector3<T>) -> Vector3<T> {
    let row = |i: usize| T::lit(matrix[(i, 0)]) * a.x + T::lit(matrix[(i, 1)]) * a.y + T::lit(matrix[(i, 2)]) * a.z;
    Vector3::new(row(0), row(1), row(2))
}

/// Index and value of the first entry that is infinite or NaN in some lane.
pub(crate) fn first_non_finite<T: Real>(values: &[T]) -> Option<(usize, f64)> {
    let (index, entry) = values.iter().enumerate().find(|(_, entry)| !entry.is_finite().all())?;
    let value = (0..T::LANES).map(|lane| entry.primal(lane)).find(|value| !value.is_finite());
    Some((index, value.unwrap_or(f64::NAN)))
}
