//! The scenes of the repository are valid.

use std::path::{Path, PathBuf};

/// A path of the repository; none where the package stands alone, outside of it.
fn in_repository(path: &str) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    // The repository has the map of the house; a folder in which a package was unpacked has none.
    root.join("ARCHITECTURE.md").exists().then(|| root.join(path))
}

#[test]
fn scenes_that_come_with_the_program_are_valid() {
    let Some(folder) = in_repository("scenes") else { return };
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut count = 0;
    for entry in entries {
        let path = entry.unwrap_or_else(|error| panic!("{}: {error}", folder.display())).path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            match piola_scene::SceneFile::load(&path, &[]) {
                Ok(_) => count += 1,
                // Scenes of solids, boxes and robots are not read without their feature, and nothing else is wrong with them.
                Err(piola_scene::SceneError::Invalid(report))
                    if !cfg!(all(feature = "solutions", feature = "spectral", feature = "robots")) =>
                {
                    let [mistake] = report.mistakes.as_slice() else { panic!("{}: {report}", path.display()) };
                    assert!(mistake.found.contains("needs the feature `"), "{}: {report}", path.display());
                }
                Err(error) => panic!("{}: {error}", path.display()),
            }
        }
    }
    let has = |feature: bool, scenes: usize| if feature { scenes } else { 0 };
    let least = 10
        + has(cfg!(feature = "solutions"), 5)
        + has(cfg!(feature = "spectral"), 3)
        + has(cfg!(feature = "robots"), 3);
    assert!(least <= count, "{count} scenes");
}
