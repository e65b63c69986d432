//! Spectral kernel: principal values and axes, polar decomposition, functions of tensors and their derivatives.
//!
//! | to get | use |
//! |---|---|
//! | eigenvalues and eigenvectors of a symmetric tensor | [`decompose`] |
//! | R, U, V, stretches, ln U, ln V of a deformation | [`StretchAnalysis`] |
//! | R, U and ln U together, with the machine's widest instructions | [`polar_hencky`] |
//! | √A, ln A, eᴬ, Aᵖ or any isotropic f(A) | [`tensor_function`] with [`SquareRoot`], [`Logarithm`], …, or your own [`IsotropicFunction`] |
//! | derivatives of f(A) | [`derivative`], [`second_derivative`], [`derivative_array`], or differentiable scalars |
//!
//! Everything runs over any scalar: floats, lanes, and differentiable numbers up to the fourth order. No step
//! divides by a gap between eigenvalues, so that coalescent and nearly coalescent ones are no special cases, of
//! derivatives either.

mod decomposition;
mod expansion;
pub(crate) mod frame;
mod functions;
mod isotropic;
mod orthogonal_images;
mod polar;
mod series;
mod stretch;
mod tensor_function;

#[cfg(feature = "serde")]
pub(crate) use decomposition::check_principal;
pub use decomposition::{SpectralDecomposition, decompose};
pub use functions::{Exponential, Logarithm, Power, SquareRoot};
pub use isotropic::IsotropicFunction;
pub use polar::{PolarHencky, polar_hencky};
pub use stretch::StretchAnalysis;
pub use tensor_function::{derivative, derivative_array, second_derivative, tensor_function};
