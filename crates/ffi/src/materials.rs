//! Materials by the name that a finite-element program knows them by, kept by each thread.

use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;

use piola::solids::AnySolid;

use crate::{FfiError, named, text};

/// The environment variable with the folder of materials in files.
pub const FOLDER: &str = "PIOLA_MATERIALS";

/// Materials that a thread keeps: programs have few, but may vary their properties from point to point.
const KEPT: usize = 64;

/// A material as it was asked for, and its law.
struct Material {
    name: String,
    properties: Vec<f64>,
    law: Rc<AnySolid>,
}

impl Material {
    fn is(&self, name: &str, properties: &[f64]) -> bool {
        self.name == name
            && self.properties.len() == properties.len()
            && self.properties.iter().zip(properties).all(|(a, b)| a.to_bits() == b.to_bits())
    }
}

thread_local! {
    /// The materials of this thread, and which is forgotten next.
    static MATERIALS: RefCell<(Vec<Material>, usize)> = const { RefCell::new((Vec::new(), 0)) };
}

/// The law of a material. It is made once for each thread; later calls only find it.
///
/// | name | law |
/// |---|---|
/// | that of a law ([`named`]), such as `COMPRESSIBLE-GENT-SIMO_TAYLOR` | with the properties as its parameters |
/// | any other, such as `TREAD`, without properties | that of the file `tread.json` in the folder [`FOLDER`] |
///
/// A file holds a law in its written form, or the summary of a fit, whose best law is then taken as it is: incompressible, or it
/// names a fit, one of its models and an energy of the change of volume. The path of the fit is relative to the folder.
///
/// ```text
/// {"law": "hencky", "shear_modulus": 1.0, "volumetric": {"law": "lame", "first_lame_parameter": 2.0}}
/// {"fit": "summary.json", "model": "ogden:3", "volumetric": {"law": "simo_taylor", "bulk_modulus": 2000.0}}
/// ```
///
/// # Errors
/// As [`named::solid`]; [`FfiError::NoMaterial`]; an unreadable or invalid file.
pub fn material(name: &str, properties: &[f64]) -> Result<Rc<AnySolid>, FfiError> {
    MATERIALS.with_borrow_mut(|(materials, next)| {
        if let Some(found) = materials.iter().find(|material| material.is(name, properties)) {
            return Ok(Rc::clone(&found.law));
        }
        let law = Rc::new(if named::is_law(name) { named::solid(name, properties)? } else { from_file(name)? });
        let made = Material { name: name.to_owned(), properties: properties.to_vec(), law: Rc::clone(&law) };
        if materials.len() < KEPT {
            materials.push(made);
        } else {
            materials[*next] = made;
            *next = (*next + 1) % KEPT;
        }
        Ok(law)
    })
}

/// The law of a material's file.
fn from_file(name: &str) -> Result<AnySolid, FfiError> {
    let folder = std::env::var_os(FOLDER).map(PathBuf::from).unwrap_or_default();
    let read = |file: &str| {
        let path = folder.join(file);
        std::fs::read_to_string(&path).map_err(|error| FfiError::NoMaterial {
            name: name.to_owned(),
            path: path.display().to_string(),
            message: error.to_string(),
        })
    };
    let text = read(&format!("{}.json", name.to_ascii_lowercase()))?;
    let value: serde_json::Value = serde_json::from_str(&text)
        .map_err(|error| FfiError::Unreadable { what: "file of a material", message: error.to_string() })?;
    if let Some(fit) = value["fit"].as_str() {
        let volumetric = match value.get("volumetric") {
            Some(written) => Some(text::volumetric_from_value(written.clone())?),
            None => None,
        };
        return text::solid_from_fit(&read(fit)?, value["model"].as_str(), volumetric);
    }
    if value.get("laws").is_some() { text::solid_from_fit(&text, None, None) } else { text::solid_from_value(value) }
}
