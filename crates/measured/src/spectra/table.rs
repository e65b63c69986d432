//! Tables of moduli over frequency or time.

use core::f64::consts::TAU;
use std::path::PathBuf;

use piola_document::units::Dimension;

use crate::MeasuredError;
use crate::fitting::{TableMistake, TableReport};
use crate::sheet::{Row, Sheet, read, spelled, units_of, unknown};

/// What was measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Response {
    /// G′ and G″ over the angular frequency ω.
    Oscillation,
    /// G over the time t after a step of strain.
    Relaxation,
}

/// A measured row in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ResponseRow {
    /// ω, rad/s, or t, s.
    pub at: f64,
    /// G′ and G″, Pa; or G twice.
    pub moduli: [f64; 2],
}

/// The rows of one temperature, in the order of ω or t.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Isotherm {
    /// The temperature, K, if it is told.
    pub temperature: Option<f64>,
    /// The rows.
    pub rows: Vec<ResponseRow>,
}

/// Moduli of one material.
///
/// # Example
/// ```
/// use piola_measured::spectra::{Response, SpectrumTable};
/// let text = "temperature [°C],frequency [Hz],G' [kPa],G'' [kPa]\n150,1,2,3\n150,2,4,5\n170,1,1,2\n";
/// let table = SpectrumTable::parse("melt.csv", text)?;
/// assert_eq!((table.response, table.isotherms.len()), (Response::Oscillation, 2));
/// assert_eq!(table.isotherms[0].temperature, Some(423.15));
/// assert_eq!(table.isotherms[0].rows[1].moduli, [4000.0, 5000.0]);
/// let wrong = SpectrumTable::parse("melt.csv", "time [s],G(t) [Pa]\n1,-2\n");
/// assert!(wrong.unwrap_err().to_string().starts_with("melt.csv:2: "));
/// # Ok::<(), piola_measured::MeasuredError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SpectrumTable {
    /// The file, or the first of several.
    pub path: PathBuf,
    /// What was measured.
    pub response: Response,
    /// The rows by temperature, the lowest first.
    pub isotherms: Vec<Isotherm>,
    /// What was read in a way that a reader must know, as sentences without a full stop.
    pub notes: Vec<String>,
}

impl SpectrumTable {
    /// Reads files of one material.
    ///
    /// # Errors
    /// [`MeasuredError::Unreadable`], [`MeasuredError::TooLarge`], [`MeasuredError::NotText`]; [`MeasuredError::Table`] with every
    /// mistake and its line; [`MeasuredError::Argument`] for files of different responses, or without temperatures beside others.
    pub fn load(paths: &[PathBuf]) -> Result<Self, MeasuredError> {
        let none = MeasuredError::Argument { argument: "no file".to_owned(), valid: "a file of moduli, or several" };
        let mut tables = paths.iter().map(|path| Self::parse(path, &read(path)?));
        let mut all = tables.next().ok_or(none)??;
        for table in tables {
            all.append(table?)?;
        }
        Ok(all)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`MeasuredError::Table`].
    pub fn parse(path: impl Into<PathBuf>, text: &str) -> Result<Self, MeasuredError> {
        let path = path.into();
        match parsed(text) {
            Ok((response, isotherms, notes)) => Ok(Self { path, response, isotherms, notes }),
            Err(mistakes) => Err(MeasuredError::Table(TableReport::new(path, mistakes))),
        }
    }

    /// The name of the file without folder and ending.
    #[must_use]
    pub fn name(&self) -> String {
        self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    fn append(&mut self, other: Self) -> Result<(), MeasuredError> {
        let shown = other.path.display();
        if other.response != self.response {
            return Err(MeasuredError::Argument {
                argument: shown.to_string(),
                valid: "files of one response: all of G′ and G″, or all of G(t)",
            });
        }
        if self.isotherms.iter().chain(&other.isotherms).any(|isotherm| isotherm.temperature.is_none()) {
            return Err(MeasuredError::Argument {
                argument: shown.to_string(),
                valid: "several files with a temperature each: a column, or a comment `# temperature: 150 °C`",
            });
        }
        let notes: Vec<String> = other.notes.into_iter().filter(|note| !self.notes.contains(note)).collect();
        self.notes.extend(notes);
        let isotherms = self.isotherms.drain(..).chain(other.isotherms);
        self.isotherms = grouped(isotherms.flat_map(|Isotherm { temperature, rows }| {
            rows.into_iter().map(move |row| (temperature, row)).collect::<Vec<_>>()
        }));
        Ok(())
    }
}

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
const TEMPERATURE: &[&str] = &["temperature", "temp", "θ"];
const ALL: [&[&str]; 7] = [FREQUENCY, ANGULAR, TIME, STORAGE, LOSS, RELAXATION, TEMPERATURE];

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

/// A column of numbers, and how they become SI.
#[derive(Clone, Copy)]
struct Column {
    at: usize,
    factor: f64,
}

fn column(sheet: &Sheet, names: &[&[&str]]) -> Option<usize> {
    sheet.columns(&|plain| names.iter().any(|names| names.contains(&plain))).next()
}

/// A modulus; without a unit it is in Pa.
fn modulus(sheet: &Sheet, at: usize, notes: &mut Vec<String>) -> Result<Column, TableMistake> {
    let Some(text) = sheet.headings[at].unit.as_deref() else {
        notes.push(format!("`{}` has no unit: read as Pa", sheet.headings[at].written));
        return Ok(Column { at, factor: 1.0 });
    };
    let unit = spelled(text).filter(|unit| unit.dimension == Dimension::PRESSURE);
    let valid = || format!("one of {}", units_of(Dimension::PRESSURE));
    let unit = unit.ok_or_else(|| TableMistake::new(sheet.header_line, unknown(text), valid()))?;
    Ok(Column { at, factor: unit.to_si(1.0) })
}

/// The frequency or the time.
fn abscissa(sheet: &Sheet, at: usize, response: Response, notes: &mut Vec<String>) -> Result<Column, TableMistake> {
    let heading = &sheet.headings[at];
    let unit = heading.unit.as_deref().map(|text| (text, spelled(text)));
    if response == Response::Relaxation {
        return match unit {
            None => {
                notes.push(format!("`{}` has no unit: read as s", heading.written));
                Ok(Column { at, factor: 1.0 })
            }
            Some((_, Some(unit))) if unit.dimension == Dimension::TIME => Ok(Column { at, factor: unit.to_si(1.0) }),
            Some((text, _)) => Err(TableMistake::new(sheet.header_line, unknown(text), "s, ms, min or h")),
        };
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

/// What a table holds.
type Parsed = (Response, Vec<Isotherm>, Vec<String>);

/// The columns of a table.
struct Columns {
    response: Response,
    at: Column,
    moduli: Vec<Column>,
    temperature: Option<(usize, String)>,
}

fn columns(sheet: &Sheet, notes: &mut Vec<String>) -> Result<Columns, TableMistake> {
    let missing = |what: &str, valid: &'static str| {
        let what = format!("no column is {what}: the columns are {}", sheet.names());
        TableMistake::new(sheet.header_line, what, valid)
    };
    let (storage, loss) = (column(sheet, &[STORAGE]), column(sheet, &[LOSS]));
    let (response, x, moduli) = match (storage, loss, column(sheet, &[RELAXATION])) {
        (Some(storage), Some(loss), _) => {
            let x = column(sheet, &[ANGULAR]).or_else(|| column(sheet, &[FREQUENCY]));
            (
                Response::Oscillation,
                x.ok_or_else(|| missing("a frequency", "`angular frequency [rad/s]`"))?,
                vec![storage, loss],
            )
        }
        (None, None, Some(relaxation)) => {
            let x = column(sheet, &[TIME]).ok_or_else(|| missing("a time", "`time [s]`"))?;
            (Response::Relaxation, x, vec![relaxation])
        }
        (Some(_), None, _) => return Err(missing("a loss modulus", "`G'' [Pa]`")),
        (None, Some(_), _) => return Err(missing("a storage modulus", "`G' [Pa]`")),
        (None, None, None) => return Err(missing("a modulus", "`G' [Pa]` and `G'' [Pa]`, or `G(t) [Pa]`")),
    };
    let at = abscissa(sheet, x, response, notes)?;
    let moduli = moduli.into_iter().map(|at| modulus(sheet, at, notes)).collect::<Result<_, _>>()?;
    let temperature = column(sheet, &[TEMPERATURE]).map(|at| {
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

fn parsed(text: &str) -> Result<Parsed, Vec<TableMistake>> {
    let sheet = Sheet::parse(text, &|plain| ALL.iter().any(|names| names.contains(&plain)))?;
    let mut notes = Vec::new();
    let columns = columns(&sheet, &mut notes).map_err(|mistake| vec![mistake])?;
    let stated = sheet.settings.iter().find(|setting| TEMPERATURE.contains(&setting.key.as_str()));
    let stated = match stated.map(|setting| (setting, stated_temperature(&setting.value))) {
        None => None,
        Some((_, Some(temperature))) => Some(temperature),
        Some((setting, None)) => {
            let what = format!("the temperature is `{}`", setting.value);
            return Err(vec![TableMistake::new(setting.line, what, "a number with its unit, as 150 °C")]);
        }
    };
    let mut mistakes = Vec::new();
    let mut rows = Vec::new();
    for row in &sheet.rows {
        if let Some(mistake) = sheet.incomplete(row) {
            mistakes.push(mistake);
            continue;
        }
        match read_row(&sheet, row, &columns) {
            Ok((temperature, found)) => rows.push((temperature.or(stated), found)),
            Err(mistake) => mistakes.push(mistake),
        }
    }
    if rows.is_empty() && mistakes.is_empty() {
        mistakes.push(TableMistake::new(sheet.last, "the table has a header and no rows", "a row for each point"));
    }
    if mistakes.is_empty() { Ok((columns.response, grouped(rows), notes)) } else { Err(mistakes) }
}

/// `150 °C`, `423 K`.
pub(super) fn stated_temperature(text: &str) -> Option<f64> {
    let text = text.trim();
    let end = text.find(|c: char| c == '°' || c.is_alphabetic()).unwrap_or(text.len());
    kelvin(text[..end].trim().replace(',', ".").parse().ok()?, &text[end..])
}

fn read_row(sheet: &Sheet, row: &Row, columns: &Columns) -> Result<(Option<f64>, ResponseRow), TableMistake> {
    let positive = |Column { at, factor }: Column| {
        let text = row.fields.get(at).unwrap_or_default();
        let found = sheet.number(text).map(|x| factor * x).filter(|x| 0.0 < *x && x.is_finite());
        found.ok_or_else(|| {
            let what = format!("`{}` is `{text}`", sheet.headings[at].written);
            TableMistake::new(row.line, what, "a finite number greater than zero")
        })
    };
    let at = positive(columns.at)?;
    let first = positive(columns.moduli[0])?;
    let second = columns.moduli.get(1).map_or(Ok(first), |column| positive(*column))?;
    let temperature = columns.temperature.as_ref().map(|(at, unit)| {
        let text = row.fields.get(*at).unwrap_or_default();
        sheet.number(text).and_then(|value| kelvin(value, unit)).ok_or_else(|| {
            TableMistake::new(row.line, format!("the temperature is `{text}`"), "a temperature above absolute zero")
        })
    });
    Ok((temperature.transpose()?, ResponseRow { at, moduli: [first, second] }))
}

/// Rows by temperature; those of one isotherm differ by less than half a kelvin, as instruments hold it.
fn grouped(rows: impl IntoIterator<Item = (Option<f64>, ResponseRow)>) -> Vec<Isotherm> {
    /// What an instrument lets the temperature wander, K.
    const HELD: f64 = 0.5;
    let mut isotherms: Vec<Isotherm> = Vec::new();
    for (temperature, row) in rows {
        let is_same = |isotherm: &&mut Isotherm| match (isotherm.temperature, temperature) {
            (Some(a), Some(b)) => (a - b).abs() < HELD,
            (a, b) => a.is_none() && b.is_none(),
        };
        match isotherms.iter_mut().find(is_same) {
            Some(isotherm) => isotherm.rows.push(row),
            None => isotherms.push(Isotherm { temperature, rows: vec![row] }),
        }
    }
    for isotherm in &mut isotherms {
        isotherm.rows.sort_by(|a, b| a.at.total_cmp(&b.at));
    }
    isotherms.sort_by(|a, b| a.temperature.unwrap_or(0.0).total_cmp(&b.temperature.unwrap_or(0.0)));
    isotherms
}
