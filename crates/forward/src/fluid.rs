//! Fluids named in an argument, in a file, or in the results of a fit.

use std::path::Path;

use piola_document::units::{Dimension, Quantity};
use piola_fluids::AnyFluid;
use serde_json::{Map, Value};

use crate::ForwardError;
use piola_measured::internal::{read, written_fluid};

const VISCOSITY: Dimension = Dimension { length: -1, mass: 1, time: -1, angle: 0 };

/// The dimension of a parameter that has one of its own; a consistency has that of Pa sⁿ.
fn dimension(parameter: &str) -> Option<Dimension> {
    match parameter {
        "yield_stress" | "apparent_yield_stress" | "half_stress" | "stress" => Some(Dimension::PRESSURE),
        "time" | "growth_time" => Some(Dimension::TIME),
        "exponent" | "transition" | "mobility" | "extensibility" => Some(Dimension::NONE),
        "consistency" => None,
        _ => Some(VISCOSITY),
    }
}

const VALID: &str = "NAME:PARAMETER=VALUE,…, as bingham:yield_stress=3 Pa,plastic_viscosity=50 mPa s; or a JSON file of a fluid, or the \
                     summary.json of a fit-flow or nonlinear, with #NAME for one of its fluids";

/// A fluid, as `bingham:yield_stress=3,plastic_viscosity=0.05`, a JSON file, or a fit's `summary.json` with `#bingham`.
///
/// # Errors
/// [`ForwardError::Argument`] for names, parameters or units that are not those of a fluid; [`ForwardError::Measured`] for
/// files.
///
/// # Example
/// ```
/// use piola_fluids::ViscometricFluid;
/// let mud = piola_forward::fluid("bingham:yield_stress=3 Pa,plastic_viscosity=500 mPa s")?;
/// assert_eq!(mud.shear_stress(4.0), 5.0);
/// assert!(piola_forward::fluid("bingham:yield_stress=3 m").is_err());
/// # Ok::<(), piola_forward::ForwardError>(())
/// ```
pub fn fluid(text: &str) -> Result<AnyFluid, ForwardError> {
    let (path, name) = text.split_once('#').map_or((text, None), |(path, name)| (path, Some(name)));
    if Path::new(path).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json")) {
        return of_file(Path::new(path), name);
    }
    let (name, parameters) = text.split_once(':').unwrap_or((text, ""));
    let mut fields = Map::new();
    for part in parameters.split(',').filter(|part| !part.trim().is_empty()) {
        let Some((parameter, value)) = part.split_once('=') else { return Err(refused(text)) };
        let parameter = parameter.trim().replace('-', "_");
        if fields.contains_key(&parameter) {
            return Err(ForwardError::Argument { argument: part.trim().to_owned(), valid: "each parameter once" });
        }
        let quantity: Quantity = value.trim().parse().map_err(|_| refused(part))?;
        let fits = quantity.dimension().is_none_or(|found| dimension(&parameter) == Some(found));
        let value = quantity.to_si().ok().filter(|_| fits).ok_or_else(|| ForwardError::Argument {
            argument: part.trim().to_owned(),
            valid: "a number in SI, or with a unit of this parameter",
        })?;
        fields.insert(parameter, value.into());
    }
    made(name, fields, text)
}

fn refused(text: &str) -> ForwardError {
    ForwardError::Argument { argument: text.trim().to_owned(), valid: VALID }
}

/// The fluid of a name and its parameters.
fn made(name: &str, mut fields: Map<String, Value>, text: &str) -> Result<AnyFluid, ForwardError> {
    fields.insert("fluid".to_owned(), name.trim().replace('-', "_").into());
    written_fluid(Value::Object(fields))
        .map_err(|error| ForwardError::Fluid { argument: text.to_owned(), cause: error.to_string() })
}

/// A fluid that was written, or one of a fit: that of the name, or the best.
fn of_file(path: &Path, name: Option<&str>) -> Result<AnyFluid, ForwardError> {
    let text = read(path)?;
    let shown = path.display().to_string();
    let wrong = |cause: String| ForwardError::Fluid { argument: shown.clone(), cause };
    let value: Value = serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
    let Some(fluids) = value["fluids"].as_array() else {
        return written_fluid(value).map_err(|error| wrong(error.to_string()));
    };
    let Some(name) = name.or_else(|| value["best_by_aicc"].as_str()) else {
        return Err(wrong("no fluid of this fit is the best; name one, as summary.json#bingham".to_owned()));
    };
    let Some(found) = fluids.iter().find(|fluid| fluid["fluid"] == name) else {
        let names: Vec<&str> = fluids.iter().filter_map(|fluid| fluid["fluid"].as_str()).collect();
        return Err(wrong(format!("no fluid of this fit is called {name}; it has {}", names.join(", "))));
    };
    // A fluid of several modes is written whole.
    if found["law"].is_object() {
        return written_fluid(found["law"].clone()).map_err(|error| wrong(error.to_string()));
    }
    let mut fields = Map::new();
    for parameter in found["parameters"].as_array().into_iter().flatten() {
        if let Some(name) = parameter["name"].as_str() {
            fields.insert(name.to_owned(), parameter["value"].clone());
        }
    }
    made(name, fields, &shown)
}
