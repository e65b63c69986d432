//! What a solved flow writes.

use core::fmt::Write as _;

use piola_charts::{Folder, Panel, Written, figure};
use serde_json::json;

use crate::flow::{Answered, SolvedFlow};

impl SolvedFlow {
    /// A number of the flow by its name.
    #[must_use]
    pub fn answer(&self, name: &str) -> Option<Answered> {
        self.answers.iter().find(|answer| answer.name == name).copied()
    }

    /// A table for a reader.
    #[must_use]
    pub fn table(&self) -> String {
        let mut text = format!("{} of a {} fluid\n\n", self.flow, self.fluid.name());
        for Answered { name, unit, value, error } in &self.answers {
            let _ = write!(text, "{:<26}{value:>15.6e} {unit:<7}", name.replace('_', " "));
            match error {
                Some(error) => {
                    let _ = writeln!(text, "± {error:.0e}");
                }
                None => text.push('\n'),
            }
        }
        text
    }

    /// The numbers, as they stand in `summary.json`.
    #[must_use]
    pub fn summary(&self) -> String {
        let summary = json!({
            "flow": self.flow,
            "fluid": serde_json::to_value(&self.fluid).unwrap_or_default(),
            "answers": serde_json::to_value(&self.answers).unwrap_or_default(),
        });
        let mut text = serde_json::to_string_pretty(&summary).unwrap_or_default();
        text.push('\n');
        text
    }

    /// What `velocity` of the profile is, with its unit.
    fn velocity(&self) -> [&'static str; 2] {
        if self.flow == "couette" { ["angular velocity", "rad/s"] } else { ["velocity", "m/s"] }
    }

    /// What `position` of the profile is.
    fn position(&self) -> &'static str {
        match self.flow.as_str() {
            "channel" => "distance from the middle",
            "film" => "distance from the free surface",
            _ => "radius",
        }
    }

    /// Writes summary, profile and figure.
    #[must_use]
    pub fn write(&self, folder: &Folder) -> Written {
        let ([velocity, unit], position) = (self.velocity(), self.position());
        let mut csv = format!("{position} [m],{velocity} [{unit}],shear stress [Pa],shear rate [1/s]\n");
        for point in &self.profile {
            let (x, v, stress, rate) = (point.position, point.velocity, point.shear_stress, point.shear_rate);
            let _ = writeln!(csv, "{x:?},{v:?},{stress:?},{rate:?}");
        }
        let files = [("summary.json", self.summary()), ("profile.csv", csv), ("profile.svg", self.figure())];
        Written::of(folder, files)
    }

    /// Velocity and shear stress across the flow.
    fn figure(&self) -> String {
        let ([velocity, unit], position) = (self.velocity(), self.position());
        // Lengths of instruments are millimetres.
        let line = |of: &dyn Fn(&crate::ProfilePoint) -> f64| -> Vec<(f64, f64)> {
            self.profile.iter().map(|point| (1e3 * point.position, of(point))).collect()
        };
        let panel = |name: &str, unit: &str, line: Vec<(f64, f64)>| Panel {
            name: name.to_owned(),
            axes: [format!("{position} (mm)"), format!("{name} ({unit})")],
            points: line.iter().step_by(20).copied().collect(),
            curves: vec![line],
            is_curve: true,
        };
        let panels = [
            panel(velocity, unit, line(&|point| point.velocity)),
            panel("shear stress", "Pa", line(&|point| point.shear_stress)),
        ];
        let title = format!("{} of a {} fluid", self.flow, self.fluid.name());
        figure((760, 420), &title, &|area| {
            for (panel, part) in panels.iter().zip(area.split_evenly((1, 2))) {
                panel.draw(&part)?;
            }
            Ok(())
        })
    }
}
