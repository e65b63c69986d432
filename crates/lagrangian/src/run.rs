//! A motion that has been computed, with a method chosen for it.

use piola_integrators::Report;
use piola_kinematics::SingularPosition;

/// A motion that has been computed: every accepted step, and how good it is.
///
/// A state is (q, q̇); of a system of which some quasi-velocities are held, (q, the free quasi-velocities).
///
/// # Example
/// See [`Lagrangian`](crate::Lagrangian).
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    pub(super) coordinates: usize,
    pub(super) dimension: usize,
    pub(super) times: Vec<f64>,
    pub(super) states: Vec<f64>,
    pub(super) report: Report,
    pub(super) energy_drift: f64,
    pub(super) error_estimate: f64,
    pub(super) residual: f64,
    pub(super) rate_residual: f64,
    pub(super) singular_positions: Vec<SingularPosition>,
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
    /// The singular positions of constraints that the run went through: the first 64.
    #[must_use]
    pub fn singular_positions(&self) -> &[SingularPosition] {
        &self.singular_positions
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
