//! Laws with history as texts: their written form in JSON, and the summary of a fit.

use piola::inelastic::AnyInelastic;
use serde_json::{Value, json};

use crate::FfiError;
use crate::text::{Entry, unreadable};

const WHAT: &str = "law with history";

/// A law with history in its written form.
pub(crate) fn history_from_value(value: Value) -> Result<AnyInelastic, FfiError> {
    serde_json::from_value(value).map_err(|error| unreadable(WHAT, &error))
}

/// A law with history from JSON, an object with the key `law` and the parameters by name: see [`AnyInelastic`].
///
/// # Errors
/// [`FfiError::Unreadable`] with line and column of the mistake, or with what the constructor refuses.
///
/// # Example
/// ```
/// use piola_ffi::history::text::history_from_json;
/// let spring = r#"{"law": "neo_hookean", "shear_modulus": 1.0, "volumetric": {"law": "simo_taylor", "bulk_modulus": 2.0}}"#;
/// let text = format!(r#"{{"law": "in_series", "first": {spring}, "second": {spring}, "viscosity": 0.5}}"#);
/// assert_eq!(history_from_json(&text)?.state_length(), 9);
/// let wrong = history_from_json(&text.replace("0.5", "-0.5")).unwrap_err();
/// assert!(wrong.to_string().contains("violates 0 ≤ η"));
/// # Ok::<(), piola_ffi::FfiError>(())
/// ```
pub fn history_from_json(text: &str) -> Result<AnyInelastic, FfiError> {
    serde_json::from_str(text).map_err(|error| unreadable(WHAT, &error))
}

/// The law of a fit: of the `summary.json` that `piola fit` writes for laws with history, or of one of the entries of its `laws`.
///
/// | argument | meaning |
/// |---|---|
/// | `model` | `bergstrom-boyce`, `reese-govindjee`, `ogden-roxburgh` or `viscoplastic`; the best by `aicc` where it is `None` |
///
/// Parameters are converted from the `stress_unit` of the summary to Pa, as by [`solid_from_fit`](crate::text::solid_from_fit).
///
/// # Errors
/// [`FfiError::Unreadable`] where the text is no such summary, or the fit of the model failed; [`FfiError::UnknownChoice`] where it has no
/// such model, or an unknown unit; [`FfiError::WrongParameter`] where a parameter is missing; what the law's constructor refuses.
///
/// # Example
/// ```
/// let fit = r#"{"model": "ogden-roxburgh", "parameters": [{"name": "shear_modulus", "value": 1.0},
///     {"name": "first_lame_parameter", "value": 100.0}, {"name": "softening", "value": 2.0},
///     {"name": "energy", "value": 0.25}, {"name": "share", "value": 0.0}]}"#;
/// let law = piola_ffi::history::text::history_from_fit(fit, None)?;
/// assert_eq!((law.name(), law.state_length()), ("mullins", 1));
/// # Ok::<(), piola_ffi::FfiError>(())
/// ```
pub fn history_from_fit(text: &str, model: Option<&str>) -> Result<AnyInelastic, FfiError> {
    history_of(&Entry::of(text, model)?)
}

/// The models of a fit that are laws with history.
pub(crate) const FITTED: [&str; 4] = ["bergstrom-boyce", "reese-govindjee", "ogden-roxburgh", "viscoplastic"];

/// The law of an entry of a fit.
pub(crate) fn history_of(entry: &Entry) -> Result<AnyInelastic, FfiError> {
    let value = |name: &str| {
        let found = entry.parameters.iter().find(|(known, _)| known == name);
        found.map(|(_, value)| *value).ok_or_else(|| FfiError::WrongParameter {
            law: entry.model.clone(),
            parameter: name.to_owned(),
            what: "is missing",
            valid: entry.parameters.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", "),
        })
    };
    // The springs of the models of a fit: neo-Hookean with ¼ λ (J² − 1 − 2 ln J); of metal Hencky's.
    let neo_hookean = |prefix: &str| {
        let modulus = value(&format!("{prefix}shear_modulus"))?;
        let bulk = value(&format!("{prefix}first_lame_parameter"))?;
        let volumetric = json!({ "law": "simo_taylor", "bulk_modulus": bulk });
        Ok::<_, FfiError>(json!({ "law": "neo_hookean", "shear_modulus": modulus, "volumetric": volumetric }))
    };
    let named = |names: &[&str]| {
        let pairs = names.iter().map(|name| Ok(((*name).to_owned(), Value::from(value(name)?))));
        pairs.collect::<Result<serde_json::Map<_, _>, FfiError>>().map(Value::Object)
    };
    let law = match entry.model.as_str() {
        "bergstrom-boyce" => json!({
            "law": "bergstrom_boyce",
            "equilibrium": neo_hookean("")?,
            "overstress": neo_hookean("overstress_")?,
            "flow": named(&["rate", "stress", "stress_exponent", "stretch_exponent", "perturbation"])?,
        }),
        "reese-govindjee" => json!({
            "law": "reese_govindjee",
            "equilibrium": neo_hookean("")?,
            "overstress": neo_hookean("overstress_")?,
            "viscosity": value("viscosity")?,
            "bulk_fluidity": 0.0,
        }),
        "ogden-roxburgh" => json!({
            "law": "mullins",
            "elastic": neo_hookean("")?,
            "softening": value("softening")?,
            "energy": value("energy")?,
            "share": value("share")?,
        }),
        "viscoplastic" => {
            let volumetric = json!({ "law": "lame", "first_lame_parameter": value("first_lame_parameter")? });
            let elastic =
                json!({ "law": "hencky", "shear_modulus": value("shear_modulus")?, "volumetric": volumetric });
            json!({
                "law": "viscoplastic",
                "elastic": elastic,
                "hardening": named(&["yield_stress", "linear", "saturation", "saturation_exponent"])?,
                "viscosity": value("viscosity")?,
            })
        }
        _ => {
            let (given, valid) = (entry.model.clone(), FITTED.join(", "));
            return Err(FfiError::UnknownChoice { choice: "law with history of a fit", given, valid });
        }
    };
    history_from_value(law)
}
