//! Tests of what studies compute, beside closed forms.

#[cfg(feature = "spectral")]
mod boxes;
mod fronts;
mod media;
mod samples;
