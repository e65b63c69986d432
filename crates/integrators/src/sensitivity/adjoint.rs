//! The gradient of one number by all inputs of a run, backwards in time.

use core::ops::ControlFlow;

use piola_numerics::Real;

use super::checkpoints::Checkpoints;
use super::reversal::Reversal;
use super::stages::StepTimes;
use super::{Objective, ObjectiveGradient, ParametricField, WithParameters, check_length};
use crate::events::stopped_by;
use crate::explicit::{Rows, RungeKutta, RungeKuttaPair};
use crate::state::check_run;
use crate::{IntegratorsError, Report, State, Step};

/// The gradient of an [`Objective`] by the start of a run and by all parameters: the discrete adjoint method.
///
/// A run is recorded first; [`gradient`](Self::gradient) then walks it backwards. The gradient is the exact derivative of the run
/// that was made, with the lengths of its steps held fixed: it agrees to rounding with
/// [`ForwardSensitivity`](super::ForwardSensitivity).
///
/// The scalar may itself carry derivatives: over [`Dual`](piola_numerics::Dual) the gradient's own derivative along a direction comes
/// along, a product of the Hessian with a vector.
///
/// # Cost
/// With a product of the field's own ([`ParametricField::vector_jacobian_product`]) the time does not grow with the number of
/// parameters: 4 to 5 times that of the run in the example `sensitivities`. With the default product it is about that of the forward
/// method.
///
/// # Memory
/// ```text
/// 2 numbers for each accepted step  +  2 n (c + 1) numbers,    c: the states kept beside the start
/// ```
///
/// States between those kept are made again. The number of steps made again, as a multiple of the number N of steps:
///
/// | N | c = 10 | c = 30 | c = 100 |
/// |---|---|---|---|
/// | 100 | 1.32 | 0.75 | 0 |
/// | 1000 | 2.81 | 1.59 | 0.94 |
/// | 10 000 | 7.34 | 2.39 | 1.50 |
///
/// It is at most 2.1 for N ≤ (c + 1)², and 0 for N ≤ c + 1. With c = 0 it is (N − 1)/2.
///
/// # Accuracy
/// As [`ForwardSensitivity`](super::ForwardSensitivity). The gradient has the same bits for any number of states kept.
///
/// # References
/// Griewank & Walther, *Evaluating Derivatives*, 2nd ed., chapter 12; A. Sandu, *On the properties of Runge–Kutta discrete adjoints*,
/// LNCS 3994 (2006) 550–557.
///
/// # Example
/// ```
/// use core::convert::Infallible;
/// use piola_integrators::*;
/// use piola_numerics::Real;
/// /// ẍ = −p² x.
/// struct Oscillator;
/// impl ParametricField for Oscillator {
///     type Error = Infallible;
///     fn dimension(&self) -> usize {
///         2
///     }
///     fn parameters(&self) -> usize {
///         1
///     }
///     fn rate<T: Real>(&self, _t: f64, y: &[T], p: &[T], rate: &mut [T]) -> Result<(), Infallible> {
///         rate[0] = y[1];
///         rate[1] = -p[0] * p[0] * y[0];
///         Ok(())
///     }
/// }
/// /// J = x(t₁) + ∫ x dt.
/// struct PlaceAndMean;
/// impl Objective for PlaceAndMean {
///     const RUNNING: bool = true;
///     fn terminal<T: Real>(&self, _t: f64, y: &[T], _p: &[T]) -> T {
///         y[0]
///     }
///     fn running<T: Real>(&self, _t: f64, y: &[T], _p: &[T]) -> T {
///         y[0]
///     }
/// }
/// // x = cos pt from rest: J = cos pt + sin(pt)/p at t = 5.
/// let mut state = State::new(0.0, vec![1.0, 0.0])?;
/// let mut method = AdjointSensitivity::new(DormandPrince853::new(Tolerance::relative(1e-13)?), 5);
/// method.integrate_to(&Oscillator, &[2.0], &mut state, 5.0)?;
/// let mut gradient = ObjectiveGradient::default();
/// method.gradient(&Oscillator, &PlaceAndMean, &mut gradient)?;
/// let (sine, cosine) = 10.0_f64.sin_cos();
/// assert!((gradient.value - (cosine + 0.5 * sine)).abs() < 1e-12);
/// assert!((gradient.by_parameters[0] - (-5.0 * sine + 2.5 * cosine - 0.25 * sine)).abs() < 1e-11);
/// # Ok::<(), IntegratorsError>(())
/// ```
#[doc(alias("adjoint equations", "backpropagation", "reverse mode", "checkpointing"))]
#[derive(Clone, Debug)]
pub struct AdjointSensitivity<P, T = f64> {
    method: RungeKutta<P, T>,
    /// The start and the length of each accepted step.
    steps: Vec<(f64, f64)>,
    checkpoints: Checkpoints<T>,
    p: Vec<T>,
    end_time: f64,
    end: Vec<T>,
    reversal: Reversal<T>,
}

impl<P: RungeKuttaPair, T: Real> AdjointSensitivity<P, T> {
    /// Records the runs of a method. It keeps at most `checkpoints` states of a run, beside the start.
    #[must_use]
    pub fn new(method: RungeKutta<P, T>, checkpoints: usize) -> Self {
        let (steps, p, end) = (Vec::new(), Vec::new(), Vec::new());
        Self {
            method,
            steps,
            checkpoints: Checkpoints::new(checkpoints),
            p,
            end_time: 0.0,
            end,
            reversal: Reversal::new(),
        }
    }

    /// Integrates to `end` and records the run, unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<F: ParametricField>(
        &mut self,
        field: &F,
        p: &[T],
        state: &mut State<T>,
        end: f64,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.integrate(field, p, state, end, |_| ControlFlow::Continue(()))
    }

    /// Integrates to `end`, backwards if it is earlier than the state's time, and records the run in place of the one before. The
    /// observer sees every step and may stop the run.
    ///
    /// The record grows with the number of steps. A run that is not longer than one before allocates nothing.
    ///
    /// # Errors
    /// The parameters do not fit the field or are not finite, or as [`RungeKutta::integrate`]. The state then stands at the last
    /// accepted step, and the record ends there; the gradient of this shorter run is available. If the arguments are refused, the
    /// record of the run before stays.
    pub fn integrate<F: ParametricField>(
        &mut self,
        field: &F,
        p: &[T],
        state: &mut State<T>,
        end: f64,
        mut observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        let n = field.dimension();
        let mut at_parameters = WithParameters::new(field, p)?;
        check_run(n, state, end)?;
        let Self { method, steps, checkpoints, .. } = self;
        steps.clear();
        checkpoints.clear(n);
        self.p.clear();
        self.p.extend_from_slice(p);
        let run = method.run(&mut at_parameters, state, end, None, &mut |dense| {
            checkpoints.offer(steps.len(), dense.row(Rows::START), dense.row(Rows::START_CARRY));
            steps.push((dense.step.start, dense.step.length));
            let step = Step { number: dense.number(), time: dense.time(), values: dense.values() };
            Ok(stopped_by(observer(step)))
        });
        self.end_time = state.time;
        self.end.clear();
        self.end.extend_from_slice(&state.values);
        run
    }

    /// Writes the value of an objective at the recorded run, and its gradient, to `gradient`.
    ///
    /// It may be called again, for other objectives. States kept beside the start are then made again.
    ///
    /// # Errors
    /// The field is not of the size of the recorded one or fails; the objective or its gradient is not finite. What `gradient` held
    /// is then unchanged.
    pub fn gradient<F: ParametricField, G: Objective>(
        &mut self,
        field: &F,
        objective: &G,
        gradient: &mut ObjectiveGradient<T>,
    ) -> Result<(), IntegratorsError<F::Error>> {
        check_length("record", field.dimension(), self.end.len())?;
        check_length("parameters", field.parameters(), self.p.len())?;
        self.reversal.begin::<P, G>(objective, self.end_time, &self.end, &self.p);
        self.reversal.check(None)?;
        let mut replayed_steps = 0;
        let mut end = self.steps.len();
        while 0 < end {
            self.checkpoints.forget_from(end);
            let Some(start) = self.checkpoints.read_last(&mut self.reversal.y, &mut self.reversal.y_carry) else {
                break;
            };
            let length = end - start;
            let keep = 1 < length && !self.checkpoints.is_full();
            let target = if keep { start + self.checkpoints.next_distance(length) } else { end - 1 };
            for number in start..target {
                let times = self.times(number);
                self.reversal.replay::<P, F>(field, &self.p, times)?;
                replayed_steps += 1;
            }
            if keep {
                self.checkpoints.push(target, &self.reversal.y, &self.reversal.y_carry);
            } else {
                let times = self.times(target);
                self.reversal.step::<P, F, G>(field, objective, &self.p, times)?;
                end = target;
            }
        }
        gradient.value = self.reversal.value;
        gradient.by_start.clone_from(&self.reversal.lambda);
        gradient.by_parameters.clone_from(&self.reversal.mu);
        gradient.replayed_steps = replayed_steps;
        Ok(())
    }

    /// The number of recorded steps.
    #[must_use]
    pub const fn steps(&self) -> usize {
        self.steps.len()
    }

    /// The number of states kept at present, the start among them.
    #[must_use]
    pub const fn kept_states(&self) -> usize {
        self.checkpoints.count()
    }

    fn times(&self, number: usize) -> StepTimes {
        let (start, length) = self.steps[number];
        let first = number.checked_sub(1).map_or(start, |before| self.steps[before].0 + self.steps[before].1);
        StepTimes { first, start, length }
    }
}
