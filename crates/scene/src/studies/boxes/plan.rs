//! What will be computed for fields on a box, and what it costs.

use piola_spectral::{PointLocation, Walls};

use super::map::{Slice, stride_of};
use super::{BoxFields, BoxStudy, FlowTask, Form, MotionTask, StaticTask, Task};
use crate::studies::StudyPlan;
use crate::studies::panel::quantity;
use piola_document::words;

type Files = (&'static [&'static str], &'static [&'static str]);

/// Memory in words: `12.6 MB`.
pub(super) fn bytes_in_words(bytes: f64) -> String {
    if bytes < 1e15 { quantity("B", bytes) } else { format!("{bytes:.1e} B") }
}

impl BoxStudy {
    /// Fills a plan; the tables and figures of this study.
    pub(in crate::studies) fn plan(&self, plan: &mut StudyPlan) -> Files {
        match self {
            Self::Rectangle(fields) => fields.plan(plan),
            Self::Box(fields) => fields.plan(plan),
        }
    }
}

/// Numbers with a cross between them: `64 × 32`.
fn crossed<T: core::fmt::Display>(numbers: impl IntoIterator<Item = T>) -> String {
    numbers.into_iter().map(|x| x.to_string()).collect::<Vec<_>>().join(" × ")
}

impl<const D: usize> BoxFields<D> {
    fn plan(&self, plan: &mut StudyPlan) -> Files {
        let body = if D == 2 { "rectangle" } else { "box" };
        let walls = if self.walls == Walls::Sliding { "sliding" } else { "guided" };
        let size = crossed(self.sides.map(words::number));
        let place = format!("in a {body} of {size} m between {walls} walls");
        let [lambda, mu] = [self.lame.first(), self.lame.shear_modulus()];
        let (subject, files) = match &self.task {
            Task::Static(task) => ("equilibrium of an elastic body", self.plan_static(task, plan)),
            Task::Motion(task) => ("motion of an elastic body", self.plan_motion(task, plan)),
            Task::Flow(task) => ("creeping flow of a viscous fluid", self.plan_flow(task, plan)),
        };
        let unit = if matches!(self.task, Task::Flow(_)) { "Pa s" } else { "Pa" };
        plan.system = format!("{subject} {place}, λ = {} and μ = {}", quantity(unit, lambda), quantity(unit, mu));
        files
    }

    /// Points, modes and memory.
    fn cost(&self, points: Option<usize>) -> String {
        let modes: f64 = self.highest().iter().map(|index| *index as f64 + 1.0).product();
        let memory = bytes_in_words(self.bytes());
        match points {
            Some(points) => format!("{points} points, {modes} modes of {D} components, {memory} of memory"),
            None => format!("{modes} modes of {D} components, {memory} of memory"),
        }
    }

    fn plan_grid(&self, points: [usize; D], location: PointLocation, has_truncation: bool, plan: &mut StudyPlan) {
        let where_ = if location == PointLocation::Cells { "cells" } else { "nodes" };
        plan.method = format!("eigenfunctions on {} {where_}", crossed(points));
        plan.reason = format!("transforms make each mode one division: {}", self.cost(Some(points.iter().product())));
        if has_truncation {
            plan.skip("modes", format!("only those up to {:?} were asked for", self.highest()));
        }
        if self.loads.iter().any(|load| matches!(load.form, Form::Point { .. })) {
            plan.compute("forces at points", "sums of modes: each is spread over the length of the shortest wave");
        }
    }

    fn plan_lift(&self, has_truncation: bool, plan: &mut StudyPlan) {
        let is_sampled = |form: &Form<D>| matches!(form, Form::Uniform { .. } | Form::Gaussian { .. });
        let what = "force normal to the walls";
        if !self.loads.iter().any(|load| is_sampled(&load.form)) {
            plan.skip(what, "modes and forces at points are summed as they are");
        } else if has_truncation {
            plan.skip(what, "a sum of few modes has no room for it");
        } else if self.walls == Walls::Guided {
            plan.compute(what, "its largest size: the cosines of guided walls hold it");
        } else {
            plan.compute(
                what,
                "a displacement that balances it is split off: the sines of sliding walls approach it slowly",
            );
        }
    }

    fn plan_static(&self, task: &StaticTask<D>, plan: &mut StudyPlan) -> Files {
        self.plan_grid(task.grid.points(), task.grid.location(), task.modes.is_some(), plan);
        plan.compute("displacement, stress", "at the points of the grid");
        plan.compute("energy", "of the modes of the displacement, by Parseval's equation");
        plan.compute("resultant of the loads", "beside the forces of the walls");
        self.plan_lift(task.modes.is_some(), plan);
        if self.walls == Walls::Guided {
            plan.skip("forces of the walls", "guided walls exert no normal force");
        }
        self.plan_probes("displacement", plan);
        plan_table("field.csv", stride_of(&task.grid), plan);
        if let Some(height) = Slice::of(&task.grid).height {
            plan.skip("other slices in the figure", format!("it shows the plane z = {} m", words::number(height)));
        }
        (&["field.csv"], &["displacement.svg"])
    }

    fn plan_motion(&self, task: &MotionTask<D>, plan: &mut StudyPlan) -> Files {
        let instants = 1 + task.instants().count();
        plan.method = format!("exact solution of each mode up to {:?}, {instants} instants", task.modes);
        plan.reason = format!(
            "a step has no error in time, whatever its length: the instants of the output alone fix the cost, {}",
            self.cost(None)
        );
        plan.compute("energy", "kinetic and elastic, by Parseval's equation");
        if self.is_conservative(task) {
            plan.compute("drift of the energy", "there is neither drag nor a load: it is constant");
        } else {
            plan.skip("drift of the energy", "drag or loads change the energy");
        }
        plan.skip("limit of stability", "an exact step has none");
        if self.loads.is_empty() {
            plan.skip("forces", "there is no [[load]]");
        }
        self.plan_probes("displacement over time", plan);
        let tables: &[&str] = if self.probes.is_empty() { &["energy.csv"] } else { &["energy.csv", "probes.csv"] };
        (tables, &["motion.svg"])
    }

    fn plan_flow(&self, task: &FlowTask<D>, plan: &mut StudyPlan) -> Files {
        self.plan_grid(task.grid.points(), task.grid.location(), task.modes.is_some(), plan);
        plan.compute("velocity", "once: the loads are steady");
        match task.step {
            Some(step) => {
                plan.compute("steps", format!("{:.0} of Runge and Kutta's method", (task.duration / step).ceil()));
            }
            None => plan.compute("steps", "of half the time in which the fastest particle crosses a spacing"),
        }
        plan.compute(
            "least Jacobian",
            format!("of each step; below {} the displacement is put away", task.least_jacobian),
        );
        plan.compute("map of the particles", "where each was at first");
        self.plan_lift(task.modes.is_some(), plan);
        plan.skip("pressure", "the fluid is compressible: λ and μ give its stress");
        self.plan_probes("place at first", plan);
        plan_table("particles.csv", stride_of(&task.grid), plan);
        if let Some(height) = Slice::of(&task.grid).height {
            plan.skip("other slices in the figure", format!("it shows the plane z = {} m", words::number(height)));
        }
        (&["flow.csv", "particles.csv"], &["flow.svg"])
    }

    fn plan_probes(&self, what: &str, plan: &mut StudyPlan) {
        if self.probes.is_empty() {
            plan.skip(&format!("{what} at named places"), "there is no [[probe]]");
        } else {
            let names: Vec<&str> = self.probes.iter().map(|probe| probe.name.as_str()).collect();
            plan.compute(&format!("{what} at named places"), names.join(", "));
        }
    }
}

fn plan_table(name: &str, stride: usize, plan: &mut StudyPlan) {
    if 1 < stride {
        plan.skip(
            "points in the table",
            format!("{name} has one of {stride} along each axis, {} rows at most", super::map::MOST_ROWS),
        );
    }
}
