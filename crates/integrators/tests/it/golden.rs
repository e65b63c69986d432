//! Reference trajectories, computed with 230 bits: every listed time.

use core::convert::Infallible;

use piola_integrators::{
    Composition, DormandPrince853, Field, GaussLegendre, GaussRadau15, IntegratorsError, Nystrom86, Nystrom1210, Order,
    Report, SecondOrder, Separable, State, Tolerance, Verner98,
};
use piola_numerics::Real;
use piola_testkit::golden::{self, number, text, vector};
use piola_testkit::{DoubleDouble, Tol, assert_close};

use crate::problems::{DoublePendulum, henon_heiles, kepler, three_bodies};

fn check(name: &str, mut integrate_to: impl FnMut(&mut State, f64) -> Result<Report, IntegratorsError<Infallible>>) {
    let golden = golden::load("trajectories");
    let case = golden.cases.iter().find(|case| text(&case["name"]) == name).unwrap();
    let mut state = State::new(0.0, vector(&case["initial_state"])).unwrap();
    let sensitivity = vector(&case["sensitivity"]);
    for (expected, sensitivity) in case["states"].as_array().unwrap().iter().zip(sensitivity) {
        integrate_to(&mut state, number(&expected["t"])).unwrap();
        let tol = Tol::stated(1e-11, "trajectories").or(Tol::stated(1e-14, "rounding of the input").times(sensitivity));
        assert_close(name, &state.values, &vector(&expected["state"]), tol);
    }
}

fn adaptive<F: Field<Error = Infallible>>(name: &str, mut field: F) {
    let mut method = DormandPrince853::new(Tolerance::relative(1e-15).unwrap());
    check(name, |state, end| method.integrate_to(&mut field, state, end));
}

fn verner<F: Field<Error = Infallible>>(name: &str, mut field: F) {
    let mut method = Verner98::new(Tolerance::relative(1e-15).unwrap());
    check(name, |state, end| method.integrate_to(&mut field, state, end));
}

fn nystrom<F: SecondOrder<Error = Infallible>>(name: &str, mut field: F) {
    let mut method = Nystrom86::new(Tolerance::relative(1e-14).unwrap());
    check(name, |state, end| method.integrate_to(&mut field, state, end));
    let mut method = Nystrom1210::new(Tolerance::relative(1e-15).unwrap());
    check(name, |state, end| method.integrate_to(&mut field, state, end));
}

fn collocation<F: Field<Error = Infallible>>(name: &str, mut field: F, step: f64) {
    let mut method = GaussLegendre::new(Order::Eight, step).unwrap();
    check(name, |state, end| method.integrate_to(&mut field, state, end));
}

fn composition<F: Separable<Error = Infallible>>(name: &str, mut field: F, step: f64) {
    let mut method = Composition::new(Order::Eight, step).unwrap();
    check(name, |state, end| method.integrate_to(&mut field, state, end));
}

#[test]
fn dormand_prince_follows_kepler_motions() {
    adaptive("kepler_e0.3", kepler());
    adaptive("kepler_e0.9", kepler());
    adaptive("kepler_e0.99", kepler());
}

#[test]
fn dormand_prince_follows_henon_heiles_and_the_figure_eight() {
    adaptive("henon_heiles_E_1_12", henon_heiles());
    adaptive("figure_eight", three_bodies());
}

#[test]
fn dormand_prince_follows_double_pendulums_from_rest() {
    let pendulum = |masses, lengths| DoublePendulum { masses, lengths, gravity: 9.8125 };
    adaptive("double_pendulum_low", pendulum([1.0, 1.0], [1.0, 1.0]));
    adaptive("double_pendulum_high", pendulum([1.0, 2.0], [1.0, 0.5]));
}

#[test]
fn verner_follows_the_references() {
    verner("kepler_e0.3", kepler());
    verner("kepler_e0.9", kepler());
    verner("kepler_e0.99", kepler());
    verner("henon_heiles_E_1_12", henon_heiles());
    verner("figure_eight", three_bodies());
    let low = DoublePendulum { masses: [1.0; 2], lengths: [1.0; 2], gravity: 9.8125 };
    verner("double_pendulum_low", low);
    let high = DoublePendulum { masses: [1.0, 2.0], lengths: [1.0, 0.5], gravity: 9.8125 };
    verner("double_pendulum_high", high);
}

#[test]
fn nystrom_follows_the_references() {
    nystrom("kepler_e0.3", kepler());
    nystrom("kepler_e0.9", kepler());
    nystrom("kepler_e0.99", kepler());
    nystrom("henon_heiles_E_1_12", henon_heiles());
    nystrom("figure_eight", three_bodies());
}

#[test]
fn gauss_legendre_follows_the_references() {
    collocation("kepler_e0.3", kepler(), 0.02);
    collocation("kepler_e0.9", kepler(), 0.0008);
    collocation("henon_heiles_E_1_12", henon_heiles(), 0.05);
    collocation("figure_eight", three_bodies(), 0.01);
    let low = DoublePendulum { masses: [1.0; 2], lengths: [1.0; 2], gravity: 9.8125 };
    collocation("double_pendulum_low", low, 0.01);
}

#[test]
fn composition_follows_the_references() {
    composition("kepler_e0.3", kepler(), 0.01);
    composition("kepler_e0.9", kepler(), 0.0002);
    composition("henon_heiles_E_1_12", henon_heiles(), 0.02);
    composition("figure_eight", three_bodies(), 0.005);
}

/// The 31 digits of a decimal number.
fn twofold(text: &str) -> DoubleDouble {
    let (mantissa, exponent) = text.split_once('e').map_or((text, 0), |(m, e)| (m, e.parse::<i32>().unwrap()));
    let (whole, fraction) = mantissa.trim_start_matches('-').split_once('.').unwrap_or((mantissa, ""));
    let ten = DoubleDouble::lit(10.0);
    let digits = whole.trim_start_matches('-').chars().chain(fraction.chars());
    let number = digits.fold(DoubleDouble::lit(0.0), |number, digit| {
        number * ten + DoubleDouble::lit(f64::from(digit.to_digit(10).unwrap()))
    });
    let power = exponent - i32::try_from(fraction.len()).unwrap();
    let scale = (0..power.abs()).fold(DoubleDouble::lit(1.0), |scale, _| scale * ten);
    let number = if power < 0 { number / scale } else { number * scale };
    if text.starts_with('-') { -number } else { number }
}

#[test]
fn states_of_the_references_are_their_long_digits_rounded() {
    let mut compared = 0;
    for case in &golden::load("trajectories").cases {
        for state in case["states"].as_array().unwrap() {
            let long = state["state_hi"].as_array().unwrap();
            for (&short, long) in vector(&state["state"]).iter().zip(long) {
                let left = twofold(text(long)).rounding_of(short).abs();
                // Rounded twice: to seventeen digits, then to a double.
                assert!(left <= 0.7 * f64::EPSILON * short.abs(), "{}: {short} and {long}", text(&case["name"]));
                compared += 1;
            }
        }
        assert!(number(&case["max_difference_between_methods"]) < 1e-30);
    }
    assert!(250 < compared, "{compared}");
}

/// What rounding cuts off the state is not lost: values and carries together are nearer to the reference than doubles can be.
#[test]
fn compensated_state_equals_the_reference_beyond_double_precision() {
    fn check<F: SecondOrder<Error = Infallible>>(name: &str, mut field: F) {
        let golden = golden::load("trajectories");
        let case = golden.cases.iter().find(|case| text(&case["name"]) == name).unwrap();
        let first = &case["states"][0];
        let mut state = State::new(0.0, vector(&case["initial_state"])).unwrap();
        // Eight short steps: increments are small beside the state, and so is their rounding.
        let mut method = GaussRadau15::with_step(number(&first["t"]) / 8.0).unwrap();
        method.integrate_to(&mut field, &mut state, number(&first["t"])).unwrap();
        let largest = state.values.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let long = first["state_hi"].as_array().unwrap();
        for ((long, &value), &carry) in long.iter().zip(&state.values).zip(&state.carry) {
            let error = (twofold(text(long)) - DoubleDouble::of_sum(value, carry)).rounding_of(0.0);
            assert!(error.abs() < 0.2 * f64::EPSILON * largest, "{name}: {error:e} of {largest}");
        }
    }
    check("kepler_e0.3", kepler());
    check("henon_heiles_E_1_12", henon_heiles());
    check("figure_eight", three_bodies());
}
