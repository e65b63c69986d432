//! Stated errors of inversions of functions are not below the true ones.

use core::f64::consts::{PI, TAU};

use piola_numerics::{Mask, Real};
use piola_testkit::{Tol, assert_close};
use piola_viscometry::recover::{CouetteGeometry, MeasuredCurve, PipeGeometry, functions};

/// ΔΩ between cylinders of radii 1 and R₂ for ζ = Σ a sᵖ: ½ Σ (a/p) T₁ᵖ (1 − R₂^(−2p)).
struct Powers<'p> {
    terms: &'p [[f64; 2]],
    outer: f64,
}

impl Powers<'_> {
    fn rate(&self, stress: f64) -> f64 {
        self.terms.iter().map(|[factor, power]| factor * stress.powf(*power)).sum()
    }
}

impl MeasuredCurve for Powers<'_> {
    fn response<T: Real>(&self, torque: T) -> T {
        let wall = torque * T::lit(TAU.recip());
        self.terms.iter().fold(T::zero(), |sum, &[factor, power]| {
            let share = -(-2.0 * power * (self.outer - 1.0).ln_1p()).exp_m1();
            sum + wall.powf(T::lit(power)) * T::lit(0.5 * factor / power * share)
        })
    }
}

/// Bingham's ΔΩ with a yield stress and a viscosity of 1: ½ [s − ln s] from max(T₂, 1) to T₁.
struct Bingham {
    outer: f64,
}

impl MeasuredCurve for Bingham {
    fn response<T: Real>(&self, torque: T) -> T {
        let wall = torque * T::lit(TAU.recip());
        let (outer, one) = (wall * T::lit(self.outer.powi(-2)), T::one());
        let low = T::select(outer.less_than(one), one, outer);
        let value = T::lit(0.5) * (wall - low - (wall / low).ln());
        if wall.at_most(one).all() { T::zero() } else { value }
    }
}

/// Buckingham and Reiner's discharge of a pipe of radius 1: (πc/8) (1 − 4φ/3 + φ⁴/3), φ = 2/c.
struct Buckingham;

impl MeasuredCurve for Buckingham {
    fn response<T: Real>(&self, gradient: T) -> T {
        let share = T::lit(2.0) / gradient;
        let reduced = T::one() - T::lit(4.0 / 3.0) * share + share.powi(4) * T::lit(1.0 / 3.0);
        if T::one().at_most(share).all() { T::zero() } else { T::lit(PI / 8.0) * gradient * reduced }
    }
}

/// What is wrong with the stated error at a stress, if anything: the true one may be above it by the rounding of the curve alone.
fn understated(curve: &impl MeasuredCurve, outer: f64, stress: f64, truth: f64, rounding: Tol) -> Option<String> {
    let gap = CouetteGeometry::new(1.0, outer).expect("a gap");
    let found = functions::couette(curve, gap, stress * TAU).expect("a sum");
    let off = (found.value - truth).abs();
    let is_stated = off <= found.error + rounding.value() * truth && off <= 1e-8 * truth;
    (!is_stated).then(|| format!("R1/R2 = {}, {stress} Pa: off by {off:e} of {truth:e}, {found:?}", 1.0 / outer))
}

const RATIOS: [f64; 4] = [0.5, 0.9, 0.99, 0.999];

#[test]
fn stated_errors_of_the_series_are_not_below_the_true_ones_for_powers_and_plateaus() {
    // Power laws of n = 2, 1, 0.6, 0.2; Ellis' fluids of α = 3 and 1.7, Newtonian at small stresses.
    let fluids: [&[[f64; 2]]; 6] = [
        &[[1.3, 0.5]],
        &[[0.7, 1.0]],
        &[[1.3, 1.0 / 0.6]],
        &[[0.2, 5.0]],
        &[[0.5, 1.0], [0.25, 3.0]],
        &[[0.5, 1.0], [0.25, 1.7]],
    ];
    let mut wrong = Vec::new();
    for terms in fluids {
        for ratio in RATIOS {
            let curve = Powers { terms, outer: 1.0 / ratio };
            // Powers multiply the rounding of the torque and of logarithms.
            let most = terms.iter().map(|[_, power]| *power).fold(1.0, f64::max);
            for stress in [1e-3, 0.3, 1.5, 4.0, 40.0] {
                let rounding = Tol::ulps(16.0).times(most);
                wrong.extend(understated(&curve, curve.outer, stress, curve.rate(stress), rounding));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn stated_errors_of_the_series_are_not_below_the_true_ones_for_a_yield_stress_in_narrow_gaps() {
    let mut wrong = Vec::new();
    for ratio in RATIOS {
        let curve = Bingham { outer: 1.0 / ratio };
        for stress in [1.001, 1.05, 1.5, 2.0, 10.0, 900.0] {
            // The torque is known to an ulp, what is above yield to less; the terms of the series are all as large as the first.
            let condition = stress / (stress - 1.0) / (1.0 - ratio * ratio);
            let rounding = Tol::ulps(8.0).times(condition);
            wrong.extend(understated(&curve, curve.outer, stress, stress - 1.0, rounding));
        }
        let gap = CouetteGeometry::new(1.0, curve.outer).expect("a gap");
        let at_rest = functions::couette(&curve, gap, 0.9 * TAU).expect("a sum");
        assert!(at_rest.value.abs() <= 0.0 && at_rest.error.abs() <= 0.0);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_discharge_of_buckingham_and_reiner_gives_back_binghams_fluid() {
    let pipe = PipeGeometry::new(1.0).expect("a pipe");
    for stress in [1.001, 1.05, 1.5, 2.0, 10.0, 900.0] {
        let wall = functions::pipe(&Buckingham, pipe, 2.0 * stress).expect("finite");
        let condition = stress / (stress - 1.0);
        assert_close("shear rate", &[wall.shear_rate], &[stress - 1.0], Tol::ulps(8.0).times(condition));
    }
    let at_rest = functions::pipe(&Buckingham, pipe, 1.8).expect("finite");
    assert!(at_rest.shear_rate.abs() <= 0.0);
}
