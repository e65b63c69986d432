//! Tests of measurements: every bad table has a clear answer, every good one the right result.

mod fitting;
mod rheology;
