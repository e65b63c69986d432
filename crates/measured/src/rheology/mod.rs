//! Fluids from viscometric measurements: tables in; flow curves with bands, or parameters of fluids, out.
//!
//! | stage | item |
//! |---|---|
//! | read | [`Measured::load`]: a CSV table with units, its geometry in comments; every mistake with its line |
//! | recover | [`recover`]: flow curves and normal stresses with bands, by [`piola_viscometry::recover`] |
//! | correct | [`recover_without_slip`], [`recover_without_ends`]: pipes of several radii, capillaries of several lengths |
//! | fit | [`compare`]: fluids on the same data, by [`piola_fit::fluids`] |
//! | write | [`Recovery::write`], [`Comparison::write`]: `summary.json`, CSV tables, a figure |
//!
//! ```text
//! # radius: 2 mm
//! pressure_gradient [kPa/m], discharge [mm^3/s]
//! 10, 125.3
//! ```

mod columns;
mod contained;
mod figure;
mod fluids;
mod geometry;
mod kind;
mod oilfield;
mod recovery;
mod recovery_output;
pub(crate) mod sweeps;
mod table;

#[cfg(any(feature = "history", feature = "nonlinear"))]
pub(crate) use fluids::parameter_in_words;
pub use fluids::{Comparison, FittedFluid, Request, compare, compare_until};
#[cfg(feature = "nonlinear")]
pub(crate) use fluids::{largest, rms};
pub use kind::{Answer, Answering, Flow, FlowKind};
pub use piola_fit::fluids::{FluidModel, Intervals, State, Weighting};
pub use piola_viscometry::recover::{Noise, Rise};
pub use recovery::{
    Correction, Function, Point, RecoveredCurve, Recovery, RecoveryRequest, recover, recover_without_ends,
    recover_without_slip,
};
pub use sweeps::{Hysteresis, Sweep};
pub use table::{Measured, Reading};
