//! Constraints on mechanisms from checked records.

use piola_document::units::Dimension;
use piola_document::{Mistake, Record};
use piola_simulation::constraints::{Constraint, ConstraintKind};

use super::forces::Surroundings;
use super::{Builder, System};
use piola_expression::text;

impl Surroundings<'_> {
    /// A direction of any length as a unit vector.
    fn direction(record: &Record, key: &str, direction: [f64; 3]) -> Result<[f64; 3], Box<Mistake>> {
        // Divided by the largest component first: squares neither overflow nor vanish.
        let largest = direction.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
        let scaled = direction.map(|x| x / largest);
        let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
        if largest <= 0.0 {
            return Err(Mistake::new(record.place_of(key), format!("`{key}` is zero"))
                .valid("a direction, as [0, 0, 1]")
                .into());
        }
        Ok(scaled.map(|x| x / length))
    }

    fn tie(&self, record: &Record) -> Result<ConstraintKind, Box<Mistake>> {
        match record.text("type").unwrap_or_default() {
            "prescribed" => {
                let coordinate = self.coordinate(record)?;
                let dimension = if self.mechanism.angular[coordinate] { Dimension::ANGLE } else { Dimension::LENGTH };
                let motion = text::of_key(record, "motion", &self.names, dimension)?;
                if motion.coordinates().max(motion.conjugates()) != 0 {
                    return Err(Mistake::new(record.place_of("motion"), "the motion depends on a coordinate")
                        .valid("an expression of t alone")
                        .into());
                }
                Ok(ConstraintKind::Prescribed { coordinate, motion })
            }
            "rolling" => {
                let unit =
                    |key: &str| record.vector(key).map(|direction| Self::direction(record, key, direction)).transpose();
                let centre = self.anchor(record, "body", "centre_at")?;
                if self.mechanism.tree.coordinates_of(&centre).next().is_none() {
                    return Err(Mistake::new(record.place_of("body"), "nothing moves the body")
                        .valid("a body that coordinates move, as on a free joint")
                        .into());
                }
                let (radius, normal) = (record.number("radius").unwrap_or_default(), unit("normal")?);
                Ok(ConstraintKind::Rolling {
                    centre,
                    radius,
                    axis: unit("axis")?,
                    normal: normal.unwrap_or([0.0, 0.0, 1.0]),
                })
            }
            kind => {
                let ends = [self.anchor(record, "from", "from_at")?, self.anchor(record, "to", "to_at")?];
                self.apart(record, &ends)?;
                if kind == "loop" {
                    return Ok(ConstraintKind::Loop { ends });
                }
                let places = self.places(&ends);
                let length = record.number("length").unwrap_or_else(|| (places[1] - places[0]).norm());
                if length <= 0.0 {
                    return Err(Mistake::new(record.place.clone(), "the points are one at the start")
                        .valid("length = their distance, or type = \"loop\"")
                        .into());
                }
                Ok(ConstraintKind::Distance { ends, length })
            }
        }
    }
}

impl Builder<'_> {
    /// The constraints of a scene.
    pub(super) fn constraints(&mut self, scene: &Record, surroundings: &Surroundings<'_>) -> Option<Vec<Constraint>> {
        let records = scene.records("constraint");
        self.unique_names(&[records]);
        let mut constraints = Vec::with_capacity(records.len());
        for record in records {
            if ["length", "radius"].iter().any(|key| record.has(key) && record.number(key).is_none()) {
                continue;
            }
            if record.text("type") == Some("rolling") && !record.has("radius") {
                continue;
            }
            match surroundings.tie(record) {
                Ok(kind) => {
                    constraints.push(Constraint { name: record.text("name").unwrap_or_default().to_string(), kind });
                }
                Err(mistake) => self.wrong(*mistake),
            }
        }
        (constraints.len() == records.len()).then_some(constraints)
    }

    /// Refuses methods of fixed step for constraints.
    pub(super) fn keeps_constraints(&mut self, scene: &Record) {
        let adaptive = "an adaptive method, as \"dormand-prince-853\", which brings every step back to the constraints";
        if let Some(integrator) = scene.record("integrator").filter(|_| !scene.records("constraint").is_empty()) {
            let method = integrator.text("method").unwrap_or_default();
            if method.starts_with("gauss") || method.starts_with("composition") || integrator.has("step") {
                let key = if integrator.has("step") { "step" } else { "method" };
                self.refuse(integrator.place_of(key), "a fixed step with constraints", adaptive);
            }
        }
    }

    /// Refuses the closed form of a mechanism that has none.
    pub(super) fn has_closed_form(&mut self, scene: &Record, system: Option<&System>) {
        if let (Some(System::Mechanism(system)), Some(integrator)) = (system, scene.record("integrator"))
            && integrator.text("method") == Some("closed-form")
            && !system.has_closed_form()
        {
            self.refuse(
                integrator.place_of("method"),
                "the mechanism has no closed form",
                "one body on a spherical joint, symmetric about the third axis of the joint, with its centre of mass on it, the second angle between 0 and pi at the start, under gravity along -z alone, without [[force]] and [[constraint]]; or another method",
            );
        }
    }

    /// Refuses reactions of what has none.
    pub(crate) fn has_reactions(&mut self, scene: &Record) {
        if let Some(output) = scene.record("output")
            && output.flag("reactions") == Some(true)
            && !scene.has("mechanism")
        {
            self.refuse(
                output.place_of("reactions"),
                "`reactions` of a scene without joints",
                "reactions = true in a [mechanism]",
            );
        }
    }
}
