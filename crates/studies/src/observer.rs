//! What watches a study and may stop it.

use core::ops::ControlFlow;

use piola_simulation::Outcome;

/// A function that gets the finished part of the study, 0 to 1, and may stop it.
pub type Observer<'o> = dyn FnMut(f64) -> ControlFlow<()> + 'o;

/// Keeps checkpoints of a study: the last one is what counts.
pub trait StudyCheckpointKeeper<C> {
    /// Whether it is time for a checkpoint; asked where the study can go on from one.
    fn is_due(&mut self) -> bool;
    /// Keeps one.
    fn keep(&mut self, checkpoint: &C);
}

/// The end of a study whose steps may have failed.
pub(crate) fn outcome<E: core::fmt::Display>(result: Result<bool, E>) -> Outcome {
    match result {
        Ok(true) => Outcome::Completed,
        Ok(false) => Outcome::Interrupted,
        Err(error) => Outcome::Failed(error.to_string()),
    }
}
