//! Gauss–Legendre collocation by simplified Newton iteration.

use core::ops::ControlFlow;

use piola_integrators::internal::{DIRECTIONS, check_step};
use piola_integrators::{
    Checkpoint, Field, IntegratorsError, Order, Report, State, Step, order_and_step, resumed_run, unobserved,
};
use piola_numerics::{Gradient, Real};

use super::equations::Exact;
use super::stepper::PairStepper;
use super::tableau::PairTableau;
use crate::kept::{Kept, checkpoint_of};

/// Gauss–Legendre collocation of orders 2, 4, 6 and 8 with a fixed step, whose stages simplified Newton iteration finds with exact
/// Jacobians.
///
/// For stiff oscillators: [`GaussLegendre`](piola_integrators::GaussLegendre) sweeps, which converges while |hω| is about one, and is
/// faster there. Fast linear vibrations do not limit the step. The method resolves the slow motion and keeps the amplitude of fast
/// vibrations, but their phase is wrong. The field must be generic over its scalar.
///
/// ```text
/// Yᵢ = y + Σⱼ μᵢⱼ Lⱼ        Lᵢ = h bᵢ f(t + cᵢh, Yᵢ)        y ← y + Σᵢ Lᵢ        μᵢⱼ + μⱼᵢ = 1
/// (1 − h bᵢ J(Yᵢ) μᵢⱼ) ΔL = −residual,   s·n equations
/// ```
///
/// # Accuracy
/// Global error O(hᵒʳᵈᵉʳ) where hω is small. The stages are iterated until rounding stops them; the state is summed with compensation.
/// The map is symplectic where the field is Hamiltonian, symmetric, and keeps all quadratic integrals.
///
/// # Example
/// ```
/// use core::convert::Infallible;
/// use piola_geometric::GaussCollocation;
/// use piola_integrators::{Field, Order, State};
/// use piola_numerics::Real;
/// struct Stiff; // q̈ = −10⁸ q: ten thousand radians a second
/// impl<T: Real> Field<T> for Stiff {
///     type Error = Infallible;
///     fn dimension(&self) -> usize {
///         2
///     }
///     fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
///         rate[0] = y[1];
///         rate[1] = -T::lit(1e8) * y[0];
///         Ok(())
///     }
/// }
/// let mut state = State::new(0.0, vec![1.0, 0.0])?;
/// GaussCollocation::new(Order::Four, 0.1)?.integrate_to(&mut Stiff, &mut state, 100.0)?; // hω = 1000
/// let energy = 0.5 * (state.values[1] * state.values[1] + 1e8 * state.values[0] * state.values[0]);
/// assert!((energy / 0.5e8 - 1.0).abs() < 1e-9);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
///
/// # References
/// E. Hairer, C. Lubich & G. Wanner, *Geometric Numerical Integration*, II.1.3, VIII.6.2.
#[doc(alias("implicit midpoint", "Newton", "stiff oscillator", "symplectic"))]
#[derive(Clone, Debug)]
pub struct GaussCollocation<T = f64> {
    order: Order,
    step: f64,
    stepper: PairStepper<T>,
}

impl<T: Real> GaussCollocation<T> {
    /// Collocation of the given order with steps no longer than `step` (s).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn new(order: Order, step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        Ok(Self { order, step, stepper: PairStepper::new(&PairTableau::gauss(order)) })
    }

    order_and_step!();

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step), unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<F, E>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
    ) -> Result<Report, IntegratorsError<E>>
    where
        F: Field<T, Error = E> + Field<Gradient<T, DIRECTIONS>, Error = E>,
    {
        self.integrate(field, state, end, unobserved)
    }

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step); backwards if `end` is earlier than the state's time. The
    /// observer sees every step and may stop the run.
    ///
    /// # Errors
    /// The state does not fit, the field fails or gives a rate or a derivative that is not finite, a matrix is singular, or the stages do
    /// not converge. The state then stands at the last complete step.
    pub fn integrate<F, E>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<E>>
    where
        F: Field<T, Error = E> + Field<Gradient<T, DIRECTIONS>, Error = E>,
    {
        self.run(field, None, state, end, observer)
    }

    checkpoint_of!(stepper, "GaussCollocation");

    resumed_run!(
        <F, E> [F: Field<T, Error = E> + Field<Gradient<T, DIRECTIONS>, Error = E>] field: &mut F, IntegratorsError<E>
    );

    fn run<F, E>(
        &mut self,
        field: &mut F,
        resumed: Option<&Checkpoint<T>>,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<E>>
    where
        F: Field<T, Error = E> + Field<Gradient<T, DIRECTIONS>, Error = E>,
    {
        self.stepper.run::<F, Exact>((Self::NAME, resumed, self.step), field, state, end, observer)
    }
}
