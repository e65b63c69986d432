//! Polar decomposition, logarithm and eigenvectors by several methods, over many points at a time.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use piola_batch as batch;
use piola_continuum::polar::{PolarHencky, StretchAnalysis, polar_hencky};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::linear::matrix3::from_rows;
use piola_tensor::spectral::decompose;

use super::trigonometric;

/// The peer's name and version.
pub const NALGEBRA: &str = "nalgebra 0.35";

/// R, U and ln U.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polar {
    /// R.
    pub rotation: Matrix3<f64>,
    /// U.
    pub right_stretch: Matrix3<f64>,
    /// ln U.
    pub hencky: Matrix3<f64>,
}

/// Eigenvalues and eigenvectors, these by columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pairs {
    /// Descending or not.
    pub values: [f64; 3],
    /// Unit vectors.
    pub vectors: Matrix3<f64>,
}

/// Q diag(f) Qᵀ for axes by columns.
#[inline]
fn composed(axes: &Matrix3<f64>, values: Vector3<f64>) -> Matrix3<f64> {
    axes * Matrix3::from_diagonal(&values) * axes.transpose()
}

/// Ours, point by point.
#[inline]
#[must_use]
pub fn polar(f: &DeformationGradient) -> PolarHencky {
    polar_hencky(f)
}

/// Ours, compiled into its caller, for any machine.
#[inline]
#[must_use]
pub fn polar_inlined(f: &DeformationGradient) -> PolarHencky {
    let stretch = StretchAnalysis::of(f);
    PolarHencky {
        rotation: from_rows(stretch.rotation()),
        right_stretch: stretch.right_stretch(),
        hencky: stretch.hencky_material(),
    }
}

/// Ours, ln U alone.
#[inline]
#[must_use]
pub fn hencky(f: &DeformationGradient) -> Symmetric {
    StretchAnalysis::of(f).hencky_material()
}

/// ln U = Q ln Σ Qᵀ by nalgebra's singular value decomposition.
#[inline]
#[must_use]
pub fn hencky_by_svd(f: &Matrix3<f64>) -> Matrix3<f64> {
    let svd = f.svd(false, true);
    svd.v_t.map_or_else(|| Matrix3::repeat(f64::NAN), |qt| composed(&qt.transpose(), svd.singular_values.map(f64::ln)))
}

/// ln U = ½ Q ln Λ Qᵀ by nalgebra's eigenvectors of C.
#[inline]
#[must_use]
pub fn hencky_by_eigen(f: &Matrix3<f64>) -> Matrix3<f64> {
    let eigen = SymmetricEigen::new(f.transpose() * f);
    composed(&eigen.eigenvectors, eigen.eigenvalues.map(|square| 0.5 * square.ln()))
}

/// ln U = ½ Q ln Λ Qᵀ by the closed form's eigenvectors of C.
#[inline]
#[must_use]
pub fn hencky_by_trigonometry(f: &Matrix3<f64>) -> Matrix3<f64> {
    let (values, vectors) = trigonometric::eigenpairs(&(f.transpose() * f));
    composed(&vectors, Vector3::from(values).map(|square| 0.5 * square.ln()))
}

/// nalgebra's singular value decomposition F = W Σ Qᵀ: R = W Qᵀ, U = Q Σ Qᵀ, ln U = Q ln Σ Qᵀ.
#[inline]
#[must_use]
pub fn polar_by_svd(f: &Matrix3<f64>) -> Polar {
    let svd = f.svd(true, true);
    let (Some(w), Some(qt)) = (svd.u, svd.v_t) else { return invalid() };
    let q = qt.transpose();
    let values = svd.singular_values;
    Polar { rotation: w * qt, right_stretch: composed(&q, values), hencky: composed(&q, values.map(f64::ln)) }
}

/// nalgebra's eigenvectors of `C = FᵀF`: `U = Q √Λ Qᵀ`, `ln U = ½ Q ln Λ Qᵀ`, `R = F U⁻¹`.
#[inline]
#[must_use]
pub fn polar_by_eigen(f: &Matrix3<f64>) -> Polar {
    let eigen = SymmetricEigen::new(f.transpose() * f);
    polar_of_square(f, eigen.eigenvalues, &eigen.eigenvectors)
}

/// The closed form's eigenvectors of `C = FᵀF`, then as [`polar_by_eigen`].
#[inline]
#[must_use]
pub fn polar_by_trigonometry(f: &Matrix3<f64>) -> Polar {
    let (values, vectors) = trigonometric::eigenpairs(&(f.transpose() * f));
    polar_of_square(f, values.into(), &vectors)
}

#[inline]
fn polar_of_square(f: &Matrix3<f64>, squares: Vector3<f64>, axes: &Matrix3<f64>) -> Polar {
    let stretches = squares.map(f64::sqrt);
    let inverse = composed(axes, stretches.map(f64::recip));
    Polar {
        rotation: f * inverse,
        right_stretch: composed(axes, stretches),
        hencky: composed(axes, squares.map(|square| 0.5 * square.ln())),
    }
}

fn invalid() -> Polar {
    let nan = Matrix3::repeat(f64::NAN);
    Polar { rotation: nan, right_stretch: nan, hencky: nan }
}

/// Ours of a symmetric tensor.
#[inline]
#[must_use]
pub fn pairs(a: &Symmetric) -> Pairs {
    let decomposition = decompose(a);
    Pairs { values: decomposition.values, vectors: from_rows(decomposition.vectors).transpose() }
}

/// nalgebra's of a symmetric tensor.
#[inline]
#[must_use]
pub fn pairs_by_nalgebra(a: &Matrix3<f64>) -> Pairs {
    let eigen = SymmetricEigen::new(*a);
    Pairs { values: eigen.eigenvalues.into(), vectors: eigen.eigenvectors }
}

/// nalgebra's singular values and vectors, which are eigenvalues and eigenvectors of a positive definite tensor.
#[inline]
#[must_use]
pub fn pairs_by_svd(a: &Matrix3<f64>) -> Pairs {
    let svd = a.svd(false, true);
    let vectors = svd.v_t.map_or_else(|| Matrix3::repeat(f64::NAN), |vt| vt.transpose());
    Pairs { values: svd.singular_values.into(), vectors }
}

/// The closed form's of a symmetric tensor.
#[inline]
#[must_use]
pub fn pairs_by_trigonometry(a: &Matrix3<f64>) -> Pairs {
    let (values, vectors) = trigonometric::eigenpairs(a);
    Pairs { values, vectors }
}

/// Ours in lanes: R, U and ln U of a batch. Returns how many points took the slow path.
///
/// # Panics
/// When lengths differ.
pub fn polar_batch(
    f: &[DeformationGradient],
    rotations: &mut [Matrix3<f64>],
    stretches: &mut [Symmetric],
    logarithms: &mut [Symmetric],
) -> usize {
    let requests = (batch::rotation(rotations), batch::right_stretch(stretches), batch::hencky(logarithms));
    batch::evaluate(f, requests).expect("lengths agree, points are good").slow_path
}
