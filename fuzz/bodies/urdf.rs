//! A robot is refused, or a tree of it falls with finite accelerations.

use piola_multibody::{Urdf, UrdfOptions};

pub(super) fn run(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    match Urdf::parse(text, UrdfOptions::default()) {
        Ok(robot) => {
            assert!(0 < robot.tree.links() || robot.tree.freedoms() == 0);
            let _ = robot.with_mimics();
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
