//! Time stepping for mechanics, over any scalar.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

mod accepted;
mod collocation;
mod composition;
mod dormand_prince;
mod error;
mod estimate;
mod events;
mod field;
mod gauss_legendre;
mod gauss_legendre_16;
mod gauss_radau_15;
mod lie_group;
mod radau_iia;
mod second_order;
mod state;
mod stiff_field;
mod tolerance;

pub use composition::{Composition, Order};
pub use dormand_prince::{DenseStep, DormandPrince853};
pub use error::IntegratorsError;
pub use estimate::ErrorEstimate;
pub use events::{Crossing, Event, EventAction, Occurrence};
pub use field::{Field, FunctionField, Separable, field, separable};
pub use gauss_legendre::GaussLegendre;
pub use gauss_legendre_16::{CollocationStep, GaussLegendre16};
pub use gauss_radau_15::{GaussRadau15, GaussRadauStep};
pub use lie_group::{
    AdaptiveMuntheKaas, CommutatorFree, DirectPower, DirectProduct, FunctionGroupField, GeneralisedAlpha, GroupField,
    GroupMotion, LieGroup, MuntheKaas, RigidMotions, Rotations, Translations, group_field,
};
pub use radau_iia::{RadauIia, RadauIiaStep, RadauOrder, RadauReport};
pub use second_order::SecondOrder;
pub use state::{Ending, Report, State, Step, unobserved};
pub use stiff_field::{DifferenceJacobian, Differentiable, ExactJacobian, GivenJacobian, StiffField, WithMass};
pub use tolerance::Tolerance;

/// For tests, and for methods in other crates of Piola: no part of the interface.
#[doc(hidden)]
pub mod internal {
    pub use crate::radau_iia::Tableau;
    pub use crate::state::{compensated_add, equal_steps};
}
