//! What a homogeneous test asks of a body.

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{DisplacementGradient, FirstPiola};

use crate::ConstitutiveError;
use crate::solids::Hyperelastic;

/// What a body answers to a deformation, whatever it remembers: the stress and its exact derivative.
///
/// Every [`Hyperelastic`] law is one, and so is [a step of a viscoelastic solid](crate::memory::Viscoelastic::response). A law of
/// your own that has no energy, an update of a plastic solid say, is pulled and sheared by
/// [`equilibrium`](super::equilibrium) once it says these.
///
/// # Example
/// A stress that is linear in ∇u and has no energy, as its tangent is not symmetric.
/// ```
/// use nalgebra::Matrix3;
/// use piola_constitutive::ConstitutiveError;
/// use piola_constitutive::homogeneous::{Controls, Response, equilibrium};
/// use piola_continuum::stress::tangents::FirstPiolaTangent;
/// use piola_continuum::tensor::FourthOrder;
/// use piola_continuum::{Deformation, DisplacementGradient, FirstPiola};
/// struct Linear(FourthOrder);
/// impl Response for Linear {
///     fn admits(&self, _: &DisplacementGradient) -> Result<(), ConstitutiveError> {
///         Ok(())
///     }
///     fn stress_and_tangent(&self, deformation: &DisplacementGradient) -> (FirstPiola, FirstPiolaTangent) {
///         let stress = self.0.contract(deformation.displacement_rows());
///         (FirstPiola(Matrix3::from_fn(|i, j| stress[i][j])), FirstPiolaTangent(self.0))
///     }
/// }
/// // P₁₁ = 4 u₁₁ + u₂₂ + u₃₃, P₂₂ = 2 u₁₁ + 4 u₂₂ …
/// let mut c = FourthOrder::from_fn(|i, a, j, b| if (i, a) == (j, b) { 4.0 } else { 0.0 });
/// (c.components[0][4], c.components[0][8], c.components[4][0], c.components[8][0]) = (1.0, 1.0, 2.0, 2.0);
/// let bar = equilibrium(&Linear(c), &Controls::uniaxial(1.25)?, &DisplacementGradient::zero())?;
/// assert_eq!((bar.deformation.matrix()[(1, 1)], bar.first_piola.0[(0, 0)]), (-0.125, 0.75));
/// # Ok::<(), ConstitutiveError>(())
/// ```
pub trait Response {
    /// Refuses deformations at which the body has no answer.
    ///
    /// # Errors
    /// Those of its laws.
    fn admits(&self, deformation: &DisplacementGradient) -> Result<(), ConstitutiveError>;

    /// Whether the body keeps its volume: its pressure is then sought beside the deformation.
    ///
    /// On the way the volume may change. [`admits`](Self::admits) is then asked about the change of shape, J^(−⅓) F, while stress
    /// and tangent are asked for at F itself.
    fn keeps_volume(&self) -> bool {
        false
    }

    /// P, Pa.
    fn stress(&self, deformation: &DisplacementGradient) -> FirstPiola {
        self.stress_and_tangent(deformation).0
    }

    /// (P, ∂P/∂F), Pa.
    fn stress_and_tangent(&self, deformation: &DisplacementGradient) -> (FirstPiola, FirstPiolaTangent);
}

impl<L: Hyperelastic> Response for L {
    fn admits(&self, deformation: &DisplacementGradient) -> Result<(), ConstitutiveError> {
        self.check(deformation)
    }
    fn keeps_volume(&self) -> bool {
        self.is_incompressible()
    }
    fn stress(&self, deformation: &DisplacementGradient) -> FirstPiola {
        self.first_piola(deformation)
    }
    fn stress_and_tangent(&self, deformation: &DisplacementGradient) -> (FirstPiola, FirstPiolaTangent) {
        self.first_piola_and_tangent(deformation)
    }
}
