//! Derivatives of the state by differentiable numbers along the accepted steps.

use core::ops::ControlFlow;

use piola_numerics::{Gradient, Real};

use super::stages::{Stages, StepTimes};
use super::{DIRECTIONS, Directional, ParametricField, Sensitivities, SensitivityInputs, WithParameters};
use crate::events::stopped_by;
use crate::explicit::{Rows, RungeKutta, RungeKuttaPair};
use crate::state::{check_run, compensated_add};
use crate::{IntegratorsError, Report, State, Step};

/// Derivatives of the state by the start of the run and by parameters: the variational equations.
///
/// ```text
/// d/dt ∂y/∂y₀ = (∂f/∂y) ∂y/∂y₀        d/dt ∂y/∂p = (∂f/∂y) ∂y/∂p + ∂f/∂p
/// ```
///
/// [`DormandPrince853`](crate::DormandPrince853) or [`Verner98`](crate::Verner98) makes the run as if it were alone: the same steps and
/// the same bits of the state. Each accepted step is then made again over numbers with four derivatives, once for every four
/// directions. The derivatives are those of the run that was made, with the lengths of its steps held fixed.
///
/// The scalar may itself carry derivatives: over [`Dual`](piola_numerics::Dual) second derivatives come along.
///
/// # Accuracy
/// The error of the derivatives is of the order of the method. The tolerance bounds the error of the state alone: a state at rest is
/// followed in long steps, whatever its derivatives do. Bound the steps there by
/// [`with_longest_step`](RungeKutta::with_longest_step).
///
/// # References
/// Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, I.14.
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
/// // x = cos pt from rest: ∂x/∂p = −t sin pt, and ∂x/∂v₀ = sin(pt)/p.
/// let mut state = State::new(0.0, vec![1.0, 0.0])?;
/// let mut sensitivities = Sensitivities::at_start(2, 1, SensitivityInputs::StartAndParameters);
/// let mut method = ForwardSensitivity::new(DormandPrince853::new(Tolerance::relative(1e-13)?));
/// method.integrate_to(&Oscillator, &[2.0], &mut state, &mut sensitivities, 5.0)?;
/// assert!((sensitivities.by_parameters()[0] + 5.0 * 10.0_f64.sin()).abs() < 1e-11);
/// assert!((sensitivities.by_start()[1] - 0.5 * 10.0_f64.sin()).abs() < 1e-12);
/// # Ok::<(), IntegratorsError>(())
/// ```
#[doc(alias("sensitivity analysis", "variational equations", "tangent linear"))]
#[derive(Clone, Debug)]
pub struct ForwardSensitivity<P, T = f64> {
    method: RungeKutta<P, T>,
    work: Work<T>,
    next: Sensitivities<T>,
}

#[derive(Clone, Debug)]
struct Work<T> {
    stages: Stages<Directional<T>>,
    p: Vec<Directional<T>>,
    y: Vec<Directional<T>>,
    y_carry: Vec<Directional<T>>,
    /// The start of the step, and what rounding left of it.
    start: Vec<T>,
    start_carry: Vec<T>,
}

impl<P: RungeKuttaPair, T: Real> ForwardSensitivity<P, T> {
    /// Of the runs that a method makes.
    #[must_use]
    pub fn new(method: RungeKutta<P, T>) -> Self {
        let [p, y, y_carry] = [const { Vec::new() }; 3];
        let [start, start_carry] = [const { Vec::new() }; 2];
        let work = Work { stages: Stages::new(), p, y, y_carry, start, start_carry };
        Self { method, work, next: Sensitivities::at_start(0, 0, SensitivityInputs::Start) }
    }

    /// Integrates to `end`, unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<F: ParametricField>(
        &mut self,
        field: &F,
        p: &[T],
        state: &mut State<T>,
        sensitivities: &mut Sensitivities<T>,
        end: f64,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.integrate(field, p, state, sensitivities, end, |_, _| ControlFlow::Continue(()))
    }

    /// Integrates to `end`, backwards if it is earlier than the state's time. The observer sees every step with its derivatives,
    /// and may stop the run. A later run may go on from where this one ended.
    ///
    /// The report counts evaluations over T. Those with derivatives are 12 (Dormand–Prince) or 16 (Verner) for each accepted step
    /// and every four directions.
    ///
    /// # Errors
    /// The parameters, the state or the derivatives do not fit the field; a parameter or the state is not finite; a derivative
    /// becomes infinite or NaN; or as [`RungeKutta::integrate`]. State and derivatives then stand at the last step for which both
    /// are known.
    pub fn integrate<F: ParametricField>(
        &mut self,
        field: &F,
        p: &[T],
        state: &mut State<T>,
        sensitivities: &mut Sensitivities<T>,
        end: f64,
        mut observer: impl FnMut(Step<'_, T>, &Sensitivities<T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        let n = field.dimension();
        let mut at_parameters = WithParameters::new(field, p)?;
        check_run(n, state, end)?;
        sensitivities.check(n, p.len())?;
        let Self { method, work, next } = self;
        work.resize::<P>(n, p.len());
        next.resize_as(sensitivities);

        let mut first = state.time;
        let mut clock = (state.time, state.time_carry);
        let mut incomplete = false;
        let run = method.run(&mut at_parameters, state, end, None, &mut |dense| {
            let times = StepTimes { first, start: dense.step.start, length: dense.step.length };
            work.start.copy_from_slice(dense.row(Rows::START));
            work.start_carry.copy_from_slice(dense.row(Rows::START_CARRY));
            incomplete = true;
            work.step::<P, F>(field, p, times, sensitivities, next)?;
            incomplete = false;
            core::mem::swap(sensitivities, next);
            first = times.end();
            compensated_add(&mut clock.0, &mut clock.1, times.length);
            let step = Step { number: dense.number(), time: dense.time(), values: dense.values() };
            Ok(stopped_by(observer(step, sensitivities)))
        });
        if incomplete {
            // The state has gone one step too far.
            state.values.copy_from_slice(&work.start);
            state.carry.copy_from_slice(&work.start_carry);
            (state.time, state.time_carry) = clock;
        }
        run
    }
}

impl<T: Real> Work<T> {
    fn resize<P: RungeKuttaPair>(&mut self, n: usize, m: usize) {
        let zero = Gradient::constant(T::zero());
        self.stages.resize::<P>(n);
        self.p.resize(m, zero);
        self.y.resize(n, zero);
        self.y_carry.resize(n, zero);
        self.start.resize(n, T::zero());
        self.start_carry.resize(n, T::zero());
    }

    /// Writes the derivatives at the end of a step to `next`.
    fn step<P: RungeKuttaPair, F: ParametricField>(
        &mut self,
        field: &F,
        p: &[T],
        times: StepTimes,
        now: &Sensitivities<T>,
        next: &mut Sensitivities<T>,
    ) -> Result<(), IntegratorsError<F::Error>> {
        for first in (0..now.directions()).step_by(DIRECTIONS) {
            for (y, &value) in self.y.iter_mut().zip(&self.start).chain(self.y_carry.iter_mut().zip(&self.start_carry))
            {
                y.value = value;
            }
            now.read(first, &mut self.y, &mut self.y_carry);
            now.seed_parameters(first, p, &mut self.p);
            self.stages.evaluate::<P, F>(field, &self.p, times, (&self.y, &self.y_carry))?;
            self.stages.advance::<P>(times.length, &mut self.y, &mut self.y_carry);
            next.write(first, &self.y, &self.y_carry);
        }
        next.check_finite(times.start)
    }
}
