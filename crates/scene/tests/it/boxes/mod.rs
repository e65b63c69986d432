//! Fields on a box beside closed forms, and the mistakes of their scenes.

mod flow;
mod mistakes;
mod motion;
mod results;
mod statics;

use std::ops::ControlFlow;

use piola_scene::run::Outcome;
use piola_scene::studies::boxes::{BoxFindings, FlowHistory, Found, MotionHistory, StaticField};
use piola_scene::studies::{self, Findings, StudyRun};

use crate::support::study;

/// A flow in a square, stirred by one mode.
const STIR: &str = r#"
[box]
type = "flow"
sides = [1.0, 1.0]
points = [8, 8]
shear_viscosity = 1.5
duration = 0.5

[[load]]
type = "mode"
indices = [1, 1]
force_per_volume = [-1.0, 1.0]
"#;

fn run(text: &str) -> StudyRun {
    let run = studies::run(&study(text), |_| ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed);
    run
}

fn findings(run: &StudyRun) -> &BoxFindings {
    match &run.findings {
        Findings::Box(found) => found,
        other => panic!("{other:?}"),
    }
}

fn in_rectangle(run: &StudyRun) -> &Found<2> {
    match findings(run) {
        BoxFindings::Rectangle(found) => found,
        other @ BoxFindings::Box(_) => panic!("{other:?}"),
    }
}

fn in_box(run: &StudyRun) -> &Found<3> {
    match findings(run) {
        BoxFindings::Box(found) => found,
        other @ BoxFindings::Rectangle(_) => panic!("{other:?}"),
    }
}

fn field<const D: usize>(found: &Found<D>) -> &StaticField<D> {
    match found {
        Found::Static(found) => found,
        other => panic!("{other:?}"),
    }
}

fn history<const D: usize>(found: &Found<D>) -> &MotionHistory<D> {
    match found {
        Found::Motion(found) => found,
        other => panic!("{other:?}"),
    }
}

fn flow_of<const D: usize>(found: &Found<D>) -> &FlowHistory<D> {
    match found {
        Found::Flow(found) => found,
        other => panic!("{other:?}"),
    }
}
