//! Principal values and axes, isotropic functions of symmetric tensors, and their derivatives.
//!
//! | to get | use |
//! |---|---|
//! | eigenvalues and eigenvectors of a symmetric tensor | [`decompose`] |
//! | √A, ln A, eᴬ, Aᵖ or any isotropic f(A) | [`tensor_function`] with [`SquareRoot`], [`Logarithm`], …, or your own [`IsotropicFunction`] |
//! | the coefficients of an isotropic function of tensors in 1, A, A² | [`representation`] |
//! | derivatives of f(A) | [`derivative`], [`second_derivative`], [`derivative_array`], or differentiable scalars |
//!
//! Everything runs over any scalar: floats, lanes, and differentiable numbers up to the fourth order. No step
//! divides by a gap between eigenvalues, so that coalescent and nearly coalescent ones are no special cases, of
//! derivatives either.

pub(crate) mod decomposition;
pub(crate) mod expansion;
pub(crate) mod frame;
mod functions;
mod isotropic;
mod representation;
mod series;
mod tensor_function;

pub use decomposition::{SpectralDecomposition, decompose};
pub use functions::{Exponential, Logarithm, Power, SquareRoot};
pub use isotropic::IsotropicFunction;
pub use representation::{EigenvalueCase, Representation, representation};
pub use tensor_function::{derivative, derivative_array, second_derivative, tensor_function};
