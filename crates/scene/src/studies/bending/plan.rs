//! The plan.

use super::BentBlockStudy;
use crate::studies::StudyPlan;
use crate::studies::law::material;
use crate::studies::panel::quantity;
use piola_charts::format_short;

/// Fills a plan; the tables and figures of this study.
pub(in crate::studies) fn plan(
    asked: &BentBlockStudy,
    plan: &mut StudyPlan,
) -> (&'static [&'static str], &'static [&'static str]) {
    let BentBlockStudy { block, angle, .. } = asked;
    plan.system = format!(
        "a block {} thick, {} long and {} high, of {}, bent by {} degrees",
        quantity("m", block.thickness()),
        quantity("m", block.length()),
        quantity("m", block.height()),
        material(&asked.law),
        format_short(angle.to_degrees())
    );
    plan.method = "moment by quadrature through the thickness".to_string();
    plan.reason =
        "the two curved faces exchange their stretches whatever the law: both are free of stress at once".to_string();
    plan.compute("moment", format!("over the angle, at the stretch {} along the axis", asked.axial_stretch));
    plan.compute("axial force", "that holds the stretch along the axis");
    match asked.moment {
        Some(moment) => plan.compute("states", format!("all that carry {}", quantity("N m", moment))),
        None => plan.skip("states at a moment", "no `moment` is given: stresses are those at the largest angle"),
    }
    plan.skip("wrinkles of the inner face", "the solution is the sector's own");
    (&["bending.csv", "stress.csv"], &["bending.svg"])
}
