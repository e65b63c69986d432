//! Time stepping for mechanics, over any scalar.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

mod composition;
mod dormand_prince;
mod error;
mod estimate;
mod field;
mod gauss_legendre;
mod gauss_legendre_16;
mod second_order;
mod state;
mod tolerance;

pub use composition::{Composition, Order};
pub use dormand_prince::{Crossing, DenseStep, DormandPrince853, Event, EventAction, Occurrence};
pub use error::IntegratorsError;
pub use estimate::ErrorEstimate;
pub use field::{Field, FunctionField, Separable, field, separable};
pub use gauss_legendre::GaussLegendre;
pub use gauss_legendre_16::{CollocationStep, GaussLegendre16};
pub use second_order::SecondOrder;
pub use state::{Ending, Report, State, Step, unobserved};
pub use tolerance::Tolerance;
