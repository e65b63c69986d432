//! Exact solutions of nonlinear elasticity: universal deformations and motions, their loads, and their inversion.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

mod curve;
pub mod dynamics;
mod error;
pub mod families;
pub mod homogeneous;
mod integral;
mod law;
pub mod loads;
mod roots;
pub mod universality;

pub use curve::{CurvePoint, LoadCurve};
pub use error::SolutionsError;
pub use law::{LocalDeformation, ResponseFunctions};
