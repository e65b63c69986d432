//! Derivatives of the end of a run by its start and by parameters.
//!
//! ```text
//! ẏ = f(t, y, p),    y(t₀) = y₀        wanted: ∂y(t)/∂y₀,  ∂y(t)/∂p,  or the gradient of g(y(t₁), p) + ∫ ℓ(t, y, p) dt
//! ```
//!
//! # Which?
//! | wanted | type | evaluations a step, beside those of the run |
//! |---|---|---|
//! | every component by the start or by few parameters | [`ForwardSensitivity`] | s (n + m)/4, each with four derivatives |
//! | one number by many parameters | [`AdjointSensitivity`] | s products λᵀ ∂f/∂(y, p), and replayed steps |
//!
//! n is the number of components of y, m that of p, and s the number of stages: 12 for Dormand–Prince, 16 for Verner. A product
//! that the field gives itself costs about as much as an evaluation. The adjoint method then takes a time that does not grow with
//! m: 4 to 5 times that of the run in the example `sensitivities`, where 200 parameters take the forward method some hundred times
//! as long. The default product takes (n + m)/4 evaluations over numbers with four derivatives, and saves little over the forward
//! method.
//!
//! Other methods that are generic over their scalar, as [`GaussLegendre`](crate::GaussLegendre), differentiate their runs where the
//! start and the parameters are numbers with derivatives: [`Gradient`](piola_numerics::Gradient) for all directions at once.
//!
//! # Accuracy
//! Both differentiate the run that was made: its accepted steps, their lengths held fixed. The two therefore agree to rounding. From
//! the derivatives of the exact solution they differ by an error of the order of the method. The steps are chosen by the solution
//! alone, so that a derivative that varies faster than the solution needs a smaller tolerance.
//!
//! # References
//! Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, I.14; Griewank & Walther, *Evaluating Derivatives*,
//! 2nd ed., chapters 3 and 12; A. Sandu, *On the properties of Runge–Kutta discrete adjoints*, LNCS 3994 (2006) 550–557.

mod adjoint;
mod checkpoints;
mod forward;
mod matrices;
mod objective;
mod parametric;
mod product;
mod reversal;
mod stages;

pub use self::adjoint::AdjointSensitivity;
pub use self::forward::ForwardSensitivity;
pub use self::matrices::{Sensitivities, SensitivityInputs};
pub use self::objective::{Objective, ObjectiveGradient};
pub use self::parametric::{ParametricField, WithParameters};
pub use self::product::JacobianProduct;

use piola_numerics::{Gradient, Real};

use crate::IntegratorsError;
use crate::field::DIRECTIONS;
use crate::state::check_finite;

/// Numbers with derivatives in that many directions.
type Directional<T> = Gradient<T, DIRECTIONS>;

/// Refuses a wrong number of parameters, and parameters that are not finite.
fn check_parameters<T: Real, F: ParametricField>(field: &F, p: &[T]) -> Result<(), IntegratorsError<F::Error>> {
    check_length("parameters", field.parameters(), p.len())?;
    check_finite("parameters", None, p)
}

/// Refuses a length that differs from the one expected.
fn check_length<E>(quantity: &'static str, expected: usize, found: usize) -> Result<(), IntegratorsError<E>> {
    if expected == found { Ok(()) } else { Err(IntegratorsError::WrongLength { quantity, expected, found }) }
}
