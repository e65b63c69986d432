//! What a homogeneous test asks of a body.

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{DisplacementGradient, FirstPiola};

use crate::Hyperelastic;
use crate::SolidsError;

/// What a body answers to a deformation, whatever it remembers: the stress and its exact derivative.
///
/// Every [`Hyperelastic`] law is one, and so is [a step of a viscoelastic solid](crate::memory::Viscoelastic::response). A law of
/// your own that has no energy, an update of a plastic solid say, is pulled and sheared by
/// `piola_specimens::homogeneous::equilibrium` once it says these.
pub trait Response {
    /// Refuses deformations at which the body has no answer.
    ///
    /// # Errors
    /// Those of its laws.
    fn admits(&self, deformation: &DisplacementGradient) -> Result<(), SolidsError>;

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
