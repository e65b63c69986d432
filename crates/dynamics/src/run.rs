//! A motion that has been computed, with a method chosen for it.

use core::ops::{ControlFlow, Range};

use piola_integrators::{DormandPrince853, Ending, Field, IntegratorsError, Report, State, Tolerance};

use crate::DynamicsError;

/// A motion that has been computed: every accepted step, and how good it is.
///
/// A state is (q, q̇); of a system of which some quasi-velocities are held, (q, the free quasi-velocities).
///
/// # Example
/// See [`Lagrangian::integrate`](crate::lagrangian::Lagrangian::integrate).
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    coordinates: usize,
    dimension: usize,
    times: Vec<f64>,
    states: Vec<f64>,
    report: Report,
    energy_drift: f64,
    error_estimate: f64,
    residual: f64,
    rate_residual: f64,
}

impl Run {
    /// The number of accepted steps.
    #[must_use]
    pub const fn steps(&self) -> u64 {
        self.report.steps
    }
    /// The method, by name.
    #[must_use]
    pub const fn method(&self) -> &'static str {
        "Dormand–Prince 8(5,3)"
    }
    /// What the run cost.
    #[must_use]
    pub const fn report(&self) -> Report {
        self.report
    }
    /// The largest change of the Jacobi integral h, relative to the largest |h| or E met, whichever is
    /// larger. A measure of error when neither time nor applied forces change h; otherwise it shows their
    /// work. Where quasi-velocities are held or constraints imposed, E + V stands for h.
    #[must_use]
    pub const fn energy_drift(&self) -> f64 {
        self.energy_drift
    }
    /// The largest difference of a coordinate at the end to a second run with a hundredth of the tolerance:
    /// an estimate of the global error. Infinite where there is none, because a run ended early.
    #[must_use]
    pub const fn error_estimate(&self) -> f64 {
        self.error_estimate
    }
    /// What is left of implicit constraints at the end of the worst step, relative to the terms of φ; zero where
    /// there are none.
    #[must_use]
    pub const fn residual(&self) -> f64 {
        self.residual
    }
    /// The same of their rates G q̇ + ∂φ/∂t.
    #[must_use]
    pub const fn rate_residual(&self) -> f64 {
        self.rate_residual
    }
    /// The times of the steps, the first being the start, s.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }
    /// The coordinates at the step of this number; 0 is the start.
    #[must_use]
    pub fn coordinates(&self, step: usize) -> Option<&[f64]> {
        Some(self.state(step)?.split_at(self.coordinates).0)
    }
    /// The velocities, or free quasi-velocities, at the step of this number; 0 is the start.
    #[must_use]
    pub fn velocities(&self, step: usize) -> Option<&[f64]> {
        Some(self.state(step)?.split_at(self.coordinates).1)
    }
    /// The coordinates and velocities at the end.
    #[must_use]
    pub fn last(&self) -> (&[f64], &[f64]) {
        self.states[self.states.len() - self.dimension..].split_at(self.coordinates)
    }

    fn state(&self, step: usize) -> Option<&[f64]> {
        let start = self.dimension.checked_mul(step)?;
        self.states.get(start..start.checked_add(self.dimension)?)
    }
}

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
pub(crate) fn record<F: Field<Error = DynamicsError>>(
    field: impl Fn() -> F,
    coordinates: usize,
    start: &[f64],
    times: Range<f64>,
    tolerance: Tolerance,
    mut certify: impl FnMut(f64, &[f64]) -> Result<Certificate, DynamicsError>,
) -> Result<Run, DynamicsError> {
    let mut run = Run {
        coordinates,
        dimension: start.len(),
        times: vec![times.start],
        states: start.to_vec(),
        report: Report { steps: 0, rejected: 0, evaluations: 0, ending: Ending::Reached },
        energy_drift: 0.0,
        error_estimate: f64::INFINITY,
        residual: 0.0,
        rate_residual: 0.0,
    };
    let stopped =
        |error: IntegratorsError| DynamicsError::Run { time: times.start, source: Box::new(error.with_field_error()) };
    let mut state = State::new(times.start, start.to_vec()).map_err(stopped)?;
    let followed = DormandPrince853::new(tolerance).integrate(&mut field(), &mut state, times.end, |step| {
        run.times.push(step.time());
        run.states.extend_from_slice(step.values());
        run.report.steps += 1;
        ControlFlow::Continue(())
    });
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
            return Err(DynamicsError::Unfinished { time: state.time, source: Box::new(error), run: Box::new(run) });
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
