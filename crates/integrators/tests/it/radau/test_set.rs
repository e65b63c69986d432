//! Mechanisms with constraints and a long stiff chain, against published and own references.

use core::convert::Infallible;
use std::fs;

use piola_integrators::{ExactJacobian, Field, RadauIia, RadauReport, State, StiffField, Tolerance};
use piola_testkit::golden::{number, vector};
use piola_testkit::{Tol, assert_close, assert_each_close};
use serde_json::Value;

use super::large::Chain;
use super::mechanisms::{CarAxis, Squeezer};

fn reference(name: &str) -> Value {
    let path = format!("{}/../../testdata/reference/{name}.json", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

fn run(
    system: &mut impl StiffField<Error = Infallible>,
    start: &[f64],
    end: f64,
    tolerance: f64,
) -> (Vec<f64>, RadauReport) {
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let mut method = RadauIia::new(Tolerance::relative(tolerance).unwrap());
    let report = method.integrate_to(system, &mut state, end).unwrap();
    (state.values, report)
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
        (false, 1e-6, [20.0, 200.0, 500.0, 500.0]),
        (false, 1e-10, [20.0, 200.0, 500.0, 500.0]),
        (true, 1e-6, [20.0, 200.0, 500.0, 500.0]),
        (true, 1e-8, [20.0, 200.0, 500.0, 500.0]),
    ] {
        let mut system = Squeezer { on_velocities }.system().unwrap();
        let (values, report) = run(&mut system, &start, 0.03, tolerance);
        println!("squeezer {on_velocities} {tolerance:e} {report:?}");
        for ((name, part), factor) in [("q", 0..7), ("v", 7..14), ("w", 14..21), ("λ", 21..27)].into_iter().zip(factors)
        {
            let size = own[part.clone()].iter().fold(0.0_f64, |size, x| size.max(x.abs()));
            let off =
                values[part.clone()].iter().zip(&own[part.clone()]).fold(0.0_f64, |a, (x, y)| a.max((x - y).abs()));
            println!("  {name} {:e}", off / size / tolerance);
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
    for (tolerance, factors) in [(1e-6, [100.0, 100.0, 100.0]), (1e-9, [100.0, 100.0, 100.0])] {
        let (values, report) = run(&mut CarAxis.system().unwrap(), &CarAxis::START, number(&file["end"]), tolerance);
        println!("car {tolerance:e} {report:?}");
        for ((name, part), factor) in [("p", 0..4), ("q", 4..8), ("λ", 8..10)].into_iter().zip(factors) {
            let size = own[part.clone()].iter().fold(0.0_f64, |size, x| size.max(x.abs()));
            let off =
                values[part.clone()].iter().zip(&own[part.clone()]).fold(0.0_f64, |a, (x, y)| a.max((x - y).abs()));
            println!("  {name} {:e}", off / size / tolerance);
            let tol = Tol::stated(factor, "growth of errors over five bumps").times(tolerance);
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
    for tolerance in [1e-4, 1e-7, 1e-10] {
        let mut system = ExactJacobian::new(Chain { masses });
        let (values, report) = run(&mut system, &[0.0; 40], number(&file["end"]), tolerance);
        println!("chain {tolerance:e} {report:?}");
        let own = vector(&file["values"]);
        let off = values.iter().zip(&own).fold(0.0_f64, |a, (x, y)| a.max(((x - y) / y).abs()));
        println!("  {:e}", off / tolerance);
        let tol = Tol::stated(100.0, "growth over ten swings").times(tolerance);
        assert_each_close("chain", &values, &own, tol);
    }
}
