//! The plan of a study of wave fronts.

use piola_studies::fronts::MOST_RAYS;

use super::{MediumPart, Source, Wavefront};
use crate::studies::StudyPlan;

/// Fills a plan; the tables and figures of this study.
pub(in crate::studies) fn plan(
    asked: &Wavefront,
    plan: &mut StudyPlan,
) -> (&'static [&'static str], &'static [&'static str]) {
    let source = match asked.source {
        Source::Plane { width, .. } => format!("a plane source {width} m wide"),
        Source::Point { .. } => "a point source".to_string(),
    };
    let parts = asked.medium.parts.len();
    plan.system = format!("wave fronts from {source} in a medium of {parts} part{}", if parts == 1 { "" } else { "s" });
    plan.method = format!("rays of |p| = n by a method of order 6, {} steps", asked.steps());
    plan.reason =
        "H = |p|/n has no terms of p and q apart: explicit, with exact derivatives; its difference from order 4 \
                   is the error stated"
            .to_string();
    plan.compute("fronts", format!("{} levels of the optical length up to {} m", asked.fronts, asked.length));
    plan.compute(
        "rays",
        format!(
            "{} to begin with; more, up to {}, where neighbours on a front are {} m apart",
            asked.rays, MOST_RAYS, asked.spacing
        ),
    );
    plan.compute("caustics", "where the Jacobian of the ray map changes sign");
    if asked.first_only {
        plan.compute(
            "first arrival",
            "keep = \"first\": swallow-tails and rays that have touched a caustic are cut off",
        );
    } else {
        plan.skip("first arrival", "keep = \"all\": fronts keep all their sheets");
    }
    if asked.medium.parts.iter().any(|part| matches!(part, MediumPart::Luneburg { .. })) {
        plan.compute(
            "short steps",
            "the gradient of Luneburg's index jumps on its rim: a step across it is of order one",
        );
    }
    plan.skip("amplitude and diffraction", "rays only");
    (&["fronts.csv", "caustic.csv"], &["fronts.svg"])
}
