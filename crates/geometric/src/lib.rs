//! Time stepping that keeps what the motion keeps, over any scalar.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

mod discrete_gradient;
mod fixed_step;
mod kept;
mod lie_group;
mod lobatto_pair;
mod newton;
mod reversible;
mod variational;

pub use discrete_gradient::{DiscreteGradient, EnergySystem};
pub use lie_group::{
    AdaptiveMuntheKaas, CommutatorFree, DirectPower, DirectProduct, FunctionGroupField, GeneralisedAlpha, GroupField,
    GroupMotion, LieGroup, MuntheKaas, RigidMotions, Rotations, Translations, group_field,
};
pub use lobatto_pair::{GaussCollocation, LobattoPair};
pub use reversible::{ReversibleComposition, StepLength};
pub use variational::{
    ActionRule, Chord, DiscreteEulerLagrange, DiscreteLagrangian, VariationalIntegrator, VariationalSystem,
    momentum_map,
};

/// For tests: no part of the interface.
#[doc(hidden)]
pub mod internal {
    pub use crate::lobatto_pair::PairTableau;
    pub use crate::variational::ActionTableau;
}
