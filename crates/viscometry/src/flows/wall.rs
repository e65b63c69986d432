//! Channel, pipe and film: the shear stress grows in proportion to the distance from a place of rest up to a wall.
//!
//! With L that distance and `τ_w` the stress at the wall: v = L m₀ + `v_s` and, over the cross section, V = L mₚ + `v_s`, where mₚ is the
//! moment ∫ sᵖ ζ ds over `τ_wᵖ⁺¹`.

use piola_fluids::{FlowMoment, ViscometricFluid};
use piola_numerics::Dual;

use crate::error::{check_bound, check_finite};
use crate::inverse::{Wanted, solve};
use crate::quadrature::{Span, scaled_moment};
use crate::{Estimate, Validity, ViscometryError, WallSlip, Warning};

/// Names of the flow and of the half of its width.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheared {
    pub(super) flow: &'static str,
    /// L, m.
    pub(super) length: f64,
    /// `τ_w`, Pa, signed.
    pub(super) wall_stress: f64,
    pub(super) slip: WallSlip,
}

impl Sheared {
    /// v, m/s, at the distance (1 − `share`) L from the place of rest.
    pub(super) fn velocity<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        share: f64,
    ) -> Result<Estimate, ViscometryError> {
        self.signed(fluid, FlowMoment::Zeroth, share)
    }

    /// V, m/s, with the moment of the cross section.
    pub(super) fn mean_velocity<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        moment: FlowMoment,
    ) -> Result<Estimate, ViscometryError> {
        self.signed(fluid, moment, 1.0)
    }

    fn signed<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        moment: FlowMoment,
        share: f64,
    ) -> Result<Estimate, ViscometryError> {
        let span = Span { top: self.wall_stress.abs(), share };
        let sheared = scaled_moment(fluid, moment, span)?.scaled(self.length.copysign(self.wall_stress));
        let all = sheared.plus(Estimate::rounded(self.slip.speed(self.wall_stress)));
        finite(self.flow, "velocity", all)
    }

    /// The stress at the wall, Pa, with which the mean velocity is this one; `nominal` is the rate of a Newtonian fluid at the wall
    /// over V/L.
    pub(super) fn wall_stress_of<F: ViscometricFluid + ?Sized>(
        &self,
        fluid: &F,
        moment: FlowMoment,
        mean_velocity: f64,
        nominal: f64,
    ) -> Result<f64, ViscometryError> {
        let target = mean_velocity.abs();
        if target <= 0.0 {
            return Ok(0.0);
        }
        let yields = fluid.yield_stress();
        if !self.slip.is_none() && target <= self.slip.speed(yields) {
            return Ok(self.slip.stress(target).copysign(mean_velocity));
        }
        let start = fluid.shear_stress(nominal * target / self.length) - yields;
        let order = f64::from(moment.power() + 1);
        let wanted = Wanted { flow: self.flow, quantity: "mean velocity", value: target };
        let excess = solve(wanted, start, |excess| {
            let top = yields + excess;
            let mean = scaled_moment(fluid, moment, Span { top, share: 1.0 })?.value;
            let slope = (fluid.shear_rate(top)? - order * mean) / top;
            Ok((self.length * mean + self.slip.speed(top), self.length * slope + self.slip.slope(top)))
        })?;
        Ok((yields + excess).copysign(mean_velocity))
    }
}

/// Refuses an answer beyond the range of numbers.
pub(super) fn finite(
    flow: &'static str,
    quantity: &'static str,
    answer: Estimate,
) -> Result<Estimate, ViscometryError> {
    if answer.value.is_finite() {
        Ok(answer)
    } else {
        Err(ViscometryError::NotFinite { flow, quantity, value: answer.value })
    }
}

/// 0 < ρ.
pub(super) fn check_density(flow: &'static str, density: f64) -> Result<(), ViscometryError> {
    check_bound(flow, "density", density, "0 < ρ", 0.0 < density)
}

/// τ, Pa, at a rate other than 0; refused where it falls, for no steady shear is stable there.
pub(super) fn rising_stress<F: ViscometricFluid + ?Sized>(
    flow: &'static str,
    fluid: &F,
    rate: f64,
) -> Result<f64, ViscometryError> {
    let Dual { value, tangent } = fluid.shear_stress(Dual::variable(rate));
    if tangent < 0.0 {
        return Err(ViscometryError::NotIncreasing { fluid: F::NAME, shear_rate: rate, slope: tangent });
    }
    check_finite(flow, "shear stress", value)?;
    Ok(value)
}

/// Refuses a fluid whose stress falls at one of 36 rates over eight decades below this one: a stress would have several rates.
pub(super) fn check_rising<F: ViscometricFluid + ?Sized>(
    flow: &'static str,
    fluid: &F,
    rate: f64,
) -> Result<(), ViscometryError> {
    let mut rates = (0..36).map(|k| rate * (-0.5 * f64::from(k)).exp()).take_while(|rate| *rate > 0.0);
    rates.try_for_each(|rate| rising_stress(flow, fluid, rate).map(drop))
}

/// σ₁ and σ₂ at a rate; none is computed for a fluid that has none, nor at rest.
pub(super) fn normal_functions<F: ViscometricFluid + ?Sized>(fluid: &F, rate: f64) -> [f64; 2] {
    if F::NORMAL_STRESSES && rate != 0.0 { [fluid.sigma1(rate), fluid.sigma2(rate)] } else { [0.0; 2] }
}

/// The length, m, over which a flow develops in a duct of the width `width`, m: (aᵖ + (b Re)ᵖ)^(1/p), p = 1.6, times the width.
///
/// F. Durst, S. Ray, B. Ünsal, O. A. Bayoumi, *J. Fluids Eng.* 127 (2005) 1154.
pub(super) fn entry_length(width: f64, [a, b]: [f64; 2], reynolds: f64) -> f64 {
    width * (a.powf(1.6) + (b * reynolds).powf(1.6)).powf(0.625)
}

/// Up to this the flow in a duct is laminar.
const LAMINAR: f64 = 2100.0;

/// The Reynolds number `factor` ρ V²/|`τ_w`|; zero at rest.
pub(super) fn generalised_reynolds(factor: f64, density: f64, mean_velocity: f64, wall_stress: f64) -> f64 {
    let speed = mean_velocity.abs();
    if speed > 0.0 { factor * density * speed * (speed / wall_stress.abs()) } else { 0.0 }
}

/// The validity of a flow in a duct; it is developed where half of the length or more is.
pub(super) fn duct(reynolds: f64, length: f64, developing: f64) -> Validity {
    Validity::new(
        reynolds,
        [
            (LAMINAR < reynolds, Warning::Turbulence { reynolds, critical: LAMINAR }),
            (length < 2.0 * developing, Warning::Entry { length, developing }),
        ],
    )
}

/// The distance from the place of rest within which the fluid does not yield.
pub(super) fn plug(length: f64, wall_stress: f64, yield_stress: f64) -> f64 {
    let wall = wall_stress.abs();
    if yield_stress <= 0.0 {
        0.0
    } else if wall <= yield_stress {
        length
    } else {
        length * (yield_stress / wall)
    }
}

/// An answer at each place.
pub(super) fn profile(
    flow: &'static str,
    places: &[f64],
    answers: &mut [Estimate],
    mut at: impl FnMut(f64) -> Result<Estimate, ViscometryError>,
) -> Result<(), ViscometryError> {
    if places.len() != answers.len() {
        let (expected, found) = (places.len(), answers.len());
        return Err(ViscometryError::WrongLength { flow, quantity: "velocities", expected, found });
    }
    for (place, answer) in places.iter().zip(answers) {
        *answer = at(*place)?;
    }
    Ok(())
}

/// The Reynolds number ρ |Ω| L² k/τ of a turning gap of the depth L, and the warning that inertia adds 1 % to its torque.
pub(super) fn secondary_flow(density: f64, speed: f64, depth: f64, rate: f64, stress: f64) -> (f64, (bool, Warning)) {
    const CRITICAL: f64 = 4.0;
    let reynolds = if rate.abs() > 0.0 { density * speed.abs() * depth * depth * (rate / stress) } else { 0.0 };
    (reynolds, (CRITICAL < reynolds, Warning::SecondaryFlow { reynolds, critical: CRITICAL }))
}
