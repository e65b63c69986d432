//! Tables of moduli over frequency or time, or of compliances over time.

use std::path::PathBuf;

use super::columns::{Columns, TEMPERATURE, columns, is_known, kelvin};
use super::isotherms::{Group, grouped, told_of};
use super::response::{Isotherm, Response, ResponseRow};
use crate::MeasuredError;
use crate::fitting::{TableMistake, TableReport};
use crate::sheet::{NumberColumn as Column, Row, Sheet, read};

/// Moduli or compliances of one material.
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
        let none = MeasuredError::Argument {
            argument: "no file".to_owned(),
            valid: "a file of moduli or compliances, or several",
        };
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
                valid: "files of one response: all of G′ and G″, or all of G(t), or all of J(t)",
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
        let isotherms = self.isotherms.iter().chain(&other.isotherms);
        let rows: Vec<(Option<f64>, ResponseRow)> =
            isotherms.flat_map(|found| found.rows.iter().map(|row| (found.temperature, *row))).collect();
        let groups = grouped(&rows).map_err(|[low, high]| MeasuredError::Argument {
            argument: format!("{shown}: temperatures from {low} to {high} K"),
            valid: RAMP,
        })?;
        let own: usize = self.isotherms.iter().map(|isotherm| isotherm.rows.len()).sum();
        self.isotherms.clear();
        for group in groups {
            let mut notes: Vec<String> = group.merged.iter().cloned().collect();
            // The rows of each file are sorted, and what they were is told already. New is what two files measured alike.
            let is_shared = group.places.iter().any(|k| *k < own) && group.places.iter().any(|k| own <= *k);
            let isotherm = group.sorted();
            if is_shared {
                notes.extend(told_of(&isotherm, self.response));
            }
            self.isotherms.push(isotherm);
            let new: Vec<String> = notes.into_iter().filter(|note| !self.notes.contains(note)).collect();
            self.notes.extend(new);
        }
        Ok(())
    }
}

/// What is valid in place of a ramp of the temperature.
const RAMP: &str = "isotherms: temperatures that are held to 3 K, half a kelvin apart or more";

/// What a table holds.
type Parsed = (Response, Vec<Isotherm>, Vec<String>);

fn parsed(text: &str) -> Result<Parsed, Vec<TableMistake>> {
    let sheet = Sheet::parse(text, &is_known)?;
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
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    let groups = grouped(&rows).map_err(|[low, high]| {
        let what = format!("temperatures run from {low} to {high} K without a gap");
        vec![TableMistake::new(sheet.last, what, RAMP)]
    })?;
    for group in &groups {
        notes.extend(group.merged.iter().cloned().chain(told_of(&group.isotherm, columns.response)));
    }
    Ok((columns.response, groups.into_iter().map(Group::sorted).collect(), notes))
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
