//! Shear between two discs, one of which turns.

use std::f64::consts::PI;

use piola_fluids::ViscometricFluid;

use super::declaration::flow_of_numbers;
use super::turning::{Gap, Turning};
use super::wall::{check_density, finite, normal_functions, rising_stress, secondary_flow};
use crate::error::{check_bound, check_finite};
use crate::inverse::{Wanted, drive_error, solve};
use crate::quadrature::rate_integral;
use crate::{Estimate, Stresses, Validity, ViscometryError, WallSlip, Warning};

flow_of_numbers! {
    /// The gap between two parallel discs, one of which turns; the shear rate grows with the radius.
    ///
    /// ```text
    /// k = Ω r/h      M = 2 π (R/k_R)³ ∫ k² τ dk      F = π (R/k_R)² ∫ k (N₁ − N₂) dk      from 0 to k_R = Ω R/h
    /// T₃₃ = −∫ᵣᴿ σ₂/ξ dξ      T₁₁ = T₃₃ + σ₁      T₂₂ = T₃₃ + σ₂
    /// ```
    /// | symbol | number | unit | bounds |
    /// |---|---|---|---|
    /// | R | `radius` | m | 0 < R |
    /// | h | `gap` | m | 0 < h |
    /// | Ω | `speed` | rad/s | finite |
    ///
    /// Direction 1 is from disc to disc, 2 that of the rotation, 3 radial; pressures are counted from that of the air, which meets T₃₃ at
    /// the rim. With slip at both discs k(r) is the root of h k + 2 `v_s(τ(k))` = Ω r, and M = 2 π ∫ r² τ dr,
    /// F = π ∫ r (N₁ − N₂) dr over the discs.
    ///
    /// # Accuracy
    /// 1e-12, with the bound in the answer; with slip 1e-10.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::Newtonian;
    /// use piola_viscometry::ParallelPlates;
    /// let oil = Newtonian::new(0.75)?;
    /// let discs = ParallelPlates::new(0.5, 0.125, 0.75)?;
    /// assert_eq!(discs.rim_shear_rate(), 3.0);
    /// let torque = discs.torque(&oil)?; // π μ Ω R⁴/(2 h)
    /// assert!((torque.value - 0.140625 * std::f64::consts::PI).abs() <= torque.error);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// The functions of W(23.13)–W(23.24) on circles; the balance of moments of thin layers.
    pub struct ParallelPlates("parallel plates") {
        /// R, m.
        radius: "0 < R" => 0.0 < radius,
        /// h, m.
        gap: "0 < h" => 0.0 < gap,
        /// Ω, rad/s.
        speed: "Ω is finite" => speed.is_finite(),
    }
}

impl ParallelPlates {
    /// The flow of a fluid under a given torque, N m; at rest up to that of the yield stress.
    ///
    /// # Errors
    /// As [`new`](Self::new); [`ViscometryError::NoDrive`]; what the fluid refuses.
    pub fn with_torque<F: ViscometricFluid + ?Sized>(
        radius: f64,
        gap: f64,
        torque: f64,
        fluid: &F,
    ) -> Result<Self, ViscometryError> {
        let still = Self::new(radius, gap, 0.0)?;
        check_finite(Self::NAME, "torque", torque)?;
        // The mean of k² τ over k_R³.
        let stress = torque.abs() / (2.0 * PI * still.radius.powi(3));
        let yields = fluid.yield_stress();
        let excess = stress - yields / 3.0;
        if excess <= 0.0 {
            return Ok(still);
        }
        let wanted = Wanted { flow: Self::NAME, quantity: "torque", value: excess };
        let start = fluid.shear_rate(yields + 3.0 * excess)?;
        let rim = solve(wanted, start, |rim| {
            let mean = mean_stress(fluid, rim, yields)?.value;
            Ok((mean, (fluid.shear_stress(rim) - yields - 3.0 * mean) / rim))
        })?;
        Self::new(radius, gap, (rim * gap / radius).copysign(torque))
    }

    /// The flow of a fluid that slips at both discs under a given torque, N m; at rest without a torque.
    ///
    /// # Errors
    /// As [`with_torque`](Self::with_torque).
    pub fn with_slip_and_torque<F: ViscometricFluid + ?Sized>(
        radius: f64,
        gap: f64,
        slip: WallSlip,
        torque: f64,
        fluid: &F,
    ) -> Result<Self, ViscometryError> {
        if slip.is_none() {
            return Self::with_torque(radius, gap, torque, fluid);
        }
        let still = Self::new(radius, gap, 0.0)?.with_slip(slip);
        check_finite(Self::NAME, "torque", torque)?;
        let speed = still.turning().speed_of(fluid, torque)?.copysign(torque);
        Ok(Self::new(radius, gap, speed)?.with_slip(slip))
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

    /// `k_R` = Ω R/h, 1/s: the rate at the rim of a fluid that sticks.
    #[must_use]
    pub const fn rim_shear_rate(&self) -> f64 {
        self.speed * self.radius / self.gap
    }

    /// k, 1/s, at the distance `r`, m, from the axis.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 ≤ r ≤ R; what the fluid refuses, where it slips.
    pub fn shear_rate<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<f64, ViscometryError> {
        self.check(r)?;
        if self.slip.is_none() || r <= 0.0 {
            return Ok(self.nominal(r));
        }
        self.turning().at(r)?.shear_rate(fluid)
    }

    /// T₁₂, Pa, at the distance `r`, m, from the axis; zero at rest.
    ///
    /// # Errors
    /// As [`shear_rate`](Self::shear_rate); [`ViscometryError::NotIncreasing`] where τ falls.
    pub fn shear_stress<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<f64, ViscometryError> {
        self.check(r)?;
        let rate = self.nominal(r);
        if self.slip.is_none() || r <= 0.0 {
            return if rate.abs() > 0.0 { rising_stress(Self::NAME, fluid, rate) } else { Ok(0.0) };
        }
        self.turning().at(r)?.shear_stress(fluid)
    }

    /// v, m/s, at the distance `r`, m, from the axis and at the share `height` of the gap.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 ≤ r ≤ R and 0 ≤ height ≤ 1; what the fluid refuses, where it slips.
    pub fn velocity<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        r: f64,
        height: f64,
    ) -> Result<f64, ViscometryError> {
        self.check(r)?;
        check_bound(Self::NAME, "height", height, "0 ≤ height ≤ 1", 0.0 <= height && height <= 1.0)?;
        if self.slip.is_none() || r <= 0.0 {
            return Ok(self.speed * r * height);
        }
        self.turning().at(r)?.velocity(fluid, self.gap * height)
    }

    /// M, N m.
    ///
    /// # Errors
    /// As [`shear_stress`](Self::shear_stress) at the rim; [`ViscometryError::NotFinite`] beyond the range of numbers.
    pub fn torque<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        if !self.slip.is_none() {
            return self.turning().torque(fluid);
        }
        let rim = self.rim_shear_rate();
        // Discs turn steadily only where the stress rises out to the rim.
        self.shear_stress(fluid, self.radius)?;
        let mean = mean_stress(fluid, rim.abs(), 0.0)?;
        finite(Self::NAME, "torque", mean.scaled((2.0 * PI * self.radius.powi(3)).copysign(rim)))
    }

    /// F, N: what drives the discs apart, without inertia.
    ///
    /// # Errors
    /// [`ViscometryError::NotFinite`] beyond the range of numbers.
    pub fn thrust<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        if !F::NORMAL_STRESSES {
            return Ok(Estimate::ZERO);
        }
        if !self.slip.is_none() {
            let difference = |r: f64, rate: f64| r * (fluid.sigma2(rate) - 2.0 * fluid.sigma1(rate));
            return finite(Self::NAME, "thrust", self.turning().normal(fluid, 0.0, difference)?.scaled(PI));
        }
        let rim = self.rim_shear_rate().abs();
        let mean = rate_integral(0.0, rim, |rate| {
            let [sigma1, sigma2] = normal_functions(fluid, rate);
            Ok((rate / rim) * (sigma2 - 2.0 * sigma1) / rim)
        })?;
        finite(Self::NAME, "thrust", mean.scaled(PI * self.radius * self.radius))
    }

    /// The stresses, Pa, at the distance `r`, m, from the axis.
    ///
    /// # Errors
    /// As [`shear_rate`](Self::shear_rate).
    pub fn stresses<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<Stresses, ViscometryError> {
        let shear = self.shear_stress(fluid, r)?;
        if !F::NORMAL_STRESSES {
            return Ok(Stresses::from_gradient(shear, 0.0, [0.0; 2], 0.0));
        }
        let rate = self.shear_rate(fluid, r)?.abs();
        let sigma = normal_functions(fluid, rate);
        if !self.slip.is_none() {
            let hoop = self.turning().normal(fluid, r, |r, rate| fluid.sigma2(rate) / r)?;
            return Ok(Stresses::from_gradient(shear, sigma[0] - hoop.value, sigma, hoop.error));
        }
        let hoop = rate_integral(rate, self.rim_shear_rate().abs(), |rate| Ok(fluid.sigma2(rate) / rate))?;
        Ok(Stresses::from_gradient(shear, sigma[0] - hoop.value, sigma, hoop.error))
    }

    /// M Ω, W.
    ///
    /// # Errors
    /// As [`torque`](Self::torque).
    pub fn dissipation<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        Ok(self.torque(fluid)?.scaled(self.speed))
    }

    /// The Reynolds number ρ Ω h²/η at the rim, and whether a secondary flow or the rim matter: 1 % of the torque at Re = 4; R of at
    /// least ten h.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 < ρ.
    ///
    /// # Source
    /// The correction 3/4900 Re² of R. H. Ewoldt, M. T. Johnston, L. M. Caretta, in *Complex Fluids in Biological Systems*, Springer
    /// 2015.
    pub fn validity<F: ViscometricFluid + ?Sized>(&self, fluid: &F, density: f64) -> Result<Validity, ViscometryError> {
        const LEAST: f64 = 10.0;
        check_density(Self::NAME, density)?;
        let stress = self.shear_stress(fluid, self.radius)?;
        let rate = self.shear_rate(fluid, self.radius)?;
        let (reynolds, secondary) = secondary_flow(density, self.speed, self.gap, rate, stress);
        let ratio = self.radius / self.gap;
        Ok(Validity::new(reynolds, [secondary, (ratio < LEAST, Warning::Ends { ratio, least: LEAST })]))
    }

    /// Ω r/h.
    const fn nominal(&self, r: f64) -> f64 {
        self.speed * r / self.gap
    }

    fn check(&self, r: f64) -> Result<(), ViscometryError> {
        check_bound(Self::NAME, "r", r, "0 ≤ r ≤ R", 0.0 <= r && r <= self.radius)
    }

    const fn turning(&self) -> Turning {
        let gap = Gap::Even(self.gap);
        Turning { flow: Self::NAME, radius: self.radius, gap, speed: self.speed, slip: self.slip }
    }
}

/// ∫ k² (τ − `less`) dk from 0 to `rim`, over rim³: Pa.
fn mean_stress<F: ViscometricFluid + ?Sized>(fluid: &F, rim: f64, less: f64) -> Result<Estimate, ViscometryError> {
    rate_integral(0.0, rim, |rate| Ok((rate / rim).powi(2) * ((fluid.shear_stress(rate) - less) / rim)))
}
