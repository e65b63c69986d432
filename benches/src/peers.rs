//! Hand-coded equations given to other crates.

use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};
use ode_solvers::{Dop853, OutputType, SVector, System};

use crate::problems::{Equations, Problem};
use crate::work_precision::Outcome;

/// The crate `ode_solvers`, with the version that these benches ask for.
pub const ODE_SOLVERS: &str = "ode_solvers 0.6";
/// The crate `differential-equations`, with the version that these benches ask for.
pub const DIFFERENTIAL_EQUATIONS: &str = "differential-equations 0.7";

/// Equations as both crates take them.
struct Given<'a, E>(&'a E);

impl<E: Equations<D>, const D: usize> System<f64, SVector<f64, D>> for Given<'_, E> {
    #[inline]
    fn system(&self, _t: f64, y: &SVector<f64, D>, rate: &mut SVector<f64, D>) {
        self.0.rate(&y.data.0[0], &mut rate.data.0[0]);
    }
}

impl<E: Equations<D>, const D: usize> ODE<f64, [f64; D]> for Given<'_, E> {
    #[inline]
    fn diff(&self, _t: f64, y: &[f64; D], rate: &mut [f64; D]) {
        self.0.rate(y, rate);
    }
}

/// Integrates a problem with the method of order 8(5,3) of `ode_solvers`; with `spacing`, it also fills a
/// table of dense output.
///
/// # Errors
/// Whatever the crate reports, or an output that does not end at the problem's end.
pub fn ode_solvers<E: Equations<D>, const D: usize>(
    problem: &Problem<E, D>,
    tolerance: f64,
    spacing: Option<f64>,
) -> Result<Outcome, String> {
    let start = SVector::<f64, D>::from(problem.start);
    let (step, end) = (spacing.unwrap_or(problem.end), problem.end);
    let absolute = tolerance * problem.small;
    let mut method = Dop853::new(Given(&problem.equations), 0.0, end, step, start, tolerance, absolute);
    method.set_output(if spacing.is_some() { OutputType::Dense } else { OutputType::Sparse });
    let report = method.integrate().map_err(|error| error.to_string())?;
    let state = method.y_out().last().ok_or("no output")?.as_slice().to_vec();
    Ok(Outcome { state, evaluations: u64::from(report.num_eval), steps: u64::from(report.accepted_steps) })
}

/// Integrates a problem with the method of order 8(5,3) of `differential-equations`; with `spacing`, its
/// output is a table of dense output.
///
/// # Errors
/// Whatever the crate reports.
pub fn differential_equations<E: Equations<D>, const D: usize>(
    problem: &Problem<E, D>,
    tolerance: f64,
    spacing: Option<f64>,
) -> Result<Outcome, String> {
    let given = Given(&problem.equations);
    let absolute = tolerance * problem.small;
    let method = ExplicitRungeKutta::dop853().rtol(tolerance).atol(absolute).max_steps(1_000_000);
    let run = IVP::ode(&given, 0.0, problem.end, problem.start).method(method);
    let solution = match spacing {
        Some(spacing) => run.even(spacing).solve(),
        None => run.solve(),
    }
    .map_err(|error| format!("{error:?}"))?;
    let state = solution.y.last().ok_or("no output")?.to_vec();
    Ok(Outcome { state, evaluations: solution.evals.function as u64, steps: solution.steps.accepted as u64 })
}
