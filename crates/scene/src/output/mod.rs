//! Results in one folder: a summary, tables and figures.
//!
//! The folder is tried before the run. Every file is written beside its place and then moved there, so that none is ever half
//! written, and one that fails does not keep the others from being written.

mod figures;
mod phase;
mod summary;
mod tables;

pub use piola_charts::{Folder, Written};
pub use summary::{Summary, stability};

use crate::model;
use crate::model::Scene;
use crate::plan::Plan;
use crate::run::{Answers, Run};
use piola_simulation::phase::PhaseAnswers;
use piola_simulation::questions::MechanismAnswers;

/// The time of a crossing, and its q and p.
type Crossing = (f64, Vec<f64>);

/// Writes everything that the plan lists; no table of a question that was not answered.
#[must_use]
pub fn write(folder: &Folder, scene: &Scene, plan: &Plan, run: &Run, summary: &Summary) -> Written {
    let text = |name: &str| match name {
        "summary.json" => Some(summary.to_json()),
        "trajectory.csv" => Some(tables::trajectory(&run.history)),
        "invariants.csv" => Some(tables::invariants(&run.history)),
        "works.csv" => Some(tables::works(&run.history)),
        "energies.csv" => Some(tables::energies(&run.history)),
        "section.csv" => Some(tables::section(&run.history, crossings(run)?)),
        "exponent.csv" => Some(tables::exponent(phase_answers(run).filter(|found| !found.estimates.is_empty())?)),
        "brackets.csv" => Some(tables::brackets(scene, &run.history, phase_answers(run)?)),
        "modes.csv" => Some(tables::modes(&run.history, mechanism_answers(run)?)),
        "phase.svg" => Some(phase::planes(title(scene), &run.history)),
        "section.svg" => Some(phase::section(title(scene), &run.history, crossings(run)?)),
        "reactions.csv" => Some(tables::reactions(&run.history)),
        "constraints.csv" => Some(tables::conditions(&run.history)),
        "coordinates.csv" => Some(tables::coordinates(&run.history)),
        "reference.csv" => Some(tables::reference(run)),
        "trajectory.svg" => Some(figures::trajectory(title(scene), &run.history, gravity(scene))),
        "invariants.svg" => Some(figures::invariants(title(scene), &run.history)),
        "error.svg" => Some(figures::error(title(scene), run)),
        _ => None,
    };
    Written::of(folder, plan.files.iter().filter_map(|name| Some((name.as_str(), text(name)?))))
}

fn phase_answers(run: &Run) -> Option<&PhaseAnswers> {
    if let Some(Answers::Phase(answers)) = &run.answers { Some(answers) } else { None }
}

/// The crossings of the section, if it was sought.
fn crossings(run: &Run) -> Option<&[Crossing]> {
    phase_answers(run)?.crossings.as_deref()
}

fn mechanism_answers(run: &Run) -> Option<&MechanismAnswers> {
    if let Some(Answers::Mechanism(Ok(answers))) = &run.answers { Some(answers) } else { None }
}

fn title(scene: &Scene) -> &str {
    scene.title.as_deref().unwrap_or(&scene.name)
}

fn gravity(scene: &Scene) -> Option<[f64; 3]> {
    match &scene.system {
        model::System::Mechanism(system) => Some(system.gravity),
        _ => None,
    }
}
