//! The benches' own tests.

mod constitutive;
mod stability;
