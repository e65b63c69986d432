//! Fits of solids.

mod freedom;
mod recovery;
mod refusals;
mod rubber;
mod statistics;
mod ties;
mod told;
