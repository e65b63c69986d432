//! The benches' own tests.

mod constitutive;
mod error_bars;
mod stability;
