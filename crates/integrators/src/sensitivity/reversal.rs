//! One step of an explicit method backwards: the adjoint of its stages.

use piola_numerics::Real;

use super::stages::{Stages, StepTimes, add_to_row, scaled_row, stage};
use super::{JacobianProduct, Objective, ParametricField};
use crate::IntegratorsError;
use crate::explicit::RungeKuttaCoefficients;
use crate::state::{check_finite, compensated_add};

/// The gradient of an objective, on its way from the end of a run to its start.
///
/// ```text
/// Yᵢ = y + h Σⱼ aᵢⱼ kⱼ,   kᵢ = f(tᵢ, Yᵢ, p),   y₁ = y + h Σ bᵢ kᵢ
/// κᵢ = h (bᵢ λ₁ + Σⱼ aⱼᵢ vⱼ),   vᵢ = κᵢᵀ ∂f/∂y + h bᵢ ∂ℓ/∂y,   λ = λ₁ + Σ vᵢ,   μ = μ₁ + Σ (κᵢᵀ ∂f/∂p + h bᵢ ∂ℓ/∂p)
/// ```
///
/// with λ = ∂J/∂y and μ = ∂J/∂p.
#[derive(Clone, Debug)]
pub(super) struct Reversal<T> {
    pub(super) stages: Stages<T>,
    /// The state, and what rounding left of it.
    pub(super) y: Vec<T>,
    pub(super) y_carry: Vec<T>,
    /// J without the part of the integral before the present step.
    pub(super) value: T,
    value_carry: T,
    /// λ, μ and what rounding left of them.
    pub(super) lambda: Vec<T>,
    lambda_carry: Vec<T>,
    pub(super) mu: Vec<T>,
    mu_carry: Vec<T>,
    product: JacobianProduct<T>,
    /// κ/h, a row for each stage.
    kappa: Vec<T>,
    /// Σ vᵢ.
    change: Vec<T>,
}

impl<T: Real> Reversal<T> {
    pub(super) fn new() -> Self {
        let [y, y_carry, lambda, lambda_carry, mu, mu_carry, kappa, change] = [const { Vec::new() }; 8];
        let (value, value_carry) = (T::zero(), T::zero());
        let (stages, product) = (Stages::new(), JacobianProduct::empty());
        Self { stages, y, y_carry, value, value_carry, lambda, lambda_carry, mu, mu_carry, product, kappa, change }
    }

    /// Starts from the end of a run.
    pub(super) fn begin<P: RungeKuttaCoefficients, G: Objective>(&mut self, objective: &G, t: f64, y: &[T], p: &[T]) {
        let (n, m) = (y.len(), p.len());
        self.stages.resize::<P>(n);
        for memory in [&mut self.y, &mut self.y_carry, &mut self.change] {
            memory.resize(n, T::zero());
        }
        self.kappa.resize(P::END * n, T::zero());
        self.product.resize(n, m);
        self.product.clear_by_state();
        self.product.clear_by_parameters();
        (self.value, self.value_carry) = (objective.terminal(t, y, p), T::zero());
        self.product.add_of_scalar(y, p, T::one(), |y, p| objective.terminal(t, y, p));
        for (sum, carry, start) in [
            (&mut self.lambda, &mut self.lambda_carry, self.product.by_state()),
            (&mut self.mu, &mut self.mu_carry, self.product.by_parameters()),
        ] {
            sum.clear();
            sum.extend_from_slice(start);
            carry.clear();
            carry.resize(start.len(), T::zero());
        }
    }

    /// Makes a step again, forwards.
    pub(super) fn replay<P: RungeKuttaCoefficients, F: ParametricField>(
        &mut self,
        field: &F,
        p: &[T],
        times: StepTimes,
    ) -> Result<(), IntegratorsError<F::Error>> {
        self.stages.evaluate::<P, F>(field, p, times, (&self.y, &self.y_carry))?;
        self.stages.advance::<P>(times.length, &mut self.y, &mut self.y_carry);
        Ok(())
    }

    /// Takes the gradient from the end of a step to its start, where y is.
    pub(super) fn step<P: RungeKuttaCoefficients, F: ParametricField, G: Objective>(
        &mut self,
        field: &F,
        objective: &G,
        p: &[T],
        times: StepTimes,
    ) -> Result<(), IntegratorsError<F::Error>> {
        let y = (&self.y[..], &self.y_carry[..]);
        self.stages.evaluate::<P, F>(field, p, times, y)?;
        self.kappa.fill(T::zero());
        for &(i, b) in P::WEIGHTS {
            add_to_row(&mut self.kappa, i, b, &self.lambda);
        }
        self.change.fill(T::zero());
        self.product.clear_by_parameters();
        let mut integral = T::zero();
        for index in (0..=P::ROWS.len()).rev() {
            let (number, row) = stage::<P>(index);
            let t = times.stage::<P>(number);
            let argument = self.stages.argument::<P>(index, times.length, y);
            scaled_row(&self.kappa, number, times.length, self.product.covector_mut());
            self.product.clear_by_state();
            field
                .vector_jacobian_product(t, argument, p, &mut self.product)
                .map_err(|source| IntegratorsError::Field { t, source })?;
            let weight = P::WEIGHTS.iter().find(|&&(i, _)| i == number);
            if let (true, Some(&(_, b))) = (G::RUNNING, weight) {
                let weight = T::lit(times.length) * T::lit(b);
                integral += weight * objective.running(t, argument, p);
                objective.running_gradient(t, argument, p, weight, &mut self.product);
            }
            for &(j, a) in row {
                add_to_row(&mut self.kappa, j, a, self.product.by_state());
            }
            add_to_row(&mut self.change, 0, 1.0, self.product.by_state());
        }
        compensated_add(&mut self.value, &mut self.value_carry, integral);
        for (sum, carry, changes) in [
            (&mut self.lambda, &mut self.lambda_carry, &self.change[..]),
            (&mut self.mu, &mut self.mu_carry, self.product.by_parameters()),
        ] {
            for ((sum, carry), &change) in sum.iter_mut().zip(carry).zip(changes) {
                compensated_add(sum, carry, change);
            }
        }
        self.check(Some(times.start))
    }

    /// Refuses numbers that are not finite.
    pub(super) fn check<E>(&self, t: Option<f64>) -> Result<(), IntegratorsError<E>> {
        check_finite("objective", t, &[self.value])?;
        check_finite("gradient by start", t, &self.lambda)?;
        check_finite("gradient by parameters", t, &self.mu)
    }
}
