//! Mechanisms with constraints and a long stiff chain, against published and own references.

use core::convert::Infallible;
use std::fs;

use piola_integrators::{Field, State, Tolerance};
use piola_stiff::{ExactJacobian, RadauIia, StiffField};
use piola_testkit::golden::{number, vector};
use piola_testkit::{Tol, assert_close, assert_each_close};
use serde_json::Value;

use super::heavy_top::HeavyTop;
use super::large::Chain;
use super::mechanisms::{CarAxis, Squeezer};

fn reference(name: &str) -> Value {
    let path = format!("{}/../../testdata/reference/{name}.json", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

fn run(system: &mut impl StiffField<Error = Infallible>, start: &[f64], end: f64, tolerance: f64) -> Vec<f64> {
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let mut method = RadauIia::new(Tolerance::relative(tolerance).unwrap());
    method.integrate_to(system, &mut state, end).unwrap();
    state.values
}

/// The published start satisfies the equations that are written here: balance and closure.
#[test]
fn squeezer_starts_in_equilibrium() {
    let file = reference("andrews_squeezer");
    let start = vector(&file["initial_state"]);
    for on_velocities in [false, true] {
        let mut rate = [1.0; Squeezer::DIMENSION];
        Squeezer { on_velocities }.rate(0.0, &start, &mut rate).unwrap();
        assert_close("velocities", &rate[..7], &start[7..14], Tol::ulps(0.0));
        // Moments of up to 1 N m balance, accelerations times lengths of up to 400 m/s² close.
        assert_close("balance", &rate[14..21], &[0.0; 7], Tol::stated(1e-14, "rounding of 1 N m"));
        assert_close("closure", &rate[21..], &[0.0; 6], Tol::stated(1e-12, "rounding of 400 m/s²"));
    }
}

#[test]
fn squeezer_ends_where_published() {
    let file = reference("andrews_squeezer");
    let start = vector(&file["initial_state"]);
    let [published, own] = [&file["published_reference_t003"], &file["own_reference_t003"]["state"]].map(vector);
    for (on_velocities, tolerance, factors) in [
        (false, 1e-6, [1.0, 1.0, 10.0, 10.0]),
        (false, 1e-10, [1.0, 1.0, 10.0, 10.0]),
        // On velocities accelerations and reactions have index 2, and a lower order.
        (true, 1e-6, [10.0, 50.0, 1e3, 1e3]),
        (true, 1e-8, [10.0, 50.0, 3e3, 3e3]),
    ] {
        let mut system = Squeezer { on_velocities }.system().unwrap();
        let values = run(&mut system, &start, 0.03, tolerance);
        for ((name, part), factor) in [("q", 0..7), ("v", 7..14), ("w", 14..21), ("λ", 21..27)].into_iter().zip(factors)
        {
            let tol =
                Tol::stated(factor, "growth of errors while the crank turns two and a half times").times(tolerance);
            assert_close(name, &values[part.clone()], &own[part.clone()], tol);
            let tol = tol.or(Tol::stated(2e-6, "digits of the published accelerations and reactions"));
            assert_close(name, &values[part.clone()], &published[part.clone()], tol);
        }
    }
}

#[test]
fn car_axis_ends_where_published() {
    let file = reference("car_axis");
    let [published, own] = [&file["published_reference"], &file["own_reference"]["values"]].map(vector);
    for (tolerance, factors) in [(1e-6, [1.0, 20.0, 20.0]), (1e-9, [1.0, 20.0, 2e4])] {
        let values = run(&mut CarAxis.system().unwrap(), &CarAxis::START, number(&file["end"]), tolerance);
        for ((name, part), factor) in [("p", 0..4), ("q", 4..8), ("λ", 8..10)].into_iter().zip(factors) {
            let tol = Tol::stated(factor, "growth of errors over five bumps; reactions have index 2").times(tolerance);
            assert_close(name, &values[part.clone()], &own[part.clone()], tol);
            let tol = tol.or(Tol::stated(1e-7, "digits of the published reactions"));
            assert_close(name, &values[part.clone()], &published[part], tol);
        }
    }
}

#[test]
fn stiff_chain_from_rest_ends_at_the_reference() {
    let file = reference("stiff_chain");
    let masses = 20;
    for tolerance in [1e-3, 1e-4, 1e-7, 1e-10] {
        let mut system = ExactJacobian::new(Chain { masses });
        let values = run(&mut system, &[0.0; 40], number(&file["end"]), tolerance);
        let own = vector(&file["values"]);
        let tol = Tol::stated(10.0, "growth over two swings").times(tolerance);
        assert_each_close("chain", &values, &own, tol);
    }
}

#[test]
fn heavy_top_in_directors_precesses_steadily() {
    let (start, end) = (HeavyTop::at(0.0), HeavyTop::at(HeavyTop::END));
    let mut rate = [1.0; 24];
    HeavyTop.rate(0.0, &start, &mut rate).unwrap();
    assert_close("constraints", &rate[18..], &[0.0; 6], Tol::stated(1e-13, "rounding of 150 rad/s"));
    for tolerance in [1e-5, 1e-8] {
        let values = run(&mut HeavyTop.system().unwrap(), &start, HeavyTop::END, tolerance);
        let tol = Tol::stated(20.0, "growth over seven turns").times(tolerance);
        for (name, part) in [("directors", 0..9), ("velocities", 9..18), ("reactions", 18..24)] {
            assert_close(name, &values[part.clone()], &end[part], tol);
        }
        // Directors stay orthonormal, though the constraints stand on velocities.
        let [one, two, three] = [0, 3, 6].map(|k| &values[k..k + 3]);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let products = [(one, one), (two, two), (three, three), (one, two), (two, three), (three, one)];
        let products = products.map(|(a, b)| dot(a, b));
        assert_close("orthonormality", &products, &[1.0, 1.0, 1.0, 0.0, 0.0, 0.0], tol);
    }
}
