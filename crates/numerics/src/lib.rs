//! Scalars for mechanics: one formula over floats, exact derivatives and SIMD lanes.
//!
//! Everything in Piola is written over [`Real`]. This crate holds that trait and what follows from it:
//!
//! | to get | use |
//! |---|---|
//! | a derivative of a formula, exact to rounding | [`derivatives`], or [`Dual`], [`Gradient`], [`Jet`] directly |
//! | its gradient and each second derivative once, in up to seven variables | [`Hessian`] |
//! | the change of a formula between two close points, without cancellation | [`Secant`] |
//! | several points at once, in the lanes of one scalar | [`Lanes`], run by [`dispatch`] |
//! | a linear system solved over any scalar, with the reason when it cannot be | [`linear`] |
//! | integrals of functions of one variable, with their errors | [`quadrature`] |
//! | a sum, dot product or state update without rounding loss | [`sums`] |

pub mod derivatives;
mod differentiable;
mod dispatch;
mod dual;
mod elementary;
mod error;
mod excess;
mod gradient;
mod jet;
mod lanes;
mod lanewise;
pub mod linear;
#[cfg(feature = "num-dual")]
mod num_dual;
mod outlined;
mod parameters;
mod prefetch;
pub mod quadrature;
mod real;
mod secant;
mod second_derivatives;
pub mod sums;

pub use dispatch::{Kernel, LaneKernel, Level, dispatch, dispatch_at, dispatch_lanes};
pub use dual::Dual;
pub use error::NumericsError;
pub use gradient::Gradient;
pub use jet::Jet;
pub use lanes::{Element, LaneMask, Lanes};
pub use real::{Mask, Real};
pub use secant::{Secant, SecantMask};
pub use second_derivatives::Hessian;

/// For the other crates of Piola alone: no part of the interface.
#[doc(hidden)]
pub mod internal {
    pub use crate::excess::{excess_of_exponential, excess_over_given, excess_over_logarithm, volume_excess};
    pub use crate::lanewise::Lanewise;
    pub use crate::linear::independent_rows::IndependentRows;
    pub use crate::linear::vectors::{dot, size, zeros};
    pub use crate::outlined::outlined;
    pub use crate::prefetch::{prefetch, prefetch_for_writing};
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;
