//! Fits: recovered parameters, statistics, ties and refusals.

#[cfg(feature = "fluids")]
mod fluids;
#[cfg(feature = "history")]
mod history;
#[cfg(all(feature = "history", feature = "nonlinear"))]
mod intervals;
#[cfg(feature = "nonlinear")]
mod nonlinear;
#[cfg(feature = "solids")]
mod sides;
#[cfg(feature = "solids")]
mod solids;
mod statistics;
