//! The numbers of `summary.json`.

use serde_json::{Value, json};

use super::Arrivals;

/// The results of `summary.json`.
pub(in crate::studies) fn results(found: &Arrivals) -> Value {
    let last = found.arrival.iter().filter_map(|(place, time)| Some((*place, (*time)?)));
    let last = last.max_by(|a, b| a.1.total_cmp(&b.1));
    json!({
        "characteristics": found.rays,
        "last_place": last.map(|(place, time)| json!({ "time_s": time, "place_m": place })),
        "first_loss_of_invertibility": found.first_loss.map(|loss| json!({
            "time_s": loss.time,
            "closed_form_s": found.closed_form_of_first_loss,
            "place_m": loss.place,
            "angle_rad": loss.angle,
        })),
        "points_not_reached": found.uncovered,
        "largest_residual_on_characteristics": found.drift,
        "largest_residual_on_grid": found.residual,
        "largest_difference_of_grid_s": found.difference,
    })
}
