//! Homogeneous tests against closed forms.

use piola_constitutive::homogeneous::{
    Incompressible, IncompressibleState, Mode, nominal_stress, nominal_stress_and_slope,
};
use piola_constitutive::solids::MooneyRivlin;
use piola_numerics::{Dual, Gradient, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

const STRESS: Tol = Tol::stated(1e-13, "stresses of ordinary and of small strains");

fn rubber() -> MooneyRivlin {
    MooneyRivlin::stress_free(0.37, 0.11, 2.0).expect("parameters")
}

/// The same energy in stretches, its parameters over any scalar.
struct InStretches<T> {
    c10: T,
    c01: T,
}

impl<T: Real> Incompressible<T> for InStretches<T> {
    fn energy_of_stretches(&self, stretches: [Dual<T>; 3]) -> Dual<T> {
        let squares = stretches.map(|x| x * x);
        let first = squares[0] + squares[1] + squares[2];
        let second = squares[0].recip() + squares[1].recip() + squares[2].recip();
        Dual::constant(self.c10) * first + Dual::constant(self.c01) * second
    }
}

/// The closed forms of the textbooks, factored so that nothing cancels but λ − 1, which is exact.
fn closed(mode: Mode, x: f64) -> f64 {
    let (c10, c01) = (0.37, 0.11);
    let e = x - 1.0;
    match mode {
        Mode::Uniaxial => 2.0 * (e * (x * x + x + 1.0) / (x * x)) * (c10 + c01 / x),
        // λ − λ⁻⁵ = (λ⁶ − 1)/λ⁵
        Mode::Equibiaxial => {
            let sixth = e * (x + 1.0) * (x.powi(4) + x * x + 1.0) / x.powi(5);
            2.0 * sixth * (c10 + c01 * x * x)
        }
        Mode::Planar => 2.0 * (e * (x + 1.0) * (x * x + 1.0) / x.powi(3)) * (c10 + c01),
        Mode::SimpleShear => 2.0 * x * (c10 + c01),
    }
}

fn stretches(mode: Mode) -> impl Iterator<Item = f64> {
    let amounts = (1..=15).flat_map(|k| [10.0_f64.powi(-k), -(10.0_f64.powi(-k))]).chain([0.5, -0.5, 1.5, 4.0, 6.5]);
    amounts.map(move |amount| mode.rest() + amount).filter(|&x| x != 1.0)
}

#[test]
fn mooney_rivlin_equals_the_closed_forms_at_small_and_large_strain() {
    for mode in Mode::ALL {
        for x in stretches(mode) {
            let stress = nominal_stress(mode, x, &rubber());
            assert_close(&format!("{} {x:e}", mode.name()), &[stress], &[closed(mode, x)], STRESS);
            let state = IncompressibleState::of(&rubber(), mode, x).expect("state");
            let place = if mode == Mode::SimpleShear { (1, 0) } else { (0, 0) };
            assert_close(&format!("{} {x:e}: state", mode.name()), &[state.first_piola.0[place]], &[stress], STRESS);
        }
    }
}

#[test]
fn energies_of_stretches_give_the_stress_and_its_derivatives_by_parameters() {
    for mode in Mode::ALL {
        for x in stretches(mode) {
            let law = InStretches { c10: Gradient::<f64, 2>::variable(0.37, 0), c01: Gradient::variable(0.11, 1) };
            let stress = nominal_stress(mode, Gradient::constant(x), &law);
            let rounding = Tol::ulps(64.0);
            // Only the sum is accurate to the moduli.
            assert_close_at_scale(mode.name(), &[stress.value], &[closed(mode, x)], 1.0 + x.abs().powi(3), rounding);
            // The stress is linear in the parameters: P = Σ c ∂P/∂c.
            let sum = 0.37 * stress.partials[0] + 0.11 * stress.partials[1];
            assert_close_at_scale(mode.name(), &[sum], &[stress.value], 1.0 + x.abs().powi(3), rounding);
        }
    }
}

#[test]
fn slope_equals_the_slope_of_the_closed_form() {
    for mode in Mode::ALL {
        for x in [mode.rest(), mode.rest() + 0.7] {
            let (stress, slope) = nominal_stress_and_slope(mode, x, &rubber());
            let along = |h: f64| closed(mode, x + h);
            // Richardson's differences of the closed form.
            let difference = |h: f64| (along(h) - along(-h)) / (2.0 * h);
            let expected = (4.0 * difference(5e-4) - difference(1e-3)) / 3.0;
            assert_close_at_scale("P", &[stress], &[closed(mode, x)], 1.0, STRESS);
            assert_close("dP/dλ", &[slope], &[expected], Tol::stated(1e-10, "differences of fourth order, h = 1e-3"));
        }
    }
}

#[test]
fn bad_stretches_are_refused() {
    for mode in [Mode::Uniaxial, Mode::Equibiaxial, Mode::Planar] {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(IncompressibleState::of(&rubber(), mode, bad).is_err(), "{} {bad}", mode.name());
        }
    }
}
