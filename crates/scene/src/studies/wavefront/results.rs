//! The numbers of a study of wave fronts.

use serde_json::{Value, json};

use super::Fronts;

/// The results of `summary.json`.
pub(in crate::studies) fn results(found: &Fronts) -> Value {
    json!({
        "optical_length_m": found.fronts.last().map_or(0.0, |front| front.length),
        "fronts": found.fronts.len(),
        "rays": found.count,
        "largest_distance_of_neighbours_m": found.widest,
        "fronts_on_which_it_exceeds_the_spacing": found.too_wide,
        "rays_beyond_a_caustic": found.fronts.last().map_or(0, |front| front.beyond_caustic),
        "first_caustic": found.first_caustic().map(|first| json!({
            "optical_length_m": first.length,
            "place_m": first.place,
            "ray": first.parameter,
        })),
        "largest_relative_error_of_a_step": found.error,
        "largest_residual_of_eikonal": found.residual,
    })
}
