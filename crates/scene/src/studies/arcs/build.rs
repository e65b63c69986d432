//! Events from checked records.

use nalgebra::Vector3;

use super::{KeplerArcs, lambert};
use crate::document::Mistake;
use crate::model::Builder;
use crate::validation::Record;

/// Sine of the least angle between the places.
const LINED_UP: f64 = 1e-6;

impl Builder<'_> {
    pub(in crate::studies) fn kepler_arcs(&mut self, table: &Record) -> Option<KeplerArcs> {
        let [from, to] = ["from", "to"].map(|key| table.vector(key).map(Vector3::from));
        let (gm, from, to) = (table.number("gm")?, from?, to?);
        for (key, place) in [("from", from), ("to", to)] {
            if place.norm() <= 0.0 {
                self.wrong(
                    Mistake::new(table.place_of(key), format!("`{key}` is the centre"))
                        .valid("a place other than the origin"),
                );
                return None;
            }
        }
        if from.normalize().cross(&to.normalize()).norm() <= LINED_UP {
            self.wrong(
                Mistake::new(
                    table.place_of("to"),
                    "the places are in line with the centre, so that arcs have no plane",
                )
                .see(table.place_of("from"), "the other place")
                .valid("places at an angle other than 0° and 180°"),
            );
            return None;
        }
        let duration = table.number("duration")?;
        let arcs = KeplerArcs { gm, mass: table.number("mass")?, from, to, duration };
        self.few_enough(table, &arcs).then_some(arcs)
    }

    /// Whether there are finitely many arcs, and not too many.
    fn few_enough(&mut self, table: &Record, arcs: &KeplerArcs) -> bool {
        let (_, unit) = arcs.units();
        let longest = arcs.longest();
        if !(0.0 < unit && unit < f64::INFINITY && 0.0 < longest && longest < f64::INFINITY) {
            self.wrong(
                Mistake::new(table.place_of("from"), format!("lengths and gm make the time √(r³/gm) = {unit} s"))
                    .see(table.place_of("gm"), "gm")
                    .valid("places and gm of which it is a positive number"),
            );
            return false;
        }
        if arcs.duration <= longest {
            return true;
        }
        let most = lambert::MOST_REVOLUTIONS;
        let count = f64::from(2 + 4 * most) * (arcs.duration / longest);
        self.wrong(
            Mistake::new(
                table.place_of("duration"),
                format!("in {} s there are about {count:.1e} arcs", arcs.duration),
            )
            .valid(format!("at most {longest:.6e} s, in which no arc has more than {most} revolutions")),
        );
        false
    }
}
