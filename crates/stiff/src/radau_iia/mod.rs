//! Radau IIA: stiffly accurate collocation of orders 5, 9 and 13 for stiff problems M ẏ = f(t, y), with adaptive steps and
//! variable order.
//!
//! ```text
//! M Zᵢ = h Σⱼ aᵢⱼ f(t + cⱼh, y + Zⱼ),   i = 1 … s        y ← y + Zₛ
//! ```
//!
//! The order is 2s − 1. The nodes c are the zeros of the Radau polynomial `P_s − P_{s−1}` on [0, 1]; the last one is 1. The
//! methods are A-stable and L-stable: R(∞) = 0. The last stage is the result, so that constraints among the equations hold at
//! the end of every step.
//!
//! # Stages
//! Newton's iteration with one Jacobian J for all stages, in the variables W = T⁻¹Z in which A⁻¹ has the real eigenvalue γ
//! and pairs α ± iβ. It solves one real and (s − 1)/2 complex systems of n equations instead of one of s·n:
//!
//! ```text
//! (γ/h M − J) ΔW₁ = r₁        ((α − iβ)/h M − J) (ΔW₂ + i ΔW₃) = r₂ + i r₃        r = Λ/h T⁻¹ (h A f(y + Z) − M Z)
//! ```
//!
//! Only residuals are transformed: T⁻¹ has entries up to 300, and their rounding vanishes with the residual. The iteration
//! starts from the polynomial of the step before. J is kept while each sweep reduces the change by more than a factor of 10³;
//! the factors are kept if, besides, the step would grow by less than a fifth.
//!
//! # Error and step
//! The defect of the collocation polynomial at the start of the step, filtered by the real matrix, is of order s + 1:
//!
//! ```text
//! (γ/h M − J) e = f(t, y) + M Σ dᵢ Zᵢ / h
//! ```
//!
//! Where a step would be rejected, e is computed once more from f(t, y + e), which damps its stiff part.
//! Components that are slow for the step have an error of order 2s, far smaller than e; for them ‖e‖ is compared with
//! ⅒ tolerance^((s+1)/2s). Components that are fast for the step, which follow the others at once, have the error e itself.
//! Their part of e is compared with the tolerance, down to 1e-12:
//!
//! ```text
//! ‖(1 − F)² e‖ ≤ tolerance,    F = (γ/h M − J)⁻¹ γ/h M: near 1 for what is slow, near 0 for what is fast
//! ```
//!
//! Components of index 2 are left out of it. The next step follows from the last two errors (Gustafsson's predictive control).
//!
//! # Order
//! Newton's iteration contracts fast where the step is short for the problem, and then a higher order pays: the order rises
//! where the contraction is below 0.002, and falls where it is above 0.8 or the iteration fails.
//!
//! # When?
//! For chemical kinetics, stiff springs, strong damping, internal variables with short relaxation times: where an explicit
//! method takes steps far shorter than the motion asks for. Dense matrices serve for n up to a few hundred. With the feature
//! `sparse` a field may name the entries of its Jacobian, and n may be many thousands.
//!
//! # References
//! Hairer & Wanner, *Solving Ordinary Differential Equations II*, IV.5 and IV.8; Hairer & Wanner, *Stiff differential equations
//! solved by Radau methods*, J. Comput. Appl. Math. 111 (1999) 93; Gustafsson, ACM Trans. Math. Softw. 20 (1994) 496.

mod aim;
mod attempt;
mod checkpoint;
mod control;
mod dense;
mod estimate;
mod first_step;
mod global_error;
mod high_index;
mod lu;
mod matrices;
mod norm;
mod order;
mod run;
#[cfg(feature = "sparse")]
mod sparse;
#[cfg(feature = "sparse")]
mod sparse_lu;
mod stages;
mod tableau;
#[expect(
    clippy::unreadable_literal,
    clippy::excessive_precision,
    reason = "seventeen digits, to be compared with printed tables"
)]
mod tables;

use core::ops::ControlFlow;

use piola_integrators::internal::{begin, check_longest, check_step, locate, stopped_by};
use piola_integrators::{Event, IntegratorsError, Occurrence, Report, State, Tolerance};

pub use self::checkpoint::RadauCheckpoint;
pub use self::dense::RadauIiaStep;
pub use self::order::RadauOrder;
use self::stages::Workspace;
pub use self::tableau::Tableau;
use crate::StiffField;

/// Radau IIA of orders 5, 9 and 13 for stiff problems, with adaptive steps and order or with a fixed step.
///
/// # Accuracy
/// The error of a step is of order 6, 10 or 14; of components whose decay is far faster than the step, of order 4, 6 or 8. At
/// the end of van der Pol's, Robertson's and the Oregonator's equations and of HIRES the error is at most seven times the
/// tolerance, at tolerances from 1e-3 to 1e-13; of a stiff spring pendulum some twenty times. At the end of Andrews' squeezer
/// positions and velocities are within the tolerance if the constraints are on accelerations (index 1), within twelve times the
/// tolerance if they are on velocities (index 2). Reactions of index 2 are some hundred times less accurate. The state and the time are summed with compensation.
///
/// # Cost
/// Factorisations and solutions take most of a run: half of it to nine tenths on a chain of twenty stiff springs, by the last table of the example
/// `stiff`. Rows and columns that are zero beyond a band are left out. Where the fastest decay leaves an explicit method of high order long
/// enough steps, it is as fast at errors of 1e-10 and faster below: see the page *Integration* of the measurements.
///
/// # Example
/// ```
/// use core::convert::Infallible;
/// use piola_integrators::{Field, State, Tolerance};
/// use piola_stiff::{ExactJacobian, RadauIia};
/// use piola_numerics::Real;
/// struct VanDerPol; // x' = v, v' = 10⁶ ((1 − x²) v − x)
/// impl<T: Real> Field<T> for VanDerPol {
///     type Error = Infallible;
///     fn dimension(&self) -> usize {
///         2
///     }
///     fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
///         rate[0] = y[1];
///         rate[1] = T::lit(1e6) * ((T::one() - y[0] * y[0]) * y[1] - y[0]);
///         Ok(())
///     }
/// }
/// let mut state = State::new(0.0, vec![2.0, 0.0])?;
/// let mut method = RadauIia::new(Tolerance::relative(1e-8)?);
/// let report = method.integrate_to(&mut ExactJacobian::new(VanDerPol), &mut state, 2.0)?;
/// // The value in the Test Set for IVP Solvers; an explicit method takes millions of steps.
/// assert!((state.values[0] - 1.706167732170483).abs() < 1e-6);
/// assert!(report.run.steps < 500);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("RADAU5", "stiff", "implicit Runge-Kutta", "DAE", "BDF"))]
#[derive(Clone, Debug)]
pub struct RadauIia {
    control: Control,
    orders: Option<[RadauOrder; 2]>,
    first_step: Option<f64>,
    longest_step: f64,
    most_steps: u64,
    work: Workspace,
}

/// How steps are chosen.
#[derive(Clone, Copy, Debug)]
enum Control {
    Adaptive(Tolerance),
    /// Equal steps no longer than this.
    Fixed(f64),
}

/// What a run cost and how it ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct RadauReport {
    /// Steps, evaluations of the field (those for Jacobians apart) and the ending.
    pub run: Report,
    /// Jacobians evaluated.
    pub jacobians: u64,
    /// Factorisations, each of one real and (s − 1)/2 complex matrices.
    pub factorisations: u64,
}

impl RadauReport {
    const fn begin() -> Self {
        Self { run: Report::begin(), jacobians: 0, factorisations: 0 }
    }
    /// This run followed by another.
    #[must_use]
    pub const fn then(self, next: Self) -> Self {
        Self {
            run: self.run.then(next.run),
            jacobians: self.jacobians + next.jacobians,
            factorisations: self.factorisations + next.factorisations,
        }
    }
}

impl RadauIia {
    /// Steps and orders that adapt to a tolerance. A relative part between 0 and 1e-14 is raised to 1e-14: rounding of the iteration
    /// leaves nothing to be won below.
    #[must_use]
    pub fn new(tolerance: Tolerance) -> Self {
        Self {
            control: Control::Adaptive(aim::above_rounding(tolerance)),
            orders: None,
            first_step: None,
            longest_step: f64::INFINITY,
            most_steps: u64::MAX,
            work: Workspace::default(),
        }
    }

    /// Equal steps no longer than `step` (s), of one order; the stages are iterated until rounding stops them.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn with_step(order: RadauOrder, step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        // Newton's iteration alone sees this tolerance.
        let tolerance = Tolerance::relative(aim::ROUNDING)?;
        Ok(Self { control: Control::Fixed(step), ..Self::new(tolerance).with_orders(order, order) })
    }

    /// Bounds the order instead of leaving the bounds to the tolerance: by default the order is 5 or 9 at relative tolerances
    /// above 1e-5, 9 down to 1e-11, and 9 or 13 below.
    #[must_use]
    pub const fn with_orders(mut self, lowest: RadauOrder, highest: RadauOrder) -> Self {
        self.orders = Some([lowest, if highest.value() < lowest.value() { lowest } else { highest }]);
        self
    }

    /// Sets the first step tried, s; by default it is estimated.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn with_first_step(mut self, step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        self.first_step = Some(step);
        Ok(self)
    }

    /// Bounds every step, s; by default steps are not bounded.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step; ∞ is no bound.
    pub fn with_longest_step(mut self, step: f64) -> Result<Self, IntegratorsError> {
        self.longest_step = check_longest(step)?;
        Ok(self)
    }

    /// Bounds the number of steps of one run; by default it is not bounded.
    #[must_use]
    pub const fn with_most_steps(mut self, steps: u64) -> Self {
        self.most_steps = steps;
        self
    }

    /// The same with a part of the tolerance, or with steps of half the length.
    pub(crate) fn finer(&self, part: f64) -> Result<Self, IntegratorsError> {
        let control = match self.control {
            Control::Adaptive(tolerance) => {
                let (relative, absolute) = (tolerance.relative_part() * part, tolerance.absolute_part() * part);
                Control::Adaptive(aim::above_rounding(Tolerance::new(relative, absolute)?))
            }
            Control::Fixed(step) => Control::Fixed(0.5 * step),
        };
        Ok(Self { control, ..self.clone() })
    }

    /// Integrates to `end`, unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<F: StiffField>(
        &mut self,
        field: &mut F,
        state: &mut State,
        end: f64,
    ) -> Result<RadauReport, IntegratorsError<F::Error>> {
        self.integrate(field, state, end, |_step| ControlFlow::Continue(()))
    }

    /// Integrates to `end`, backwards if it is earlier than the state's time. The observer sees every step, with the state
    /// at any time within it, and may stop the run.
    ///
    /// # Errors
    /// The state does not fit or is not finite; the field or its Jacobian fails or is not finite; however small the step,
    /// the matrix is singular ([`IntegratorsError::SingularMatrix`]), the stages do not converge
    /// ([`IntegratorsError::StagesDiverged`]) or their error is too large ([`IntegratorsError::StepTooSmall`]), or the
    /// constraints are of index three ([`IntegratorsError::IndexTooHigh`], also where a component says so itself); or the limit on
    /// steps is reached. With a fixed step the first such failure ends the run. The state then stands at the last
    /// accepted step.
    pub fn integrate<F: StiffField>(
        &mut self,
        field: &mut F,
        state: &mut State,
        end: f64,
        mut observer: impl FnMut(&RadauIiaStep<'_>) -> ControlFlow<()>,
    ) -> Result<RadauReport, IntegratorsError<F::Error>> {
        self.run(field, state, end, None, &mut |step| Ok(stopped_by(observer(step))))
    }

    /// Continues a run from a [`RadauCheckpoint`] that this method made with the same settings: the state becomes that of the
    /// checkpoint. To the same end the run takes the same steps, to the last bit.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate); [`IntegratorsError::WrongLength`] for a checkpoint of another system or of other orders; for
    /// equal steps [`IntegratorsError::InvalidStep`] where the checkpoint is not at the end of one of the steps to this end.
    pub fn resume<F: StiffField>(
        &mut self,
        field: &mut F,
        checkpoint: &RadauCheckpoint,
        state: &mut State,
        end: f64,
        mut observer: impl FnMut(&RadauIiaStep<'_>) -> ControlFlow<()>,
    ) -> Result<RadauReport, IntegratorsError<F::Error>> {
        self.run(field, state, end, Some(checkpoint), &mut |step| Ok(stopped_by(observer(step))))
    }

    /// Integrates to `end` and reports the crossings of the events in the order of time, as
    /// [`DormandPrince853::integrate_with_events`](piola_integrators::DormandPrince853::integrate_with_events): the run ends early at an
    /// event whose action is [`EventAction::Stop`](piola_integrators::EventAction::Stop), with the state there, or when one of the
    /// observers breaks.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate), and [`IntegratorsError::InvalidEvent`] where a function is NaN.
    pub fn integrate_with_events<F: StiffField>(
        &mut self,
        field: &mut F,
        state: &mut State,
        end: f64,
        events: &mut [Event<'_>],
        mut on_event: impl FnMut(Occurrence<'_>) -> ControlFlow<()>,
        mut observer: impl FnMut(&RadauIiaStep<'_>) -> ControlFlow<()>,
    ) -> Result<RadauReport, IntegratorsError<F::Error>> {
        piola_integrators::internal::check_run(field.dimension(), state, end)?;
        let mut values = state.values.clone();
        begin(events, state)?;
        self.run(field, state, end, None, &mut |step| {
            if !events.is_empty()
                && let Some(stop) = locate(step, events, &mut values, &mut on_event)?
            {
                return Ok(ControlFlow::Break(stop));
            }
            Ok(stopped_by(observer(step)))
        })
    }
}
