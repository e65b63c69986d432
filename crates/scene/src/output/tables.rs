//! CSV tables: units in the headers, numbers in the shortest form that reads back exactly.

use core::fmt::Write as _;

use piola_simulation::phase::PhaseAnswers;
use piola_simulation::questions::MechanismAnswers;

use super::Crossing;
use crate::model::{Scene, System};
use crate::run::{History, PartReaction, Run};

/// `time_s,body,x_m,y_m,z_m` with velocities where there are any: a form that can be a reference again.
pub(super) fn trajectory(history: &History) -> String {
    let moving = !history.velocities.is_empty();
    let mut text = String::from("time_s,body,x_m,y_m,z_m");
    text.push_str(if moving { ",vx_m_per_s,vy_m_per_s,vz_m_per_s\n" } else { "\n" });
    for (record, (time, positions)) in history.times.iter().zip(&history.positions).enumerate() {
        for (body, (name, [x, y, z])) in history.names.iter().zip(positions).enumerate() {
            let _ = write!(text, "{time:?},{name},{x:?},{y:?},{z:?}");
            if let Some([u, v, w]) = history.velocities.get(record).and_then(|velocities| velocities.get(body)) {
                let _ = write!(text, ",{u:?},{v:?},{w:?}");
            }
            text.push('\n');
        }
    }
    text
}

/// Invariants and their relative changes; a column is empty where nothing is conserved.
pub(super) fn invariants(history: &History) -> String {
    let mut text = String::from(
        "time_s,energy_J,relative_energy_drift,post_newtonian_energy_J,relative_post_newtonian_energy_drift,\
         relative_momentum_drift,relative_angular_momentum_drift,work_J\n",
    );
    let show = |x: Option<f64>| x.map(|x| format!("{x:?}")).unwrap_or_default();
    for (record, drift) in history.invariants.iter().zip(history.drift_series()) {
        let _ = writeln!(
            text,
            "{:?},{:?},{:?},{},{},{},{},{:?}",
            record.time,
            record.energy,
            drift.energy,
            show(record.post_newtonian_energy),
            show(drift.post_newtonian_energy),
            show(drift.momentum),
            show(drift.angular_momentum),
            record.work,
        );
    }
    text
}

/// Coordinates of a mechanism and their rates, or coordinates and momenta.
pub(super) fn coordinates(history: &History) -> String {
    let mut names = history.coordinate_names.clone();
    // Momenta have names of their own, rates those of their coordinates.
    if history.coordinates.first().is_some_and(|row| names.len() < row.len()) {
        names.extend(history.coordinate_names.iter().map(|name| format!("rate of {name}")));
    }
    columns(&history.times, &names, &history.coordinates)
}

/// Energies by part.
pub(super) fn energies(history: &History) -> String {
    columns(&history.times, &history.energy_names, &history.energies)
}

/// Crossings of a Poincaré section.
pub(super) fn section(history: &History, crossings: &[Crossing]) -> String {
    let times: Vec<f64> = crossings.iter().map(|(t, _)| *t).collect();
    let points: Vec<Vec<f64>> = crossings.iter().map(|(_, point)| point.clone()).collect();
    columns(&times, &history.coordinate_names, &points)
}

/// Estimates of the largest Lyapunov exponent over time.
pub(super) fn exponent(answers: &PhaseAnswers) -> String {
    let mut text = String::from("time_since_start_s,exponent_1_per_s\n");
    for [t, estimate] in &answers.estimates {
        let _ = writeln!(text, "{t:?},{estimate:?}");
    }
    text
}

/// Poisson brackets at every recorded instant.
pub(super) fn brackets(scene: &Scene, history: &History, answers: &PhaseAnswers) -> String {
    let System::Phase(system) = &scene.system else { return String::new() };
    let names: Vec<String> = system.questions.brackets.iter().map(|bracket| bracket.name.clone()).collect();
    columns(&history.times, &names, &answers.brackets)
}

/// Modes of small motions: frequency, growth and the displacement of each coordinate in phase and a quarter of a turn later.
pub(super) fn modes(history: &History, answers: &MechanismAnswers) -> String {
    let mut text = String::from("mode,angular_frequency_rad_per_s,growth_rate_1_per_s");
    for name in &history.coordinate_names {
        let _ = write!(text, ",{name}");
    }
    for name in &history.coordinate_names {
        let _ = write!(text, ",{name} in quadrature");
    }
    text.push('\n');
    for (number, mode) in answers.modes.iter().enumerate() {
        let _ = write!(text, "{},{:?},{:?}", number + 1, mode.angular_frequency, mode.growth_rate);
        for i in 0..2 * mode.shape.len() {
            let (shape, place) = (&mode.shape, i.checked_sub(mode.shape.len()));
            let displacement = place.map_or_else(|| shape[i], |i| mode.quadrature.get(i).copied().unwrap_or(0.0));
            let _ = write!(text, ",{displacement:?}");
        }
        text.push('\n');
    }
    text
}

/// Works of the forces of a mechanism since the start.
pub(super) fn works(history: &History) -> String {
    let names: Vec<String> = history.work_names.iter().map(|name| format!("work of {name} (J)")).collect();
    columns(&history.times, &names, &history.works)
}

/// Forces of constraints: tensions, forces of loops, drives.
pub(super) fn conditions(history: &History) -> String {
    columns(&history.times, &history.condition_names, &history.conditions)
}

/// What holds the parts of a mechanism beside gravity.
pub(super) fn reactions(history: &History) -> String {
    let mut text = String::from("time_s,part,fx_N,fy_N,fz_N,mx_N_m,my_N_m,mz_N_m\n");
    for (time, parts) in history.times.iter().zip(&history.reactions) {
        for (name, PartReaction { force: [x, y, z], moment: [a, b, c] }) in history.names.iter().zip(parts) {
            let _ = writeln!(text, "{time:?},{name},{x:?},{y:?},{z:?},{a:?},{b:?},{c:?}");
        }
    }
    text
}

/// A row for each instant, with a column for each name.
fn columns(times: &[f64], names: &[String], rows: &[Vec<f64>]) -> String {
    let mut text = String::from("time_s");
    for name in names {
        let _ = write!(text, ",{name}");
    }
    text.push('\n');
    for (time, row) in times.iter().zip(rows) {
        let _ = write!(text, "{time:?}");
        for value in row {
            let _ = write!(text, ",{value:?}");
        }
        text.push('\n');
    }
    text
}

/// Errors against the reference.
pub(super) fn reference(run: &Run) -> String {
    let mut text = String::from("time_s,body,error_m,relative_error\n");
    for body in run.errors.iter().flat_map(|errors| &errors.bodies) {
        for at in &body.at {
            let _ = writeln!(text, "{:?},{},{:?},{:?}", at.time, body.name, at.error, at.relative);
        }
    }
    text
}
