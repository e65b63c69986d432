//! The numbers of `summary.json`.

use serde_json::{Value, json};

use super::{TubeState, TubeStresses};

fn results_of_state(found: &TubeState) -> Value {
    let [least, largest] = found.hoop_stresses();
    json!({
        "pressure_Pa": found.pressure,
        "inner_radius_m": found.radii[0],
        "outer_radius_m": found.radii[1],
        "axial_stretch": found.axial_stretch,
        "axial_force_N": found.axial_force,
        "hoop_moment_N": found.moment,
        "least_hoop_stress_Pa": least,
        "largest_hoop_stress_Pa": largest,
    })
}

/// The results of `summary.json`.
pub(in crate::studies) fn results(found: &TubeStresses) -> Value {
    let state = |state: Option<&TubeState>| state.map(results_of_state);
    let spread = |state: &TubeState| {
        let [least, largest] = state.hoop_stresses();
        largest - least
    };
    let ratio = found.loaded.as_ref().zip(found.homogeneous.as_ref());
    json!({
        "without_loads": state(found.at_rest.as_ref()),
        "under_pressure": state(found.loaded.as_ref()),
        "homogeneous_under_pressure": state(found.homogeneous.as_ref()),
        "range_of_hoop_stress_over_homogeneous": ratio.map(|(tube, other)| spread(tube) / spread(other)),
    })
}
