//! Gauss–Radau collocation of eight stages, order 15, for q̈ = f(t, q, q̇); the first stage is the start of the step.
//!
//! ```text
//! q̈(s) = a₀ + b₀ s + b₁ s² + … + b₆ s⁷                 s = (t − t₀)/h, through f at the nodes c₀ = 0 < c₁ < … < c₇ < 1
//! q̇(s) = v₀ + h s (a₀ + Σ bₖ sᵏ⁺¹/(k + 2))
//! q(s) = q₀ + h s v₀ + h² s² (½ a₀ + Σ bₖ sᵏ⁺¹/((k + 2)(k + 3)))
//! ```
//!
//! Predictor: the polynomial of the step before, continued. Corrector: a sweep evaluates f at the seven nodes one after the
//! other, each with the newest accelerations of all. Sweeps end where the next one would change the accelerations by less than
//! a thousandth of the tolerance or a hundredth of their rounding, or where the changes no longer fall (more than half of the one before, and
//! below the square root of rounding). A step that needs more than 12 sweeps is made again, shorter; a fixed step may
//! take 40.
//!
//! # Step size
//! The last coefficient tells how well a degree of seven suffices, and the method is accurate to twice that degree:
//!
//! ```text
//! r = Σ|b₆| / Σ|q̈|,    error ∝ r^(15/7),    h ← h (ε/r)^(1/7),    ε = 10⁻⁹ or tolerance^(7/15)
//! ```
//!
//! with sums over the components, and |q̈| the mean over the nodes, so that an acceleration may pass through zero. A step that
//! should have been shorter than 0.7 of its length is made again.
//!
//! The time scale of acceleration, jerk and snap at the end of a step, |a|²/(|j|² + |a||s|) = τ²/2 (Pham, Rein & Spiegel, 2024),
//! is not used: it is zero wherever the acceleration is zero, so that a harmonic oscillator of one coordinate would stop at its
//! first passage through the middle.
//!
//! # References
//! E. Everhart, *An efficient integrator that uses Gauss–Radau spacings*, in *Dynamics of Comets* (1985); H. Rein &
//! D. S. Spiegel, *IAS15*, MNRAS 446, 1424 (2015); D. Pham, H. Rein & D. S. Spiegel, *A new timestep criterion for N-body
//! simulations*, Open J. Astrophys. 7 (2024).

mod dense;
mod stages;
#[expect(clippy::unreadable_literal, reason = "seventeen digits, to be compared with printed tables")]
mod tables;

use core::ops::ControlFlow;

use piola_numerics::{Kernel, Real, dispatch};

pub use self::dense::GaussRadauStep;
use self::stages::{Attempt, Workspace};
use crate::events::{Stop, begin, locate};
use crate::field::largest_lane;
use crate::state::{check_run, check_step, equal_steps};
use crate::{Ending, Event, IntegratorsError, Occurrence, Report, SecondOrder, State, Tolerance};

/// Gauss–Radau collocation of order 15 for q̈ = f(t, q, q̇), with steps that adapt, to rounding if nothing else is said.
///
/// The state is y = (q, v). It suits smooth problems followed for very long, close encounters and any eccentricity: with the
/// steps of [`to_rounding`](Self::to_rounding) the energy error walks at random, as rounding alone makes it. It needs f in one
/// scalar only, where [`GaussLegendre16`](crate::GaussLegendre16) needs it in lanes and is faster. It is not symplectic.
///
/// ```text
/// q̈(s) = a₀ + Σ bₖ sᵏ⁺¹,    v(s) = v₀ + h s (a₀ + Σ bₖ sᵏ⁺¹/(k + 2)),    q(s) = q₀ + h s v₀ + h² s² (½ a₀ + Σ bₖ sᵏ⁺¹/((k + 2)(k + 3)))
/// ```
/// | symbol | meaning |
/// |---|---|
/// | s | the part of the step that is past, (t − t₀)/h |
/// | a₀ | f at the start of the step |
/// | b₀ … b₆ | coefficients with which q̈ = f(t, q, q̇) at seven more places, Radau's nodes |
/// | ε | `Σ\|b₆\| / Σ\|q̈\|` that a step should have, with the mean of \|q̈\| over the nodes: 10⁻⁹, or tolerance^(7/15) |
///
/// The nodes are solved for by sweeps, from the polynomial of the last step, until nothing but rounding changes: mostly two.
///
/// # Accuracy
/// Global error O(h¹⁵), until rounding; the state is summed with compensation. With `to_rounding`, the relative error of the
/// energy of eight Keplerian orbits (e from 0.01 to 0.04) has a root mean square of 9e-15 after 10,240 revolutions, and grows
/// as the square root of the time (test `energy_error_of_ten_thousand_revolutions_walks_at_random`).
///
/// # Example
/// ```
/// use core::convert::Infallible;
/// use piola_integrators::{GaussRadau15, SecondOrder, State};
/// struct Kepler; // q̈ = −q/|q|³
/// impl SecondOrder for Kepler {
///     type Error = Infallible;
///     const VELOCITY_DEPENDENT: bool = false;
///     fn freedom(&self) -> usize {
///         2
///     }
///     #[cfg_attr(not(debug_assertions), inline(always))]
///     fn acceleration(&mut self, _t: f64, q: &[f64], _v: &[f64], acceleration: &mut [f64]) -> Result<(), Infallible> {
///         let square = q[0] * q[0] + q[1] * q[1];
///         let factor = 1.0 / (square * square.sqrt());
///         acceleration[0] = -q[0] * factor;
///         acceleration[1] = -q[1] * factor;
///         Ok(())
///     }
/// }
/// // Eccentricity ½, from the pericentre: a hundred times around in 200π.
/// let mut state = State::new(0.0, vec![0.5, 0.0, 0.0, 3.0_f64.sqrt()])?;
/// GaussRadau15::to_rounding().integrate_to(&mut Kepler, &mut state, 200.0 * core::f64::consts::PI)?;
/// assert!((state.values[0] - 0.5).abs() < 1e-12 && state.values[1].abs() < 1e-11);
/// let energy = 0.5 * (state.values[2].powi(2) + state.values[3].powi(2)) - 1.0 / state.values[0].hypot(state.values[1]);
/// assert!((energy + 0.5).abs() < 1e-14);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("RADAU", "RA15", "IAS15", "Everhart", "implicit Runge-Kutta", "predictor-corrector"))]
#[derive(Clone, Debug)]
pub struct GaussRadau15<T = f64> {
    control: Control,
    longest_step: f64,
    most_steps: u64,
    work: Workspace<T>,
}

/// How steps are chosen.
#[derive(Clone, Copy, Debug)]
enum Control {
    /// Steps whose ratio |b₆|/|a| is at most ε.
    Adaptive(f64),
    /// Equal steps no longer than this.
    Fixed(f64),
}

/// The steps after which a run is given up, unless it is told otherwise.
const MOST_STEPS: u64 = 1_000_000_000;
/// ε of runs to rounding: r^(15/7) is then 5e-20.
const TO_ROUNDING: f64 = 1e-9;
/// The power of the tolerance that ε is.
const POWER: f64 = 7.0 / 15.0;
/// The factor of contraction of a sweep at which a digit costs least: e⁻² or more.
const BEST_CONTRACTION: f64 = 0.3;
/// Sweeps that are no reason to shorten a step.
const FEW_SWEEPS: u64 = 5;
/// Steps whose error asks for less than this part of them are made again.
const REJECTED: f64 = 0.7;
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
/// Steps whose ratio |b₆|/|a| exceeds ε by this factor after one sweep are not swept further: 0.65⁻⁷.
const HOPELESS: f64 = 20.0;
/// Growth after which a first step is made again rather than kept.
const TIMID: f64 = 3.0;
/// Attempts at the first step.
const MOST_ATTEMPTS: u32 = 4;

impl<T: Real> Default for GaussRadau15<T> {
    /// As [`to_rounding`](GaussRadau15::to_rounding).
    fn default() -> Self {
        Self::to_rounding()
    }
}

impl<T: Real> GaussRadau15<T> {
    fn controlled(control: Control, most_steps: u64) -> Self {
        Self { control, longest_step: f64::INFINITY, most_steps, work: Workspace::default() }
    }

    /// Steps so short that only rounding errs: ε = 10⁻⁹ for the last coefficient over the acceleration.
    #[must_use]
    pub fn to_rounding() -> Self {
        Self::controlled(Control::Adaptive(TO_ROUNDING), MOST_STEPS)
    }

    /// Steps that adapt to a tolerance of the error of the run, relative to the state: ε = tolerance^(7/15).
    #[must_use]
    pub fn new(tolerance: Tolerance) -> Self {
        let tolerance = tolerance.relative_part().max(tolerance.absolute_part());
        Self::controlled(Control::Adaptive(tolerance.min(1.0).powf(POWER)), MOST_STEPS)
    }

    /// Steps whose last coefficient is the part ε of the acceleration, the `ε_b` of Rein & Spiegel.
    ///
    /// An ε that rounding alone exceeds, about 10⁻¹² in `f64`, is raised to that.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidTolerance`] unless 0 < ε < 1.
    #[doc(alias("epsilon_b"))]
    pub fn with_epsilon(epsilon: f64) -> Result<Self, IntegratorsError> {
        let epsilon = Tolerance::relative(epsilon)?.relative_part();
        Ok(Self::controlled(Control::Adaptive(epsilon), MOST_STEPS))
    }

    /// Equal steps no longer than `step` (s), of order fifteen.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn with_step(step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        Ok(Self::controlled(Control::Fixed(step), u64::MAX))
    }

    /// Bounds every adaptive step, s; by default steps are not bounded.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step; ∞ is no bound.
    pub fn with_longest_step(mut self, step: f64) -> Result<Self, IntegratorsError> {
        if 0.0 < step {
            self.longest_step = step;
            Ok(self)
        } else {
            Err(IntegratorsError::InvalidStep { step })
        }
    }

    /// Changes the number of steps after which an adaptive run is given up, a thousand million.
    #[must_use]
    pub const fn with_most_steps(mut self, steps: u64) -> Self {
        self.most_steps = steps;
        self
    }

    /// The same with a part of the tolerance, or with steps of half the length.
    pub(crate) fn finer(&self, part: f64) -> Self {
        let control = match self.control {
            Control::Adaptive(epsilon) => Control::Adaptive(epsilon * part.powf(POWER)),
            Control::Fixed(step) => Control::Fixed(0.5 * step),
        };
        Self { control, ..self.clone() }
    }

    /// Integrates to `end`, unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<F: SecondOrder<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.integrate(field, state, end, |_step| ControlFlow::Continue(()))
    }

    /// Integrates to `end`; backwards if it is earlier than the state's time. The observer sees every step, with the state
    /// at any time within it, and may stop the run.
    ///
    /// # Errors
    /// The state does not fit or is not finite; the field fails or gives rates that are not finite, or the step shrinks
    /// until it no longer advances the time; the limit on steps is reached; with a fixed step, stages that do not converge.
    /// The state then stands at the last complete step.
    pub fn integrate<F: SecondOrder<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        mut observer: impl FnMut(&GaussRadauStep<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        let inspect = |step: &mut GaussRadauStep<'_, T>| Ok(stopped_by(observer(step)));
        dispatch(Run { method: self, field, state, end, inspect })
    }
}

impl GaussRadau15<f64> {
    /// Integrates to `end` and reports the crossings of the events in the order of time. The run ends early at an event whose
    /// action is [`EventAction::Stop`](crate::EventAction::Stop), with the state there, or when one of the observers breaks.
    /// The observer sees a step after its events; a step cut short by a stop it does not see.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate), and [`IntegratorsError::InvalidEvent`] where a function is NaN.
    ///
    /// # Example
    /// See [`DormandPrince853::integrate_with_events`](crate::DormandPrince853::integrate_with_events): the events are the same.
    pub fn integrate_with_events<F: SecondOrder>(
        &mut self,
        field: &mut F,
        state: &mut State,
        end: f64,
        events: &mut [Event<'_>],
        mut on_event: impl FnMut(Occurrence<'_>) -> ControlFlow<()>,
        mut observer: impl FnMut(&GaussRadauStep<'_>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        check_run(2 * field.freedom(), state, end)?;
        let mut values = state.values.clone();
        begin(events, state)?;
        let inspect = |step: &mut GaussRadauStep<'_>| match locate(step, events, &mut values, &mut on_event)? {
            Some(stop) => Ok(ControlFlow::Break(stop)),
            None => Ok(stopped_by(observer(step))),
        };
        dispatch(Run { method: self, field, state, end, inspect })
    }
}

/// What an observer's verdict at the end of a step means.
fn stopped_by(verdict: ControlFlow<()>) -> ControlFlow<Stop> {
    if verdict.is_break() { ControlFlow::Break((None, Ending::Stopped)) } else { ControlFlow::Continue(()) }
}

/// A run, compiled for each set of instructions.
///
/// `inspect` sees each accepted step; to end the run it gives the time of the end (the step's own end when `None`) and how the
/// run ended.
struct Run<'a, T, F, I> {
    method: &'a mut GaussRadau15<T>,
    field: &'a mut F,
    state: &'a mut State<T>,
    end: f64,
    inspect: I,
}

impl<T: Real, F: SecondOrder<T>, I> Kernel for Run<'_, T, F, I>
where
    I: FnMut(&mut GaussRadauStep<'_, T>) -> Result<ControlFlow<Stop>, IntegratorsError<F::Error>>,
{
    type Output = Result<Report, IntegratorsError<F::Error>>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Self::Output {
        let Run { method, field, state, end, mut inspect } = self;
        let n = field.freedom();
        check_run(2 * n, state, end)?;
        let work = &mut method.work;
        work.begin(n);
        let span = end - state.time;
        let mut report = Report::begin();
        let (epsilon, equal) = match method.control {
            Control::Adaptive(epsilon) => (epsilon.max(work.smallest_ratio()), None),
            Control::Fixed(longest) => (0.0, Some(equal_steps(state.time, end, longest)?)),
        };
        let tolerance = epsilon.powf(1.0 / POWER);
        let mut h = equal.map_or_else(|| first_step(state, n, span), |(_, h)| h);
        let (mut first, start) = (0, state.time);
        // The best length of the step before; zero before the first.
        let mut best_before = 0.0_f64;
        // When the field last could not be evaluated, and what it said.
        let mut refused: Option<(f64, F::Error)> = None;
        if equal.is_some_and(|(count, _)| count == 0) {
            return Ok(report);
        }
        loop {
            let remaining = end - state.time;
            if equal.is_none() && remaining * span <= 0.0 {
                return Ok(report);
            }
            if method.most_steps <= report.steps {
                return Err(IntegratorsError::TooManySteps { t: state.time, steps: report.steps });
            }
            let mut last = equal.is_some_and(|(count, _)| count == report.steps + 1);
            if equal.is_none() {
                h = h.clamp(-method.longest_step, method.longest_step);
                (h, last) = shared(h, remaining);
                if h.abs() <= 2.0 * f64::EPSILON * state.time.abs() || h.abs() < f64::MIN_POSITIVE {
                    return Err(match refused {
                        // The last refusal is the reason if it was here.
                        Some((t, source)) if (state.time - t).abs() <= HERE * span.abs() => {
                            IntegratorsError::Field { t: state.time, source }
                        }
                        _ => work.why_too_small(state.time, h),
                    });
                }
            }
            work.begin_step(field, state, &mut report.evaluations)?;
            let most = if equal.is_some() { f64::INFINITY } else { HOPELESS * epsilon };
            let attempt = match work.attempt(field, state, h, tolerance, most, &mut report.evaluations) {
                Ok(attempt) => attempt,
                Err(source) if equal.is_some() => return Err(IntegratorsError::Field { t: state.time, source }),
                Err(source) => {
                    refused = Some((state.time, source));
                    report.rejected += 1;
                    h *= UNCONVERGED;
                    continue;
                }
            };
            let factor = factor(&attempt, epsilon);
            if equal.is_some() {
                if let Some(error) = work.why_failed(&attempt, state.time, h) {
                    return Err(error);
                }
            } else if !attempt.converged || factor < REJECTED {
                report.rejected += 1;
                h *= factor.clamp(0.05, 0.7);
                continue;
            } else if report.steps == 0
                && TIMID < factor
                && !last
                && first < MOST_ATTEMPTS
                && h.abs() < method.longest_step
            {
                first += 1;
                report.rejected += 1;
                h *= factor.min(50.0);
                continue;
            }
            let from = state.time;
            if let Some(error) = work.accept(state, h) {
                return Err(error);
            }
            report.steps += 1;
            match equal {
                Some((_, h)) if !last => state.set_time(start + h * report.steps as f64),
                None if !last => state.advance_time(h),
                _ => state.set_time(end),
            }
            let verdict = inspect(&mut GaussRadauStep::new(work, state, report.steps, h, from))?;
            if let ControlFlow::Break((time, ending)) = verdict {
                if let Some(time) = time.filter(|time| time.to_bits() != state.time.to_bits()) {
                    work.state_at((time - from) / h, &mut state.values);
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
                h *= growth(factor, h, &mut best_before);
            }
        }
    }
}

/// The length of the next step, and whether it is the last: the last two steps share what remains.
fn shared(h: f64, remaining: f64) -> (f64, bool) {
    if remaining.abs() <= h.abs() * (1.0 + 1e-9) {
        (remaining, true)
    } else if remaining.abs() < 2.0 * h.abs() {
        (0.5 * remaining, false)
    } else {
        (h, false)
    }
}

/// By how much the step should be longer.
#[cfg_attr(not(debug_assertions), inline(always))]
fn factor(attempt: &Attempt, epsilon: f64) -> f64 {
    let accurate = if 0.0 < attempt.ratio { (epsilon / attempt.ratio).powf(1.0 / 7.0) } else { f64::INFINITY };
    if !attempt.converged {
        return if attempt.hopeless { SAFETY * accurate } else { UNCONVERGED };
    }
    // Few sweeps are cheap whatever they contract by.
    let slow = FEW_SWEEPS < attempt.sweeps;
    let cheap = if slow { (BEST_CONTRACTION / attempt.contraction).sqrt() } else { f64::INFINITY };
    accurate.min(cheap.max(REJECTED))
}

/// By how much the next step is longer: as the best step changed, it will change.
fn growth(factor: f64, h: f64, best_before: &mut f64) -> f64 {
    let best = h.abs() * factor;
    let trend = if 0.0 < *best_before { (best / *best_before).clamp(TREND.0, TREND.1) } else { 1.0 };
    *best_before = best;
    (SAFETY * factor * trend).min(MOST_GROWTH)
}

/// A first step to try: a part of the time in which the positions would change as much as their size.
fn first_step<T: Real>(state: &State<T>, n: usize, span: f64) -> f64 {
    let largest = |x: &[T]| x.iter().fold(0.0_f64, |largest, &x| largest.max(largest_lane(x)));
    let (q, v) = state.values.split_at(n);
    let time = 0.1 * largest(q) / largest(v);
    let part = 0.01 * span.abs();
    if 0.0 < time && time < part { time.copysign(span) } else { part.copysign(span) }
}
