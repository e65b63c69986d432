//! Derivatives of deformations over any scalar.

use nalgebra::Vector3;
use piola_fields::Motion;
use piola_numerics::{Gradient, Real};
use piola_tensor::internal::rows::Rows;

/// The place as three variables of a gradient.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn variables<T: Real>(reference: &Vector3<T>) -> Vector3<Gradient<T, 3>> {
    Vector3::from_fn(|i, _| Gradient::variable(reference[i], i))
}

/// F at a particle.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn gradient<T: Real>(motion: &impl Motion, reference: &Vector3<T>, t: f64) -> Rows<T> {
    let place = motion.place(&variables(reference), Gradient::constant(T::lit(t)));
    [0, 1, 2].map(|i: usize| place[i].partials)
}

/// Values and derivatives with respect to the particle apart.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn values<T: Real>(rows: Rows<Gradient<T, 3>>) -> Rows<T> {
    rows.map(|row| row.map(|entry| entry.value))
}
