//! Solids named in an argument, in a file, or in the results of a fit.

use std::path::Path;

use piola_document::units::{Dimension, Quantity};
use piola_fit::sides::SidesModel;
use piola_fit::solids::{AnyModel, Model as _, Parameter};
use piola_laws::rubber::AnyRubber;
use piola_measured::internal::{read, spelled, written_solid};
use piola_solids::volumetric::SimoTaylor;
use serde_json::Value;

use crate::ForwardError;

const VALID: &str = "NAME:PARAMETER=VALUE,…, as mooney-rivlin:c10=0.3 MPa,c01=50 kPa or ogden:1:mu1=0.6 MPa,alpha1=2; or a JSON \
                     file of a solid, or the summary.json of a fit, with #NAME for one of its laws";

/// A solid, as `yeoh:c10=0.3 MPa,c20=-1 kPa,c30=50 Pa`, a JSON file of a solid, or a fit's `summary.json` with `#yeoh`.
///
/// The names and parameters are those of the [models of fits](AnyModel). Such a law keeps its volume unless a bulk modulus K is
/// given: then its energy is that of F/J^(1/3) with U(J) = ¼ K (J² − 1 − 2 ln J) added.
///
/// # Errors
/// [`ForwardError::Solid`] and [`ForwardError::Argument`] for names, parameters or units that are not those of a solid;
/// [`ForwardError::Measured`] for files.
///
/// # Example
/// ```
/// use piola_laws::rubber::AnyRubber;
/// use piola_solids::{IncompressibleSolid, isochoric::MooneyRivlin};
/// let rubber = piola_forward::solid("mooney-rivlin:c10=0.3 MPa,c01=50 kPa", None)?;
/// assert_eq!(rubber, AnyRubber::from(IncompressibleSolid::new(MooneyRivlin::new(3e5, 5e4)?)));
/// assert!(piola_forward::solid("neo-hookean:mu=3 m", None).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn solid(text: &str, bulk_modulus: Option<&str>) -> Result<AnyRubber, ForwardError> {
    let bulk = bulk_modulus.map(|text| pressure(text).ok_or_else(|| wrong_bulk(text))).transpose()?;
    let (path, name) = text.split_once('#').map_or((text, None), |(path, name)| (path, Some(name)));
    if Path::new(path).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json")) {
        return of_file(Path::new(path), name, bulk);
    }
    let refused = || ForwardError::Argument { argument: text.trim().to_owned(), valid: VALID };
    // The name of a series has a colon of its own.
    let head = text.split('=').next().unwrap_or(text);
    let (name, _) = head.rsplit_once(':').ok_or_else(refused)?;
    let model = Named::parse(name.trim())?;
    let parameters = model.parameters();
    let mut values = vec![None; parameters.len()];
    for part in text[name.len() + 1..].split(',') {
        let (parameter, value) = part.split_once('=').ok_or_else(refused)?;
        let parameter = parameter.trim();
        let index = parameters.iter().position(|other| same(&other.name, parameter)).ok_or_else(|| {
            let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name.as_str()).collect();
            wrong(text, format!("{} has no parameter {parameter}; it has {}", name.trim(), names.join(", ")))
        })?;
        if values[index].is_some() {
            return Err(ForwardError::Argument { argument: part.trim().to_owned(), valid: "each parameter once" });
        }
        values[index] = Some(value_of(&parameters[index], value).ok_or_else(|| ForwardError::Argument {
            argument: part.trim().to_owned(),
            valid: "a number in SI, or with a unit of this parameter",
        })?);
    }
    let mut given = Vec::with_capacity(values.len());
    for (parameter, value) in parameters.iter().zip(values) {
        given.push(value.ok_or_else(|| wrong(text, format!("{} is not given", parameter.name)))?);
    }
    made(model, &given, bulk)
}

/// Whether two spellings name one parameter: `C10` is `c10`.
fn same(name: &str, spelling: &str) -> bool {
    name.eq_ignore_ascii_case(spelling)
}

fn wrong(text: &str, cause: String) -> ForwardError {
    ForwardError::Solid { argument: text.trim().to_owned(), cause }
}

fn wrong_bulk(text: &str) -> ForwardError {
    ForwardError::Argument { argument: format!("bulk modulus {text}"), valid: "a pressure above zero, as 1.5 GPa" }
}

/// Of a stress, in Pa, with or without its unit.
pub(crate) fn pressure(text: &str) -> Option<f64> {
    let quantity: Quantity = text.trim().parse().ok()?;
    let fits = quantity.dimension().is_none_or(|found| found == Dimension::PRESSURE);
    quantity.to_si().ok().filter(|_| fits)
}

fn value_of(parameter: &Parameter, text: &str) -> Option<f64> {
    if parameter.is_stress { pressure(text) } else { text.trim().parse().ok().filter(|x: &f64| x.is_finite()) }
}

/// A model of a name.
#[derive(Clone, Copy)]
enum Named {
    Rubber(AnyModel),
    Sides(SidesModel),
}

impl Named {
    fn parse(name: &str) -> Result<Self, ForwardError> {
        match name.parse() {
            Ok(model) => Ok(Self::Sides(model)),
            // One of these names with a wrong number of terms.
            Err(error) if name.starts_with("hyperfoam") || name.starts_with("holzapfel") => Err(error.into()),
            Err(_) => Ok(Self::Rubber(name.parse()?)),
        }
    }

    fn parameters(self) -> Vec<Parameter> {
        match self {
            Self::Rubber(model) => model.parameters(3.0),
            Self::Sides(model) => {
                let made = |(name, is_stress, bounds): (String, bool, [f64; 2])| Parameter {
                    is_stress,
                    ..Parameter::number(name, bounds)
                };
                model.parameters().into_iter().map(made).collect()
            }
        }
    }
}

/// The law of a model and its parameters in SI.
fn made(model: Named, values: &[f64], bulk: Option<f64>) -> Result<AnyRubber, ForwardError> {
    let model = match model {
        Named::Rubber(model) => model,
        Named::Sides(model) => return of_sides(model, values, bulk),
    };
    Ok(match bulk {
        Some(modulus) => {
            let volumetric = SimoTaylor::new(modulus).map_err(piola_fit::FitError::from)?;
            model.compressible(values, volumetric)?
        }
        None => model.law(values)?,
    })
}

/// A foam has its own law of volumes; fibres need a bulk modulus.
fn of_sides(model: SidesModel, values: &[f64], bulk: Option<f64>) -> Result<AnyRubber, ForwardError> {
    let name = model.to_string();
    match (model, bulk) {
        (SidesModel::Hyperfoam(_), None) => Ok(model.law(values, 0.0)?),
        (SidesModel::Hyperfoam(_), Some(_)) => {
            Err(wrong(&name, "a foam has its own law of volumes; leave out the bulk modulus".to_owned()))
        }
        (_, Some(bulk)) => Ok(model.law(values, bulk)?),
        (_, None) => Err(wrong(&name, "it needs a bulk modulus, as 1 GPa".to_owned())),
    }
}

/// A solid that was written, or one of a fit: that of the name, or the best.
fn of_file(path: &Path, name: Option<&str>, bulk: Option<f64>) -> Result<AnyRubber, ForwardError> {
    let text = read(path)?;
    let shown = path.display().to_string();
    let wrong = |cause: String| wrong(&shown, cause);
    let value: Value = serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
    let Some(laws) = value["laws"].as_array() else {
        if bulk.is_some() {
            return Err(wrong("a solid of a file has its own law of volumes; leave out the bulk modulus".to_owned()));
        }
        return written_solid(value).map_err(|error| wrong(error.to_string()));
    };
    let Some(name) = name.or_else(|| value["best_by_aicc"].as_str()) else {
        return Err(wrong("no law of this fit is the best; name one, as summary.json#yeoh".to_owned()));
    };
    let Some(found) = laws.iter().find(|law| law["model"] == name) else {
        let names: Vec<&str> = laws.iter().filter_map(|law| law["model"].as_str()).collect();
        return Err(wrong(format!("no law of this fit is called {name}; it has {}", names.join(", "))));
    };
    if let Some(failure) = found["failure"].as_str() {
        return Err(wrong(format!("the fit of {name} failed: {failure}")));
    }
    let model = Named::parse(name)?;
    let unit = match value["stress_unit"].as_str() {
        Some(unit) => spelled(unit)
            .filter(|unit| unit.dimension == Dimension::PRESSURE)
            .ok_or_else(|| wrong(format!("the unit of stress, {unit}, is not known")))?
            .to_si(1.0),
        None => 1.0,
    };
    let fitted = found["parameters"].as_array().map_or(&[][..], Vec::as_slice);
    let value = |parameter: &Parameter| {
        let entry = fitted.iter().find(|entry| entry["name"] == parameter.name.as_str())?;
        Some(entry["value"].as_f64()? * if parameter.is_stress { unit } else { 1.0 })
    };
    let mut given = Vec::with_capacity(fitted.len());
    for parameter in &model.parameters() {
        given.push(value(parameter).ok_or_else(|| wrong(format!("{name} lacks a value of {}", parameter.name)))?);
    }
    made(model, &given, bulk)
}
