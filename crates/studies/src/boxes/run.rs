//! Runs a study of fields on a box, whatever its dimension.

use super::flow::FlowHistory;
use super::motion::MotionHistory;
use super::statics::StaticField;
use super::{BoxFields, BoxStudy, Task};
use crate::observer::outcome;
use crate::{Observer, Outcome};

/// The results of a study of fields on a rectangle or a box.
#[derive(Debug, Clone)]
pub enum BoxFindings {
    /// Two sides.
    Rectangle(Found<2>),
    /// Three sides.
    Box(Found<3>),
}

/// The results, with the study that they belong to.
#[derive(Debug, Clone)]
pub enum Found<const D: usize> {
    /// A displacement in equilibrium.
    Static(StaticField<D>),
    /// A motion of modes.
    Motion(MotionHistory<D>),
    /// A creeping flow.
    Flow(FlowHistory<D>),
}

impl BoxStudy {
    /// Runs the study: the results so far and how it ended. The observer gets the finished part, from 0 to 1, and may stop it.
    #[must_use]
    pub fn run(&self, observer: &mut Observer<'_>) -> (BoxFindings, Outcome) {
        match self {
            Self::Rectangle(fields) => {
                let (found, outcome) = fields.run(observer);
                (BoxFindings::Rectangle(found), outcome)
            }
            Self::Box(fields) => {
                let (found, outcome) = fields.run(observer);
                (BoxFindings::Box(found), outcome)
            }
        }
    }
}

impl<const D: usize> BoxFields<D> {
    fn run(&self, observer: &mut Observer<'_>) -> (Found<D>, Outcome) {
        match &self.task {
            Task::Static(task) => {
                let mut found = StaticField::of(task);
                let result = found.solve(self, task, observer);
                (Found::Static(found), outcome(result))
            }
            Task::Motion(task) => {
                let mut found = MotionHistory::of(self, task);
                let result = found.follow(self, task, observer);
                (Found::Motion(found), outcome(result))
            }
            Task::Flow(task) => {
                let mut found = FlowHistory::of(task);
                let result = found.follow(self, task, observer);
                (Found::Flow(found), outcome(result))
            }
        }
    }
}
