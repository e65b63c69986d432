//! Variational integrators: the discrete Euler–Lagrange equations of a Lagrangian, of orders 2, 4, 6 and 8.
//!
//! The action of one step is approximated by a function of its ends, and made stationary:
//!
//! ```text
//! L_d(q₀, q₁) ≈ ∫ L(q, q̇, t) dt        p₀ = −D₁L_d(q₀, q₁),   p₁ = D₂L_d(q₀, q₁)
//! L_d = ext h Σ bᵢ L(Q(cᵢ), Q̇(cᵢ), tᵢ)   over polynomials Q of degree s with Q(0) = q₀, Q(1) = q₁
//! ```
//!
//! The state is (q, p). The equations for the nodes of Q are solved by Newton's iteration with exact second derivatives of L.
//! A force adds its virtual work Σ h bᵢ Fᵢ·δQᵢ (discrete principle of d'Alembert).
//!
//! # What is kept
//! Without forces the map is symplectic, and for every symmetry, a generator ξ with L(q + εξ, …) = L, the momentum
//! p·ξ(q) is constant if ξ is affine in q (Noether; see [`momentum_map`]), both to rounding at any step. The energy oscillates and
//! does not drift.
//!
//! # Which?
//! [`VariationalIntegrator`] for a Lagrangian: [`ActionRule::Lobatto`] of order 2 is the Störmer–Verlet method, and for
//! more accuracy [`ActionRule::Gauss`] of order 6 or 8. [`DiscreteEulerLagrange`] for an `L_d` of your own.
//!
//! # References
//! J. E. Marsden, M. West, *Discrete mechanics and variational integrators*, Acta Numerica 10 (2001) 357; S. Ober-Blöbaum,
//! N. Saake, *Construction and analysis of higher order Galerkin variational integrators*, Adv. Comput. Math. 41 (2015)
//! 955.

mod discrete;
mod galerkin;
pub(crate) mod rule;
mod step;
mod system;

use core::ops::ControlFlow;

use piola_integrators::internal::{check_finite, check_run, check_step};
use piola_integrators::{
    Checkpoint, IntegratorsError, Order, Report, State, Step, order_and_step, resumed_run, unobserved_run,
};
use piola_numerics::Real;

pub use self::discrete::{Chord, DiscreteEulerLagrange, DiscreteLagrangian};
use self::galerkin::{Memory, PolynomialAction, momenta};
pub use self::rule::{ActionRule, ActionTableau};
use self::step::Stepper;
pub use self::system::VariationalSystem;
use crate::fixed_step::take_equal_steps;
use crate::kept::{Kept, checkpoint_of};

/// The variational integrator of a Lagrangian, with a fixed step: Galerkin's method with Gauss's or Lobatto's quadrature.
///
/// # Accuracy
/// Global error O(hᵒʳᵈᵉʳ). The equations are iterated until rounding stops them; positions and momenta are summed with
/// compensation.
///
/// # Example
/// ```
/// use piola_geometric::{ActionRule, VariationalIntegrator, VariationalSystem, momentum_map};
/// use piola_integrators::Order;
/// use piola_numerics::Real;
/// struct Kepler;
/// impl VariationalSystem for Kepler {
///     fn freedom(&self) -> usize {
///         2
///     }
///     fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
///         T::lit(0.5) * (v[0] * v[0] + v[1] * v[1]) + (q[0] * q[0] + q[1] * q[1]).sqrt().recip()
///     }
/// }
/// let mut method = VariationalIntegrator::new(ActionRule::Gauss, Order::Six, 0.1)?;
/// let mut state = method.start(&Kepler, 0.0, &[1.0, 0.0], &[0.0, 1.2])?;
/// method.integrate_to(&Kepler, &mut state, 100.0)?;
/// // Rotations ξ = (−q₂, q₁): the angular momentum stays 1.2.
/// let (q, p) = state.values.split_at(2);
/// assert!((momentum_map(&[-q[1], q[0]], p)? - 1.2).abs() < 1e-14);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("Störmer", "Verlet", "discrete mechanics", "symplectic"))]
#[derive(Clone, Debug)]
pub struct VariationalIntegrator<T: Real = f64> {
    rule: ActionRule,
    order: Order,
    step: f64,
    tableau: ActionTableau,
    stepper: Stepper<T>,
    memory: Memory<T>,
}

impl<T: Real> VariationalIntegrator<T> {
    /// The integrator of a rule and an order with steps no longer than `step` (s).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn new(rule: ActionRule, order: Order, step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        let tableau = ActionTableau::new(rule, order);
        Ok(Self { rule, order, step, tableau, stepper: Stepper::new(), memory: Memory::new(0) })
    }

    /// The quadrature.
    #[must_use]
    pub const fn rule(&self) -> ActionRule {
        self.rule
    }

    order_and_step!();

    /// The state (q, p) with the momenta p = ∂L/∂v of velocities at a time.
    ///
    /// # Errors
    /// The positions or velocities do not fit or are not finite, or the momenta are not finite.
    pub fn start<S: VariationalSystem>(
        &mut self,
        system: &S,
        t: f64,
        q: &[T],
        v: &[T],
    ) -> Result<State<T>, IntegratorsError> {
        let expected = system.freedom();
        for (quantity, found) in [("q", q.len()), ("v", v.len())] {
            if found != expected {
                return Err(IntegratorsError::WrongLength { quantity, expected, found });
            }
        }
        check_finite("t", None, &[t])?;
        check_finite("q", None, q)?;
        check_finite("v", None, v)?;
        self.make_memory(expected);
        let mut values = q.to_vec();
        values.extend_from_slice(v);
        momenta(system, &mut self.memory, (q, v, t), &mut values[expected..])?;
        State::new(t, values)
    }

    unobserved_run!(S: VariationalSystem, system: &S, IntegratorsError);

    /// Integrates (q, p) to `end` in equal steps no longer than [`step`](Self::step); backwards if `end` is earlier than
    /// the state's time. The observer sees every step and may stop the run.
    ///
    /// # Errors
    /// The state does not fit or is not finite, a derivative of the Lagrangian is not finite, or the equations do not
    /// converge or have a singular matrix (a Lagrangian that is not regular): take a smaller step. The state then stands at
    /// the last complete step.
    pub fn integrate<S: VariationalSystem>(
        &mut self,
        system: &S,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError> {
        self.run(system, None, state, end, observer)
    }

    checkpoint_of!(stepper, "VariationalIntegrator");

    resumed_run!(<S> [S: VariationalSystem] system: &S, IntegratorsError);

    fn run<S: VariationalSystem>(
        &mut self,
        system: &S,
        resumed: Option<&Checkpoint<T>>,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError> {
        let n = system.freedom();
        self.make_memory(n);
        let (stepper, memory, tableau) = (&mut self.stepper, &mut self.memory, &self.tableau);
        stepper.begin(n, tableau.degree);
        let before = stepper.start(Self::NAME, resumed, state, |state| check_run(2 * n, state, end))?;
        take_equal_steps((before, self.step), state, end, observer, |state, h| {
            stepper.advance(&mut PolynomialAction { system, tableau, memory }, state, h)
        })
    }

    fn make_memory(&mut self, n: usize) {
        if self.memory.freedom() != n {
            self.memory = Memory::new(n);
        }
    }
}

/// The momentum p·ξ of a symmetry with the generator ξ(q), which variational integrators keep.
///
/// Of a translation ξ is the direction and p·ξ the linear momentum along it; of a rotation in the plane ξ = (−q₂, q₁), and
/// p·ξ is the angular momentum.
///
/// # Errors
/// [`IntegratorsError::WrongLength`].
///
/// # Example
/// ```
/// use piola_geometric::momentum_map;
/// let (q, p) = ([2.0, 0.0], [1.0, 3.0]);
/// assert_eq!(momentum_map(&[-q[1], q[0]], &p)?, 6.0);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("Noether", "conserved quantity"))]
pub fn momentum_map<T: Real>(generator: &[T], p: &[T]) -> Result<T, IntegratorsError> {
    piola_numerics::sums::compensated_dot(generator, p).map_err(|_| IntegratorsError::WrongLength {
        quantity: "p",
        expected: generator.len(),
        found: p.len(),
    })
}
