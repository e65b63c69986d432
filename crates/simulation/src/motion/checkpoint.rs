//! A run at one of its steps, from which it can be continued.

use core::fmt::{self, Write};

use piola_integrators::{Checkpoint, Report, State};
use serde::{Deserialize, Serialize};

use super::{History, Method, System, Timetable};
use crate::SimulationError;

/// A run at the end of one of its steps, with all that it has recorded. Continued by [`resume`](super::resume), the run gives
/// the same record, to the last bit, as one that was never stopped.
///
/// Use a format of serde that keeps every digit of a number. JSON has no infinite numbers and no NaN: a checkpoint that holds
/// one is written, but cannot be read again. The run that made it would fail at its end.
///
/// # Example
/// See [`resume`](super::resume).
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(transparent)]
pub struct MotionCheckpoint(pub(super) Sealed<MotionCheckpointBody>);

/// The state of an interrupted run with the marks of that run, and a fingerprint that tells whether the state was changed.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sealed<B> {
    /// The marks of the run.
    pub marks: Marks,
    /// The fingerprint of the body.
    fingerprint: u64,
    /// The state from which a run continues.
    pub body: B,
}

/// The state from which a run continues.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MotionCheckpointBody {
    pub(super) stage: Stage,
    pub(super) report: Report,
    pub(super) steps: u64,
    pub(super) next: usize,
    pub(super) landing: usize,
    pub(super) history: History,
    /// The islands of a mechanism that are done.
    #[serde(default)]
    pub(super) done: Vec<Part>,
}

/// An island of a mechanism that was integrated, however far it came.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Part {
    pub(super) history: History,
    pub(super) report: Report,
    /// Time reached, s.
    pub(super) time: f64,
}

/// The version and the run that a checkpoint belongs to.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Marks {
    version: String,
    run: u64,
}

/// What a method goes on from.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) enum Stage {
    /// Of a method of fixed step.
    Fixed(State),
    /// Of an adaptive method.
    Adaptive(Checkpoint),
}

impl Marks {
    /// Of a run: the version of this crate, and a fingerprint of the system with its questions, the method and the instants.
    pub(super) fn of(system: &System, method: Method, timetable: &Timetable) -> Self {
        Self::of_run(format_args!("{system:?}{method:?}{timetable:?}"))
    }

    /// Of a run by a text in which all stands that it depends on.
    #[must_use]
    pub fn of_run(text: fmt::Arguments<'_>) -> Self {
        let run = Fingerprint::of(text);
        Self { version: env!("CARGO_PKG_VERSION").to_string(), run }
    }
}

impl Marks {
    fn check(&self, expected: Self) -> Result<(), SimulationError> {
        if self.version != expected.version {
            let (found, expected) = (self.version.clone(), expected.version);
            return Err(SimulationError::CheckpointOfOtherVersion { found, expected });
        }
        if self.run != expected.run {
            return Err(SimulationError::CheckpointOfOtherRun);
        }
        Ok(())
    }
}

/// The hash FNV-1a of a text, of 64 bits.
struct Fingerprint(u64);

impl Fingerprint {
    /// Of a text in which every field of some data stands, numbers with all their digits.
    fn of(text: fmt::Arguments<'_>) -> u64 {
        let mut fingerprint = Self(0xcbf2_9ce4_8422_2325);
        // A fingerprint takes any text.
        let _ = fingerprint.write_fmt(text);
        fingerprint.0
    }
}

impl Write for Fingerprint {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        Ok(())
    }
}

impl<B: fmt::Debug> Sealed<B> {
    /// Seals the state of a run.
    #[must_use]
    pub fn new(marks: Marks, body: B) -> Self {
        Self { marks, fingerprint: Fingerprint::of(format_args!("{body:?}")), body }
    }

    /// Checks that the state is of the run with these marks and is as it was made.
    ///
    /// # Errors
    /// [`SimulationError::CheckpointOfOtherVersion`], [`SimulationError::CheckpointOfOtherRun`],
    /// [`SimulationError::CheckpointChanged`].
    pub fn check(&self, expected: Marks) -> Result<(), SimulationError> {
        self.marks.check(expected)?;
        let Self { fingerprint, body, .. } = self;
        if *fingerprint != Fingerprint::of(format_args!("{body:?}")) {
            return Err(SimulationError::CheckpointChanged);
        }
        Ok(())
    }
}

impl MotionCheckpoint {
    pub(super) fn new(marks: Marks, body: MotionCheckpointBody) -> Self {
        Self(Sealed::new(marks, body))
    }

    /// Time reached, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        match &self.0.body.stage {
            Stage::Fixed(state) => state.time,
            Stage::Adaptive(checkpoint) => checkpoint.state().time,
        }
    }

    /// Checks that this version of Piola made the checkpoint, in a run of this system by this method at these instants, and that it
    /// is as it was made.
    ///
    /// # Errors
    /// [`SimulationError::CheckpointOfOtherVersion`], [`SimulationError::CheckpointOfOtherRun`],
    /// [`SimulationError::CheckpointChanged`].
    pub fn check(&self, system: &System, method: Method, timetable: &Timetable) -> Result<(), SimulationError> {
        self.0.check(Marks::of(system, method, timetable))
    }
}

/// Keeps the checkpoints of a run, for instance in a file.
///
/// # Example
/// See [`resume`](super::resume).
pub trait CheckpointKeeper {
    /// Whether a checkpoint is wanted now. An adaptive method asks after every step. A method of fixed step asks at every instant
    /// that is recorded, and after every thousand steps between two instants. A mechanism with constraints asks after a thousand steps,
    /// or where it is next apart from singular positions; one that stays beside such a position, as a linkage at rest there, does not
    /// ask again.
    fn is_due(&mut self) -> bool;
    /// Takes a checkpoint: one that is due, or the last one of a run that its observer stops. Of an adaptive method and of a closed
    /// form the last one is of the step at which the run stops. Of a method of fixed step it is of the last instant that was recorded
    /// or the last thousand steps, because the method begins anew there; of a mechanism with constraints, of the place where it last
    /// asked, or of the start.
    fn keep(&mut self, checkpoint: &MotionCheckpoint);
}
