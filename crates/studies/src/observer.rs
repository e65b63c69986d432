//! What watches a study and may stop it.

use core::ops::ControlFlow;

use piola_simulation::Outcome;

/// A function that gets the finished part of the study, 0 to 1, and may stop it.
pub type Observer<'o> = dyn FnMut(f64) -> ControlFlow<()> + 'o;

/// The end of a study whose steps may have failed.
pub(crate) fn outcome<E: core::fmt::Display>(result: Result<bool, E>) -> Outcome {
    match result {
        Ok(true) => Outcome::Completed,
        Ok(false) => Outcome::Interrupted,
        Err(error) => Outcome::Failed(error.to_string()),
    }
}
