//! The plan.

use super::LayeredTube;
use crate::studies::StudyPlan;
use crate::studies::law::material;
use crate::studies::panel::quantity;

/// Fills a plan; the tables and figures of this study.
pub(in crate::studies) fn plan(
    asked: &LayeredTube,
    plan: &mut StudyPlan,
) -> (&'static [&'static str], &'static [&'static str]) {
    let ([inner, outer], count) =
        (asked.layers.radii().map(|radius| quantity("m", radius)), asked.layers.layers().len());
    let plural = if count == 1 { "" } else { "s" };
    plan.system = format!(
        "a tube of radii {inner} and {outer} in {count} layer{plural} of {}, under {}",
        material(&asked.law),
        quantity("Pa", asked.pressure)
    );
    plan.method = "quadrature through the layers; stretches by Newton's iteration".to_string();
    plan.reason =
        "layers of one law deform as a tube whatever that law: radius and length are left to be found".to_string();
    plan.compute("residual stress", "both faces free, no axial force");
    plan.compute("stress under pressure", "at the axial stretch of the tube without loads");
    plan.compute("homogeneous tube", "of the same radii without growth, at its natural length");
    plan.skip("edges", "the tube is long: layers do not slide at its ends");
    (&["pressure.csv", "stress.csv"], &["tube.svg"])
}
