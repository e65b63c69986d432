//! Flow along the gap between two cylinders at rest.

use std::f64::consts::PI;

use piola_fluids::{Newtonian, ViscometricFluid};

use super::declaration::flow_of_numbers;
use super::wall::{check_density, check_rising, duct, entry_length, finite, normal_functions, profile};
use crate::error::{check_bound, check_finite};
use crate::inverse::{Wanted, drive_error, solve, zero};
use crate::quadrature::integrate;
use crate::{Estimate, Stresses, Validity, ViscometryError, WallSlip};

flow_of_numbers! {
    /// Steady flow along the gap between two coaxial cylinders at rest.
    ///
    /// ```text
    /// T_rz = −½ c (r − λ²/r)      ∫ ζ(T_rz) dr = 0 from R₁ to R₂ determines λ      v(r) = ∫ ζ(T_rz) dξ from R₁ to r
    /// Q = −π ∫ (ξ² − λ²) ζ(T_rz) dξ      T_rr(r) = ∫ σ₁/ξ dξ from r to R₂ + c z      T_θθ = T_rr − σ₁      T_zz = T_θθ + σ₂
    /// ```
    /// | symbol | number | unit | bounds |
    /// |---|---|---|---|
    /// | R₁ | `inner_radius` | m | 0 < R₁ |
    /// | R₂ | `outer_radius` | m | R₁ < R₂ |
    /// | c = −∂p/∂z | `pressure_gradient` | Pa/m | finite |
    ///
    /// Direction 1 is r, 2 is z, 3 is θ. The pressure is counted from `T_rr` = 0 at the outer wall at z = 0. λ is found by a bracket that
    /// shrinks around the zero of its integral; by how much the integral misses zero is part of every bound.
    /// With slip `v_s(R₁)` + ∫ ζ dr = `v_s(R₂)` determines λ, and Q has π (λ² − R₁²) `v_s(R₁)` + π (R₂² − λ²) `v_s(R₂)` besides.
    ///
    /// # Accuracy
    /// 1e-12, with the bound in the answer.
    ///
    /// # Example
    /// ```
    /// use std::f64::consts::PI;
    /// use piola_fluids::Newtonian;
    /// use piola_viscometry::Annulus;
    /// let oil = Newtonian::new(0.125)?;
    /// let annulus = Annulus::new(1.0, 2.0, 1.0)?;
    /// let rest = annulus.rest_radius(&oil)?; // λ² = (R₂² − R₁²)/(2 ln(R₂/R₁))
    /// assert!((rest * rest - 1.5 / 2.0_f64.ln()).abs() < 1e-13);
    /// let discharge = annulus.discharge(&oil)?; // π c/(8 μ) (R₂⁴ − R₁⁴ − (R₂² − R₁²)²/ln(R₂/R₁))
    /// assert!((discharge.value / (PI * (15.0 - 9.0 / 2.0_f64.ln())) - 1.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// A. G. Fredrickson, R. B. Bird, *Ind. Eng. Chem.* 50 (1958) 347, for any flow function.
    pub struct Annulus("annular flow") {
        /// R₁, m.
        inner_radius: "0 < R₁" => 0.0 < inner_radius,
        /// R₂, m.
        outer_radius: "R₁ < R₂" => inner_radius < outer_radius,
        /// c = −∂p/∂z, Pa/m: what drives the fluid towards larger z.
        pressure_gradient: "c is finite" => pressure_gradient.is_finite(),
    }
}

/// The share of the gap within which of its plug the stress of a fluid that yields is not resolved.
const NEAR: f64 = 1.0 / 16_777_216.0;

/// A small step of the place of rest, for differences.
const STEP: f64 = 1e-4;

/// The place of rest, as shares of the gap from the inner wall.
#[derive(Clone, Copy, Debug)]
struct Rest {
    /// (λ − R₁)/(R₂ − R₁).
    place: f64,
    /// Where the fluid ceases and begins to yield.
    plug: [f64; 2],
    /// Bound of the difference of ∫ |ζ| dr between the two sides of λ, m/s: it tells how far λ is off, as the speeds at which the
    /// sides pass one another.
    mismatch: f64,
}

impl Annulus {
    /// The flow of a fluid with a given discharge, m³/s; at rest where it is zero.
    ///
    /// # Errors
    /// As [`new`](Self::new); [`ViscometryError::NoDrive`]; what the fluid refuses.
    pub fn with_discharge<F: ViscometricFluid + ?Sized>(
        inner_radius: f64,
        outer_radius: f64,
        discharge: f64,
        fluid: &F,
    ) -> Result<Self, ViscometryError> {
        Self::with_slip_and_discharge(inner_radius, outer_radius, WallSlip::NONE, discharge, fluid)
    }

    /// The flow of a fluid that slips with a given discharge, m³/s.
    ///
    /// # Errors
    /// As [`with_discharge`](Self::with_discharge).
    pub fn with_slip_and_discharge<F: ViscometricFluid + ?Sized>(
        inner_radius: f64,
        outer_radius: f64,
        slip: WallSlip,
        discharge: f64,
        fluid: &F,
    ) -> Result<Self, ViscometryError> {
        let still = Self::new(inner_radius, outer_radius, 0.0)?.with_slip(slip);
        check_finite(Self::NAME, "discharge", discharge)?;
        let target = discharge.abs();
        if target <= 0.0 {
            return Ok(still);
        }
        let gap = outer_radius - inner_radius;
        let least = 2.0 * fluid.yield_stress() / gap;
        let mean = target / (PI * gap * (inner_radius + outer_radius));
        if !slip.is_none() && mean <= slip.speed(fluid.yield_stress()) {
            let pressure_gradient = (2.0 * slip.stress(mean) / gap).copysign(discharge);
            return Ok(Self { pressure_gradient, ..still });
        }
        // Walls of a channel of the width of the gap.
        let start = 2.0 * fluid.shear_stress(6.0 * mean / gap) / gap - least;
        let wanted = Wanted { flow: Self::NAME, quantity: "discharge", value: target };
        let excess = solve(wanted, start, |excess| {
            let at = |excess: f64| Self { pressure_gradient: least + excess, ..still }.discharge(fluid);
            let value = at(excess)?.value;
            // The slope steers the search; its error costs a step, not a digit.
            let beside = at(excess * (1.0 + 1e-5))?.value;
            Ok((value, (beside - value) / (excess * 1e-5)))
        })?;
        Ok(Self { pressure_gradient: (least + excess).copysign(discharge), ..still })
    }

    /// Error bound of the pressure gradient, Pa/m, found by [`with_discharge`](Self::with_discharge) for this discharge, m³/s, as
    /// [`Poiseuille::pressure_gradient_error`](crate::Poiseuille::pressure_gradient_error).
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn pressure_gradient_error<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        discharge: f64,
    ) -> Result<f64, ViscometryError> {
        check_finite(Self::NAME, "discharge", discharge)?;
        let least = 2.0 * fluid.yield_stress() / self.gap();
        drive_error(self.pressure_gradient, least, discharge, |pressure_gradient| {
            Self { pressure_gradient, ..*self }.discharge(fluid)
        })
    }

    /// λ, m: where the shear stress vanishes. Where nothing flows any place of a range serves, and √(R₁ R₂) is given.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn rest_radius<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<f64, ViscometryError> {
        Ok(self.rest_or_middle(self.rest(fluid)?))
    }

    /// The radii, m, between which the fluid moves as a plug; equal without a yield stress, R₁ and R₂ where nothing flows.
    ///
    /// # Errors
    /// As [`rest_radius`](Self::rest_radius).
    pub fn plug<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<[f64; 2], ViscometryError> {
        Ok(self.rest(fluid)?.map_or([self.inner_radius, self.outer_radius], |rest| {
            rest.plug.map(|place| self.radius(place.clamp(0.0, 1.0)))
        }))
    }

    /// `T_rz`, Pa, at the distance `r`, m, from the axis.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless R₁ ≤ r ≤ R₂; what the fluid refuses.
    pub fn shear_stress<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<f64, ViscometryError> {
        self.check(r)?;
        Ok(self.shear_about(self.rest_radius(fluid)?, r))
    }

    /// dv/dr = ζ(`T_rz`), 1/s.
    ///
    /// # Errors
    /// As [`shear_stress`](Self::shear_stress).
    pub fn shear_rate<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<f64, ViscometryError> {
        Ok(fluid.shear_rate(self.shear_stress(fluid, r)?)?)
    }

    /// v, m/s, at the distance `r`, m, from the axis.
    ///
    /// # Errors
    /// As [`shear_stress`](Self::shear_stress).
    pub fn velocity<F: ViscometricFluid + ?Sized>(&self, fluid: &F, r: f64) -> Result<Estimate, ViscometryError> {
        self.check(r)?;
        let Some(rest) = self.rest(fluid)? else { return Ok(self.plug_velocity()) };
        self.velocity_about(rest, fluid, r)
    }

    /// v, m/s, at each of the distances, m, into `velocities`; the place of rest is sought once.
    ///
    /// # Errors
    /// As [`velocity`](Self::velocity); [`ViscometryError::WrongLength`].
    pub fn profile_into<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        distances: &[f64],
        velocities: &mut [Estimate],
    ) -> Result<(), ViscometryError> {
        let rest = self.rest(fluid)?;
        profile(Self::NAME, distances, velocities, |r| {
            self.check(r)?;
            rest.map_or(Ok(self.plug_velocity()), |rest| self.velocity_about(rest, fluid, r))
        })
    }

    /// Q, m³/s.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn discharge<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        let Some(rest) = self.rest(fluid)? else {
            return Ok(self.plug_velocity().scaled(PI * self.gap() * (self.inner_radius + self.outer_radius)));
        };
        let lambda = self.radius(rest.place);
        let weight = |r: f64, place: f64, rate: f64| self.gap() * (place - rest.place) * (r + lambda) * rate;
        let inner = self.sheared(rest, fluid, Side::Inner, 0.0, weight)?;
        let outer = self.sheared(rest, fluid, Side::Outer, 1.0, weight)?;
        // Where λ moves every ζ grows by as much as ∫ ζ dr does in all: ξ² − λ² weighs it by no more than at the wall.
        let [inside, outside] =
            [self.inner_radius, self.outer_radius].map(|wall| (wall - lambda).abs() * (wall + lambda));
        let off = Estimate { value: 0.0, error: inside.max(outside) * rest.mismatch };
        let slipped =
            inside * self.slipped(lambda, self.inner_radius) - outside * self.slipped(lambda, self.outer_radius);
        let all = inner.plus(outer).plus(off).plus(Estimate::rounded(-slipped));
        finite(Self::NAME, "discharge", all.scaled(-PI.copysign(self.pressure_gradient)))
    }

    /// Q/(π (R₂² − R₁²)), m/s.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn mean_velocity<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        let area = PI * self.gap() * (self.inner_radius + self.outer_radius);
        Ok(self.discharge(fluid)?.scaled(area.recip()))
    }

    /// The stresses, Pa, at the distance `r`, m, from the axis and the height `z`, m.
    ///
    /// # Errors
    /// As [`shear_stress`](Self::shear_stress).
    pub fn stresses<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        r: f64,
        z: f64,
    ) -> Result<Stresses, ViscometryError> {
        check_finite(Self::NAME, "z", z)?;
        self.check(r)?;
        let rest = self.rest(fluid)?;
        let shear = self.shear_about(self.rest_or_middle(rest), r);
        let mut radial = Estimate::rounded(self.pressure_gradient * z);
        let mut sigma = [0.0; 2];
        if F::NORMAL_STRESSES
            && let Some(rest) = rest
        {
            let place = (r - self.inner_radius) / self.gap();
            let pressed = self.pressed(rest, fluid, place)?;
            sigma = normal_functions(fluid, self.rate(rest, fluid, place - rest.place)?.1);
            radial = radial.plus(pressed);
            // What moves with λ, by differences over a step that is known in units of the mismatch.
            let beside = self.rest_at(fluid, rest.place + STEP);
            let moved = self.pressed(beside, fluid, place)?.value - pressed.value;
            let others = normal_functions(fluid, self.rate(beside, fluid, place - beside.place)?.1);
            let all = moved.abs() + (others[0] - sigma[0]).abs() + (others[1] - sigma[1]).abs();
            radial.error += all * (rest.mismatch / self.balance(beside, fluid)?.value.abs());
        }
        Ok(Stresses::from_gradient(shear, radial.value, sigma, radial.error))
    }

    /// c Q, W/m: the power that a length of the annulus dissipates.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn dissipation<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        Ok(self.discharge(fluid)?.scaled(self.pressure_gradient))
    }

    /// The Reynolds number ρ V D/μ of the hydraulic diameter D = 2 (R₂ − R₁), where μ is the viscosity of the Newtonian fluid with the
    /// same discharge, and whether the flow is laminar and developed in an annulus of this length, m.
    ///
    /// Laminar up to 2100; the length of development is that of a channel of the same gap.
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
        let mean = self.mean_velocity(fluid)?.value.abs();
        let unit = self.with_slip(WallSlip::NONE).mean_velocity(&Newtonian::new(1.0)?)?.value.abs();
        let reynolds = if mean > 0.0 { density * mean * (2.0 * self.gap()) * (mean / unit) } else { 0.0 };
        Ok(duct(reynolds, length, entry_length(self.gap(), [0.631, 0.0442], 0.5 * reynolds)))
    }

    /// v at `r`, from the wall on its side of the plug.
    fn velocity_about<F: ViscometricFluid + ?Sized>(
        &self,
        rest: Rest,
        fluid: &F,
        r: f64,
    ) -> Result<Estimate, ViscometryError> {
        let place = (r - self.inner_radius) / self.gap();
        let weight = |_: f64, _: f64, rate: f64| rate;
        let (side, wall) = if place < rest.plug[0] { (Side::Inner, 0.0) } else { (Side::Outer, 1.0) };
        // Of one sign on either side: positive inside, negative outside.
        let all = self.sheared(rest, fluid, side, wall, weight)?;
        let some = self.sheared(rest, fluid, side, place, weight)?;
        // Beside the wall the difference of large numbers would keep few digits.
        let speed = if some.value.abs() < 0.5 * all.value.abs() {
            all.plus(some.scaled(-1.0))
        } else {
            self.beside_wall(rest, fluid, place, wall)?
        };
        let radius = if wall > 0.0 { self.outer_radius } else { self.inner_radius };
        let slipped = Estimate::rounded(self.slipped(self.radius(rest.place), radius).abs());
        let speed = Estimate { value: speed.value.abs(), error: speed.error + rest.mismatch }.plus(slipped);
        finite(Self::NAME, "velocity", speed.scaled(1.0_f64.copysign(self.pressure_gradient)))
    }

    /// ∫ ζ dr between two places on one side of the plug, but for the sign.
    fn beside_wall<F: ViscometricFluid + ?Sized>(
        &self,
        rest: Rest,
        fluid: &F,
        from: f64,
        to: f64,
    ) -> Result<Estimate, ViscometryError> {
        let width = to - from;
        let beyond = from - rest.place;
        let rate = |x: f64| Ok(self.rate(rest, fluid, beyond + width * x)?.1);
        Ok(integrate(&[0.0, 1.0], rate)?.scaled(width * self.gap()))
    }

    /// λ, for |c|; `None` where nothing flows.
    fn rest<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Option<Rest>, ViscometryError> {
        let drive = self.pressure_gradient.abs();
        if drive * self.gap() <= 2.0 * fluid.yield_stress() {
            return Ok(None);
        }
        // Where λ is too far out the stress at the inner wall may be beyond the fluid: no rate, or none that is a number.
        let mut refused = None;
        let place = zero(0.0, 1.0, |place| {
            let rest = self.rest_at(fluid, place);
            let outer = self.balance_of(Side::Outer, rest, fluid)?;
            Ok(match self.balance_of(Side::Inner, rest, fluid) {
                Ok(inner) if inner.value.is_finite() => inner.value + outer.value,
                Ok(_) => f64::INFINITY,
                Err(error) => {
                    refused = Some(error);
                    f64::INFINITY
                }
            })
        })?;
        let rest = self.rest_at(fluid, place);
        let lambda = self.radius(place);
        let walls = [self.inner_radius, self.outer_radius].map(|wall| self.shear_about(lambda, wall).abs());
        check_rising(Self::NAME, fluid, fluid.shear_rate(walls[0].max(walls[1]))?)?;
        let left = self.balance(rest, fluid)?;
        let mismatch = left.value.abs() + left.error;
        if let Some(error) = refused {
            // The sides do not meet before the fluid refuses, and not for want of digits.
            let outer = self.balance_of(Side::Outer, rest, fluid)?;
            if outer.value.abs() < 1e6 * mismatch && outer.error < outer.value.abs() {
                return Err(error);
            }
        }
        Ok(Some(Rest { mismatch, ..rest }))
    }

    /// ∫ ζ dr over the gap and the slip of both walls, which grows with λ.
    fn balance<F: ViscometricFluid + ?Sized>(&self, rest: Rest, fluid: &F) -> Result<Estimate, ViscometryError> {
        Ok(self.balance_of(Side::Inner, rest, fluid)?.plus(self.balance_of(Side::Outer, rest, fluid)?))
    }

    /// The part of one side: positive inside, negative outside.
    fn balance_of<F: ViscometricFluid + ?Sized>(
        &self,
        side: Side,
        rest: Rest,
        fluid: &F,
    ) -> Result<Estimate, ViscometryError> {
        let (to, wall) = match side {
            Side::Inner => (0.0, self.inner_radius),
            Side::Outer => (1.0, self.outer_radius),
        };
        let sheared = self.sheared(rest, fluid, side, to, |_, _, rate| rate)?;
        Ok(sheared.plus(Estimate::rounded(self.slipped(self.radius(rest.place), wall))))
    }

    /// `v_s` of |c| at a wall: positive at the inner one, negative at the outer one.
    fn slipped(&self, lambda: f64, wall: f64) -> f64 {
        self.slip.speed(self.shear_about(lambda, wall) * self.pressure_gradient.signum())
    }

    /// The velocity of a fluid that does not yield: both walls slip alike, about λ² = R₁ R₂.
    fn plug_velocity(&self) -> Estimate {
        Estimate::rounded(self.slip.speed(0.5 * self.pressure_gradient * self.gap()))
    }

    /// ∫ σ₁ dr/r from a place to the outer wall, in parts that begin at the plug: signs are those of the ways.
    fn pressed<F: ViscometricFluid + ?Sized>(
        &self,
        rest: Rest,
        fluid: &F,
        place: f64,
    ) -> Result<Estimate, ViscometryError> {
        let weight = |r: f64, _: f64, rate: f64| fluid.sigma1(rate) / r;
        let outer = self.sheared(rest, fluid, Side::Outer, 1.0, weight)?;
        Ok(if place > rest.plug[1] {
            outer.plus(self.sheared(rest, fluid, Side::Outer, place, weight)?.scaled(-1.0))
        } else if place < rest.plug[0] {
            outer.plus(self.sheared(rest, fluid, Side::Inner, place, weight)?)
        } else {
            outer
        })
    }

    /// λ; where nothing flows √(R₁ R₂).
    fn rest_or_middle(&self, rest: Option<Rest>) -> f64 {
        rest.map_or((self.inner_radius * self.outer_radius).sqrt(), |rest| self.radius(rest.place))
    }

    /// −½ c (r − λ²/r).
    fn shear_about(&self, lambda: f64, r: f64) -> f64 {
        -0.5 * self.pressure_gradient * ((r - lambda) * ((r + lambda) / r))
    }

    /// The plug about a place of rest: r² ∓ 2 a r − λ² = 0 with a = `τ_y`/c.
    fn rest_at<F: ViscometricFluid + ?Sized>(&self, fluid: &F, place: f64) -> Rest {
        let half = fluid.yield_stress() / self.pressure_gradient.abs();
        let lambda = self.radius(place);
        let beyond = half * (half / (half.hypot(lambda) + lambda));
        let plug = [place + (beyond - half) / self.gap(), place + (beyond + half) / self.gap()];
        Rest { place, plug, mismatch: 0.0 }
    }

    /// ∫ w(r, place, ζ) dr from the end of the plug outwards or inwards to a place, counted positive on both sides.
    fn sheared<F: ViscometricFluid + ?Sized>(
        &self,
        rest: Rest,
        fluid: &F,
        side: Side,
        to: f64,
        weight: impl Fn(f64, f64, f64) -> f64,
    ) -> Result<Estimate, ViscometryError> {
        let start = match side {
            Side::Inner => rest.plug[0],
            Side::Outer => rest.plug[1],
        };
        let way = to - start;
        let is_empty = match side {
            Side::Inner => way >= 0.0,
            Side::Outer => way <= 0.0,
        };
        if is_empty {
            return Ok(Estimate::ZERO);
        }
        let beyond = start - rest.place;
        if fluid.yield_stress() > 0.0 && way.abs() < NEAR {
            // The stress beyond yield has too few digits for a rule; between nothing and the rate at its end the integral lies.
            let (r, rate) = self.rate(rest, fluid, beyond + way)?;
            let most = weight(r, to, rate) * (way.abs() * self.gap());
            return Ok(Estimate { value: 0.5 * most, error: most.abs() });
        }
        // The cube of the variable: at the plug the rate begins like a power, often less than the first.
        let integral = integrate(&[0.0, 1.0], |x| {
            let offset = beyond + way * (x * x * x);
            let (r, rate) = self.rate(rest, fluid, offset)?;
            Ok(weight(r, rest.place + offset, rate) * (3.0 * x * x))
        })?;
        Ok(integral.scaled(way.abs() * self.gap()))
    }

    /// r and ζ(`T_rz`) of |c| at a distance from the place of rest, in gaps.
    fn rate<F: ViscometricFluid + ?Sized>(
        &self,
        rest: Rest,
        fluid: &F,
        offset: f64,
    ) -> Result<(f64, f64), ViscometryError> {
        let (r, lambda) = (self.radius(rest.place + offset), self.radius(rest.place));
        let drive = self.pressure_gradient.abs();
        let stress = -0.5 * drive * (self.gap() * offset) * ((r + lambda) / r);
        Ok((r, fluid.shear_rate(stress)?))
    }

    fn radius(&self, place: f64) -> f64 {
        self.inner_radius + self.gap() * place
    }

    const fn gap(&self) -> f64 {
        self.outer_radius - self.inner_radius
    }

    fn check(&self, r: f64) -> Result<(), ViscometryError> {
        check_bound(Self::NAME, "r", r, "R₁ ≤ r ≤ R₂", self.inner_radius <= r && r <= self.outer_radius)
    }
}

/// Which side of the plug.
#[derive(Clone, Copy, Debug)]
enum Side {
    Inner,
    Outer,
}
