//! When a checkpoint is due, and which are refused.

use std::time::{Duration, Instant};

use piola_scene::output::Folder;
use piola_scene::run::Checkpoints;
use piola_simulation::motion::CheckpointKeeper as _;

#[test]
fn a_checkpoint_of_slow_steps_is_due_at_the_first_step_after_the_pause() {
    const PAUSE: Duration = Duration::from_millis(20);
    let path = std::env::temp_dir().join(format!("piola-due-{}", std::process::id()));
    let folder = Folder::prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    let mut checkpoints = Checkpoints::new(&folder, PAUSE);
    let begun = Instant::now();
    for step in 1..=8 {
        std::thread::sleep(Duration::from_millis(4));
        let is_late = PAUSE <= begun.elapsed();
        let is_due = checkpoints.is_due();
        assert!(is_due || !is_late, "step {step}");
    }
    let _ = std::fs::remove_dir_all(&path);
}

#[cfg(feature = "robots")]
#[test]
fn a_checkpoint_of_a_robot_that_was_changed_is_refused_and_the_spelling_of_its_path_does_not_matter() {
    use core::ops::ControlFlow;
    use std::path::Path;

    use piola_scene::studies::{checkpoint_time, run_with_checkpoints};
    use piola_scene::{SceneFile, Study};

    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let load = |path: &Path| -> Study {
        match SceneFile::load(path, &[]) {
            Ok(SceneFile::Study(study)) => study,
            other => panic!("{other:?}"),
        }
    };
    let study = load(&root.join("two-link-arm.toml"));
    let path = std::env::temp_dir().join(format!("piola-robot-{}", std::process::id()));
    let folder = Folder::prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    let mut checkpoints = Checkpoints::new(&folder, Duration::from_secs(1000));
    let stop = |fraction: f64| if fraction < 0.5 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
    let stopped = run_with_checkpoints(&study, false, &mut checkpoints, stop);
    assert!(stopped.is_ok());
    let other = load(&root.join("../scenes/two-link-arm.toml"));
    assert!(matches!(checkpoint_time(&other, &checkpoints), Ok(Some(_))));
    let file = path.join(".piola-checkpoint");
    let text = std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{error}"));
    let changed = text.replacen("\"q\":[", "\"q\":[0.5,", 1);
    assert!(changed != text && std::fs::write(&file, changed).is_ok());
    let refused = checkpoint_time(&study, &checkpoints).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(refused.contains("the checkpoint was changed"), "{refused}");
    let _ = std::fs::remove_dir_all(&path);
}
