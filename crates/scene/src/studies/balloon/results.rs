//! The numbers of `summary.json`.

use serde_json::{Value, json};

use super::{BalloonCurve, is_stable};

/// The results of `summary.json`.
pub(in crate::studies) fn results(found: &BalloonCurve) -> Value {
    let limits: Vec<Value> = found
        .limits
        .iter()
        .map(|limit| {
            let kind = if found.is_maximum(limit) { "maximum" } else { "minimum" };
            json!({ "kind": kind, "stretch": limit.parameter, "pressure_Pa": limit.load })
        })
        .collect();
    let states: Vec<Value> = found
        .states
        .iter()
        .map(|state| {
            json!({ "stretch": state.parameter, "pressure_Pa": state.load, "stable_under_pressure": is_stable(state) })
        })
        .collect();
    json!({
        "first_limit_point": limits.first(),
        "limit_points": limits,
        "states": states,
        "largest_imbalance_of_a_half": found.imbalance,
    })
}
