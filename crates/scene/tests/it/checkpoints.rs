//! When a checkpoint is due.

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
