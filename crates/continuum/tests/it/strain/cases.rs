//! Random deformations, and the shapes in which results are compared.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::strain::{
    BiotStrain, HenckyStrain, LeftStretch, RightStretch, Rotation, SethHill, SethHillStrain, SpatialHenckyStrain,
    SpatialSethHillStrain,
};
use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient, Symmetric};
use piola_numerics::Real;
use piola_testkit::DoubleDouble;
use piola_testkit::strategies::{self, rotation_matrix};
use proptest::prelude::*;

/// A rotation matrix.
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

/// ∇u with entries of one size between 10⁻¹⁴ and 0.1.
pub(super) fn displacement() -> impl Strategy<Value = DisplacementGradient> {
    (direction(), -14.0..-1.0_f64).prop_map(|(entries, exponent)| {
        DisplacementGradient::new(entries * 10.0_f64.powf(exponent)).expect("0 < det F")
    })
}

/// A matrix with entries up to 1.
pub(super) fn direction() -> impl Strategy<Value = Matrix3<f64>> {
    strategies::vector(9, -1.0..1.0).prop_map(|entries| Matrix3::from_row_slice(&entries))
}

pub(super) fn matrix(rows: [[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| rows[i][j])
}

/// The nine components of a symmetric tensor, for comparisons by the largest entry.
pub(super) fn nine(tensor: &Symmetric) -> Vec<f64> {
    tensor.rows().as_flattened().to_vec()
}

/// The entries of a matrix by rows.
pub(super) fn flat(matrix: &Matrix3<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

/// The same numbers in doubled precision.
pub(super) fn doubled(matrix: &Matrix3<f64>) -> Matrix3<DoubleDouble> {
    matrix.map(DoubleDouble::lit)
}

/// The leading double of each number.
pub(super) fn leading(numbers: &[DoubleDouble]) -> Vec<f64> {
    numbers.iter().map(|x| x.primal(0)).collect()
}

/// Deformations with three and two equal stretches, with and without a rotation, and nearly equal ones.
pub(super) fn coalescent() -> Vec<DeformationGradient> {
    let turn = matrix(rotation_matrix([0.8, 0.36, 0.48, 0.0]));
    let mut all = Vec::new();
    for stretches in [[1.0, 1.0, 1.0], [1.5, 1.5, 1.5], [1.5, 1.5, 0.75], [2.0, 0.5, 0.5], [1.25, 1.25 + 1e-10, 0.8]] {
        let diagonal = Matrix3::from_diagonal(&stretches.into());
        let axes = matrix(rotation_matrix([0.5, 0.5, -0.5, 0.5]));
        for f in [diagonal, turn * diagonal, turn * diagonal * axes.transpose(), turn.transpose() * diagonal * turn] {
            all.push(DeformationGradient::new(f).expect("0 < det F"));
        }
    }
    all
}

/// The spectral measures as functions that are compiled once: the library's are inlined wherever they are called.
macro_rules! compiled_once {
    ($($function:ident $measure:ident),*) => { $(
        #[inline(never)]
        pub(super) fn $function<T: Real>(f: &impl Deformation<T>) -> Symmetric<T> {
            $measure::of(f).0
        }
    )* };
}
compiled_once!(
    right_stretch RightStretch, left_stretch LeftStretch, biot BiotStrain, hencky HenckyStrain,
    spatial_hencky SpatialHenckyStrain
);

#[inline(never)]
pub(super) fn polar_rotation<T: Real>(f: &impl Deformation<T>) -> Rotation<T> {
    Rotation::of(f)
}

#[inline(never)]
pub(super) fn seth_hill<T: Real>(f: &impl Deformation<T>, scale: SethHill) -> Symmetric<T> {
    SethHillStrain::of(f, scale).tensor
}

#[inline(never)]
pub(super) fn spatial_seth_hill<T: Real>(f: &impl Deformation<T>, scale: SethHill) -> Symmetric<T> {
    SpatialSethHillStrain::of(f, scale).tensor
}

#[inline(never)]
pub(super) fn analysis<T: Real>(f: &impl Deformation<T>) -> StretchAnalysis<T> {
    StretchAnalysis::of(f)
}
