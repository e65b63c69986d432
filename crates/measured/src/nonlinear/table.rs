//! Tables of stresses in shear and extension, from rest or steady.

use std::path::{Path, PathBuf};

use piola_fit::nonlinear::{NonlinearData, NonlinearFlow, ShearResponse};

use super::columns::{Columns, Rate, columns, is_known, rate_of};
use crate::MeasuredError;
use crate::fitting::{TableMistake, TableReport};
use crate::sheet::{NumberColumn as Column, Row, Sheet, read};

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
    /// The flows: one for each response, and of start-up for each rate. Rates within 1 % are one.
    pub flows: Vec<NonlinearData>,
    /// What was read in a way that a reader must know, as sentences without a full stop.
    pub notes: Vec<String>,
}

impl NonlinearTable {
    /// Reads files of one fluid.
    ///
    /// # Errors
    /// [`MeasuredError::Unreadable`], [`MeasuredError::TooLarge`], [`MeasuredError::NotText`]; [`MeasuredError::Table`] with every
    /// mistake and its line; [`MeasuredError::Argument`] for more than 500 flows.
    pub fn load(paths: &[PathBuf]) -> Result<Self, MeasuredError> {
        let none = MeasuredError::Argument { argument: "no file".to_owned(), valid: "a file of stresses, or several" };
        let first = paths.first().ok_or(none)?;
        let (mut all, mut notes) = (Vec::new(), Vec::new());
        for path in paths {
            let (rows, own) = rows_of(path, &read(path)?)?;
            all.extend(rows);
            let own: Vec<String> = own.into_iter().filter(|note| !notes.contains(note)).collect();
            notes.extend(own);
        }
        let flows = grouped(all.into_iter(), &mut notes)?;
        Ok(Self { path: first.clone(), flows, notes })
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`MeasuredError::Table`]; [`MeasuredError::Argument`] for more than 500 flows.
    pub fn parse(path: impl Into<PathBuf>, text: &str) -> Result<Self, MeasuredError> {
        let path = path.into();
        let (rows, mut notes) = rows_of(&path, text)?;
        let flows = grouped(rows.into_iter(), &mut notes)?;
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

/// Start-ups at rates within this factor are one.
const SAME_RATE: f64 = 1.01;
/// The most flows of a table.
const MOST_FLOWS: usize = 500;

/// The flow at another rate; a steady one has none.
const fn at_rate(flow: NonlinearFlow, rate: f64) -> NonlinearFlow {
    match flow {
        NonlinearFlow::ShearStartUp { response, .. } => NonlinearFlow::ShearStartUp { shear_rate: rate, response },
        NonlinearFlow::ExtensionStartUp { extension, .. } => NonlinearFlow::ExtensionStartUp { extension, rate },
        steady => steady,
    }
}

/// Rows with their order, by flow at the rate 1/s, each with its rate.
type Kinds = Vec<(NonlinearFlow, Vec<(f64, usize, [f64; 2])>)>;

/// The flows of all rows, in the order of their first rows. Start-ups at rates within 1 % are one, at the mean of the rates of their rows;
/// a note says so.
fn grouped(rows: impl Iterator<Item = FlowRow>, notes: &mut Vec<String>) -> Result<Vec<NonlinearData>, MeasuredError> {
    let mut kinds: Kinds = Vec::new();
    for (order, (flow, row)) in rows.enumerate() {
        let kind = at_rate(flow, 1.0);
        let rate = rate_of(flow).unwrap_or(1.0);
        match kinds.iter_mut().find(|(other, _)| *other == kind) {
            Some((_, rows)) => rows.push((rate, order, row)),
            None => kinds.push((kind, vec![(rate, order, row)])),
        }
    }
    let mut found = Vec::new();
    for (kind, mut rows) in kinds {
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut rest = rows.as_slice();
        while let Some(&(least, ..)) = rest.first() {
            let count = rest.partition_point(|(rate, ..)| *rate <= SAME_RATE * least);
            let (these, others) = rest.split_at(count);
            rest = others;
            let greatest = these.last().map_or(least, |(rate, ..)| *rate);
            let mut rate = least;
            if least < greatest {
                rate += these.iter().map(|(rate, ..)| (rate - least) / count as f64).sum::<f64>();
                let note =
                    format!("rates within 1 % are one start-up: {least} to {greatest} 1/s are read as {rate:.6} 1/s");
                if !notes.contains(&note) {
                    notes.push(note);
                }
            }
            let first = these.iter().map(|(_, order, _)| *order).min().unwrap_or(0);
            let mut these: Vec<(usize, [f64; 2])> = these.iter().map(|(_, order, row)| (*order, *row)).collect();
            these.sort_by_key(|(order, _)| *order);
            found.push((first, at_rate(kind, rate), these.into_iter().map(|(_, row)| row).collect::<Vec<_>>()));
        }
    }
    if MOST_FLOWS < found.len() {
        let argument = format!("a table of {} flows", found.len());
        return Err(MeasuredError::Argument { argument, valid: "at most 500 rates and responses of start-up" });
    }
    found.sort_by_key(|(first, ..)| *first);
    found.into_iter().map(|(_, flow, rows)| Ok(NonlinearData::new(flow, rows)?)).collect()
}

/// A drive and a response, with the flow that they are of.
type FlowRow = (NonlinearFlow, [f64; 2]);
/// Rows of a table by their flows, and notes.
type Rows = (Vec<FlowRow>, Vec<String>);

fn rows_of(path: &Path, text: &str) -> Result<Rows, MeasuredError> {
    rows(text).map_err(|mistakes| MeasuredError::Table(TableReport::new(path.to_owned(), mistakes)))
}

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
        if !stress.is_normal() {
            return Err(wrong(
                column.at,
                "a number whose stress, times the power of the rate, is neither zero nor infinite",
            ));
        }
        answers.push((columns.flow(*response, rate), [t.unwrap_or(rate), stress]));
    }
    if answers.is_empty() {
        return Err(TableMistake::new(row.line, "a row without a response", "a number in a column of responses"));
    }
    Ok(Some(answers))
}
