//! Evaluations, Jacobians, factorisations, time and error of `RadauIia` against the tolerance, on five stiff problems.
//!
//! ```text
//! cargo run --release -p piola-integrators --example stiff
//! ```
//!
//! The error is the largest of a component at the end, relative to that component. The time is the least of eleven runs.

#![expect(clippy::print_stdout, reason = "the table is what this program is for")]

mod problems;

use core::convert::Infallible;
use std::time::Instant;

use piola_integrators::{
    Differentiable, DormandPrince853, ExactJacobian, Field, IntegratorsError, RadauIia, State, Tolerance,
};
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
    for tolerance in TOLERANCES {
        let mut least = f64::INFINITY;
        let mut last = None;
        for _ in 0..RUNS {
            let mut state = State::new(0.0, start.clone())?;
            let mut method = RadauIia::new(Tolerance::new(tolerance, absolute * tolerance)?);
            let clock = Instant::now();
            let report = method.integrate_to(&mut ExactJacobian::new(field), &mut state, end)?;
            least = least.min(clock.elapsed().as_secs_f64());
            last = Some((report, state));
        }
        let Some((report, state)) = last else { return Ok(()) };
        let error = state.values.iter().zip(&expected).map(|(a, e)| ((a - e) / e).abs()).fold(0.0, f64::max);
        println!(
            "| {name} | {tolerance:.0e} | {} | {} | {} | {} | {} | {:.0} | {error:.1e} |",
            report.run.steps,
            report.run.rejected,
            report.run.evaluations,
            report.jacobians,
            report.factorisations,
            1e6 * least,
        );
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
    explicit()
}
