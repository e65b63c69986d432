//! A run of a robot that can be continued.

use piola_integrators::State;
use piola_multibody::{ClosedMotion, TreeMotion};
use piola_simulation::internal::Marks;
use serde::{Deserialize, Serialize};

use super::RobotStudy;
use super::sample::RobotSample;
use crate::SceneError;
use crate::run::Checkpoints;

/// Steps after which a run begins anew from the state alone, so that it can be continued from there.
pub(super) const PIECE: u32 = 1000;

/// A run where it begins anew, with what it has recorded.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::studies) struct RobotCheckpoint {
    pub(super) marks: Marks,
    pub(super) state: State,
    pub(super) samples: Vec<RobotSample>,
    pub(super) cost: [u64; 3],
    pub(super) singular_positions: Vec<(f64, String)>,
}

impl RobotCheckpoint {
    /// Time reached, s.
    pub(in crate::studies) fn time(&self) -> f64 {
        self.state.time
    }
}

impl RobotStudy {
    pub(super) fn marks(&self) -> Marks {
        Marks::of_run(format_args!("{self:?}"))
    }

    /// The checkpoint that a run before has left.
    pub(in crate::studies) fn last(&self, checkpoints: &Checkpoints) -> Result<Option<RobotCheckpoint>, SceneError> {
        checkpoints.read(|checkpoint: &RobotCheckpoint| checkpoint.marks.check(self.marks()))
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
