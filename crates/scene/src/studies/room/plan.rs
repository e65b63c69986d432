//! The plan.

use super::Room;
use crate::studies::StudyPlan;

/// Fills a plan; the tables and figures of this study.
pub(in crate::studies) fn plan(
    asked: &Room,
    plan: &mut StudyPlan,
) -> (&'static [&'static str], &'static [&'static str]) {
    let [a, b] = asked.outline.semi_axes;
    let from = if asked.circle.is_some() { "a circle" } else { "its wall" };
    plan.system = format!("first arrival of a signal from {from} in a room of {} m by {} m", 2.0 * a, 2.0 * b);
    plan.method = format!("characteristics, refined to {} m", asked.resolution);
    plan.reason =
        "the eikonal equation keeps all its sheets on characteristics; the least of them is the first arrival"
            .to_string();
    plan.compute("first arrival", format!("on a grid of {} points along the longer axis", asked.grid));
    plan.compute("first loss of invertibility", "where characteristics first cross: the tip of the caustic");
    plan.compute("residual", "of the eikonal equation with the gradient of the interpolated time");
    plan.skip("reflection", "the signal ends at the wall");
    (&["arrival.csv", "caustic.csv"], &["arrival.svg"])
}
