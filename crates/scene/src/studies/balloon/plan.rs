//! The plan.

use super::Balloon;
use crate::studies::StudyPlan;
use crate::studies::law::material;
use crate::studies::panel::quantity;

/// Fills a plan; the tables and figures of this study.
pub(in crate::studies) fn plan(
    asked: &Balloon,
    plan: &mut StudyPlan,
) -> (&'static [&'static str], &'static [&'static str]) {
    let ([inner, outer], [low, high]) = (asked.radii(), asked.stretch);
    let [inner, outer] = [inner, outer].map(|radius| quantity("m", radius));
    plan.system = format!("a spherical shell of radii {inner} and {outer}, of {}", material(&asked.law));
    plan.method = format!("pressure by quadrature through the wall, stretches from {low} to {high}");
    plan.reason = "a sphere inflated keeps its shape whatever the law: nothing but an integral is left".to_string();
    plan.compute("limit points", "where the exact slope of the pressure changes its sign");
    match asked.pressure {
        Some(pressure) => plan.compute("states", format!("all that carry {}", quantity("Pa", pressure))),
        None => plan.skip("states at a pressure", "no `pressure` is given: stresses are those at the limit points"),
    }
    plan.compute("thin wall", "the pressure of a wall without thickness, for comparison");
    plan.skip("states that are no spheres", "the solution is the sphere's own");
    (&["curve.csv", "states.csv", "stress.csv"], &["balloon.svg"])
}
