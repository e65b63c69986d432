//! Sections from checked records.

use super::HenonHeiles;
use crate::document::Mistake;
use crate::model::Builder;
use crate::validation::Record;

impl Builder<'_> {
    pub(in crate::studies) fn henon_heiles(&mut self, table: &Record) -> Option<HenonHeiles> {
        let energies = table.numbers("energies")?.to_vec();
        if let Some(energy) = energies.iter().find(|energy| !(0.0 < **energy && **energy <= 1.0 / 6.0)) {
            self.wrong(
                Mistake::new(table.place_of("energies"), format!("the energy {energy} of no bound motion"))
                    .valid("energies greater than 0 and at most 1/6"),
            );
            return None;
        }
        Some(HenonHeiles {
            energies,
            orbits: table.count("orbits")?,
            crossings: table.count("crossings")?,
            duration: table.number("duration")?,
            tolerance: table.number("tolerance")?,
        })
    }
}
