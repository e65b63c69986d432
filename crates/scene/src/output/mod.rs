//! Results in one folder: a summary, tables and figures.
//!
//! The folder is tried before the run. Every file is written beside its place and then moved there, so that none is ever half
//! written, and one that fails does not keep the others from being written.

pub(crate) mod figures;
mod folder;
mod summary;
mod tables;

pub use folder::Folder;
pub use summary::Summary;

use std::path::PathBuf;

use crate::model::Scene;
use crate::plan::Plan;
use crate::run::Run;
use crate::{SceneError, model};

/// The files that were written, and those that could not be.
#[derive(Debug, Default)]
#[non_exhaustive]
pub struct Written {
    /// Files in the order of writing.
    pub files: Vec<PathBuf>,
    /// The error of each file that could not be written.
    pub failures: Vec<SceneError>,
}

impl Written {
    /// Writes files into a folder.
    pub(crate) fn of<'n>(folder: &Folder, files: impl IntoIterator<Item = (&'n str, String)>) -> Self {
        let mut written = Self::default();
        for (name, text) in files {
            match folder.write(name, &text) {
                Ok(path) => written.files.push(path),
                Err(error) => written.failures.push(error),
            }
        }
        written
    }
}

/// Writes everything that the plan lists.
#[must_use]
pub fn write(folder: &Folder, scene: &Scene, plan: &Plan, run: &Run, summary: &Summary) -> Written {
    let mut written = Written::default();
    for name in &plan.files {
        let text = match name.as_str() {
            "summary.json" => summary.to_json(),
            "trajectory.csv" => tables::trajectory(&run.history),
            "invariants.csv" => tables::invariants(&run.history),
            "coordinates.csv" => tables::coordinates(&run.history),
            "reference.csv" => tables::reference(run),
            "trajectory.svg" => figures::trajectory(title(scene), &run.history, gravity(scene)),
            "invariants.svg" => figures::invariants(title(scene), &run.history),
            "error.svg" => figures::error(title(scene), run),
            _ => continue,
        };
        match folder.write(name, &text) {
            Ok(path) => written.files.push(path),
            Err(error) => written.failures.push(error),
        }
    }
    written
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
