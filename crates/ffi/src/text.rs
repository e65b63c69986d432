//! Laws as texts: the written form of `AnySolid` and `AnyFluid` in JSON, and the summary of a fit.

use piola::fit::solids::AnyModel;
use piola::fluids::AnyFluid;
use piola::solids::{AnySolid, AnyVolumetric};
use piola_document::units::{Dimension, UNITS, Unit, spelled};
use serde_json::{Map, Value};

use crate::FfiError;
use crate::error::{check_finite, check_length};

pub(crate) fn unreadable(what: &'static str, error: &serde_json::Error) -> FfiError {
    FfiError::Unreadable { what, message: error.to_string() }
}

/// A law of a solid in its written form.
pub(crate) fn solid_from_value(value: Value) -> Result<AnySolid, FfiError> {
    serde_json::from_value(value).map_err(|error| unreadable("law of a solid", &error))
}

/// An energy of the change of volume in its written form.
pub(crate) fn volumetric_from_value(value: Value) -> Result<AnyVolumetric, FfiError> {
    serde_json::from_value(value).map_err(|error| unreadable("energy of the change of volume", &error))
}

/// An energy of the change of volume from JSON, such as `{"law": "quadratic", "bulk_modulus": 1e3}`: see
/// [`AnyVolumetric`].
///
/// # Errors
/// As [`solid_from_json`].
pub fn volumetric_from_json(text: &str) -> Result<AnyVolumetric, FfiError> {
    serde_json::from_str(text).map_err(|error| unreadable("energy of the change of volume", &error))
}

/// A law of a solid from JSON, an object with the key `law` and the parameters by name: see
/// [`AnySolid`].
///
/// # Errors
/// [`FfiError::Unreadable`] with line and column of the mistake, or with what the constructor refuses.
///
/// # Example
/// ```
/// use piola_ffi::text::solid_from_json;
/// let text = r#"{"law": "saint_venant_kirchhoff", "first_lame_parameter": 1.0, "shear_modulus": 2.0}"#;
/// assert!(solid_from_json(text).is_ok());
/// let wrong = solid_from_json(&text.replace("2.0", "-2.0")).unwrap_err();
/// assert!(wrong.to_string().contains("violates 0 < 3 λ + 2 μ"));
/// ```
pub fn solid_from_json(text: &str) -> Result<AnySolid, FfiError> {
    serde_json::from_str(text).map_err(|error| unreadable("law of a solid", &error))
}

/// A fluid from JSON, an object with the key `fluid` and the parameters by name: see
/// [`AnyFluid`].
///
/// # Errors
/// As [`solid_from_json`].
pub fn fluid_from_json(text: &str) -> Result<AnyFluid, FfiError> {
    serde_json::from_str(text).map_err(|error| unreadable("fluid", &error))
}

/// A fluid of a name and parameters by name.
///
/// # Errors
/// [`FfiError::NotFinite`], [`FfiError::WrongLength`] unless there is a value for each name; [`FfiError::Unreadable`].
///
/// # Example
/// ```
/// use piola::fluids::ViscometricFluid;
/// let mud = piola_ffi::text::fluid_with_names("bingham", &["yield_stress", "plastic_viscosity"], &[3.0, 0.5])?;
/// assert_eq!(mud.shear_stress(4.0), 5.0);
/// # Ok::<(), piola_ffi::FfiError>(())
/// ```
pub fn fluid_with_names(name: &str, names: &[&str], values: &[f64]) -> Result<AnyFluid, FfiError> {
    check_length("values", names.len(), values.len())?;
    check_finite("parameters", values)?;
    let mut fluid = Map::new();
    fluid.insert("fluid".into(), Value::from(name.to_ascii_lowercase()));
    for (name, value) in names.iter().zip(values) {
        fluid.insert((*name).to_owned(), Value::from(*value));
    }
    serde_json::from_value(Value::Object(fluid)).map_err(|error| unreadable("fluid", &error))
}

/// The law of a fit: of the `summary.json` that `piola fit` writes, or of one of the entries of its `laws`.
///
/// ```text
/// {"best_by_aicc": "ogden:3", "stress_unit": "MPa",
///  "laws": [{"model": "ogden:3", "parameters": [{"name": …, "is_stress": true, "value": …}, …]}, …]}
/// ```
/// Parameters in the unit of the stresses, `stress_unit`, are converted to Pa. A summary without that unit is taken as it is, in Pa. Numbers of
/// `volumetric` are in Pa.
///
/// | argument | meaning |
/// |---|---|
/// | `model` | which of the laws, such as `yeoh`; the best by `aicc` where it is `None` |
/// | `volumetric` | the energy of the change of volume; `None` makes the law incompressible |
///
/// # Errors
/// [`FfiError::Unreadable`] where the text is no such summary, or the fit of the model failed; [`FfiError::UnknownChoice`] where it has no
/// such model, or an unknown unit; what the law's constructor refuses.
///
/// # Example
/// ```
/// use piola::solids::{AnySolid, Compressible, isochoric::NeoHookean, volumetric::Quadratic};
/// let fit = r#"{"model": "neo-hookean", "parameters": [{"name": "mu", "value": 0.5}]}"#;
/// let law = piola_ffi::text::solid_from_fit(fit, None, Some(Quadratic::new(10.0)?.into()))?;
/// assert_eq!(law, AnySolid::from(Compressible::new(NeoHookean::new(0.5)?, Quadratic::new(10.0)?)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn solid_from_fit(
    text: &str,
    model: Option<&str>,
    volumetric: Option<AnyVolumetric>,
) -> Result<AnySolid, FfiError> {
    solid_of(Entry::of(text, model)?, volumetric)
}

/// The law of an entry of a fit.
pub(crate) fn solid_of(entry: Entry, volumetric: Option<AnyVolumetric>) -> Result<AnySolid, FfiError> {
    let model: AnyModel = entry.model.parse()?;
    let values: Vec<f64> = entry.parameters.iter().map(|(_, value)| *value).collect();
    let law = match volumetric {
        Some(volumetric) => model.compressible(&values, volumetric)?,
        None => model.law(&values)?,
    };
    let given = || FfiError::UnknownChoice {
        choice: "law of this fit",
        given: entry.model,
        valid: "neo-hookean, mooney-rivlin, yeoh, gent, arruda-boyce, polynomial:n, ogden:n".to_owned(),
    };
    law.solid().cloned().ok_or_else(given)
}

/// The unit of the stresses of a summary, in Pa.
fn stress_unit(summary: &Value) -> Result<f64, FfiError> {
    let given = match &summary["stress_unit"] {
        Value::Null => return Ok(1.0),
        Value::String(given) => given.clone(),
        other => other.to_string(),
    };
    let is_stress = |unit: &Unit| unit.dimension == Dimension::PRESSURE;
    let found = spelled(&given).ok().filter(is_stress);
    found.map(|unit| unit.to_si(1.0)).ok_or_else(|| {
        let named = UNITS.iter().filter(|unit| is_stress(&unit.unit)).map(|unit| unit.name);
        let valid = named.collect::<Vec<_>>().join(", ");
        FfiError::UnknownChoice { choice: "unit of stress", given, valid }
    })
}

/// One law of the summary of a fit.
pub(crate) struct Entry {
    /// The name of its model.
    pub(crate) model: String,
    /// Its parameters in SI units, in the order of the model; a name is empty where the summary has none.
    pub(crate) parameters: Vec<(String, f64)>,
}

impl Entry {
    /// The law of this model, or the best one.
    pub(crate) fn of(text: &str, model: Option<&str>) -> Result<Self, FfiError> {
        const WHAT: &str = "summary of a fit";
        let missing = |message: &str| FfiError::Unreadable { what: WHAT, message: message.to_owned() };
        let summary: Value = serde_json::from_str(text).map_err(|error| unreadable(WHAT, &error))?;
        let only = std::slice::from_ref(&summary);
        let laws = summary["laws"].as_array().map_or(only, Vec::as_slice);
        let wanted = model.or_else(|| summary["best_by_aicc"].as_str());
        let entry = match wanted {
            Some(wanted) => laws.iter().find(|law| law["model"] == wanted),
            None => laws.first().filter(|_| laws.len() == 1),
        };
        let Some(entry) = entry else {
            let names: Vec<_> = laws.iter().filter_map(|law| law["model"].as_str()).collect();
            let given = wanted.unwrap_or("no model").to_owned();
            return Err(FfiError::UnknownChoice { choice: "model of this fit", given, valid: names.join(", ") });
        };
        let name = entry["model"].as_str().ok_or_else(|| missing("there is no `model`"))?;
        if let Some(failure) = entry["failure"].as_str() {
            return Err(missing(&format!("the fit of `{name}` failed: {failure}")));
        }
        let unit = stress_unit(&summary)?;
        let written = entry["parameters"].as_array().ok_or_else(|| missing("there are no `parameters`"))?;
        let mut parameters = Vec::with_capacity(written.len());
        for parameter in written {
            let name = parameter["name"].as_str().unwrap_or_default();
            let value = parameter["value"].as_f64().ok_or_else(|| missing("a parameter has no `value`"))?;
            let is_stress = match &parameter["is_stress"] {
                Value::Bool(is_stress) => *is_stress,
                _ if summary["stress_unit"].is_null() => true,
                _ => {
                    return Err(missing(
                        "there is a `stress_unit`, but a parameter does not say whether it `is_stress`",
                    ));
                }
            };
            // A viscosity has the unit of the stresses times a second.
            let scale = if is_stress || name == "viscosity" { unit } else { 1.0 };
            parameters.push((name.to_owned(), scale * value));
        }
        Ok(Self { model: name.to_owned(), parameters })
    }
}
