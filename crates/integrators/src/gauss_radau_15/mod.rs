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
//! should have been shorter than 0.7 of its length is made again. Where two bodies are so near to one another, seen from the origin,
//! that the rounding of positions makes a larger coefficient than ε/8, eight times that coefficient take the place of ε. One more evaluation, at
//! positions moved by 1024 times their rounding, finds it; it is made only where a step should have been shorter.
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
use self::stages::{NAME, Workspace};
use crate::collocation::{Control, Plan, follow};
use crate::events::{Stop, begin, locate, stopped_by};
use crate::second_order::check_freedom;
use crate::state::{check_longest, check_run, check_step};
use crate::{Checkpoint, Event, IntegratorsError, Occurrence, Report, SecondOrder, State, Tolerance};

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
    first_step: Option<f64>,
    longest_step: f64,
    most_steps: u64,
    work: Workspace<T>,
}

/// The steps after which a run is given up, unless it is told otherwise.
const MOST_STEPS: u64 = 1_000_000_000;
/// ε of runs to rounding: r^(15/7) is then 5e-20.
const TO_ROUNDING: f64 = 1e-9;
/// The power of the tolerance that ε is.
const POWER: f64 = 7.0 / 15.0;
/// Steps whose error asks for less than this part of them are made again.
const REJECTED: f64 = 0.7;

impl<T: Real> Default for GaussRadau15<T> {
    /// As [`to_rounding`](GaussRadau15::to_rounding).
    fn default() -> Self {
        Self::to_rounding()
    }
}

impl<T: Real> GaussRadau15<T> {
    fn controlled(control: Control, most_steps: u64) -> Self {
        Self { control, first_step: None, longest_step: f64::INFINITY, most_steps, work: Workspace::default() }
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

    /// Sets the first step to try (s) of adaptive runs instead of estimating it; a step that proves too long, or much too short, is
    /// made again.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn with_first_step(mut self, step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        self.first_step = Some(step);
        Ok(self)
    }

    /// Bounds every adaptive step, s; by default steps are not bounded.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step; ∞ is no bound.
    pub fn with_longest_step(mut self, step: f64) -> Result<Self, IntegratorsError> {
        self.longest_step = check_longest(step)?;
        Ok(self)
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
        dispatch(Run { method: self, field, state, end, resumed: None, inspect })
    }

    /// Continues a run from a [`Checkpoint`] that this method made with the same settings: the state becomes that of the
    /// checkpoint. To the same end the run takes the same steps, to the last bit.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate); [`IntegratorsError::WrongMethod`] for a checkpoint of another method and
    /// [`IntegratorsError::WrongLength`] for one of another system. The state is then left alone.
    pub fn resume<F: SecondOrder<T>>(
        &mut self,
        field: &mut F,
        checkpoint: &Checkpoint<T>,
        state: &mut State<T>,
        end: f64,
        mut observer: impl FnMut(&GaussRadauStep<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        let inspect = |step: &mut GaussRadauStep<'_, T>| Ok(stopped_by(observer(step)));
        dispatch(Run { method: self, field, state, end, resumed: Some(checkpoint), inspect })
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
        dispatch(Run { method: self, field, state, end, resumed: None, inspect })
    }
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
    resumed: Option<&'a Checkpoint<T>>,
    inspect: I,
}

impl<T: Real, F: SecondOrder<T>, I> Kernel for Run<'_, T, F, I>
where
    I: FnMut(&mut GaussRadauStep<'_, T>) -> Result<ControlFlow<Stop>, IntegratorsError<F::Error>>,
{
    type Output = Result<Report, IntegratorsError<F::Error>>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Self::Output {
        let Run { method, field, state, end, resumed, mut inspect } = self;
        check_freedom::<T, F>(field)?;
        let n = field.freedom();
        let work = &mut method.work;
        work.begin(n);
        match resumed {
            None => check_run(2 * n, state, end)?,
            Some(checkpoint) => {
                checkpoint.open(NAME, [8 * n, 5], &[1, 4], state, |state| check_run(2 * n, state, end))?;
                work.restore(&checkpoint.memory, [checkpoint.numbers[3], checkpoint.numbers[4]]);
            }
        }
        let (aim, equal) = match method.control {
            Control::Adaptive(epsilon) => (epsilon.max(work.smallest_ratio()), None),
            Control::Fixed(longest) => (0.0, Some(longest)),
        };
        let plan = Plan {
            equal,
            first_step: method.first_step,
            longest_step: method.longest_step,
            most_steps: method.most_steps,
            aim,
            tolerance: aim.powf(1.0 / POWER),
            rejected: REJECTED,
        };
        follow(work, field, state, end, &plan, resumed, |work, state, step| {
            inspect(&mut GaussRadauStep::new(work, state, step))
        })
    }
}
