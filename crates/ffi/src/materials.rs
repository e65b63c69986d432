//! Materials by the name that a finite-element program knows them by, kept by each thread.

use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;

#[cfg(feature = "history")]
use piola::inelastic::AnyInelastic;
use piola::solids::AnySolid;
use serde_json::Value;

#[cfg(feature = "history")]
use crate::history::{named::is_history, text as history_text};
use crate::text::{Entry, solid_from_value, solid_of, volumetric_from_value};
use crate::{FfiError, named};

/// The environment variable with the folder of materials in files.
pub const FOLDER: &str = "PIOLA_MATERIALS";

/// Materials that a thread keeps: programs have few, but may vary their properties from point to point.
const KEPT: usize = 64;

/// The law of a material.
///
/// # Example
/// ```
/// use piola::solids::{AnySolid, SaintVenantKirchhoff};
/// use piola_ffi::materials::{MaterialLaw, material};
/// let law = MaterialLaw::from(AnySolid::from(SaintVenantKirchhoff::new(1.0, 2.0)?));
/// assert_eq!(*material("SAINT_VENANT_KIRCHHOFF", &[1.0, 2.0])?, law);
/// assert_eq!(law.state_length(), None);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "one a material")]
#[non_exhaustive]
pub enum MaterialLaw {
    /// Elastic.
    Elastic(AnySolid),
    /// With history.
    #[cfg(feature = "history")]
    History(AnyInelastic),
}

impl From<AnySolid> for MaterialLaw {
    fn from(law: AnySolid) -> Self {
        Self::Elastic(law)
    }
}

#[cfg(feature = "history")]
impl From<AnyInelastic> for MaterialLaw {
    fn from(law: AnyInelastic) -> Self {
        Self::History(law)
    }
}

impl MaterialLaw {
    /// The number of internal variables; none of an elastic law, which leaves a state of any length alone.
    #[must_use]
    pub const fn state_length(&self) -> Option<usize> {
        match self {
            Self::Elastic(_) => None,
            #[cfg(feature = "history")]
            Self::History(law) => Some(law.state_length()),
        }
    }
}

/// A material as it was asked for, and its law.
struct Named {
    name: String,
    properties: Vec<f64>,
    law: Rc<MaterialLaw>,
}

impl Named {
    fn is(&self, name: &str, properties: &[f64]) -> bool {
        self.name == name
            && self.properties.len() == properties.len()
            && self.properties.iter().zip(properties).all(|(a, b)| a.to_bits() == b.to_bits())
    }
}

/// The materials of a thread.
struct Kept {
    materials: Vec<Named>,
    /// Which is forgotten next.
    next: usize,
}

thread_local! {
    static MATERIALS: RefCell<Kept> = const { RefCell::new(Kept { materials: Vec::new(), next: 0 }) };
}

impl Kept {
    /// The law of a material, made where it is not here yet.
    fn get(&mut self, name: &str, properties: &[f64]) -> Result<Rc<MaterialLaw>, FfiError> {
        if let Some(found) = self.materials.iter().find(|material| material.is(name, properties)) {
            return Ok(Rc::clone(&found.law));
        }
        let law = Rc::new(made(name, properties)?);
        let made = Named { name: name.to_owned(), properties: properties.to_vec(), law: Rc::clone(&law) };
        if self.materials.len() < KEPT {
            self.materials.push(made);
        } else {
            self.materials[self.next] = made;
            self.next = (self.next + 1) % KEPT;
        }
        Ok(law)
    }
}

/// The law of a material. It is made once for each thread; later calls only find it.
///
/// | name | law |
/// |---|---|
/// | that of an elastic law ([`named`]), such as `COMPRESSIBLE-GENT-SIMO_TAYLOR` | with the properties as its parameters |
/// | that of a law with history ([`named::history`](named), feature `history`) | the same |
/// | any other, such as `TREAD`, without properties | that of the file `tread.json` in the folder [`FOLDER`] |
///
/// A file holds a law in its written form, or the summary of a fit, whose best law is then taken as it is: an elastic one incompressible. Or it
/// names a fit, one of its models and, of an elastic law, an energy of the change of volume. The path of the fit is relative to the folder.
/// Parameters of a fit are converted to Pa.
///
/// ```text
/// {"law": "hencky", "shear_modulus": 1.0, "volumetric": {"law": "lame", "first_lame_parameter": 2.0}}
/// {"fit": "summary.json", "model": "ogden:3", "volumetric": {"law": "simo_taylor", "bulk_modulus": 2000.0}}
/// {"fit": "summary.json", "model": "reese-govindjee"}
/// ```
///
/// # Errors
/// As [`named::solid`] and `named::history`; [`FfiError::NoMaterial`]; an unreadable or invalid file.
pub fn material(name: &str, properties: &[f64]) -> Result<Rc<MaterialLaw>, FfiError> {
    MATERIALS.with_borrow_mut(|kept| kept.get(name, properties))
}

fn made(name: &str, properties: &[f64]) -> Result<MaterialLaw, FfiError> {
    #[cfg(feature = "history")]
    if is_history(name) {
        return named::history(name, properties).map(MaterialLaw::History);
    }
    if named::is_law(name) { named::solid(name, properties).map(MaterialLaw::Elastic) } else { from_file(name) }
}

/// The number of internal variables of a material, NSTATV of Abaqus, whatever its properties are: 0 of an elastic law.
///
/// # Errors
/// As [`material`].
#[cfg(feature = "history")]
pub fn material_state_length(name: &str) -> Result<usize, FfiError> {
    if is_history(name) {
        named::state_length(name)
    } else if named::is_law(name) {
        named::Resolved::of(name).map(|_| 0)
    } else {
        Ok(material(name, &[])?.state_length().unwrap_or(0))
    }
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

fn wrong(message: String) -> FfiError {
    FfiError::Unreadable { what: "file of a material", message }
}

/// A fit that the file of a material names, the model, and the energy of the change of volume; refuses what else stands beside them.
struct Fit<'a> {
    summary: &'a str,
    model: Option<&'a str>,
    volumetric: Option<&'a Value>,
}

impl<'a> Fit<'a> {
    fn of(value: &'a Value) -> Result<Option<Self>, FfiError> {
        const KEYS: [&str; 3] = ["fit", "model", "volumetric"];
        let Some(object) = value.as_object().filter(|object| object.contains_key("fit")) else { return Ok(None) };
        if let Some(key) = object.keys().find(|key| !KEYS.contains(&key.as_str())) {
            return Err(wrong(format!("unknown key `{key}`; with `fit` there can be {}", KEYS.join(", "))));
        }
        let text = |key: &str| match object.get(key) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text.as_str())),
            Some(other) => Err(wrong(format!("`{key}` is {other}, which is no text"))),
        };
        let model = text("model")?;
        Ok(text("fit")?.map(|summary| Self { summary, model, volumetric: object.get("volumetric") }))
    }
}

/// The law of a material's file.
fn from_file(name: &str) -> Result<MaterialLaw, FfiError> {
    let text = read(name, &format!("{}.json", name.to_ascii_lowercase()))?;
    let value: Value = serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
    if let Some(Fit { summary, model, volumetric }) = Fit::of(&value)? {
        return of_fit(Entry::of(&read(name, summary)?, model)?, volumetric);
    }
    if value.get("laws").is_some() {
        return of_fit(Entry::of(&text, None)?, None);
    }
    #[cfg(feature = "history")]
    if value["law"].as_str().is_some_and(is_history) {
        return history_text::history_from_value(value).map(MaterialLaw::History);
    }
    solid_from_value(value).map(MaterialLaw::Elastic)
}

/// The law of an entry of a fit.
fn of_fit(entry: Entry, volumetric: Option<&Value>) -> Result<MaterialLaw, FfiError> {
    #[cfg(feature = "history")]
    if history_text::FITTED.contains(&entry.model.as_str()) {
        return match volumetric {
            None => history_text::history_of(&entry).map(MaterialLaw::History),
            Some(_) => {
                Err(wrong(format!("`volumetric` is of elastic laws; `{}` has its own change of volume", entry.model)))
            }
        };
    }
    solid_of(entry, volumetric.cloned().map(volumetric_from_value).transpose()?).map(MaterialLaw::Elastic)
}
