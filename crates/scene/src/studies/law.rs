//! The law of a solid, read from `[law]`.

use piola_solids::SolidsError;
use piola_solids::isochoric::{ArrudaBoyce, Gent, Isochoric, MooneyRivlin, NeoHookean, Yeoh};

use super::RubberLaw;
use super::panel::quantity;
use crate::model::Builder;
use piola_document::Record;

/// A law in words, with the scale of its stresses.
pub(super) fn material(law: &RubberLaw) -> String {
    format!("{} rubber of shear modulus {}", law.name(), quantity("Pa", law.shear_modulus()))
}

impl Builder<'_> {
    /// The law of a scene of the kind `name`.
    pub(super) fn law(&mut self, scene: &Record, name: &str) -> Option<RubberLaw> {
        let Some(table) = scene.record("law") else {
            if !scene.has("law") {
                self.refuse(
                    scene.place_of(name),
                    format!("[{name}] without a law"),
                    "a table [law], as type = \"neo-hookean\" and shear_modulus = \"0.4 MPa\"",
                );
            }
            return None;
        };
        let number = |key: &str| table.number(key);
        let (made, key) = match table.text("type")? {
            "neo-hookean" => (NeoHookean::new(number("shear_modulus")?).map(RubberLaw::from), "shear_modulus"),
            "mooney-rivlin" => (MooneyRivlin::new(number("c10")?, number("c01")?).map(RubberLaw::from), "c10"),
            "yeoh" => (Yeoh::new(number("c1")?, number("c2")?, number("c3")?).map(RubberLaw::from), "c1"),
            "gent" => (Gent::new(number("shear_modulus")?, number("limit")?).map(RubberLaw::from), "limit"),
            _ => (ArrudaBoyce::new(number("rubbery_modulus")?, number("links")?).map(RubberLaw::from), "links"),
        };
        match made {
            Ok(law) => Some(law),
            Err(error) => {
                let valid = match &error {
                    SolidsError::OutOfBounds { bound, .. } => format!("numbers with {bound}"),
                    _ => "finite numbers".to_string(),
                };
                self.refused(table.place_of(key), error.to_string(), valid)
            }
        }
    }
}
