//! Answers to 25 digits: the printed formulas over numbers of twice the digits, by the rule of tanh and sinh.

use std::f64::consts::PI;

use piola_fluids::ViscometricFluid;
use piola_numerics::Real;
use piola_testkit::DoubleDouble;

type Number = DoubleDouble;

/// π.
fn pi() -> Number {
    Number::of_sum(PI, 1.224_646_799_147_353_2e-16)
}

fn whole(value: f64) -> Number {
    Number::lit(value)
}

/// ∫ f from `from` to `to`, for f analytic but at the ends.
fn integral(from: Number, to: Number, mut f: impl FnMut(Number) -> Number) -> Number {
    const STEPS: i32 = 24;
    let (width, step) = (to - from, whole(f64::from(STEPS)).recip());
    let mut sum = whole(0.0);
    for k in -4 * STEPS..=4 * STEPS {
        let t = step * whole(f64::from(k));
        // x = 1/(1 + e^(−π sinh t)) and dx = π cosh t x (1 − x) dt: the smaller of x and 1 − x keeps its digits.
        let arc = pi() * t.sinh();
        let near = arc.abs().exp();
        let small = (whole(1.0) + near).recip();
        let place = if k < 0 { from + width * small } else { to - width * small };
        let weight = pi() * t.cosh() * small * (whole(1.0) - small);
        if weight.primal(0) > 1e-33 {
            sum += weight * f(place);
        }
    }
    sum * width * step
}

/// ζ.
fn rate<F: ViscometricFluid>(fluid: &F, stress: Number) -> Number {
    fluid.shear_rate(stress).unwrap_or_else(|_| whole(f64::NAN))
}

/// ∫ sᵖ ζ ds between two stresses.
fn moment<F: ViscometricFluid>(fluid: &F, power: i32, from: Number, to: Number) -> Number {
    let yields = whole(fluid.yield_stress());
    let from = if from.less_than(yields) { yields } else { from };
    if to.at_most(from) {
        return whole(0.0);
    }
    integral(from, to, |s| s.powi(power) * rate(fluid, s))
}

/// v of a pipe at a distance from its axis.
#[must_use]
pub fn pipe_velocity<F: ViscometricFluid>(fluid: &F, radius: f64, gradient: f64, r: f64) -> Number {
    let half = whole(0.5) * whole(gradient);
    moment(fluid, 0, half * whole(r), half * whole(radius)) / half
}

/// Q of a pipe.
#[must_use]
pub fn pipe_discharge<F: ViscometricFluid>(fluid: &F, radius: f64, gradient: f64) -> Number {
    let half = whole(0.5) * whole(gradient);
    pi() * moment(fluid, 2, whole(0.0), half * whole(radius)) / half.powi(3)
}

/// Q of a channel per width.
#[must_use]
pub fn channel_discharge<F: ViscometricFluid>(fluid: &F, half_width: f64, gradient: f64) -> Number {
    let c = whole(gradient);
    whole(2.0) * moment(fluid, 1, whole(0.0), c * whole(half_width)) / c.powi(2)
}

/// M between cylinders with a given ΔΩ, from a torque near it: Newton's method, each step doubles the digits.
#[must_use]
pub fn couette_torque<F: ViscometricFluid>(fluid: &F, [inner, outer]: [f64; 2], speed: f64, near: f64) -> Number {
    let stress = |torque: Number, r: f64| torque / (whole(2.0) * pi() * whole(r).powi(2));
    let mut torque = whole(near);
    for _ in 0..3 {
        let [low, high] = [stress(torque, outer), stress(torque, inner)];
        let excess = whole(0.5) * moment(fluid, -1, low, high) - whole(speed);
        let slope = whole(0.5) * (rate(fluid, high) - rate(fluid, low)) / torque;
        torque -= excess / slope;
    }
    torque
}

#[cfg(test)]
mod tests {
    use piola_fluids::PowerLaw;

    use super::{channel_discharge, pi, pipe_discharge, whole};

    #[test]
    fn discharges_of_a_power_law_equal_closed_forms_to_25_digits() {
        let fluid = PowerLaw::new(2.0, 0.5).expect("within bounds");
        // ζ = (s/2)²: Q = π (2/c)³ (cR/2)⁵/20 and (2/c²) (cd)⁴/16.
        let pipe = whole(5.0) * pipe_discharge(&fluid, 1.0, 4.0) / pi();
        let channel = channel_discharge(&fluid, 1.0, 2.0) / whole(0.5);
        for ratio in [pipe, channel] {
            assert!(ratio.rounding_of(1.0).abs() < 1e-25, "{ratio:?}");
        }
    }
}
