//! Bodies that attract each other.

use super::{Builder, Gravitation, MassPoint, NEWTONIAN_CONSTANT, PostNewtonian};
use piola_document::{Mistake, Record, words};

/// c, m/s.
const SPEED_OF_LIGHT: f64 = 299_792_458.0;
/// The part of c up to which terms of first order in v²/c² mean something.
const MOST_OF_LIGHT: f64 = 0.1;

impl Builder<'_> {
    pub(super) fn gravitation(&mut self, scene: &Record, table: &Record) -> Option<Gravitation> {
        let records = scene.records("body");
        self.unique_names(&[records]);
        if records.is_empty() {
            return self.refused(
                table.place.clone(),
                "[gravity] without bodies",
                "at least one [[body]] with name, gm or mass, position and velocity",
            );
        }
        let bodies: Vec<Option<MassPoint>> = records.iter().map(|record| self.mass_point(record)).collect();
        let softening = table.number("softening");
        if softening.is_some_and(|softening| softening <= 0.0) {
            self.bodies_apart(records, &bodies);
        }
        let post_newtonian = self.post_newtonian(table, records, &bodies);
        Some(Gravitation {
            bodies: bodies.into_iter().collect::<Option<_>>()?,
            softening: softening?,
            post_newtonian: post_newtonian?,
        })
    }

    fn mass_point(&mut self, record: &Record) -> Option<MassPoint> {
        let shown = record.text("name").unwrap_or("without a name").to_string();
        let elements = [
            "semi_major_axis",
            "eccentricity",
            "inclination",
            "ascending_node",
            "argument_of_pericentre",
            "mean_anomaly",
        ];
        for key in elements.into_iter().filter(|key| record.has(key)) {
            self.refuse(
                record.place_of(key),
                format!("`{key}` in a scene of [gravity]"),
                "position and velocity: orbital elements need [central]",
            );
        }
        if record.has("gm") == record.has("mass") {
            let what = if record.has("gm") { "both `gm` and `mass`" } else { "neither `gm` nor `mass`" };
            let place = if record.has("gm") { record.place_of("mass") } else { record.place.clone() };
            self.refuse(place, format!("the body {shown} has {what}"), "one of them");
        }
        for key in ["position", "velocity"].into_iter().filter(|key| !record.has(key)) {
            self.refuse(
                record.place.clone(),
                format!("the body {shown} lacks `{key}`"),
                format!(
                    "{key} = a list of 3 numbers, or a text such as \"[1, 0, 0] {}\"",
                    if key == "position" { "au" } else { "km/s" }
                ),
            );
        }
        Some(MassPoint {
            name: record.text("name")?.to_string(),
            gm: record.number("gm").or_else(|| Some(NEWTONIAN_CONSTANT * record.number("mass")?))?,
            position: record.vector("position")?,
            velocity: record.vector("velocity")?,
        })
    }

    /// Two bodies in one place attract each other infinitely.
    fn bodies_apart(&mut self, records: &[Record], bodies: &[Option<MassPoint>]) {
        let mut order: Vec<(usize, &MassPoint)> =
            bodies.iter().enumerate().filter_map(|(i, body)| body.as_ref().map(|body| (i, body))).collect();
        // Sorted by position, equal ones are neighbours; adding zero makes −0 equal to 0.
        let key = |body: &MassPoint| body.position.map(|x| (x + 0.0).to_bits());
        order.sort_by_key(|(index, body)| (key(body), *index));
        for pair in order.windows(2) {
            let ((first, one), (second, other)) = (pair[0], pair[1]);
            if key(one) == key(other) {
                self.wrong(
                    Mistake::new(
                        records[second].place_of("position"),
                        format!(
                            "`{}` and `{}` are in one place, {} m",
                            one.name,
                            other.name,
                            words::numbers(&one.position)
                        ),
                    )
                    .see(records[first].place_of("position"), format!("`{}` is here", one.name))
                    .valid("places apart, or gravity.softening greater than zero"),
                );
            }
        }
    }

    /// The outer `None` says that a mistake was made.
    #[expect(clippy::option_option, reason = "absent because not asked for, or because of a mistake")]
    fn post_newtonian(
        &mut self,
        table: &Record,
        records: &[Record],
        bodies: &[Option<MassPoint>],
    ) -> Option<Option<PostNewtonian>> {
        let names: Vec<&str> = records.iter().map(|record| record.text("name").unwrap_or("")).collect();
        let named =
            if table.has("central_body") { Some(self.find(table, "central_body", "body", &names)?) } else { None };
        if !table.flag("post_newtonian")? {
            return Some(None);
        }
        let heaviest = || {
            let gm = |index: &usize| bodies[*index].as_ref().map_or(0.0, |body| body.gm);
            (0..bodies.len()).reduce(|a, b| if gm(&a) < gm(&b) { b } else { a })
        };
        for (record, body) in records.iter().zip(bodies) {
            let Some(body) = body else { continue };
            let speed = body.velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
            // Squares overflow: infinity is too fast, too.
            if MOST_OF_LIGHT * SPEED_OF_LIGHT <= speed {
                self.refuse(
                    record.place_of("velocity"),
                    format!("the speed {} m/s with a post-Newtonian term of first order", words::number(speed)),
                    "less than a tenth of the speed of light, 299792458 m/s",
                );
            }
        }
        Some(Some(PostNewtonian { central: named.or_else(heaviest)? }))
    }
}
