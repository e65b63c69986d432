//! Materials by the name that a finite-element program knows them by, kept by each thread.

use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;

#[cfg(feature = "history")]
use piola::inelastic::AnyInelastic;
use piola::solids::AnySolid;
use serde_json::Value;

#[cfg(feature = "history")]
use crate::history::named::is_history;
#[cfg(feature = "history")]
use crate::history::text::{history_from_fit, history_from_value};
use crate::{FfiError, named, text};

/// The environment variable with the folder of materials in files.
pub const FOLDER: &str = "PIOLA_MATERIALS";

/// Materials that a thread keeps: programs have few, but may vary their properties from point to point.
const KEPT: usize = 64;

/// A material as it was asked for, and its law.
struct Material<L> {
    name: String,
    properties: Vec<f64>,
    law: Rc<L>,
}

impl<L> Material<L> {
    fn is(&self, name: &str, properties: &[f64]) -> bool {
        self.name == name
            && self.properties.len() == properties.len()
            && self.properties.iter().zip(properties).all(|(a, b)| a.to_bits() == b.to_bits())
    }
}

/// The materials of a thread.
struct Kept<L> {
    materials: Vec<Material<L>>,
    /// Which is forgotten next.
    next: usize,
}

impl<L> Kept<L> {
    const fn new() -> RefCell<Self> {
        RefCell::new(Self { materials: Vec::new(), next: 0 })
    }

    /// The law of a material, made where it is not here yet.
    fn get(
        &mut self,
        name: &str,
        properties: &[f64],
        make: impl FnOnce() -> Result<L, FfiError>,
    ) -> Result<Rc<L>, FfiError> {
        if let Some(found) = self.materials.iter().find(|material| material.is(name, properties)) {
            return Ok(Rc::clone(&found.law));
        }
        let law = Rc::new(make()?);
        let made = Material { name: name.to_owned(), properties: properties.to_vec(), law: Rc::clone(&law) };
        if self.materials.len() < KEPT {
            self.materials.push(made);
        } else {
            self.materials[self.next] = made;
            self.next = (self.next + 1) % KEPT;
        }
        Ok(law)
    }
}

thread_local! {
    static MATERIALS: RefCell<Kept<AnySolid>> = const { Kept::new() };
}

/// The law of a material. It is made once for each thread; later calls only find it.
///
/// | name | law |
/// |---|---|
/// | that of a law ([`named`]), such as `COMPRESSIBLE-GENT-SIMO_TAYLOR` | with the properties as its parameters |
/// | any other, such as `TREAD`, without properties | that of the file `tread.json` in the folder [`FOLDER`] |
///
/// A file holds a law in its written form, or the summary of a fit, whose best law is then taken as it is: incompressible, or it
/// names a fit, one of its models and an energy of the change of volume. The path of the fit is relative to the folder. Parameters of a fit
/// are converted to Pa.
///
/// ```text
/// {"law": "hencky", "shear_modulus": 1.0, "volumetric": {"law": "lame", "first_lame_parameter": 2.0}}
/// {"fit": "summary.json", "model": "ogden:3", "volumetric": {"law": "simo_taylor", "bulk_modulus": 2000.0}}
/// ```
///
/// # Errors
/// As [`named::solid`]; [`FfiError::NoMaterial`]; an unreadable or invalid file.
pub fn material(name: &str, properties: &[f64]) -> Result<Rc<AnySolid>, FfiError> {
    let make = || if named::is_law(name) { named::solid(name, properties) } else { from_file(name) };
    MATERIALS.with_borrow_mut(|kept| kept.get(name, properties, make))
}

#[cfg(feature = "history")]
thread_local! {
    static HISTORIES: RefCell<Kept<AnyInelastic>> = const { Kept::new() };
}

/// The law with history of a material, as [`material`]: its name is that of a law ([`named::history`]) with the properties as its
/// parameters, or that of a file with a law in its written form, the summary of a fit, or the name of one.
///
/// ```text
/// {"fit": "summary.json", "model": "reese-govindjee"}
/// ```
///
/// # Errors
/// As [`named::history`]; [`FfiError::NoMaterial`]; an unreadable or invalid file.
#[cfg(feature = "history")]
pub fn material_with_history(name: &str, properties: &[f64]) -> Result<Rc<AnyInelastic>, FfiError> {
    let make = || {
        if is_history(name) {
            return named::history(name, properties);
        }
        let File { text, value } = File::of(name)?;
        match fit_of(&value, &["fit", "model"])? {
            Some((fit, model)) => history_from_fit(&read(name, fit)?, model),
            None if value.get("laws").is_some() => history_from_fit(&text, None),
            None => history_from_value(value),
        }
    };
    HISTORIES.with_borrow_mut(|kept| kept.get(name, properties, make))
}

/// The number of internal variables of the law with history of a material, whatever its properties are: NSTATV of Abaqus.
///
/// # Errors
/// As [`material_with_history`].
#[cfg(feature = "history")]
pub fn material_state_length(name: &str) -> Result<usize, FfiError> {
    if is_history(name) { named::state_length(name) } else { Ok(material_with_history(name, &[])?.state_length()) }
}

/// The text of a file in the folder of materials.
fn read(name: &str, file: &str) -> Result<String, FfiError> {
    let path = std::env::var_os(FOLDER).map(PathBuf::from).unwrap_or_default().join(file);
    std::fs::read_to_string(&path).map_err(|error| FfiError::NoMaterial {
        name: name.to_owned(),
        path: path.display().to_string(),
        message: error.to_string(),
    })
}

/// The file of a material.
struct File {
    text: String,
    value: Value,
}

impl File {
    fn of(name: &str) -> Result<Self, FfiError> {
        let text = read(name, &format!("{}.json", name.to_ascii_lowercase()))?;
        let value = serde_json::from_str(&text)
            .map_err(|error| FfiError::Unreadable { what: "file of a material", message: error.to_string() })?;
        Ok(Self { text, value })
    }
}

/// The fit that the file of a material names, and the model; refuses what else stands beside them.
fn fit_of<'a>(value: &'a Value, keys: &[&str]) -> Result<Option<(&'a str, Option<&'a str>)>, FfiError> {
    let wrong = |message: String| FfiError::Unreadable { what: "file of a material", message };
    let Some(object) = value.as_object().filter(|object| object.contains_key("fit")) else { return Ok(None) };
    if let Some(key) = object.keys().find(|key| !keys.contains(&key.as_str())) {
        return Err(wrong(format!("unknown key `{key}`; with `fit` there can be {}", keys.join(", "))));
    }
    let text = |key: &str| match object.get(key) {
        None => Ok(None),
        Some(Value::String(text)) => Ok(Some(text.as_str())),
        Some(other) => Err(wrong(format!("`{key}` is {other}, which is no text"))),
    };
    let model = text("model")?;
    Ok(text("fit")?.map(|fit| (fit, model)))
}

/// The law of a material's file.
fn from_file(name: &str) -> Result<AnySolid, FfiError> {
    let File { text, value } = File::of(name)?;
    if let Some((fit, model)) = fit_of(&value, &["fit", "model", "volumetric"])? {
        let volumetric = match value.get("volumetric") {
            Some(written) => Some(text::volumetric_from_value(written.clone())?),
            None => None,
        };
        return text::solid_from_fit(&read(name, fit)?, model, volumetric);
    }
    if value.get("laws").is_some() { text::solid_from_fit(&text, None, None) } else { text::solid_from_value(value) }
}
