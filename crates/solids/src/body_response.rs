//! Stress and tangent of a body at a deformation, whatever it remembers.

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{DisplacementGradient, FirstPiola};

use crate::Hyperelastic;
use crate::SolidsError;

/// The stress of a body at a deformation and its exact derivative, whatever the body remembers.
///
/// Every [`Hyperelastic`] law is one, and so is [a step of a viscoelastic solid](crate::memory::Viscoelastic::response). A law
/// of your own without an energy, such as an update of a plastic solid, implements this trait; equilibrium of its specimens
/// is then found by `piola_specimens::homogeneous::equilibrium`.
///
/// # Example
/// P = 3 ∇u: its tangent is 3 in all nine components.
/// ```
/// use piola_continuum::stress::tangents::FirstPiolaTangent;
/// use piola_continuum::{DisplacementGradient, FirstPiola};
/// use piola_solids::{Response, SolidsError};
/// use piola_tensor::FourthOrder;
/// struct Springs;
/// impl Response for Springs {
///     fn admits(&self, _: &DisplacementGradient) -> Result<(), SolidsError> {
///         Ok(())
///     }
///     fn stress_and_tangent(&self, deformation: &DisplacementGradient) -> (FirstPiola, FirstPiolaTangent) {
///         let tangent = FourthOrder::from_fn(|i, a, j, b| if (i, a) == (j, b) { 3.0 } else { 0.0 });
///         (FirstPiola(*deformation.matrix() * 3.0), FirstPiolaTangent(tangent))
///     }
/// }
/// assert_eq!(Springs.stress(&DisplacementGradient::simple_shear(0.5)?).0[(1, 0)], 1.5);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
pub trait Response {
    /// Refuses deformations at which the body has no answer.
    ///
    /// # Errors
    /// Those of its laws.
    fn admits(&self, deformation: &DisplacementGradient) -> Result<(), SolidsError>;

    /// True if the body keeps its volume: its pressure is then an unknown beside the deformation.
    ///
    /// During the iteration the volume may change: [`admits`](Self::admits) is then called with J^(−⅓) F, stress and tangent
    /// with F itself.
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
    fn admits(&self, deformation: &DisplacementGradient) -> Result<(), SolidsError> {
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
