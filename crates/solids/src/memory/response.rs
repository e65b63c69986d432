//! A step of a viscoelastic solid as a body that is pulled and sheared.

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{DisplacementGradient, FirstPiola};

use super::{PronyStep, Viscoelastic, ViscoelasticState};
use crate::Hyperelastic;
use crate::Response;
use crate::SolidsError;

/// Stress and tangent of a viscoelastic solid at the end of a step: [`Viscoelastic::response`].
#[derive(Clone, Copy, Debug)]
pub struct ViscoelasticResponse<'a, E, D> {
    solid: &'a Viscoelastic<E, D>,
    state: &'a ViscoelasticState,
    step: &'a PronyStep,
}

impl<E: Hyperelastic, D: Hyperelastic> Viscoelastic<E, D> {
    /// The solid at the end of a step, as a function of the deformation there, as
    /// `piola_specimens::homogeneous::equilibrium` asks it: sides that are free, forces that are held.
    ///
    /// # Errors
    /// Those of [`check_state`](Self::check_state) and [`check_step`](Self::check_step).
    pub fn response<'a>(
        &'a self,
        state: &'a ViscoelasticState,
        step: &'a PronyStep,
    ) -> Result<ViscoelasticResponse<'a, E, D>, SolidsError> {
        self.check_state(state)?;
        self.check_step(step)?;
        Ok(ViscoelasticResponse { solid: self, state, step })
    }
}

impl<E: Hyperelastic, D: Hyperelastic> Response for ViscoelasticResponse<'_, E, D> {
    fn admits(&self, deformation: &DisplacementGradient) -> Result<(), SolidsError> {
        self.solid.check(deformation)
    }
    fn keeps_volume(&self) -> bool {
        self.solid.equilibrium().is_incompressible() || self.solid.overstress().is_incompressible()
    }
    fn stress(&self, deformation: &DisplacementGradient) -> FirstPiola {
        self.solid.first_piola(self.state, deformation, self.step)
    }
    fn stress_and_tangent(&self, deformation: &DisplacementGradient) -> (FirstPiola, FirstPiolaTangent) {
        self.solid.first_piola_and_tangent(self.state, deformation, self.step)
    }
}
