//! The numbers and tables of a robot's motion.

use core::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::{RobotMotion, RobotStudy, figure, gltf};

/// The results of `summary.json`.
pub(in crate::studies) fn results(found: &RobotMotion) -> Value {
    let named = |key: &str, pairs: &[(f64, String)]| -> Value {
        pairs.iter().map(|(t, name)| json!({ "time_s": t, key: name })).collect()
    };
    let mut last = Map::new();
    if let Some(sample) = found.samples.last() {
        last.extend(found.names.iter().zip(&sample.q).map(|(name, &q)| (name.clone(), q.into())));
    }
    json!({
        "reached_s": found.reached,
        "steps": found.cost[0],
        "rejected_steps": found.cost[1],
        "force_evaluations": found.cost[2],
        "relative_error_of_energy_balance": found.energy_error,
        "singular_positions": named("closure", &found.singular_positions),
        "joints_beyond_their_limits": named("joint", &found.beyond_limits),
        "coordinates_at_the_end": last,
    })
}

/// A file of the plan by its name.
pub(in crate::studies) fn file(found: &RobotMotion, asked: &RobotStudy, title: &str, name: &str) -> Option<String> {
    match name {
        "coordinates.csv" => Some(coordinates(found, asked)),
        "energies.csv" => Some(energies(found)),
        "coordinates.svg" => Some(figure::coordinates(found, asked, title)),
        "energies.svg" => Some(figure::energies(found, title)),
        "motion.gltf" => gltf::animation(found, asked, title),
        _ => None,
    }
}

fn coordinates(found: &RobotMotion, asked: &RobotStudy) -> String {
    let mut text = String::from("time_s");
    let rates = asked.names[1].iter().map(|name| format!("rate of {name}"));
    for name in asked.names[0].iter().cloned().chain(rates) {
        let quote = if name.contains([',', '"', '\n']) { "\"" } else { "" };
        let _ = write!(text, ",{quote}{}{quote}", name.replace('"', "\"\""));
    }
    text.push('\n');
    for sample in &found.samples {
        let _ = write!(text, "{:?}", sample.t);
        for value in sample.q.iter().chain(&sample.v) {
            let _ = write!(text, ",{value:?}");
        }
        text.push('\n');
    }
    text
}

fn energies(found: &RobotMotion) -> String {
    let mut text =
        String::from("time_s,kinetic_J,potential_J,springs_J,work_of_torques_J,work_of_damping_J,work_of_friction_J\n");
    for sample in &found.samples {
        let _ = write!(text, "{:?}", sample.t);
        for value in sample.energies.iter().chain(&sample.works) {
            let _ = write!(text, ",{value:?}");
        }
        text.push('\n');
    }
    text
}
