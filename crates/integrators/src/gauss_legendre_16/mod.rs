//! Gauss–Legendre collocation of eight stages, order 16, for q̈ = f(t, q, q̇); all stages are evaluated at once.
//!
//! ```text
//! Vᵢ = v + h Σⱼ aᵢⱼ Aⱼ        Qᵢ = q + h cᵢ v + h² Σⱼ (A²)ᵢⱼ Aⱼ        Aᵢ = f(t + cᵢ h, Qᵢ, Vᵢ)
//! v ← v + h Σᵢ bᵢ Aᵢ         q ← q + h v + h² Σᵢ bᵢ (1 − cᵢ) Aᵢ
//! ```
//!
//! The eight stages are the lanes of one number: a sweep evaluates the field once, in lanes, for all of them. Sweeps start
//! from the polynomial of the step before, continued, and end where the next one would change less than the tolerance. Sums and
//! differences of stages that mirror one another about the middle of the step need half the products.
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
use self::stages::{NAME, Workspace};
use self::tableau::Stages;
use crate::collocation::{Control, Plan, follow};
use crate::events::stopped_by;
use crate::second_order::check_freedom;
use crate::state::{check_run, check_step};
use crate::{Checkpoint, IntegratorsError, Report, SecondOrder, State, Tolerance};

/// Gauss–Legendre collocation of order 16 for q̈ = f(t, q, q̇), with steps that adapt or with a fixed one.
///
/// The state is y = (q, v). It suits smooth problems and small errors: near rounding it takes one step where an explicit
/// method of order eight takes ten. With a fixed step it is symplectic where f derives from a potential of q alone.
///
/// # Accuracy
/// Global error O(h¹⁶), until rounding; the state is summed with compensation.
///
/// # Cost
/// Four to nine sweeps a step, each an evaluation in lanes and the products of the tableau, which sums and differences of mirrored stages
/// halve. A field of up to four coordinates should state their number in [`FREEDOM`](SecondOrder::FREEDOM): its sweeps are unrolled. The example
/// `floors` measures what evaluations and products take alone, and the page *Integration* of the measurements has the table.
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

/// The steps after which a run is given up, unless it is told otherwise.
const MOST_STEPS: u64 = 10_000_000;
/// The smallest tolerance that changes anything.
const ROUNDING: f64 = 1e-17;
/// r₀ over the tolerance to the power 7/16: then ten revolutions of eccentric orbits end within the tolerance.
const AIM: f64 = 0.25;
/// Steps whose error asks for less than this part of them are made again.
const REJECTED: f64 = 0.8;

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
        dispatch(Run { method: self, field, state, end, resumed: None, observer })
    }

    /// Continues a run from a [`Checkpoint`] that this method made with the same settings: the state becomes that of the
    /// checkpoint. To the same end the run takes the same steps, to the last bit.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate); [`IntegratorsError::WrongMethod`] for a checkpoint of another method and
    /// [`IntegratorsError::WrongLength`] for one of another system. The state is then left alone.
    pub fn resume<F: SecondOrder<Stages>>(
        &mut self,
        field: &mut F,
        checkpoint: &Checkpoint,
        state: &mut State,
        end: f64,
        observer: impl FnMut(&CollocationStep<'_>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        dispatch(Run { method: self, field, state, end, resumed: Some(checkpoint), observer })
    }
}

/// A run, compiled for each set of instructions.
struct Run<'a, F, O> {
    method: &'a mut GaussLegendre16,
    field: &'a mut F,
    state: &'a mut State,
    end: f64,
    resumed: Option<&'a Checkpoint>,
    observer: O,
}

impl<F: SecondOrder<Stages>, O: FnMut(&CollocationStep<'_>) -> ControlFlow<()>> Kernel for Run<'_, F, O> {
    type Output = Result<Report, IntegratorsError<F::Error>>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Self::Output {
        let Run { method, field, state, end, resumed, mut observer } = self;
        check_freedom::<Stages, F>(field)?;
        let n = field.freedom();
        method.work.begin(n);
        match resumed {
            None => check_run(2 * n, state, end)?,
            Some(checkpoint) => {
                checkpoint.open(NAME, [8 * n, 5], &[1, 4], state, |state| check_run(2 * n, state, end))?;
                method.work.restore(&checkpoint.memory, [checkpoint.numbers[3], checkpoint.numbers[4]]);
            }
        }
        let (tolerance, equal) = match method.control {
            Control::Adaptive(tolerance) => (tolerance, None),
            Control::Fixed(longest) => (ROUNDING, Some(longest)),
        };
        let plan = Plan {
            equal,
            first_step: None,
            longest_step: f64::INFINITY,
            most_steps: method.most_steps,
            // r₀ of the module's head.
            aim: AIM * tolerance.powf(7.0 / 16.0),
            tolerance,
            rejected: REJECTED,
        };
        follow(&mut method.work, field, state, end, &plan, resumed, |work, state, step| {
            Ok(stopped_by(observer(&CollocationStep::new(work, state, step))))
        })
    }
}
