//! Tests of what studies compute, beside closed forms.

mod fronts;
mod media;
mod samples;
