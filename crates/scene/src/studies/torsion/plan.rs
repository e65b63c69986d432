//! The plan.

use super::TwistedRod;
use crate::studies::StudyPlan;
use crate::studies::law::material;
use crate::studies::panel::quantity;

/// Fills a plan; the tables and figures of this study.
pub(in crate::studies) fn plan(
    asked: &TwistedRod,
    plan: &mut StudyPlan,
) -> (&'static [&'static str], &'static [&'static str]) {
    let [inner, outer] = [asked.tube.inner(), asked.tube.outer()].map(|radius| quantity("m", radius));
    let body = if asked.tube.is_solid() {
        format!("a rod of radius {outer}")
    } else {
        format!("a tube of radii {inner} and {outer}")
    };
    plan.system = format!("{body}, of {}, twisted by up to {} rad/m", material(&asked.law), asked.twist);
    plan.method = "loads by quadrature, stretches by Newton's iteration with exact slopes".to_string();
    plan.reason = "a twisted rod keeps its circles whatever the law: two stretches are left to be found".to_string();
    plan.compute("held", format!("torque and axial force at the axial stretch {}", asked.axial_stretch));
    plan.compute(
        "pulled",
        format!("torque and axial stretch under the axial force {}", quantity("N", asked.axial_force)),
    );
    match asked.torque {
        Some(torque) => {
            plan.compute("states", format!("all under the axial force that carry {}", quantity("N m", torque)));
        }
        None => plan.skip("states at a torque", "no `torque` is given: stresses are those at the largest twist"),
    }
    plan.skip("buckling", "the axis stays straight");
    (&["torsion.csv", "stress.csv"], &["torsion.svg"])
}
