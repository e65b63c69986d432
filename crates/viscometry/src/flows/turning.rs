//! Cone and plate and parallel discs with slip: every circle is plane Couette flow in the gap there.
//!
//! ```text
//! h(r) ζ(τ) + 2 v_s(τ) = Ω r      M = 2π ∫ r² τ dr      with h(r) = h between discs, α r under a cone
//! ```
//! Up to the radius 2 `v_s(τ_y)`/Ω the fluid does not yield, and slips as a plug.

use std::f64::consts::PI;

use piola_fluids::ViscometricFluid;

use super::PlaneCouette;
use crate::inverse::{Wanted, solve};
use crate::quadrature::integrate;
use crate::{Estimate, ViscometryError, WallSlip};

/// The width of the gap.
#[derive(Clone, Copy, Debug)]
pub(super) enum Gap {
    /// h, m.
    Even(f64),
    /// α, rad: α r.
    Cone(f64),
}

/// A gap between a surface at rest and one that turns, with slip at both.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turning {
    pub(super) flow: &'static str,
    /// R, m.
    pub(super) radius: f64,
    pub(super) gap: Gap,
    /// Ω, rad/s.
    pub(super) speed: f64,
    pub(super) slip: WallSlip,
}

impl Turning {
    /// Plane Couette flow at the distance 0 < `r` from the axis.
    pub(super) fn at(&self, r: f64) -> Result<PlaneCouette, ViscometryError> {
        let gap = match self.gap {
            Gap::Even(gap) => gap,
            Gap::Cone(angle) => angle * r,
        };
        Ok(PlaneCouette::new(gap, self.speed * r)?.with_slip(self.slip))
    }

    /// ∫ w(r, τ, k) dr from `from`, or where the fluid begins to yield, to R, with 0 ≤ τ and 0 ≤ k.
    fn integral<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        from: f64,
        weight: impl Fn(f64, f64, f64) -> f64,
    ) -> Result<Estimate, ViscometryError> {
        let start = from.max(self.plug(fluid));
        let way = self.radius - start;
        if way <= 0.0 {
            return Ok(Estimate::ZERO);
        }
        // The cube of the variable: stresses begin like a power of the radius, often less than the first.
        let integral = integrate(&[0.0, 1.0], |x| {
            let r = start + way * (x * x * x);
            if r <= 0.0 {
                return Ok(0.0);
            }
            let stress = self.at(r)?.shear_stress(fluid)?.abs();
            Ok(weight(r, stress, fluid.shear_rate(stress)?) * (3.0 * x * x))
        })?;
        Ok(integral.scaled(way))
    }

    /// The radius up to which the fluid slips and does not yield.
    fn plug<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> f64 {
        let yields = fluid.yield_stress();
        if yields > 0.0 { (2.0 * self.slip.speed(yields) / self.speed.abs()).min(self.radius) } else { 0.0 }
    }

    /// M, N m.
    pub(super) fn torque<F: ViscometricFluid + ?Sized>(&self, fluid: &F) -> Result<Estimate, ViscometryError> {
        if self.speed.abs() <= 0.0 {
            return Ok(Estimate::ZERO);
        }
        let sheared = self.integral(fluid, 0.0, |r, stress, _| r * r * stress)?;
        let plug = self.plug(fluid);
        // τ = (Ω r/2b)^(1/m).
        let slipping = if plug > 0.0 {
            let stress = self.slip.stress(0.5 * self.speed.abs() * plug);
            Estimate::rounded(stress * plug.powi(3) / (3.0 + self.slip.exponent().recip()))
        } else {
            Estimate::ZERO
        };
        super::wall::finite(self.flow, "torque", sheared.plus(slipping).scaled((2.0 * PI).copysign(self.speed)))
    }

    /// ∫ w(r, k) dr from `from` to R of what vanishes with the rate.
    pub(super) fn normal<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        from: f64,
        weight: impl Fn(f64, f64) -> f64,
    ) -> Result<Estimate, ViscometryError> {
        if self.speed.abs() <= 0.0 {
            return Ok(Estimate::ZERO);
        }
        self.integral(fluid, from, |r, _, rate| if rate > 0.0 { weight(r, rate) } else { 0.0 })
    }

    /// |Ω|, rad/s, with which the torque, N m, is this one.
    pub(super) fn speed_of<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        torque: f64,
    ) -> Result<f64, ViscometryError> {
        let target = torque.abs();
        if target <= 0.0 {
            return Ok(0.0);
        }
        let stress = 1.5 * target / (PI * self.radius.powi(3));
        let rim = match self.gap {
            Gap::Even(gap) => gap / self.radius,
            Gap::Cone(angle) => angle,
        };
        let start = rim * fluid.shear_rate(stress)? + 2.0 * self.slip.speed(stress) / self.radius;
        let wanted = Wanted { flow: self.flow, quantity: "torque", value: target };
        solve(wanted, start, |speed| {
            let at = |speed: f64| Self { speed, ..*self }.torque(fluid);
            let value = at(speed)?.value;
            // The slope steers the search; its error costs a step, not a digit.
            let beside = at(speed * (1.0 + 1e-5))?.value;
            Ok((value, (beside - value) / (speed * 1e-5)))
        })
    }
}
