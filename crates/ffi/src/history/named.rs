//! Laws with history by name: the law, then its elastic parts, each with its own parts; numbers in the same order.

use piola::inelastic::AnyInelastic;
use serde_json::{Map, Value};

use super::text::history_from_value;
use crate::FfiError;
use crate::error::{check_finite, check_length};
use crate::named::{Resolved, in_order, list, words};

/// Parameters of a law: the object that they stand in, nothing for the law itself; the name; how many numbers, a list for more than one.
type Own = (&'static str, &'static str, usize);

const HARDENING: [Own; 4] = [
    ("hardening", "yield_stress", 1),
    ("hardening", "linear", 1),
    ("hardening", "saturation", 1),
    ("hardening", "saturation_exponent", 1),
];

/// The laws, their elastic parts, and their own parameters.
const HISTORIES: &[(&str, &[&str], &[Own])] = &[
    (
        "bergstrom_boyce",
        &["equilibrium", "overstress"],
        &[
            ("flow", "rate", 1),
            ("flow", "stress", 1),
            ("flow", "stress_exponent", 1),
            ("flow", "stretch_exponent", 1),
            ("flow", "perturbation", 1),
        ],
    ),
    ("reese_govindjee", &["equilibrium", "overstress"], &[("", "viscosity", 1), ("", "bulk_fluidity", 1)]),
    ("in_series", &["first", "second"], &[("", "viscosity", 1)]),
    ("viscoplastic", &["elastic"], &[HARDENING[0], HARDENING[1], HARDENING[2], HARDENING[3], ("", "viscosity", 1)]),
    (
        "kinematic",
        &["elastic", "back"],
        &[HARDENING[0], HARDENING[1], HARDENING[2], HARDENING[3], ("", "recovery", 1), ("", "viscosity", 1)],
    ),
    ("mullins", &["elastic"], &[("", "softening", 1), ("", "energy", 1), ("", "share", 1)]),
    ("driven_growth", &["elastic"], &[("", "rate", 1), ("", "bounds", 2), ("", "exponent", 1)]),
    ("given_growth", &["elastic"], &[]),
    ("thermal", &["elastic"], &[("expansion", "coefficient", 1), ("expansion", "reference_temperature", 1)]),
];

/// Whether a name begins with that of a law with history.
pub(crate) fn is_history(name: &str) -> bool {
    words(name).first().is_some_and(|word| HISTORIES.iter().any(|(law, _, _)| law == word))
}

/// A law with history whose name is resolved.
struct History {
    law: &'static str,
    springs: Vec<(&'static str, Resolved, Vec<String>)>,
    own: &'static [Own],
}

impl History {
    fn of(name: &str) -> Result<Self, FfiError> {
        let mut words = words(name).into_iter();
        let first = words.next().unwrap_or_default();
        let Some((law, parts, own)) = HISTORIES.iter().find(|(law, _, _)| *law == first) else {
            let valid = list(HISTORIES.iter().map(|(law, _, _)| *law));
            return Err(FfiError::UnknownChoice { choice: "law with history", given: first, valid });
        };
        let mut springs = Vec::new();
        for part in *parts {
            let resolved = Resolved::of_words(&mut words)?;
            let Some(numbers) = resolved.numbers() else {
                return Err(FfiError::WrongParameter {
                    law: resolved.law().to_owned(),
                    parameter: (*part).to_owned(),
                    what: "has vectors or terms: make the law from JSON",
                    valid: "numbers".to_owned(),
                });
            };
            springs.push((*part, resolved, numbers));
        }
        match words.next() {
            None => Ok(Self { law, springs, own }),
            Some(given) => {
                let valid = format!("no further parts of `{law}`");
                Err(FfiError::UnknownChoice { choice: "part of this law", given, valid })
            }
        }
    }

    /// The names of all numbers in their order.
    fn names(&self) -> Vec<String> {
        let springs =
            self.springs.iter().flat_map(|(part, _, names)| names.iter().map(move |name| format!("{part}.{name}")));
        let own = self.own.iter().flat_map(|(_, name, count)| {
            (0..*count).map(move |k| if *count == 1 { (*name).to_owned() } else { format!("{name}.{k}") })
        });
        springs.chain(own).collect()
    }

    fn with_values(&self, values: &[f64]) -> Result<AnyInelastic, FfiError> {
        let names = self.names();
        if names.len() != values.len() {
            let (law, expected) = (self.law.to_owned(), list(names.iter().map(String::as_str)));
            return Err(FfiError::WrongCount { law, expected, found: values.len() });
        }
        let mut law = Map::new();
        law.insert("law".into(), Value::from(self.law));
        let mut rest = values;
        for (part, spring, names) in &self.springs {
            let (own, others) = rest.split_at(names.len());
            rest = others;
            law.insert((*part).into(), spring.written(own)?);
        }
        for (object, name, count) in self.own {
            let (own, others) = rest.split_at(*count);
            rest = others;
            let value = match own {
                [value] => Value::from(*value),
                values => Value::from(values),
            };
            if object.is_empty() {
                law.insert((*name).into(), value);
            } else if let Some(inner) = law.entry(*object).or_insert_with(|| Map::new().into()).as_object_mut() {
                inner.insert((*name).into(), value);
            }
        }
        history_from_value(Value::Object(law))
    }
}

/// The law with history of a name and its parameters in their order: those of the elastic parts, then its own.
///
/// A name is followed by the names of the elastic parts, each with its own parts as [`solid`](crate::named::solid) takes them:
/// `bergstrom_boyce-neo_hookean-lame-neo_hookean-lame`.
///
/// | name | elastic parts | own parameters in their order |
/// |---|---|---|
/// | `bergstrom_boyce` | equilibrium, overstress | `rate`, `stress`, `stress_exponent`, `stretch_exponent`, `perturbation` |
/// | `reese_govindjee` | equilibrium, overstress | `viscosity`, `bulk_fluidity` |
/// | `in_series` | first, second | `viscosity` |
/// | `viscoplastic` | elastic | `yield_stress`, `linear`, `saturation`, `saturation_exponent`, `viscosity` |
/// | `kinematic` | elastic, back | the four of the hardening, `recovery`, `viscosity` |
/// | `mullins` | elastic | `softening`, `energy`, `share` |
/// | `driven_growth` | elastic | `rate`, `bounds`: two numbers, `exponent` |
/// | `given_growth` | elastic | – |
/// | `thermal` | elastic | `coefficient`, `reference_temperature` |
///
/// Elastic parts with vectors or terms are made from a text: [`history_from_json`](crate::history::text::history_from_json).
///
/// # Errors
/// [`FfiError::NotFinite`], [`FfiError::UnknownChoice`], [`FfiError::WrongCount`], [`FfiError::WrongParameter`];
/// [`FfiError::Unreadable`] with what the constructor of the law refuses.
///
/// # Example
/// ```
/// let law = piola_ffi::named::history("mullins-neo_hookean-lame", &[1.0, 2.0, 2.0, 0.25, 0.0])?;
/// assert_eq!(law.state_length(), 1);
/// # Ok::<(), piola_ffi::FfiError>(())
/// ```
pub fn history(name: &str, values: &[f64]) -> Result<AnyInelastic, FfiError> {
    check_finite("parameters", values)?;
    History::of(name)?.with_values(values)
}

/// The law with history of a name and parameters by name, in any order; those of elastic parts stand behind the part:
/// `overstress.shear_modulus`, `elastic.volumetric.exponent`, and one of a list behind its number, `bounds.0`.
///
/// # Errors
/// As [`history`]; [`FfiError::WrongParameter`] for a parameter that is unknown, missing or given twice;
/// [`FfiError::WrongLength`] unless there is a value for each name.
///
/// # Example
/// ```
/// let names = ["elastic.shear_modulus", "elastic.first_lame_parameter", "coefficient", "reference_temperature"];
/// let law = piola_ffi::named::history_with_names("thermal-hencky-lame", &names, &[1.0, 2.0, 1e-5, 293.15])?;
/// assert_eq!(law, piola_ffi::named::history("thermal-hencky-lame", &[1.0, 2.0, 1e-5, 293.15])?);
/// # Ok::<(), piola_ffi::FfiError>(())
/// ```
pub fn history_with_names(name: &str, names: &[&str], values: &[f64]) -> Result<AnyInelastic, FfiError> {
    check_length("values", names.len(), values.len())?;
    check_finite("parameters", values)?;
    let law = History::of(name)?;
    let own = law.names();
    let wrong = |parameter: &str, what| FfiError::WrongParameter {
        law: law.law.to_owned(),
        parameter: parameter.to_owned(),
        what,
        valid: list(own.iter().map(String::as_str)),
    };
    let own: Vec<&str> = own.iter().map(String::as_str).collect();
    law.with_values(&in_order(&own, |number, name| own[number] == name, names, values, wrong)?)
}

/// The number of internal variables of the law with this name, whatever its parameters are.
///
/// # Errors
/// [`FfiError::UnknownChoice`] and [`FfiError::WrongParameter`] of any part, as [`history`].
///
/// # Example
/// ```
/// assert_eq!(piola_ffi::named::state_length("KINEMATIC-HENCKY-LAME-HENCKY-LAME")?, 19);
/// # Ok::<(), piola_ffi::FfiError>(())
/// ```
pub fn state_length(name: &str) -> Result<usize, FfiError> {
    let law = History::of(name)?.law;
    AnyInelastic::state_length_of(law).ok_or_else(|| FfiError::UnknownChoice {
        choice: "law with history",
        given: law.to_owned(),
        valid: list(HISTORIES.iter().map(|(law, _, _)| *law)),
    })
}
