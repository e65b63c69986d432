//! One function a command.

use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, Ordering};
use std::borrow::Cow;
use std::io::Write as _;
use std::path::Path;
use std::time::Duration;

use piola_charts::{Folder, Written};
use piola_forward::ForwardError;
use piola_measured::MeasuredError;
use piola_scene::output::{self, Summary};
use piola_scene::run::{self, Checkpoints, MotionCheckpoint, Outcome, Prediction};
use piola_scene::studies::{self, StudyPlan};
use piola_scene::{Plan, Scene, SceneError, SceneFile, Study, schema};

use crate::arguments::{PlanArguments, RunArguments, SceneArguments, SchemaArguments};
use crate::explain::Explanation;
use crate::interrupt::Interrupt;
use crate::progress::{ProgressLine, STRIDE};
use crate::{Exit, html, report};

pub(crate) fn run(arguments: &RunArguments) -> Exit {
    match load(&arguments.scene) {
        Ok(SceneFile::Motion(scene)) => run_motion(&scene, arguments),
        Ok(SceneFile::Study(study)) => run_study(&study, arguments),
        Err(error) => invalid(&error, arguments.scene.json),
    }
}

/// Seconds between two checkpoints, unless others are asked for.
const PAUSE: f64 = 30.0;

/// The folder of the results: the argument's, or the scene's.
fn results(arguments: &RunArguments, asked: &Path) -> Result<Folder, SceneError> {
    Ok(Folder::prepare(arguments.out.as_deref().unwrap_or(asked))?)
}

fn run_study(study: &Study, arguments: &RunArguments) -> Exit {
    let flags = [(arguments.resume, "--resume"), (arguments.checkpoint.is_some(), "--checkpoint")];
    if let (false, Some((_, flag))) = (studies::has_checkpoints(study), flags.iter().find(|(given, _)| *given)) {
        return refuse(
            &format!("this study takes seconds and leaves no checkpoints: run it without {flag}"),
            arguments.scene.json,
        );
    }
    let folder = match results(arguments, &study.output.folder) {
        Ok(folder) => folder,
        Err(error) => return invalid(&error, arguments.scene.json),
    };
    let plan = StudyPlan::of(study);
    let mut checkpoints = Checkpoints::new(&folder, Duration::from_secs_f64(arguments.checkpoint.unwrap_or(PAUSE)));
    if arguments.resume {
        match studies::checkpoint_time(study, &checkpoints) {
            Ok(from) => note(&went_on(from)),
            Err(error) => return invalid(&error, arguments.scene.json),
        }
    } else {
        checkpoints.remove();
    }
    let interrupt = Interrupt::listen();
    let mut progress = ProgressLine::new(&plan.name, 1);
    let run = studies::run_with_checkpoints(study, arguments.resume, &mut checkpoints, |fraction| {
        progress.update(fraction);
        if interrupt.asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    progress.finish();
    let run = match run {
        Ok((run, _)) => run,
        Err(error) => return invalid(&error, arguments.scene.json),
    };
    let mut written = run.write(&folder, study, &plan);
    if arguments.report {
        let texts = [("Results", run.table(study, &plan)), ("Plan", plan.to_string())];
        html::add(&arguments.scene, study.title.as_deref().unwrap_or(&study.name), &texts, (&folder, &mut written));
    }
    if arguments.scene.json {
        print(&run.summary(&plan));
    } else {
        print(&run.table(study, &plan));
        print(&listing(&folder, &written));
    }
    if let Some(failure) = checkpoints.failure() {
        note(&format!("the last checkpoint is not written: {failure}"));
    }
    if run.outcome != Outcome::Interrupted && written.failures.is_empty() {
        checkpoints.remove();
    }
    let end = format!("what was found until then is in {}", folder.path().display());
    ended(&run.outcome, &written, &end)
}

fn run_motion(scene: &Scene, arguments: &RunArguments) -> Exit {
    let folder = match results(arguments, &scene.output.folder) {
        Ok(folder) => folder,
        Err(error) => return invalid(&error, arguments.scene.json),
    };
    let plan = Plan::of(scene);
    match run::trial(scene, &plan) {
        Err(why) => return refuse_start(&why, arguments.scene.json),
        Ok(cost) if !arguments.yes && MOST_SECONDS < cost.seconds => {
            return refuse(&format!("this run takes {cost}; with --yes it starts all the same"), arguments.scene.json);
        }
        Ok(_) => {}
    }
    let pause = arguments.checkpoint.unwrap_or(PAUSE);
    let mut checkpoints = Checkpoints::new(&folder, Duration::from_secs_f64(pause));
    if !arguments.resume {
        // A later --resume must not go on from a run before this one.
        checkpoints.remove();
    }
    let from = match arguments.resume.then(|| begin_again(scene, &plan, &checkpoints)).transpose() {
        Ok(from) => from.flatten(),
        Err(error) => return invalid(&error, arguments.scene.json),
    };
    let interrupt = Interrupt::listen();
    let mut progress = ProgressLine::new(&plan.name, STRIDE);
    let run = run::run_with_checkpoints(scene, &plan, from, &mut checkpoints, |step| {
        progress.update(step.fraction);
        if interrupt.asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    progress.finish();
    let run = match run {
        Ok(run) => run,
        Err(error) => return invalid(&error, arguments.scene.json),
    };
    let summary = Summary::of(scene, &plan, &run);
    let mut written = output::write(&folder, scene, &plan, &run, &summary);
    if arguments.report {
        let texts = [("Results", report::table(scene, &plan, &run)), ("Plan", plan.to_string())];
        html::add(&arguments.scene, scene.title.as_deref().unwrap_or(&scene.name), &texts, (&folder, &mut written));
    }
    if arguments.scene.json {
        print(&summary.to_json());
    } else {
        print(&report::table(scene, &plan, &run));
        print(&listing(&folder, &written));
    }
    if let Some(failure) = checkpoints.failure() {
        note(&format!("the last checkpoint is not written: {failure}"));
    }
    if run.outcome != Outcome::Interrupted && written.failures.is_empty() {
        checkpoints.remove();
    }
    let end =
        format!("at {} s of {} s; what was computed until then is in {}", run.time, plan.end, folder.path().display());
    ended(&run.outcome, &written, &end)
}

/// The checkpoint that a run goes on from, if there is one; tells which it is.
fn begin_again(scene: &Scene, plan: &Plan, checkpoints: &Checkpoints) -> Result<Option<MotionCheckpoint>, SceneError> {
    let from = checkpoints.last(scene, plan)?;
    note(&went_on(from.as_ref().map(MotionCheckpoint::time)));
    Ok(from)
}

/// Where a run goes on, in words.
fn went_on(from: Option<f64>) -> String {
    from.map_or_else(
        || "there is no checkpoint: the run begins at its start".to_owned(),
        |time| format!("the run goes on at {time} s"),
    )
}

/// Prints the errors of a run and gives its exit code.
fn ended(outcome: &Outcome, written: &Written, end: &str) -> Exit {
    for failure in &written.failures {
        note(&format!("error: {failure}"));
    }
    match outcome {
        Outcome::Completed if written.failures.is_empty() => Exit::Done,
        Outcome::Completed => Exit::Failed,
        Outcome::Interrupted => {
            note(&format!("interrupted {end}"));
            Exit::Failed
        }
        Outcome::Failed(why) => {
            note(&format!("error: the run failed: {why}\nstopped {end}"));
            Exit::Failed
        }
    }
}

/// Runs of more than a day need a confirmation.
pub(crate) const MOST_SECONDS: f64 = 86_400.0;

fn refuse_start(why: &str, json: bool) -> Exit {
    refuse(&format!("the run fails at its start: {why}"), json)
}

fn refuse(why: &str, json: bool) -> Exit {
    failure(&why, json);
    Exit::Invalid
}

/// A plan with what the run will cost.
#[derive(serde::Serialize)]
struct PlanWithCost {
    #[serde(flatten)]
    plan: Plan,
    cost: Prediction,
}

impl core::fmt::Display for PlanWithCost {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{}\ncost      {}", self.plan, self.cost)
    }
}

fn plan_of_motion(scene: &Scene, json: bool) -> Exit {
    let plan = Plan::of(scene);
    match run::trial(scene, &plan) {
        Ok(cost) => show_plan(&PlanWithCost { plan, cost }, json),
        Err(why) => refuse_start(&why, json),
    }
}

pub(crate) fn plan(arguments: &PlanArguments) -> Exit {
    let json = arguments.scene.json;
    match (load(&arguments.scene), &arguments.explain) {
        (Ok(file), Some(term)) => explain(&file, term, json),
        (Ok(SceneFile::Motion(scene)), None) => plan_of_motion(&scene, json),
        (Ok(SceneFile::Study(study)), None) => show_plan(&StudyPlan::of(&study), json),
        (Err(error), _) => invalid(&error, json),
    }
}

fn explain(file: &SceneFile, term: &str, json: bool) -> Exit {
    match Explanation::of(file, term) {
        Ok(explanation) if json => print_json(&explanation),
        Ok(explanation) => print(&explanation.to_string()),
        Err(why) => return refuse(&why, json),
    }
    Exit::Done
}

fn show_plan(plan: &(impl serde::Serialize + core::fmt::Display), json: bool) -> Exit {
    if json {
        print_json(plan);
    } else {
        print(&format!("{plan}\n"));
    }
    Exit::Done
}

pub(crate) fn check(arguments: &SceneArguments) -> Exit {
    let (name, system) = match load(arguments) {
        Ok(SceneFile::Motion(scene)) => {
            let plan = Plan::of(&scene);
            if let Err(why) = run::trial(&scene, &plan) {
                return refuse_start(&why, arguments.json);
            }
            (plan.name, plan.system)
        }
        Ok(SceneFile::Study(study)) => (study.name.clone(), StudyPlan::of(&study).system),
        Err(error) => return invalid(&error, arguments.json),
    };
    if arguments.json {
        print_json(&serde_json::json!({ "name": name, "valid": true, "mistakes": [], "more": 0 }));
    } else {
        print(&format!("{} is valid: {system}\n", arguments.scene.display()));
    }
    Exit::Done
}

/// The folder and the files of the results.
pub(crate) fn listing(folder: &Folder, written: &Written) -> String {
    let names: Vec<_> = written.files.iter().filter_map(|path| path.file_name()?.to_str()).collect();
    format!("written to {}: {}\n", folder.path().display(), names.join(", "))
}

pub(crate) fn schema(arguments: &SchemaArguments) -> Exit {
    if arguments.markdown {
        print(&schema::markdown());
    } else {
        print_json(&schema::json_schema());
    }
    Exit::Done
}

fn load(arguments: &SceneArguments) -> Result<SceneFile, SceneError> {
    SceneFile::load(&arguments.scene, &arguments.settings)
}

fn invalid(error: &SceneError, json: bool) -> Exit {
    match error {
        SceneError::Invalid(report) if json => print_json(&serde_json::json!({
            "valid": false,
            "mistakes": report.mistakes,
            "more": report.more,
        })),
        SceneError::Invalid(report) => note(&report.to_string()),
        _ => failure(error, json),
    }
    Exit::Invalid
}

/// Measurements that are not accepted, or cannot be read.
pub(crate) fn refused(error: &MeasuredError, json: bool) -> Exit {
    match error {
        MeasuredError::Table(report) if json => print_json(&serde_json::json!({
            "valid": false,
            "file": report.path,
            "mistakes": report.mistakes,
            "more": report.more,
        })),
        MeasuredError::Table(report) => note(&report.to_string()),
        _ => failure(error, json),
    }
    Exit::Invalid
}

/// A flow or a specimen that is not accepted.
pub(crate) fn refused_forward(error: &ForwardError, json: bool) -> Exit {
    if let ForwardError::Measured(error) = error {
        return refused(error, json);
    }
    failure(error, json);
    Exit::Invalid
}

pub(crate) fn failure(error: &impl core::fmt::Display, json: bool) {
    if json {
        print_json(&serde_json::json!({ "valid": false, "error": error.to_string() }));
    } else {
        note(&format!("error: {error}"));
    }
}

fn print_json(value: &impl serde::Serialize) {
    // Nothing that is printed can fail to serialise: keys are texts, numbers that are not finite become null.
    let text = serde_json::to_string_pretty(value).unwrap_or_default();
    print(&format!("{text}\n"));
}

/// Whether standard output could not take something. A reader that has gone away is no failure.
static LOST: AtomicBool = AtomicBool::new(false);

/// Standard output.
pub(crate) fn print(text: &str) {
    let mut output = std::io::stdout().lock();
    let written = output.write_all(printable(text).as_bytes()).and_then(|()| output.flush());
    if let Err(error) = written
        && error.kind() != std::io::ErrorKind::BrokenPipe
        && !LOST.swap(true, Ordering::Relaxed)
    {
        note(&format!("error: standard output cannot be written: {error}"));
    }
}

/// The exit, or a failure if standard output could not take all of the results.
pub(crate) fn whole(exit: Exit) -> Exit {
    if exit == Exit::Done && LOST.load(Ordering::Relaxed) { Exit::Failed } else { exit }
}

/// Standard error.
pub(crate) fn note(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{}", printable(text));
}

/// The text with its control characters, and those that turn the direction of writing, escaped: names and paths come from files
/// and must not command the terminal.
fn printable(text: &str) -> Cow<'_, str> {
    let commands = |c: char| {
        c.is_control() && c != '\n' && c != '\t'
            || matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    if !text.contains(commands) {
        return Cow::Borrowed(text);
    }
    // Four digits serve for all of them, and in JSON too.
    let escaped = text.chars().map(|c| if commands(c) { format!("\\u{:04x}", u32::from(c)) } else { c.to_string() });
    Cow::Owned(escaped.collect())
}
