//! Tables of viscometric measurements.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use piola_fit::FitError;
use piola_fit::fluids::FlowData;
use piola_viscometry::ViscometryError;
use piola_viscometry::recover::{FlowTable, mean, repeats};

use super::columns::{self, Sources};
use super::geometry::{mismatch, size};
use super::kind::{Answer, Answering, Flow, FlowKind};
use super::sweeps::{self, Hysteresis, Sweep};
use crate::MeasuredError;
use crate::fitting::{TableMistake, TableReport};
use crate::sheet::{Sheet, read};

/// How a table is read.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Reading {
    /// Lengths and angles, as `("radius", "2 mm")`; they stand before those of the file.
    pub sizes: Vec<(String, String)>,
    /// The rows that are used of a table with rising and falling sweeps.
    pub sweep: Sweep,
    /// Only rows whose column has this text or number are used.
    pub only: Vec<(String, String)>,
}

/// A table of measurements in SI units. Its rows rise in the drive, in whatever order the file has them.
///
/// # Example
/// ```
/// use piola_measured::rheology::{FlowKind, Measured};
/// let text = "# radius: 2 mm\npressure_gradient [kPa/m],discharge [mm^3/s]\n20,251\n10,125.5\n";
/// let measured = Measured::parse("pipe.csv", text, FlowKind::Pipe, &[])?;
/// assert_eq!(measured.rows()[1], [20e3, 251e-9]);
/// let wrong = Measured::parse("pipe.csv", &text.replace("kPa/m", "kg"), FlowKind::Pipe, &[]);
/// assert!(wrong.unwrap_err().to_string().starts_with("pipe.csv:2: "));
/// // A spreadsheet's table, with viscosities instead of stresses.
/// let text = "Shear rate [1/s];Viscosity [mPa s];T [°C]\n0,5;2000;25\n1,0;1200;25\n";
/// let measured = Measured::parse("curve.csv", text, FlowKind::Curve, &[])?;
/// assert_eq!(measured.rows(), [[0.5, 1.0], [1.0, 1.2]]);
/// # Ok::<(), piola_measured::MeasuredError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Measured {
    /// The file.
    pub path: PathBuf,
    /// The flow with its geometry.
    pub flow: Flow,
    /// The columns of responses, in the order of the file; one at least. Each has the rows of the table.
    pub answers: Vec<Answer>,
    /// The line of each row.
    pub lines: Vec<u64>,
    /// What was read in a way that a reader must know, as sentences without a full stop.
    pub notes: Vec<String>,
    /// Falling beside rising sweeps, if the file has both.
    pub hysteresis: Option<Hysteresis>,
}

impl Measured {
    /// Reads a file. Sizes such as `("radius", "2 mm")` stand before those of the file.
    ///
    /// # Errors
    /// [`MeasuredError::Unreadable`], [`MeasuredError::TooLarge`], [`MeasuredError::NotText`], [`MeasuredError::Argument`];
    /// [`MeasuredError::Table`] with every mistake and its line.
    pub fn load(path: &Path, kind: FlowKind, sizes: &[(String, String)]) -> Result<Self, MeasuredError> {
        Self::load_as(path, kind, &Reading { sizes: sizes.to_vec(), ..Reading::default() })
    }

    /// Reads a file in a stated way.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn load_as(path: &Path, kind: FlowKind, reading: &Reading) -> Result<Self, MeasuredError> {
        Self::parse_as(path, &read(path)?, kind, reading)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`MeasuredError::Table`], [`MeasuredError::Argument`].
    pub fn parse(
        path: impl Into<PathBuf>,
        text: &str,
        kind: FlowKind,
        sizes: &[(String, String)],
    ) -> Result<Self, MeasuredError> {
        Self::parse_as(path, text, kind, &Reading { sizes: sizes.to_vec(), ..Reading::default() })
    }

    /// Reads the text of a file in a stated way.
    ///
    /// # Errors
    /// As [`parse`](Self::parse).
    pub fn parse_as(
        path: impl Into<PathBuf>,
        text: &str,
        kind: FlowKind,
        reading: &Reading,
    ) -> Result<Self, MeasuredError> {
        let path = path.into();
        let given = given_sizes(kind, &reading.sizes)?;
        let table = |mistakes: Vec<TableMistake>| MeasuredError::Table(TableReport::new(path.clone(), mistakes));
        let mut sheet = Sheet::parse(text, &columns::is_known).map_err(table)?;
        for (column, value) in &reading.only {
            sheet.keep_only(column, value).map_err(|mistake| table(vec![mistake]))?;
        }
        let read = rows(&sheet, kind, &given, reading.sweep).map_err(table)?;
        let measured = Self { path: path.clone(), ..read };
        match measured.check() {
            Ok(()) => Ok(measured),
            Err(error) => Err(table(vec![measured.mistake(&error)])),
        }
    }

    /// The name of the file without folder and ending.
    #[must_use]
    pub fn name(&self) -> String {
        self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// "ketchup: 31 rows, coaxial cylinders", and what was read in a way that a reader must know.
    pub(super) fn heading(&self) -> String {
        let notes = self.notes.iter().fold(String::new(), |text, note| text + "\n  " + note);
        format!("{}: {} rows, {}{notes}", self.name(), self.rows().len(), self.flow.kind().words())
    }

    /// Drives and responses: of the first column that is not of normal stresses, if there is one.
    #[must_use]
    pub fn rows(&self) -> &[[f64; 2]] {
        self.sheared().or(self.answers.first()).map_or(&[], |answer| &answer.rows)
    }

    /// The same with one row for each drive: the geometric mean of repeated measurements ([`repeats`]).
    #[must_use]
    pub fn merged(&self) -> Cow<'_, Self> {
        let rows = self.rows();
        let groups = repeats(rows);
        if groups.len() == rows.len() {
            return Cow::Borrowed(self);
        }
        let merged = |answer: &Answer| Answer {
            what: answer.what,
            is_negative: answer.is_negative,
            rows: groups.iter().map(|group| mean(&answer.rows[group.clone()])).collect(),
        };
        let mut notes = self.notes.clone();
        notes.push(format!("{} rows are means of repeated measurements at {} drives", rows.len(), groups.len()));
        Cow::Owned(Self {
            path: self.path.clone(),
            flow: self.flow,
            answers: self.answers.iter().map(merged).collect(),
            lines: groups.iter().map(|group| self.lines[group.start]).collect(),
            notes,
            hysteresis: self.hysteresis,
        })
    }

    /// The first column that is not of normal stresses.
    pub(super) fn sheared(&self) -> Option<&Answer> {
        self.answers.iter().find(|answer| !answer.what.is_normal())
    }

    /// The names of a pair of columns with their SI units.
    pub(super) fn columns(&self, answer: Answering) -> [String; 2] {
        [self.flow.kind().drive(), answer.column()].map(|(name, _, unit)| format!("{name} [{unit}]"))
    }

    /// The names of the columns of [`rows`](Self::rows).
    pub(super) fn first_columns(&self) -> [String; 2] {
        self.sheared().or(self.answers.first()).map_or_else(Default::default, |answer| self.columns(answer.what))
    }

    /// The [`rows`](Self::rows) as data of a fit.
    pub(super) fn data(&self) -> Result<FlowData, FitError> {
        let rows = self.rows();
        let none: &[[f64; 2]] = &[];
        let data = match self.flow {
            Flow::Pipe { radius } => FlowData::pipe(&FlowTable::pipe(radius, none)?),
            Flow::Capillary { radius, length } => {
                let gradients: Vec<_> =
                    rows.iter().map(|[discharge, pressure]| [pressure / length, *discharge]).collect();
                return Ok(FlowData::pipe(&FlowTable::pipe(radius, &gradients)?));
            }
            Flow::Channel { half_width } => FlowData::channel(&FlowTable::channel(half_width, none)?),
            Flow::Couette { inner_radius, outer_radius } => {
                FlowData::couette(&FlowTable::couette(inner_radius, outer_radius, none)?)
            }
            Flow::Plates { radius, gap } => FlowData::parallel_plates(&FlowTable::parallel_plates(radius, gap, none)?),
            Flow::Cone { radius, angle } => FlowData::cone_and_plate(&FlowTable::cone_and_plate(radius, angle, none)?),
            Flow::Curve => FlowData::flow_curve(none)?,
        };
        data.with_rows(rows.to_vec())
    }

    fn check(&self) -> Result<(), ViscometryError> {
        let merged = self.merged();
        merged.answers.iter().try_for_each(|answer| FlowTable::new((), &answer.rows).map(|_| ()))
    }

    /// An error of viscometry, with the line of its row.
    fn mistake(&self, error: &ViscometryError) -> TableMistake {
        let line = |row: usize| self.lines.get(row).copied().unwrap_or(1);
        let (row, valid) = match error {
            ViscometryError::RowNotPositive { row, .. } => (Some(*row), "positive numbers"),
            ViscometryError::RowTwice { row, .. } => (Some(*row), "each value of the first column once"),
            ViscometryError::RowNotSorted { row, .. } => (Some(*row), "rows that rise in the first column"),
            ViscometryError::ResponseFalls { row, .. } => {
                (Some(*row), "a response that rises with the drive; if noise makes it fall, state it, as --noise 2%")
            }
            _ => (None, "a table of this flow"),
        };
        let text = error.to_string();
        // The error counts rows from 0; the line says it to a reader.
        let what = text.split_once(": ").filter(|_| row.is_some()).map_or(text.as_str(), |(_, what)| what);
        TableMistake::new(row.map_or_else(|| line(0), line), what, valid)
    }

    /// An error of viscometry, with the line where it has one.
    pub(super) fn refused(&self, error: ViscometryError) -> MeasuredError {
        match error {
            ViscometryError::RowNotPositive { .. }
            | ViscometryError::RowTwice { .. }
            | ViscometryError::RowNotSorted { .. }
            | ViscometryError::ResponseFalls { .. } => {
                MeasuredError::Table(TableReport::new(self.path.clone(), vec![self.mistake(&error)]))
            }
            _ => MeasuredError::Viscometry(error),
        }
    }
}

/// The sizes of arguments in SI.
fn given_sizes(kind: FlowKind, sizes: &[(String, String)]) -> Result<Vec<(String, f64)>, MeasuredError> {
    let mut given = Vec::new();
    for (name, text) in sizes {
        let accepted = kind.sizes().iter().chain(kind.more_sizes());
        let size = accepted.clone().find(|(other, _)| other == name).and_then(|(_, dimension)| size(text, *dimension));
        let Some(size) = size else {
            let valid = if accepted.clone().any(|(other, _)| other == name) {
                "a length from 1 nm to 1 km, or a positive angle, with its unit, as 2mm or 2deg"
            } else {
                "only the sizes of this flow"
            };
            let argument = format!("--{} {text}", name.replace('_', "-"));
            return Err(MeasuredError::Argument { argument, valid });
        };
        given.push((name.clone(), size));
    }
    if let Some((_, valid)) = mismatch(kind, &given) {
        let argument: Vec<String> = sizes.iter().map(|(name, text)| format!("{name} = {text}")).collect();
        return Err(MeasuredError::Argument { argument: argument.join(", "), valid });
    }
    Ok(given)
}

/// The rows of a sheet, sorted by the drive.
fn rows(sheet: &Sheet, kind: FlowKind, given: &[(String, f64)], sweep: Sweep) -> Result<Measured, Vec<TableMistake>> {
    let mut mistakes = Vec::new();
    let Sources { flow, drive, answers: sources, mut notes } = columns::sources(sheet, kind, given, &mut mistakes);
    if sheet.rows.is_empty() {
        mistakes.push(TableMistake::new(sheet.last, "the table has a header and no rows", "a row for each point"));
    }
    let mut answers: Vec<Answer> =
        sources.iter().map(|(what, _)| Answer { what: *what, is_negative: false, rows: Vec::new() }).collect();
    let mut lines = Vec::new();
    let read = drive.filter(|_| !answers.is_empty());
    for (index, row) in sheet.rows.iter().enumerate() {
        if let Some(mistake) = sheet.incomplete(row) {
            mistakes.push(mistake);
            continue;
        }
        let Some(drive) = read else { continue };
        let mut refuse = |name: &str, found: &str, valid: &str| {
            mistakes.push(TableMistake::new(row.line, format!("{name} is {found}"), valid));
        };
        let set = drive.value(sheet, index);
        match &set {
            Err((name, found)) => refuse(name, found, "a positive number"),
            Ok(x) if *x <= 0.0 => {
                let (name, found) = drive.written(sheet, index);
                refuse(name, &found, "a positive number");
            }
            Ok(_) => {}
        }
        let set = set.unwrap_or(f64::NAN);
        for (answer, (what, source)) in answers.iter_mut().zip(&sources) {
            let found = source.value(sheet, index);
            if answer.rows.is_empty() {
                answer.is_negative = what.is_normal() && found.as_ref().is_ok_and(|x| *x < 0.0);
            }
            let size = found.as_ref().ok().map(|x| x * answer.sign()).filter(|x| 0.0 < *x);
            if size.is_none() {
                let valid = match (what.is_normal(), answer.is_negative) {
                    (true, true) => "a negative number, as in the rows before",
                    (true, false) if !answer.rows.is_empty() => "a positive number, as in the rows before",
                    (true, false) => "a number other than 0",
                    _ => "a positive number",
                };
                let (name, text) = found.err().unwrap_or_else(|| source.written(sheet, index));
                refuse(name, &text, valid);
            }
            answer.rows.push([set, size.unwrap_or(f64::NAN)]);
        }
        lines.push(row.line);
    }
    let Some(flow) = flow.filter(|_| mistakes.is_empty()) else {
        mistakes.sort_by_key(|mistake| mistake.line);
        return Err(mistakes);
    };
    let hysteresis = choose(&mut answers, &mut lines, sweep, &mut notes);
    sort(&mut answers, &mut lines, &mut notes);
    Ok(Measured { path: PathBuf::new(), flow, answers, lines, notes, hysteresis })
}

/// Keeps the rows of the sweeps that are asked for.
fn choose(answers: &mut [Answer], lines: &mut Vec<u64>, sweep: Sweep, notes: &mut Vec<String>) -> Option<Hysteresis> {
    let first = answers.first()?;
    let drives: Vec<f64> = first.rows.iter().map(|row| row[0]).collect();
    let rising = sweeps::directions(&drives)?;
    let hysteresis = sweeps::hysteresis(&first.rows, &rising);
    let percent = |ratio: f64| format!("{:+.1} %", 100.0 * (ratio - 1.0));
    let told = hysteresis.map_or_else(String::new, |h| {
        let (mean, farthest) = (percent(h.mean), percent(h.farthest));
        format!("; falling beside rising: {mean} on average, {farthest} where they differ most")
    });
    let [up, down] = [true, false].map(|way| rising.iter().filter(|rising| **rising == way).count());
    let used = match sweep {
        Sweep::Rising => "the rising ones are used (--sweep falling or all for the others)",
        Sweep::Falling => "the falling ones are used",
        Sweep::All => "all are used, as repeated measurements",
    };
    notes.push(format!("{up} rows of rising and {down} of falling sweeps: {used}{told}"));
    if sweep != Sweep::All {
        let kept: Vec<bool> = rising.iter().map(|way| *way == (sweep == Sweep::Rising)).collect();
        let mut flags = kept.iter();
        lines.retain(|_| flags.next().copied().unwrap_or(true));
        for answer in answers {
            let mut flags = kept.iter();
            answer.rows.retain(|_| flags.next().copied().unwrap_or(true));
        }
    }
    hysteresis
}

/// Sorts by the drive; equal drives keep their order.
fn sort(answers: &mut [Answer], lines: &mut Vec<u64>, notes: &mut Vec<String>) {
    let Some(first) = answers.first() else { return };
    let drives: Vec<f64> = first.rows.iter().map(|row| row[0]).collect();
    if drives.windows(2).all(|pair| pair[0] <= pair[1]) {
        return;
    }
    let mut order: Vec<usize> = (0..drives.len()).collect();
    order.sort_by(|&a, &b| drives[a].total_cmp(&drives[b]));
    let falls = drives.windows(2).all(|pair| pair[1] <= pair[0]);
    notes.push(if falls { "rows fall in the file".to_owned() } else { "rows are sorted by the drive".to_owned() });
    *lines = order.iter().map(|&row| lines[row]).collect();
    for answer in answers {
        answer.rows = order.iter().map(|&row| answer.rows[row]).collect();
    }
}
