//! Changes of reference that leave a homogeneous configuration homogeneous.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::linear::matrix3::inverse;

use crate::SolutionsError;
use crate::error::{check_bound, check_finite};

/// The symmetry group 𝒢 of a homogeneous body.
///
/// # Example
/// See [`configuration_residual`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum MaterialSymmetry {
    /// All H with |det H| = 1: fluids.
    Unimodular,
    /// All orthogonal H: isotropic solids in an undistorted reference.
    Orthogonal,
    /// All orthogonal H with H e = ±e: transversely isotropic solids about e.
    About(Vector3<f64>),
    /// Finitely many: crystals; the identity is always one of them.
    Finite(Vec<Matrix3<f64>>),
}

impl MaterialSymmetry {
    /// How far H is from the group: zero for its elements.
    fn distance(&self, h: &Matrix3<f64>) -> f64 {
        let orthogonal = || (h * h.transpose() - Matrix3::identity()).norm();
        match self {
            Self::Unimodular => (h.determinant().abs() - 1.0).abs(),
            Self::Orthogonal => orthogonal(),
            Self::About(axis) => {
                let e = axis.normalize();
                orthogonal().max((h * e - e).norm().min((h * e + e).norm()))
            }
            Self::Finite(elements) => {
                let from = |element: &Matrix3<f64>| (h - element).norm();
                elements.iter().map(from).fold(from(&Matrix3::identity()), f64::min)
            }
        }
    }
}

/// How far a change of reference with the gradients K at some places is from leaving a homogeneous configuration
/// homogeneous: the largest distance of K(X) K(Y)⁻¹ from the symmetry group. Zero where it does.
///
/// # Errors
/// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] unless det K ≠ 0, and for an axis without direction.
///
/// # Accuracy
/// A few ulp × the condition number of K.
///
/// # Example
/// A block bent without strain of its points would turn them: for an isotropic solid the bent reference is homogeneous, too;
/// for a crystal it is not.
/// ```
/// use nalgebra::{Matrix3, Rotation3};
/// use piola_solutions::homogeneous::{MaterialSymmetry, configuration_residual};
/// let turned = [0.0, 0.4, 0.9].map(|angle| *Rotation3::from_axis_angle(&nalgebra::Vector3::z_axis(), angle).matrix());
/// assert!(configuration_residual(&turned, &MaterialSymmetry::Orthogonal)? < 1e-15);
/// assert!(0.1 < configuration_residual(&turned, &MaterialSymmetry::Finite(vec![-Matrix3::identity()]))?);
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
///
/// # Source
/// W(22.3).
pub fn configuration_residual(gradients: &[Matrix3<f64>], group: &MaterialSymmetry) -> Result<f64, SolutionsError> {
    if let MaterialSymmetry::About(axis) = group {
        check_bound("|e|", axis.norm(), "0 < |e|", 0.0 < axis.norm())?;
    }
    let mut worst = 0.0_f64;
    for gradient in gradients {
        check_finite("K", gradient.as_slice())?;
        let determinant = gradient.determinant();
        check_bound("det K", determinant, "det K ≠ 0", 0.0 < determinant.abs())?;
    }
    for (i, at) in gradients.iter().enumerate() {
        for from in &gradients[..i] {
            worst = worst.max(group.distance(&(at * inverse(from)?)));
        }
    }
    Ok(worst)
}
