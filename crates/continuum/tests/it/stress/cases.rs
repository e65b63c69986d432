//! Random stresses and deformations, and the shapes in which results are compared.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::{CauchyStress, DeformationGradient, Symmetric};
use piola_testkit::strategies::{self, rotation_matrix};
use proptest::prelude::*;

/// A stress of entries up to 100 Pa.
pub(super) fn stress() -> impl Strategy<Value = CauchyStress> {
    strategies::vector(6, -100.0..100.0)
        .prop_map(|c| CauchyStress::new(c[0], c[1], c[2], c[3], c[4], c[5]).expect("finite"))
}

/// A rotation matrix.
pub(super) fn rotation() -> impl Strategy<Value = Matrix3<f64>> {
    strategies::rotation().prop_map(|q| matrix(rotation_matrix(q)))
}

/// R diag(stretches) Qᵀ with principal stretches between 1/2 and 2: no product of terms is much larger than F.
pub(super) fn deformation() -> impl Strategy<Value = DeformationGradient> {
    (rotation(), rotation(), strategies::vector(3, -0.7..0.7)).prop_map(|(r, q, logarithms)| {
        let stretches = Vector3::from_iterator(logarithms.iter().map(|x| x.exp()));
        DeformationGradient::new(r * Matrix3::from_diagonal(&stretches) * q.transpose()).expect("0 < det F")
    })
}

/// A direction.
pub(super) fn direction() -> impl Strategy<Value = Vector3<f64>> {
    strategies::unit_vector().prop_map(Vector3::from)
}

/// A matrix with entries up to 1.
pub(super) fn rate() -> impl Strategy<Value = Matrix3<f64>> {
    strategies::vector(9, -1.0..1.0).prop_map(|entries| Matrix3::from_row_slice(&entries))
}

pub(super) fn matrix(rows: [[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| rows[i][j])
}

/// The nine components of a symmetric tensor, for comparisons by the largest entry.
pub(super) fn nine(tensor: &Symmetric) -> Vec<f64> {
    tensor.rows().as_flattened().to_vec()
}

/// The largest modulus of the entries.
pub(super) fn size(entries: &[f64]) -> f64 {
    entries.iter().fold(0.0, |largest, x| largest.max(x.abs()))
}
