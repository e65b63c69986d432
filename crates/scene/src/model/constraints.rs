//! Constraints on mechanisms from checked records.

use piola_document::units::Dimension;
use piola_document::{Mistake, Record};
use piola_simulation::constraints::{Constraint, ConstraintKind};

use super::Builder;
use super::forces::Surroundings;
use piola_expression::text;

impl Surroundings<'_> {
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
            if record.has("length") && record.number("length").is_none() {
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
