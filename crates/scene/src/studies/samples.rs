//! Samples of a study as a chart draws them.

use piola_charts::Lattice;
use piola_studies::PlaneSamples;

/// The samples for a chart.
pub(super) fn lattice(samples: &PlaneSamples) -> Lattice {
    let PlaneSamples { origin, spacing, points, values } = samples.clone();
    Lattice { origin, spacing, points, values }
}
