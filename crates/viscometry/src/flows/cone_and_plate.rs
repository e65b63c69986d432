//! Shear between a plate and a blunt cone that turns on it.

use std::f64::consts::{FRAC_PI_2, PI};

use piola_constitutive::fluids::ViscometricFluid;

use super::declaration::flow_of_numbers;
use super::wall::{check_density, normal_functions, secondary_flow};
use crate::error::{check_bound, check_finite};
use crate::{Stresses, Validity, ViscometryError, Warning};

flow_of_numbers! {
    /// The gap between a plate and a cone whose apex touches it, for a small angle: the shear rate is the same everywhere.
    ///
    /// ```text
    /// k = Ω/α      M = ⅔ π R³ τ(k)      F = ½ π R² N₁(k)
    /// T₁₁ = N₂ + (N₁ + 2 N₂) ln(r/R)      T₃₃ = T₁₁ − σ₁      T₂₂ = T₃₃ + σ₂
    /// ```
    /// | symbol | number | unit | bounds |
    /// |---|---|---|---|
    /// | R | `radius` | m | 0 < R |
    /// | α | `angle` between cone and plate | rad | 0 < α < π/2 |
    /// | Ω | `speed` | rad/s | finite |
    ///
    /// Direction 1 is from the plate to the cone, 2 that of the rotation, 3 radial; pressures are counted from that of the air, which meets
    /// T₃₃ at the rim.
    ///
    /// # Accuracy
    /// That of τ and N₁; of the model, α².
    ///
    /// # Example
    /// ```
    /// use piola_constitutive::fluids::Newtonian;
    /// use piola_viscometry::ConeAndPlate;
    /// let oil = Newtonian::new(0.75)?;
    /// let rheometer = ConeAndPlate::new(0.5, 0.0625, 0.75)?;
    /// assert_eq!(rheometer.shear_rate(), 12.0);
    /// assert!((rheometer.torque(&oil)? - 0.75 * std::f64::consts::PI).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// The functions of W(23.13)–W(23.24) in a sector; the balance of moments of thin layers.
    pub struct ConeAndPlate("cone and plate") {
        /// R, m.
        radius: "0 < R" => 0.0 < radius,
        /// α, rad.
        angle: "0 < α < π/2" => 0.0 < angle && angle < FRAC_PI_2,
        /// Ω, rad/s.
        speed: "Ω is finite" => speed.is_finite(),
    }
}

impl ConeAndPlate {
    /// The flow of a fluid under a given torque, N m; at rest up to the yield stress.
    ///
    /// # Errors
    /// As [`new`](Self::new); what the fluid refuses.
    pub fn with_torque<F: ViscometricFluid + ?Sized>(
        radius: f64,
        angle: f64,
        torque: f64,
        fluid: &F,
    ) -> Result<Self, ViscometryError> {
        let still = Self::new(radius, angle, 0.0)?;
        check_finite(Self::NAME, "torque", torque)?;
        let rate = fluid.shear_rate(1.5 * torque / (PI * still.radius.powi(3)))?;
        Self::new(radius, angle, rate * angle)
    }

    /// k = Ω/α, 1/s.
    #[must_use]
    pub const fn shear_rate(&self) -> f64 {
        self.speed / self.angle
    }

    /// T₁₂, Pa; zero at rest.
    ///
    /// # Errors
    /// [`ViscometryError::NotFinite`] beyond the range of numbers.
    pub fn shear_stress<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<f64, ViscometryError> {
        if self.speed.abs() <= 0.0 {
            return Ok(0.0);
        }
        let stress = fluid.shear_stress(self.shear_rate());
        check_finite(Self::NAME, "shear stress", stress)?;
        Ok(stress)
    }

    /// v, m/s, at the distance `r`, m, from the axis and at the share `height` of the gap there.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 < r ≤ R and 0 ≤ height ≤ 1.
    pub fn velocity(&self, r: f64, height: f64) -> Result<f64, ViscometryError> {
        self.check(r)?;
        check_bound(Self::NAME, "height", height, "0 ≤ height ≤ 1", 0.0 <= height && height <= 1.0)?;
        Ok(self.speed * r * height)
    }

    /// M, N m.
    ///
    /// # Errors
    /// As [`shear_stress`](Self::`shear_stress`).
    pub fn torque<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<f64, ViscometryError> {
        Ok(PI * self.radius.powi(3) * (2.0 / 3.0) * self.shear_stress(fluid)?)
    }

    /// F, N: what drives cone and plate apart, without inertia.
    pub fn thrust<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> f64 {
        let [sigma1, sigma2] = normal_functions(fluid, self.shear_rate());
        0.5 * PI * self.radius * self.radius * (sigma2 - sigma1)
    }

    /// −3 π ρ Ω² R⁴/40, N: what inertia adds to the thrust of any fluid whose velocity is that of the model.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 < ρ.
    ///
    /// # Source
    /// K. Walters, *Rheometry*, Chapman and Hall 1975.
    pub fn thrust_of_inertia(&self, density: f64) -> Result<f64, ViscometryError> {
        check_density(Self::NAME, density)?;
        Ok(-0.075 * PI * density * (self.speed * self.radius * self.radius).powi(2))
    }

    /// The stresses at the distance `r`, m, from the axis.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 < r ≤ R.
    pub fn stresses<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<Stresses, ViscometryError> {
        self.check(r)?;
        let sigma = normal_functions(fluid, self.shear_rate());
        let across = sigma[0] + (sigma[1] + sigma[0]) * (r / self.radius).ln();
        Ok(Stresses::from_gradient(self.shear_stress(fluid)?, across, sigma, 0.0))
    }

    /// M Ω, W.
    ///
    /// # Errors
    /// As [`torque`](Self::torque).
    pub fn dissipation<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<f64, ViscometryError> {
        Ok(self.torque(fluid)? * self.speed)
    }

    /// The Reynolds number ρ Ω α² R²/η, and whether a secondary flow or the width of the gap matter: each 1 % at Re = 4, α = 0.1.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 < ρ.
    ///
    /// # Source
    /// R. M. Turian, *Ind. Eng. Chem. Fundam.* 11 (1972) 361: the torque grows by 6·10⁻⁴ Re².
    pub fn validity<F: ViscometricFluid + ?Sized>(&self, fluid: &F, density: f64) -> Result<Validity, ViscometryError> {
        const GREATEST: f64 = 0.1;
        check_density(Self::NAME, density)?;
        let stress = self.shear_stress(fluid)?;
        let depth = self.angle * self.radius;
        let (reynolds, secondary) = secondary_flow(density, self.speed, depth, self.shear_rate(), stress);
        Ok(Validity::new(
            reynolds,
            [secondary, (GREATEST < self.angle, Warning::WideCone { angle: self.angle, greatest: GREATEST })],
        ))
    }

    fn check(&self, r: f64) -> Result<(), ViscometryError> {
        check_bound(Self::NAME, "r", r, "0 < r ≤ R", 0.0 < r && r <= self.radius)
    }
}
