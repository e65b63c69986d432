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

mod coefficients;
mod dense;
mod events;

use core::ops::ControlFlow;

use piola_numerics::Real;

pub use dense::DenseStep;
pub use events::{Crossing, Event, EventAction, Occurrence};

use self::coefficients as c;
use crate::field::largest_lane;
use crate::state::{check_finite, check_run, compensated_add};
use crate::{Ending, Field, IntegrationError, Report, State, Tolerance};

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
/// # Ok::<(), piola_integrators::IntegrationError>(())
/// ```
#[derive(Clone, Debug)]
pub struct DormandPrince853<T = f64> {
    tolerance: Tolerance,
    first_step: Option<f64>,
    longest_step: f64,
    most_steps: u64,
    /// k₁ … k₁₆; stage 12 is the rate at the end of the step.
    stages: [Vec<T>; 16],
    /// The stage's argument, then the step's end.
    trial: Vec<T>,
    trial_carry: Vec<T>,
    start: Vec<T>,
    start_carry: Vec<T>,
    magnitudes: Vec<f64>,
    magnitudes_at_end: Vec<f64>,
    /// The coefficients of the interpolating polynomial; see `dense`.
    interpolant: [Vec<T>; 7],
}

impl<T: Real> DormandPrince853<T> {
    /// A method with the given tolerance.
    #[must_use]
    pub fn new(tolerance: Tolerance) -> Self {
        Self {
            tolerance,
            first_step: None,
            longest_step: f64::INFINITY,
            most_steps: u64::MAX,
            stages: core::array::from_fn(|_| Vec::new()),
            trial: Vec::new(),
            trial_carry: Vec::new(),
            start: Vec::new(),
            start_carry: Vec::new(),
            magnitudes: Vec::new(),
            magnitudes_at_end: Vec::new(),
            interpolant: core::array::from_fn(|_| Vec::new()),
        }
    }

    /// Sets the first step tried, s; by default it is estimated.
    ///
    /// # Errors
    /// [`IntegrationError::InvalidStep`] unless 0 < step < ∞.
    pub fn with_first_step(mut self, step: f64) -> Result<Self, IntegrationError> {
        crate::state::check_step(step)?;
        self.first_step = Some(step);
        Ok(self)
    }

    /// Bounds every step, s; by default steps are not bounded.
    ///
    /// # Errors
    /// [`IntegrationError::InvalidStep`] unless 0 < step.
    pub fn with_longest_step(mut self, step: f64) -> Result<Self, IntegrationError> {
        if !(0.0 < step) {
            return Err(IntegrationError::InvalidStep { step });
        }
        self.longest_step = step;
        Ok(self)
    }

    /// Bounds the number of steps of one run; by default it is not bounded.
    #[must_use]
    pub const fn with_most_steps(mut self, steps: u64) -> Self {
        self.most_steps = steps;
        self
    }

    /// The tolerance.
    #[must_use]
    pub const fn tolerance(&self) -> Tolerance {
        self.tolerance
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
    ) -> Result<Report, IntegrationError<F::Error>> {
        self.integrate(field, state, end, |_| ControlFlow::Continue(()))
    }

    /// Integrates to `end`, backwards if it is earlier than the state's time. The observer sees every step,
    /// may ask for the state at any time within it, and may stop the run.
    ///
    /// # Errors
    /// The state does not fit, the field fails or its rate stays not finite however small the step, the step
    /// no longer advances the time, or the limit on steps is reached. The state then stands at the last
    /// accepted step.
    pub fn integrate<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        mut observer: impl FnMut(&mut DenseStep<'_, T, F>) -> ControlFlow<()>,
    ) -> Result<Report, IntegrationError<F::Error>> {
        self.run(field, state, end, &mut |step, _| {
            if observer(step).is_break() {
                ControlFlow::Break((None, Ending::Stopped))
            } else {
                ControlFlow::Continue(())
            }
        })
    }

    fn prepare(&mut self, n: usize) {
        for buffer in self.stages.iter_mut().chain(&mut self.interpolant) {
            buffer.resize(n, T::zero());
        }
        for buffer in [&mut self.trial, &mut self.trial_carry, &mut self.start, &mut self.start_carry] {
            buffer.resize(n, T::zero());
        }
        self.magnitudes.resize(n, 0.0);
        self.magnitudes_at_end.resize(n, 0.0);
    }

    /// The loop of all runs. `inspect` sees each accepted step; to end the run it gives the time of the end
    /// (the step's own end when `None`) and how the run ended.
    fn run<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        inspect: &mut impl FnMut(&mut DenseStep<'_, T, F>, &mut Report) -> ControlFlow<(Option<f64>, Ending)>,
    ) -> Result<Report, IntegrationError<F::Error>> {
        check_run(field.dimension(), state, end)?;
        self.prepare(state.values.len());
        let mut report = Report::begin();
        let span = end - state.time;
        if span.abs() <= 0.0 {
            return Ok(report);
        }
        let direction = span.signum();

        evaluate(field, state.time, &state.values, &mut self.stages[0])?;
        report.evaluations += 1;
        check_finite(state.time, &self.stages[0])?;
        let mut step = match self.first_step {
            Some(step) => step * direction,
            None => self.estimate_first_step(field, state, span, &mut report)?,
        };
        let mut just_rejected = false;
        loop {
            if self.most_steps <= report.steps {
                return Err(IntegrationError::TooManySteps { time: state.time, steps: report.steps });
            }
            let remaining = (end - state.time) - state.time_carry;
            step = direction * step.abs().min(self.longest_step);
            let last = remaining.abs() <= 1.01 * step.abs();
            let h = if last { remaining } else { step };
            if h.abs() <= 2.0 * f64::EPSILON * state.time.abs() && !last || !(0.0 < h.abs()) {
                return Err(IntegrationError::StepTooSmall { time: state.time, step: h });
            }

            let error = self.try_step(field, state, h, &mut report)?;
            // The new step: h · 0.9 / error^(1/8), changed by a factor between 1/3 and 6.
            let factor = (0.9 * error.powf(-0.125)).clamp(1.0 / 3.0, 6.0);
            if !(error <= 1.0) {
                // NaN comes here too: the trial left the field's domain.
                report.rejected += 1;
                step = h * if error.is_finite() { factor.min(1.0) } else { 0.1 };
                just_rejected = true;
                continue;
            }
            let factor = if just_rejected { factor.min(1.0) } else { factor };
            just_rejected = false;

            self.start.copy_from_slice(&state.values);
            self.start_carry.copy_from_slice(&state.carry);
            let (start_time, start_time_carry) = (state.time, state.time_carry);
            state.values.copy_from_slice(&self.trial);
            state.carry.copy_from_slice(&self.trial_carry);
            if last {
                state.set_time(end);
            } else {
                state.advance_time(h);
            }
            report.steps += 1;

            let verdict = {
                let mut dense = DenseStep::new(self, field, report.steps, start_time, state.time, h);
                let verdict = inspect(&mut dense, &mut report);
                report.evaluations += dense.evaluations();
                match verdict {
                    ControlFlow::Continue(()) => None,
                    ControlFlow::Break((time, ending)) => {
                        let mut evaluations = 0;
                        if let Some(time) = time {
                            let before = dense.evaluations();
                            dense.at(time, &mut state.values)?;
                            evaluations = dense.evaluations() - before;
                        }
                        Some((time, ending, evaluations))
                    }
                }
            };
            if let Some((time, ending, evaluations)) = verdict {
                report.evaluations += evaluations;
                report.ending = ending;
                if let Some(time) = time {
                    state.carry.fill(T::zero());
                    state.set_time(time);
                }
                return Ok(report);
            }
            let _ = start_time_carry;
            if last {
                return Ok(report);
            }
            // The rate at the end is the first stage of the next step.
            let (first, rest) = self.stages.split_at_mut(1);
            core::mem::swap(&mut first[0], &mut rest[11]);
            step = h * factor;
        }
    }

    /// Makes the stages of one step and its end in `trial`; returns the error over the tolerance.
    fn try_step<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &State<T>,
        h: f64,
        report: &mut Report,
    ) -> Result<f64, IntegrationError<F::Error>> {
        let t = state.time;
        let y = (&state.values[..], &state.carry[..]);
        let k = &mut self.stages;
        let trial = &mut self.trial;
        macro_rules! stage {
            ($number:literal, $row:expr) => {
                combine(&$row, k, y, h, trial);
                evaluate(field, t + c::C[$number] * h, trial, &mut k[$number])?;
            };
        }
        stage!(1, c::A2);
        stage!(2, c::A3);
        stage!(3, c::A4);
        stage!(4, c::A5);
        stage!(5, c::A6);
        stage!(6, c::A7);
        stage!(7, c::A8);
        stage!(8, c::A9);
        stage!(9, c::A10);
        stage!(10, c::A11);
        stage!(11, c::A12);
        for i in 0..trial.len() {
            let mut increment = T::zero();
            for &(j, b) in &c::B {
                increment += T::lit(b) * k[j][i];
            }
            let (mut value, mut carry) = (state.values[i], state.carry[i]);
            compensated_add(&mut value, &mut carry, increment * T::lit(h));
            trial[i] = value;
            self.trial_carry[i] = carry;
        }
        report.evaluations += 11;
        let error = self.error(field, state, h);
        if error <= 1.0 {
            evaluate(field, t + h, &self.trial, &mut self.stages[12])?;
            report.evaluations += 1;
            if check_finite::<T, F::Error>(t, &self.stages[12]).is_err() {
                return Ok(f64::NAN);
            }
        }
        Ok(error)
    }

    /// The error of the step over the tolerance: fifth-order estimate, damped by the third-order one.
    fn error<F: Field<T>>(&mut self, field: &F, state: &State<T>, h: f64) -> f64 {
        field.magnitudes(&state.values, &mut self.magnitudes);
        field.magnitudes(&self.trial, &mut self.magnitudes_at_end);
        let (mut fifth, mut third) = (0.0, 0.0);
        for i in 0..self.trial.len() {
            let (mut e5, mut e3) = (T::zero(), T::zero());
            for &(j, e) in &c::E5 {
                e5 += T::lit(e) * self.stages[j][i];
            }
            for &(j, e) in &c::E3 {
                e3 += T::lit(e) * self.stages[j][i];
            }
            let (e5, e3) = (largest_lane(e5), largest_lane(e3));
            let magnitude = self.magnitudes[i].max(self.magnitudes_at_end[i]);
            let allowed = self.tolerance.absolute_part() + self.tolerance.relative_part() * magnitude;
            if e5.abs() <= 0.0 && e3.abs() <= 0.0 {
                continue; // exact, whatever the tolerance: also where the magnitude is zero
            }
            fifth += (e5 / allowed) * (e5 / allowed);
            third += (e3 / allowed) * (e3 / allowed);
        }
        let denominator = fifth + 0.01 * third;
        if denominator <= 0.0 {
            return 0.0;
        }
        h.abs() * fifth / (denominator * self.trial.len() as f64).sqrt()
    }

    /// A first step for which an explicit Euler step would change the state by one hundredth and the rate is
    /// known to vary slowly; a start from rest falls back on the acceleration.
    fn estimate_first_step<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &State<T>,
        span: f64,
        report: &mut Report,
    ) -> Result<f64, IntegrationError<F::Error>> {
        field.magnitudes(&state.values, &mut self.magnitudes);
        let tolerance = self.tolerance;
        let scaled = |x: &[T], magnitudes: &[f64]| {
            let mut sum = 0.0;
            for (&x, &magnitude) in x.iter().zip(magnitudes) {
                let allowed = tolerance.absolute_part() + tolerance.relative_part() * magnitude;
                let ratio = largest_lane(x) / allowed;
                if ratio.is_finite() {
                    sum += ratio * ratio;
                }
            }
            (sum / x.len().max(1) as f64).sqrt()
        };
        let (size, rate) = (scaled(&state.values, &self.magnitudes), scaled(&self.stages[0], &self.magnitudes));
        let span = span.abs().min(self.longest_step) * span.signum();
        let euler = if size <= 1e-5 || rate <= 1e-5 { span.abs() * 1e-6 } else { 0.01 * size / rate };
        let euler = euler.min(span.abs()) * span.signum();
        for ((trial, &y), &rate) in self.trial.iter_mut().zip(&state.values).zip(&self.stages[0]) {
            *trial = y + T::lit(euler) * rate;
        }
        evaluate(field, state.time + euler, &self.trial, &mut self.stages[1])?;
        report.evaluations += 1;
        for (change, &first) in self.trial.iter_mut().zip(&self.stages[0]) {
            *change = -first;
        }
        for (change, &second) in self.trial.iter_mut().zip(&self.stages[1]) {
            *change += second;
        }
        let curvature = scaled(&self.trial, &self.magnitudes) / euler.abs();
        let largest = curvature.max(rate);
        let step = if largest <= 1e-15 || !largest.is_finite() {
            (euler.abs() * 1e-3).max(span.abs() * 1e-6)
        } else {
            (0.01 / largest).powf(0.125)
        };
        Ok(step.min(100.0 * euler.abs()).min(span.abs()) * span.signum())
    }
}

fn evaluate<T: Real, F: Field<T>>(
    field: &mut F,
    time: f64,
    y: &[T],
    rate: &mut [T],
) -> Result<(), IntegrationError<F::Error>> {
    field.rate(time, y, rate).map_err(|source| IntegrationError::Field { time, source })
}

/// y + (carry + h Σ aⱼ kⱼ), written for rows whose length the compiler knows.
#[inline(always)]
fn combine<T: Real, const M: usize>(
    row: &[(usize, f64); M],
    stages: &[Vec<T>; 16],
    (y, carry): (&[T], &[T]),
    h: f64,
    out: &mut [T],
) {
    let n = out.len();
    let terms: [(T, &[T]); M] = core::array::from_fn(|m| (T::lit(row[m].1), &stages[row[m].0][..n]));
    let (y, carry) = (&y[..n], &carry[..n]);
    let h = T::lit(h);
    for i in 0..n {
        let mut sum = terms[0].0 * terms[0].1[i];
        for term in &terms[1..] {
            sum += term.0 * term.1[i];
        }
        out[i] = y[i] + (carry[i] + h * sum);
    }
}
