//! A film that runs down a wall.

use std::f64::consts::FRAC_PI_2;

use piola_fluids::{FlowMoment, ViscometricFluid};

use super::declaration::flow_of_numbers;
use super::wall::{Sheared, generalised_reynolds, normal_functions, plug};
use crate::error::{check_bound, check_finite};
use crate::inverse::{Wanted, drive_error, solve};
use crate::{Estimate, Stresses, Validity, ViscometryError, Warning};

flow_of_numbers! {
    /// A film with a free surface that runs steadily down an inclined wall under its weight; x is the distance from the wall.
    ///
    /// ```text
    /// T₁₂ = f (δ − x)      f = ρ g sin β      v(x) = ∫ ζ(f η) dη from δ − x to δ      Q = (1/f²) ∫ s ζ(s) ds from 0 to f δ
    /// T₁₁ = −ρ g cos β (δ − x)      T₃₃ = T₁₁ − σ₁      T₂₂ = T₃₃ + σ₂
    /// ```
    /// | symbol | number | unit | bounds |
    /// |---|---|---|---|
    /// | δ | `thickness` | m | 0 < δ |
    /// | ρ | `density` | kg/m³ | 0 < ρ |
    /// | g | `gravity` | m/s² | 0 ≤ g |
    /// | β | `inclination` | rad | 0 ≤ β ≤ π/2, that of a vertical wall |
    ///
    /// The discharge is per width. The pressure is counted from that of the air. With slip `v_s` is added to v.
    ///
    /// # Accuracy
    /// As [`Channel`](crate::Channel).
    ///
    /// # Example
    /// ```
    /// use piola_fluids::Newtonian;
    /// use piola_viscometry::FallingFilm;
    /// let syrup = Newtonian::new(10.0)?;
    /// let film = FallingFilm::new(0.01, 1000.0, 10.0, std::f64::consts::FRAC_PI_2)?;
    /// let discharge = film.discharge(&syrup)?; // ρ g δ³/(3 μ)
    /// assert!((discharge.value - 1e-3 / 3.0).abs() < 1e-17);
    /// let again = FallingFilm::with_discharge(discharge.value, 1000.0, 10.0, std::f64::consts::FRAC_PI_2, &syrup)?;
    /// assert!((again.thickness() - 0.01).abs() < 1e-16);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// Half of a channel, W(23.39)–W(23.49), with c = ρ g sin β.
    pub struct FallingFilm("falling film") {
        /// δ, m.
        thickness: "0 < δ" => 0.0 < thickness,
        /// ρ, kg/m³.
        density: "0 < ρ" => 0.0 < density,
        /// g, m/s².
        gravity: "0 ≤ g" => 0.0 <= gravity,
        /// β, rad.
        inclination: "0 ≤ β ≤ π/2" => 0.0 <= inclination && inclination <= FRAC_PI_2,
    }
}

impl FallingFilm {
    /// The film, of a thickness to be found, with a given discharge per width, m²/s.
    ///
    /// # Errors
    /// As [`new`](Self::new); [`ViscometryError::OutOfBounds`] unless 0 < Q; [`ViscometryError::NoDrive`]; what the fluid refuses.
    pub fn with_discharge<F: ViscometricFluid + ?Sized>(
        discharge: f64,
        density: f64,
        gravity: f64,
        inclination: f64,
        fluid: &F,
    ) -> Result<Self, ViscometryError> {
        let unit = Self::new(1.0, density, gravity, inclination)?;
        check_bound(Self::NAME, "discharge", discharge, "0 < Q", 0.0 < discharge)?;
        let weight = unit.wall_stress();
        let wanted = Wanted { flow: Self::NAME, quantity: "discharge", value: discharge };
        if weight <= 0.0 {
            return Err(ViscometryError::NoDrive { flow: Self::NAME, quantity: "discharge", value: discharge });
        }
        let yields = fluid.yield_stress();
        // A Newtonian fluid of the viscosity at 1/s: Q = f δ³/(3 μ).
        let start = weight * (3.0 * discharge * (fluid.shear_stress(1.0) - yields) / weight).cbrt();
        let excess = solve(wanted, start, |excess| {
            let wall = yields + excess;
            let film = Self { thickness: wall / weight, ..unit };
            let slope = film.thickness * fluid.shear_rate(wall)? / weight;
            Ok((film.discharge(fluid)?.value, slope))
        })?;
        Self::new((yields + excess) / weight, density, gravity, inclination)
    }

    /// Error bound of the thickness, m, found by [`with_discharge`](Self::with_discharge) for this discharge per width, m²/s:
    /// (|Q(δ) − Q| + δQ)/(dQ/dδ), infinite where the slope is zero, as below a yield stress.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn thickness_error<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        discharge: f64,
    ) -> Result<f64, ViscometryError> {
        check_finite(Self::NAME, "discharge", discharge)?;
        let least = fluid.yield_stress() * (self.thickness / self.wall_stress());
        drive_error(self.thickness, least, discharge, |thickness| Self { thickness, ..*self }.discharge(fluid))
    }

    /// f δ, Pa: T₁₂ at the wall.
    #[must_use]
    pub fn wall_stress(&self) -> f64 {
        self.density * self.gravity * self.inclination.sin() * self.thickness
    }

    /// T₁₂, Pa, at the distance `x`, m, from the wall.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 ≤ x ≤ δ.
    pub fn shear_stress(&self, x: f64) -> Result<f64, ViscometryError> {
        check_bound(Self::NAME, "x", x, "0 ≤ x ≤ δ", 0.0 <= x && x <= self.thickness)?;
        Ok(self.wall_stress() * ((self.thickness - x) / self.thickness))
    }

    /// dv/dx = ζ(T₁₂), 1/s.
    ///
    /// # Errors
    /// As [`shear_stress`](Self::shear_stress); what the fluid refuses.
    pub fn shear_rate<F: ViscometricFluid + ?Sized>(&self, fluid: &F, x: f64) -> Result<f64, ViscometryError> {
        Ok(fluid.shear_rate(self.shear_stress(x)?)?)
    }

    /// v, m/s, at the distance `x`, m, from the wall.
    ///
    /// # Errors
    /// As [`shear_rate`](Self::shear_rate).
    pub fn velocity<F: ViscometricFluid + ?Sized>(&self, fluid: &F, x: f64) -> Result<Estimate, ViscometryError> {
        self.shear_stress(x)?;
        self.sheared().velocity(fluid, x / self.thickness)
    }

    /// Q per width, m²/s.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn discharge<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        Ok(self.mean_velocity(fluid)?.scaled(self.thickness))
    }

    /// Q/δ, m/s.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn mean_velocity<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        self.sheared().mean_velocity(fluid, FlowMoment::First)
    }

    /// The thickness, m, of the layer below the surface that moves rigidly, at most δ; zero without a yield stress.
    pub fn plug_thickness<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> f64 {
        plug(self.thickness, self.wall_stress(), fluid.yield_stress())
    }

    /// The stresses, Pa, at the distance `x`, m, from the wall.
    ///
    /// # Errors
    /// As [`shear_rate`](Self::shear_rate).
    pub fn stresses<F: ViscometricFluid + ?Sized>(&self, fluid: &F, x: f64) -> Result<Stresses, ViscometryError> {
        let shear = self.shear_stress(x)?;
        let sigma = if F::NORMAL_STRESSES { normal_functions(fluid, fluid.shear_rate(shear)?) } else { [0.0; 2] };
        let weight = self.density * self.gravity * self.inclination.cos() * (self.thickness - x);
        let across = Estimate::rounded(-weight);
        Ok(Stresses::from_gradient(shear, across.value, sigma, across.error))
    }

    /// f Q, W/m²: the power that is dissipated per area of the wall, at the wall included.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn dissipation<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        Ok(self.mean_velocity(fluid)?.scaled(self.wall_stress()))
    }

    /// The generalised Reynolds number 3 ρ V²/`τ_w` (ρ V δ/μ), and whether long waves grow: from 5/6 cot β, the threshold of a
    /// Newtonian fluid. On a vertical wall they always do.
    ///
    /// # Errors
    /// What the fluid refuses.
    ///
    /// # Source
    /// C.-S. Yih, *Phys. Fluids* 6 (1963) 321.
    pub fn validity<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Validity, ViscometryError> {
        let mean = self.mean_velocity(fluid)?.value;
        let reynolds = generalised_reynolds(3.0, self.density, mean, self.wall_stress());
        let critical = 5.0 / 6.0 * (self.inclination.cos() / self.inclination.sin());
        let waves = (critical < reynolds, Warning::Waves { reynolds, critical });
        Ok(Validity::new(reynolds, [waves, (false, Warning::Waves { reynolds, critical })]))
    }

    fn sheared(&self) -> Sheared {
        Sheared { flow: Self::NAME, length: self.thickness, wall_stress: self.wall_stress(), slip: self.slip }
    }
}
