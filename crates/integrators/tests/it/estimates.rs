//! Estimates of the error of whole runs, beside the true errors.

use core::convert::Infallible;

use piola_integrators::{
    DormandPrince853, ErrorEstimate, Field, GaussLegendre16, GaussRadau15, IntegratorsError, Nystrom86, Nystrom1210,
    SecondOrder, State, Tolerance, Verner98,
};
use piola_numerics::Lanes;
use piola_testkit::golden::{self, number, text, vector};

use crate::problems::{DoublePendulum, henon_heiles, kepler, three_bodies};

const TOLERANCES: [f64; 10] = [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13];

type Estimated = Result<ErrorEstimate, IntegratorsError<Infallible>>;

/// Estimate over true error of positions and of velocities, where rounding of the input is not the error.
fn ratios(name: &str, mut run: impl FnMut(&mut State, f64, Tolerance) -> Estimated) -> Vec<f64> {
    let golden = golden::load("trajectories");
    let case = golden.cases.iter().find(|case| text(&case["name"]) == name).unwrap();
    let states = case["states"].as_array().unwrap();
    let (last, sensitivity) = (states.last().unwrap(), vector(&case["sensitivity"]).last().copied().unwrap());
    let exact = vector(&last["state"]);
    let n = exact.len() / 2;
    let mut ratios = Vec::new();
    for tolerance in TOLERANCES {
        let mut state = State::new(0.0, vector(&case["initial_state"])).unwrap();
        let estimate = run(&mut state, number(&last["t"]), Tolerance::relative(tolerance).unwrap()).unwrap();
        for block in [0..n, n..2 * n] {
            let largest = |x: &[f64]| x.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
            let difference: Vec<f64> = block.clone().map(|i| state.values[i] - exact[i]).collect();
            let (size, error) = (largest(&exact[block.clone()]), largest(&difference));
            // A motion that the error has changed altogether, and one that rounding has, are no cases.
            if error < 0.05 * size && 1e-14 * sensitivity.max(10.0) * size < error {
                ratios.push(largest(&estimate.errors[block]) / error);
            }
        }
    }
    ratios
}

fn judge(method: &str, ratios: &[f64], cases: usize) {
    assert!(cases <= ratios.len(), "{method}: {} cases", ratios.len());
    let good = ratios.iter().filter(|ratio| (1.0 / 3.0..=3.0).contains(*ratio)).count();
    assert!(0.9 * ratios.len() as f64 <= good as f64, "{method}: {good} of {}: {ratios:?}", ratios.len());
    let least = ratios.iter().fold(f64::INFINITY, |least, ratio| least.min(*ratio));
    assert!(0.1 <= least, "{method}: {least}");
}

fn eight<F: Field<Error = Infallible>>(name: &str, mut field: F) -> Vec<f64> {
    ratios(name, |state, end, tolerance| {
        DormandPrince853::new(tolerance).integrate_and_estimate(&mut field, state, end)
    })
}

fn nine<F: Field<Error = Infallible>>(name: &str, mut field: F) -> Vec<f64> {
    ratios(name, |state, end, tolerance| Verner98::new(tolerance).integrate_and_estimate(&mut field, state, end))
}

fn nystrom_eight<F: SecondOrder<Error = Infallible>>(name: &str, mut field: F) -> Vec<f64> {
    ratios(name, |state, end, tolerance| Nystrom86::new(tolerance).integrate_and_estimate(&mut field, state, end))
}

fn nystrom_twelve<F: SecondOrder<Error = Infallible>>(name: &str, mut field: F) -> Vec<f64> {
    ratios(name, |state, end, tolerance| Nystrom1210::new(tolerance).integrate_and_estimate(&mut field, state, end))
}

fn sixteen<F: SecondOrder<Lanes<f64, 8>, Error = Infallible>>(name: &str, mut field: F) -> Vec<f64> {
    ratios(name, |state, end, tolerance| GaussLegendre16::new(tolerance).integrate_and_estimate(&mut field, state, end))
}

fn fifteen<F: SecondOrder<Error = Infallible>>(name: &str, mut field: F) -> Vec<f64> {
    ratios(name, |state, end, tolerance| GaussRadau15::new(tolerance).integrate_and_estimate(&mut field, state, end))
}

macro_rules! all_problems {
    ($run:ident) => {{
        let pendulum = |masses, lengths| DoublePendulum { masses, lengths, gravity: 9.8125 };
        [
            $run("kepler_e0.3", kepler()),
            $run("kepler_e0.9", kepler()),
            $run("kepler_e0.99", kepler()),
            $run("henon_heiles_E_1_12", henon_heiles()),
            $run("figure_eight", three_bodies()),
            $run("double_pendulum_low", pendulum([1.0, 1.0], [1.0, 1.0])),
            $run("double_pendulum_high", pendulum([1.0, 2.0], [1.0, 0.5])),
        ]
        .concat()
    }};
}

#[test]
fn estimate_of_order_eight_equals_the_true_error_within_three() {
    judge("order eight", &all_problems!(eight), 80);
}

#[test]
fn estimate_of_order_nine_equals_the_true_error_within_three() {
    judge("order nine", &all_problems!(nine), 80);
}

#[test]
fn estimates_of_nystrom_pairs_equal_the_true_errors_within_three() {
    macro_rules! problems {
        ($run:ident) => {
            [
                $run("kepler_e0.3", kepler()),
                $run("kepler_e0.9", kepler()),
                $run("kepler_e0.99", kepler()),
                $run("henon_heiles_E_1_12", henon_heiles()),
                $run("figure_eight", three_bodies()),
            ]
            .concat()
        };
    }
    judge("Nyström, order eight", &problems!(nystrom_eight), 50);
    judge("Nyström, order twelve", &problems!(nystrom_twelve), 50);
}

#[test]
fn estimate_of_order_fifteen_equals_the_true_error_within_three() {
    judge("order fifteen", &all_problems!(fifteen), 80);
}

#[test]
fn estimate_of_order_sixteen_equals_the_true_error_within_three() {
    judge("order sixteen", &all_problems!(sixteen), 80);
}

#[test]
fn estimate_of_a_fixed_step_equals_the_true_error() {
    let fixed = |name, mut field| {
        ratios(name, |state, end, _| {
            GaussLegendre16::with_step(0.8).unwrap().integrate_and_estimate(&mut field, state, end)
        })
    };
    judge("fixed step", &fixed("kepler_e0.3", kepler()), 10);
}

#[test]
fn method_keeps_its_tolerance_after_an_estimate() {
    let mut method = DormandPrince853::new(Tolerance::relative(1e-6).unwrap());
    let start = State::new(0.0, vec![0.5, 0.0, 0.0, 3.0_f64.sqrt()]).unwrap();
    let (mut first, mut second) = (start.clone(), start);
    let one = method.integrate_and_estimate(&mut kepler(), &mut first, 5.0).unwrap();
    let other = method.integrate_and_estimate(&mut kepler(), &mut second, 5.0).unwrap();
    assert_eq!((one, first), (other, second));
}
