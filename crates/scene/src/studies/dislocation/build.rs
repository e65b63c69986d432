//! Crystals with screws from checked records.

use super::{ScrewDislocations, Screws};
use crate::model::Builder;
use piola_document::Record;
use piola_document::words;

impl Builder<'_> {
    pub(in crate::studies) fn screw_dislocations(&mut self, table: &Record) -> Option<ScrewDislocations> {
        let radii = table.numbers("radii")?.to_vec();
        let spread = match table.text("type")? {
            "uniform" => Screws::Uniform { density: table.number("density")? },
            _ => Screws::Core { burgers: table.number("burgers")?, radius: table.number("core_radius")? },
        };
        if let Some(radius) = radii.iter().find(|radius| **radius <= 0.0) {
            return self.refused(
                table.place_of("radii"),
                format!("a circuit of radius {} m", words::number(*radius)),
                "lengths greater than zero",
            );
        }
        Some(ScrewDislocations { spread, radii, centre: table.pair("centre")?, tolerance: table.number("tolerance")? })
    }
}
