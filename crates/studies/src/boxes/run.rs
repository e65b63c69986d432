//! Runs a study of fields on a box, whatever its dimension.

use super::checkpoint::{Body, BoxCheckpoint, Keeper};
use super::flow::FlowHistory;
use super::motion::MotionHistory;
use super::statics::StaticField;
use super::{BoxFields, BoxStudy, Task};
use crate::observer::outcome;
use crate::{Observer, Outcome, StudyCheckpointKeeper};

/// The results of a study of fields on a rectangle or a box.
///
/// # Example
/// See [`BoxStudy`](super::BoxStudy).
#[derive(Debug, Clone)]
pub enum BoxFindings {
    /// Two sides.
    Rectangle(Found<2>),
    /// Three sides.
    Box(Found<3>),
}

/// The results, by the task.
///
/// # Example
/// See [`BoxStudy`](super::BoxStudy).
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
        self.run_with_checkpoints(None, None, observer)
    }

    /// As [`run`](Self::run), from a checkpoint of this study or from its start, with checkpoints of motions and flows.
    ///
    /// A run from a checkpoint is bit for bit the run that was never stopped. With a checkpoint of another study, or one that was
    /// changed, the run fails.
    ///
    /// # Example
    /// ```
    /// use piola_spectral::{LameParameters, Walls};
    /// use piola_studies::StudyCheckpointKeeper;
    /// use piola_studies::boxes::{BoxCheckpoint, BoxFields, BoxFindings, BoxStudy, Form, Found, MotionTask, Start, Task};
    /// use std::ops::ControlFlow;
    /// struct Last(Option<BoxCheckpoint>);
    /// impl StudyCheckpointKeeper<BoxCheckpoint> for Last {
    ///     fn is_due(&mut self) -> bool {
    ///         true
    ///     }
    ///     fn keep(&mut self, checkpoint: &BoxCheckpoint) {
    ///         self.0 = Some(checkpoint.clone());
    ///     }
    /// }
    /// let form = Form::Mode { amplitudes: [1.0, 0.0], indices: [1, 0] };
    /// let (modes, starts) = ([1, 0], vec![Start { form, is_velocity: false }]);
    /// let task = Task::Motion(MotionTask { modes, density: 1.0, drag: 0.0, duration: 1.0, interval: 0.1, starts });
    /// let (sides, walls, lame) = ([1.0, 1.0], Walls::Sliding, LameParameters::new(2.0, 1.0)?);
    /// let study = BoxStudy::Rectangle(BoxFields { sides, walls, lame, loads: vec![], probes: vec![], task });
    /// let mut last = Last(None);
    /// // Stopped in the middle, then continued.
    /// let half = |part: f64| if part < 0.5 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
    /// study.run_with_checkpoints(None, Some(&mut last), &mut |part| half(part));
    /// let (continued, _) = study.run_with_checkpoints(last.0, None, &mut |_| ControlFlow::Continue(()));
    /// let (whole, _) = study.run(&mut |_| ControlFlow::Continue(()));
    /// let energies = |found: &BoxFindings| {
    ///     let BoxFindings::Rectangle(Found::Motion(motion)) = found else { panic!() };
    ///     motion.instants.iter().map(|at| at.kinetic_energy.to_bits()).collect::<Vec<_>>()
    /// };
    /// assert_eq!(energies(&continued), energies(&whole));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn run_with_checkpoints(
        &self,
        from: Option<BoxCheckpoint>,
        keeper: Option<&mut dyn StudyCheckpointKeeper<BoxCheckpoint>>,
        observer: &mut Observer<'_>,
    ) -> (BoxFindings, Outcome) {
        if let Some(Err(error)) = from.as_ref().map(|checkpoint| checkpoint.check(self)) {
            return (self.nothing(), Outcome::Failed(error.to_string()));
        }
        let from = from.map(BoxCheckpoint::into_body);
        match self {
            Self::Rectangle(fields) => {
                let (found, outcome) = fields.run(from, keeper, observer);
                (BoxFindings::Rectangle(found), outcome)
            }
            Self::Box(fields) => {
                let (found, outcome) = fields.run(from, keeper, observer);
                (BoxFindings::Box(found), outcome)
            }
        }
    }
}

impl BoxStudy {
    /// The results before the run.
    fn nothing(&self) -> BoxFindings {
        match self {
            Self::Rectangle(fields) => BoxFindings::Rectangle(fields.nothing()),
            Self::Box(fields) => BoxFindings::Box(fields.nothing()),
        }
    }
}

impl<const D: usize> BoxFields<D> {
    fn nothing(&self) -> Found<D> {
        match &self.task {
            Task::Static(task) => Found::Static(StaticField::of(task)),
            Task::Motion(task) => Found::Motion(MotionHistory::of(self, task)),
            Task::Flow(task) => Found::Flow(FlowHistory::of(task)),
        }
    }

    fn run(&self, from: Option<Body>, keeper: Keeper<'_>, observer: &mut Observer<'_>) -> (Found<D>, Outcome) {
        let mut found = self.nothing();
        let result = match (&mut found, &self.task) {
            (Found::Static(found), Task::Static(task)) => outcome(found.solve(self, task, observer)),
            (Found::Motion(found), Task::Motion(task)) => {
                let from = if let Some(Body::Motion(body)) = from { Some(body) } else { None };
                outcome(found.follow((self, task), (from, keeper), observer))
            }
            (Found::Flow(found), Task::Flow(task)) => {
                let from = if let Some(Body::Flow(body)) = from { Some(body) } else { None };
                outcome(found.follow((self, task), (from, keeper), observer))
            }
            // `nothing` is of the task.
            _ => Outcome::Completed,
        };
        (found, result)
    }
}
