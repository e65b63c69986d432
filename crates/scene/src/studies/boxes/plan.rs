//! What will be computed for fields on a box, and what it costs.

use piola_spectral::{PointLocation, Walls};

use super::map::Slice;
use super::{BoxFields, BoxStudy, FlowTask, Form, MotionTask, StaticTask, Task};
use crate::studies::StudyPlan;
use crate::studies::panel::quantity;
use piola_document::words;
use piola_studies::internal::{MOST_ROWS, stride_of};

type Files = (&'static [&'static str], &'static [&'static str]);

/// Memory in words: `12.6 MB`.
pub(super) fn bytes_in_words(bytes: f64) -> String {
    if bytes < 1e15 { quantity("B", bytes) } else { format!("{bytes:.1e} B") }
}

/// Fills a plan; the tables and figures of this study.
pub(in crate::studies) fn plan(asked: &BoxStudy, plan: &mut StudyPlan) -> Files {
    match asked {
        BoxStudy::Rectangle(fields) => plan_fields(fields, plan),
        BoxStudy::Box(fields) => plan_fields(fields, plan),
    }
}

/// Numbers with a cross between them: `64 × 32`.
fn crossed<T: core::fmt::Display>(numbers: impl IntoIterator<Item = T>) -> String {
    numbers.into_iter().map(|x| x.to_string()).collect::<Vec<_>>().join(" × ")
}

fn plan_fields<const D: usize>(asked: &BoxFields<D>, plan: &mut StudyPlan) -> Files {
    let body = if D == 2 { "rectangle" } else { "box" };
    let walls = if asked.walls == Walls::Sliding { "sliding" } else { "guided" };
    let size = crossed(asked.sides.map(words::number));
    let place = format!("in a {body} of {size} m between {walls} walls");
    let [lambda, mu] = [asked.lame.first(), asked.lame.shear_modulus()];
    let (subject, files) = match &asked.task {
        Task::Static(task) => ("equilibrium of an elastic body", plan_static(asked, task, plan)),
        Task::Motion(task) => ("motion of an elastic body", plan_motion(asked, task, plan)),
        Task::Flow(task) => ("creeping flow of a viscous fluid", plan_flow(asked, task, plan)),
    };
    let unit = if matches!(asked.task, Task::Flow(_)) { "Pa s" } else { "Pa" };
    plan.system = format!("{subject} {place}, λ = {} and μ = {}", quantity(unit, lambda), quantity(unit, mu));
    files
}

/// Points, modes and memory.
fn cost<const D: usize>(asked: &BoxFields<D>, points: Option<usize>) -> String {
    let modes: f64 = asked.highest().iter().map(|index| *index as f64 + 1.0).product();
    let memory = bytes_in_words(asked.bytes());
    match points {
        Some(points) => format!("{points} points, {modes} modes of {D} components, {memory} of memory"),
        None => format!("{modes} modes of {D} components, {memory} of memory"),
    }
}

fn plan_grid<const D: usize>(
    asked: &BoxFields<D>,
    points: [usize; D],
    location: PointLocation,
    has_truncation: bool,
    plan: &mut StudyPlan,
) {
    let where_ = if location == PointLocation::Cells { "cells" } else { "nodes" };
    plan.method = format!("eigenfunctions on {} {where_}", crossed(points));
    plan.reason = format!("transforms make each mode one division: {}", cost(asked, Some(points.iter().product())));
    if has_truncation {
        plan.skip("modes", format!("only those up to {:?} were asked for", asked.highest()));
    }
    if asked.loads.iter().any(|load| matches!(load.form, Form::Point { .. })) {
        plan.compute("forces at points", "sums of modes: each is spread over the length of the shortest wave");
    }
}

fn plan_lift<const D: usize>(asked: &BoxFields<D>, has_truncation: bool, plan: &mut StudyPlan) {
    let is_sampled = |form: &Form<D>| matches!(form, Form::Uniform { .. } | Form::Gaussian { .. });
    let what = "force normal to the walls";
    if !asked.loads.iter().any(|load| is_sampled(&load.form)) {
        plan.skip(what, "modes and forces at points are summed as they are");
    } else if has_truncation {
        plan.skip(what, "a sum of few modes has no room for it");
    } else if asked.walls == Walls::Guided {
        plan.compute(what, "its largest size: the cosines of guided walls hold it");
    } else {
        plan.compute(
            what,
            "a displacement that balances it is split off: the sines of sliding walls approach it slowly",
        );
    }
}

fn plan_static<const D: usize>(asked: &BoxFields<D>, task: &StaticTask<D>, plan: &mut StudyPlan) -> Files {
    plan_grid(asked, task.grid.points(), task.grid.location(), task.modes.is_some(), plan);
    plan.compute("displacement, stress", "at the points of the grid");
    plan.compute("energy", "of the modes of the displacement, by Parseval's equation");
    plan.compute("resultant of the loads", "beside the forces of the walls");
    plan_lift(asked, task.modes.is_some(), plan);
    if asked.walls == Walls::Guided {
        plan.skip("forces of the walls", "guided walls exert no normal force");
    }
    plan_probes(asked, "displacement", plan);
    plan_table("field.csv", stride_of(&task.grid), plan);
    if let Some(height) = Slice::of(&task.grid).height {
        plan.skip("other slices in the figure", format!("it shows the plane z = {} m", words::number(height)));
    }
    (&["field.csv"], &["displacement.svg"])
}

fn plan_motion<const D: usize>(asked: &BoxFields<D>, task: &MotionTask<D>, plan: &mut StudyPlan) -> Files {
    let instants = 1 + task.instants().count();
    plan.method = format!("exact solution of each mode up to {:?}, {instants} instants", task.modes);
    plan.reason = format!(
        "a step has no error in time, whatever its length: the instants of the output alone fix the cost, {}",
        cost(asked, None)
    );
    plan.compute("energy", "kinetic and elastic, by Parseval's equation");
    if asked.is_conservative(task) {
        plan.compute("drift of the energy", "there is neither drag nor a load: it is constant");
    } else {
        plan.skip("drift of the energy", "drag or loads change the energy");
    }
    plan.skip("limit of stability", "an exact step has none");
    if asked.loads.is_empty() {
        plan.skip("forces", "there is no [[load]]");
    }
    plan_probes(asked, "displacement over time", plan);
    let tables: &[&str] = if asked.probes.is_empty() { &["energy.csv"] } else { &["energy.csv", "probes.csv"] };
    (tables, &["motion.svg"])
}

fn plan_flow<const D: usize>(asked: &BoxFields<D>, task: &FlowTask<D>, plan: &mut StudyPlan) -> Files {
    plan_grid(asked, task.grid.points(), task.grid.location(), task.modes.is_some(), plan);
    plan.compute("velocity", "once: the loads are steady");
    match task.step {
        Some(step) => {
            plan.compute("steps", format!("{:.0} of Runge and Kutta's method", (task.duration / step).ceil()));
        }
        None => plan.compute("steps", "of half the time in which the fastest particle crosses a spacing"),
    }
    plan.compute("least Jacobian", format!("of each step; below {} the displacement is put away", task.least_jacobian));
    plan.compute("map of the particles", "where each was at first");
    plan_lift(asked, task.modes.is_some(), plan);
    plan.skip("pressure", "the fluid is compressible: λ and μ give its stress");
    plan_probes(asked, "place at first", plan);
    plan_table("particles.csv", stride_of(&task.grid), plan);
    if let Some(height) = Slice::of(&task.grid).height {
        plan.skip("other slices in the figure", format!("it shows the plane z = {} m", words::number(height)));
    }
    (&["flow.csv", "particles.csv"], &["flow.svg"])
}

fn plan_probes<const D: usize>(asked: &BoxFields<D>, what: &str, plan: &mut StudyPlan) {
    if asked.probes.is_empty() {
        plan.skip(&format!("{what} at named places"), "there is no [[probe]]");
    } else {
        let names: Vec<&str> = asked.probes.iter().map(|probe| probe.name.as_str()).collect();
        plan.compute(&format!("{what} at named places"), names.join(", "));
    }
}

fn plan_table(name: &str, stride: usize, plan: &mut StudyPlan) {
    if 1 < stride {
        plan.skip(
            "points in the table",
            format!("{name} has one of {stride} along each axis, {MOST_ROWS} rows at most"),
        );
    }
}
