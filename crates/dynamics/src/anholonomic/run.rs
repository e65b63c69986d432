//! The motion in time, with a method chosen for it.

use core::ops::{ControlFlow, Range};

use piola_integrators::{DormandPrince853, Ending, IntegrationError, Report, State, Tolerance};
use piola_kinematics::Holonomic;

use super::solve::Workspace;
use super::{Nonholonomic, QuasiVelocities};
use crate::DynamicsError;
use crate::lagrangian::{Forces, Potential};

/// A motion that has been computed: every accepted step, and how good it is.
///
/// # Example
/// See [`Nonholonomic::integrate`].
#[derive(Clone, Debug)]
pub struct ConstrainedRun {
    coordinates: usize,
    dimension: usize,
    times: Vec<f64>,
    states: Vec<f64>,
    report: Report,
    energy_change: f64,
    error_estimate: f64,
}

impl ConstrainedRun {
    /// The number of accepted steps.
    ///
    /// # Example
    /// See [`Nonholonomic::integrate`].
    #[must_use]
    pub const fn steps(&self) -> u64 {
        self.report.steps
    }
    /// What the run cost.
    ///
    /// # Example
    /// See [`Nonholonomic::integrate`].
    #[must_use]
    pub const fn report(&self) -> Report {
        self.report
    }
    /// The largest change of E + V, relative to the largest |E + V| or E met, whichever is larger. A measure of
    /// error where nothing works: no applied forces, no moving surface, nothing held at a speed.
    ///
    /// # Example
    /// See [`Nonholonomic::integrate`].
    #[must_use]
    pub const fn energy_change(&self) -> f64 {
        self.energy_change
    }
    /// The largest difference of a coordinate at the end to a second run with a hundredth of the tolerance:
    /// an estimate of the global error.
    ///
    /// # Example
    /// See [`Nonholonomic::integrate`].
    #[must_use]
    pub const fn error_estimate(&self) -> f64 {
        self.error_estimate
    }
    /// The times of the steps, the first being the start, s.
    ///
    /// # Example
    /// See [`Nonholonomic::integrate`].
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }
    /// The coordinates at the step of this number; 0 is the start.
    ///
    /// # Example
    /// See [`Nonholonomic::integrate`].
    #[must_use]
    pub fn coordinates(&self, step: usize) -> Option<&[f64]> {
        Some(self.state(step)?.split_at(self.coordinates).0)
    }
    /// The free quasi-velocities at the step of this number; 0 is the start.
    ///
    /// # Example
    /// See [`Nonholonomic::integrate`].
    #[must_use]
    pub fn quasi_velocities(&self, step: usize) -> Option<&[f64]> {
        Some(self.state(step)?.split_at(self.coordinates).1)
    }
    /// The coordinates and free quasi-velocities at the end.
    ///
    /// # Example
    /// See [`Nonholonomic::integrate`].
    #[must_use]
    pub fn last(&self) -> (&[f64], &[f64]) {
        self.states[self.states.len() - self.dimension..].split_at(self.coordinates)
    }

    fn state(&self, step: usize) -> Option<&[f64]> {
        self.states.get(self.dimension * step..self.dimension * (step + 1))
    }
}

impl<S: Holonomic, P: Potential, F: Forces, W: QuasiVelocities> Nonholonomic<S, P, F, W> {
    /// Integrates the motion from (q, w) over a span of time and keeps every step.
    ///
    /// The method is the adaptive one of order eight; its global error is estimated by a second run with a
    /// hundredth of the tolerance. For a method of your choice, an observer, dense output or events, give
    /// [`motion`](Self::motion) to an integrator.
    ///
    /// # Errors
    /// What [`Lagrangian::check`](crate::lagrangian::Lagrangian::check) and [`velocities`](Self::velocities)
    /// refuse; [`DynamicsError::Run`] when the run fails.
    ///
    /// # Example
    /// ```
    /// use piola_dynamics::anholonomic::rolling::RollingDisc;
    /// use piola_integrators::Tolerance;
    /// let coin = RollingDisc::homogeneous(5.7e-3, 12e-3)?.on_plane([0.0, 0.0, -9.81]);
    /// let (q, w) = ([0.0, 0.0, 0.0, 1.5, 0.0], [0.0, 0.0, -40.0]);
    /// let run = coin.integrate(&q, &w, 0.0..1.0, Tolerance::relative(1e-10)?)?;
    /// assert!(run.energy_change() < 1e-9 && run.error_estimate() < 1e-7);
    /// assert_eq!(run.quasi_velocities(0), Some(&w[..]));
    /// let (end, _) = run.last();
    /// assert!(0.2 < end[1]); // it started along y
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn integrate(
        &self,
        q: &[f64],
        w: &[f64],
        times: Range<f64>,
        tolerance: Tolerance,
    ) -> Result<ConstrainedRun, DynamicsError> {
        let v = self.velocities(q, w, times.start)?;
        self.unconstrained().lagrangian().check(q, v.as_slice(), times.start)?;
        let start = [q, w].concat();
        let mut run = ConstrainedRun {
            coordinates: q.len(),
            dimension: start.len(),
            times: vec![times.start],
            states: start.clone(),
            report: Report { steps: 0, rejected: 0, evaluations: 0, ending: Ending::Reached },
            energy_change: 0.0,
            error_estimate: 0.0,
        };
        let stopped = |time: f64| {
            move |error: IntegrationError| DynamicsError::Run { time, source: Box::new(error.with_field_error()) }
        };
        let mut state = State::new(times.start, start.clone()).map_err(stopped(times.start))?;
        run.report = DormandPrince853::new(tolerance)
            .integrate(&mut self.motion(q.len()), &mut state, times.end, |step| {
                run.times.push(step.time());
                run.states.extend_from_slice(step.values());
                ControlFlow::Continue(())
            })
            .map_err(|error| DynamicsError::Run { time: state.time, source: Box::new(error) })?;
        run.energy_change = self.energy_change(&run)?;

        let finer = Tolerance::new(tolerance.relative_part() * 0.01, tolerance.absolute_part() * 0.01)
            .map_err(stopped(times.start))?;
        let mut reference = State::new(times.start, start).map_err(stopped(times.start))?;
        DormandPrince853::new(finer)
            .integrate_to(&mut self.motion(q.len()), &mut reference, times.end)
            .map_err(|error| DynamicsError::Run { time: reference.time, source: Box::new(error) })?;
        let pairs = state.values.iter().zip(&reference.values).take(q.len());
        run.error_estimate = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        Ok(run)
    }

    fn energy_change(&self, run: &ConstrainedRun) -> Result<f64, DynamicsError> {
        let mut work = Workspace::default();
        let mut v = vec![0.0; run.coordinates];
        let (mut first, mut change, mut scale) = (None, 0.0_f64, 0.0_f64);
        for (state, &time) in run.states.chunks_exact(run.dimension.max(1)).zip(&run.times) {
            let (q, w) = state.split_at(run.coordinates);
            self.spread(&mut work, q, w)?;
            work.map.evaluate(self.unconstrained().map(), q, time)?;
            work.map.velocities_into(&work.quasi, &mut v);
            let energies = self.unconstrained().lagrangian().energies_with(&mut work.lagrangian, q, &v, time)?;
            let total = energies.total();
            change = change.max((total - *first.get_or_insert(total)).abs());
            scale = scale.max(total.abs()).max(energies.kinetic);
        }
        Ok(if 0.0 < scale { change / scale } else { 0.0 })
    }
}
