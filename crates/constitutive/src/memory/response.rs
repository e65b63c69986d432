//! A step of a viscoelastic solid as a body that is pulled and sheared.

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{DisplacementGradient, FirstPiola};

use super::{PronyStep, Viscoelastic, ViscoelasticState};
use crate::ConstitutiveError;
use crate::homogeneous::Response;
use crate::solids::Hyperelastic;

/// What a viscoelastic solid answers at the end of a step: [`Viscoelastic::response`].
#[derive(Clone, Copy, Debug)]
pub struct ViscoelasticResponse<'a, E, D> {
    solid: &'a Viscoelastic<E, D>,
    state: &'a ViscoelasticState,
    step: &'a PronyStep,
}

impl<E: Hyperelastic, D: Hyperelastic> Viscoelastic<E, D> {
    /// What the solid answers at the end of a step to the deformations that may be there, as
    /// [`equilibrium`](crate::homogeneous::equilibrium) asks it: sides that are free, forces that are held.
    ///
    /// # Errors
    /// Those of [`check_state`](Self::check_state) and [`check_step`](Self::check_step).
    ///
    /// # Example
    /// Creep of an incompressible bar under a force that is applied at once and held. At last only the law at rest bears it.
    /// ```
    /// use piola_constitutive::homogeneous::{Control, Controls, equilibrium};
    /// use piola_constitutive::memory::{Prony, PronyTerm, Viscoelastic};
    /// use piola_constitutive::solids::{IncompressibleSolid, isochoric::NeoHookean};
    /// use piola_continuum::DisplacementGradient;
    /// let rubber = IncompressibleSolid::new(NeoHookean::new(2.0)?); // μ of fast loading; half of it relaxes
    /// let solid = Viscoelastic::relaxing(rubber, Prony::new(vec![PronyTerm { weight: 0.5, time: 1.0 }])?)?;
    /// let pulled = Controls::axial([Control::Nominal(1.75), Control::FREE, Control::FREE])?;
    /// let (mut state, mut bar) = (solid.at_rest(), DisplacementGradient::zero());
    /// for duration in [0.0].into_iter().chain([0.1; 600]) {
    ///     let step = solid.prony().step(duration)?;
    ///     bar = equilibrium(&solid.response(&state, &step)?, &pulled, &bar)?.deformation;
    ///     solid.advance(&mut state, &bar, &step);
    /// }
    /// let stretch = 1.0 + bar.matrix()[(0, 0)];
    /// assert!((stretch - 2.0).abs() < 1e-9); // P = μ (λ − λ⁻²) with μ = 1
    /// # Ok::<(), piola_constitutive::ConstitutiveError>(())
    /// ```
    pub fn response<'a>(
        &'a self,
        state: &'a ViscoelasticState,
        step: &'a PronyStep,
    ) -> Result<ViscoelasticResponse<'a, E, D>, ConstitutiveError> {
        self.check_state(state)?;
        self.check_step(step)?;
        Ok(ViscoelasticResponse { solid: self, state, step })
    }
}

impl<E: Hyperelastic, D: Hyperelastic> Response for ViscoelasticResponse<'_, E, D> {
    fn admits(&self, deformation: &DisplacementGradient) -> Result<(), ConstitutiveError> {
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
