//! Bodies about a fixed centre of attraction.

use super::{Builder, Central, Orbiter};
use piola_document::{Record, words};
use piola_gravitation::kepler::Elements;

const SHAPE: [&str; 2] = ["semi_major_axis", "eccentricity"];
const ANGLES: [&str; 4] = ["inclination", "ascending_node", "argument_of_pericentre", "mean_anomaly"];

impl Builder<'_> {
    pub(super) fn central(&mut self, scene: &Record, table: &Record) -> Option<Central> {
        let records = scene.records("body");
        self.unique_names(&[records]);
        if records.is_empty() {
            return self.refused(
                table.place.clone(),
                "[central] without bodies",
                "at least one [[body]] with a name and a state or orbital elements",
            );
        }
        let gm = table.number("gm");
        let bodies: Vec<Option<Orbiter>> = records.iter().map(|record| self.orbiter(record, gm)).collect();
        let central = Central { gm: gm?, bodies: bodies.into_iter().collect::<Option<_>>()? };
        let turns = scene.record("time").is_some_and(|time| time.has("revolutions"));
        if turns && central.period().is_none() {
            return self.refused(
                records[0].place.clone(),
                "the first body escapes, so there are no revolutions",
                "time.end, or a bound orbit",
            );
        }
        Some(central)
    }

    fn orbiter(&mut self, record: &Record, gm: Option<f64>) -> Option<Orbiter> {
        let shown = record.text("name").unwrap_or("without a name").to_string();
        if record.has("gm") {
            self.refuse(
                record.place_of("gm"),
                "`gm` of a body in a scene of [central]",
                "mass, or nothing: these bodies do not attract",
            );
        }
        let state = ["position", "velocity"];
        let has_state = state.iter().any(|key| record.has(key));
        let element = SHAPE.iter().chain(&ANGLES).find(|key| record.has(key));
        let wanted: &[&str] = if has_state { &state } else { &SHAPE };
        if let (true, Some(key)) = (has_state, element) {
            return self.refused(
                record.place_of(key),
                format!("the body {shown} has a state and orbital elements"),
                "position and velocity, or semi_major_axis and eccentricity with the angles",
            );
        }
        let missing: Vec<&str> = wanted.iter().copied().filter(|key| !record.has(key)).collect();
        if !missing.is_empty() {
            return self.refused(
                record.place.clone(),
                format!("the body {shown} lacks {}", missing.join(" and ")),
                "position and velocity, or semi_major_axis and eccentricity with the angles",
            );
        }
        let eccentricity = record.number("eccentricity");
        if let Some(e) = eccentricity.filter(|e| 1.0 <= *e) {
            return self.refused(
                record.place_of("eccentricity"),
                format!("the eccentricity {} is of no ellipse", words::number(e)),
                "a number from 0 to less than 1; give position and velocity of an escaping body",
            );
        }
        let (position, velocity) = if has_state {
            (record.vector("position")?, record.vector("velocity")?)
        } else {
            let angle = |key| if record.has(key) { record.number(key) } else { Some(0.0) };
            Elements {
                semi_major_axis: record.number("semi_major_axis")?,
                eccentricity: eccentricity?,
                inclination: angle("inclination")?,
                ascending_node: angle("ascending_node")?,
                argument_of_pericentre: angle("argument_of_pericentre")?,
                mean_anomaly: angle("mean_anomaly")?,
            }
            .state(gm?)
        };
        if position.iter().all(|x| x.abs() <= 0.0) {
            return self.refused(
                record.place_of("position"),
                format!("the body {shown} is in one place with the centre"),
                "a position other than the origin",
            );
        }
        let mass = if record.has("mass") { record.number("mass")? } else { 1.0 };
        Some(Orbiter { name: record.text("name")?.to_string(), mass, position, velocity })
    }
}
