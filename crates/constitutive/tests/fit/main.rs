//! The tests of `piola_constitutive::fit`.
#![cfg(feature = "fit")]

mod freedom;
mod recovery;
mod refusals;
mod rubber;
mod statistics;
mod ties;
