//! Flow along a pipe.

use std::f64::consts::PI;

use piola_fluids::{FlowMoment, ViscometricFluid};

use super::declaration::flow_of_numbers;
use super::wall::{Sheared, check_density, entry_length, normal_functions};
use crate::error::{check_bound, check_finite};
use crate::inverse::drive_error;
use crate::quadrature::{Span, stress_integral};
use crate::{Estimate, Stresses, Validity, ViscometryError, WallSlip};

flow_of_numbers! {
    /// Steady flow along a pipe of circular cross section, after Poiseuille.
    ///
    /// ```text
    /// T_rz = −½ c r      v(r) = ∫ᵣᴿ ζ(½ c ξ) dξ      Q = π ∫₀ᴿ ξ² ζ(½ c ξ) dξ
    /// T_rr(r) = ∫ᵣᴿ σ₁/ξ dξ + c z      T_θθ = T_rr − σ₁      T_zz = T_θθ + σ₂
    /// ```
    /// | symbol | number | unit | bounds |
    /// |---|---|---|---|
    /// | R | `radius` | m | 0 < R |
    /// | c = −∂p/∂z | `pressure_gradient` | Pa/m | finite |
    ///
    /// Direction 1 is r, 2 is z, 3 is θ. The pressure is counted from `T_rr` = 0 at the wall at z = 0. With slip `v_s` is added to v.
    ///
    /// # Accuracy
    /// 1e-13 where the fluid has closed forms, 1e-12 by quadrature, with the bound in the answer.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::Newtonian;
    /// use piola_viscometry::Poiseuille;
    /// let oil = Newtonian::new(0.5)?;
    /// let pipe = Poiseuille::new(2.0, 3.0)?;
    /// assert_eq!(pipe.velocity(&oil, 0.0)?.value, 6.0); // c R²/(4 μ)
    /// let discharge = pipe.discharge(&oil)?; // π c R⁴/(8 μ)
    /// assert!((discharge.value - 12.0 * std::f64::consts::PI).abs() <= discharge.error);
    /// let again = Poiseuille::with_discharge(2.0, discharge.value, &oil)?;
    /// assert!((again.pressure_gradient() - 3.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// W(23.60), W(23.62), W(23.63), W(23.65).
    pub struct Poiseuille("Poiseuille flow") {
        /// R, m.
        radius: "0 < R" => 0.0 < radius,
        /// c = −∂p/∂z, Pa/m: what drives the fluid towards larger z.
        pressure_gradient: "c is finite" => pressure_gradient.is_finite(),
    }
}

impl Poiseuille {
    /// The flow of a fluid with a given discharge, m³/s; at rest where it is zero.
    ///
    /// # Errors
    /// As [`new`](Self::new); [`ViscometryError::NoDrive`]; what the fluid refuses.
    pub fn with_discharge<F: ViscometricFluid + ?Sized>(
        radius: f64,
        discharge: f64,
        fluid: &F,
    ) -> Result<Self, ViscometryError> {
        Self::with_slip_and_discharge(radius, WallSlip::NONE, discharge, fluid)
    }

    /// The flow of a fluid that slips with a given discharge, m³/s.
    ///
    /// # Errors
    /// As [`with_discharge`](Self::with_discharge).
    pub fn with_slip_and_discharge<F: ViscometricFluid + ?Sized>(
        radius: f64,
        slip: WallSlip,
        discharge: f64,
        fluid: &F,
    ) -> Result<Self, ViscometryError> {
        let still = Self::new(radius, 0.0)?.with_slip(slip);
        check_finite(Self::NAME, "discharge", discharge)?;
        let mean = discharge / (PI * radius * radius);
        let wall = still.sheared().wall_stress_of(fluid, FlowMoment::Second, mean, 4.0)?;
        Self::new(radius, 2.0 * wall / radius).map(|flow| flow.with_slip(slip))
    }

    /// Error bound of the pressure gradient, Pa/m, found by [`with_discharge`](Self::with_discharge) for this discharge, m³/s.
    ///
    /// ```text
    /// |δc| ≈ (|Q(c) − Q| + δQ)/(dQ/dc)      the residual of the discharge and its quadrature error, over the slope
    /// ```
    /// Infinite where the slope is zero, as below a yield stress.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn pressure_gradient_error<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        discharge: f64,
    ) -> Result<f64, ViscometryError> {
        check_finite(Self::NAME, "discharge", discharge)?;
        let least = 2.0 * fluid.yield_stress() / self.radius;
        drive_error(self.pressure_gradient, least, discharge, |pressure_gradient| {
            Self { pressure_gradient, ..*self }.discharge(fluid)
        })
    }

    /// ½ c R, Pa: minus `T_rz` at the wall.
    #[must_use]
    pub const fn wall_stress(&self) -> f64 {
        0.5 * self.pressure_gradient * self.radius
    }

    /// `T_rz`, Pa, at the distance `r`, m, from the axis.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 ≤ r ≤ R.
    pub fn shear_stress(&self, r: f64) -> Result<f64, ViscometryError> {
        self.check(r)?;
        Ok(-0.5 * self.pressure_gradient * r)
    }

    /// dv/dr = ζ(`T_rz`), 1/s.
    ///
    /// # Errors
    /// As [`shear_stress`](Self::shear_stress); what the fluid refuses.
    pub fn shear_rate<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<f64, ViscometryError> {
        Ok(fluid.shear_rate(self.shear_stress(r)?)?)
    }

    /// v, m/s, at the distance `r`, m, from the axis.
    ///
    /// # Errors
    /// As [`shear_rate`](Self::shear_rate).
    pub fn velocity<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<Estimate, ViscometryError> {
        self.check(r)?;
        self.sheared().velocity(fluid, (self.radius - r) / self.radius)
    }

    /// Q, m³/s.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn discharge<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        Ok(self.mean_velocity(fluid)?.scaled(PI * self.radius * self.radius))
    }

    /// Q/(π R²), m/s.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn mean_velocity<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        self.sheared().mean_velocity(fluid, FlowMoment::Second)
    }

    /// The radius, m, within which the fluid moves as a plug: 2 `τ_y`/|c|, at most R; zero without a yield stress.
    pub fn plug_radius<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> f64 {
        super::wall::plug(self.radius, self.wall_stress(), fluid.yield_stress())
    }

    /// The stresses, Pa, at the distance `r`, m, from the axis and the height `z`, m.
    ///
    /// # Errors
    /// As [`shear_rate`](Self::shear_rate).
    pub fn stresses<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        r: f64,
        z: f64,
    ) -> Result<Stresses, ViscometryError> {
        check_finite(Self::NAME, "z", z)?;
        let shear = self.shear_stress(r)?;
        let mut radial = Estimate::rounded(self.pressure_gradient * z);
        let mut sigma = [0.0; 2];
        if F::NORMAL_STRESSES {
            sigma = normal_functions(fluid, fluid.shear_rate(shear)?);
            let span = Span { top: self.wall_stress().abs(), share: (self.radius - r) / self.radius };
            radial = radial.plus(stress_integral(fluid, span, |stress, rate| fluid.sigma1(rate) / stress)?);
        }
        Ok(Stresses::from_gradient(shear, radial.value, sigma, radial.error))
    }

    /// −`T_rr` at the wall, Pa, at the height `z`, m: what a hole in the wall is pressed with.
    #[must_use]
    pub const fn wall_pressure(&self, z: f64) -> f64 {
        -self.pressure_gradient * z
    }

    /// c Q, W/m: the power that a length of the pipe dissipates, at its wall included.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn dissipation<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        Ok(self.discharge(fluid)?.scaled(self.pressure_gradient))
    }

    /// The generalised Reynolds number 8 ρ V²/`τ_w`, and whether the flow is laminar and developed in a pipe of this length, m.
    ///
    /// Laminar up to 2100; the length of development is that of a Newtonian fluid.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 < ρ and 0 < length; what the fluid refuses.
    ///
    /// # Source
    /// A. B. Metzner, J. C. Reed, *A. I. Ch. E. Journal* 1 (1955) 434.
    pub fn validity<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        density: f64,
        length: f64,
    ) -> Result<Validity, ViscometryError> {
        check_density(Self::NAME, density)?;
        check_bound(Self::NAME, "length", length, "0 < length", 0.0 < length)?;
        let mean = self.mean_velocity(fluid)?.value;
        let reynolds = super::wall::generalised_reynolds(8.0, density, mean, self.wall_stress());
        let developing = entry_length(2.0 * self.radius, [0.619, 0.0567], reynolds);
        Ok(super::wall::duct(reynolds, length, developing))
    }

    fn check(&self, r: f64) -> Result<(), ViscometryError> {
        check_bound(Self::NAME, "r", r, "0 ≤ r ≤ R", 0.0 <= r && r <= self.radius)
    }

    const fn sheared(&self) -> Sheared {
        Sheared { flow: Self::NAME, length: self.radius, wall_stress: self.wall_stress(), slip: self.slip }
    }
}
