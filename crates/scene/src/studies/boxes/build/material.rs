//! Moduli and viscosities.

use piola_spectral::LameParameters;

use super::Lame;
use crate::model::Builder;
use piola_document::Record;

/// The two ways to state an elastic material.
const PAIRS: [[&str; 2]; 2] = [["young_modulus", "poisson_ratio"], ["shear_modulus", "first_lame_parameter"]];

impl Builder<'_> {
    /// λ and μ of the body, or of the fluid.
    pub(super) fn lame_parameters(&mut self, table: &Record, is_fluid: bool) -> Option<LameParameters> {
        if is_fluid {
            let made = LameParameters::new(table.number("second_viscosity")?, table.number("shear_viscosity")?);
            return self.checked(table, "second_viscosity", made);
        }
        let written = |pair: &[&str; 2]| pair.iter().filter(|key| table.has(key)).count();
        let [engineering, lame] = [written(&PAIRS[0]), written(&PAIRS[1])];
        match (engineering, lame) {
            (2, 0) => {
                let made = LameParameters::from_engineering(table.number(PAIRS[0][0])?, table.number(PAIRS[0][1])?);
                self.checked(table, "poisson_ratio", made)
            }
            (0, 2) => {
                let made = LameParameters::new(table.number(PAIRS[1][1])?, table.number(PAIRS[1][0])?);
                self.checked(table, "first_lame_parameter", made)
            }
            _ => {
                let keys: Vec<&str> = PAIRS.concat().into_iter().filter(|key| table.has(key)).collect();
                let (place, what) = match keys.last() {
                    Some(last) => (table.place_of(last), format!("a material of `{}`", keys.join("`, `"))),
                    None => (table.place.clone(), "an elastic [box] without a material".to_string()),
                };
                let valid = "`young_modulus` and `poisson_ratio`, or `first_lame_parameter` and `shear_modulus`";
                self.refused(place, what, valid)
            }
        }
    }

    fn checked(&mut self, table: &Record, key: &str, made: Lame) -> Option<LameParameters> {
        made.map_err(|error| {
            self.refuse(table.place_of(key), error.to_string(), "a material that holds this bound");
        })
        .ok()
    }
}
