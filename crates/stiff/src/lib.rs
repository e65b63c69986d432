//! Implicit Runge-Kutta methods for stiff and constrained systems.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

mod radau_iia;
mod stiff_field;

pub use radau_iia::{RadauCheckpoint, RadauIia, RadauIiaStep, RadauOrder, RadauReport};
pub use stiff_field::{DifferenceJacobian, Differentiable, ExactJacobian, GivenJacobian, StiffField, WithMass};

#[cfg(feature = "sparse")]
pub use stiff_field::{SparseJacobian, Sparsity};

/// For tests: no part of the interface.
#[doc(hidden)]
pub mod internal {
    pub use crate::radau_iia::Tableau;
}
