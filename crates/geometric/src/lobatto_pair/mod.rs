//! Lobatto's pairs IIIA–IIIB of orders 2, 4, 6 and 8: symplectic, for fields in (q, p).
//!
//! Positions and momenta have their own coefficients on the same points, the ends of the step among them:
//!
//! ```text
//! q̇ = f(t, q, p)      Qᵢ = q + h Σⱼ aᵢⱼ f(Qⱼ, Pⱼ)      q ← q + h Σ bᵢ f(Qᵢ, Pᵢ)        IIIA
//! ṗ = g(t, q, p)      Pᵢ = p + h Σⱼ âᵢⱼ g(Qⱼ, Pⱼ)      p ← p + h Σ bᵢ g(Qᵢ, Pᵢ)        IIIB
//! bᵢ âᵢⱼ + bⱼ aⱼᵢ = bᵢ bⱼ
//! ```
//!
//! With s stages the order is 2s − 2. Order 2 is the Störmer–Verlet method, for Hamiltonians that do not separate too. Q₁ is the
//! start of the step and Q_s its end.
//!
//! # References
//! L. O. Jay, SIAM J. Numer. Anal. 33 (1996) 368; E. Hairer, C. Lubich & G. Wanner, *Geometric Numerical Integration*,
//! II.2.2, VI.4.
#![expect(clippy::doc_markdown, reason = "symbols with indices, as Q_s, are not code")]

mod equations;
mod gauss;
mod stepper;
mod tableau;

use core::ops::ControlFlow;

use piola_integrators::internal::{DIRECTIONS, check_step};
use piola_integrators::{
    Checkpoint, Field, IntegratorsError, Order, Report, State, Step, order_and_step, resumed_run, unobserved_run,
};
use piola_numerics::{Gradient, Real};

use self::equations::{Exact, FixedPoint, Jacobians};
pub use self::gauss::GaussCollocation;
use self::stepper::PairStepper;
pub use self::tableau::PairTableau;
use crate::kept::{Kept, checkpoint_of};

/// Lobatto's pair IIIA–IIIB with a fixed step, for fields y = (q, p) in two halves.
///
/// # Accuracy
/// Global error O(hᵒʳᵈᵉʳ). The stages are iterated until rounding stops them; the state is summed with compensation. The map
/// is symplectic where the field is Hamiltonian.
///
/// # Example
/// ```
/// use piola_geometric::LobattoPair;
/// use piola_integrators::{Order, State, field};
/// // q̇ = p, ṗ = −q by one step h = 1 of Störmer and Verlet: q + p h − q h²/2, then p − (q₀ + q₁) h/2.
/// let mut oscillator = field(2, |_t, y: &[f64], rate: &mut [f64]| rate.copy_from_slice(&[y[1], -y[0]]));
/// let mut state = State::new(0.0, vec![1.0, 0.0])?;
/// LobattoPair::new(Order::Two, 1.0)?.integrate_to(&mut oscillator, &mut state, 1.0)?;
/// assert!((state.values[0] - 0.5).abs() < 1e-15 && (state.values[1] + 0.75).abs() < 1e-15);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("Lobatto IIIA", "Lobatto IIIB", "partitioned Runge-Kutta", "Störmer", "Verlet"))]
#[derive(Clone, Debug)]
pub struct LobattoPair<T = f64> {
    order: Order,
    step: f64,
    stepper: PairStepper<T>,
}

impl<T: Real> LobattoPair<T> {
    /// The pair of the given order with steps no longer than `step` (s).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn new(order: Order, step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        Ok(Self { order, step, stepper: PairStepper::new(&PairTableau::lobatto(order)) })
    }

    order_and_step!();
    unobserved_run!(F: Field<T>, field: &mut F, IntegratorsError<F::Error>);

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step) by fixed-point iteration; backwards if `end` is
    /// earlier than the state's time. The observer sees every step and may stop the run.
    ///
    /// # Errors
    /// The state does not fit, its dimension is odd, the field fails or gives a rate that is not finite, or the stages do not
    /// converge ([`IntegratorsError::StagesDiverged`]: take a smaller step, or Newton's iteration). The state then stands at the
    /// last complete step.
    pub fn integrate<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.run(field, None, state, end, observer)
    }

    /// Integrates as [`integrate`](Self::integrate), by simplified Newton iteration with exact Jacobians, which converges where
    /// fixed-point iteration does not. Stability still bounds the step: a vibration ω needs |hω| < 2, 2.8, 3.1 or 6 for order 2,
    /// 4, 6 or 8. For faster vibrations take `RadauIia` of `piola-stiff`. The field must be generic over its scalar.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate), and a matrix that is singular or not finite.
    pub fn integrate_by_newton<F, E>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<E>>
    where
        F: Field<T, Error = E> + Field<Gradient<T, DIRECTIONS>, Error = E>,
    {
        self.run_by::<F, Exact>(field, None, state, end, observer)
    }

    checkpoint_of!(stepper, "LobattoPair");

    resumed_run!(<F> [F: Field<T>] field: &mut F, IntegratorsError<F::Error>);

    /// Continues a run of [`integrate_by_newton`](Self::integrate_by_newton), as [`resume`](Self::resume) continues one of
    /// [`integrate`](Self::integrate).
    ///
    /// # Errors
    /// As [`integrate_by_newton`](Self::integrate_by_newton) and [`resume`](Self::resume); [`IntegratorsError::WrongLength`] also for a
    /// checkpoint of the other iteration.
    pub fn resume_by_newton<F, E>(
        &mut self,
        field: &mut F,
        checkpoint: &Checkpoint<T>,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<E>>
    where
        F: Field<T, Error = E> + Field<Gradient<T, DIRECTIONS>, Error = E>,
    {
        self.run_by::<F, Exact>(field, Some(checkpoint), state, end, observer)
    }

    fn run<F: Field<T>>(
        &mut self,
        field: &mut F,
        resumed: Option<&Checkpoint<T>>,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.run_by::<F, FixedPoint>(field, resumed, state, end, observer)
    }

    fn run_by<F: Field<T>, K: Jacobians<F, T>>(
        &mut self,
        field: &mut F,
        resumed: Option<&Checkpoint<T>>,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        let n = field.dimension();
        if !n.is_multiple_of(2) {
            return Err(IntegratorsError::OddDimension { dimension: n });
        }
        self.stepper.run::<F, K>((Self::NAME, resumed, self.step), field, state, end, observer)
    }
}
