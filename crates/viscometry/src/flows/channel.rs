//! Flow along a channel.

use piola_fluids::{FlowMoment, ViscometricFluid};

use super::declaration::flow_of_numbers;
use super::wall::{Sheared, check_density, duct, entry_length, generalised_reynolds, normal_functions, plug};
use crate::error::{check_bound, check_finite};
use crate::inverse::drive_error;
use crate::{Estimate, Stresses, Validity, ViscometryError, WallSlip};

flow_of_numbers! {
    /// Steady flow between two walls at rest, |x₁| ≤ d, along x₂.
    ///
    /// ```text
    /// T₁₂ = −c x₁      v(x₁) = ∫ ζ(c ξ) dξ from |x₁| to d      Q = (2/c²) ∫ s ζ(s) ds from 0 to c d
    /// T₁₁ = c x₂      T₃₃ = T₁₁ − σ₁      T₂₂ = T₃₃ + σ₂
    /// ```
    /// | symbol | number | unit | bounds |
    /// |---|---|---|---|
    /// | d | `half_width` | m | 0 < d |
    /// | c = −∂p/∂x₂ | `pressure_gradient` | Pa/m | finite |
    ///
    /// The discharge is per width of the channel. The pressure is counted from T₁₁ = 0 at x₂ = 0. With slip `v_s` is added to v.
    ///
    /// # Accuracy
    /// 1e-13 where the fluid has closed forms, 1e-12 by quadrature, with the bound in the answer.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::PowerLaw;
    /// use piola_viscometry::Channel;
    /// let paint = PowerLaw::new(2.0, 0.5)?; // ζ = (s/2)²
    /// let channel = Channel::new(1.0, 4.0)?;
    /// let discharge = channel.discharge(&paint)?; // (2/16) ∫ s³/4 ds from 0 to 4
    /// assert!((discharge.value - 2.0).abs() <= discharge.error);
    /// assert_eq!(channel.shear_rate(&paint, 0.5)?, -1.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// W(23.39), W(23.42), W(23.43), W(23.45)–W(23.49).
    pub struct Channel("channel flow") {
        /// d, m.
        half_width: "0 < d" => 0.0 < half_width,
        /// c = −∂p/∂x₂, Pa/m: what drives the fluid towards larger x₂.
        pressure_gradient: "c is finite" => pressure_gradient.is_finite(),
    }
}

impl Channel {
    /// The flow of a fluid with a given discharge per width, m²/s; at rest where it is zero.
    ///
    /// # Errors
    /// As [`new`](Self::new); [`ViscometryError::NoDrive`]; what the fluid refuses.
    pub fn with_discharge<F: ViscometricFluid + ?Sized>(
        half_width: f64,
        discharge: f64,
        fluid: &F,
    ) -> Result<Self, ViscometryError> {
        Self::with_slip_and_discharge(half_width, WallSlip::NONE, discharge, fluid)
    }

    /// The flow of a fluid that slips with a given discharge per width, m²/s.
    ///
    /// # Errors
    /// As [`with_discharge`](Self::with_discharge).
    pub fn with_slip_and_discharge<F: ViscometricFluid + ?Sized>(
        half_width: f64,
        slip: WallSlip,
        discharge: f64,
        fluid: &F,
    ) -> Result<Self, ViscometryError> {
        let still = Self::new(half_width, 0.0)?.with_slip(slip);
        check_finite(Self::NAME, "discharge", discharge)?;
        let mean = 0.5 * discharge / half_width;
        let wall = still.sheared().wall_stress_of(fluid, FlowMoment::First, mean, 3.0)?;
        Self::new(half_width, wall / half_width).map(|flow| flow.with_slip(slip))
    }

    /// Error bound of the pressure gradient, Pa/m, found by [`with_discharge`](Self::with_discharge) for this discharge per width, m²/s,
    /// as [`Poiseuille::pressure_gradient_error`](crate::Poiseuille::pressure_gradient_error).
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn pressure_gradient_error<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        discharge: f64,
    ) -> Result<f64, ViscometryError> {
        check_finite(Self::NAME, "discharge", discharge)?;
        let least = fluid.yield_stress() / self.half_width;
        drive_error(self.pressure_gradient, least, discharge, |pressure_gradient| {
            Self { pressure_gradient, ..*self }.discharge(fluid)
        })
    }

    /// c d, Pa: minus T₁₂ at the wall x₁ = d.
    #[must_use]
    pub const fn wall_stress(&self) -> f64 {
        self.pressure_gradient * self.half_width
    }

    /// T₁₂, Pa, at `x1`, m.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless |x₁| ≤ d.
    pub fn shear_stress(&self, x1: f64) -> Result<f64, ViscometryError> {
        self.check(x1)?;
        Ok(-self.pressure_gradient * x1)
    }

    /// dv/dx₁ = ζ(T₁₂), 1/s.
    ///
    /// # Errors
    /// As [`shear_stress`](Self::shear_stress); what the fluid refuses.
    pub fn shear_rate<F: ViscometricFluid + ?Sized>(&self, fluid: &F, x1: f64) -> Result<f64, ViscometryError> {
        Ok(fluid.shear_rate(self.shear_stress(x1)?)?)
    }

    /// v, m/s, at `x1`, m.
    ///
    /// # Errors
    /// As [`shear_rate`](Self::shear_rate).
    pub fn velocity<F: ViscometricFluid + ?Sized>(&self, fluid: &F, x1: f64) -> Result<Estimate, ViscometryError> {
        self.check(x1)?;
        self.sheared().velocity(fluid, (self.half_width - x1.abs()) / self.half_width)
    }

    /// Q per width, m²/s.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn discharge<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        Ok(self.mean_velocity(fluid)?.scaled(2.0 * self.half_width))
    }

    /// Q/(2 d), m/s.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn mean_velocity<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        self.sheared().mean_velocity(fluid, FlowMoment::First)
    }

    /// Half of the width, m, of the plug that moves rigidly: `τ_y`/|c|, at most d; zero without a yield stress.
    pub fn plug_half_width<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> f64 {
        plug(self.half_width, self.wall_stress(), fluid.yield_stress())
    }

    /// The stresses, Pa, at `x1`, `x2`, m.
    ///
    /// # Errors
    /// As [`shear_rate`](Self::shear_rate).
    pub fn stresses<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        x1: f64,
        x2: f64,
    ) -> Result<Stresses, ViscometryError> {
        check_finite(Self::NAME, "x2", x2)?;
        let shear = self.shear_stress(x1)?;
        let sigma = if F::NORMAL_STRESSES { normal_functions(fluid, fluid.shear_rate(shear)?) } else { [0.0; 2] };
        let across = Estimate::rounded(self.pressure_gradient * x2);
        Ok(Stresses::from_gradient(shear, across.value, sigma, across.error))
    }

    /// −T₁₁ at the walls, Pa, at `x2`, m: what a hole in a wall is pressed with.
    #[must_use]
    pub const fn wall_pressure(&self, x2: f64) -> f64 {
        -self.pressure_gradient * x2
    }

    /// c Q, W/m²: the power that is dissipated per length and width of the channel, at its walls included.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn dissipation<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        Ok(self.discharge(fluid)?.scaled(self.pressure_gradient))
    }

    /// The generalised Reynolds number 12 ρ V²/`τ_w` of the hydraulic diameter 4 d, and whether the flow is laminar and developed in a
    /// channel of this length, m.
    ///
    /// Laminar up to 2100; the length of development is that of a Newtonian fluid.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 < ρ and 0 < length; what the fluid refuses.
    pub fn validity<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        density: f64,
        length: f64,
    ) -> Result<Validity, ViscometryError> {
        check_density(Self::NAME, density)?;
        check_bound(Self::NAME, "length", length, "0 < length", 0.0 < length)?;
        let mean = self.mean_velocity(fluid)?.value;
        let reynolds = generalised_reynolds(12.0, density, mean, self.wall_stress());
        // The length of development is stated for the width 2 d, of which the hydraulic diameter is twice.
        let developing = entry_length(2.0 * self.half_width, [0.631, 0.0442], 0.5 * reynolds);
        Ok(duct(reynolds, length, developing))
    }

    fn check(&self, x1: f64) -> Result<(), ViscometryError> {
        check_bound(Self::NAME, "x1", x1, "|x₁| ≤ d", x1.abs() <= self.half_width)
    }

    const fn sheared(&self) -> Sheared {
        Sheared { flow: Self::NAME, length: self.half_width, wall_stress: self.wall_stress(), slip: self.slip }
    }
}
