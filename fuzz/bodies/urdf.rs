//! A robot is refused in words, or is a tree that takes its mimic joints or refuses them.

use piola_multibody::{Urdf, UrdfOptions};

/// Whether the robot is accepted.
pub(super) fn run(data: &[u8]) -> bool {
    let Ok(text) = core::str::from_utf8(data) else { return false };
    match Urdf::parse(text, UrdfOptions::default()) {
        Ok(robot) => {
            assert!(0 < robot.tree.links() || robot.tree.freedoms() == 0);
            let _ = robot.with_mimics();
            true
        }
        Err(error) => {
            assert!(!error.to_string().is_empty());
            false
        }
    }
}
