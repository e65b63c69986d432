//! What the tests share.

use nalgebra::Matrix3;
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::{DeformationGradient, DisplacementGradient, Symmetric};
use piola_testkit::spectral::Rows;

pub(super) fn matrix(rows: Rows<f64>) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| rows[i][j])
}

pub(super) fn gradient(rows: Rows<f64>) -> DeformationGradient {
    DeformationGradient::new(matrix(rows)).expect("0 < det F")
}

pub(super) fn analysis(rows: Rows<f64>) -> StretchAnalysis {
    StretchAnalysis::of(&gradient(rows))
}

pub(super) fn of_displacement(rows: Rows<f64>) -> StretchAnalysis {
    StretchAnalysis::of(&DisplacementGradient::new(matrix(rows)).expect("0 < det F"))
}

pub(super) fn symmetric(rows: Rows<f64>) -> Symmetric {
    Symmetric::symmetric_part(rows)
}

pub(super) fn flat(tensor: &Symmetric) -> Vec<f64> {
    tensor.rows().concat()
}

pub(super) fn size(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size: f64, x| size.max(x.abs()))
}

/// The largest entry of A − B.
pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
    size(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>())
}

/// The largest entry of `QᵀQ` − 1.
pub(super) fn orthogonality(rows: Rows<f64>) -> f64 {
    let q = matrix(rows);
    (q.transpose() * q - Matrix3::identity()).amax()
}
