//! Tables of stresses in shear and extension, from rest or steady.

use std::path::{Path, PathBuf};

use piola_fit::nonlinear::{NonlinearData, NonlinearFlow, ShearResponse};

use super::columns::{Column, Columns, Rate, columns, is_known};
use crate::MeasuredError;
use crate::fitting::{TableMistake, TableReport};
use crate::sheet::{Row, Sheet, read};

/// Measured flows of one fluid.
///
/// # Example
/// ```
/// use piola_measured::nonlinear::NonlinearTable;
/// let text = "# shear rate: 2 1/s\ntime [s],shear stress [kPa],N1 [kPa]\n0.5,1,0.2\n1,2,0.8\n";
/// let table = NonlinearTable::parse("melt.csv", text)?;
/// assert_eq!(table.flows.len(), 2); // of τ and of N₁
/// assert_eq!(table.flows[1].rows(), [[0.5, 200.0], [1.0, 800.0]]);
/// let wrong = NonlinearTable::parse("melt.csv", "shear rate [1/s],viscosity [Pa s]\n1,-2\n");
/// assert!(wrong.unwrap_err().to_string().starts_with("melt.csv:2: "));
/// # Ok::<(), piola_measured::MeasuredError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct NonlinearTable {
    /// The file, or the first of several.
    pub path: PathBuf,
    /// The flows: one for each response, and of start-up for each rate.
    pub flows: Vec<NonlinearData>,
    /// What was read in a way that a reader must know, as sentences without a full stop.
    pub notes: Vec<String>,
}

impl NonlinearTable {
    /// Reads files of one fluid.
    ///
    /// # Errors
    /// [`MeasuredError::Unreadable`], [`MeasuredError::TooLarge`], [`MeasuredError::NotText`]; [`MeasuredError::Table`] with every
    /// mistake and its line.
    pub fn load(paths: &[PathBuf]) -> Result<Self, MeasuredError> {
        let none = MeasuredError::Argument { argument: "no file".to_owned(), valid: "a file of stresses, or several" };
        let mut tables = paths.iter().map(|path| Self::parse(path, &read(path)?));
        let mut all = tables.next().ok_or(none)??;
        for table in tables {
            let table = table?;
            for set in table.flows {
                let rows = set.rows().iter().map(|row| (set.flow(), *row));
                add(&mut all.flows, rows)?;
            }
            let notes: Vec<String> = table.notes.into_iter().filter(|note| !all.notes.contains(note)).collect();
            all.notes.extend(notes);
        }
        Ok(all)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`MeasuredError::Table`].
    pub fn parse(path: impl Into<PathBuf>, text: &str) -> Result<Self, MeasuredError> {
        let path = path.into();
        let (rows, notes) = match rows(text) {
            Ok(found) => found,
            Err(mistakes) => return Err(MeasuredError::Table(TableReport::new(path, mistakes))),
        };
        let mut flows = Vec::new();
        add(&mut flows, rows.into_iter())?;
        Ok(Self { path, flows, notes })
    }

    /// The name of the file without folder and ending.
    #[must_use]
    pub fn name(&self) -> String {
        Path::new(&self.path).file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Rows of all flows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.flows.iter().map(|flow| flow.rows().len()).sum()
    }
}

/// Adds rows to the sets of their flows.
fn add(
    flows: &mut Vec<NonlinearData>,
    rows: impl Iterator<Item = (NonlinearFlow, [f64; 2])>,
) -> Result<(), MeasuredError> {
    let mut sets: Vec<(NonlinearFlow, Vec<[f64; 2]>)> =
        flows.drain(..).map(|set| (set.flow(), set.rows().to_vec())).collect();
    for (flow, row) in rows {
        match sets.iter_mut().find(|(other, _)| *other == flow) {
            Some((_, rows)) => rows.push(row),
            None => sets.push((flow, vec![row])),
        }
    }
    for (flow, rows) in sets {
        flows.push(NonlinearData::new(flow, rows)?);
    }
    Ok(())
}

/// A drive and a response, with the flow that they are of.
type FlowRow = (NonlinearFlow, [f64; 2]);
/// Rows of a table by their flows, and notes.
type Rows = (Vec<FlowRow>, Vec<String>);

fn rows(text: &str) -> Result<Rows, Vec<TableMistake>> {
    let sheet = Sheet::parse(text, &is_known)?;
    let mut notes = Vec::new();
    let columns = columns(&sheet, &mut notes).map_err(|mistake| vec![mistake])?;
    let (mut found, mut mistakes, mut at_rest) = (Vec::new(), Vec::new(), 0);
    for row in &sheet.rows {
        match read_row(&sheet, row, &columns) {
            Ok(Some(answers)) => found.extend(answers),
            Ok(None) => at_rest += 1,
            Err(mistake) => mistakes.push(mistake),
        }
    }
    if found.is_empty() && mistakes.is_empty() {
        mistakes.push(TableMistake::new(sheet.last, "the table has a header and no rows", "a row for each point"));
    }
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    if 0 < at_rest {
        notes.push(format!("rows at the time zero, where every fluid is at rest, are not used: {at_rest}"));
    }
    Ok((found, notes))
}

/// The responses of a row with their flows; none of the time zero.
fn read_row(sheet: &Sheet, row: &Row, columns: &Columns) -> Result<Option<Vec<FlowRow>>, TableMistake> {
    if let Some(mistake) = sheet.incomplete(row) {
        return Err(mistake);
    }
    let field = |at: usize| row.fields.get(at).unwrap_or_default();
    let wrong = |at: usize, valid: &'static str| {
        TableMistake::new(row.line, format!("`{}` is `{}`", sheet.headings[at].written, field(at)), valid)
    };
    let number = |Column { at, factor }: Column| sheet.number(field(at)).map(|x| factor * x).filter(|x| x.is_finite());
    let positive = |column: Column| {
        number(column).filter(|x| 0.0 < *x).ok_or_else(|| wrong(column.at, "a finite number greater than zero"))
    };
    let t = match columns.time {
        None => None,
        Some(column) => match number(column) {
            Some(t) if 0.0 < t => Some(t),
            Some(t) if 0.0 <= t => return Ok(None),
            _ => return Err(wrong(column.at, "a time of zero or later")),
        },
    };
    let rate = match columns.rate {
        Rate::Stated(rate) => rate,
        Rate::Column(column) => positive(column)?,
    };
    let mut answers = Vec::new();
    for response in &columns.responses {
        let column = response.column;
        if field(column.at).is_empty() {
            continue;
        }
        let stress = if response.shear == ShearResponse::SecondNormalStressDifference {
            number(column).filter(|x| *x < 0.0).ok_or_else(|| wrong(column.at, "a finite number less than zero"))?
        } else {
            positive(column)?
        };
        let stress = stress * rate.powi(response.power);
        answers.push((columns.flow(*response, rate), [t.unwrap_or(rate), stress]));
    }
    if answers.is_empty() {
        return Err(TableMistake::new(row.line, "a row without a response", "a number in a column of responses"));
    }
    Ok(Some(answers))
}
