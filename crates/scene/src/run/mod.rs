//! Runs a planned scene and keeps its history.

mod comparison;

use core::ops::ControlFlow;
use std::time::Instant;

use piola_simulation::motion::{MotionRun, simulate};

pub use comparison::{BodyErrors, ErrorAt, Errors};
pub use piola_simulation::Outcome;
pub use piola_simulation::motion::{Drift, DriftAt, Drifts, History, Invariants, Progress, Scaled};

use crate::model::Scene;
use crate::plan::{self, Plan};

/// A run with all that it recorded, however far it came.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Run {
    /// How it ended.
    pub outcome: Outcome,
    /// Time reached, s.
    pub time: f64,
    /// Accepted steps.
    pub steps: u64,
    /// Steps tried and rejected.
    pub rejected: u64,
    /// Evaluations of the forces.
    pub force_evaluations: u64,
    /// Wall time of the integration with its recording, s.
    pub wall_time: f64,
    /// The record.
    pub history: History,
    /// Drift of the invariants.
    pub drifts: Drifts,
    /// Errors against the reference, when there is one.
    pub errors: Option<Errors>,
}

/// Runs a scene as planned. The observer sees the progress after every step and may stop the run.
///
/// A run that fails or is stopped returns what it recorded until then.
///
/// # Example
/// ```
/// use piola_scene::{Document, Plan, Scene, run};
/// let document = Document::parse("orbit.toml", "
///     [central]
///     gm = 1.0
///     [[body]]
///     name = 'comet'
///     semi_major_axis = 1.0
///     eccentricity = 0.5
///     [time]
///     revolutions = 1
///     [reference]
///     closed_form = 'kepler'
/// ");
/// let scene = Scene::from_document(&document)?;
/// let run = run::run(&scene, &Plan::of(&scene), |_| std::ops::ControlFlow::Continue(()));
/// assert!(run.errors.unwrap().largest_relative < 1e-11);
/// # Ok::<(), piola_scene::SceneError>(())
/// ```
pub fn run(scene: &Scene, plan: &Plan, mut observer: impl FnMut(Progress) -> ControlFlow<()>) -> Run {
    observed(scene, plan, &mut observer)
}

/// The same for any observer: whoever calls `run` compiles none of it again.
fn observed(scene: &Scene, plan: &Plan, observer: &mut dyn FnMut(Progress) -> ControlFlow<()>) -> Run {
    let begun = Instant::now();
    let run = simulate(&scene.system, plan.method, &plan::timetable(scene), observer);
    let wall_time = begun.elapsed().as_secs_f64();
    let MotionRun { outcome, time, steps, rejected, force_evaluations, history, .. } = run;
    let drifts = history.drifts();
    let errors = comparison::errors(scene, &history);
    Run { outcome, time, steps, rejected, force_evaluations, wall_time, history, drifts, errors }
}
