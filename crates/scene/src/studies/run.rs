//! Runs a study and writes what it found.

use core::fmt::Write as _;
use core::ops::ControlFlow;
use std::time::Instant;

use serde_json::{Map, Value, json};

use super::{Study, StudyPlan, Subject, room, wavefront};
use crate::SceneError;
use crate::run::{Checkpoints, Outcome};
use piola_charts::{Folder, Written};
use piola_studies::Observer;

/// The results of a study.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Findings {
    /// Fronts in a medium.
    Wavefront(wavefront::Fronts),
    /// Arrivals of a signal in a room.
    Room(room::Arrivals),
    /// Of a study of a solid.
    #[cfg(feature = "solutions")]
    Solid(super::SolidFindings),
    /// Fields on a rectangle or a box.
    #[cfg(feature = "spectral")]
    Box(Box<super::boxes::BoxFindings>),
    /// The motion of a tree of bodies.
    #[cfg(feature = "robots")]
    Robot(Box<super::robot::RobotMotion>),
}

/// A study that was run, however far it came.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct StudyRun {
    /// How it ended.
    pub outcome: Outcome,
    /// Wall time, s.
    pub wall_time: f64,
    /// The results.
    pub findings: Findings,
}

/// Runs a study. The observer gets the finished part of the run, from 0 to 1, and may stop it.
///
/// A run that fails or is stopped returns its results until then.
///
/// # Example
/// ```
/// use piola_scene::studies::{self, Findings};
/// use piola_scene::{Document, SceneFile};
/// let document = Document::parse("fronts.toml", "
///     [wavefront]
///     type = 'point'
///     length = 3.0
///     fronts = 1
///     [[medium]]
///     type = 'uniform'
///     index = 1.5
/// ");
/// let SceneFile::Study(study) = SceneFile::from_document(&document)? else { panic!() };
/// let run = studies::run(&study, |_| std::ops::ControlFlow::Continue(()));
/// let Findings::Wavefront(found) = &run.findings else { panic!() };
/// let [x, y] = found.fronts[0].pieces[0][0]; // a circle of radius 3/1.5
/// assert!((x - 2.0).abs() < 1e-12 && y.abs() < 1e-12);
/// # Ok::<(), piola_scene::SceneError>(())
/// ```
pub fn run(study: &Study, mut observer: impl FnMut(f64) -> ControlFlow<()>) -> StudyRun {
    begun(study, Before::Nothing, None, &mut observer)
}

/// Whether runs of a study leave checkpoints: those of a `[robot]` do, and those of a `[box]` that moves or flows. The others take seconds.
#[must_use]
pub fn has_checkpoints(study: &Study) -> bool {
    study.subject.has_checkpoints()
}

/// The time (s) of the checkpoint that a run before has left, if there is one.
///
/// # Errors
/// As [`run_with_checkpoints`].
pub fn checkpoint_time(study: &Study, checkpoints: &Checkpoints) -> Result<Option<f64>, SceneError> {
    Ok(Before::of(study, checkpoints)?.time())
}

/// As [`run`], with checkpoints in the folder of the results. With `resume` the run goes on from the last one, if there is one; its
/// time (s) is returned with the run.
///
/// # Errors
/// [`CheckpointError`](crate::CheckpointError) in a [`SceneError`]: the checkpoint cannot be read, or it is of another run.
pub fn run_with_checkpoints(
    study: &Study,
    resume: bool,
    checkpoints: &mut Checkpoints,
    mut observer: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<(StudyRun, Option<f64>), SceneError> {
    let from = if resume { Before::of(study, checkpoints)? } else { Before::Nothing };
    let time = from.time();
    Ok((begun(study, from, Some(checkpoints), &mut observer), time))
}

impl Subject {
    const fn has_checkpoints(&self) -> bool {
        match self {
            #[cfg(feature = "robots")]
            Self::Robot(_) => true,
            #[cfg(feature = "spectral")]
            Self::Box(fields) => fields.has_checkpoints(),
            _ => false,
        }
    }
}

/// The state from which a run continues.
enum Before {
    Nothing,
    #[cfg(feature = "robots")]
    Robot(Box<super::robot::RobotCheckpoint>),
    #[cfg(feature = "spectral")]
    Box(Box<super::boxes::BoxCheckpoint>),
}

impl Before {
    #[cfg_attr(
        not(any(feature = "robots", feature = "spectral")),
        expect(clippy::unnecessary_wraps, reason = "checkpoints are read with these features")
    )]
    fn of(study: &Study, checkpoints: &Checkpoints) -> Result<Self, SceneError> {
        #[cfg(feature = "robots")]
        if let Subject::Robot(robot) = &study.subject {
            let last = checkpoints.read(|last: &super::robot::RobotCheckpoint| last.check(robot))?;
            return Ok(last.map_or(Self::Nothing, |last| Self::Robot(Box::new(last))));
        }
        #[cfg(feature = "spectral")]
        if let Subject::Box(fields) = &study.subject {
            let last = checkpoints.read(|last: &super::boxes::BoxCheckpoint| last.check(fields))?;
            return Ok(last.map_or(Self::Nothing, |last| Self::Box(Box::new(last))));
        }
        let _ = (study, checkpoints);
        Ok(Self::Nothing)
    }

    fn time(&self) -> Option<f64> {
        match self {
            Self::Nothing => None,
            #[cfg(feature = "robots")]
            Self::Robot(checkpoint) => Some(checkpoint.time()),
            #[cfg(feature = "spectral")]
            Self::Box(checkpoint) => Some(checkpoint.time()),
        }
    }
}

fn begun(
    study: &Study,
    from: Before,
    checkpoints: Option<&mut Checkpoints>,
    mut observer: &mut Observer<'_>,
) -> StudyRun {
    let begun = Instant::now();
    #[cfg(not(any(feature = "robots", feature = "spectral")))]
    let _ = (from, checkpoints);
    let (findings, outcome) = match &study.subject {
        Subject::Wavefront(wavefront) => {
            let (found, outcome) = wavefront.run(&mut observer);
            (Findings::Wavefront(found), outcome)
        }
        Subject::Room(room) => {
            let (found, outcome) = room.run(&mut observer);
            (Findings::Room(found), outcome)
        }
        #[cfg(feature = "solutions")]
        Subject::Solid(solid) => {
            let (found, outcome) = solid.run(&mut observer);
            (Findings::Solid(found), outcome)
        }
        #[cfg(feature = "spectral")]
        Subject::Box(fields) => {
            let from = if let Before::Box(checkpoint) = from { Some(*checkpoint) } else { None };
            let keeper = checkpoints.map(|keeper| keeper as &mut dyn piola_studies::StudyCheckpointKeeper<_>);
            let (found, outcome) = fields.run_with_checkpoints(from, keeper, &mut observer);
            (Findings::Box(Box::new(found)), outcome)
        }
        #[cfg(feature = "robots")]
        Subject::Robot(robot) => {
            let from = if let Before::Robot(checkpoint) = from { Some(*checkpoint) } else { None };
            let keeper = checkpoints.map(|keeper| keeper as &mut dyn piola_studies::StudyCheckpointKeeper<_>);
            let (found, outcome) = robot.run(from, keeper, &mut observer);
            (Findings::Robot(Box::new(found)), outcome)
        }
    };
    StudyRun { outcome, wall_time: begun.elapsed().as_secs_f64(), findings }
}

impl StudyRun {
    fn results(&self) -> Map<String, Value> {
        let results = match &self.findings {
            Findings::Wavefront(found) => wavefront::results(found),
            Findings::Room(found) => room::results(found),
            #[cfg(feature = "solutions")]
            Findings::Solid(found) => found.results(),
            #[cfg(feature = "spectral")]
            Findings::Box(found) => super::boxes::results(found),
            #[cfg(feature = "robots")]
            Findings::Robot(found) => super::robot::results(found),
        };
        if let Value::Object(map) = results { map } else { Map::new() }
    }

    /// `summary.json`.
    #[must_use]
    pub fn summary(&self, plan: &StudyPlan) -> String {
        let (status, failure) = match &self.outcome {
            Outcome::Completed => ("completed", None),
            Outcome::Interrupted => ("interrupted", None),
            Outcome::Failed(why) => ("failed", Some(why)),
        };
        let mut summary = json!({
            "name": plan.name,
            "status": status,
            "system": plan.system,
            "method": plan.method,
            "method_reason": plan.reason,
            "wall_time_s": self.wall_time,
            "results": self.results(),
            "skipped": plan.skipped,
        });
        if let Some(why) = failure {
            summary["failure"] = why.as_str().into();
        }
        // Numbers that are not finite are null: nothing here can fail to serialise.
        let mut text = serde_json::to_string_pretty(&summary).unwrap_or_default();
        text.push('\n');
        text
    }

    /// The short table at the end of a run.
    #[must_use]
    pub fn table(&self, study: &Study, plan: &StudyPlan) -> String {
        let title = study.title.as_deref().unwrap_or(&study.name);
        let mut text = String::new();
        let _ = writeln!(text, "{title}: {}\n{}, {:.3} s\n{}\n", plan.system, plan.method, self.wall_time, plan.reason);
        for (name, value) in self.results() {
            match value {
                // Lists are in the tables.
                Value::Array(items) if items.iter().any(|item| item.is_object() || item.is_array()) => {
                    let _ = writeln!(text, "{:<52}{}", name.replace('_', " "), items.len());
                }
                Value::Object(map) => {
                    for (inner, value) in map {
                        let _ = writeln!(text, "{:<52}{value}", format!("{name}: {inner}").replace('_', " "));
                    }
                }
                value => {
                    let _ = writeln!(text, "{:<52}{value}", name.replace('_', " "));
                }
            }
        }
        text.push('\n');
        text
    }

    /// Writes everything that the plan lists.
    #[must_use]
    pub fn write(&self, folder: &Folder, study: &Study, plan: &StudyPlan) -> Written {
        let title = study.title.as_deref().unwrap_or(&study.name);
        let file = |name: &str| match (&self.findings, &study.subject) {
            _ if name == "summary.json" => Some(self.summary(plan)),
            (Findings::Wavefront(found), Subject::Wavefront(asked)) => wavefront::file(found, asked, title, name),
            (Findings::Room(found), Subject::Room(asked)) => room::file(found, asked, title, name),
            #[cfg(feature = "solutions")]
            (Findings::Solid(found), Subject::Solid(asked)) => found.file(asked, title, name),
            #[cfg(feature = "spectral")]
            (Findings::Box(found), Subject::Box(_)) => super::boxes::file(found, title, name),
            #[cfg(feature = "robots")]
            (Findings::Robot(found), Subject::Robot(asked)) => super::robot::file(found, asked, title, name),
            _ => None,
        };
        Written::of(folder, plan.files.iter().filter_map(|name| Some((name.as_str(), file(name)?))))
    }
}
