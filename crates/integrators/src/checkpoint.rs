//! A run at one of its accepted steps, to be written down and continued.

use piola_numerics::Real;

use crate::state::check_finite;
use crate::{IntegratorsError, Report, State};

/// A run at the end of an accepted step. Continued by the `resume` of the same method with the same settings, to the same end,
/// the run takes the same steps, to the last bit. To another end it goes on from the same state. A checkpoint of another method is
/// refused.
///
/// The observer of an adaptive method takes it from the step, as below. For [`GaussLegendre`](crate::GaussLegendre),
/// [`ProcessedSplitting`](crate::ProcessedSplitting) and the methods of `piola-geometric`, stop the run in the observer; then call
/// `method.checkpoint(&state, report)`. The methods of `piola-gravitation` for planets and collisions return it from
/// `integrate_to_checkpoint`.
///
/// # Example
/// ```
/// use core::ops::ControlFlow;
/// use piola_integrators::{Checkpoint, State, Tolerance, Verner98, field};
/// let mut pendulum = field(2, |_t, y: &[f64], rate: &mut [f64]| rate.copy_from_slice(&[y[1], -y[0].sin()]));
/// let start = State::new(0.0, vec![1.0, 0.0])?;
/// let mut method = Verner98::new(Tolerance::relative(1e-9)?);
/// // A run, and what it was after its fifth step: with the feature `serde`, this can be written to a file.
/// let (mut whole, mut kept) = (start.clone(), None);
/// method.integrate(&mut pendulum, &mut whole, 20.0, |step| {
///     if step.number() == 5 {
///         kept = Some(step.checkpoint());
///     }
///     ControlFlow::Continue(())
/// })?;
/// let kept: Checkpoint = kept.expect("more than five steps");
/// let mut continued = kept.state().clone();
/// Verner98::new(Tolerance::relative(1e-9)?)
///     .resume(&mut pendulum, &kept, &mut continued, 20.0, |_step| ControlFlow::Continue(()))?;
/// assert_eq!(continued, whole);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("restart", "snapshot"))]
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>"))
)]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Checkpoint<T = f64> {
    /// The name of the method that made it.
    pub(crate) method: MethodName,
    pub(crate) state: State<T>,
    pub(crate) report: Report,
    /// What the method knows of the run beside the state: stages or polynomials.
    pub(crate) memory: Vec<T>,
    /// The same, numbers: lengths of steps, magnitudes.
    pub(crate) numbers: Vec<f64>,
}

/// The name of a method that makes checkpoints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(crate) struct MethodName(&'static str);

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for MethodName {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        /// Those of this crate, of `piola-geometric` and of `piola-gravitation`.
        const ALL: [&str; 20] = [
            "AdaptiveMuntheKaas",
            "DemocraticHeliocentric",
            "DiscreteEulerLagrange",
            "DiscreteGradient",
            "DormandPrince853",
            "GaussCollocation",
            "GaussLegendre",
            "GaussLegendre16",
            "GaussRadau15",
            "GeneralisedAlpha",
            "HybridSymplectic",
            "LobattoPair",
            "Nystrom1210",
            "Nystrom86",
            "ProcessedSplitting",
            "Regularised",
            "ReversibleComposition",
            "VariationalIntegrator",
            "Verner98",
            "WisdomHolman",
        ];
        let read: String = serde::Deserialize::deserialize(deserializer)?;
        let known = ALL.into_iter().find(|&name| name == read).map(Self);
        known.ok_or_else(|| serde::de::Error::unknown_variant(&read, &ALL))
    }
}

impl<T: Real> Checkpoint<T> {
    /// The state.
    #[must_use]
    pub const fn state(&self) -> &State<T> {
        &self.state
    }
    /// What the run has cost so far.
    #[must_use]
    pub const fn report(&self) -> Report {
        self.report
    }

    /// Of a run of the `method`, which remembers `memory` and `numbers` beside the state.
    #[doc(hidden)]
    #[must_use]
    pub const fn of(method: &'static str, state: State<T>, report: Report, memory: Vec<T>, numbers: Vec<f64>) -> Self {
        Self { method: MethodName(method), state, report, memory, numbers }
    }
    #[doc(hidden)]
    #[must_use]
    pub fn memory(&self) -> (&[T], &[f64]) {
        (&self.memory, &self.numbers)
    }

    /// Refuses a checkpoint of another method or of another size, and one whose numbers are not finite or, at the places of
    /// `positive`, not positive. The state becomes that of the checkpoint unless `check` refuses it.
    ///
    /// # Errors
    /// What is refused; the state is then left alone.
    #[doc(hidden)]
    pub fn open<E>(
        &self,
        method: &'static str,
        [memory, numbers]: [usize; 2],
        positive: &[usize],
        state: &mut State<T>,
        check: impl FnOnce(&mut State<T>) -> Result<(), IntegratorsError<E>>,
    ) -> Result<(), IntegratorsError<E>> {
        let MethodName(found) = self.method;
        if found != method {
            return Err(IntegratorsError::WrongMethod { expected: method, found });
        }
        for (quantity, expected, found) in
            [("checkpoint.memory", memory, self.memory.len()), ("checkpoint.numbers", numbers, self.numbers.len())]
        {
            if expected != found {
                return Err(IntegratorsError::WrongLength { quantity, expected, found });
            }
        }
        check_finite("checkpoint.memory", None, &self.memory)?;
        check_finite("checkpoint.numbers", None, &self.numbers)?;
        for &index in positive {
            let value = self.numbers[index];
            if value <= 0.0 {
                return Err(IntegratorsError::NotPositive { quantity: "checkpoint.numbers", value });
            }
        }
        let mut opened = self.state.clone();
        check(&mut opened)?;
        *state = opened;
        Ok(())
    }
}

/// What the loop over the steps knows of a run when a step is accepted, beside state and method.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RunSoFar {
    pub(crate) report: Report,
    pub(crate) time_carry: f64,
    /// When the whole run started, s.
    pub(crate) start: f64,
    /// The next step to try, s.
    pub(crate) next: f64,
    /// The step that would have been the best one, s.
    pub(crate) best: f64,
}

impl RunSoFar {
    /// Of a method that makes no checkpoints.
    pub(crate) const fn unknown() -> Self {
        Self { report: Report::begin(), time_carry: 0.0, start: 0.0, next: 0.0, best: 0.0 }
    }

    /// The checkpoint of a collocation method at the end of a step: its numbers are the start of the run, the lengths of the
    /// next step and of the best one, the last step, and the contraction that is expected.
    pub(crate) fn checkpoint<T: Real>(
        &self,
        method: &'static str,
        time: f64,
        values: &[T],
        carry: &[T],
        (memory, [previous_step, expected]): (Vec<T>, [f64; 2]),
    ) -> Checkpoint<T> {
        let Self { report, time_carry, start, next, best } = *self;
        let state = State { time, values: values.to_vec(), carry: carry.to_vec(), time_carry, run: None };
        let numbers = vec![start, next.abs(), best, previous_step, expected];
        Checkpoint::of(method, state, report, memory, numbers)
    }
}
