//! The loop over the steps of a collocation method of degree seven for q̈ = f(t, q, q̇), whose stages are found by sweeps.
//!
//! With r the last coefficient of the polynomial of the accelerations over their mean, and r₀ what it should be,
//!
//! ```text
//! h ← h (r₀/r)^(1/7)
//! ```
//!
//! A step that should have been much shorter, or whose sweeps do not converge, is made again. Sweeps that contract slowly are
//! a reason for a shorter step, too.

use core::ops::ControlFlow;

use piola_numerics::Real;

use crate::accepted::AcceptedStep;
use crate::checkpoint::{Checkpoint, RunSoFar};
use crate::events::Stop;
use crate::field::largest_lane;
use crate::state::equal_steps;
use crate::{IntegratorsError, Report, State};

/// The factor of contraction of a sweep at which a digit costs least: e⁻² where accelerations depend on positions, and
/// more where they depend on velocities.
const BEST_CONTRACTION: f64 = 0.3;
/// Sweeps that are no reason to shorten a step.
const FEW_SWEEPS: u64 = 5;
/// The part of a step that is tried after one whose stages did not converge, or where the field is not defined.
const UNCONVERGED: f64 = 0.3;
/// The part of the span within which a refusal of the field explains that steps shrink.
const HERE: f64 = 1e-6;
/// Steps grow at most by this factor.
const MOST_GROWTH: f64 = 4.0;
/// The part of the best step that is tried, so that few are rejected.
const SAFETY: f64 = 0.95;
/// The trend of the best step, from one step to the next, that is believed.
const TREND: (f64, f64) = (0.5, 1.0);
/// Steps whose last coefficient exceeds the aim by this factor after the first sweeps are not swept further: 0.65⁻⁷.
const HOPELESS: f64 = 20.0;
/// Growth after which a first step is made again rather than kept.
const TIMID: f64 = 3.0;
/// Attempts at the first step.
const MOST_ATTEMPTS: u32 = 4;
/// What rounding makes varies from step to step: a last coefficient of so many times that is aimed at.
const ABOVE_NOISE: f64 = 8.0;
/// The largest last coefficient that is put down to rounding.
const MOST_NOISE: f64 = 1e-2;

/// How steps are chosen.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Control {
    /// Steps that adapt to a number whose meaning the method knows.
    Adaptive(f64),
    /// Equal steps no longer than this.
    Fixed(f64),
}

/// What a run asks of its steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan {
    /// The longest of equal steps; none for steps that adapt.
    pub(crate) equal: Option<f64>,
    /// The first of steps that adapt, s; none where it is to be estimated.
    pub(crate) first_step: Option<f64>,
    pub(crate) longest_step: f64,
    pub(crate) most_steps: u64,
    /// r₀.
    pub(crate) aim: f64,
    /// The part of the accelerations that the sweeps may leave is a part of this.
    pub(crate) tolerance: f64,
    /// Steps whose error asks for less than this part of them are made again.
    pub(crate) rejected: f64,
}

/// What an attempt at a step found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attempt {
    /// Whether the stages stand still.
    pub(crate) converged: bool,
    /// r: the last coefficient of the accelerations over their mean.
    pub(crate) ratio: f64,
    /// The factor by which a sweep shortens the change.
    pub(crate) contraction: f64,
    /// Sweeps made.
    pub(crate) sweeps: u64,
    /// The last change, relative to the accelerations.
    pub(crate) change: f64,
    /// Whether it was given up because its error would be too large.
    pub(crate) hopeless: bool,
}

impl Attempt {
    /// Before the first sweep, with the contraction that is expected.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) const fn begin(contraction: f64) -> Self {
        Self { converged: false, ratio: 0.0, contraction, sweeps: 0, change: f64::INFINITY, hopeless: false }
    }

    /// By how much the step should be longer, for the last coefficient `aim`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn factor(&self, plan: &Plan, aim: f64) -> f64 {
        let accurate = match self.ratio / aim {
            excess if 0.0 < excess && excess < f64::INFINITY => inverse_seventh_root(excess),
            excess if 0.0 < excess => 0.0,
            _ => f64::INFINITY,
        };
        if !self.converged {
            return if self.hopeless { SAFETY * accurate } else { UNCONVERGED };
        }
        // Few sweeps are cheap whatever they contract by.
        let slow = FEW_SWEEPS < self.sweeps;
        let cheap = if slow { (BEST_CONTRACTION / self.contraction).sqrt() } else { f64::INFINITY };
        accurate.min(cheap.max(plan.rejected))
    }
}

/// The stages of a method, with the memory of its run, for a field F.
pub(crate) trait Collocation<T: Real, F> {
    /// The error of the field.
    type Error;

    /// What all attempts at a step share; `evaluations` counts those it makes.
    fn begin_step(
        &mut self,
        _field: &mut F,
        _state: &State<T>,
        _evaluations: &mut u64,
    ) -> Result<(), IntegratorsError<Self::Error>> {
        Ok(())
    }

    /// Sweeps over the stages of a step of length h from the state, until they stand still or r exceeds `most`, which is
    /// infinite for equal steps.
    fn attempt(
        &mut self,
        field: &mut F,
        state: &State<T>,
        h: f64,
        tolerance: f64,
        most: f64,
        evaluations: &mut u64,
    ) -> Result<Attempt, Self::Error>;

    /// The last coefficient that the rounding of positions alone makes in the step that was just attempted. Methods that do not
    /// know give zero.
    fn noise(
        &mut self,
        _field: &mut F,
        _state: &State<T>,
        _h: f64,
        _evaluations: &mut u64,
    ) -> Result<f64, Self::Error> {
        Ok(0.0)
    }

    /// Moves the state to the end of the step.
    ///
    /// # Errors
    /// A state that is not finite.
    fn accept(&mut self, state: &mut State<T>, h: f64) -> Result<(), IntegratorsError<Self::Error>>;

    /// Refuses the rates of the last sweep if they are not finite.
    fn check_rates(&self, t: f64) -> Result<(), IntegratorsError<Self::Error>>;

    /// Writes the state at the part s of the last accepted step.
    fn state_at(&self, part: f64, out: &mut [T]);
}

/// Integrates from the state to `end`.
///
/// `inspect` sees the memory and the state after each accepted step. To end the run it gives the time of the end (the
/// step's own end when `None`) and how the run ended.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn follow<T: Real, F, W: Collocation<T, F>>(
    work: &mut W,
    field: &mut F,
    state: &mut State<T>,
    end: f64,
    plan: &Plan,
    resumed: Option<&Checkpoint<T>>,
    mut inspect: impl FnMut(&W, &State<T>, AcceptedStep) -> Result<ControlFlow<Stop>, IntegratorsError<W::Error>>,
) -> Result<Report, IntegratorsError<W::Error>> {
    let span = end - state.time;
    let mut report = resumed.map_or(Report::begin(), |checkpoint| checkpoint.report);
    let (start, before, equal) = match plan.equal {
        Some(longest) => Grid::of(longest, resumed, state.time, end)?.parts(),
        None => (state.time, report.steps, None),
    };
    // The length of the next step, and the best one of the step before; zero before the first.
    let (mut h, mut best_before) = first_lengths(state, span, plan, equal, resumed);
    let mut attempts_at_first = 0;
    // When the field last could not be evaluated, and what it said.
    let mut refused: Option<(f64, W::Error)> = None;
    // The last coefficient that rounding makes in this step, where a step was found too long.
    let mut noise: Option<f64> = None;
    if equal.is_some_and(|(count, _)| count <= report.steps) {
        return Ok(report);
    }
    loop {
        let remaining = end - state.time;
        if equal.is_none() && remaining * span <= 0.0 {
            return Ok(report);
        }
        if plan.most_steps <= report.steps {
            return Err(IntegratorsError::TooManySteps { t: state.time, steps: report.steps });
        }
        let (mut last, mut rest) = (equal.is_some_and(|(count, _)| count == report.steps + 1), 0.0);
        if equal.is_none() {
            (h, last, rest) = shared(h.clamp(-plan.longest_step, plan.longest_step), remaining);
            if h.abs() <= 2.0 * f64::EPSILON * state.time.abs() || h.abs() < f64::MIN_POSITIVE {
                return Err(too_small(work, refused, state.time, h, span));
            }
        }
        work.begin_step(field, state, &mut report.evaluations)?;
        let aim = plan.aim.max(noise.unwrap_or(0.0));
        let most = if equal.is_some() { f64::INFINITY } else { HOPELESS * aim };
        let attempt = match work.attempt(field, state, h, plan.tolerance, most, &mut report.evaluations) {
            Ok(attempt) => attempt,
            Err(source) if equal.is_some() => return Err(IntegratorsError::Field { t: state.time, source }),
            Err(source) => {
                refused = Some((state.time, source));
                report.rejected += 1;
                h *= UNCONVERGED;
                continue;
            }
        };
        let mut factor = attempt.factor(plan, aim);
        if equal.is_none()
            && let Some(aim) =
                above_noise(work, field, state, (h, attempt, factor), &mut noise, &mut report.evaluations)
            && plan.aim < aim
        {
            if attempt.hopeless {
                report.rejected += 1;
                continue;
            }
            factor = attempt.factor(plan, aim);
        }
        if equal.is_some() {
            if !attempt.converged {
                return Err(diverged(work, &attempt, state.time, h));
            }
        } else if !attempt.converged || factor < plan.rejected {
            report.rejected += 1;
            h *= factor.clamp(0.05, 0.7);
            continue;
        } else if report.steps == 0
            && TIMID < factor
            && !last
            && attempts_at_first < MOST_ATTEMPTS
            && h.abs() < plan.longest_step
        {
            attempts_at_first += 1;
            report.rejected += 1;
            h *= factor.min(50.0);
            continue;
        }
        let from = state.time;
        noise = None;
        work.accept(state, h)?;
        report.steps += 1;
        match equal {
            Some((_, h)) if !last => state.set_time(start + h * (report.steps - before) as f64),
            None if !last => state.advance_time(h),
            _ => state.set_time(end),
        }
        let (best, next) = if equal.is_none() { next_step(h, factor, best_before, rest) } else { (h, h) };
        let progress = RunSoFar { report, start, time_carry: state.time_carry, next, best };
        let step = AcceptedStep { number: report.steps, start: from, end: state.time, length: h, progress };
        if let ControlFlow::Break((time, ending)) = inspect(work, state, step)? {
            if let Some(time) = time.filter(|time| time.to_bits() != state.time.to_bits()) {
                work.state_at(step.part(time), &mut state.values);
                state.carry.fill(T::zero());
                state.set_time(time);
            }
            report.ending = ending;
            return Ok(report);
        }
        if last {
            return Ok(report);
        }
        if equal.is_none() {
            (best_before, h) = (best, next);
        }
    }
}

/// The times of equal steps: so many steps of length h from a time on, of which some are done.
struct Grid {
    start: f64,
    count: u64,
    h: f64,
    /// Steps of the run before this time.
    before: u64,
}

impl Grid {
    /// Steps no longer than `longest` to `end`. They are those of the whole run if one of them ends at `t`; else they begin there.
    fn of<T: Real, E>(
        longest: f64,
        resumed: Option<&Checkpoint<T>>,
        t: f64,
        end: f64,
    ) -> Result<Self, IntegratorsError<E>> {
        let steps = resumed.map_or(0, |checkpoint| checkpoint.report.steps);
        if let Some(Checkpoint { numbers, .. }) = resumed
            && let Ok((count, h)) = equal_steps::<E>(numbers[0], end, longest)
            && steps <= count
            && (numbers[0] + h * steps as f64).to_bits() == t.to_bits()
        {
            return Ok(Self { start: numbers[0], count, h, before: 0 });
        }
        let (count, h) = equal_steps(t, end, longest)?;
        Ok(Self { start: t, count: steps + count, h, before: steps })
    }

    const fn parts(self) -> (f64, u64, Option<(u64, f64)>) {
        (self.start, self.before, Some((self.count, self.h)))
    }
}

/// The lengths of the step to begin with and of the best one of the step before, zero where there is none.
fn first_lengths<T: Real>(
    state: &State<T>,
    span: f64,
    plan: &Plan,
    equal: Option<(u64, f64)>,
    resumed: Option<&Checkpoint<T>>,
) -> (f64, f64) {
    let best_before = resumed.map_or(0.0, |checkpoint| checkpoint.numbers[2]);
    let h = match (equal, resumed, plan.first_step) {
        (Some((_, h)), ..) => h,
        (None, Some(checkpoint), _) => checkpoint.numbers[1].copysign(span),
        (None, None, Some(h)) => h.copysign(span),
        (None, None, None) => first_step(state, span),
    };
    (h, best_before)
}

/// The last coefficient to aim at in a step that should have been shorter, above what rounding makes there. Where bodies are
/// much nearer to one another than to the origin, shorter steps show no smaller one. It is found once a step.
fn above_noise<T: Real, F, W: Collocation<T, F>>(
    work: &mut W,
    field: &mut F,
    state: &State<T>,
    (h, attempt, factor): (f64, Attempt, f64),
    noise: &mut Option<f64>,
    evaluations: &mut u64,
) -> Option<f64> {
    let is_too_long = attempt.hopeless || attempt.converged && factor < 1.0;
    if !is_too_long || noise.is_some() {
        return None;
    }
    let found = work.noise(field, state, h, evaluations).unwrap_or(0.0);
    *noise = Some((ABOVE_NOISE * found).min(MOST_NOISE));
    *noise
}

/// x^(−1/7) for normal x > 0, to 1e-4: as accurate as a length of steps need be. It is the same on all machines, which `powf` is not. After a
/// guess by the exponent, within 4 per cent, Newton's iteration z ← z (8 − x z⁷)/7 of the equation z⁻⁷ = x needs no division. For smaller x it is
/// too small, and steps grow by their largest factor all the same.
#[cfg_attr(not(debug_assertions), inline(always))]
fn inverse_seventh_root(x: f64) -> f64 {
    /// 8/7 of the bits of one, less what makes the largest error of the guess least.
    const GUESS: u64 = 0x4911_6924_9249_2492;
    let mut z = f64::from_bits(GUESS - x.to_bits() / 7);
    for _ in 0..2 {
        let square = z * z;
        z = z * (8.0 - (x * z) * (square * square * square)) * (1.0 / 7.0);
    }
    z
}

/// The step that would have been the best one, and the next one to try: as the best step changed, it will change. It takes at least `rest`,
/// the second half of what two steps share: halved again and again, the rest would never end.
#[cfg_attr(not(debug_assertions), inline(always))]
fn next_step(h: f64, factor: f64, best_before: f64, rest: f64) -> (f64, f64) {
    let best = h.abs() * factor;
    let trend = if 0.0 < best_before { (best / best_before).clamp(TREND.0, TREND.1) } else { 1.0 };
    let next = h * (SAFETY * factor * trend).min(MOST_GROWTH);
    (best.min(f64::MAX), if next.abs() < rest.abs() { rest } else { next })
}

/// Why steps shrink until they no longer advance the time.
fn too_small<T: Real, F, W: Collocation<T, F>>(
    work: &W,
    refused: Option<(f64, W::Error)>,
    t: f64,
    step: f64,
    span: f64,
) -> IntegratorsError<W::Error> {
    match refused {
        // The last refusal is the reason if it was here.
        Some((at, source)) if (t - at).abs() <= HERE * span.abs() => IntegratorsError::Field { t, source },
        _ => work.check_rates(t).err().unwrap_or(IntegratorsError::StepTooSmall { t, step }),
    }
}

/// Why a step of equal length cannot be made.
fn diverged<T: Real, F, W: Collocation<T, F>>(
    work: &W,
    attempt: &Attempt,
    t: f64,
    step: f64,
) -> IntegratorsError<W::Error> {
    let iterations = usize::try_from(attempt.sweeps).unwrap_or(usize::MAX);
    let diverged = IntegratorsError::StagesDiverged { t, step, iterations, change: attempt.change };
    // Rates that only later sweeps led to infinity are not the field's fault.
    work.check_rates(t).err().filter(|_| attempt.change.is_infinite()).unwrap_or(diverged)
}

/// The length of the next step, whether it is the last, and that of the step after it where the last two steps share what remains.
fn shared(h: f64, remaining: f64) -> (f64, bool, f64) {
    if remaining.abs() <= h.abs() * (1.0 + 1e-9) {
        (remaining, true, 0.0)
    } else if remaining.abs() < 2.0 * h.abs() {
        (0.5 * remaining, false, 0.5 * remaining)
    } else {
        (h, false, 0.0)
    }
}

/// A first step to try: a part of the time in which the positions would change as much as their size.
fn first_step<T: Real>(state: &State<T>, span: f64) -> f64 {
    let largest = |x: &[T]| x.iter().fold(0.0_f64, |largest, &x| largest.max(largest_lane(x)));
    let (q, v) = state.values.split_at(state.values.len() / 2);
    let time = 0.1 * largest(q) / largest(v);
    let part = 0.01 * span.abs();
    if 0.0 < time && time < part { time.copysign(span) } else { part.copysign(span) }
}
