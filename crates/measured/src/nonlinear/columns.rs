//! Columns of tables of nonlinear flows, with their units.

use piola_document::units::Dimension;
use piola_fit::nonlinear::{Extension, NonlinearFlow, ShearResponse};

use crate::fitting::TableMistake;
use crate::sheet::{NumberColumn as Column, Sheet, spelled, valid_units};

const RATE: Dimension = Dimension { time: -1, ..Dimension::NONE };
const VISCOSITY: Dimension = Dimension { length: -1, mass: 1, time: -1, angle: 0 };
/// Of Ψ₁ and Ψ₂, Pa s².
const COEFFICIENT: Dimension = Dimension { length: -1, mass: 1, time: 0, angle: 0 };

const TIME: &[&str] = &["time", "t"];
const SHEAR_RATE: &[&str] = &["shear rate", "shearrate", "gamma dot", "gammadot", "γ̇"];
const EXTENSION_RATE: &[&str] = &[
    "extension rate",
    "extensional rate",
    "elongation rate",
    "elongational rate",
    "hencky rate",
    "hencky strain rate",
    "strain rate",
    "epsilon dot",
    "ε̇",
];

/// A measured quantity: its names, its dimension, the power of the rate that makes it a stress, and the flows that have it.
struct Quantity {
    names: &'static [&'static str],
    dimension: Dimension,
    si: &'static str,
    /// The stress is the number times this power of the rate.
    power: i32,
    /// None of an extension.
    in_shear: Option<ShearResponse>,
    in_extension: bool,
}

use ShearResponse::{FirstNormalStressDifference as First, SecondNormalStressDifference as Second, ShearStress};

const QUANTITIES: [Quantity; 9] = [
    Quantity {
        names: &["shear stress", "tau", "τ"],
        dimension: Dimension::PRESSURE,
        si: "Pa",
        power: 0,
        in_shear: Some(ShearStress),
        in_extension: false,
    },
    Quantity {
        names: &["stress"],
        dimension: Dimension::PRESSURE,
        si: "Pa",
        power: 0,
        in_shear: Some(ShearStress),
        in_extension: true,
    },
    Quantity {
        names: &["viscosity", "shear viscosity", "eta", "η", "eta+", "η+"],
        dimension: VISCOSITY,
        si: "Pa s",
        power: 1,
        in_shear: Some(ShearStress),
        in_extension: true,
    },
    Quantity {
        names: &["n1", "n₁", "first normal stress difference"],
        dimension: Dimension::PRESSURE,
        si: "Pa",
        power: 0,
        in_shear: Some(First),
        in_extension: false,
    },
    Quantity {
        names: &["psi1", "ψ1", "ψ₁", "first normal stress coefficient"],
        dimension: COEFFICIENT,
        si: "Pa s^2",
        power: 2,
        in_shear: Some(First),
        in_extension: false,
    },
    Quantity {
        names: &["n2", "n₂", "second normal stress difference"],
        dimension: Dimension::PRESSURE,
        si: "Pa",
        power: 0,
        in_shear: Some(Second),
        in_extension: false,
    },
    Quantity {
        names: &["psi2", "ψ2", "ψ₂", "second normal stress coefficient"],
        dimension: COEFFICIENT,
        si: "Pa s^2",
        power: 2,
        in_shear: Some(Second),
        in_extension: false,
    },
    Quantity {
        names: &["extensional stress", "elongational stress", "tensile stress", "stress difference"],
        dimension: Dimension::PRESSURE,
        si: "Pa",
        power: 0,
        in_shear: None,
        in_extension: true,
    },
    Quantity {
        names: &["extensional viscosity", "elongational viscosity", "eta e", "ηe", "eta e+"],
        dimension: VISCOSITY,
        si: "Pa s",
        power: 1,
        in_shear: None,
        in_extension: true,
    },
];

/// Whether a column of this plain name is read.
pub(super) fn is_known(plain: &str) -> bool {
    let rates = [TIME, SHEAR_RATE, EXTENSION_RATE];
    rates.iter().chain(QUANTITIES.iter().map(|quantity| &quantity.names)).any(|names| names.contains(&plain))
}

/// Where the rate stands.
#[derive(Clone, Copy)]
pub(super) enum Rate {
    /// In a column.
    Column(Column),
    /// In a comment: one rate for all rows, 1/s.
    Stated(f64),
}

/// A column of responses.
#[derive(Clone, Copy)]
pub(super) struct Response {
    pub(super) column: Column,
    /// The stress is the number times this power of the rate.
    pub(super) power: i32,
    /// What is measured in shear.
    pub(super) shear: ShearResponse,
}

/// The rate of a start-up, 1/s.
pub(super) const fn rate_of(flow: NonlinearFlow) -> Option<f64> {
    match flow {
        NonlinearFlow::ShearStartUp { shear_rate: rate, .. } | NonlinearFlow::ExtensionStartUp { rate, .. } => {
            Some(rate)
        }
        _ => None,
    }
}

/// The columns of a table.
pub(super) struct Columns {
    pub(super) time: Option<Column>,
    pub(super) rate: Rate,
    /// The kind of extension; none of a shear.
    pub(super) extension: Option<Extension>,
    pub(super) responses: Vec<Response>,
}

impl Columns {
    /// The flow of a response at a rate.
    pub(super) const fn flow(&self, response: Response, rate: f64) -> NonlinearFlow {
        let shear = response.shear;
        match (self.extension, self.time.is_some()) {
            (None, true) => NonlinearFlow::ShearStartUp { shear_rate: rate, response: shear },
            (None, false) => NonlinearFlow::SteadyShear(shear),
            (Some(extension), true) => NonlinearFlow::ExtensionStartUp { extension, rate },
            (Some(extension), false) => NonlinearFlow::SteadyExtension(extension),
        }
    }
}

/// A column with its unit; without one it is in SI.
fn column(
    sheet: &Sheet,
    at: usize,
    dimension: Dimension,
    si: &str,
    notes: &mut Vec<String>,
) -> Result<Column, TableMistake> {
    sheet.in_units(at, dimension, (si, &valid_units(dimension, si)), notes)
}

/// The line and the rate of a comment, as `# shear rate: 2 1/s`.
fn stated(sheet: &Sheet, names: &[&str]) -> Result<Option<(u64, f64)>, TableMistake> {
    let Some(setting) = sheet.settings.iter().find(|setting| names.contains(&setting.key.as_str())) else {
        return Ok(None);
    };
    let (number, unit) = setting.value.split_once(' ').unwrap_or((&setting.value, ""));
    let unit = spelled(unit).filter(|unit| unit.dimension == RATE);
    let rate = sheet.number(number).zip(unit).map(|(x, unit)| unit.to_si(x));
    let rate = rate.filter(|rate| 0.0 < *rate && rate.is_finite());
    let wrong = || {
        let what = format!("the {} is `{}`", names[0], setting.value);
        TableMistake::new(setting.line, what, "a positive number with its unit, as 2 1/s")
    };
    rate.map(|rate| Some((setting.line, rate))).ok_or_else(wrong)
}

/// The kind of extension in a comment, as `# extension: planar`.
fn extension(sheet: &Sheet, notes: &mut Vec<String>) -> Result<Extension, TableMistake> {
    let Some(setting) = sheet.settings.iter().find(|setting| setting.key == "extension") else {
        notes.push(
            "the extension is read as uniaxial; a comment `# extension: planar` or `biaxial` says another".into(),
        );
        return Ok(Extension::Uniaxial);
    };
    match setting.value.to_lowercase().as_str() {
        "uniaxial" => Ok(Extension::Uniaxial),
        "planar" => Ok(Extension::Planar),
        "biaxial" | "equibiaxial" => Ok(Extension::Biaxial),
        _ => {
            let what = format!("the extension is `{}`", setting.value);
            Err(TableMistake::new(setting.line, what, "uniaxial, planar or biaxial"))
        }
    }
}

pub(super) fn columns(sheet: &Sheet, notes: &mut Vec<String>) -> Result<Columns, TableMistake> {
    let missing = |what: &str, valid: &'static str| {
        let what = format!("no column is {what}: the columns are {}", sheet.names());
        TableMistake::new(sheet.header_line, what, valid)
    };
    let mut rate_of = |names: &[&str]| -> Result<Option<Rate>, TableMistake> {
        match (sheet.column(names)?, stated(sheet, names)?) {
            (Some(_), Some((line, _))) => {
                let what = format!("the {} stands in a column and in this comment", names[0]);
                Err(TableMistake::new(line, what, "one of them"))
            }
            (Some(at), None) => Ok(Some(Rate::Column(column(sheet, at, RATE, "1/s", notes)?))),
            (None, stated) => Ok(stated.map(|(_, rate)| Rate::Stated(rate))),
        }
    };
    let (shear, extensional) = (rate_of(SHEAR_RATE)?, rate_of(EXTENSION_RATE)?);
    let (rate, extension) = match (shear, extensional) {
        (Some(rate), None) => (rate, None),
        (None, Some(rate)) => (rate, Some(extension(sheet, notes)?)),
        (Some(_), Some(_)) => {
            let what = "a shear rate and a rate of extension in one table";
            return Err(TableMistake::new(sheet.header_line, what, "one of them; another flow in a file of its own"));
        }
        (None, None) => {
            let valid = "`shear rate [1/s]` or `extension rate [1/s]`; of one rate a comment, as `# shear rate: 2 1/s`";
            return Err(missing("a rate", valid));
        }
    };
    let time = match sheet.column(TIME)? {
        Some(at) => Some(column(sheet, at, Dimension::TIME, "s", notes)?),
        None => None,
    };
    if time.is_none() && matches!(rate, Rate::Stated(_)) {
        return Err(missing("a time", "`time [s]`, of the start-up at the rate in the comment"));
    }
    let mut responses = Vec::new();
    for quantity in &QUANTITIES {
        let shear = if extension.is_none() { quantity.in_shear } else { quantity.in_extension.then_some(ShearStress) };
        if let (Some(at), Some(shear)) = (sheet.column(quantity.names)?, shear) {
            let column = column(sheet, at, quantity.dimension, quantity.si, notes)?;
            responses.push(Response { column, power: quantity.power, shear });
        }
    }
    if responses.is_empty() {
        let valid = if extension.is_none() {
            "`shear stress [Pa]`, `viscosity [Pa s]`, `N1 [Pa]` or `N2 [Pa]`"
        } else {
            "`extensional stress [Pa]` or `extensional viscosity [Pa s]`"
        };
        return Err(missing("a response", valid));
    }
    for (k, response) in responses.iter().enumerate() {
        if let Some(other) = responses[..k].iter().find(|other| other.shear == response.shear) {
            let [first, second] = [other, response].map(|found| sheet.headings[found.column.at].written.clone());
            let what = format!("`{first}` and `{second}` are the same response twice");
            return Err(TableMistake::new(sheet.header_line, what, "one of them; rename the other"));
        }
    }
    Ok(Columns { time, rate, extension, responses })
}
