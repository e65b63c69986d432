//! The numbers and tables of a robot's motion.

use core::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::{RobotMotion, RobotStudy, figure, gltf};

impl RobotMotion {
    /// The results of `summary.json`.
    pub(in crate::studies) fn results(&self) -> Value {
        let named = |key: &str, pairs: &[(f64, String)]| -> Value {
            pairs.iter().map(|(t, name)| json!({ "time_s": t, key: name })).collect()
        };
        let mut last = Map::new();
        if let Some(sample) = self.samples.last() {
            last.extend(self.names.iter().zip(&sample.q).map(|(name, &q)| (name.clone(), q.into())));
        }
        json!({
            "reached_s": self.reached,
            "steps": self.cost[0],
            "rejected_steps": self.cost[1],
            "force_evaluations": self.cost[2],
            "relative_error_of_energy_balance": self.energy_error,
            "singular_positions": named("closure", &self.singular_positions),
            "joints_beyond_their_limits": named("joint", &self.beyond_limits),
            "coordinates_at_the_end": last,
        })
    }

    /// A file of the plan by its name.
    pub(in crate::studies) fn file(&self, asked: &RobotStudy, title: &str, name: &str) -> Option<String> {
        match name {
            "coordinates.csv" => Some(self.coordinates(asked)),
            "energies.csv" => Some(self.energies()),
            "coordinates.svg" => Some(figure::coordinates(self, asked, title)),
            "energies.svg" => Some(figure::energies(self, title)),
            "motion.gltf" => gltf::animation(self, asked, title),
            _ => None,
        }
    }

    fn coordinates(&self, asked: &RobotStudy) -> String {
        let mut text = String::from("time_s");
        let rates = asked.names[1].iter().map(|name| format!("rate of {name}"));
        for name in asked.names[0].iter().cloned().chain(rates) {
            let quote = if name.contains([',', '"', '\n']) { "\"" } else { "" };
            let _ = write!(text, ",{quote}{}{quote}", name.replace('"', "\"\""));
        }
        text.push('\n');
        for sample in &self.samples {
            let _ = write!(text, "{:?}", sample.t);
            for value in sample.q.iter().chain(&sample.v) {
                let _ = write!(text, ",{value:?}");
            }
            text.push('\n');
        }
        text
    }

    fn energies(&self) -> String {
        let mut text = String::from(
            "time_s,kinetic_J,potential_J,springs_J,work_of_torques_J,work_of_damping_J,work_of_friction_J\n",
        );
        for sample in &self.samples {
            let _ = write!(text, "{:?}", sample.t);
            for value in sample.energies.iter().chain(&sample.works) {
                let _ = write!(text, ",{value:?}");
            }
            text.push('\n');
        }
        text
    }
}
