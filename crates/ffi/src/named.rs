//! Laws of solids by name, with their parameters as numbers in a fixed order or by name.
//!
//! A name is that of the law and those of its parts, with any of `-`, `+`, `(`, `)`, `,`, `/` or spaces between them, in
//! letters of either case: `mooney_rivlin`, `compressible-gent-simo_taylor`, `HENCKY-LAME`.
//!
//! | name | parts | parameters in their order, then those of the parts |
//! |---|---|---|
//! | `compressible` | isochoric, volumetric | – |
//! | `incompressible` | isochoric | – |
//! | `neo_hookean`, `hencky` | volumetric | `shear_modulus` |
//! | `ogden`, `isochoric_ogden` | volumetric | `terms`: modulus and exponent of each |
//! | `incompressible_ogden` | – | `terms` |
//! | `mooney_rivlin` | – | `c10`, `c01`, `square_coefficient` (the reference is free of stress) |
//! | `blatz_ko` | – | `shear_modulus`, `poisson_ratio`, `solid_fraction` |
//! | `saint_venant_kirchhoff` | – | `first_lame_parameter`, `shear_modulus` |
//! | `linear_elastic` | – | `shear_modulus`, `first_lame_parameter` |
//! | `holzapfel_gasser_ogden` | – | `shear_modulus`, `bulk_modulus`, `fibre_modulus`, `fibre_exponent`, `dispersion`, `fibres`: two vectors |
//! | `reinforced_neo_hookean` | – | `shear_modulus`, `first_lame_parameter`, `fibre_modulus`, `fibre`: a vector |
//!
//! | isochoric part | parameters |
//! |---|---|
//! | `neo_hookean` | `shear_modulus` |
//! | `mooney_rivlin` | `c10`, `c01` |
//! | `yeoh` | `c1`, `c2`, `c3` |
//! | `gent` | `shear_modulus`, `limit` |
//! | `arruda_boyce`, `arruda_boyce_series` | `rubbery_modulus`, `links` |
//!
//! | volumetric part | parameters |
//! |---|---|
//! | `quadratic`, `logarithmic`, `quadratic_logarithmic`, `simo_taylor`, `liu`, `miehe`, `hartmann_neff` | `bulk_modulus` |
//! | `lame` | `first_lame_parameter` |
//! | `ogden` | `bulk_modulus`, `exponent` |
//!
//! Laws with tables of coefficients (`polynomial`, `rivlin`, `fung`, the anisotropic ones) are made from a text:
//! [`solid_from_json`](crate::text::solid_from_json).

use piola::solids::AnySolid;
use serde_json::{Map, Value};

use crate::FfiError;
use crate::error::check_finite;
use crate::text::solid_from_value;

/// Parameters of a law in their order.
#[derive(Clone, Copy)]
enum Slot {
    /// One number.
    Number(&'static str),
    /// So many vectors of three numbers: one, or a list.
    Vectors(&'static str, usize),
    /// Pairs of a modulus and an exponent, as many as there are.
    Terms(&'static str),
}
use Slot::{Number, Terms, Vectors};

impl Slot {
    const fn name(self) -> &'static str {
        match self {
            Number(name) | Vectors(name, _) | Terms(name) => name,
        }
    }

    /// How many numbers it takes at least.
    const fn least(self) -> usize {
        match self {
            Number(_) => 1,
            Vectors(_, count) => 3 * count,
            Terms(_) => 2,
        }
    }
}

/// A kind of part of a law.
#[derive(Clone, Copy)]
enum Part {
    Isochoric,
    Volumetric,
}

impl Part {
    const fn name(self) -> &'static str {
        match self {
            Self::Isochoric => "isochoric",
            Self::Volumetric => "volumetric",
        }
    }

    const fn table(self) -> &'static [(&'static str, &'static [Slot])] {
        match self {
            Self::Isochoric => ISOCHORIC,
            Self::Volumetric => VOLUMETRIC,
        }
    }
}

const SHEAR: &[Slot] = &[Number("shear_modulus")];
const BULK: &[Slot] = &[Number("bulk_modulus")];

/// The laws with their own parameters and their parts.
const SOLIDS: &[(&str, &[Slot], &[Part])] = &[
    ("compressible", &[], &[Part::Isochoric, Part::Volumetric]),
    ("incompressible", &[], &[Part::Isochoric]),
    ("neo_hookean", SHEAR, &[Part::Volumetric]),
    ("hencky", SHEAR, &[Part::Volumetric]),
    ("ogden", &[Terms("terms")], &[Part::Volumetric]),
    ("isochoric_ogden", &[Terms("terms")], &[Part::Volumetric]),
    ("incompressible_ogden", &[Terms("terms")], &[]),
    ("mooney_rivlin", &[Number("c10"), Number("c01"), Number("square_coefficient")], &[]),
    ("blatz_ko", &[Number("shear_modulus"), Number("poisson_ratio"), Number("solid_fraction")], &[]),
    ("saint_venant_kirchhoff", &[Number("first_lame_parameter"), Number("shear_modulus")], &[]),
    ("linear_elastic", &[Number("shear_modulus"), Number("first_lame_parameter")], &[]),
    (
        "holzapfel_gasser_ogden",
        &[
            Number("shear_modulus"),
            Number("bulk_modulus"),
            Number("fibre_modulus"),
            Number("fibre_exponent"),
            Number("dispersion"),
            Vectors("fibres", 2),
        ],
        &[],
    ),
    (
        "reinforced_neo_hookean",
        &[Number("shear_modulus"), Number("first_lame_parameter"), Number("fibre_modulus"), Vectors("fibre", 1)],
        &[],
    ),
];

const ISOCHORIC: &[(&str, &[Slot])] = &[
    ("neo_hookean", SHEAR),
    ("mooney_rivlin", &[Number("c10"), Number("c01")]),
    ("yeoh", &[Number("c1"), Number("c2"), Number("c3")]),
    ("gent", &[Number("shear_modulus"), Number("limit")]),
    ("arruda_boyce", &[Number("rubbery_modulus"), Number("links")]),
    ("arruda_boyce_series", &[Number("rubbery_modulus"), Number("links")]),
];

const VOLUMETRIC: &[(&str, &[Slot])] = &[
    ("quadratic", BULK),
    ("logarithmic", BULK),
    ("quadratic_logarithmic", BULK),
    ("simo_taylor", BULK),
    ("liu", BULK),
    ("miehe", BULK),
    ("lame", &[Number("first_lame_parameter")]),
    ("ogden", &[Number("bulk_modulus"), Number("exponent")]),
    ("hartmann_neff", BULK),
];

/// A law whose name is resolved: the name, slots and place (nothing for the law itself) of each piece.
pub(crate) struct Resolved {
    law: String,
    pieces: Vec<(&'static str, &'static [Slot], Option<Part>)>,
}

/// The words of a name, in small letters.
pub(crate) fn words(name: &str) -> Vec<String> {
    let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
    name.split(|c| !is_letter(c)).filter(|word| !word.is_empty()).map(str::to_ascii_lowercase).collect()
}

/// Whether a name begins with that of a law in the table of this module.
pub(crate) fn is_law(name: &str) -> bool {
    words(name).first().is_some_and(|word| SOLIDS.iter().any(|(law, _, _)| law == word))
}

pub(crate) fn list<'n>(names: impl Iterator<Item = &'n str>) -> String {
    names.collect::<Vec<_>>().join(", ")
}

impl Resolved {
    pub(crate) fn of(name: &str) -> Result<Self, FfiError> {
        let mut words = words(name).into_iter();
        let resolved = Self::of_words(&mut words)?;
        match words.next() {
            None => Ok(resolved),
            Some(given) => {
                let valid = format!("no further parts of `{}`", resolved.law);
                Err(FfiError::UnknownChoice { choice: "part of this law", given, valid })
            }
        }
    }

    /// The law of the words up to its last part.
    pub(crate) fn of_words(words: &mut impl Iterator<Item = String>) -> Result<Self, FfiError> {
        let first = words.next().unwrap_or_default();
        let Some((law, slots, parts)) = SOLIDS.iter().find(|(law, _, _)| *law == first) else {
            let valid = list(SOLIDS.iter().map(|(law, _, _)| *law));
            return Err(FfiError::UnknownChoice { choice: "law with parameters in order", given: first, valid });
        };
        let mut pieces = vec![(*law, *slots, None)];
        for part in *parts {
            let word = words.next().unwrap_or_default();
            let Some((name, slots)) = part.table().iter().find(|(name, _)| *name == word) else {
                let choice = match part {
                    Part::Isochoric => "isochoric part",
                    Part::Volumetric => "volumetric part",
                };
                let valid = list(part.table().iter().map(|(name, _)| *name));
                return Err(FfiError::UnknownChoice { choice, given: word, valid });
            };
            pieces.push((*name, *slots, Some(*part)));
        }
        Ok(Self { law: list(pieces.iter().map(|(name, _, _)| *name)).replace(", ", "-"), pieces })
    }

    fn slots(&self) -> impl Iterator<Item = (Slot, Option<Part>)> {
        self.pieces.iter().flat_map(|(_, slots, part)| slots.iter().map(move |slot| (*slot, *part)))
    }

    /// The parameters in words.
    fn parameters(&self) -> String {
        list(self.slots().map(|(slot, part)| match (slot, part) {
            (Terms(_), _) => "terms (modulus, exponent of each)",
            (slot, _) => slot.name(),
        }))
    }

    /// The name of the law with those of its parts.
    #[cfg(feature = "history")]
    pub(crate) fn law(&self) -> &str {
        &self.law
    }

    /// The parameters, if each is one number.
    #[cfg(feature = "history")]
    pub(crate) fn numbers(&self) -> Option<Vec<String>> {
        self.slots()
            .map(|(slot, part)| match (slot, part) {
                (Number(name), Some(part)) if self.slots().filter(|(other, _)| other.name() == name).count() > 1 => {
                    Some(format!("{}.{name}", part.name()))
                }
                (Number(name), _) => Some(name.to_owned()),
                _ => None,
            })
            .collect()
    }

    /// The law of numbers in their order.
    fn with_values(&self, values: &[f64]) -> Result<AnySolid, FfiError> {
        solid_from_value(self.written(values)?)
    }

    /// The same in its written form.
    pub(crate) fn written(&self, values: &[f64]) -> Result<Value, FfiError> {
        let wrong = || FfiError::WrongCount { law: self.law.clone(), expected: self.parameters(), found: values.len() };
        let least: usize = self.slots().map(|(slot, _)| slot.least()).sum();
        let spare = values.len().checked_sub(least).ok_or_else(wrong)?;
        let has_terms = self.slots().any(|(slot, _)| matches!(slot, Terms(_)));
        if spare != 0 && !(has_terms && spare.is_multiple_of(2)) {
            return Err(wrong());
        }
        let mut rest = values;
        let mut take = |count: usize| {
            let (head, tail) = rest.split_at(count.min(rest.len()));
            rest = tail;
            head
        };
        let mut given = Vec::new();
        for (slot, _) in self.slots() {
            given.push(match slot {
                Number(_) => Value::from(take(1).first().copied()),
                Vectors(_, 1) => Value::from(take(3)),
                Vectors(_, count) => take(3 * count).chunks(3).map(Value::from).collect(),
                Terms(_) => take(2 + spare).chunks(2).map(term).collect(),
            });
        }
        Ok(self.build(given))
    }

    /// The law of numbers by name; a name that two parts have is written behind the part, `volumetric.exponent`.
    fn with_names(&self, names: &[&str], values: &[f64]) -> Result<AnySolid, FfiError> {
        let wrong = |parameter: &str, what| FfiError::WrongParameter {
            law: self.law.clone(),
            parameter: parameter.to_owned(),
            what,
            valid: self.parameters(),
        };
        let is_of = |(slot, part): (Slot, Option<Part>), name: &str| match name.split_once('.') {
            Some((place, name)) => part.is_some_and(|part| part.name() == place) && slot.name() == name,
            None => slot.name() == name,
        };
        if let Some((slot, _)) = self.slots().find(|(slot, _)| !matches!(slot, Number(_))) {
            return Err(wrong(slot.name(), "is not one number: give all in their order"));
        }
        let slots: Vec<_> = self.slots().collect();
        let own: Vec<&str> = slots.iter().map(|(slot, _)| slot.name()).collect();
        let values = in_order(&own, |k, name| is_of(slots[k], name), names, values, wrong)?;
        solid_from_value(self.build(values.into_iter().map(Value::from).collect()))
    }

    /// The law in its written form.
    fn build(&self, given: Vec<Value>) -> Value {
        let mut given = given.into_iter();
        let mut law = Map::new();
        for (name, slots, part) in &self.pieces {
            let mut piece = Map::new();
            piece.insert("law".into(), Value::from(*name));
            for (slot, value) in slots.iter().zip(given.by_ref()) {
                piece.insert(slot.name().into(), value);
            }
            match part {
                None => law = piece,
                Some(part) => drop(law.insert(part.name().into(), Value::Object(piece))),
            }
        }
        Value::Object(law)
    }
}

#[cfg(feature = "history")]
pub use crate::history::named::{history, history_with_names, state_length};

/// The values of parameters in their order, each found by its name: one that is missing, given twice or unknown is `wrong`.
pub(crate) fn in_order(
    own: &[&str],
    is_of: impl Fn(usize, &str) -> bool,
    names: &[&str],
    values: &[f64],
    wrong: impl Fn(&str, &'static str) -> FfiError,
) -> Result<Vec<f64>, FfiError> {
    let mut ordered = Vec::with_capacity(own.len());
    for (number, own) in own.iter().enumerate() {
        let mut found = names.iter().zip(values).filter(|(name, _)| is_of(number, name));
        let (_, value) = found.next().ok_or_else(|| wrong(own, "is missing"))?;
        if found.next().is_some() {
            return Err(wrong(own, "is given twice"));
        }
        ordered.push(*value);
    }
    match names.iter().find(|name| !(0..own.len()).any(|number| is_of(number, name))) {
        Some(unknown) => Err(wrong(unknown, "is unknown")),
        None => Ok(ordered),
    }
}

/// A term of an Ogden law.
fn term(pair: &[f64]) -> Value {
    let mut term = Map::new();
    for (name, value) in ["modulus", "exponent"].into_iter().zip(pair) {
        term.insert(name.into(), Value::from(*value));
    }
    Value::Object(term)
}

/// The law of a name and its parameters in their order, as the tables of this [module](self) list them.
///
/// # Errors
/// [`FfiError::NotFinite`], [`FfiError::UnknownChoice`], [`FfiError::WrongCount`]; [`FfiError::Unreadable`] with what the
/// constructor of the law refuses, such as a shear modulus that is not positive.
///
/// # Example
/// ```
/// use piola::solids::{AnySolid, Compressible, isochoric::Gent, volumetric::SimoTaylor};
/// let rubber = piola_ffi::named::solid("compressible-gent-simo_taylor", &[1.0, 50.0, 100.0])?;
/// assert_eq!(rubber, AnySolid::from(Compressible::new(Gent::new(1.0, 50.0)?, SimoTaylor::new(100.0)?)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn solid(name: &str, values: &[f64]) -> Result<AnySolid, FfiError> {
    check_finite("parameters", values)?;
    Resolved::of(name)?.with_values(values)
}

/// The law of a name and parameters by name, in any order.
///
/// # Errors
/// As [`solid`]; [`FfiError::WrongParameter`] for a parameter that is unknown, missing or given twice;
/// [`FfiError::WrongLength`] unless there is a value for each name.
pub fn solid_with_names(name: &str, names: &[&str], values: &[f64]) -> Result<AnySolid, FfiError> {
    crate::error::check_length("values", names.len(), values.len())?;
    check_finite("parameters", values)?;
    Resolved::of(name)?.with_names(names, values)
}
