//! What an observer sees of a run, how the run ended and what it cost.

use core::ops::ControlFlow;

/// One accepted step, as its observer sees it.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a, T = f64> {
    /// The number of the step, from 1.
    pub number: u64,
    /// The time at its end, s.
    pub time: f64,
    /// The state at its end.
    pub values: &'a [T],
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Ending {
    /// The end time was reached.
    Reached,
    /// The observer asked to stop.
    Stopped,
    /// The event of this index ended the run.
    Event(usize),
}

/// What a run cost and how it ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Report {
    /// Accepted steps.
    pub steps: u64,
    /// Steps that were tried and rejected.
    pub rejected: u64,
    /// Evaluations of the field (of the force, for separable systems).
    pub evaluations: u64,
    /// Accepted steps of an explicit Runge–Kutta pair that stability kept short, not accuracy: see
    /// [`was_stiff`](Self::was_stiff).
    #[cfg_attr(feature = "serde", serde(default))]
    pub stiff_steps: u64,
    /// How it ended.
    pub ending: Ending,
}

impl Report {
    /// Of a run that has not begun.
    #[must_use]
    pub const fn begin() -> Self {
        Self { steps: 0, rejected: 0, evaluations: 0, stiff_steps: 0, ending: Ending::Reached }
    }
    /// Whether an explicit method worked on a stiff problem: stability bounded at least fifteen of its steps, and one in
    /// ten. The implicit methods of `piola-stiff` then take far fewer.
    ///
    /// Each step of [`DormandPrince853`](crate::DormandPrince853) and [`Verner98`](crate::Verner98) estimates the largest
    /// eigenvalue λ of the Jacobian by two rates at its end, and compares |hλ| with the limit of stability:
    ///
    /// ```text
    /// |hλ| ≈ |h| ‖f(t + h, y) − f(t + h, g)‖ / ‖y − g‖,    g: the argument of the last stage
    /// ```
    ///
    /// # Example
    /// ```
    /// use piola_integrators::{DormandPrince853, State, Tolerance, field};
    /// // y follows cos t, to which it decays a thousand times faster than that changes.
    /// let mut follower = field(1, |t: f64, y: &[f64], rate: &mut [f64]| rate[0] = -1000.0 * (y[0] - t.cos()));
    /// let mut state = State::new(0.0, vec![1.0])?;
    /// let report = DormandPrince853::new(Tolerance::relative(1e-6)?).integrate_to(&mut follower, &mut state, 10.0)?;
    /// assert!(report.was_stiff());
    /// # Ok::<(), piola_integrators::IntegratorsError>(())
    /// ```
    #[doc(alias("stiffness"))]
    #[must_use]
    pub const fn was_stiff(&self) -> bool {
        /// Fewer steps may be bounded by chance.
        const FEWEST: u64 = 15;
        FEWEST <= self.stiff_steps && self.steps <= 10 * self.stiff_steps
    }
    /// What a run that goes on begins with.
    #[doc(hidden)]
    #[must_use]
    pub const fn continued(mut self) -> Self {
        self.ending = Ending::Reached;
        self
    }
    /// This run followed by another.
    #[must_use]
    pub const fn then(self, next: Self) -> Self {
        Self {
            steps: self.steps + next.steps,
            rejected: self.rejected + next.rejected,
            evaluations: self.evaluations + next.evaluations,
            stiff_steps: self.stiff_steps + next.stiff_steps,
            ending: next.ending,
        }
    }
}

/// The observer that watches nothing and never stops a run.
pub fn unobserved<T>(_step: Step<'_, T>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}
