//! Runs a planned scene and keeps its history.

mod answers;
mod checkpoints;
mod comparison;

use core::ops::ControlFlow;
use std::time::Instant;

use piola_simulation::motion::{MotionRun, resume, simulate, simulate_together};

pub use answers::Answers;
pub use checkpoints::Checkpoints;
pub use comparison::{BodyErrors, ErrorAt, Errors};
pub use piola_simulation::Outcome;
pub use piola_simulation::motion::TOGETHER;
pub use piola_simulation::motion::{
    Drift, DriftAt, Drifts, History, Invariants, MotionCheckpoint, PartReaction, Progress, Scaled,
};

use crate::SceneError;
use crate::model::{Scene, System};
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
    /// Answers to the questions of the scene, when it has some and the motion is complete.
    pub answers: Option<Answers>,
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
    let begun = Instant::now();
    let mut last = None;
    let motion = simulate(&scene.system, plan.method, &plan::timetable(scene), &mut |progress| {
        last = Some(progress);
        observer(progress)
    });
    answered(scene, recorded(scene, motion, begun), last, &mut observer)
}

/// [`run`] of up to eight scenes at once, one in each lane of a vector of numbers: each with the same numbers to the last bit, its wall time
/// aside, which is that of all.
///
/// Nothing where they cannot go [together](simulate_together), where one of them fails, or where `stop` says so after a step: then
/// each goes by itself.
///
/// # Example
/// ```
/// use piola_scene::{Document, Plan, Scene, run};
/// let pair = |speed: f64| Document::parse("pair.toml", &format!("
///     [gravity]
///     [[body]]
///     name = 'right'
///     gm = 1.0
///     position = [1, 0, 0]
///     velocity = [0, {speed}, 0]
///     [[body]]
///     name = 'left'
///     gm = 1.0
///     position = [-1, 0, 0]
///     velocity = [0, -{speed}, 0]
///     [time]
///     end = 6.0
///     [integrator]
///     method = 'composition-8'
///     step = 0.1
/// "));
/// let (circle, ellipse) = (Scene::from_document(&pair(0.5))?, Scene::from_document(&pair(0.6))?);
/// let plans = [Plan::of(&circle), Plan::of(&ellipse)];
/// let both = run::run_together(&[&circle, &ellipse], &plans, &|| false).expect("they go together");
/// let alone = run::run(&ellipse, &plans[1], |_| std::ops::ControlFlow::Continue(()));
/// assert_eq!(both[1].history, alone.history);
/// # Ok::<(), piola_scene::SceneError>(())
/// ```
#[must_use]
pub fn run_together(scenes: &[&Scene], plans: &[Plan], stop: &dyn Fn() -> bool) -> Option<Vec<Run>> {
    let begun = Instant::now();
    let method = plans.first()?.method;
    let timetable = plan::timetable(scenes.first()?);
    let is_same = |(scene, plan): (&&Scene, &Plan)| plan.method == method && plan::timetable(scene) == timetable;
    if scenes.len() != plans.len() || !scenes.iter().zip(plans).skip(1).all(is_same) {
        return None;
    }
    let systems: Vec<&System> = scenes.iter().map(|scene| &scene.system).collect();
    let motions = simulate_together(&systems, method, &timetable, stop)?;
    let answered =
        |(scene, motion)| answered(scene, recorded(scene, motion, begun), None, &mut |_| ControlFlow::Continue(()));
    Some(scenes.iter().copied().zip(motions).map(answered).collect())
}

/// As [`run`], with checkpoints: the run begins at one if there is one, and leaves others in the folder of the results.
///
/// The answers to the questions of a scene are found after the motion and are not in its checkpoints.
///
/// # Errors
/// [`SceneError::Simulation`]: the checkpoint is of another run or of another version of Piola.
///
/// # Example
/// See [`Checkpoints`].
pub fn run_with_checkpoints(
    scene: &Scene,
    plan: &Plan,
    from: Option<MotionCheckpoint>,
    checkpoints: &mut Checkpoints,
    mut observer: impl FnMut(Progress) -> ControlFlow<()>,
) -> Result<Run, SceneError> {
    let begun = Instant::now();
    let mut last = None;
    let motion = resume(&scene.system, plan.method, &plan::timetable(scene), from, checkpoints, &mut |progress| {
        last = Some(progress);
        observer(progress)
    })?;
    Ok(answered(scene, recorded(scene, motion, begun), last, &mut observer))
}

/// Adds the answers to the questions, if the motion is complete. Compiled once for all observers.
fn answered(
    scene: &Scene,
    mut run: Run,
    last: Option<Progress>,
    observer: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Run {
    if run.outcome == Outcome::Completed
        && let Some((answers, outcome)) = answers::answers(scene, &run.history, last, observer)
    {
        run.answers = Some(answers);
        run.outcome = outcome;
    }
    run
}

/// What a run will cost, by a trial of its first steps.
///
/// # Example
/// See [`trial`].
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Prediction {
    /// Steps of the trial.
    pub tried_steps: u64,
    /// Evaluations of the forces in the whole run, about.
    pub force_evaluations: f64,
    /// Time of the whole run, s, about.
    pub seconds: f64,
    /// Memory of the record, bytes.
    pub bytes: f64,
}

/// Tries the first steps of a run: whether it starts, and what it will cost. It takes a few hundredths of a second, and
/// longer for hundreds of independent parts, of which each is tried.
///
/// Steps that become shorter or longer later, as in close encounters, change the cost.
///
/// # Errors
/// Why the run would fail at its start.
///
/// # Example
/// ```
/// use piola_scene::{Document, Plan, Scene, run};
/// let orbit = |end: &str| Document::parse("orbit.toml", &format!("
///     [central]
///     gm = 1.0
///     [[body]]
///     name = 'comet'
///     semi_major_axis = 1.0
///     eccentricity = 0.5
///     [time]
///     end = {end}
/// "));
/// let long = Scene::from_document(&orbit("1e30"))?;
/// assert!(run::trial(&long, &Plan::of(&long)).unwrap().seconds > 1e9);
/// # Ok::<(), piola_scene::SceneError>(())
/// ```
pub fn trial(scene: &Scene, plan: &Plan) -> Result<Prediction, String> {
    /// Steps of a trial, of all independent parts of a mechanism together, and the least of one of them.
    const STEPS: u64 = 500;
    const LEAST: u64 = 20;
    /// Its time, s.
    const SECONDS: f64 = 0.02;
    let islands = match &scene.system {
        // Each part takes steps of its own: none tells the cost of another.
        System::Mechanism(system) if plan.integrates_islands(system) => {
            system.islands().into_iter().map(|island| System::Mechanism(Box::new(island.mechanism))).collect()
        }
        _ => Vec::new(),
    };
    let systems = if islands.is_empty() { core::slice::from_ref(&scene.system) } else { &islands[..] };
    let count = systems.len() as u64;
    let most = (STEPS / count).max(LEAST);
    let timetable = plan::timetable(scene);
    let mut prediction = Prediction {
        tried_steps: 0,
        force_evaluations: 0.0,
        seconds: 0.0,
        bytes: (plan.instants * (plan.equations + 16) * size_of::<f64>()) as f64,
    };
    for system in systems {
        let begun = Instant::now();
        let mut fraction = 0.0;
        let motion = simulate(system, plan.method, &timetable, &mut |progress| {
            fraction = progress.fraction;
            let enough = most <= progress.steps || SECONDS / count as f64 <= begun.elapsed().as_secs_f64();
            if enough { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let seconds = begun.elapsed().as_secs_f64();
        let MotionRun { steps, force_evaluations, .. } = motion;
        let whole = match judged(motion.outcome, &motion.history) {
            Outcome::Failed(why) if steps == 0 => return Err(why),
            Outcome::Completed => 1.0,
            _ => fraction,
        };
        prediction.tried_steps += steps;
        prediction.force_evaluations += force_evaluations as f64 / whole;
        prediction.seconds += seconds / whole;
    }
    Ok(prediction)
}

impl core::fmt::Display for Prediction {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { force_evaluations, bytes, tried_steps, .. } = self;
        write!(f, "about {force_evaluations:.1e} evaluations of the forces, {}", duration(self.seconds))?;
        write!(f, ", {bytes:.1e} bytes of record; from the first {tried_steps} steps")
    }
}

/// A duration, s, as people say it.
///
/// # Example
/// ```
/// assert_eq!(piola_scene::run::duration(10_800.0), "3 h");
/// ```
#[must_use]
pub fn duration(seconds: f64) -> String {
    const DAY: f64 = 86_400.0;
    match seconds {
        s if s < 1.0 => format!("{:.0} ms", (1e3 * s).ceil()),
        s if s < 300.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s if s < 2.0 * DAY => format!("{:.0} h", s / 3600.0),
        s if s < 1000.0 * DAY => format!("{:.0} days", s / DAY),
        s => format!("{:.1e} years", s / (365.25 * DAY)),
    }
}

/// A motion that began at an instant of the clock, with its drifts and errors.
fn recorded(scene: &Scene, motion: MotionRun, begun: Instant) -> Run {
    let wall_time = begun.elapsed().as_secs_f64();
    let MotionRun { outcome, time, steps, rejected, force_evaluations, history, .. } = motion;
    let outcome = judged(outcome, &history);
    let drifts = history.drifts();
    let errors = comparison::errors(scene, &history);
    Run { outcome, time, steps, rejected, force_evaluations, wall_time, history, drifts, errors, answers: None }
}

/// The outcome of a run: one with numbers that are not finite has failed.
fn judged(outcome: Outcome, history: &History) -> Outcome {
    match (outcome, not_finite(history)) {
        (Outcome::Completed, Some(why)) => Outcome::Failed(why),
        (outcome, _) => outcome,
    }
}

/// The first recorded number that is not finite, in words: such a record is no result.
fn not_finite(history: &History) -> Option<String> {
    for record in &history.invariants {
        let vectors = [("momentum", record.momentum), ("angular momentum", record.angular_momentum)];
        let vectors = vectors.into_iter().filter_map(|(name, vector)| {
            let (components, scale) = vector?;
            components.into_iter().chain([scale]).find(|x| !x.is_finite()).map(|x| (name, x))
        });
        let energy = (!record.energy.is_finite()).then_some(("energy", record.energy));
        if let Some((name, value)) = energy.into_iter().chain(vectors).next() {
            return Some(format!(
                "the {name} is {value} at {} s: the numbers have left the range of doubles",
                record.time
            ));
        }
    }
    let tables = [
        ("a coordinate", &history.coordinates),
        ("a work", &history.works),
        ("the force of a constraint", &history.conditions),
        ("an energy", &history.energies),
    ];
    for (what, rows) in tables {
        let bad = |(t, row): (&f64, &Vec<f64>)| row.iter().find(|x| !x.is_finite()).map(|x| (*t, *x));
        if let Some((t, value)) = history.times.iter().zip(rows).find_map(bad) {
            return Some(format!("{what} is {value} at {t} s: it is not defined there"));
        }
    }
    let held = history.times.iter().zip(&history.reactions);
    let bad = |reaction: &PartReaction| !reaction.force.iter().chain(&reaction.moment).all(|x| x.is_finite());
    if let Some((t, _)) = held.into_iter().find(|(_, parts)| parts.iter().any(bad)) {
        return Some(format!("a reaction is not defined at {t} s"));
    }
    let places = history.times.iter().zip(&history.positions);
    places.flat_map(|(t, places)| places.iter().map(move |place| (t, place))).find_map(|(t, place)| {
        let value = place.iter().find(|x| !x.is_finite())?;
        Some(format!("a position is {value} at {t} s: the numbers have left the range of doubles"))
    })
}
