//! A run at one of its accepted steps, to be written down and continued.

use piola_integrators::internal::check_finite;
use piola_integrators::{IntegratorsError, State};

use super::RadauReport;
use super::control::Controller;
use super::order::RadauOrder;
use super::stages::Workspace;

/// A run of [`RadauIia`](super::RadauIia) at the end of an accepted step. Continued by [`RadauIia::resume`](super::RadauIia::resume)
/// with the same settings, to the same end, the run takes the same steps, to the last bit.
///
/// Besides the state it holds the stages of the last step and, if it serves again, the Jacobian.
///
/// # Example
/// ```
/// use core::ops::ControlFlow;
/// use piola_integrators::{State, Tolerance, field};
/// use piola_stiff::{DifferenceJacobian, RadauIia};
/// let decay = || DifferenceJacobian::new(field(1, |t, y: &[f64], rate: &mut [f64]| rate[0] = 1e4 * (f64::cos(t) - y[0])));
/// let mut method = RadauIia::new(Tolerance::relative(1e-8)?);
/// let (mut whole, mut kept) = (State::new(0.0, vec![0.0])?, None);
/// let report = method.integrate(&mut decay(), &mut whole, 10.0, |step| {
///     if step.number() == 5 {
///         kept = Some(step.checkpoint());
///     }
///     ControlFlow::Continue(())
/// })?;
/// let kept = kept.expect("more than five steps");
/// let mut continued = kept.state().clone();
/// let again = RadauIia::new(Tolerance::relative(1e-8)?)
///     .resume(&mut decay(), &kept, &mut continued, 10.0, |_step| ControlFlow::Continue(()))?;
/// assert_eq!((continued, again), (whole, report));
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("restart", "snapshot"))]
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct RadauCheckpoint {
    state: State,
    report: RadauReport,
    /// When the whole run started, s.
    origin: f64,
    memory: Memory,
    /// The stages of the last step.
    stages: Vec<f64>,
    /// f at the state.
    rate: Vec<f64>,
    /// The Jacobian, where it serves again.
    jacobian: Vec<f64>,
}

/// What a run remembers from one step to the next, beside its vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub(super) struct Memory {
    pub(super) controller: Controller,
    /// The length of the next step to be tried, s.
    pub(super) step: f64,
    /// Order and step of the last accepted step.
    pub(super) last: Option<(RadauOrder, f64)>,
    /// Order and step of the factors of the Jacobian; none where it does not serve again.
    pub(super) factored: Option<(RadauOrder, f64)>,
    pub(super) is_jacobian_kept: bool,
    /// θ/(1 − θ) of the last iteration.
    pub(super) rest: f64,
}

impl RadauCheckpoint {
    pub(super) fn new(state: State, report: RadauReport, origin: f64, memory: Memory, work: &Workspace) -> Self {
        let n = work.trial.len();
        let stages = memory.last.map_or(0, |(order, _)| order.tableau().stages());
        let jacobian = if memory.is_jacobian_kept { work.matrices.jacobian_in_memory().to_vec() } else { Vec::new() };
        Self {
            state,
            report,
            origin,
            memory,
            stages: work.accepted[..stages * n].to_vec(),
            rate: work.rate.clone(),
            jacobian,
        }
    }

    /// The state.
    #[must_use]
    pub const fn state(&self) -> &State {
        &self.state
    }

    /// What the run has cost so far.
    #[must_use]
    pub const fn report(&self) -> RadauReport {
        self.report
    }

    pub(super) const fn origin(&self) -> f64 {
        self.origin
    }

    /// Puts the vectors back; refuses those that do not fit or are not finite.
    pub(super) fn open<E>(&self, work: &mut Workspace) -> Result<Memory, IntegratorsError<E>> {
        let (n, memory) = (work.trial.len(), self.memory);
        let most = work.accepted.len();
        let stages = memory.last.map_or(0, |(order, _)| order.tableau().stages() * n);
        let entries = if memory.is_jacobian_kept { work.matrices.jacobian().len() } else { 0 };
        // Stages of an order above the highest have no room.
        let room = if most < stages { most } else { self.stages.len() };
        for (quantity, expected, found) in [
            ("checkpoint.stages", room, stages),
            ("checkpoint.rate", n, self.rate.len()),
            ("checkpoint.jacobian", entries, self.jacobian.len()),
        ] {
            if expected != found {
                return Err(IntegratorsError::WrongLength { quantity, expected, found });
            }
        }
        let [last, factored] = [memory.last, memory.factored].map(|made| made.map_or(1.0, |(_, step)| step));
        let numbers = [memory.step, memory.rest, self.origin, last, factored];
        check_finite("checkpoint.numbers", None, &numbers)?;
        check_finite("checkpoint.stages", None, &self.stages)?;
        check_finite("checkpoint.rate", None, &self.rate)?;
        check_finite("checkpoint.jacobian", None, &self.jacobian)?;
        for value in [memory.step, last.abs(), factored.abs()] {
            if value <= 0.0 {
                return Err(IntegratorsError::NotPositive { quantity: "checkpoint.numbers", value });
            }
        }
        work.accepted[..stages].copy_from_slice(&self.stages);
        work.rate.copy_from_slice(&self.rate);
        work.rest = memory.rest;
        if memory.is_jacobian_kept {
            work.matrices.jacobian().copy_from_slice(&self.jacobian);
        }
        Ok(memory)
    }
}
