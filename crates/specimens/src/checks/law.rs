//! Laws as the checks see them.

use nalgebra::Matrix3;
use piola_continuum::{Deformation, DeformationGradient};
use piola_numerics::linear::matrix3::{determinant, rows_of};
use piola_solids::Hyperelastic;

use super::Sampler;

/// An elastic response T = G(F): the stress depends on the present deformation alone, W(18.1).
///
/// Any closure from F to T is one. Nothing is assumed of it: neither symmetry of T nor indifference.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_specimens::checks::Elastic;
/// let law = |f: &Matrix3<f64>| f * f.transpose();
/// assert_eq!(law.cauchy(&Matrix3::identity()), Matrix3::identity());
/// ```
pub trait Elastic {
    /// T of F with 0 < det F, Pa.
    #[must_use]
    fn cauchy(&self, gradient: &Matrix3<f64>) -> Matrix3<f64>;

    /// True if the law has a stress at F. Where it refuses, nothing is claimed of it, and samples there are left out and
    /// counted.
    #[must_use]
    fn answers(&self, _gradient: &Matrix3<f64>) -> bool {
        true
    }

    /// True if the body keeps its volume: then all samples are isochoric.
    #[must_use]
    fn is_incompressible(&self) -> bool {
        false
    }
}

impl<G: Fn(&Matrix3<f64>) -> Matrix3<f64>> Elastic for G {
    fn cauchy(&self, gradient: &Matrix3<f64>) -> Matrix3<f64> {
        self(gradient)
    }
}

/// The response T = P Fᵀ/J of a law with an energy, not symmetrised. NaN where the law has no answer.
#[derive(Clone, Copy, Debug)]
pub struct Stored<'a, L>(
    /// The law.
    pub &'a L,
);

impl<L: Hyperelastic> Elastic for Stored<'_, L> {
    fn cauchy(&self, gradient: &Matrix3<f64>) -> Matrix3<f64> {
        let nowhere = Matrix3::from_element(f64::NAN);
        let Ok(deformation) = DeformationGradient::new(*gradient) else { return nowhere };
        if self.0.check(&deformation).is_err() {
            return nowhere;
        }
        self.0.first_piola(&deformation).0 * gradient.transpose() / deformation.jacobian()
    }

    fn answers(&self, gradient: &Matrix3<f64>) -> bool {
        DeformationGradient::new(*gradient).is_ok_and(|deformation| self.0.check(&deformation).is_ok())
    }

    fn is_incompressible(&self) -> bool {
        self.0.is_incompressible()
    }
}

/// A deformation gradient that the body can have.
pub(super) fn drawn(law: &impl Elastic, sampler: &mut Sampler, strain: f64) -> Matrix3<f64> {
    let gradient = sampler.gradient(strain);
    if law.is_incompressible() { isochoric(gradient) } else { gradient }
}

/// F without its change of volume.
pub(super) fn isochoric(gradient: Matrix3<f64>) -> Matrix3<f64> {
    gradient / jacobian(&gradient).cbrt()
}

/// P = J T F⁻ᵀ = T Cof F, T not taken as symmetric.
pub(super) fn first_piola(law: &impl Elastic, gradient: &Matrix3<f64>) -> Matrix3<f64> {
    law.cauchy(gradient) * cofactor(gradient)
}

/// Cof F.
pub(super) fn cofactor(gradient: &Matrix3<f64>) -> Matrix3<f64> {
    let rows = piola_tensor::internal::rows::cofactor(rows_of(gradient));
    Matrix3::from(rows).transpose()
}

/// det F.
pub(super) fn jacobian(gradient: &Matrix3<f64>) -> f64 {
    determinant(rows_of(gradient))
}
