//! The loop over the points: memory of the caller, lanes, threads.

pub(crate) mod deformations;
pub(crate) mod destinations;
pub(crate) mod evaluation;
pub(crate) mod parts;
pub(crate) mod point;
mod records;
pub(crate) mod refusal;
pub(crate) mod request;
pub(crate) mod scalar;
pub(crate) mod sources;
pub(crate) mod tangents;
pub(crate) mod together;
pub(crate) mod views;
