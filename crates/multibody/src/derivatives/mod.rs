//! Analytic derivatives of inverse and forward dynamics.
//!
//! Derivatives with respect to q are along the tangent space of v: δq is a displacement of
//! [`move_configuration`](crate::RigidTree::move_configuration).

mod columns;
mod dense;
mod forward;
mod inverse;

pub(crate) use columns::{gains_in_space, solve_columns};
pub use forward::AccelerationDerivatives;
pub(crate) use forward::differentiate_accelerations;
