//! Elastic and viscous-fluid registration of images in two and three dimensions.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod alignment;
mod elastic;
mod error;
mod field;
mod fluid;
mod grid;
mod image;
mod inverse;
mod jacobian;
mod map;
mod measure;
mod model;
mod operator;
mod parallel;
mod pyramid;
mod registration;
mod sampler;
mod step;

pub use error::RegistrationError;
pub use grid::ImageGrid;
pub use image::Image;
pub use map::DisplacementMap;
pub use measure::SimilarityMeasure;
pub use model::RegistrationModel;
pub use piola_spectral::Precision;
pub use registration::{LevelReport, Registered, Registration, RegistrationEnding, RegistrationProgress};
pub use sampler::{ImageSampler, Interpolant};
