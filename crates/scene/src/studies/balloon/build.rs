//! Balloons from checked records.

use piola_solutions::loads::Shell;

use super::Balloon;
use crate::model::Builder;
use crate::studies::limits::{load_limit, reach};
use piola_document::Record;
use piola_document::words;

impl Builder<'_> {
    pub(in crate::studies) fn balloon(&mut self, scene: &Record, table: &Record) -> Option<Balloon> {
        let law = self.law(scene, "balloon");
        let radii = self.radii(table);
        let stretch = table.pair("stretch")?;
        if !(0.0 < stretch[0] && stretch[0] < stretch[1]) {
            return self.refused(
                table.place_of("stretch"),
                format!("stretches of {}", words::numbers(&stretch)),
                "two increasing numbers greater than zero",
            );
        }
        let [inner, outer] = radii?;
        let Ok(shell) = Shell::new(inner, outer) else { return None };
        let balloon =
            Balloon { shell, law: law?, stretch, pressure: table.number("pressure"), points: table.count("points")? };
        if let Err(error) = stretch.iter().try_for_each(|x| balloon.state(*x).map(|_| ())) {
            let valid = if balloon.state(1.0).is_ok() && 1.0 < stretch[1] {
                let most = reach((1.0, stretch[1]), |x| balloon.state(x).is_ok());
                format!("stretches below {most:.6}")
            } else {
                "stretches nearer to 1".to_string()
            };
            return self.refused(table.place_of("stretch"), error.to_string(), valid);
        }
        if table.has("pressure") {
            let pressure = table.number("pressure")?;
            if let Err(error) = balloon.states_at(pressure) {
                let limit = load_limit(&error, "Pa");
                let place = table.place_of("pressure");
                return self.refused(place, format!("no state carries the pressure: {error}"), limit);
            }
        }
        Some(balloon)
    }
}
