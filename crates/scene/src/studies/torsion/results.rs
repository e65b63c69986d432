//! The numbers of `summary.json`.

use serde_json::{Value, json};

use super::RodCurves;

/// The results of `summary.json`.
pub(in crate::studies) fn results(found: &RodCurves) -> Value {
    let [first, last] = [found.states.first(), found.states.last()];
    let held = last.map(|state| {
        json!({
            "twist_rad_per_m": state.held.twist,
            "torque_N_m": state.held.torque,
            "axial_force_N": state.held.axial_force,
            "axial_force_of_twist_N":
                first.map(|first| state.held.axial_force - first.held.axial_force),
        })
    });
    let pulled = last.map(|state| {
        json!({
            "twist_rad_per_m": state.pulled.twist,
            "torque_N_m": state.pulled.torque,
            "axial_stretch": state.pulled.axial_stretch,
            "elongation_by_twist":
                first.map(|first| state.pulled.axial_stretch / first.pulled.axial_stretch - 1.0),
        })
    });
    let under: Vec<Value> = found
        .under_torque
        .iter()
        .map(|point| json!({ "twist_rad_per_m": point.parameter, "torque_N_m": point.load }))
        .collect();
    json!({ "held_at_largest_twist": held, "pulled_at_largest_twist": pulled, "states_under_torque": under })
}
