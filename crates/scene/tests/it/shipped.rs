//! The scenes of the repository are valid.

use piola_testkit::repository;

#[test]
fn scenes_that_come_with_the_program_are_valid() {
    let scenes = repository::scenes();
    // A package that stands alone has none.
    if scenes.is_empty() {
        return;
    }
    let mut count = 0;
    for path in scenes {
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
    let has = |feature: bool, scenes: usize| if feature { scenes } else { 0 };
    let least = 10
        + has(cfg!(feature = "solutions"), 5)
        + has(cfg!(feature = "spectral"), 3)
        + has(cfg!(feature = "robots"), 3);
    assert!(least <= count, "{count} scenes");
}
