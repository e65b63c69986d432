//! Time stepping for mechanics, over any scalar.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

mod accepted;
mod advice;
mod checkpoint;
mod collocation;
mod composition;
mod discrete_gradient;
mod dormand_prince;
mod error;
mod estimate;
mod events;
mod explicit;
mod field;
mod fixed_step;
mod gauss_legendre;
mod gauss_legendre_16;
mod gauss_radau_15;
mod legendre;
mod lie_group;
mod lobatto_pair;
mod newton;
mod nystrom;
mod radau_iia;
mod second_order;
mod sensitivity;
mod state;
mod stiff_field;
mod tolerance;
mod verner;

mod variational;

pub use advice::{Advice, AdvisedMethod, Character, advise};
pub use checkpoint::Checkpoint;
pub use composition::{Composition, Order};
pub use discrete_gradient::{DiscreteGradient, EnergySystem};
pub use dormand_prince::{DormandPrince853, DormandPrincePair};
pub use error::IntegratorsError;
pub use estimate::ErrorEstimate;
pub use events::{Crossing, Event, EventAction, Occurrence};
pub use explicit::{DenseStep, RungeKutta, RungeKuttaPair};
pub use field::{Field, FunctionField, Separable, SizedField, field, separable, sized_field};
pub use gauss_legendre::GaussLegendre;
pub use gauss_legendre_16::{CollocationStep, GaussLegendre16};
pub use gauss_radau_15::{GaussRadau15, GaussRadauStep};
pub use lie_group::{
    AdaptiveMuntheKaas, CommutatorFree, DirectPower, DirectProduct, FunctionGroupField, GeneralisedAlpha, GroupField,
    GroupMotion, LieGroup, MuntheKaas, RigidMotions, Rotations, Translations, group_field,
};
pub use lobatto_pair::LobattoPair;
pub use nystrom::{Nystrom, Nystrom86, Nystrom1210, NystromPair, NystromPair86, NystromPair1210, NystromStep};
pub use radau_iia::{RadauIia, RadauIiaStep, RadauOrder, RadauReport};
pub use second_order::SecondOrder;
pub use sensitivity::{
    AdjointSensitivity, ForwardSensitivity, JacobianProduct, Objective, ObjectiveGradient, ParametricField,
    Sensitivities, SensitivityInputs, WithParameters,
};
pub use state::{Ending, Report, State, Step, unobserved};
pub use stiff_field::{DifferenceJacobian, Differentiable, ExactJacobian, GivenJacobian, StiffField, WithMass};
#[cfg(feature = "sparse")]
pub use stiff_field::{SparseJacobian, Sparsity};
pub use tolerance::Tolerance;
pub use variational::{
    ActionRule, Chord, DiscreteEulerLagrange, DiscreteLagrangian, VariationalIntegrator, VariationalSystem,
    momentum_map,
};
pub use verner::{Verner98, VernerPair};

/// For tests, and for methods in other crates of Piola: no part of the interface.
#[doc(hidden)]
pub mod internal {
    pub use crate::explicit::RungeKuttaCoefficients;
    pub use crate::lobatto_pair::LobattoTableau;
    pub use crate::nystrom::NystromCoefficients;
    pub use crate::radau_iia::Tableau;
    pub use crate::state::{compensated_add, equal_steps};
    pub use crate::variational::ActionTableau;
}
