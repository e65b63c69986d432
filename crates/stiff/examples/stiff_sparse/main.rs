//! Sparse and dense Jacobians in `RadauIia`: time of a run against the number of components.
//!
//! ```text
//! cargo run --release -p piola-stiff --features sparse --example stiff_sparse
//! ```
//!
//! A chain of masses on stiff springs to t = 1, diffusion with a reaction on a line and on a square to t = 0.1, at a tolerance
//! of 1e-6. The time is the least of three runs, of one where a run takes more than a second. Dense matrices stop where a run
//! would take minutes.

#![expect(clippy::print_stdout, reason = "the table is what this program is for")]

#[path = "../stiff/large.rs"]
mod large;

use core::convert::Infallible;
use std::time::Instant;

use large::{Chain, Diffusion};
use piola_integrators::{Field, IntegratorsError, State, Tolerance};
use piola_stiff::{Differentiable, ExactJacobian, RadauIia, RadauReport, SparseJacobian, Sparsity, StiffField};

/// The largest number of components for which dense matrices are tried.
const LARGEST_DENSE: usize = 1024;

/// Seconds, report and end of a run.
fn run(
    system: &mut impl StiffField<Error = Infallible>,
    start: &[f64],
    end: f64,
) -> Result<(f64, RadauReport, Vec<f64>), IntegratorsError> {
    let mut least = f64::INFINITY;
    let mut runs = 0;
    loop {
        let mut state = State::new(0.0, start.to_vec())?;
        let mut method = RadauIia::new(Tolerance::relative(1e-6)?);
        let clock = Instant::now();
        let report = method.integrate_to(system, &mut state, end)?;
        least = least.min(clock.elapsed().as_secs_f64());
        runs += 1;
        if runs == 3 || 1.0 < least {
            return Ok((least, report, state.values));
        }
    }
}

fn row<F>(name: &str, mut field: F, start: &[f64], end: f64) -> Result<(), IntegratorsError>
where
    F: Field<Error = Infallible> + Field<Differentiable, Error = Infallible> + Copy,
{
    let n = start.len();
    let sparsity = Sparsity::of_field(&mut field, 0.0, start)?;
    let entries = sparsity.count();
    let mut few = SparseJacobian::new(field, sparsity)?;
    let (colours, passes) = (few.colours(), few.passes());
    let (seconds, report, values) = run(&mut few, start, end)?;
    let (steps, jacobians, factorisations) = (report.run.steps, report.jacobians, report.factorisations);
    print!(
        "| {name} | {n} | {entries} | {colours}, {passes} | {steps}, {jacobians}, {factorisations} | {:.2} |",
        1e3 * seconds
    );
    if n <= LARGEST_DENSE {
        let (dense, _, exact) = run(&mut ExactJacobian::new(field), start, end)?;
        let size = exact.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        let off = values.iter().zip(&exact).fold(0.0_f64, |off, (a, b)| off.max((a - b).abs()));
        println!(" {:.2} | {:.1} | {:.0e} |", 1e3 * dense, dense / seconds, off / size);
    } else {
        println!(" | | |");
    }
    Ok(())
}

fn main() -> Result<(), IntegratorsError> {
    println!(
        "| problem | n | entries | colours, passes | steps, Jacobians, factorisations | sparse, ms | dense, ms | ratio | difference |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for masses in [5, 10, 25, 50, 100, 250, 500, 1500] {
        row("chain", Chain { masses }, &vec![0.0; 2 * masses], 1.0)?;
    }
    for side in [10, 20, 50, 100, 200, 500, 1000, 3000] {
        let line = Diffusion { side, rows: 1 };
        row("line", line, &line.start(), 0.1)?;
    }
    for side in [3, 5, 7, 10, 14, 22, 32, 55] {
        let square = Diffusion { side, rows: side };
        row("square", square, &square.start(), 0.1)?;
    }
    Ok(())
}
