//! Time stepping for mechanics, over any scalar.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

mod accepted;
mod advice;
mod checkpoint;
mod collocation;
mod composition;
mod dormand_prince;
mod error;
mod estimate;
mod events;
mod explicit;
mod field;
mod gauss_legendre;
mod gauss_legendre_16;
mod gauss_radau_15;
mod legendre;
mod nystrom;
mod order;
mod processed;
mod report;
mod second_order;
mod sensitivity;
mod splitting;
mod state;
mod tolerance;
mod turning_frame;
mod verner;

pub use advice::{Advice, AdvisedMethod, Character, advise};
pub use checkpoint::Checkpoint;
pub use composition::Composition;
pub use dormand_prince::{DormandPrince853, DormandPrincePair};
pub use error::IntegratorsError;
pub use estimate::ErrorEstimate;
pub use events::{Crossing, Event, EventAction, Occurrence};
pub use explicit::{DenseStep, RungeKutta, RungeKuttaPair};
pub use field::{Field, FunctionField, Separable, SizedField, field, separable, sized_field};
pub use gauss_legendre::GaussLegendre;
pub use gauss_legendre_16::{CollocationStep, GaussLegendre16};
pub use gauss_radau_15::{GaussRadau15, GaussRadauStep};
pub use nystrom::{Nystrom, Nystrom86, Nystrom1210, NystromPair, NystromPair86, NystromPair1210, NystromStep};
pub use order::Order;
pub use processed::ProcessedSplitting;
pub use report::{Ending, Report, Step, unobserved};
pub use second_order::SecondOrder;
pub use sensitivity::{
    AdjointSensitivity, ForwardSensitivity, JacobianProduct, Objective, ObjectiveGradient, ParametricField,
    Sensitivities, SensitivityInputs, WithParameters,
};
pub use splitting::{SplittingScheme, SplittingStage};
pub use state::State;
pub use tolerance::Tolerance;
pub use turning_frame::TurningFrame;
pub use verner::{Verner98, VernerPair};

/// For tests, and for the methods of other crates of Piola: no part of the interface.
#[doc(hidden)]
pub mod internal {
    pub use crate::accepted::AcceptedStep;
    pub use crate::dormand_prince::coefficients as dormand_prince;
    pub use crate::estimate::differences;
    pub use crate::events::{Interpolated, Stop, begin, locate, stopped_by};
    pub use crate::explicit::{EmbeddedPair, Limits, RungeKuttaCoefficients, follow};
    pub use crate::field::{DIRECTIONS, largest_lane, magnitudes_of_blocks};
    pub use crate::nystrom::NystromCoefficients;
    pub use crate::state::{
        carry_of_time, check_finite, check_longest, check_run, check_step, check_sums, compensated_add, equal_steps,
        state_of,
    };
}
