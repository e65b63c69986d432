//! Columns of tables of moduli and compliances, with their units.

use core::f64::consts::TAU;

use piola_document::units::Dimension;

use super::Response;
use crate::fitting::TableMistake;
use crate::sheet::{NumberColumn as Column, Sheet, spelled, unknown, valid_units};

const FREQUENCY: &[&str] = &["frequency", "freq", "f", "ν"];
const ANGULAR: &[&str] = &["angular frequency", "angular freq", "ang frequency", "omega", "ω", "w"];
const TIME: &[&str] = &["time", "t", "step time"];
const STORAGE: &[&str] = &["storage modulus", "g'", "g′", "g storage", "gprime", "g prime"];
const LOSS: &[&str] = &[
    "loss modulus",
    "g''",
    "g″",
    "g′′",
    "g loss",
    "gprimeprime",
    "gdoubleprime",
    "g double prime",
    "g\"",
    "viscous modulus",
];
const RELAXATION: &[&str] = &["relaxation modulus", "g(t)", "gt", "g", "modulus"];
const CREEP: &[&str] = &["creep compliance", "compliance", "j", "j(t)", "shear compliance"];
pub(super) const TEMPERATURE: &[&str] = &["temperature", "temp", "θ"];
const ALL: [&[&str]; 8] = [FREQUENCY, ANGULAR, TIME, STORAGE, LOSS, RELAXATION, CREEP, TEMPERATURE];

/// Whether a column of this plain name is read.
pub(super) fn is_known(plain: &str) -> bool {
    ALL.iter().any(|names| names.contains(&plain))
}

/// A temperature in K, of a number in a unit.
pub(super) fn kelvin(value: f64, unit: &str) -> Option<f64> {
    let found = match unit.trim().trim_start_matches('°').trim_start_matches("deg").trim() {
        "C" | "c" | "Celsius" | "celsius" => value + 273.15,
        "K" | "k" | "Kelvin" | "kelvin" => value,
        "F" | "Fahrenheit" => (value - 32.0) / 1.8 + 273.15,
        _ => return None,
    };
    (0.0 < found && found.is_finite()).then_some(found)
}

/// A modulus, or of creep a compliance; without a unit it is in SI.
fn modulus(sheet: &Sheet, at: usize, response: Response, notes: &mut Vec<String>) -> Result<Column, TableMistake> {
    let compliance = Dimension::NONE.over(Dimension::PRESSURE);
    let (dimension, si) = if response == Response::Creep { (compliance, "1/Pa") } else { (Dimension::PRESSURE, "Pa") };
    let valid = if response == Response::Creep {
        "1/Pa, 1/kPa, 1/MPa, 1/GPa, m^2/N or cm^2/dyn".to_owned()
    } else {
        valid_units(dimension, si)
    };
    sheet.in_units(at, dimension, (si, &valid), notes)
}

/// The frequency or the time.
fn abscissa(sheet: &Sheet, at: usize, response: Response, notes: &mut Vec<String>) -> Result<Column, TableMistake> {
    let heading = &sheet.headings[at];
    let unit = heading.unit.as_deref().map(|text| (text, spelled(text)));
    if response != Response::Oscillation {
        return sheet.in_units(at, Dimension::TIME, ("s", "s, ms, min or h"), notes);
    }
    let is_angular = ANGULAR.contains(&heading.plain.as_str());
    let rate = Dimension { time: -1, ..Dimension::NONE };
    match unit {
        // A cycle is 2π; an angular frequency has no cycles.
        Some(("Hz", _)) if !is_angular => Ok(Column { at, factor: TAU }),
        Some(("kHz", _)) if !is_angular => Ok(Column { at, factor: 1e3 * TAU }),
        Some((text @ ("Hz" | "kHz"), _)) => {
            let what = format!("`{}` is in {text}", heading.written);
            Err(TableMistake::new(sheet.header_line, what, "`angular frequency [rad/s]` or `frequency [Hz]`"))
        }
        Some((_, Some(unit))) if unit.dimension == Dimension::ANGULAR_RATE => {
            Ok(Column { at, factor: unit.to_si(1.0) })
        }
        Some((_, Some(unit))) if unit.dimension == rate => {
            if !is_angular {
                notes.push(format!("`{}` is read as cycles: ω = 2π f", heading.written));
            }
            Ok(Column { at, factor: unit.to_si(1.0) * if is_angular { 1.0 } else { TAU } })
        }
        None if is_angular => {
            notes.push(format!("`{}` has no unit: read as rad/s", heading.written));
            Ok(Column { at, factor: 1.0 })
        }
        found => {
            let what = found.map_or_else(|| format!("`{}` has no unit", heading.written), |(text, _)| unknown(text));
            Err(TableMistake::new(sheet.header_line, what, "`angular frequency [rad/s]` or `frequency [Hz]`"))
        }
    }
}

/// The columns of a table.
pub(super) struct Columns {
    pub(super) response: Response,
    pub(super) at: Column,
    pub(super) moduli: Vec<Column>,
    pub(super) temperature: Option<(usize, String)>,
}

pub(super) fn columns(sheet: &Sheet, notes: &mut Vec<String>) -> Result<Columns, TableMistake> {
    let missing = |what: &str, valid: &'static str| {
        let what = format!("no column is {what}: the columns are {}", sheet.names());
        TableMistake::new(sheet.header_line, what, valid)
    };
    let (storage, loss) = (sheet.column(STORAGE)?, sheet.column(LOSS)?);
    let (relaxation, creep) = (sheet.column(RELAXATION)?, sheet.column(CREEP)?);
    let (response, moduli) = match (storage, loss, relaxation, creep) {
        (Some(storage), Some(loss), _, _) => (Response::Oscillation, vec![storage, loss]),
        (None, None, Some(_), Some(_)) => {
            let what = format!("columns of relaxation and of creep: the columns are {}", sheet.names());
            return Err(TableMistake::new(sheet.header_line, what, "one of them: `G(t) [Pa]`, or `J(t) [1/Pa]`"));
        }
        (None, None, Some(relaxation), None) => (Response::Relaxation, vec![relaxation]),
        (None, None, None, Some(creep)) => (Response::Creep, vec![creep]),
        (Some(_), None, ..) => return Err(missing("a loss modulus", "`G'' [Pa]`")),
        (None, Some(_), ..) => return Err(missing("a storage modulus", "`G' [Pa]`")),
        (None, None, None, None) => {
            return Err(missing("a modulus", "`G' [Pa]` and `G'' [Pa]`, or `G(t) [Pa]`, or `J(t) [1/Pa]`"));
        }
    };
    let x = if response == Response::Oscillation {
        let x = sheet.column(ANGULAR)?.map_or_else(|| sheet.column(FREQUENCY), |x| Ok(Some(x)))?;
        x.ok_or_else(|| missing("a frequency", "`angular frequency [rad/s]`"))?
    } else {
        sheet.column(TIME)?.ok_or_else(|| missing("a time", "`time [s]`"))?
    };
    let at = abscissa(sheet, x, response, notes)?;
    let moduli = moduli.into_iter().map(|at| modulus(sheet, at, response, notes)).collect::<Result<_, _>>()?;
    let temperature = sheet.column(TEMPERATURE)?.map(|at| {
        let unit = sheet.headings[at].unit.clone();
        (
            at,
            unit.unwrap_or_else(|| {
                notes.push(format!("`{}` has no unit: read as °C", sheet.headings[at].written));
                "°C".to_owned()
            }),
        )
    });
    if let Some((_, unit)) = &temperature
        && kelvin(300.0, unit).is_none()
    {
        return Err(TableMistake::new(sheet.header_line, unknown(unit), "°C, K or °F"));
    }
    Ok(Columns { response, at, moduli, temperature })
}
