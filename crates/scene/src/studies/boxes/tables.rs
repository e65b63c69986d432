//! Tables of fields on a box.

use core::fmt::Write as _;

use super::flow::FlowHistory;
use super::map::points_with_stride;
use super::motion::MotionHistory;
use super::statics::StaticField;
use super::{AXES, BoxFindings, Found};

impl BoxFindings {
    pub(in crate::studies) fn file(&self, title: &str, name: &str) -> Option<String> {
        match self {
            Self::Rectangle(found) => found.file(title, name),
            Self::Box(found) => found.file(title, name),
        }
    }
}

impl<const D: usize> Found<D> {
    fn file(&self, title: &str, name: &str) -> Option<String> {
        match (self, name) {
            (Self::Static(found), "field.csv") => Some(found.table()),
            (Self::Static(found), "displacement.svg") => Some(found.figure(title)),
            (Self::Motion(found), "energy.csv") => Some(found.energy_table()),
            (Self::Motion(found), "probes.csv") => Some(found.probe_table()),
            (Self::Motion(found), "motion.svg") => Some(found.figure(title)),
            (Self::Flow(found), "flow.csv") => Some(found.table()),
            (Self::Flow(found), "particles.csv") => Some(found.particle_table()),
            (Self::Flow(found), "flow.svg") => Some(found.figure(title)),
            _ => None,
        }
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

impl<const D: usize> StaticField<D> {
    fn table(&self) -> String {
        let mut text = format!("{},{}", names::<D>("", "_m"), names::<D>("u_", "_m"));
        for (a, b) in components::<D>() {
            let _ = write!(text, ",T_{}{}_Pa", AXES[a], AXES[b]);
        }
        text.push('\n');
        if self.displacement[0].is_empty() {
            return text;
        }
        for point in points_with_stride(&self.grid).0 {
            let place = values(self.grid.position(self.grid.indices(point)));
            let _ = write!(text, "{place},{}", values(self.displacement.iter().map(|list| list[point])));
            for (a, b) in components::<D>() {
                // Of a run that was stopped before, the stress is not known.
                let _ = match self.stress[a][b].get(point) {
                    Some(stress) => write!(text, ",{stress:?}"),
                    None => write!(text, ","),
                };
            }
            text.push('\n');
        }
        text
    }
}

impl<const D: usize> MotionHistory<D> {
    fn energy_table(&self) -> String {
        let unit = energy_unit::<D>();
        let mut text = format!("time_s,kinetic_energy_{unit},elastic_energy_{unit},energy_{unit}\n");
        for instant in &self.instants {
            let row = [instant.time, instant.kinetic_energy, instant.elastic_energy, instant.energy()];
            let _ = writeln!(text, "{}", values(row));
        }
        text
    }

    fn probe_table(&self) -> String {
        let mut text = format!("time_s,probe,{}\n", names::<D>("u_", "_m"));
        for instant in &self.instants {
            for (probe, displacement) in self.probes.iter().zip(&instant.displacements) {
                let _ = writeln!(text, "{:?},{},{}", instant.time, probe.name, values(*displacement));
            }
        }
        text
    }
}

impl<const D: usize> FlowHistory<D> {
    fn table(&self) -> String {
        let mut text = String::from("time_s,least_jacobian,certified_jacobian,courant_number,regriddings\n");
        for instant in &self.instants {
            let row = [instant.time, instant.least_jacobian, instant.certified_jacobian, instant.courant_number];
            let _ = writeln!(text, "{},{}", values(row), instant.regriddings);
        }
        text
    }

    fn particle_table(&self) -> String {
        let mut text = format!("{},{}\n", names::<D>("", "_m"), names::<D>("", "_at_first_m"));
        for (place, at_first) in &self.particles {
            let _ = writeln!(text, "{},{}", values(*place), values(*at_first));
        }
        text
    }
}

/// Energies of a rectangle are for a unit of depth.
pub(super) fn energy_unit<const D: usize>() -> &'static str {
    if D == 2 { "J_per_m" } else { "J" }
}
