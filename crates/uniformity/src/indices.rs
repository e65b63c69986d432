//! Arrays of components by their indices.

use nalgebra::Vector3;
use piola_numerics::{Gradient, Real};
use piola_tensor::Rows;

/// Components with three indices, `[C][A][B]`.
pub(crate) type Third<T> = [[[T; 3]; 3]; 3];
/// Components with four indices, `[C][A][B][D]`.
pub(crate) type Fourth<T> = [[[[T; 3]; 3]; 3]; 3];

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn second<T>(mut entry: impl FnMut(usize, usize) -> T) -> Rows<T> {
    core::array::from_fn(|a| core::array::from_fn(|b| entry(a, b)))
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn third<T>(mut entry: impl FnMut(usize, usize, usize) -> T) -> Third<T> {
    core::array::from_fn(|c| core::array::from_fn(|a| core::array::from_fn(|b| entry(c, a, b))))
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn fourth<T>(mut entry: impl FnMut(usize, usize, usize, usize) -> T) -> Fourth<T> {
    core::array::from_fn(|c| third(|a, b, d| entry(c, a, b, d)))
}

/// Σᵢ `term(i)` over three indices.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sum<T: Real>(mut term: impl FnMut(usize) -> T) -> T {
    term(0) + term(1) + term(2)
}

/// The coordinates as variables of first derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn variables<T: Real>(place: &Vector3<T>) -> Vector3<Gradient<T, 3>> {
    Vector3::new(Gradient::variable(place[0], 0), Gradient::variable(place[1], 1), Gradient::variable(place[2], 2))
}

/// The values in the first lane, for messages.
#[inline]
pub(crate) fn primal<T: Real>(place: &Vector3<T>, lane: usize) -> [f64; 3] {
    [0, 1, 2].map(|i: usize| place[i].primal(lane))
}

/// The largest modulus among the components, over all lanes.
#[inline]
pub(crate) fn largest<T: Real>(values: impl IntoIterator<Item = T>) -> T {
    values.into_iter().fold(T::zero(), |largest, x| largest.max(x.abs()))
}
