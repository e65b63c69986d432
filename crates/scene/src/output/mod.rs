//! Results in one folder: a summary, tables and figures.
//!
//! The folder is tried before the run. Every file is written beside its place and then moved there, so that none is ever half
//! written, and one that fails does not keep the others from being written.

mod figures;
mod summary;
mod tables;

pub use piola_charts::{Folder, Written};
pub use summary::Summary;

use crate::model;
use crate::model::Scene;
use crate::plan::Plan;
use crate::run::Run;

/// Writes everything that the plan lists.
#[must_use]
pub fn write(folder: &Folder, scene: &Scene, plan: &Plan, run: &Run, summary: &Summary) -> Written {
    let text = |name: &str| match name {
        "summary.json" => Some(summary.to_json()),
        "trajectory.csv" => Some(tables::trajectory(&run.history)),
        "invariants.csv" => Some(tables::invariants(&run.history)),
        "works.csv" => Some(tables::works(&run.history)),
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

fn title(scene: &Scene) -> &str {
    scene.title.as_deref().unwrap_or(&scene.name)
}

fn gravity(scene: &Scene) -> Option<[f64; 3]> {
    match &scene.system {
        model::System::Mechanism(system) => Some(system.gravity),
        _ => None,
    }
}
