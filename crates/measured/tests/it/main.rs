//! Tests of measurements: every bad table has a clear answer, every good one the right result.

mod cards;
mod figures;
mod fits;
mod fitting;
mod fuzz;
#[cfg(feature = "history")]
mod history;
mod layouts;
mod newtonian;
#[cfg(feature = "nonlinear")]
mod nonlinear;
mod rheology;
mod sides;
mod spectra;
mod words;
