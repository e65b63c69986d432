//! Shear between two walls, one of which moves.

use piola_fluids::ViscometricFluid;
use piola_numerics::Dual;

use super::declaration::flow_of_numbers;
use super::wall::{check_density, normal_functions, rising_stress};
use crate::error::{check_bound, check_finite};
use crate::inverse::{Wanted, solve};
use crate::{Stresses, Validity, ViscometryError, Warning};

flow_of_numbers! {
    /// Simple shear between the wall x₁ = 0, at rest, and the wall x₁ = h, which moves along x₂.
    ///
    /// ```text
    /// k = V/h      T₁₂ = τ(k)      T₁₁ = 0      T₃₃ = −σ₁      T₂₂ = T₃₃ + σ₂      with slip: V = h k + 2 v_s(τ)
    /// ```
    /// | symbol | number | unit | bounds |
    /// |---|---|---|---|
    /// | h | `gap` | m | 0 < h |
    /// | V | `speed` | m/s | finite |
    ///
    /// # Accuracy
    /// That of τ; with slip the shear rate is found to 1e-14.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::Newtonian;
    /// use piola_viscometry::{PlaneCouette, WallSlip};
    /// let oil = Newtonian::new(0.5)?;
    /// let flow = PlaneCouette::new(0.25, 1.0)?;
    /// assert_eq!(flow.shear_stress(&oil)?, 2.0);
    /// let slipping = flow.with_slip(WallSlip::new(0.25, 1.0)?); // V = h τ/μ + 2 b τ
    /// assert!((slipping.shear_stress(&oil)? - 1.0).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// W(23.13)–W(23.24).
    pub struct PlaneCouette("plane Couette flow") {
        /// h, m.
        gap: "0 < h" => 0.0 < gap,
        /// V, m/s.
        speed: "V is finite" => speed.is_finite(),
    }
}

impl PlaneCouette {
    /// The flow of a fluid under a given shear stress, Pa; at rest up to the yield stress.
    ///
    /// # Errors
    /// As [`new`](Self::new); what the fluid refuses.
    pub fn with_shear_stress<F: ViscometricFluid + ?Sized>(
        gap: f64,
        shear_stress: f64,
        fluid: &F,
    ) -> Result<Self, ViscometryError> {
        check_finite(Self::NAME, "shear_stress", shear_stress)?;
        Self::new(gap, gap * fluid.shear_rate(shear_stress)?)
    }

    /// k, 1/s.
    ///
    /// # Errors
    /// What the fluid refuses, where it slips.
    pub fn shear_rate<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<f64, ViscometryError> {
        if self.slip.is_none() {
            return Ok(self.speed / self.gap);
        }
        Ok(fluid.shear_rate(self.shear_stress(fluid)?)?)
    }

    /// T₁₂, Pa; zero at rest.
    ///
    /// # Errors
    /// [`ViscometryError::NotIncreasing`] where τ falls; [`ViscometryError::NotFinite`] beyond the range of numbers; what the fluid
    /// refuses, where it slips.
    pub fn shear_stress<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<f64, ViscometryError> {
        let target = self.speed.abs();
        let nominal = target / self.gap;
        if nominal <= 0.0 {
            return Ok(0.0);
        }
        if self.slip.is_none() {
            return rising_stress(Self::NAME, fluid, self.speed / self.gap);
        }
        let yields = fluid.yield_stress();
        if target <= 2.0 * self.slip.speed(yields) {
            return Ok(self.slip.stress(0.5 * target).copysign(self.speed));
        }
        let wanted = Wanted { flow: Self::NAME, quantity: "speed", value: target };
        let excess = solve(wanted, fluid.shear_stress(nominal) - yields, |excess| {
            let stress = yields + excess;
            let rate = fluid.shear_rate(Dual::variable(stress))?;
            let speed = self.gap * rate.value + 2.0 * self.slip.speed(stress);
            Ok((speed, self.gap * rate.tangent + 2.0 * self.slip.slope(stress)))
        })?;
        Ok((yields + excess).copysign(self.speed))
    }

    /// v, m/s, at `x1`, m.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 ≤ x₁ ≤ h; what the fluid refuses, where it slips.
    pub fn velocity<F: ViscometricFluid + ?Sized>(&self, fluid: &F, x1: f64) -> Result<f64, ViscometryError> {
        check_bound(Self::NAME, "x1", x1, "0 ≤ x₁ ≤ h", 0.0 <= x1 && x1 <= self.gap)?;
        if self.slip.is_none() {
            return Ok(self.speed * (x1 / self.gap));
        }
        let stress = self.shear_stress(fluid)?;
        Ok(self.slip.speed(stress) + fluid.shear_rate(stress)? * x1)
    }

    /// The stresses, Pa, everywhere the same; the pressure is counted from T₁₁ = 0.
    ///
    /// # Errors
    /// As [`shear_rate`](Self::shear_rate).
    pub fn stresses<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Stresses, ViscometryError> {
        let shear = self.shear_stress(fluid)?;
        let sigma = if F::NORMAL_STRESSES { normal_functions(fluid, self.shear_rate(fluid)?) } else { [0.0; 2] };
        Ok(Stresses::from_gradient(shear, 0.0, sigma, 0.0))
    }

    /// τ V, W/m²: the power that is dissipated per area of a wall, at the walls included.
    ///
    /// # Errors
    /// As [`shear_stress`](Self::shear_stress).
    pub fn dissipation<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<f64, ViscometryError> {
        Ok(self.shear_stress(fluid)? * self.speed)
    }

    /// The Reynolds number ρ V h k/τ, and whether the flow of walls of this length, m, is laminar and far from their ends.
    ///
    /// Laminar up to 1440: 360 with half the speed and half the gap. Ends: at least ten gaps.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 < ρ and 0 < length; what the fluid refuses.
    ///
    /// # Source
    /// N. Tillmark, P. H. Alfredsson, *J. Fluid Mech.* 235 (1992) 89.
    pub fn validity<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        density: f64,
        length: f64,
    ) -> Result<Validity, ViscometryError> {
        const CRITICAL: f64 = 1440.0;
        const LEAST: f64 = 10.0;
        check_density(Self::NAME, density)?;
        check_bound(Self::NAME, "length", length, "0 < length", 0.0 < length)?;
        let (stress, rate) = (self.shear_stress(fluid)?, self.shear_rate(fluid)?);
        let still = self.speed.abs() <= 0.0;
        let reynolds = if still { 0.0 } else { density * self.speed.abs() * self.gap * (rate / stress) };
        let ratio = length / self.gap;
        Ok(Validity::new(
            reynolds,
            [
                (CRITICAL < reynolds, Warning::Turbulence { reynolds, critical: CRITICAL }),
                (ratio < LEAST, Warning::Ends { ratio, least: LEAST }),
            ],
        ))
    }
}
