//! The figures of a robot's motion.

use piola_charts::figure;

use super::{RobotMotion, RobotStudy};
use crate::studies::panel::Panel;

/// More curves than this are not told apart.
const MOST_CURVES: usize = 12;

/// The coordinates of joints with one coordinate over time.
pub(super) fn coordinates(found: &RobotMotion, asked: &RobotStudy, title: &str) -> String {
    let mut panel = Panel::new("coordinates of joints", "time (s)", "angle (rad), displacement (m)");
    let single = asked.drives.iter().filter_map(|drive| drive.coordinate);
    for (index, coordinate) in single.take(MOST_CURVES).enumerate() {
        let points = found.samples.iter().map(|sample| (sample.t, sample.q[coordinate]));
        panel = panel.curve(&found.names[coordinate], index, points);
    }
    figure((980, 620), title, &|area| panel.draw(area))
}

/// The energies and the work over time.
pub(super) fn energies(found: &RobotMotion, title: &str) -> String {
    let mut panel = Panel::new("energies", "time (s)", "energy (J)");
    for (index, name) in ["kinetic", "potential", "springs"].into_iter().enumerate() {
        let points = found.samples.iter().map(|sample| (sample.t, sample.energies[index]));
        panel = panel.curve(name, index, points);
    }
    let works = |sample: &super::RobotSample| sample.works.iter().sum::<f64>();
    let name = "work of torques, damping and friction";
    panel = panel.curve(name, 3, found.samples.iter().map(|sample| (sample.t, works(sample))));
    let total = |sample: &super::RobotSample| sample.energies.iter().sum::<f64>();
    panel = panel.dashed("sum of energies", 4, found.samples.iter().map(|sample| (sample.t, total(sample))));
    figure((980, 620), title, &|area| panel.draw(area))
}
