//! Gauss–Legendre collocation of eight stages, order 16, for q̈ = f(t, q, q̇); all stages are evaluated at once.
//!
//! ```text
//! Vᵢ = v + h Σⱼ aᵢⱼ Aⱼ        Qᵢ = q + h cᵢ v + h² Σⱼ (A²)ᵢⱼ Aⱼ        Aᵢ = f(t + cᵢ h, Qᵢ, Vᵢ)
//! v ← v + h Σᵢ bᵢ Aᵢ         q ← q + h v + h² Σᵢ bᵢ (1 − cᵢ) Aᵢ
//! ```
//!
//! The eight stages are the lanes of one number: a sweep evaluates the field once, in lanes, for all of them. Sweeps start
//! from the polynomial of the step before, continued, and end where the next one would change less than the tolerance.
//!
//! # Step size
//! The accelerations of a step are a polynomial `Σ γ_k P_k` of degree seven. Its last coefficient tells how well a degree of
//! seven suffices, and collocation is accurate to more than twice that degree:
//!
//! ```text
//! r = Σ|γ₇| / Σ|A|,    error ∝ r^(16/7),    h ← h (r₀/r)^(1/7),   r₀ = ¼ tolerance^(7/16)
//! ```
//!
//! with sums over the components, and |A| the mean over the stages. Where sweeps converge slowly, shorter steps are
//! cheaper, and are taken. A step that is too long shows it after two sweeps.
//!
//! # References
//! Hairer, Lubich & Wanner, *Geometric Numerical Integration*, II.1.3, VIII.6; stages in lanes: Antoñana, Alberdi, Makazaga
//! & Murua, *An implicit symplectic solver for high-precision long-term integrations*, Celest. Mech. Dyn. Astron. 134 (2022).

mod dense;
mod stages;
#[expect(clippy::unreadable_literal, reason = "seventeen digits, to be compared with printed tables")]
mod tableau;

use core::ops::ControlFlow;

use piola_numerics::{Kernel, dispatch};

pub use self::dense::CollocationStep;
use self::stages::{Attempt, Workspace};
use self::tableau::Stages;
use crate::state::{check_run, check_step, equal_steps};
use crate::{Ending, IntegratorsError, Report, SecondOrder, State, Tolerance};

/// Gauss–Legendre collocation of order 16 for q̈ = f(t, q, q̇), with steps that adapt or with a fixed one.
///
/// The state is y = (q, v). It suits smooth problems and small errors: near rounding it takes one step where an explicit
/// method of order eight takes ten. With a fixed step it is symplectic where f derives from a potential of q alone.
///
/// # Accuracy
/// Global error O(h¹⁶), until rounding; the state is summed with compensation.
///
/// # Example
/// ```
/// use core::convert::Infallible;
/// use piola_integrators::{GaussLegendre16, SecondOrder, State, Tolerance};
/// use piola_numerics::Real;
/// struct Kepler; // q̈ = −q/|q|³
/// impl<T: Real> SecondOrder<T> for Kepler {
///     type Error = Infallible;
///     fn freedom(&self) -> usize {
///         2
///     }
///     #[cfg_attr(not(debug_assertions), inline(always))]
///     fn acceleration(&mut self, _t: T, q: &[T], _v: &[T], acceleration: &mut [T]) -> Result<(), Infallible> {
///         let square = q[0] * q[0] + q[1] * q[1];
///         let factor = (square * square.sqrt()).recip();
///         acceleration[0] = -q[0] * factor;
///         acceleration[1] = -q[1] * factor;
///         Ok(())
///     }
/// }
/// // Eccentricity ½, from the pericentre: once around in 2π.
/// let mut state = State::new(0.0, vec![0.5, 0.0, 0.0, 3.0_f64.sqrt()])?;
/// let mut method = GaussLegendre16::new(Tolerance::relative(1e-13)?);
/// let report = method.integrate_to(&mut Kepler, &mut state, 2.0 * core::f64::consts::PI)?;
/// assert!((state.values[0] - 0.5).abs() < 1e-13 && state.values[1].abs() < 1e-13);
/// assert!(report.steps < 20);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("implicit Runge-Kutta", "IRKGL16", "collocation", "symplectic"))]
#[derive(Clone, Debug)]
pub struct GaussLegendre16 {
    control: Control,
    most_steps: u64,
    work: Workspace,
}

/// How steps are chosen.
#[derive(Clone, Copy, Debug)]
enum Control {
    /// Steps whose error is within the tolerance.
    Adaptive(f64),
    /// Equal steps no longer than this.
    Fixed(f64),
}

/// The steps after which a run is given up, unless it is told otherwise.
const MOST_STEPS: u64 = 10_000_000;
/// The smallest tolerance that changes anything.
const ROUNDING: f64 = 1e-17;
/// r₀ over the tolerance to the power 7/16: then ten revolutions of eccentric orbits end within the tolerance.
const AIM: f64 = 0.25;
/// The factor of contraction of a sweep at which a digit costs least: e⁻² where accelerations depend on positions, and
/// more where they depend on velocities.
const BEST_CONTRACTION: f64 = 0.3;
/// Sweeps that are no reason to shorten a step.
const FEW_SWEEPS: u64 = 5;
/// Steps whose error asks for less than this part of them are made again.
const REJECTED: f64 = 0.8;
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
/// Steps whose last coefficient exceeds the aim by this factor after two sweeps are not swept further: 0.65⁻⁷.
const HOPELESS: f64 = 20.0;
/// Growth after which a first step is made again rather than kept.
const TIMID: f64 = 3.0;
/// Attempts at the first step.
const MOST_ATTEMPTS: u32 = 4;

impl GaussLegendre16 {
    /// Steps that adapt to a tolerance of the error of the run, relative to the state.
    #[must_use]
    pub fn new(tolerance: Tolerance) -> Self {
        let tolerance = tolerance.relative_part().max(tolerance.absolute_part()).max(ROUNDING);
        Self { control: Control::Adaptive(tolerance), most_steps: MOST_STEPS, work: Workspace::default() }
    }

    /// Equal steps no longer than `step` (s): symplectic where f derives from a potential of q alone.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn with_step(step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        Ok(Self { control: Control::Fixed(step), most_steps: u64::MAX, work: Workspace::default() })
    }

    /// Changes the number of steps after which an adaptive run is given up, ten million.
    #[must_use]
    pub const fn with_most_steps(mut self, steps: u64) -> Self {
        self.most_steps = steps;
        self
    }

    /// The same with a part of the tolerance, or with steps of half the length.
    pub(crate) fn finer(&self, part: f64) -> Self {
        let control = match self.control {
            Control::Adaptive(tolerance) => Control::Adaptive((tolerance * part).max(ROUNDING)),
            Control::Fixed(step) => Control::Fixed(0.5 * step),
        };
        Self { control, ..self.clone() }
    }

    /// Integrates to `end`, unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<F: SecondOrder<Stages>>(
        &mut self,
        field: &mut F,
        state: &mut State,
        end: f64,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.integrate(field, state, end, |_step| ControlFlow::Continue(()))
    }

    /// Integrates to `end`; backwards if it is earlier than the state's time. The observer sees every step, with the state
    /// at any time within it, and may stop the run. Evaluations are counted by stages, eight to a sweep.
    ///
    /// # Errors
    /// The state does not fit or is not finite; the field fails or gives rates that are not finite, or the step shrinks
    /// until it no longer advances the time; with a fixed step, stages that do not converge. The state then stands at the
    /// last complete step.
    pub fn integrate<F: SecondOrder<Stages>>(
        &mut self,
        field: &mut F,
        state: &mut State,
        end: f64,
        observer: impl FnMut(&CollocationStep<'_>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        dispatch(Run { method: self, field, state, end, observer })
    }
}

/// A run, compiled for each set of instructions.
struct Run<'a, F, O> {
    method: &'a mut GaussLegendre16,
    field: &'a mut F,
    state: &'a mut State,
    end: f64,
    observer: O,
}

impl<F: SecondOrder<Stages>, O: FnMut(&CollocationStep<'_>) -> ControlFlow<()>> Kernel for Run<'_, F, O> {
    type Output = Result<Report, IntegratorsError<F::Error>>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Self::Output {
        let Run { method, field, state, end, mut observer } = self;
        let n = field.freedom();
        check_run(2 * n, state, end)?;
        let work = &mut method.work;
        work.begin(n);
        let span = end - state.time;
        let mut report = Report::begin();
        let (tolerance, equal) = match method.control {
            Control::Adaptive(tolerance) => (tolerance, None),
            Control::Fixed(longest) => (ROUNDING, Some(equal_steps(state.time, end, longest)?)),
        };
        // r₀ of the module's head.
        let aim = AIM * tolerance.powf(7.0 / 16.0);
        let mut h = equal.map_or_else(|| first_step(state, n, span), |(_, h)| h);
        let (mut first, start) = (0, state.time);
        // The best length of the step before; zero before the first.
        let mut best_before = 0.0_f64;
        // When the field last could not be evaluated, and what it said.
        let mut refused: Option<(f64, F::Error)> = None;
        if let Some((count, _)) = equal
            && count == 0
        {
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
                // The last two steps share what remains.
                last = remaining.abs() <= h.abs() * (1.0 + 1e-9);
                h = if last {
                    remaining
                } else if remaining.abs() < 2.0 * h.abs() {
                    0.5 * remaining
                } else {
                    h
                };
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
            let most = if equal.is_some() { f64::INFINITY } else { HOPELESS * aim };
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
            let factor = factor(&attempt, aim);
            if equal.is_some() {
                if let Some(error) = work.why_failed(&attempt, state.time, h) {
                    return Err(error);
                }
            } else if !attempt.converged || factor < REJECTED {
                report.rejected += 1;
                h *= factor.clamp(0.05, 0.7);
                continue;
            } else if report.steps == 0 && TIMID < factor && !last && first < MOST_ATTEMPTS {
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
            let step = CollocationStep::new(work, state, report.steps, h, from);
            if observer(&step).is_break() {
                report.ending = Ending::Stopped;
                return Ok(report);
            }
            if last {
                return Ok(report);
            }
            if equal.is_none() {
                // As the best step changed, it will change.
                let best = h.abs() * factor;
                let trend = if 0.0 < best_before { (best / best_before).clamp(TREND.0, TREND.1) } else { 1.0 };
                best_before = best;
                h *= (SAFETY * factor * trend).min(MOST_GROWTH);
            }
        }
    }
}

/// By how much the step should be longer.
#[cfg_attr(not(debug_assertions), inline(always))]
fn factor(attempt: &Attempt, aim: f64) -> f64 {
    let accurate = if 0.0 < attempt.ratio { (aim / attempt.ratio).powf(1.0 / 7.0) } else { f64::INFINITY };
    if !attempt.converged {
        return if attempt.hopeless { SAFETY * accurate } else { UNCONVERGED };
    }
    // Few sweeps are cheap whatever they contract by.
    let slow = FEW_SWEEPS < attempt.sweeps;
    let cheap = if slow { (BEST_CONTRACTION / attempt.contraction).sqrt() } else { f64::INFINITY };
    accurate.min(cheap.max(REJECTED))
}

/// A first step to try: a part of the time in which the positions would change as much as their size.
fn first_step(state: &State, n: usize, span: f64) -> f64 {
    let largest = |x: &[f64]| x.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let (q, v) = state.values.split_at(n);
    let time = 0.1 * largest(q) / largest(v);
    let part = 0.01 * span.abs();
    if 0.0 < time && time < part { time.copysign(span) } else { part.copysign(span) }
}
