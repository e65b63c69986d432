//! The benches' own tests.

mod stability;
