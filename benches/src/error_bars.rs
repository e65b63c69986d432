//! Estimates of the error of whole runs beside the true errors, over the problems of [`problems`].
//!
//! A case is a block (positions or velocities) of the end of one run: a problem, a method, a tolerance. Its ratio is the largest
//! estimated error of the block over the largest true one. Cases in which rounding is the error, and those in which the motion is
//! lost, are counted apart.

use std::fmt::Write;

use piola_integrators::{
    DormandPrince853, ErrorEstimate, GaussLegendre16, GaussRadau15, Nystrom86, Nystrom1210, State, Tolerance, Verner98,
};
use piola_stiff::{ExactJacobian, RadauIia};

use crate::problems::{self, Accelerations, Equations, Force, Problem, ReferenceError};
use crate::work_precision::{Accelerated, Forced, by_hand};

/// The ratios of a method on a problem.
#[derive(Clone, Debug)]
pub struct Row {
    /// The problem.
    pub problem: &'static str,
    /// The method.
    pub method: &'static str,
    /// Of each case the tolerance, the true error relative to its block, and estimate/true.
    pub cases: Vec<[f64; 3]>,
    /// Errors below this are those of rounding: see `settle`.
    pub floor: f64,
}

impl Row {
    /// The ratios of the cases whose error is neither rounding nor the size of the motion.
    pub fn ratios(&self) -> impl Iterator<Item = f64> + '_ {
        let counts = |case: &&[f64; 3]| self.floor < case[1] && case[1] < LOST;
        self.cases.iter().filter(counts).map(|case| case[2])
    }
}

/// A larger error, relative to the block, is that of another motion.
const LOST: f64 = 0.05;
/// Rounding of the end alone.
const ROUNDING: f64 = 1e-14;

/// The strictest tolerance: the finer run has a hundredth or a thousandth of it.
const STRICTEST: i32 = 13;
/// That of the stiff chain, whose forces are rounded to 1e-10 of the masses' weight.
const STRICTEST_STIFF: i32 = 10;

fn row<E: Equations<D>, const D: usize>(
    problem: &Problem<E, D>,
    method: &'static str,
    strictest: i32,
    mut run: impl FnMut(&mut State, Tolerance) -> Result<ErrorEstimate, String>,
) -> Row {
    let mut cases = Vec::new();
    for value in (4..=strictest).map(|k| 10.0_f64.powi(-k)) {
        let (Ok(mut state), Ok(tolerance)) = (State::new(0.0, problem.start.to_vec()), Tolerance::relative(value))
        else {
            continue;
        };
        let Ok(estimate) = run(&mut state, tolerance) else { continue };
        for block in [0..E::POSITIONS, E::POSITIONS..D] {
            // What is no number is the largest of all, and no ratio of it counts.
            let largest = |x: &mut dyn Iterator<Item = f64>| {
                x.fold(
                    0.0_f64,
                    |largest, x| if x.is_nan() || largest.is_nan() { f64::NAN } else { largest.max(x.abs()) },
                )
            };
            let size = largest(&mut problem.reference[block.clone()].iter().copied());
            let differences = state.values[block.clone()].iter().zip(&problem.reference[block.clone()]);
            let error = largest(&mut differences.map(|(a, b)| a - b));
            let estimated = largest(&mut estimate.errors[block].iter().copied());
            cases.push([value, error / size, estimated / error]);
        }
    }
    Row { problem: problem.name, method, cases, floor: ROUNDING }
}

/// The methods that name a field of their own each.
macro_rules! rows {
    ($problem:expr, $strictest:expr, $($method:ident: $name:literal on $field:expr),+) => {
        vec![$(row($problem, $name, $strictest, |state, tolerance| {
            let end = $problem.end;
            $method::new(tolerance).integrate_and_estimate(&mut $field, state, end).map_err(|error| error.to_string())
        })),+]
    };
}

/// Explicit pairs for any equations.
fn explicit<E: Equations<D>, const D: usize>(problem: &Problem<E, D>) -> Vec<Row> {
    rows!(problem, STRICTEST, DormandPrince853: "Dormand–Prince 8(5,3)" on by_hand(problem), Verner98: "Verner 9(8)" on by_hand(problem))
}

/// Collocation for equations of second order.
fn collocation<E: Equations<D> + Accelerations, const D: usize>(problem: &Problem<E, D>) -> Vec<Row> {
    let field = || Accelerated::<_, D>(&problem.equations);
    rows!(problem, STRICTEST, GaussLegendre16: "Gauss–Legendre 16" on field(), GaussRadau15: "Gauss–Radau 15" on field())
}

/// Nyström pairs for forces that depend on positions alone.
fn nystrom<E: Equations<D> + Force, const D: usize>(problem: &Problem<E, D>) -> Vec<Row> {
    let field = || Forced::<'_, E, D>(&problem.equations);
    rows!(problem, STRICTEST, Nystrom86: "Nyström 8(6)" on field(), Nystrom1210: "Nyström 12(10)" on field())
}

fn of_positions<E: Equations<D> + Accelerations + Force, const D: usize>(problem: &Problem<E, D>) -> Vec<Row> {
    settle([explicit(problem), collocation(problem), nystrom(problem)].concat())
}

fn of_velocities<E: Equations<D> + Accelerations, const D: usize>(problem: &Problem<E, D>) -> Vec<Row> {
    settle([explicit(problem), collocation(problem)].concat())
}

/// Sets the floor of a problem: ten times the least error that any method reaches on it, and at least 1e-14.
fn settle(mut rows: Vec<Row>) -> Vec<Row> {
    let errors = rows.iter().flat_map(|row| row.cases.iter().map(|case| case[1]));
    let floor = (10.0 * errors.fold(f64::INFINITY, f64::min)).max(ROUNDING);
    for row in &mut rows {
        row.floor = floor;
    }
    rows
}

/// The small problems, which a test runs.
///
/// # Errors
/// A reference cannot be read.
pub fn sample() -> Result<Vec<Row>, ReferenceError> {
    Ok([
        of_positions(&problems::henon_heiles()?),
        of_positions(&problems::kepler_round()),
        settle(explicit(&problems::free_top()?)),
    ]
    .concat())
}

/// All problems.
///
/// # Errors
/// A reference cannot be read.
pub fn all() -> Result<Vec<Row>, ReferenceError> {
    let chain = problems::spring_chain()?;
    let stiff = rows!(&chain, STRICTEST_STIFF, RadauIia: "Radau IIA 5, 9, 13" on ExactJacobian::new(chain.equations));
    Ok([
        of_velocities(&problems::double_pendulum()?),
        of_positions(&problems::henon_heiles()?),
        of_positions(&problems::kepler_round()),
        of_positions(&problems::kepler()),
        of_positions(&problems::kepler_long()),
        of_velocities(&problems::arenstorf()?),
        of_positions(&problems::pleiades()?),
        of_positions(&problems::outer_solar_system()?),
        of_positions(&problems::outer_solar_system_long()?),
        of_velocities(&problems::inner_solar_system()?),
        of_positions(&problems::cluster()?),
        settle(explicit(&problems::free_top()?)),
        settle(explicit(&problems::heavy_top()?)),
        settle(stiff),
    ]
    .concat())
}

/// Counts of ratios: all, those in 1/3…3, the least and the largest.
#[derive(Clone, Copy, Debug)]
pub struct Summary {
    /// All cases.
    pub cases: usize,
    /// Those between a third and three.
    pub within_three: usize,
    /// The least ratio.
    pub least: f64,
    /// The largest ratio.
    pub largest: f64,
}

impl Summary {
    /// Of some rows.
    #[must_use]
    pub fn of<'a>(rows: impl Iterator<Item = &'a Row>) -> Self {
        let mut summary = Self { cases: 0, within_three: 0, least: f64::INFINITY, largest: 0.0 };
        for ratio in rows.flat_map(Row::ratios) {
            summary.cases += 1;
            summary.within_three += usize::from((1.0 / 3.0..=3.0).contains(&ratio));
            summary.least = summary.least.min(ratio);
            summary.largest = summary.largest.max(ratio);
        }
        summary
    }

    fn cells(self) -> String {
        if self.cases == 0 {
            return "0 | | |".to_owned();
        }
        format!("{} of {} | {:.2} | {:.2} |", self.within_three, self.cases, self.least, self.largest)
    }
}

/// A row for every problem and method, and their sums, as Markdown.
#[must_use]
pub fn table(rows: &[Row]) -> String {
    let head = "within three | least | largest |\n|---|---|---|---|";
    let mut text = format!("| problem | method | {head}---|\n");
    for row in rows {
        let cells = Summary::of(std::iter::once(row)).cells();
        let _ = writeln!(text, "| {} | {} | {cells}", row.problem, row.method);
    }
    let _ = writeln!(text, "\n| method | {head}");
    let mut methods: Vec<&str> = Vec::new();
    for row in rows {
        if !methods.contains(&row.method) {
            methods.push(row.method);
        }
    }
    for method in methods {
        let cells = Summary::of(rows.iter().filter(|row| row.method == method)).cells();
        let _ = writeln!(text, "| {method} | {cells}");
    }
    let _ = writeln!(text, "| all | {}", Summary::of(rows.iter()).cells());
    let outside = |ratio: f64| !(1.0 / 3.0..=3.0).contains(&ratio);
    let _ = writeln!(
        text,
        "\n| problem | method | tolerance | error | estimate/true, outside of 1/3…3 |\n|---|---|---|---|---|"
    );
    for row in rows {
        for [tolerance, error, ratio] in &row.cases {
            if row.floor < *error && *error < LOST && outside(*ratio) {
                let _ =
                    writeln!(text, "| {} | {} | {tolerance:.0e} | {error:.1e} | {ratio:.2} |", row.problem, row.method);
            }
        }
    }
    text
}
