//! CSV tables: units in the headers, numbers in the shortest form that reads back exactly.

use core::fmt::Write as _;

use crate::run::{History, Run};

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

/// Coordinates of a mechanism and their rates.
pub(super) fn coordinates(history: &History) -> String {
    let mut text = String::from("time_s");
    for name in &history.coordinate_names {
        let _ = write!(text, ",{name}");
    }
    for name in &history.coordinate_names {
        let _ = write!(text, ",rate of {name}");
    }
    text.push('\n');
    for (time, values) in history.times.iter().zip(&history.coordinates) {
        let _ = write!(text, "{time:?}");
        for value in values {
            let _ = write!(text, ",{value:?}");
        }
        text.push('\n');
    }
    text
}

/// Works of the forces of a mechanism since the start.
pub(super) fn works(history: &History) -> String {
    let mut text = String::from("time_s");
    for name in &history.work_names {
        let _ = write!(text, ",work of {name} (J)");
    }
    text.push('\n');
    for (time, works) in history.times.iter().zip(&history.works) {
        let _ = write!(text, "{time:?}");
        for work in works {
            let _ = write!(text, ",{work:?}");
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
