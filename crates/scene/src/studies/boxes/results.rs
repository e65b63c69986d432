//! The summary of fields on a box.

use serde_json::{Map, Value, json};

use super::tables::{components, energy_unit};
use super::{AXES, BoxFindings, FlowHistory, Found, MotionHistory, StaticField};
use piola_studies::internal::size_at;

pub(in crate::studies) fn results(found: &BoxFindings) -> Value {
    match found {
        BoxFindings::Rectangle(found) => of_found(found),
        BoxFindings::Box(found) => of_found(found),
    }
}

fn of_found<const D: usize>(found: &Found<D>) -> Value {
    match found {
        Found::Static(found) => of_statics(found),
        Found::Motion(found) => of_motion(found),
        Found::Flow(found) => of_flow(found),
    }
}

/// Forces of a rectangle are for a unit of depth.
fn force_unit<const D: usize>() -> &'static str {
    if D == 2 { "N_per_m" } else { "N" }
}

fn list<const D: usize>(numbers: [f64; D]) -> Value {
    numbers.to_vec().into()
}

fn of_statics<const D: usize>(found: &StaticField<D>) -> Value {
    let (force, energy) = (force_unit::<D>(), energy_unit::<D>());
    let mut stresses = Map::new();
    for (a, b) in components::<D>() {
        stresses.insert(format!("T_{}{}_Pa", AXES[a], AXES[b]), found.largest_stress(a, b).into());
    }
    let largest = found.largest_displacement();
    let mut results = Map::new();
    results.insert("points".into(), found.grid.points().to_vec().into());
    results.insert("largest_displacement_m".into(), largest.map(|(size, _)| size).into());
    results.insert("largest_displacement_at_m".into(), largest.map(|(_, place)| list(place)).into());
    results.insert("largest_stress".into(), stresses.into());
    results.insert(format!("elastic_energy_{energy}"), found.energy.into());
    results.insert(format!("resultant_of_loads_{force}"), found.resultant.map(list).into());
    if let Some(forces) = found.wall_forces {
        let both = (0..D).map(|axis| (AXES[axis].to_string(), list(forces[axis])));
        results.insert(format!("forces_of_near_and_far_walls_{force}"), both.collect::<Map<_, _>>().into());
        results.insert("relative_unbalance_of_loads_and_walls".into(), found.unbalance().into());
    }
    if let Some(lifted) = &found.lifted {
        results.insert("largest_force_normal_to_walls_N_per_m3".into(), lifted.overall().into());
    }
    if !found.probes.is_empty() {
        let displacements = found.probes.iter().map(|(probe, value)| (probe.name.clone(), list(*value)));
        results.insert("displacement_of_probes_m".into(), displacements.collect::<Map<_, _>>().into());
    }
    results.into()
}

fn of_motion<const D: usize>(found: &MotionHistory<D>) -> Value {
    let unit = energy_unit::<D>();
    let mut results = Map::new();
    results.insert("instants".into(), found.instants.len().into());
    results.insert("steps".into(), found.steps.into());
    for (when, instant) in [("start", found.instants.first()), ("end", found.instants.last())] {
        results.insert(format!("energy_at_{when}_{unit}"), instant.map(super::MotionInstant::energy).into());
    }
    if let Some(drift) = found.energy_drift() {
        results.insert("largest_relative_drift_of_energy".into(), drift.into());
    }
    if found.probes.is_empty() {
        return results.into();
    }
    let (mut largest, mut last) = (Map::new(), Map::new());
    for (index, probe) in found.probes.iter().enumerate() {
        let moved = || found.instants.iter().filter_map(|instant| instant.displacements.get(index));
        let sizes = moved().map(|u| u.iter().map(|x| x * x).sum::<f64>().sqrt());
        largest.insert(probe.name.clone(), sizes.reduce(f64::max).into());
        last.insert(probe.name.clone(), moved().next_back().map(|u| list(*u)).into());
    }
    results.insert("largest_displacement_of_probes_m".into(), largest.into());
    results.insert("displacement_of_probes_at_end_m".into(), last.into());
    results.into()
}

fn of_flow<const D: usize>(found: &FlowHistory<D>) -> Value {
    let speed = (0..found.velocity[0].len()).map(|point| size_at(&found.velocity, point)).fold(0.0, f64::max);
    let last = found.instants.last();
    let least = found.instants.iter().map(|instant| instant.least_jacobian).reduce(f64::min);
    let courant = found.instants.iter().map(|instant| instant.courant_number).reduce(f64::max);
    let moved = |(place, at_first): &([f64; D], [f64; D])| {
        place.iter().zip(at_first).map(|(x, a)| (x - a).powi(2)).sum::<f64>().sqrt()
    };
    let mut results = json!({
        "points": found.grid.points().to_vec(),
        "largest_speed_m_per_s": speed,
        "steps": found.instants.len(),
        "time_reached_s": last.map_or(0.0, |instant| instant.time),
        "duration_s": found.duration,
        "largest_courant_number": courant,
        "least_jacobian": least,
        "certified_jacobian": last.map(|instant| instant.certified_jacobian),
        "regriddings": last.map_or(0, |instant| instant.regriddings),
        "largest_distance_from_first_place_m": found.particles.iter().map(moved).reduce(f64::max),
    });
    if !found.probes.is_empty() {
        let places = found.probes.iter().map(|(probe, at_first)| (probe.name.clone(), list(*at_first)));
        results["place_of_probes_at_first_m"] = places.collect::<Map<_, _>>().into();
    }
    results
}
