//! A scene is refused at its mistakes, or it is planned.

use piola_scene::studies::StudyPlan;
use piola_scene::{Document, Plan, SceneError, SceneFile};

/// Whether the scene is accepted.
pub(super) fn run(data: &[u8]) -> bool {
    let Ok(text) = core::str::from_utf8(data) else { return false };
    match SceneFile::from_document(&Document::parse("fuzz.toml", text)) {
        Ok(SceneFile::Motion(scene)) => assert!(!Plan::of(&scene).to_string().is_empty()),
        Ok(SceneFile::Study(study)) => assert!(!StudyPlan::of(&study).to_string().is_empty()),
        Err(SceneError::Invalid(report)) => {
            assert!(!report.mistakes.is_empty());
            let lines = text.lines().count().max(1) + 1;
            assert!(report.mistakes.iter().all(|mistake| mistake.line <= lines), "{report}");
            return false;
        }
        Err(other) => {
            assert!(!other.to_string().is_empty());
            return false;
        }
    }
    true
}
