//! Shear between a plate and a blunt cone that turns on it.

use std::f64::consts::{FRAC_PI_2, PI};

use piola_fluids::ViscometricFluid;

use super::declaration::flow_of_numbers;
use super::turning::{Gap, Turning};
use super::wall::{check_density, finite, normal_functions, rising_stress, secondary_flow};
use crate::error::{check_bound, check_finite};
use crate::inverse::drive_error;
use crate::{Estimate, Stresses, Validity, ViscometryError, WallSlip, Warning};

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
    /// T₃₃ at the rim. With slip at both surfaces the rate is no longer everywhere the same: k(r) is the root of
    /// α r k + 2 `v_s(τ(k))` = Ω r, M = 2 π ∫ r² τ dr, F = π ∫ r N₁ dr and ∂T₃₃/∂r = (σ₁ + σ₂)/r.
    ///
    /// # Accuracy
    /// That of τ and N₁, with slip 1e-10, with the bound in the answer; of the model, α².
    ///
    /// # Example
    /// ```
    /// use piola_fluids::Newtonian;
    /// use piola_viscometry::ConeAndPlate;
    /// let oil = Newtonian::new(0.75)?;
    /// let rheometer = ConeAndPlate::new(0.5, 0.0625, 0.75)?;
    /// assert_eq!(rheometer.nominal_shear_rate(), 12.0);
    /// assert!((rheometer.torque(&oil)?.value - 0.75 * std::f64::consts::PI).abs() < 1e-15);
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

    /// The flow of a fluid that slips at cone and plate under a given torque, N m; at rest without a torque.
    ///
    /// # Errors
    /// As [`with_torque`](Self::with_torque); [`ViscometryError::NoDrive`].
    pub fn with_slip_and_torque<F: ViscometricFluid + ?Sized>(
        radius: f64,
        angle: f64,
        slip: WallSlip,
        torque: f64,
        fluid: &F,
    ) -> Result<Self, ViscometryError> {
        if slip.is_none() {
            return Self::with_torque(radius, angle, torque, fluid);
        }
        let still = Self::new(radius, angle, 0.0)?.with_slip(slip);
        check_finite(Self::NAME, "torque", torque)?;
        let speed = still.turning().speed_of(fluid, torque)?.copysign(torque);
        Ok(Self::new(radius, angle, speed)?.with_slip(slip))
    }

    /// Error bound of the angular velocity, rad/s, found by [`with_torque`](Self::with_torque) for this torque, N m:
    /// (|M(Ω) − M| + δM)/(dM/dΩ), infinite where the torque does not rise.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn speed_error<F: ViscometricFluid + ?Sized>(&self, fluid: &F, torque: f64) -> Result<f64, ViscometryError> {
        check_finite(Self::NAME, "torque", torque)?;
        drive_error(self.speed, 0.0, torque, |speed| Self { speed, ..*self }.torque(fluid))
    }

    /// Ω/α, 1/s: the rate, everywhere the same, of a fluid that sticks.
    #[must_use]
    pub const fn nominal_shear_rate(&self) -> f64 {
        self.speed / self.angle
    }

    /// k, 1/s, at the distance `r`, m, from the axis; Ω/α everywhere unless the fluid slips.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 < r ≤ R; what the fluid refuses, where it slips.
    pub fn shear_rate<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<f64, ViscometryError> {
        self.check(r)?;
        if self.slip.is_none() { Ok(self.nominal_shear_rate()) } else { self.turning().at(r)?.shear_rate(fluid) }
    }

    /// T₁₂, Pa, at the distance `r`, m, from the axis; the same everywhere unless the fluid slips, zero at rest.
    ///
    /// # Errors
    /// As [`shear_rate`](Self::shear_rate); [`ViscometryError::NotIncreasing`] where τ falls; [`ViscometryError::NotFinite`] beyond the
    /// range of numbers.
    pub fn shear_stress<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<f64, ViscometryError> {
        self.check(r)?;
        if !self.slip.is_none() {
            return self.turning().at(r)?.shear_stress(fluid);
        }
        self.nominal_shear_stress(fluid)
    }

    /// v, m/s, at the distance `r`, m, from the axis and at the share `height` of the gap there.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 < r ≤ R and 0 ≤ height ≤ 1; what the fluid refuses, where it slips.
    pub fn velocity<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        r: f64,
        height: f64,
    ) -> Result<f64, ViscometryError> {
        self.check(r)?;
        check_bound(Self::NAME, "height", height, "0 ≤ height ≤ 1", 0.0 <= height && height <= 1.0)?;
        if self.slip.is_none() {
            return Ok(self.speed * r * height);
        }
        let circle = self.turning().at(r)?;
        circle.velocity(fluid, circle.gap() * height)
    }

    /// M, N m.
    ///
    /// # Errors
    /// As [`shear_stress`](Self::shear_stress).
    pub fn torque<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        if !self.slip.is_none() {
            return self.turning().torque(fluid);
        }
        let torque = PI * self.radius.powi(3) * (2.0 / 3.0) * self.nominal_shear_stress(fluid)?;
        finite(Self::NAME, "torque", Estimate::rounded(torque))
    }

    /// F, N: what drives cone and plate apart, without inertia.
    ///
    /// # Errors
    /// [`ViscometryError::NotFinite`] beyond the range of numbers; what the fluid refuses, where it slips.
    pub fn thrust<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        if !F::NORMAL_STRESSES {
            return Ok(Estimate::ZERO);
        }
        if !self.slip.is_none() {
            let difference = |r: f64, rate: f64| r * (fluid.sigma2(rate) - fluid.sigma1(rate));
            return finite(Self::NAME, "thrust", self.turning().normal(fluid, 0.0, difference)?.scaled(PI));
        }
        let [sigma1, sigma2] = normal_functions(fluid, self.nominal_shear_rate());
        let size = 8.0 * f64::EPSILON * (sigma1.abs() + sigma2.abs());
        let difference = Estimate { value: sigma2 - sigma1, error: size };
        finite(Self::NAME, "thrust", difference.scaled(0.5 * PI * self.radius * self.radius))
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

    /// The stresses, Pa, at the distance `r`, m, from the axis.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 < r ≤ R; what the fluid refuses, where it slips.
    pub fn stresses<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<Stresses, ViscometryError> {
        self.check(r)?;
        let shear = self.shear_stress(fluid, r)?;
        if !F::NORMAL_STRESSES {
            return Ok(Stresses::from_gradient(shear, 0.0, [0.0; 2], 0.0));
        }
        let sigma = normal_functions(fluid, self.shear_rate(fluid, r)?.abs());
        if !self.slip.is_none() {
            let gained = self.turning().normal(fluid, r, |r, rate| (fluid.sigma1(rate) + fluid.sigma2(rate)) / r)?;
            return Ok(Stresses::from_gradient(shear, sigma[0] - gained.value, sigma, gained.error));
        }
        let across = sigma[0] + (sigma[1] + sigma[0]) * (r / self.radius).ln();
        Ok(Stresses::from_gradient(shear, across, sigma, 0.0))
    }

    /// M Ω, W.
    ///
    /// # Errors
    /// As [`torque`](Self::torque).
    pub fn dissipation<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        Ok(self.torque(fluid)?.scaled(self.speed))
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
        let (stress, rate) = (self.shear_stress(fluid, self.radius)?, self.shear_rate(fluid, self.radius)?);
        let depth = self.angle * self.radius;
        let (reynolds, secondary) = secondary_flow(density, self.speed, depth, rate, stress);
        Ok(Validity::new(
            reynolds,
            [secondary, (GREATEST < self.angle, Warning::WideCone { angle: self.angle, greatest: GREATEST })],
        ))
    }

    /// τ(Ω/α); zero at rest.
    fn nominal_shear_stress<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<f64, ViscometryError> {
        if self.speed.abs() > 0.0 { rising_stress(Self::NAME, fluid, self.nominal_shear_rate()) } else { Ok(0.0) }
    }

    const fn turning(&self) -> Turning {
        let gap = Gap::Cone(self.angle);
        Turning { flow: Self::NAME, radius: self.radius, gap, speed: self.speed, slip: self.slip }
    }

    fn check(&self, r: f64) -> Result<(), ViscometryError> {
        check_bound(Self::NAME, "r", r, "0 < r ≤ R", 0.0 < r && r <= self.radius)
    }
}
