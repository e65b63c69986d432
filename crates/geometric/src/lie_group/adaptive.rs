//! The Munthe-Kaas method of order 8(5,3) with steps that adapt.

use core::ops::ControlFlow;

use piola_integrators::internal::{
    EmbeddedPair, Limits, RungeKuttaCoefficients, check_finite, dormand_prince as pair, follow, largest_lane,
};
use piola_integrators::{
    Checkpoint, DormandPrincePair, Ending, IntegratorsError, Report, State, Step, Tolerance, limits_of_steps,
    resumed_run, unobserved,
};
use piola_numerics::Real;

use super::munthe_kaas::{combine, make_stages};
use super::run::{Trial, check_start, evaluate};
use super::tableaux::DORMAND_PRINCE_8;
use super::{GroupField, LieGroup};

/// The name in a checkpoint.
const NAME: &str = "AdaptiveMuntheKaas";
const STAGES: usize = 12;

/// The Runge–Kutta–Munthe-Kaas method of order 8(5,3), on Dormand and Prince's pair, with steps that adapt to a tolerance.
///
/// The error is that of the displacement of a step, in the algebra. For each component it may be
/// `absolute + relative · magnitude`, where the magnitude of an angle is one radian and that of a vector its largest component
/// ([`LieGroup::magnitudes`](crate::LieGroup::magnitudes)).
///
/// # Accuracy
/// The local error of each step is below the tolerance; the global error is proportional to it, by a factor that the problem's
/// sensitivity sets. The element is multiplied with compensation.
///
/// # Example
/// ```
/// use piola_geometric::{AdaptiveMuntheKaas, Rotations, group_field};
/// use piola_integrators::{State, Tolerance};
/// // About z at 2t rad/s: the angle is t².
/// let mut turning = group_field(Rotations, |t, _q: &[f64], omega: &mut [f64]| omega.copy_from_slice(&[0.0, 0.0, 2.0 * t]));
/// let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0])?;
/// let report = AdaptiveMuntheKaas::new(Tolerance::relative(1e-12)?).integrate_to(&mut turning, &mut state, 3.0)?;
/// assert!((state.values[3] - 4.5_f64.sin()).abs() < 1e-12); // sin of half the angle
/// assert!(report.steps < 30);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("RKMK", "Dormand-Prince", "Lie group integrator"))]
#[derive(Clone, Debug)]
pub struct AdaptiveMuntheKaas<T = f64> {
    tolerance: Tolerance,
    limits: Limits,
    stages: [Vec<T>; STAGES],
    /// ξ at the end of the step, the first stage of the next.
    velocity_at_end: Vec<T>,
    displacement: Vec<T>,
    /// The two estimates of the error.
    fifth: Vec<T>,
    third: Vec<T>,
    magnitudes: Vec<f64>,
    magnitudes_at_end: Vec<f64>,
    /// The length of the next step to try.
    next: f64,
    trial: Trial<T>,
}

impl<T: Real> AdaptiveMuntheKaas<T> {
    /// The method with the given tolerance, raised above rounding.
    #[must_use]
    pub fn new(tolerance: Tolerance) -> Self {
        Self {
            tolerance: tolerance.above_rounding::<T>(),
            limits: Limits::none(),
            stages: core::array::from_fn(|_| Vec::new()),
            velocity_at_end: Vec::new(),
            displacement: Vec::new(),
            fifth: Vec::new(),
            third: Vec::new(),
            magnitudes: Vec::new(),
            magnitudes_at_end: Vec::new(),
            next: 0.0,
            trial: Trial::new(),
        }
    }

    limits_of_steps!();

    /// Integrates to `end`, unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<F: GroupField<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.integrate(field, state, end, unobserved)
    }

    /// Integrates to `end`, backwards if it is earlier than the state's time. The observer sees every step and may stop the run.
    ///
    /// # Errors
    /// The state does not fit, is not finite or is no element of the group; the field fails or its velocity is not finite at
    /// the start or, however small the step, beyond a time; the step no longer advances the time; or the limit on steps is
    /// reached. The state then stands at the last accepted step.
    pub fn integrate<F: GroupField<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.run(field, None, state, end, observer)
    }

    /// The run where it stands, to be continued by [`resume`](Self::resume): the state and the report of a run of this method that
    /// has ended or that the observer has stopped. After a run without a step the checkpoint has no next step, and
    /// [`resume`](Self::resume) refuses it ([`IntegratorsError::NotPositive`]).
    ///
    /// # Example
    /// ```
    /// use core::ops::ControlFlow;
    /// use piola_geometric::{AdaptiveMuntheKaas, Rotations, group_field};
    /// use piola_integrators::{State, Tolerance};
    /// let mut turning = group_field(Rotations, |t, _q: &[f64], omega: &mut [f64]| omega.copy_from_slice(&[0.0, t, 2.0 * t]));
    /// let start = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0])?;
    /// let mut method = AdaptiveMuntheKaas::new(Tolerance::relative(1e-9)?);
    /// let (mut whole, mut state) = (start.clone(), start);
    /// let report = method.integrate_to(&mut turning, &mut whole, 3.0)?;
    /// // Stopped after two steps; with the feature `serde`, the checkpoint can be written to a file.
    /// let stopped = method.integrate(&mut turning, &mut state, 3.0, |step| {
    ///     if step.number == 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    /// })?;
    /// let checkpoint = method.checkpoint(&state, stopped);
    /// let continued = method.resume(&mut turning, &checkpoint, &mut state, 3.0, |_step| ControlFlow::Continue(()))?;
    /// assert_eq!((state, continued), (whole, report));
    /// # Ok::<(), piola_integrators::IntegratorsError>(())
    /// ```
    #[must_use]
    pub fn checkpoint(&self, state: &State<T>, report: Report) -> Checkpoint<T> {
        let numbers = core::iter::once(&self.next).chain(&self.magnitudes_at_end).copied().collect();
        Checkpoint::of(NAME, state.clone(), report, self.velocity_at_end.clone(), numbers)
    }

    resumed_run!(<F> [F: GroupField<T>] field: &mut F, IntegratorsError<F::Error>);

    fn run<F: GroupField<T>>(
        &mut self,
        field: &mut F,
        resumed: Option<&Checkpoint<T>>,
        state: &mut State<T>,
        end: f64,
        mut observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        follow(self, field, state, end, resumed, &mut |method, _field, state, step, _report| {
            method.next = step.next();
            let seen = observer(Step { number: step.number, time: state.time, values: &state.values });
            Ok(if seen.is_break() { ControlFlow::Break(Ending::Stopped) } else { ControlFlow::Continue(()) })
        })
    }

    fn prepare(&mut self, group: &impl LieGroup<T>, state: &State<T>) {
        let n = group.dimension();
        let vectors = [&mut self.velocity_at_end, &mut self.displacement, &mut self.fifth, &mut self.third];
        for vector in self.stages.iter_mut().chain(vectors) {
            vector.resize(n, T::zero());
        }
        self.magnitudes.resize(n, 0.0);
        self.magnitudes_at_end.resize(n, 0.0);
        self.trial.resize(state.values.len());
    }

    /// The error that a component of the given magnitude may have.
    fn allowed(&self, magnitude: f64) -> f64 {
        self.tolerance.absolute_part() + self.tolerance.relative_part() * magnitude
    }

    /// The length of a first step whose error should be within the tolerance.
    ///
    /// ```text
    /// h = (0.01/‖m‖)^(1/8) / λ,    λ² = ‖ξ̇‖/‖m‖,    m the magnitudes
    /// ```
    fn estimate_first_step<F: GroupField<T>>(
        &mut self,
        field: &mut F,
        state: &State<T>,
        span: f64,
        report: &mut Report,
    ) -> f64 {
        let longest = span.abs().min(self.limits.longest_step);
        let shortest = 1e-6 * longest;
        let resolved = 1e3 * f64::EPSILON * state.time.abs();
        let (size, rate) = self.norms(&self.stages[0]);
        let euler =
            if 0.0 < rate && 0.0 < size { (0.01 * size / rate).clamp(1e-3 * shortest, longest) } else { shortest };
        let step = euler.copysign(span);
        for (displacement, &velocity) in self.displacement.iter_mut().zip(&self.stages[0]) {
            *displacement = T::lit(step) * velocity;
        }
        self.trial.begin(state);
        self.trial.advance(field.group(), &self.displacement);
        report.evaluations += 1;
        if evaluate(field, state.time, state.time + step, &self.trial.element, &mut self.stages[1]).is_err() {
            return shortest.max(resolved).min(longest);
        }
        for (difference, (&before, &after)) in self.fifth.iter_mut().zip(self.stages[0].iter().zip(&self.stages[1])) {
            *difference = after - before;
        }
        let acceleration = self.norms(&self.fifth).1 / euler;
        let step = (0.01 / size).sqrt().sqrt().sqrt() / (acceleration / size).sqrt();
        let step = if 0.0 < step && step.is_finite() { step.min(0.1 * longest) } else { shortest };
        step.max(resolved).min(longest)
    }

    /// The magnitudes and a velocity, each in the norm of the tolerance. Components of magnitude zero have no say.
    fn norms(&self, velocity: &[T]) -> (f64, f64) {
        let (mut size, mut rate) = (0.0, 0.0);
        for (&magnitude, &velocity) in self.magnitudes.iter().zip(velocity) {
            let allowed = self.allowed(magnitude);
            if 0.0 < allowed {
                size += (magnitude / allowed) * (magnitude / allowed);
                rate += (largest_lane(velocity) / allowed) * (largest_lane(velocity) / allowed);
            }
        }
        let n = velocity.len().max(1) as f64;
        ((size / n).sqrt(), (rate / n).sqrt())
    }
}

impl<T: Real, F: GroupField<T>> EmbeddedPair<T, F> for AdaptiveMuntheKaas<T> {
    type Error = F::Error;

    fn limits(&self) -> Limits {
        self.limits
    }

    fn begin(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        resumed: Option<&Checkpoint<T>>,
        report: &mut Report,
    ) -> Result<f64, IntegratorsError<F::Error>> {
        let n = field.group().dimension();
        match resumed {
            None => check_start(field.group(), 0, state, end)?,
            Some(checkpoint) => {
                let check = |state: &mut State<T>| check_start(field.group(), 0, state, end);
                checkpoint.open(NAME, [n, n + 1], &[0], state, check)?;
            }
        }
        self.prepare(field.group(), state);
        let span = end - state.time;
        if span.abs() <= 0.0 {
            return Ok(0.0);
        }
        if let Some(checkpoint) = resumed {
            let (velocity, numbers) = checkpoint.memory();
            self.stages[0].copy_from_slice(velocity);
            self.magnitudes.copy_from_slice(&numbers[1..]);
            return Ok(numbers[0]);
        }
        evaluate(field, state.time, state.time, &state.values, &mut self.stages[0])?;
        report.evaluations += 1;
        field.group().magnitudes(&state.values, &mut self.magnitudes);
        match self.limits.first_step {
            Some(step) => Ok(step),
            None => Ok(self.estimate_first_step(field, state, span, report)),
        }
    }

    fn attempt(
        &mut self,
        field: &mut F,
        state: &State<T>,
        h: f64,
        report: &mut Report,
    ) -> Result<f64, IntegratorsError<F::Error>> {
        let Self { stages, displacement, trial, fifth, third, .. } = self;
        report.evaluations += STAGES as u64 - 1;
        make_stages(&DORMAND_PRINCE_8, field, state, h, (stages, displacement, trial))?;
        check_finite("state", Some(state.time), &trial.element)?;
        combine(&pair::E5, stages, 1.0, fifth);
        combine(&pair::B3, stages, 1.0, third);
        combine(&pair::B, stages, 1.0, displacement);
        field.group().magnitudes(&trial.element, &mut self.magnitudes_at_end);
        let (mut fifth, mut third) = (0.0, 0.0);
        for (i, &slope) in self.displacement.iter().enumerate() {
            let (e5, e3) = (largest_lane(self.fifth[i]), largest_lane(slope - self.third[i]));
            let allowed = self.allowed(self.magnitudes[i].max(self.magnitudes_at_end[i]));
            // An exact component is exact whatever the tolerance: also where its magnitude is zero.
            let allowed = if e5 <= 0.0 && e3 <= 0.0 { 1.0 } else { allowed };
            fifth += (e5 / allowed) * (e5 / allowed);
            third += (e3 / allowed) * (e3 / allowed);
        }
        let error = DormandPrincePair::error(h, self.displacement.len(), fifth, third);
        if error <= 1.0 {
            self.trial.renormalise(field.group());
            report.evaluations += 1;
            evaluate(field, state.time, state.time + h, &self.trial.element, &mut self.velocity_at_end)?;
        }
        Ok(error)
    }

    fn root(error: f64) -> f64 {
        DormandPrincePair::root(error)
    }

    fn accept(&mut self, state: &mut State<T>) {
        self.trial.swap(state);
    }

    fn advance(
        &mut self,
        _field: &mut F,
        _state: &State<T>,
        _report: &mut Report,
    ) -> Result<(), IntegratorsError<F::Error>> {
        core::mem::swap(&mut self.stages[0], &mut self.velocity_at_end);
        core::mem::swap(&mut self.magnitudes, &mut self.magnitudes_at_end);
        Ok(())
    }
}
