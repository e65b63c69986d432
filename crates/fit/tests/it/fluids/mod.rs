//! Fits of fluids.

mod golden;
mod refusals;
mod statistics;
mod told;
mod torques;
