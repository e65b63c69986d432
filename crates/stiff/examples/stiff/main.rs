//! Evaluations, Jacobians, factorisations, time and error of `RadauIia` against the tolerance, on stiff problems and mechanisms.
//!
//! ```text
//! cargo run --release -p piola-stiff --example stiff
//! ```
//!
//! The last table has the linear algebra of the chain by itself, the factorisations of its runs and the solutions of their sweeps: a
//! run of dense matrices cannot be faster. The order of a run varies between those of 3 and of 7 stages, and so does what bounds it.
//!
//! The error is the largest of a component at the end, relative to that component; of mechanisms and of the chain the largest of
//! a place or a velocity, relative to the largest of its kind. The time is the least of eleven runs.

#![expect(clippy::print_stdout, reason = "the table is what this program is for")]

mod floor;
mod heavy_top;
#[expect(dead_code, reason = "diffusion is for `stiff_sparse`")]
mod large;
mod mechanisms;
mod problems;

use core::convert::Infallible;
use std::fs;
use std::time::Instant;

use heavy_top::HeavyTop;
use large::Chain;
use mechanisms::{CarAxis, Squeezer};
use piola_integrators::{DormandPrince853, Field, IntegratorsError, State, Tolerance};
use piola_stiff::{Differentiable, ExactJacobian, RadauIia, StiffField};
use piola_testkit::golden::{self, number, text, vector};
use problems::{Hires, Oregonator, Robertson, SpringPendulum, VanDerPol};

const TOLERANCES: [f64; 4] = [1e-4, 1e-6, 1e-8, 1e-10];
const RUNS: u32 = 11;

fn table<F>(name: &str, absolute: f64, field: F) -> Result<(), IntegratorsError>
where
    F: Field<Error = Infallible> + Field<Differentiable, Error = Infallible> + Copy,
{
    let golden = golden::load("stiff");
    let Some(case) = golden.cases.iter().find(|case| text(&case["name"]) == name) else { return Ok(()) };
    let (start, end, expected) = (vector(&case["start"]), number(&case["end"]), vector(&case["values"]));
    let error = |values: &[f64]| values.iter().zip(&expected).map(|(a, e)| ((a - e) / e).abs()).fold(0.0, f64::max);
    rows(name, absolute, &mut ExactJacobian::new(field), &start, end, error)
}

/// A row for each tolerance.
fn rows(
    name: &str,
    absolute: f64,
    system: &mut impl StiffField<Error = Infallible>,
    start: &[f64],
    end: f64,
    error: impl Fn(&[f64]) -> f64,
) -> Result<(), IntegratorsError> {
    for tolerance in TOLERANCES {
        let mut least = f64::INFINITY;
        let mut last = None;
        for _ in 0..RUNS {
            let mut state = State::new(0.0, start.to_vec())?;
            let mut method = RadauIia::new(Tolerance::new(tolerance, absolute * tolerance)?);
            let clock = Instant::now();
            let report = method.integrate_to(system, &mut state, end)?;
            least = least.min(clock.elapsed().as_secs_f64());
            last = Some((report, state));
        }
        let Some((report, state)) = last else { return Ok(()) };
        println!(
            "| {name} | {tolerance:.0e} | {} | {} | {} | {} | {} | {:.0} | {:.1e} |",
            report.run.steps,
            report.run.rejected,
            report.run.evaluations,
            report.jacobians,
            report.factorisations,
            1e6 * least,
            error(&state.values),
        );
    }
    Ok(())
}

/// The largest error of a component of the first two groups of so many, relative to the largest of its group.
fn error_of_motion(values: &[f64], expected: &[f64], group: usize) -> f64 {
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let pairs = values.chunks(group).zip(expected.chunks(group)).take(2);
    pairs.fold(0.0, |error: f64, (values, expected)| {
        let off = largest(&mut values.iter().zip(expected).map(|(a, e)| a - e));
        error.max(off / largest(&mut expected.iter().copied()))
    })
}

fn mechanisms() -> Result<(), IntegratorsError> {
    let reference = |name: &str| {
        let path = format!("{}/../../testdata/reference/{name}.json", env!("CARGO_MANIFEST_DIR"));
        fs::read_to_string(path)
            .ok()
            .and_then(|text| serde_json::from_str(&text).ok())
            .unwrap_or(serde_json::Value::Null)
    };
    let file = reference("andrews_squeezer");
    let (start, expected) = (vector(&file["initial_state"]), vector(&file["own_reference_t003"]["state"]));
    for (name, on_velocities) in [("squeezer, index 1", false), ("squeezer, index 2", true)] {
        let mut system = Squeezer { on_velocities }.system()?;
        rows(name, 0.0, &mut system, &start, 0.03, |values| error_of_motion(values, &expected, 7))?;
    }
    let file = reference("car_axis");
    let expected = vector(&file["own_reference"]["values"]);
    let error = |values: &[f64]| error_of_motion(values, &expected, 4);
    rows("car axis, index 2", 0.0, &mut CarAxis.system()?, &CarAxis::START, 3.0, error)?;
    let expected = HeavyTop::at(HeavyTop::END);
    let error = |values: &[f64]| error_of_motion(values, &expected, 9);
    rows("heavy top, index 2", 0.0, &mut HeavyTop.system()?, &HeavyTop::at(0.0), HeavyTop::END, error)?;
    let expected = vector(&reference("stiff_chain")["values"]);
    let error = |values: &[f64]| error_of_motion(values, &expected, 20);
    rows("chain of 20", 0.0, &mut ExactJacobian::new(Chain { masses: 20 }), &[0.0; 40], 10.0, error)
}

/// The time of the chain's runs, and of their linear algebra by itself.
fn linear_algebra_of_chain() -> Result<(), IntegratorsError> {
    const END: f64 = 10.0;
    let mut chain = ExactJacobian::new(Chain { masses: 20 });
    let mut jacobian = [0.0; 1600];
    if let Err(never) = chain.jacobian(0.0, &[0.0; 40], &mut jacobian) {
        match never {}
    }
    println!(
        "\n| chain of 20, tolerance | run, µs | stages | factorisations, µs | solutions, µs | both, part of the run |"
    );
    println!("|---|---|---|---|---|---|");
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
        let mut method = RadauIia::new(Tolerance::relative(tolerance)?);
        let (mut least, mut last) = (f64::INFINITY, None);
        for _ in 0..RUNS {
            let mut state = State::new(0.0, vec![0.0; 40])?;
            let clock = Instant::now();
            last = Some(method.integrate_to(&mut chain, &mut state, END)?);
            least = least.min(clock.elapsed().as_secs_f64());
        }
        let Some(report) = last else { return Ok(()) };
        let bounds = floor::linear_algebra(40, &jacobian, END / report.run.steps as f64, &report).unwrap_or_default();
        for (stages, [factorisations, solutions]) in [3, 7].into_iter().zip(bounds) {
            println!(
                "| {tolerance:.0e} | {:.0} | {stages} | {:.0} | {:.0} | {:.2} |",
                1e6 * least,
                1e6 * factorisations,
                1e6 * solutions,
                (factorisations + solutions) / least
            );
        }
    }
    Ok(())
}

/// What an explicit method needs for van der Pol's equation.
fn explicit() -> Result<(), IntegratorsError> {
    let golden = golden::load("stiff");
    let Some(case) = golden.cases.iter().find(|case| text(&case["name"]) == "van der Pol") else { return Ok(()) };
    let mut state = State::new(0.0, vector(&case["start"]))?;
    let mut method = DormandPrince853::new(Tolerance::new(1e-6, 1e-9)?);
    let clock = Instant::now();
    let report = method.integrate_to(&mut VanDerPol, &mut state, number(&case["end"]))?;
    let (steps, evaluations, seconds) = (report.steps, report.evaluations, clock.elapsed().as_secs_f64());
    println!("\n`DormandPrince853`, van der Pol, 1e-06: {steps} steps, {evaluations} evaluations, {seconds:.2} s");
    Ok(())
}

fn main() -> Result<(), IntegratorsError> {
    println!(
        "| problem | tolerance | steps | rejected | evaluations | Jacobians | factorisations | time, µs | error |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    table("van der Pol", 1e-3, VanDerPol)?;
    table("Robertson", 1e-8, Robertson)?;
    table("HIRES", 1e-4, Hires)?;
    table("Oregonator", 1e-6, Oregonator)?;
    table("spring pendulum", 0.0, SpringPendulum)?;
    mechanisms()?;
    explicit()?;
    linear_algebra_of_chain()
}
