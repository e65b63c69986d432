//! Dormand–Prince 8(5,3): an adaptive explicit Runge–Kutta method of order eight with dense output of order
//! seven and events.
//!
//! The step is chosen so that the local error, estimated by two embedded formulas of orders five and three,
//! stays below the [`Tolerance`]. Dense output costs three more evaluations, made only for the steps where it
//! is asked for, and never extrapolates.
//!
//! # When?
//! For smooth fields that are not stiff, at tolerances from 1e-6 to rounding: close encounters, driven and
//! damped systems, trajectories at prescribed times. For millions of revolutions prefer a symplectic method.
//!
//! # References
//! Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, II.4–II.6, II.10.

#[expect(clippy::unreadable_literal, reason = "seventeen digits, to be compared with printed tables")]
mod coefficients;
mod dense;
mod stages;
mod with_events;

use core::ops::ControlFlow;

use piola_numerics::Real;

pub use dense::DenseStep;

use crate::events::{Stop, stopped_by};
use crate::explicit::{Limits, follow, settle};
use crate::state::check_longest;
use crate::{Field, IntegratorsError, Report, State, Tolerance};

/// The adaptive method of order 8(5,3).
///
/// # Accuracy
/// The local error of each step is below the tolerance; the global error is proportional to it, by a factor
/// that the problem's sensitivity sets. The state and the time are summed with compensation.
///
/// # Example
/// ```
/// use piola_integrators::{DormandPrince853, State, Tolerance, field};
/// let mut oscillator = field(2, |_t, y: &[f64], rate: &mut [f64]| {
///     rate[0] = y[1];
///     rate[1] = -y[0];
/// });
/// let mut state = State::new(0.0, vec![1.0, 0.0])?;
/// let mut method = DormandPrince853::new(Tolerance::relative(1e-13)?);
/// let mut largest = 0.0_f64;
/// method.integrate(&mut oscillator, &mut state, 10.0, |step| {
///     // Dense output in the middle of each step.
///     let middle = 0.5 * (step.start() + step.time());
///     let mut y = [0.0; 2];
///     if step.at(middle, &mut y).is_ok() {
///         largest = largest.max((y[0] - middle.cos()).abs());
///     }
///     std::ops::ControlFlow::Continue(())
/// })?;
/// assert!((state.values[0] - 10.0_f64.cos()).abs() < 1e-12);
/// assert!(largest < 1e-11);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("DOP853", "Runge-Kutta"))]
#[derive(Clone, Debug)]
pub struct DormandPrince853<T = f64> {
    tolerance: Tolerance,
    limits: Limits,
    /// Rows of one state each: see `Row`.
    memory: Vec<T>,
    /// Components of the state.
    components: usize,
    magnitudes: Vec<f64>,
    magnitudes_at_end: Vec<f64>,
}

/// The rows of the memory.
#[derive(Clone, Copy, Debug)]
struct Row;
impl Row {
    /// k₁ … k₁₆ come first; stage 12 is the rate at the end of the step.
    const STAGES: usize = 16;
    /// The stage's argument, then the step's end and what rounding left of it.
    const TRIAL: usize = 16;
    /// The step's start and what rounding left of it.
    const START: usize = 18;
    const START_CARRY: usize = 19;
    /// The seven coefficients of the interpolating polynomial; see `dense`.
    const INTERPOLANT: usize = 20;
    const COUNT: usize = 27;
}

impl<T: Real> DormandPrince853<T> {
    /// A method with the given tolerance.
    #[must_use]
    pub const fn new(tolerance: Tolerance) -> Self {
        Self {
            tolerance,
            limits: Limits::none(),
            memory: Vec::new(),
            components: 0,
            magnitudes: Vec::new(),
            magnitudes_at_end: Vec::new(),
        }
    }

    /// Sets the first step tried, s; by default it is estimated.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn with_first_step(mut self, step: f64) -> Result<Self, IntegratorsError> {
        crate::state::check_step(step)?;
        self.limits.first_step = Some(step);
        Ok(self)
    }

    /// Bounds every step, s; by default steps are not bounded.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step; ∞ is no bound.
    pub fn with_longest_step(mut self, step: f64) -> Result<Self, IntegratorsError> {
        self.limits.longest_step = check_longest(step)?;
        Ok(self)
    }

    /// Bounds the number of steps of one run; by default it is not bounded.
    #[must_use]
    pub const fn with_most_steps(mut self, steps: u64) -> Self {
        self.limits.most_steps = steps;
        self
    }

    /// The tolerance.
    #[must_use]
    pub const fn tolerance(&self) -> Tolerance {
        self.tolerance
    }

    pub(crate) const fn tolerance_mut(&mut self) -> &mut Tolerance {
        &mut self.tolerance
    }

    /// Integrates to `end`, unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.integrate(field, state, end, |_| ControlFlow::Continue(()))
    }

    /// Integrates to `end`, backwards if it is earlier than the state's time. The observer sees every step,
    /// may ask for the state at any time within it, and may stop the run.
    ///
    /// # Errors
    /// The state does not fit or is not finite; the field fails or its rate is not finite at the start or, however
    /// small the step, beyond a time; the step no longer advances the time; or the limit on steps is reached.
    /// The state then stands at the last accepted step.
    pub fn integrate<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        mut observer: impl FnMut(&mut DenseStep<'_, T, F>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.run(field, state, end, &mut |step| Ok(stopped_by(observer(step))))
    }

    /// Runs to `end`. `inspect` sees each accepted step; to end the run it gives the time of the end (the step's own end
    /// when `None`) and how the run ended.
    fn run<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        inspect: &mut impl FnMut(&mut DenseStep<'_, T, F>) -> Result<ControlFlow<Stop>, IntegratorsError<F::Error>>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        follow(self, field, state, end, &mut |method, field, state, step, report| {
            let mut dense = DenseStep::new(method, field, step);
            let verdict = inspect(&mut dense);
            settle(verdict, &mut dense, state, report)
        })
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn evaluate<T: Real, F: Field<T>>(
    field: &mut F,
    time: f64,
    y: &[T],
    rate: &mut [T],
) -> Result<(), IntegratorsError<F::Error>> {
    field.rate(time, y, rate).map_err(|source| IntegratorsError::Field { t: time, source })
}
