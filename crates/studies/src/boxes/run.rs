//! Runs a study of fields on a box, whatever its dimension.

use super::checkpoint::{Body, BoxCheckpoint};
use super::flow::FlowHistory;
use super::motion::MotionHistory;
use super::statics::StaticField;
use super::{BoxFields, BoxStudy, Task};
use crate::observer::outcome;
use crate::{Observer, Outcome, StudyCheckpointKeeper};

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

/// Where the checkpoints of a run go.
pub(super) type Keeper<'k> = Option<&'k mut dyn StudyCheckpointKeeper<BoxCheckpoint>>;

impl BoxStudy {
    /// Runs the study: the results so far and how it ended. The observer gets the finished part, from 0 to 1, and may stop it.
    #[must_use]
    pub fn run(&self, observer: &mut Observer<'_>) -> (BoxFindings, Outcome) {
        self.run_with_checkpoints(None, None, observer)
    }

    /// As [`run`](Self::run), from a checkpoint of this study or from its start, with checkpoints of motions and flows.
    ///
    /// A run from a checkpoint is bit for bit the run that was never stopped. One of another study is refused by
    /// [`BoxCheckpoint::check`]; here it is passed over where its task is another one.
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

impl<const D: usize> BoxFields<D> {
    fn run(&self, from: Option<BoxCheckpoint>, keeper: Keeper<'_>, observer: &mut Observer<'_>) -> (Found<D>, Outcome) {
        let from = from.map(|checkpoint| checkpoint.body);
        match &self.task {
            Task::Static(task) => {
                let mut found = StaticField::of(task);
                let result = found.solve(self, task, observer);
                (Found::Static(found), outcome(result))
            }
            Task::Motion(task) => {
                let mut found = MotionHistory::of(self, task);
                let from = if let Some(Body::Motion(body)) = from { Some(body) } else { None };
                let result = found.follow((self, task), (from, keeper), observer);
                (Found::Motion(found), outcome(result))
            }
            Task::Flow(task) => {
                let mut found = FlowHistory::of(task);
                let from = if let Some(Body::Flow(body)) = from { Some(body) } else { None };
                let result = found.follow((self, task), (from, keeper), observer);
                (Found::Flow(found), outcome(result))
            }
        }
    }
}
