//! The summary of fields on a box.

use serde_json::{Map, Value, json};

use super::flow::FlowHistory;
use super::map::size_at;
use super::motion::MotionHistory;
use super::statics::StaticField;
use super::tables::{components, energy_unit};
use super::{AXES, BoxFindings, Found};

impl BoxFindings {
    pub(in crate::studies) fn results(&self) -> Value {
        match self {
            Self::Rectangle(found) => found.results(),
            Self::Box(found) => found.results(),
        }
    }
}

impl<const D: usize> Found<D> {
    fn results(&self) -> Value {
        match self {
            Self::Static(found) => found.results(),
            Self::Motion(found) => found.results(),
            Self::Flow(found) => found.results(),
        }
    }
}

/// Forces of a rectangle are for a unit of depth.
fn force_unit<const D: usize>() -> &'static str {
    if D == 2 { "N_per_m" } else { "N" }
}

fn list<const D: usize>(numbers: [f64; D]) -> Value {
    numbers.to_vec().into()
}

impl<const D: usize> StaticField<D> {
    /// The largest displacement, m, and its place.
    #[must_use]
    pub fn largest_displacement(&self) -> Option<(f64, [f64; D])> {
        let sizes = (0..self.displacement[0].len()).map(|point| (size_at(&self.displacement, point), point));
        let (size, point) = sizes.max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some((size, self.grid.position(self.grid.indices(point))))
    }

    /// The largest size of a component of the stress, Pa.
    #[must_use]
    pub fn largest_stress(&self, row: usize, column: usize) -> Option<f64> {
        self.stress[row][column].iter().map(|stress| stress.abs()).reduce(f64::max)
    }

    /// The largest component of what loads and walls together leave over, over that of the loads: the error of the forces of the
    /// walls, which are sums of modes.
    #[must_use]
    pub fn unbalance(&self) -> Option<f64> {
        let (loads, walls) = (self.resultant?, self.wall_forces?);
        let size = loads.iter().fold(0.0, |size: f64, load| size.max(load.abs()));
        let left = (0..D).map(|axis| (loads[axis] + walls[axis][0] + walls[axis][1]).abs()).fold(0.0, f64::max);
        (0.0 < size).then(|| left / size)
    }

    fn results(&self) -> Value {
        let (force, energy) = (force_unit::<D>(), energy_unit::<D>());
        let mut stresses = Map::new();
        for (a, b) in components::<D>() {
            stresses.insert(format!("T_{}{}_Pa", AXES[a], AXES[b]), self.largest_stress(a, b).into());
        }
        let largest = self.largest_displacement();
        let mut results = Map::new();
        results.insert("points".into(), self.grid.points().to_vec().into());
        results.insert("largest_displacement_m".into(), largest.map(|(size, _)| size).into());
        results.insert("largest_displacement_at_m".into(), largest.map(|(_, place)| list(place)).into());
        results.insert("largest_stress".into(), stresses.into());
        results.insert(format!("elastic_energy_{energy}"), self.energy.into());
        results.insert(format!("resultant_of_loads_{force}"), self.resultant.map(list).into());
        if let Some(forces) = self.wall_forces {
            let both = (0..D).map(|axis| (AXES[axis].to_string(), list(forces[axis])));
            results.insert(format!("forces_of_near_and_far_walls_{force}"), both.collect::<Map<_, _>>().into());
            results.insert("relative_unbalance_of_loads_and_walls".into(), self.unbalance().into());
        }
        if let Some(lifted) = &self.lifted {
            results.insert("largest_force_normal_to_walls_N_per_m3".into(), lifted.overall().into());
        }
        if !self.probes.is_empty() {
            let displacements = self.probes.iter().map(|(probe, value)| (probe.name.clone(), list(*value)));
            results.insert("displacement_of_probes_m".into(), displacements.collect::<Map<_, _>>().into());
        }
        results.into()
    }
}

impl<const D: usize> MotionHistory<D> {
    fn results(&self) -> Value {
        let unit = energy_unit::<D>();
        let mut results = Map::new();
        results.insert("instants".into(), self.instants.len().into());
        results.insert("steps".into(), self.steps.into());
        for (when, instant) in [("start", self.instants.first()), ("end", self.instants.last())] {
            results.insert(format!("energy_at_{when}_{unit}"), instant.map(super::MotionInstant::energy).into());
        }
        if let Some(drift) = self.energy_drift() {
            results.insert("largest_relative_drift_of_energy".into(), drift.into());
        }
        if self.probes.is_empty() {
            return results.into();
        }
        let (mut largest, mut last) = (Map::new(), Map::new());
        for (index, probe) in self.probes.iter().enumerate() {
            let moved = || self.instants.iter().filter_map(|instant| instant.displacements.get(index));
            let sizes = moved().map(|u| u.iter().map(|x| x * x).sum::<f64>().sqrt());
            largest.insert(probe.name.clone(), sizes.reduce(f64::max).into());
            last.insert(probe.name.clone(), moved().next_back().map(|u| list(*u)).into());
        }
        results.insert("largest_displacement_of_probes_m".into(), largest.into());
        results.insert("displacement_of_probes_at_end_m".into(), last.into());
        results.into()
    }
}

impl<const D: usize> FlowHistory<D> {
    fn results(&self) -> Value {
        let speed = (0..self.velocity[0].len()).map(|point| size_at(&self.velocity, point)).fold(0.0, f64::max);
        let last = self.instants.last();
        let least = self.instants.iter().map(|instant| instant.least_jacobian).reduce(f64::min);
        let courant = self.instants.iter().map(|instant| instant.courant_number).reduce(f64::max);
        let moved = |(place, at_first): &([f64; D], [f64; D])| {
            place.iter().zip(at_first).map(|(x, a)| (x - a).powi(2)).sum::<f64>().sqrt()
        };
        let mut results = json!({
            "points": self.grid.points().to_vec(),
            "largest_speed_m_per_s": speed,
            "steps": self.instants.len(),
            "time_reached_s": last.map_or(0.0, |instant| instant.time),
            "duration_s": self.duration,
            "largest_courant_number": courant,
            "least_jacobian": least,
            "certified_jacobian": last.map(|instant| instant.certified_jacobian),
            "regriddings": last.map_or(0, |instant| instant.regriddings),
            "largest_distance_from_first_place_m": self.particles.iter().map(moved).reduce(f64::max),
        });
        if !self.probes.is_empty() {
            let places = self.probes.iter().map(|(probe, at_first)| (probe.name.clone(), list(*at_first)));
            results["place_of_probes_at_first_m"] = places.collect::<Map<_, _>>().into();
        }
        results
    }
}
