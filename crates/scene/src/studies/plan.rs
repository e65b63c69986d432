//! The plan of a study: its method, computed and skipped quantities.

use core::fmt;

use serde::Serialize;

#[cfg(feature = "spectral")]
use super::boxes;
#[cfg(feature = "robots")]
use super::robot;
use super::{Study, Subject, room, wavefront};
use crate::plan::Item;

/// The plan of a study.
///
/// # Example
/// ```
/// use piola_scene::studies::StudyPlan;
/// use piola_scene::{Document, SceneFile};
/// let document = Document::parse("fronts.toml", "
///     [wavefront]
///     type = 'point'
///     length = 1.0
///     [[medium]]
///     type = 'uniform'
/// ");
/// let SceneFile::Study(study) = SceneFile::from_document(&document)? else { panic!() };
/// assert!(StudyPlan::of(&study).files.contains(&"fronts.svg".to_string()));
/// # Ok::<(), piola_scene::SceneError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct StudyPlan {
    /// Name of the scene.
    pub name: String,
    /// The subject in words.
    pub system: String,
    /// Method.
    pub method: String,
    /// Why this method.
    pub reason: String,
    /// Quantities computed.
    pub computed: Vec<Item>,
    /// Quantities not computed.
    pub skipped: Vec<Item>,
    /// Folder of the results.
    pub folder: String,
    /// Files that will be written.
    pub files: Vec<String>,
}

impl StudyPlan {
    /// The plan of a study.
    #[must_use]
    pub fn of(study: &Study) -> Self {
        let mut plan = Self {
            name: study.name.clone(),
            system: String::new(),
            method: String::new(),
            reason: String::new(),
            computed: Vec::new(),
            skipped: Vec::new(),
            folder: study.output.folder.display().to_string(),
            files: vec!["summary.json".to_string()],
        };
        let (tables, figures) = match &study.subject {
            Subject::Wavefront(asked) => wavefront::plan(asked, &mut plan),
            Subject::Room(asked) => room::plan(asked, &mut plan),
            #[cfg(feature = "solutions")]
            Subject::Solid(solid) => solid.plan(&mut plan),
            #[cfg(feature = "spectral")]
            Subject::Box(fields) => boxes::plan(fields, &mut plan),
            #[cfg(feature = "robots")]
            Subject::Robot(robot) => robot::plan(robot, &mut plan),
        };
        for (wanted, files, what) in
            [(study.output.tables, tables, "tables"), (study.output.figures, figures, "figures")]
        {
            if wanted {
                plan.files.extend(files.iter().map(ToString::to_string));
            } else {
                plan.skip(what, format!("output.{what} = false"));
            }
        }
        plan
    }

    pub(super) fn compute(&mut self, what: &str, why: impl Into<String>) {
        self.computed.push(Item { what: what.to_string(), why: why.into() });
    }

    pub(super) fn skip(&mut self, what: &str, why: impl Into<String>) {
        self.skipped.push(Item { what: what.to_string(), why: why.into() });
    }
}

impl fmt::Display for StudyPlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {}", self.name, self.system)?;
        writeln!(f, "method    {}\n          {}", self.method, self.reason)?;
        for (heading, items) in [("computed", &self.computed), ("skipped", &self.skipped)] {
            for (index, item) in items.iter().enumerate() {
                writeln!(f, "{:<10}{}: {}", if index == 0 { heading } else { "" }, item.what, item.why)?;
            }
        }
        write!(f, "written   {}: {}", self.folder, self.files.join(", "))
    }
}
