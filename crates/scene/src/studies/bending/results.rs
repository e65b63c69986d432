//! The numbers of `summary.json`.

use serde_json::{Value, json};

use super::BendingCurve;

/// The results of `summary.json`.
pub(in crate::studies) fn results(found: &BendingCurve) -> Value {
    let states = found.shown.iter().zip(&found.shown_states).zip(&found.stresses);
    let states: Vec<Value> = states
        .map(|((angle, state), stresses)| {
            let hoop = |pick: fn(f64, f64) -> f64| stresses.iter().map(|at| at.stress[1]).reduce(pick);
            json!({
                "angle_rad": angle,
                "moment_N_m": state.moment,
                "axial_force_N": state.axial_force,
                "inner_radius_m": state.radii[0],
                "outer_radius_m": state.radii[1],
                "radius_without_stretch_m": found.length / angle,
                "least_hoop_stress_Pa": hoop(f64::min),
                "largest_hoop_stress_Pa": hoop(f64::max),
                "stress_on_inner_face_Pa": stresses.first().map(|at| at.stress[0]),
            })
        })
        .collect();
    json!({ "first_state": states.first(), "states": states })
}
