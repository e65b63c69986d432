//! The motion in time, with a method chosen for it.

use core::ops::{ControlFlow, Range};

use piola_integrators::{DormandPrince853, IntegrationError, Report, State, Tolerance};
use piola_kinematics::Holonomic;

use super::acceleration::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::DynamicsError;

/// A motion that has been computed: every accepted step, and how good it is.
#[derive(Clone, Debug)]
pub struct Run {
    coordinates: usize,
    times: Vec<f64>,
    states: Vec<f64>,
    report: Report,
    energy_drift: f64,
    error_estimate: f64,
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
    /// The largest change of the Jacobi integral h, relative to the largest |h| or |E| met, whichever is
    /// larger. A measure of error when neither time nor applied forces change h; otherwise it shows their
    /// work.
    #[must_use]
    pub const fn energy_drift(&self) -> f64 {
        self.energy_drift
    }
    /// The largest difference of a coordinate at the end to a second run with a hundredth of the tolerance:
    /// an estimate of the global error.
    #[must_use]
    pub const fn error_estimate(&self) -> f64 {
        self.error_estimate
    }
    /// The times of the steps, the first being the start, s.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }
    /// The coordinates at the step of this number; 0 is the start.
    #[must_use]
    pub fn coordinates(&self, step: usize) -> Option<&[f64]> {
        let n = self.coordinates;
        self.states.get(2 * n * step..2 * n * step + n)
    }
    /// The velocities at the step of this number; 0 is the start.
    #[must_use]
    pub fn velocities(&self, step: usize) -> Option<&[f64]> {
        let n = self.coordinates;
        self.states.get(2 * n * step + n..2 * n * (step + 1))
    }
    /// The coordinates and velocities at the end.
    #[must_use]
    pub fn last(&self) -> (&[f64], &[f64]) {
        self.states[self.states.len() - 2 * self.coordinates..].split_at(self.coordinates)
    }
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// Integrates the motion from (q, q̇) over a span of time and keeps every step.
    ///
    /// The method is the adaptive one of order eight; its global error is estimated by a second run with a
    /// hundredth of the tolerance, which costs about 1.8 times the first. For a method of your choice, an
    /// observer, dense output or events, give [`motion`](Self::motion) to an integrator.
    ///
    /// # Errors
    /// What [`check`](Self::check) refuses; [`DynamicsError::Run`] when the run fails.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_dynamics::lagrangian::{Holonomic, Lagrangian, Placement};
    /// # use piola_numerics::Real;
    /// use piola_integrators::Tolerance;
    /// # struct Pendulum { mass: f64, length: f64 }
    /// # impl Holonomic for Pendulum {
    /// #     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    /// #         let (s, c) = q[0].sin_cos();
    /// #         let length = T::lit(self.length);
    /// #         bodies.particle(self.mass, Vector3::new(length * s, T::zero(), -length * c));
    /// #     }
    /// # }
    /// let pendulum = Lagrangian::of(Pendulum { mass: 1.0, length: 1.0 }).with_gravity(9.80665);
    /// let run = pendulum.integrate(&[1.0], &[0.0], 0.0..60.0, Tolerance::relative(1e-10)?)?;
    /// assert!(run.energy_drift() < 1e-8 && run.error_estimate() < 1e-7);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn integrate(
        &self,
        q: &[f64],
        v: &[f64],
        times: Range<f64>,
        tolerance: Tolerance,
    ) -> Result<Run, DynamicsError> {
        self.check(q, v, times.start)?;
        let n = q.len();
        let start: Vec<f64> = q.iter().chain(v).copied().collect();
        let mut run = Run {
            coordinates: n,
            times: vec![times.start],
            states: start.clone(),
            report: Report { steps: 0, rejected: 0, evaluations: 0, ending: piola_integrators::Ending::Reached },
            energy_drift: 0.0,
            error_estimate: 0.0,
        };
        let mut state = State::new(times.start, start.clone()).map_err(|error| stopped(times.start, error))?;
        let mut method = DormandPrince853::new(tolerance);
        run.report = method
            .integrate(&mut self.motion(n), &mut state, times.end, |step| {
                run.times.push(step.time());
                run.states.extend_from_slice(step.values());
                ControlFlow::Continue(())
            })
            .map_err(|error| DynamicsError::Run { time: state.time, source: Box::new(error) })?;
        run.energy_drift = self.drift(&run)?;

        let finer = Tolerance::new(tolerance.relative_part() * 0.01, tolerance.absolute_part() * 0.01)
            .map_err(|error| stopped(times.start, error))?;
        let mut reference = State::new(times.start, start).map_err(|error| stopped(times.start, error))?;
        DormandPrince853::new(finer)
            .integrate_to(&mut self.motion(n), &mut reference, times.end)
            .map_err(|error| DynamicsError::Run { time: reference.time, source: Box::new(error) })?;
        run.error_estimate =
            state.values[..n].iter().zip(&reference.values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        Ok(run)
    }

    fn drift(&self, run: &Run) -> Result<f64, DynamicsError> {
        let mut work = Workspace::default();
        let (mut first, mut change, mut scale) = (None, 0.0_f64, 0.0_f64);
        let mut momenta = vec![0.0; run.coordinates];
        for (step, &time) in run.times.iter().enumerate() {
            let (Some(q), Some(v)) = (run.coordinates(step), run.velocities(step)) else { continue };
            let energies = self.energies_with(&mut work, q, v, time)?;
            self.momenta_into(&mut work, q, v, time, &mut momenta)?;
            let h = momenta.iter().zip(v).map(|(p, v)| p * v).sum::<f64>() - energies.lagrangian();
            let start = *first.get_or_insert(h);
            change = change.max((h - start).abs());
            scale = scale.max(h.abs()).max(energies.kinetic);
        }
        Ok(if 0.0 < scale { change / scale } else { 0.0 })
    }
}

fn stopped(time: f64, error: IntegrationError) -> DynamicsError {
    DynamicsError::Run { time, source: Box::new(error.with_field_error()) }
}
