//! Helpers shared by the formulas of fluids: signs, finite rates, moments of powers, roots of growing relations.

use piola_numerics::{Dual, Mask, Real};

use super::viscometric::{FlowMoment, ViscometricFluid};
use crate::FluidsError;

/// `size` with the sign of k, and zero where k is.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn signed<T: Real>(k: T, size: T) -> T {
    T::select(k.less_than(T::zero()), -size, T::select(T::zero().less_than(k), size, T::zero()))
}

/// k, or 1 where it is zero, so that a quotient or power of it exists before the limit replaces it.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn moving<T: Real>(k: T) -> (T::Mask, T) {
    let size = k.abs();
    let rest = size.at_most(T::zero());
    (rest, T::select(rest, T::one(), size))
}

/// τ/k with its limit at rest.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn viscosity_with_limit<F: ViscometricFluid, T: Real>(fluid: &F, k: T, limit: f64) -> T {
    let (rest, k) = moving(k);
    T::select(rest, T::lit(limit), fluid.shear_stress(k) / k)
}

/// The part of a stress beyond the yield stress; zero below. Exact: the difference of two numbers less than a factor of two
/// apart has no rounding.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn beyond<T: Real>(stress: T, yield_stress: T) -> T {
    let excess = stress.abs() - yield_stress;
    T::select(T::zero().less_than(excess), excess, T::select(excess.is_nan(), excess, T::zero()))
}

/// A rate that a closed form gave, refused where it is not finite.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn finite_rate<F: ViscometricFluid, T: Real>(stress: T, rate: T) -> Result<T, FluidsError> {
    if (stress.is_finite() & rate.is_finite()).all() { Ok(rate) } else { Err(no_rate::<F, T>(stress, rate)) }
}

/// The error of the first lane without a rate.
#[cold]
fn no_rate<F: ViscometricFluid, T: Real>(stress: T, rate: T) -> FluidsError {
    let bad = |lane: &usize| !(stress.primal(*lane).is_finite() && rate.primal(*lane).is_finite());
    let lane = (0..T::LANES).find(bad).unwrap_or(0);
    let stress = stress.primal(lane);
    FluidsError::NoShearRate { fluid: F::NAME, stress, residual: stress }
}

/// ∫ s^(power − 1) (s/scale)^m ds from `from` to `to`: no power of a large or small number alone, and the difference through
/// its ratio, so that a narrow interval keeps its digits. 0 ≤ from ≤ to, 0 < power + m.
pub(super) fn moment_of_power(power: i32, exponent: f64, scale: f64, from: f64, to: f64) -> f64 {
    if to <= 0.0 {
        return 0.0;
    }
    let q = f64::from(power) + exponent;
    let whole = to.powi(power) * (to / scale).powf(exponent);
    let share = if 0.0 < from { -(q * ((from - to) / to).ln_1p()).exp_m1() } else { 1.0 };
    whole * share / q
}

/// (τᵧ + u)ᵖ = Σ cᵢ uⁱ for 0 ≤ p: the cᵢ, and how many.
pub(super) fn shifted_power(moment: FlowMoment, yield_stress: f64) -> Option<([f64; 3], usize)> {
    match moment {
        FlowMoment::Reciprocal => None,
        FlowMoment::Zeroth => Some(([1.0, 0.0, 0.0], 1)),
        FlowMoment::First => Some(([yield_stress, 1.0, 0.0], 2)),
        FlowMoment::Second => Some(([yield_stress * yield_stress, 2.0 * yield_stress, 1.0], 3)),
    }
}

/// A growing relation x(y) between numbers without dimension with x ≥ y and a slope in logarithms of at least one.
pub(super) trait Relation<T: Real> {
    /// x at y, 0 ≤ y; derivatives of the parameters are carried where those of y are.
    fn at(&self, y: Dual<T>) -> Dual<T>;
}

/// The y of a relation at x, 0 ≤ x, from a start that is not below it.
///
/// ln x is a convex function of ln y, so that Newton's method descends to it; then steps in y itself, in which also
/// derivatives enter, one order a step.
///
/// # Accuracy
/// 2 ulp beyond the rounding of the relation.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn solve_from_above<T: Real>(relation: &impl Relation<T>, x: T, start: T) -> T {
    let wanted = x.frozen();
    let (rest, target) = moving(wanted);
    let mut y = T::select(rest, T::one(), start.frozen());
    for _ in 0..100 {
        let at = relation.at(Dual { value: y, tangent: y });
        let step = ((at.value.frozen() / target).ln() * at.value / at.tangent).frozen();
        y *= (-step).exp();
        if (step.abs().at_most(T::lit(1e-9)) | rest | step.is_nan()).all() {
            break;
        }
    }
    let mut y = T::select(rest, T::zero(), y);
    for _ in 0..=T::ORDER + 1 {
        let at = relation.at(Dual { value: y, tangent: T::one() });
        let step = (at.value - x) / at.tangent.frozen();
        y -= step;
    }
    y
}

/// ln(x + √(1 + x²)) for 0 ≤ x.
///
/// # Accuracy
/// 4 ulp.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn inverse_sinh<T: Real>(x: T) -> T {
    let large = T::lit(1e8).less_than(x);
    let near = T::select(large, T::one(), x);
    let root = (T::one() + near * near).sqrt();
    let value = (near + near * near / (T::one() + root)).ln_1p();
    // 1/(4 x²) is below the rounding of ln 2 x.
    if large.any() { T::select(large, x.ln() + T::lit(core::f64::consts::LN_2), value) } else { value }
}
