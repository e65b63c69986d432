//! Following a motion, keeping every step, and judging how good it is.

use core::ops::{ControlFlow, Range};

use piola_integrators::{DormandPrince853, Field, IntegratorsError, Report, State, Tolerance};
use piola_kinematics::SingularPosition;

use super::run::Run;
use crate::LagrangianError;

/// What is looked at in every state of a run.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Certificate {
    /// h, or E + V.
    pub(crate) integral: f64,
    /// A size against which its changes are measured.
    pub(crate) kinetic: f64,
    pub(crate) residual: f64,
    pub(crate) rate_residual: f64,
}

/// Follows a field from `start` = (q, velocities) and keeps every step; then estimates the error by a second run with a
/// hundredth of the tolerance, and has every state certified.
pub(crate) fn record<F: Field<Error = LagrangianError>>(
    field: impl Fn() -> F,
    coordinates: usize,
    start: &[f64],
    times: Range<f64>,
    tolerance: Tolerance,
    mut certify: impl FnMut(f64, &[f64]) -> Result<Certificate, LagrangianError>,
    singular_positions: impl Fn(&F) -> Vec<SingularPosition>,
) -> Result<Run, LagrangianError> {
    let mut run = Run {
        coordinates,
        dimension: start.len(),
        times: vec![times.start],
        states: start.to_vec(),
        report: Report::begin(),
        energy_drift: 0.0,
        error_estimate: f64::INFINITY,
        residual: 0.0,
        rate_residual: 0.0,
        singular_positions: Vec::new(),
    };
    let stopped = |error: IntegratorsError| LagrangianError::Run {
        time: times.start,
        source: Box::new(error.with_field_error()),
    };
    let mut state = State::new(times.start, start.to_vec()).map_err(stopped)?;
    let mut motion = field();
    let followed = DormandPrince853::new(tolerance).integrate(&mut motion, &mut state, times.end, |step| {
        run.times.push(step.time());
        run.states.extend_from_slice(step.values());
        run.report.steps += 1;
        ControlFlow::Continue(())
    });
    run.singular_positions = singular_positions(&motion);
    let (mut first, mut change, mut scale) = (None, 0.0_f64, 0.0_f64);
    for (state, &time) in run.states.chunks_exact(run.dimension.max(1)).zip(&run.times) {
        let certificate = certify(time, state)?;
        let integral = certificate.integral;
        change = change.max((integral - *first.get_or_insert(integral)).abs());
        scale = scale.max(integral.abs()).max(certificate.kinetic);
        run.residual = run.residual.max(certificate.residual);
        run.rate_residual = run.rate_residual.max(certificate.rate_residual);
    }
    run.energy_drift = if 0.0 < scale { change / scale } else { 0.0 };
    match followed {
        Ok(report) => run.report = report,
        Err(error) => {
            return Err(LagrangianError::Unfinished { time: state.time, source: Box::new(error), run: Box::new(run) });
        }
    }
    let finer = Tolerance::new(tolerance.relative_part() * 0.01, tolerance.absolute_part() * 0.01).map_err(stopped)?;
    let mut reference = State::new(times.start, start.to_vec()).map_err(stopped)?;
    // A second run that fails leaves the first as it is, without an estimate.
    if DormandPrince853::new(finer).integrate_to(&mut field(), &mut reference, times.end).is_ok() {
        let pairs = state.values.iter().zip(&reference.values).take(coordinates);
        run.error_estimate = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    }
    Ok(run)
}
