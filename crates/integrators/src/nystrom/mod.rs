//! Nyström pairs 8(6) and 12(10): explicit methods with adaptive steps for q̈ = f(t, q).
//!
//! ```text
//! Qᵢ = q + cᵢ h v + h² Σⱼ aᵢⱼ Aⱼ        Aᵢ = f(t + cᵢ h, Qᵢ)
//! q ← q + h v + h² Σ bᵢ Aᵢ            v ← v + h Σ b′ᵢ Aᵢ
//! ```
//!
//! Forces must not depend on velocities; then no stage needs them, and a step of order eight takes eight evaluations where
//! a method for any field takes twelve of twice as many components.
//!
//! # When?
//! [`Nystrom1210`] for gravitation, springs and potentials; [`Nystrom86`] only where bodies pass each other closely and an error
//! of 1e-7 is enough. Where the acceleration can be evaluated in lanes, [`GaussLegendre16`](crate::GaussLegendre16) is faster on
//! most problems that were measured.
//!
//! # References
//! Dormand, El-Mikkawy & Prince, IMA J. Numer. Anal. 7 (1987) 235–250 and 423–430.

#[expect(clippy::unreadable_literal, reason = "seventeen digits, to be compared with printed tables")]
mod dense;
#[expect(clippy::unreadable_literal, reason = "seventeen digits, to be compared with printed tables")]
pub(crate) mod order_12;
#[expect(clippy::unreadable_literal, reason = "seventeen digits, to be compared with printed tables")]
pub(crate) mod order_8;
mod stages;
mod with_events;

use core::marker::PhantomData;
use core::ops::ControlFlow;

use piola_numerics::Real;

pub use self::dense::NystromStep;
use crate::checkpoint::Checkpoint;
use crate::events::{Stop, stopped_by};
use crate::explicit::{Limits, Weights, follow, settle};
use crate::{IntegratorsError, Report, SecondOrder, State, Tolerance, limits_of_steps};

/// A pair of Nyström formulas: [`NystromPair86`] or [`NystromPair1210`].
pub trait NystromPair: NystromCoefficients {}

/// What makes a Nyström pair. Stages are counted from zero.
pub trait NystromCoefficients: Copy + core::fmt::Debug {
    /// The name of the method that steps with the pair.
    const NAME: &'static str;
    /// Stages, with the one at the end of the step.
    const STAGES: usize;
    /// The times of the stages, as parts of the step.
    const NODES: &'static [f64];
    /// The stages after the first.
    const ROWS: &'static [Weights];
    /// The stage that holds the acceleration at the end of a step: the first stage of the next one.
    const END: usize;
    /// The weights of the position at the end, in units of h².
    const POSITION: Weights;
    /// The weights of the velocity at the end, in units of h.
    const VELOCITY: Weights;
    /// The weights of the position less those of the lower order.
    const POSITION_ERROR: Weights;
    /// The weights of the velocity less those of the lower order.
    const VELOCITY_ERROR: Weights;
    /// Times that the polynomial of dense output is made better: each adds two to its order.
    const LAYERS: usize;
    /// e^(1/p), where the error e falls with the power p of the step.
    fn root(error: f64) -> f64;
}

/// An explicit Nyström method with adaptive steps: [`Nystrom86`] or [`Nystrom1210`].
///
/// # Accuracy
/// The local error of each step is below the tolerance, relative to the largest position and to the largest velocity, or to the
/// magnitudes of the system where it has its own ([`SecondOrder::magnitudes`]). The state and the time are summed with
/// compensation. [Tolerances below rounding](Tolerance#tolerances-below-rounding) are raised.
///
/// # Example
/// ```
/// use core::convert::Infallible;
/// use piola_integrators::{Nystrom86, SecondOrder, State, Tolerance};
/// struct Spring; // q̈ = −4 q
/// impl SecondOrder for Spring {
///     type Error = Infallible;
///     const VELOCITY_DEPENDENT: bool = false;
///     fn freedom(&self) -> usize {
///         1
///     }
///     fn acceleration(&mut self, _t: f64, q: &[f64], _v: &[f64], acceleration: &mut [f64]) -> Result<(), Infallible> {
///         acceleration[0] = -4.0 * q[0];
///         Ok(())
///     }
/// }
/// let mut state = State::new(0.0, vec![1.0, 0.0])?;
/// Nystrom86::new(Tolerance::relative(1e-12)?).integrate_to(&mut Spring, &mut state, 5.0)?;
/// assert!((state.values[0] - 10.0_f64.cos()).abs() < 1e-12);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Nystrom<P, T = f64> {
    pub(crate) tolerance: Tolerance,
    limits: Limits,
    /// Rows of one acceleration each: the stages, then those of `Rows`.
    memory: Vec<T>,
    /// Positions at which dense output evaluates the acceleration.
    argument: Vec<T>,
    /// Magnitudes, one for each component, for the first step.
    spread: Vec<f64>,
    /// Coordinates.
    freedom: usize,
    /// The largest position and the largest velocity, at the start of a step and at its end.
    magnitudes: [f64; 2],
    magnitudes_at_end: [f64; 2],
    /// Those of each component, of a system that has its own.
    own_magnitudes: Vec<f64>,
    own_magnitudes_at_end: Vec<f64>,
    pair: PhantomData<P>,
}

/// The Nyström method of order 8(6): eight evaluations a step, dense output of order eight with two more.
///
/// # Example
/// See [`Nystrom`].
#[doc(alias("RKN8(6)", "DPRKN8", "Runge-Kutta-Nyström"))]
pub type Nystrom86<T = f64> = Nystrom<NystromPair86, T>;

/// The Nyström method of order 12(10): seventeen evaluations a step, dense output of order ten with six more.
///
/// # Example
/// See [`Nystrom`]: only the name differs.
#[doc(alias("RKN12(10)", "DPRKN12", "RKNINT", "Runge-Kutta-Nyström"))]
pub type Nystrom1210<T = f64> = Nystrom<NystromPair1210, T>;

/// The rows of the memory after the stages.
struct Rows;
impl Rows {
    /// Position and velocity at the end of the step, and what rounding left of them.
    const TRIAL: usize = 0;
    /// The same at its start.
    const START: usize = 4;
    /// The Legendre coefficients of the accelerations, for dense output.
    const LEGENDRE: usize = 8;
    /// The argument of a stage, and the part of it that its weights are added to.
    const ARGUMENT: usize = 16;
    const COUNT: usize = 18;
}

/// The formulas of orders eight and six.
///
/// # Example
/// ```
/// use piola_integrators::{Nystrom, Nystrom86, NystromPair86, Tolerance};
/// let method: Nystrom<NystromPair86> = Nystrom86::new(Tolerance::relative(1e-9)?);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct NystromPair86;

impl NystromPair for NystromPair86 {}

impl NystromCoefficients for NystromPair86 {
    const NAME: &'static str = "Nystrom86";
    const STAGES: usize = 9;
    const NODES: &'static [f64] = &order_8::C;
    const ROWS: &'static [Weights] = &order_8::ROWS;
    const END: usize = 8;
    const POSITION: Weights = &order_8::B;
    const VELOCITY: Weights = &order_8::B_VELOCITY;
    const POSITION_ERROR: Weights = &order_8::E;
    const VELOCITY_ERROR: Weights = &order_8::E_VELOCITY;
    const LAYERS: usize = 1;

    /// e^(9/64), nearly the seventh root.
    fn root(error: f64) -> f64 {
        let eighth = error.sqrt().sqrt().sqrt();
        eighth * eighth.sqrt().sqrt().sqrt()
    }
}

/// The formulas of orders twelve and ten.
///
/// # Example
/// ```
/// use piola_integrators::{Nystrom, Nystrom1210, NystromPair1210, Tolerance};
/// let method: Nystrom<NystromPair1210> = Nystrom1210::new(Tolerance::relative(1e-13)?);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct NystromPair1210;

impl NystromPair for NystromPair1210 {}

impl NystromCoefficients for NystromPair1210 {
    const NAME: &'static str = "Nystrom1210";
    const STAGES: usize = 18;
    const NODES: &'static [f64] = &order_12::C;
    const ROWS: &'static [Weights] = &order_12::ROWS;
    const END: usize = 17;
    const POSITION: Weights = &order_12::B;
    const VELOCITY: Weights = &order_12::B_VELOCITY;
    const POSITION_ERROR: Weights = &order_12::E;
    const VELOCITY_ERROR: Weights = &order_12::E_VELOCITY;
    const LAYERS: usize = 2;

    /// e^(3/32), nearly the eleventh root.
    fn root(error: f64) -> f64 {
        let sixteenth = error.sqrt().sqrt().sqrt().sqrt();
        sixteenth * sixteenth.sqrt()
    }
}

impl<P: NystromPair, T: Real> Nystrom<P, T> {
    /// A method with the given tolerance, raised above rounding.
    #[must_use]
    pub fn new(tolerance: Tolerance) -> Self {
        Self {
            tolerance: tolerance.above_rounding::<T>(),
            limits: Limits::none(),
            memory: Vec::new(),
            argument: Vec::new(),
            spread: Vec::new(),
            freedom: 0,
            magnitudes: [0.0; 2],
            magnitudes_at_end: [0.0; 2],
            own_magnitudes: Vec::new(),
            own_magnitudes_at_end: Vec::new(),
            pair: PhantomData,
        }
    }

    limits_of_steps!();

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
        self.integrate(field, state, end, |_| ControlFlow::Continue(()))
    }

    /// Integrates to `end`, backwards if it is earlier than the state's time. The observer sees every step,
    /// may ask for the state at any time within it, and may stop the run.
    ///
    /// # Errors
    /// The accelerations depend on velocities ([`SecondOrder::is_velocity_dependent`]): [`IntegratorsError::VelocityDependent`]. The
    /// state does not fit or is not finite; the field fails or its acceleration is not finite at the start or, however
    /// small the step, beyond a time; the step no longer advances the time; or the limit on steps is reached.
    /// The state then stands at the last accepted step.
    pub fn integrate<F: SecondOrder<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(&mut NystromStep<'_, P, T, F>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.integrate_from(field, None, state, end, observer)
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
        observer: impl FnMut(&mut NystromStep<'_, P, T, F>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.integrate_from(field, Some(checkpoint), state, end, observer)
    }

    /// [`integrate`](Self::integrate) without a checkpoint, [`resume`](Self::resume) with one: compiled once for both.
    ///
    /// # Errors
    /// As these.
    #[doc(hidden)]
    pub fn integrate_from<F: SecondOrder<T>>(
        &mut self,
        field: &mut F,
        checkpoint: Option<&Checkpoint<T>>,
        state: &mut State<T>,
        end: f64,
        mut observer: impl FnMut(&mut NystromStep<'_, P, T, F>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.run(field, state, end, checkpoint, &mut |step| Ok(stopped_by(observer(step))))
    }

    /// Runs to `end`. `inspect` sees each accepted step; to end the run it gives the time of the end (the step's own end
    /// when `None`) and how the run ended.
    fn run<F: SecondOrder<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        resumed: Option<&Checkpoint<T>>,
        inspect: &mut impl FnMut(&mut NystromStep<'_, P, T, F>) -> Result<ControlFlow<Stop>, IntegratorsError<F::Error>>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        follow(self, field, state, end, resumed, &mut |method, field, state, step, report| {
            let mut dense = NystromStep::new(method, field, step);
            let verdict = inspect(&mut dense);
            settle(verdict, &mut dense, state, report)
        })
    }
}
