//! Flow between cylinders that turn.

use std::f64::consts::PI;

use piola_fluids::{FlowMoment, ViscometricFluid};

use super::declaration::flow_of_numbers;
use super::wall::{check_density, finite, normal_functions};
use crate::error::{check_bound, check_finite};
use crate::inverse::{Wanted, drive_error, solve};
use crate::quadrature::{Span, integrate, scaled_moment, stress_integral};
use crate::{Estimate, Stresses, Validity, ViscometryError, WallSlip, Warning};

flow_of_numbers! {
    /// Steady flow between two coaxial cylinders, of which the outer turns faster by ΔΩ where the moment is positive.
    ///
    /// ```text
    /// T_rθ = M/(2 π r²)      r ω′ = ζ(T_rθ)      ω(r) = Ω₁ + ∫ ζ(M/2πξ²) dξ/ξ from R₁ to r      ΔΩ = ω(R₂) − Ω₁
    /// T_rr(r) = ∫ (σ₂ − σ₁) dξ/ξ − ∫ ρ ξ ω² dξ      T_zz = T_rr − σ₁      T_θθ = T_zz + σ₂
    /// ```
    /// | symbol | number | unit | bounds |
    /// |---|---|---|---|
    /// | R₁ | `inner_radius` | m | 0 < R₁ |
    /// | R₂ | `outer_radius` | m | R₁ < R₂ |
    /// | M | `moment`, per length, on the outer cylinder | N m/m | finite |
    ///
    /// Direction 1 is r, 2 is θ, 3 is z. The pressure is counted from `T_rr` = 0 at the inner cylinder. With slip the walls' speeds `v_s` add
    /// `v_s(R₁)/R₁` + `v_s(R₂)/R₂` to ΔΩ.
    ///
    /// # Accuracy
    /// 1e-13 where the fluid has closed forms, 1e-12 by quadrature, with the bound in the answer; also for R₁/R₂ → 1, where the width of the
    /// gap keeps its digits.
    ///
    /// # Example
    /// ```
    /// use std::f64::consts::PI;
    /// use piola_fluids::Newtonian;
    /// use piola_viscometry::Couette;
    /// let oil = Newtonian::new(0.5)?;
    /// let flow = Couette::new(1.0, 2.0, 8.0 * PI)?;
    /// let difference = flow.speed_difference(&oil)?; // M/(4 π μ) (1/R₁² − 1/R₂²)
    /// assert!((difference.value - 3.0).abs() <= difference.error);
    /// let again = Couette::with_speed_difference(1.0, 2.0, 3.0, &oil)?;
    /// assert!((again.moment() - 8.0 * PI).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// W(23.75)–W(23.79), W(23.87).
    pub struct Couette("Couette flow") {
        /// R₁, m.
        inner_radius: "0 < R₁" => 0.0 < inner_radius,
        /// R₂, m.
        outer_radius: "R₁ < R₂" => inner_radius < outer_radius,
        /// M, N m/m.
        moment: "M is finite" => moment.is_finite(),
    }
    also {
        /// Ω₁, rad/s; zero unless given.
        inner_speed: f64 = 0.0, |flow, speed| flow.with_inner_speed(speed);
        /// ρ, kg/m³: for centrifugal pressures; zero unless given.
        density: f64 = 0.0, |flow, density| flow.with_density(density);
    }
}

impl Couette {
    /// The flow of a fluid with a given ΔΩ, rad/s; without moment where it is zero.
    ///
    /// # Errors
    /// As [`new`](Self::new); [`ViscometryError::NoDrive`]; what the fluid refuses.
    pub fn with_speed_difference<F: ViscometricFluid + ?Sized>(
        inner_radius: f64,
        outer_radius: f64,
        speed_difference: f64,
        fluid: &F,
    ) -> Result<Self, ViscometryError> {
        Self::with_slip_and_speed_difference(inner_radius, outer_radius, WallSlip::NONE, speed_difference, fluid)
    }

    /// The flow of a fluid that slips with a given ΔΩ, rad/s.
    ///
    /// # Errors
    /// As [`with_speed_difference`](Self::with_speed_difference).
    pub fn with_slip_and_speed_difference<F: ViscometricFluid + ?Sized>(
        inner_radius: f64,
        outer_radius: f64,
        slip: WallSlip,
        speed_difference: f64,
        fluid: &F,
    ) -> Result<Self, ViscometryError> {
        let still = Self::new(inner_radius, outer_radius, 0.0)?.with_slip(slip);
        check_finite(Self::NAME, "speed_difference", speed_difference)?;
        let target = speed_difference.abs();
        if target <= 0.0 {
            return Ok(still);
        }
        let yields = fluid.yield_stress();
        let under = |stress: f64| Self { moment: stress * (2.0 * PI * inner_radius * inner_radius), ..still };
        let slipped = under(yields).slipped();
        if !slip.is_none() && target <= slipped {
            // Both walls slip by the same power of the moment.
            let unit = under(1.0).slipped();
            let stress = (target / unit).powf(slip.exponent().recip());
            return Ok(Self { moment: under(stress).moment.copysign(speed_difference), ..still });
        }
        let share = still.share(outer_radius);
        // The rate of a Newtonian fluid at the inner wall: 2 ΔΩ/(1 − (R₁/R₂)²).
        let start = fluid.shear_stress(2.0 * target / share) - yields;
        let wanted = Wanted { flow: Self::NAME, quantity: "speed difference", value: target };
        let ratio = (inner_radius / outer_radius).powi(2);
        let excess = solve(wanted, start, |excess| {
            let top = yields + excess;
            let flow = under(top);
            let outer = fluid.shear_rate(top * ratio)?;
            let slope = 0.5 * (fluid.shear_rate(top)? - outer) / top + slip.exponent() * flow.slipped() / top;
            Ok((flow.speed_difference(fluid)?.value, slope))
        })?;
        Ok(Self { moment: under(yields + excess).moment.copysign(speed_difference), ..still })
    }

    /// With the angular velocity Ω₁, rad/s, of the inner cylinder.
    ///
    /// # Errors
    /// [`ViscometryError::NotFinite`].
    pub fn with_inner_speed(mut self, inner_speed: f64) -> Result<Self, ViscometryError> {
        check_finite(Self::NAME, "inner_speed", inner_speed)?;
        self.inner_speed = inner_speed;
        Ok(self)
    }

    /// With the density ρ, kg/m³, for centrifugal pressures.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 ≤ ρ.
    pub fn with_density(mut self, density: f64) -> Result<Self, ViscometryError> {
        check_bound(Self::NAME, "density", density, "0 ≤ ρ", 0.0 <= density)?;
        self.density = density;
        Ok(self)
    }

    /// Error bound of the moment, N m/m, found by [`with_speed_difference`](Self::with_speed_difference) for this ΔΩ, rad/s:
    /// (|ΔΩ(M) − ΔΩ| + δΔΩ)/(dΔΩ/dM), infinite where the slope is zero, as below a yield stress.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn moment_error<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        speed_difference: f64,
    ) -> Result<f64, ViscometryError> {
        check_finite(Self::NAME, "speed_difference", speed_difference)?;
        let least = fluid.yield_stress() * (2.0 * PI * self.inner_radius * self.inner_radius);
        drive_error(self.moment, least, speed_difference, |moment| Self { moment, ..*self }.speed_difference(fluid))
    }

    /// `T_rθ`, Pa, at the distance `r`, m, from the axis.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless R₁ ≤ r ≤ R₂.
    pub fn shear_stress(&self, r: f64) -> Result<f64, ViscometryError> {
        self.check(r)?;
        Ok(self.stress_at(r))
    }

    /// r ω′ = ζ(`T_rθ`), 1/s.
    ///
    /// # Errors
    /// As [`shear_stress`](Self::shear_stress); what the fluid refuses.
    pub fn shear_rate<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<f64, ViscometryError> {
        Ok(fluid.shear_rate(self.shear_stress(r)?)?)
    }

    /// ω, rad/s, of the fluid at the distance `r`, m, from the axis.
    ///
    /// # Errors
    /// As [`shear_rate`](Self::shear_rate).
    pub fn angular_velocity<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        r: f64,
    ) -> Result<Estimate, ViscometryError> {
        self.check(r)?;
        let at_wall = self.inner_speed + self.slip.speed(self.stress_at(self.inner_radius)) / self.inner_radius;
        finite(Self::NAME, "angular velocity", self.gained(fluid, r)?.plus(Estimate::rounded(at_wall)))
    }

    /// v = r ω, m/s, at the distance `r`, m, from the axis.
    ///
    /// # Errors
    /// As [`angular_velocity`](Self::angular_velocity).
    pub fn velocity<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<Estimate, ViscometryError> {
        Ok(self.angular_velocity(fluid, r)?.scaled(r))
    }

    /// ΔΩ = Ω₂ − Ω₁, rad/s, of the cylinders, slip included.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn speed_difference<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        let all = self.gained(fluid, self.outer_radius)?.plus(Estimate::rounded(self.slipped()));
        finite(Self::NAME, "speed difference", all)
    }

    /// The radius, m, beyond which the fluid moves rigidly, between R₁ (all of it) and R₂ (nothing); `None` without a yield stress.
    pub fn yield_radius<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Option<f64> {
        let yields = fluid.yield_stress();
        let radius = (self.moment.abs() / (2.0 * PI * yields)).sqrt();
        (yields > 0.0).then(|| radius.clamp(self.inner_radius, self.outer_radius))
    }

    /// The stresses, Pa, at the distance `r`, m, from the axis; centrifugal ones where a density is given.
    ///
    /// # Errors
    /// As [`shear_rate`](Self::shear_rate).
    pub fn stresses<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<Stresses, ViscometryError> {
        let shear = self.shear_stress(r)?;
        let mut radial = Estimate::ZERO;
        let mut sigma = [0.0; 2];
        if F::NORMAL_STRESSES {
            sigma = normal_functions(fluid, fluid.shear_rate(shear)?);
            let span = Span { top: self.stress_at(self.inner_radius).abs(), share: self.share(r) };
            let weight = |stress: f64, rate: f64| fluid.first_normal_stress_difference(rate) / stress;
            radial = stress_integral(fluid, span, weight)?.scaled(0.5);
        }
        if self.density > 0.0 {
            radial = radial.plus(self.centrifugal(fluid, r)?.scaled(-self.density));
        }
        Ok(Stresses::from_gradient(shear, radial.value, sigma, radial.error))
    }

    /// `T_rr(R₂)` − `T_rr(R₁)`, Pa.
    ///
    /// # Errors
    /// As [`stresses`](Self::stresses).
    pub fn radial_difference<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        let Stresses { gradient, error, .. } = self.stresses(fluid, self.outer_radius)?;
        Ok(Estimate { value: gradient, error })
    }

    /// M ΔΩ, W/m: the power that a length of the cylinders dissipates, at the walls included.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn dissipation<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        Ok(self.speed_difference(fluid)?.scaled(self.moment))
    }

    /// The Reynolds number ρ |ΔΩ| R₁ (R₂ − R₁)/η with η at the inner wall, and whether vortices grow and the ends matter for cylinders of
    /// this height, m.
    ///
    /// Vortices: where |Ω| r² falls outwards (Rayleigh) and Taylor's number Re² (R₂ − R₁)/R₁ is above 1695, that of a narrow gap with
    /// the outer cylinder at rest. Ends: a height of at least ten gaps.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless 0 < ρ and 0 < height; what the fluid refuses.
    ///
    /// # Source
    /// G. I. Taylor, *Phil. Trans. R. Soc. A* 223 (1923) 289.
    pub fn validity<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        density: f64,
        height: f64,
    ) -> Result<Validity, ViscometryError> {
        const CRITICAL: f64 = 1695.0;
        const LEAST: f64 = 10.0;
        check_density(Self::NAME, density)?;
        check_bound(Self::NAME, "height", height, "0 < height", 0.0 < height)?;
        let gap = self.outer_radius - self.inner_radius;
        let stress = self.stress_at(self.inner_radius);
        let rate = fluid.shear_rate(stress)?;
        let difference = self.speed_difference(fluid)?.value;
        let reynolds =
            if rate.abs() > 0.0 { density * difference.abs() * self.inner_radius * gap * (rate / stress) } else { 0.0 };
        let taylor = reynolds * reynolds * gap / self.inner_radius;
        let (inner, outer) = (self.inner_speed, self.inner_speed + difference);
        let angular_momenta = [inner * self.inner_radius.powi(2), outer * self.outer_radius.powi(2)];
        let falls = angular_momenta[1] * angular_momenta[0].signum() < angular_momenta[0].abs();
        let ratio = height / gap;
        Ok(Validity::new(
            reynolds,
            [
                (falls && CRITICAL < taylor, Warning::Vortices { taylor, critical: CRITICAL }),
                (ratio < LEAST, Warning::Ends { ratio, least: LEAST }),
            ],
        ))
    }

    /// ω(r) − ω(R₁) of the fluid.
    fn gained<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<Estimate, ViscometryError> {
        let span = Span { top: self.stress_at(self.inner_radius).abs(), share: self.share(r) };
        let sheared = scaled_moment(fluid, FlowMoment::Reciprocal, span)?;
        Ok(sheared.scaled(0.5_f64.copysign(self.moment)))
    }

    /// `v_s(R₁)/R₁` + `v_s(R₂)/R₂`.
    fn slipped(&self) -> f64 {
        [self.inner_radius, self.outer_radius].map(|r| self.slip.speed(self.stress_at(r)) / r).iter().sum()
    }

    /// ∫ ξ ω² dξ from R₁ to `r`.
    fn centrifugal<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<Estimate, ViscometryError> {
        // Where the fluid does not yield it turns rigidly.
        let end = self.yield_radius(fluid).map_or(r, |radius| radius.min(r));
        let width = end - self.inner_radius;
        let mut off = 0.0_f64;
        let mut sheared = Estimate::ZERO;
        if width > 0.0 {
            sheared = integrate(&[0.0, 1.0], |x| {
                let xi = self.inner_radius + width * x;
                let omega = self.angular_velocity(fluid, xi)?;
                off = off.max((omega.error * omega.value).abs());
                Ok(xi * omega.value * omega.value)
            })?
            .scaled(width);
        }
        let omega = self.angular_velocity(fluid, end)?;
        let rigid = 0.5 * (r - end) * (r + end);
        let beyond = Estimate::rounded(rigid * omega.value * omega.value);
        let inner = Estimate { value: 0.0, error: 2.0 * (off * r * width + rigid * (omega.error * omega.value).abs()) };
        Ok(sheared.plus(beyond).plus(inner))
    }

    fn check(&self, r: f64) -> Result<(), ViscometryError> {
        check_bound(Self::NAME, "r", r, "R₁ ≤ r ≤ R₂", self.inner_radius <= r && r <= self.outer_radius)
    }

    /// M/(2 π r²).
    fn stress_at(&self, r: f64) -> f64 {
        self.moment / (2.0 * PI * r * r)
    }

    /// 1 − (R₁/r)² without cancellation.
    fn share(&self, r: f64) -> f64 {
        ((r - self.inner_radius) / r) * ((r + self.inner_radius) / r)
    }
}
