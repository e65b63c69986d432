//! What all accepted steps know: their number and their times.

use crate::IntegratorsError;
use crate::checkpoint::RunSoFar;

/// An accepted step in time.
#[derive(Clone, Copy, Debug)]
pub struct AcceptedStep {
    /// From 1.
    pub number: u64,
    /// The time at its start, s.
    pub start: f64,
    /// The time at its end, s.
    pub end: f64,
    /// Its length, negative where a run goes backwards, s; `end - start` but for rounding.
    pub length: f64,
    /// What a checkpoint needs beside the state and the method.
    pub(crate) progress: RunSoFar,
}

impl AcceptedStep {
    /// Of a method that makes no checkpoints.
    #[must_use]
    pub const fn new(number: u64, start: f64, end: f64, length: f64) -> Self {
        Self { number, start, end, length, progress: RunSoFar::unknown() }
    }

    /// The length of the next step to try, s.
    #[must_use]
    pub const fn next(self) -> f64 {
        self.progress.next
    }

    /// Whether a time lies within the step.
    #[must_use]
    pub fn contains(self, t: f64) -> bool {
        let (low, high) = if self.start <= self.end { (self.start, self.end) } else { (self.end, self.start) };
        low <= t && t <= high
    }

    /// The part of the step that is past at a time.
    #[must_use]
    pub fn part(self, t: f64) -> f64 {
        ((t - self.start) / self.length).clamp(0.0, 1.0)
    }

    /// Refuses a time outside the step, and a state to be written to `found` numbers where there are `expected`.
    ///
    /// # Errors
    /// What is refused.
    pub fn check<E>(self, t: f64, expected: usize, found: usize) -> Result<(), IntegratorsError<E>> {
        if found != expected {
            return Err(IntegratorsError::WrongLength { quantity: "out", expected, found });
        }
        if !self.contains(t) {
            return Err(IntegratorsError::OutsideStep { t, start: self.start, end: self.end });
        }
        Ok(())
    }

    /// Whether a time is that of the end.
    #[must_use]
    pub fn is_end(self, t: f64) -> bool {
        t.to_bits() == self.end.to_bits()
    }
}

/// The number and the times of a step that has them in its field `step`.
#[doc(hidden)]
#[macro_export]
macro_rules! number_and_times {
    () => {
        /// The number of the step, from 1.
        #[must_use]
        pub const fn number(&self) -> u64 {
            self.step.number
        }
        /// The time at its start, s.
        #[must_use]
        pub const fn start(&self) -> f64 {
            self.step.start
        }
        /// The time at its end, s.
        #[must_use]
        pub const fn time(&self) -> f64 {
            self.step.end
        }
        /// Whether a time lies within the step.
        #[must_use]
        pub fn contains(&self, t: f64) -> bool {
            self.step.contains(t)
        }
    };
}
