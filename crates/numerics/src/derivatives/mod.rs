//! Derivatives of a formula, exact to rounding, by evaluating it over differentiable numbers.
//!
//! A formula is a type with one generic method, because a closure cannot be generic:
//!
//! ```
//! use piola_numerics::{Real, derivatives::{self, ScalarFunction}};
//!
//! /// V(x, y) = ½ k (x² + y²) of a spring.
//! struct Spring { stiffness: f64 }
//!
//! impl ScalarFunction for Spring {
//!     fn call<T: Real>(&self, x: &[T]) -> T {
//!         T::lit(0.5 * self.stiffness) * (x[0] * x[0] + x[1] * x[1])
//!     }
//! }
//!
//! let spring = Spring { stiffness: 3.0 };
//! assert_eq!(derivatives::gradient(&spring, &[1.0, 2.0])?.as_slice(), [3.0, 6.0]);
//! assert_eq!(derivatives::hessian(&spring, &[1.0, 2.0])?.as_slice(), [3.0, 0.0, 0.0, 3.0]);
//! # Ok::<(), piola_numerics::NumericsError>(())
//! ```
//!
//! | f | to get | use | passes over f |
//! |---|---|---|---|
//! | ℝ → ℝ | f, f′ | [`first_derivative`] | 1 |
//! | | f, f′, f″ | [`second_derivative`] | 1 |
//! | ℝⁿ → ℝ | ∇f | [`gradient`], [`gradient_into`] | n/D |
//! | | v·∇f and v·(∇²f)v | [`directional`] | 1 |
//! | | u·(∇²f)v | [`mixed`] | 1 |
//! | | (∇²f)v | [`hessian_vector_product_into`] | n/D |
//! | | ∇²f | [`hessian`], [`hessian_into`] | ½ (n/D)² |
//! | ℝⁿ → ℝᵐ | ∇f, the m×n matrix ∂fᵢ/∂xⱼ | [`jacobian`], [`jacobian_into`] | n/D |
//! | | (∇f)v | [`jacobian_vector_product_into`] | 1 |
//!
//! D is the number of directions taken at once, a constant of [`Workspace`]; each pass costs about 1 + D
//! evaluations, so that a gradient costs about n + n/D of them. Functions ending in `_into` write to the
//! caller's memory and never allocate. Points may be any [`Real`]: over lanes the derivatives of many points
//! come at once.
//!
//! # Errors
//! Every function refuses a vector of the wrong length ([`NumericsError::WrongLength`](crate::NumericsError::WrongLength)), an
//! argument that is not finite, and a result that is not, because the formula has no derivative there
//! ([`NumericsError::NotFinite`](crate::NumericsError::NotFinite) with the name and index).
//!
//! # Accuracy
//! That of the formula's own operations: a few ulp × the condition number. There is no step width and no
//! truncation.

mod several;
mod univariate;
mod workspace;

pub use several::{
    directional, gradient, gradient_into, hessian, hessian_into, hessian_vector_product_into, jacobian, jacobian_into,
    jacobian_vector_product_into, mixed,
};
pub use univariate::{first_derivative, second_derivative};
pub use workspace::Workspace;

use crate::Real;

/// A formula of one variable, f: ℝ → ℝ.
pub trait UnivariateFunction {
    /// f(x).
    fn call<T: Real>(&self, x: T) -> T;
}

/// A formula of several variables, f: ℝⁿ → ℝ.
pub trait ScalarFunction {
    /// f(x).
    fn call<T: Real>(&self, x: &[T]) -> T;
}

/// A formula with several values, f: ℝⁿ → ℝᵐ.
pub trait VectorFunction {
    /// m, the number of values for n = `variables`.
    fn values(&self, variables: usize) -> usize;
    /// Writes f(x) to `out`, which has m entries.
    fn call<T: Real>(&self, x: &[T], out: &mut [T]);
}
