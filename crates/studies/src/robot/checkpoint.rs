//! A run of a robot that can be continued.

use piola_integrators::State;
use piola_multibody::{ClosedMotion, TreeMotion};
use piola_simulation::SimulationError;
use piola_simulation::internal::{Marks, Sealed};
use serde::{Deserialize, Serialize};

use super::RobotStudy;
use super::sample::RobotSample;

/// Steps after which a run begins anew from the state alone, so that it can be continued from there.
pub(super) const PIECE: u32 = 1000;

/// The state of an interrupted run of a robot, with the instants recorded so far.
///
/// # Example
/// See [`RobotStudy`].
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(transparent)]
pub struct RobotCheckpoint(pub(super) Sealed<RobotCheckpointBody>);

/// The state from which a run continues.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RobotCheckpointBody {
    pub(super) state: State,
    pub(super) samples: Vec<RobotSample>,
    pub(super) cost: [u64; 3],
    pub(super) singular_positions: Vec<(f64, String)>,
}

impl RobotCheckpoint {
    pub(super) fn new(robot: &RobotStudy, body: RobotCheckpointBody) -> Self {
        Self(Sealed::new(robot.marks(), body))
    }

    /// Time reached, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.0.body.state.time
    }

    /// Checks that the checkpoint is of this run and is as it was made.
    ///
    /// # Errors
    /// [`SimulationError`]: it is of another study or another version, or it was changed.
    pub fn check(&self, robot: &RobotStudy) -> Result<(), SimulationError> {
        self.0.check(robot.marks())
    }
}

impl RobotStudy {
    /// The marks of a run, by all that its record depends on: not by the paths of files, which may be spelled in several ways.
    fn marks(&self) -> Marks {
        let Self { closed, time, tolerance, samples, stops, start, drives, names, slip_rate, .. } = self;
        let asked = (time, tolerance, samples, stops);
        Marks::of_run(format_args!("{asked:?}{closed:?}{start:?}{drives:?}{names:?}{slip_rate:?}"))
    }
}

/// A motion that may remember more than its state.
pub(super) trait Renewable {
    /// Whether it may begin anew.
    fn is_apart(&self) -> bool;
    /// Forgets all but the state; the conditions that depended on others at positions passed since it did so before, with their times.
    fn renew(&mut self) -> Vec<(f64, usize)>;
}

impl<F> Renewable for TreeMotion<'_, F> {
    fn is_apart(&self) -> bool {
        true
    }
    fn renew(&mut self) -> Vec<(f64, usize)> {
        Vec::new()
    }
}

impl<F> Renewable for ClosedMotion<'_, F> {
    fn is_apart(&self) -> bool {
        Self::is_apart(self)
    }
    fn renew(&mut self) -> Vec<(f64, usize)> {
        let passed = self.singular_positions().iter().map(|position| (position.t, position.condition)).collect();
        self.restart();
        passed
    }
}
