//! Objectives: numbers computed from a run, and their gradients.

use piola_numerics::Real;

use super::JacobianProduct;

/// A number that depends on a run: J = g(t₁, y(t₁), p) + ∫ ℓ(t, y, p) dt.
///
/// # Example
/// See [`AdjointSensitivity`](super::AdjointSensitivity).
#[doc(alias("cost function", "loss"))]
pub trait Objective {
    /// Whether ℓ differs from zero. The default is no, and then [`running`](Self::running) is not evaluated.
    const RUNNING: bool = false;
    /// g(t₁, y(t₁), p).
    fn terminal<T: Real>(&self, t: f64, y: &[T], p: &[T]) -> T;
    /// ℓ(t, y, p). The method's own weights integrate it over the steps of the run. The tolerance does not bound the error of this integral.
    fn running<T: Real>(&self, _t: f64, _y: &[T], _p: &[T]) -> T {
        T::zero()
    }
    /// Adds the weight times ∂ℓ/∂y and ∂ℓ/∂p to the sums of `product`, whose covector has no part in it.
    ///
    /// The default evaluates [`running`](Self::running) (n + m)/4 times over numbers with four derivatives.
    fn running_gradient<T: Real>(&self, t: f64, y: &[T], p: &[T], weight: T, product: &mut JacobianProduct<T>) {
        product.add_of_scalar(y, p, weight, |y, p| self.running(t, y, p));
    }
}

/// An objective and its gradient by the start of the run and by the parameters.
///
/// # Example
/// See [`AdjointSensitivity`](super::AdjointSensitivity).
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectiveGradient<T = f64> {
    /// J.
    pub value: T,
    /// ∂J/∂y₀, n components.
    pub by_start: Vec<T>,
    /// ∂J/∂p, m components.
    pub by_parameters: Vec<T>,
    /// The steps that were made again because their starts were not kept.
    pub replayed_steps: u64,
}

impl<T: Real> Default for ObjectiveGradient<T> {
    /// Memory to write to.
    fn default() -> Self {
        Self { value: T::zero(), by_start: Vec::new(), by_parameters: Vec::new(), replayed_steps: 0 }
    }
}
