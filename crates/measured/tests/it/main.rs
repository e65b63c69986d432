//! Tests of measurements: every bad table has a clear answer, every good one the right result.

mod figures;
mod fits;
mod fitting;
mod layouts;
mod newtonian;
mod rheology;
