//! The numbers of `summary.json`.

use serde_json::{Value, json};

use super::BurgersCircuits;
use piola_uniformity::Flatness;

/// The results of `summary.json`.
pub(in crate::studies) fn results(found: &BurgersCircuits) -> Value {
    let circuits: Vec<Value> = found
        .circuits
        .iter()
        .map(|circuit| {
            json!({
                "radius_m": circuit.radius,
                "burgers_vector_m": circuit.burgers,
                "error_m": circuit.error,
                "closed_form_m": circuit.closed_form,
            })
        })
        .collect();
    let flatness = |report: Option<Flatness>| {
        report.map(|report| {
            json!({
                "homogeneous": report.is_flat(),
                "largest_torsion_per_m": report.torsion.value,
                "relative_torsion": report.torsion.relative,
                "largest_curvature_per_m2": report.curvature.value,
                "relative_curvature": report.curvature.relative,
                "places": report.places,
            })
        })
    };
    json!({
        "circuits": circuits,
        "largest_relative_difference_from_closed_form": found.largest_difference(),
        "gap_of_development_m": found.in_crystal.last(),
        "holonomy_less_one": found.holonomy,
        "as_a_crystal": flatness(found.of_crystal),
        "as_an_isotropic_solid": flatness(found.of_isotropic_solid),
    })
}
