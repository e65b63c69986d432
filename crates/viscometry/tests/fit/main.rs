//! Tests of `piola_viscometry::fit`.
#![cfg(feature = "fit")]

mod golden;
mod refusals;
mod statistics;
