//! Tables of fields on a box.

use core::fmt::Write as _;

use super::figure;
use super::{AXES, BoxFindings, FlowHistory, Found, MotionHistory, StaticField};
use piola_studies::internal::points_with_stride;

pub(in crate::studies) fn file(found: &BoxFindings, title: &str, name: &str) -> Option<String> {
    match found {
        BoxFindings::Rectangle(found) => file_of(found, title, name),
        BoxFindings::Box(found) => file_of(found, title, name),
    }
}

fn file_of<const D: usize>(found: &Found<D>, title: &str, name: &str) -> Option<String> {
    match (found, name) {
        (Found::Static(found), "field.csv") => Some(field_table(found)),
        (Found::Static(found), "displacement.svg") => Some(figure::displacement(found, title)),
        (Found::Motion(found), "energy.csv") => Some(energy_table(found)),
        (Found::Motion(found), "probes.csv") => Some(probe_table(found)),
        (Found::Motion(found), "motion.svg") => Some(figure::motion(found, title)),
        (Found::Flow(found), "flow.csv") => Some(flow_table(found)),
        (Found::Flow(found), "particles.csv") => Some(particle_table(found)),
        (Found::Flow(found), "flow.svg") => Some(figure::flow(found, title)),
        _ => None,
    }
}

/// Names of components: `x_m,y_m,z_m`.
fn names<const D: usize>(before: &str, after: &str) -> String {
    AXES[..D].iter().map(|axis| format!("{before}{axis}{after}")).collect::<Vec<_>>().join(",")
}

fn values(numbers: impl IntoIterator<Item = f64>) -> String {
    numbers.into_iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(",")
}

/// Row and column of the components of the stress, each once.
pub(super) fn components<const D: usize>() -> impl Iterator<Item = (usize, usize)> {
    (0..D).map(|a| (a, a)).chain((0..D).flat_map(|a| (a + 1..D).map(move |b| (a, b))))
}

fn field_table<const D: usize>(found: &StaticField<D>) -> String {
    let mut text = format!("{},{}", names::<D>("", "_m"), names::<D>("u_", "_m"));
    for (a, b) in components::<D>() {
        let _ = write!(text, ",T_{}{}_Pa", AXES[a], AXES[b]);
    }
    text.push('\n');
    if found.displacement[0].is_empty() {
        return text;
    }
    for point in points_with_stride(&found.grid).0 {
        let place = values(found.grid.position(found.grid.indices(point)));
        let _ = write!(text, "{place},{}", values(found.displacement.iter().map(|list| list[point])));
        for (a, b) in components::<D>() {
            // Of a run that was stopped before, the stress is not known.
            let _ = match found.stress[a][b].get(point) {
                Some(stress) => write!(text, ",{stress:?}"),
                None => write!(text, ","),
            };
        }
        text.push('\n');
    }
    text
}

fn energy_table<const D: usize>(found: &MotionHistory<D>) -> String {
    let unit = energy_unit::<D>();
    let mut text = format!("time_s,kinetic_energy_{unit},elastic_energy_{unit},energy_{unit}\n");
    for instant in &found.instants {
        let row = [instant.time, instant.kinetic_energy, instant.elastic_energy, instant.energy()];
        let _ = writeln!(text, "{}", values(row));
    }
    text
}

fn probe_table<const D: usize>(found: &MotionHistory<D>) -> String {
    let mut text = format!("time_s,probe,{}\n", names::<D>("u_", "_m"));
    for instant in &found.instants {
        for (probe, displacement) in found.probes.iter().zip(&instant.displacements) {
            let _ = writeln!(text, "{:?},{},{}", instant.time, probe.name, values(*displacement));
        }
    }
    text
}

fn flow_table<const D: usize>(found: &FlowHistory<D>) -> String {
    let mut text = String::from("time_s,least_jacobian,certified_jacobian,courant_number,regriddings\n");
    for instant in &found.instants {
        let row = [instant.time, instant.least_jacobian, instant.certified_jacobian, instant.courant_number];
        let _ = writeln!(text, "{},{}", values(row), instant.regriddings);
    }
    text
}

fn particle_table<const D: usize>(found: &FlowHistory<D>) -> String {
    let mut text = format!("{},{}\n", names::<D>("", "_m"), names::<D>("", "_at_first_m"));
    for (place, at_first) in &found.particles {
        let _ = writeln!(text, "{},{}", values(*place), values(*at_first));
    }
    text
}

/// Energies of a rectangle are for a unit of depth.
pub(super) fn energy_unit<const D: usize>() -> &'static str {
    if D == 2 { "J_per_m" } else { "J" }
}
