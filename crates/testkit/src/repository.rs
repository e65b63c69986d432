//! Files of the repository outside of the packages.

use std::path::{Path, PathBuf};

/// A path of the repository; `None` where the package stands alone, outside of it.
///
/// # Example
/// ```
/// use piola_testkit::repository;
/// assert!(repository::path("scenes").is_none_or(|folder| folder.is_dir()));
/// ```
#[must_use]
pub fn path(path: &str) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    // The repository has the map of the house; a folder in which a package was unpacked has none.
    root.join("ARCHITECTURE.md").exists().then(|| root.join(path))
}

/// The scenes of the repository, sorted; none where the package stands alone.
///
/// # Panics
/// When the repository has no scenes.
///
/// # Example
/// ```
/// use piola_testkit::repository;
/// assert!(repository::scenes().iter().all(|scene| scene.extension().is_some_and(|kind| kind == "toml")));
/// ```
#[must_use]
#[track_caller]
pub fn scenes() -> Vec<PathBuf> {
    let Some(folder) = path("scenes") else { return Vec::new() };
    let entries = std::fs::read_dir(&folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut scenes: Vec<_> = entries.filter(|path| path.extension().is_some_and(|kind| kind == "toml")).collect();
    assert!(!scenes.is_empty(), "no scenes in {}", folder.display());
    scenes.sort();
    scenes
}
