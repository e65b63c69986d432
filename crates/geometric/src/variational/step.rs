//! One step in position–momentum form, for any discrete action.

use piola_integrators::internal::{check_finite, check_sums, compensated_add, largest_lane};
use piola_integrators::{IntegratorsError, State};
use piola_numerics::Real;

use crate::kept::{Kept, Visitor};
use crate::newton::{Equations, Newton};

/// A discrete action A(q₀, U) of the start q₀ and of the increments U₁ … Uₛ of the nodes after it, Uₛ = q₁ − q₀, with forces.
///
/// With A held as a function of U the equations are
///
/// ```text
/// 0 = ∂A/∂Uⱼ + forces (j < s)        p₀ = ∂A/∂Uₛ − ∂A/∂q₀ + forces        p₁ − p₀ = ∂A/∂q₀ + forces
/// ```
pub(super) trait DiscreteAction<T: Real> {
    /// n.
    fn freedom(&self) -> usize;
    /// Writes the left-hand sides of the equations for U, n for each node, of which the last is p₀, and the impulse p₁ − p₀.
    fn equations(
        &mut self,
        start: &Start<'_, T>,
        u: &[T],
        out: &mut [T],
        impulse: &mut [T],
    ) -> Result<(), IntegratorsError>;
    /// Writes the derivatives of the left-hand sides with respect to U, down the columns.
    fn derivatives(&mut self, start: &Start<'_, T>, u: &[T], out: &mut [T]) -> Result<(), IntegratorsError>;
}

/// Where a step begins.
pub(super) struct Start<'a, T> {
    pub(super) q: &'a [T],
    pub(super) q_carry: &'a [T],
    pub(super) t: f64,
    pub(super) h: f64,
}

/// Memory of a run.
#[derive(Clone, Debug)]
pub(super) struct Stepper<T> {
    newton: Newton<T>,
    /// U₁ … Uₛ.
    increments: Vec<T>,
    impulse: Vec<T>,
    residual: Vec<T>,
}

struct PositionMomentum<'a, A, T> {
    action: &'a mut A,
    start: Start<'a, T>,
    p: &'a [T],
    p_carry: &'a [T],
    impulse: &'a mut [T],
}

impl<A: DiscreteAction<T>, T: Real> Equations<T> for PositionMomentum<'_, A, T> {
    type Error = core::convert::Infallible;

    fn residual(&mut self, x: &[T], residual: &mut [T]) -> Result<(), IntegratorsError> {
        self.action.equations(&self.start, x, residual, self.impulse)?;
        let n = self.p.len();
        let last = x.len() - n;
        for ((residual, &p), &carry) in residual[last..].iter_mut().zip(self.p).zip(self.p_carry) {
            *residual = (*residual - p) - carry;
        }
        check_finite("derivative of the action", Some(self.start.t), residual)
    }

    fn matrix(&mut self, x: &[T], matrix: &mut [T], _response: &mut [f64]) -> Result<(), IntegratorsError> {
        self.action.derivatives(&self.start, x, matrix)?;
        check_finite("jacobian", Some(self.start.t), matrix)
    }

    fn magnitudes(&self, x: &[T], magnitudes: &mut [f64]) {
        let largest = self.start.q.iter().chain(x).map(|&x| largest_lane(x)).fold(0.0, f64::max);
        magnitudes.fill(largest);
    }
}

impl<T: Real> Kept<T> for Stepper<T> {
    fn visit<V: Visitor<T>>(&mut self, visitor: &mut V) {
        visitor.values(&mut self.increments);
        self.newton.visit(visitor);
    }
}

impl<T: Real> Stepper<T> {
    pub(super) const fn new() -> Self {
        Self { newton: Newton::new(), increments: Vec::new(), impulse: Vec::new(), residual: Vec::new() }
    }

    /// Makes room for n coordinates.
    pub(super) fn begin(&mut self, n: usize, nodes: usize) {
        self.newton.begin(n * nodes, true);
        self.increments.clear();
        self.increments.resize(n * nodes, T::zero());
        self.residual.resize(n * nodes, T::zero());
        self.impulse.resize(n, T::zero());
    }

    /// Makes one step on the values of the state; returns the number of evaluations.
    pub(super) fn advance<A: DiscreteAction<T>>(
        &mut self,
        action: &mut A,
        state: &mut State<T>,
        h: f64,
    ) -> Result<u64, IntegratorsError> {
        let (n, t) = (action.freedom(), state.time);
        if n == 0 {
            return Ok(0);
        }
        let (q, p) = state.values.split_at_mut(n);
        let (q_carry, p_carry) = state.carry.split_at_mut(n);
        let start = Start { q, q_carry, t, h };
        let mut equations = PositionMomentum { action, start, p, p_carry, impulse: &mut self.impulse };
        let evaluations = self.newton.solve(&mut equations, &mut self.increments, (t, h))?;
        // The impulse of the solution: that of the last iteration belongs to the iterate before.
        equations.residual(&self.increments, &mut self.residual)?;
        check_finite("impulse", Some(t), &self.impulse)?;
        let last = self.increments.len() - n;
        check_sums(t, q, &self.increments[last..])?;
        check_sums(t, p, &self.impulse)?;
        for ((q, carry), &increment) in q.iter_mut().zip(q_carry).zip(&self.increments[last..]) {
            compensated_add(q, carry, increment);
        }
        for ((p, carry), &impulse) in p.iter_mut().zip(p_carry).zip(&self.impulse) {
            compensated_add(p, carry, impulse);
        }
        Ok(evaluations + 1)
    }
}
