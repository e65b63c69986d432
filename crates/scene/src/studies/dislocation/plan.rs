//! The plan.

use super::{ScrewDislocations, Screws};
use crate::studies::StudyPlan;
use crate::studies::panel::quantity;

/// Fills a plan; the tables and figures of this study.
pub(in crate::studies) fn plan(
    asked: &ScrewDislocations,
    plan: &mut StudyPlan,
) -> (&'static [&'static str], &'static [&'static str]) {
    let screws = match asked.spread {
        Screws::Uniform { density } => format!("of density {density:e} 1/m everywhere"),
        Screws::Core { burgers, radius } => {
            format!("of {} in all, half of them within {}", quantity("m", burgers), quantity("m", radius))
        }
    };
    let count = asked.radii.len();
    plan.system = format!("a crystal with screw dislocations {screws}, and {count} circuit{}", plural(count));
    plan.method = "Burgers vectors by quadrature around circles; development by parallel transport".to_string();
    plan.reason = "the two are independent: one integrates K⁻¹, the other the connection that K makes".to_string();
    plan.compute("development", "the largest circuit as it runs in the crystal, in arcs");
    plan.compute("torsion", "along a radius, by exact derivatives of K");
    plan.compute("flatness", "of the crystal and of an isotropic solid with the same K");
    plan.skip("stress", "dislocations without a law: how the lattice lies, not what it carries");
    (&["circuits.csv", "development.csv", "torsion.csv"], &["burgers.svg"])
}

pub(super) const fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}
