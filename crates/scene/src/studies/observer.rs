//! What watches a run and may stop it.

use core::ops::ControlFlow;

#[cfg(any(feature = "solutions", feature = "spectral"))]
use crate::run::Outcome;

/// A function that gets the finished part of the run, 0 to 1, and may stop the run.
pub(super) type Observer<'o> = dyn FnMut(f64) -> ControlFlow<()> + 'o;

/// The end of a run whose steps may have failed.
#[cfg(any(feature = "solutions", feature = "spectral"))]
pub(super) fn outcome<E: core::fmt::Display>(result: Result<bool, E>) -> Outcome {
    match result {
        Ok(true) => Outcome::Completed,
        Ok(false) => Outcome::Interrupted,
        Err(error) => Outcome::Failed(error.to_string()),
    }
}
