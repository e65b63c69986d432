//! Random tensors, and the shapes in which results are compared.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_tensor::{FourthOrder, PairSymmetric, Skew};
use piola_testkit::strategies::{self, rotation_matrix};
use proptest::prelude::*;

pub(super) fn symmetric() -> impl Strategy<Value = Symmetric> {
    strategies::vector(6, -1.0..1.0).prop_map(|c| Symmetric::new(c[0], c[1], c[2], c[3], c[4], c[5]))
}

pub(super) fn skew() -> impl Strategy<Value = Skew> {
    strategies::vector(3, -1.0..1.0).prop_map(|c| Skew::new(c[0], c[1], c[2]))
}

pub(super) fn rows() -> impl Strategy<Value = [[f64; 3]; 3]> {
    strategies::vector(9, -1.0..1.0).prop_map(|c| core::array::from_fn(|i| core::array::from_fn(|j| c[3 * i + j])))
}

pub(super) fn rotation() -> impl Strategy<Value = Matrix3<f64>> {
    strategies::rotation().prop_map(|q| matrix(rotation_matrix(q)))
}

/// R diag(stretches) Qᵀ with principal stretches between 1/2 and 2.
pub(super) fn deformation() -> impl Strategy<Value = DeformationGradient> {
    (rotation(), rotation(), strategies::vector(3, -0.7..0.7)).prop_map(|(r, q, logarithms)| {
        let stretches = Vector3::from_iterator(logarithms.iter().map(|x| x.exp()));
        DeformationGradient::new(r * Matrix3::from_diagonal(&stretches) * q.transpose()).expect("0 < det F")
    })
}

pub(super) fn matrix(rows: [[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| rows[i][j])
}

/// All 81 components.
pub(super) fn all(tensor: &impl PairSymmetric<f64>) -> Vec<f64> {
    flat(&tensor.general())
}

pub(super) fn flat(tensor: &FourthOrder) -> Vec<f64> {
    tensor.components.as_flattened().to_vec()
}

pub(super) fn nine(tensor: &Symmetric) -> Vec<f64> {
    tensor.rows().as_flattened().to_vec()
}
