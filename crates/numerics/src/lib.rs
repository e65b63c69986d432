//! Scalars for mechanics: one formula over floats, exact derivatives and SIMD lanes.
//!
//! Everything in Piola is written over [`Real`]. This crate holds that trait and what follows from it:
//!
//! | to get | use |
//! |---|---|
//! | a derivative of a formula, exact to rounding | [`derivatives`], or [`Dual`], [`Gradient`], [`Jet`] directly |

mod differentiable;
mod dual;
mod gradient;
mod jet;
mod real;

pub use dual::Dual;
pub use gradient::Gradient;
pub use jet::Jet;
pub use real::{Mask, Real};
