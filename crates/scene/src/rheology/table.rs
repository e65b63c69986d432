//! Tables of viscometric measurements.

use core::str::FromStr;
use std::path::{Path, PathBuf};

use csv::{ReaderBuilder, StringRecord, Trim};
use piola_viscometry::ViscometryError;
use piola_viscometry::fit::FlowData;
use piola_viscometry::recover::FlowTable;

use crate::SceneError;
use crate::fitting::layout::{line_of, read};
use crate::fitting::{TableMistake, TableReport};
use crate::units::{Dimension, Quantity, Unit};

/// Pa.
const STRESS: Dimension = Dimension { length: -1, mass: 1, time: -2, angle: 0 };
const RATE: Dimension = Dimension { time: -1, ..Dimension::NONE };
const DISCHARGE: Dimension = Dimension { length: 3, time: -1, ..Dimension::NONE };
const DISCHARGE_PER_WIDTH: Dimension = Dimension { length: 2, time: -1, ..Dimension::NONE };
const PRESSURE_GRADIENT: Dimension = Dimension { length: -2, mass: 1, time: -2, angle: 0 };
const TORQUE_PER_LENGTH: Dimension = Dimension { length: 1, mass: 1, time: -2, angle: 0 };

/// A column: its name, dimension and SI unit.
type Named = (&'static str, Dimension, &'static str);

/// What was measured.
///
/// | name | columns | geometry |
/// |---|---|---|
/// | `pipe` | `pressure_gradient` (Pa/m), `discharge` (m³/s) | `radius` |
/// | `channel` | `pressure_gradient` (Pa/m), `discharge_per_width` (m²/s) | `half_width` |
/// | `couette` | `torque_per_length` (N), `speed_difference` (rad/s) | `inner_radius`, `outer_radius` |
/// | `curve` | `shear_rate` (1/s), `shear_stress` (Pa) | |
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FlowKind {
    /// The discharge of a pipe.
    Pipe,
    /// The discharge of a channel.
    Channel,
    /// The speeds of coaxial cylinders.
    Couette,
    /// A flow curve itself.
    Curve,
}

impl FlowKind {
    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pipe => "pipe",
            Self::Channel => "channel",
            Self::Couette => "couette",
            Self::Curve => "curve",
        }
    }

    /// The columns.
    pub(super) const fn columns(self) -> [Named; 2] {
        match self {
            Self::Pipe => [("pressure_gradient", PRESSURE_GRADIENT, "Pa/m"), ("discharge", DISCHARGE, "m^3/s")],
            Self::Channel => [
                ("pressure_gradient", PRESSURE_GRADIENT, "Pa/m"),
                ("discharge_per_width", DISCHARGE_PER_WIDTH, "m^2/s"),
            ],
            Self::Couette => {
                [("torque_per_length", TORQUE_PER_LENGTH, "N"), ("speed_difference", Dimension::ANGULAR_RATE, "rad/s")]
            }
            Self::Curve => [("shear_rate", RATE, "1/s"), ("shear_stress", STRESS, "Pa")],
        }
    }

    /// The lengths of the geometry.
    const fn lengths(self) -> &'static [&'static str] {
        match self {
            Self::Pipe => &["radius"],
            Self::Channel => &["half_width"],
            Self::Couette => &["inner_radius", "outer_radius"],
            Self::Curve => &[],
        }
    }
}

impl FromStr for FlowKind {
    type Err = SceneError;

    fn from_str(text: &str) -> Result<Self, SceneError> {
        [Self::Pipe, Self::Channel, Self::Couette, Self::Curve]
            .into_iter()
            .find(|kind| kind.name() == text)
            .ok_or_else(|| SceneError::Argument { argument: text.to_owned(), valid: "pipe, channel, couette or curve" })
    }
}

/// What was measured, and where. Lengths in m.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Flow {
    /// A pipe.
    Pipe {
        /// Its radius.
        radius: f64,
    },
    /// A channel.
    Channel {
        /// Half its width.
        half_width: f64,
    },
    /// Coaxial cylinders.
    Couette {
        /// The radius of the inner one.
        inner_radius: f64,
        /// The radius of the outer one.
        outer_radius: f64,
    },
    /// A flow curve.
    Curve,
}

impl Flow {
    /// What it is.
    #[must_use]
    pub const fn kind(self) -> FlowKind {
        match self {
            Self::Pipe { .. } => FlowKind::Pipe,
            Self::Channel { .. } => FlowKind::Channel,
            Self::Couette { .. } => FlowKind::Couette,
            Self::Curve => FlowKind::Curve,
        }
    }

    /// Stress and rate at the wall of the Newtonian fluid that would have answered so: where searches start.
    pub(super) fn apparent(self, [drive, response]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Pipe { radius } => [0.5 * drive * radius, 4.0 * response / (core::f64::consts::PI * radius.powi(3))],
            Self::Channel { half_width } => [drive * half_width, 1.5 * response / (half_width * half_width)],
            Self::Couette { inner_radius, outer_radius } => {
                let (ratio, area) = (inner_radius / outer_radius, core::f64::consts::TAU * inner_radius.powi(2));
                [drive / area, 2.0 * response / (1.0 - ratio * ratio)]
            }
            Self::Curve => [response, drive],
        }
    }
}

/// A table of measurements in SI units.
///
/// # Example
/// ```
/// use piola_scene::rheology::{FlowKind, Measured};
/// let text = "# radius: 2 mm\npressure_gradient [kPa/m],discharge [mm^3/s]\n10,125.5\n20,251\n";
/// let measured = Measured::parse("pipe.csv", text, FlowKind::Pipe, &[])?;
/// assert_eq!(measured.rows[1], [20e3, 251e-9]);
/// let wrong = Measured::parse("pipe.csv", &text.replace("kPa/m", "kg"), FlowKind::Pipe, &[]);
/// assert!(wrong.unwrap_err().to_string().starts_with("pipe.csv:2: "));
/// # Ok::<(), piola_scene::SceneError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Measured {
    /// The file.
    pub path: PathBuf,
    /// What was measured.
    pub flow: Flow,
    /// What drives the flow and what answers, or shear rates and stresses.
    pub rows: Vec<[f64; 2]>,
    /// The line of each row.
    pub lines: Vec<u64>,
}

impl Measured {
    /// Reads a file. Lengths given as `name`, `value with unit` stand before those of the file's comments.
    ///
    /// # Errors
    /// [`SceneError::Unreadable`], [`SceneError::TooLarge`], [`SceneError::NotText`]; [`SceneError::Table`] with every mistake and
    /// its line; [`SceneError::Argument`] for a length that cannot be read.
    pub fn load(path: &Path, kind: FlowKind, lengths: &[(String, String)]) -> Result<Self, SceneError> {
        Self::parse(path, &read(path)?, kind, lengths)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`SceneError::Table`], [`SceneError::Argument`].
    pub fn parse(
        path: impl Into<PathBuf>,
        text: &str,
        kind: FlowKind,
        lengths: &[(String, String)],
    ) -> Result<Self, SceneError> {
        let path = path.into();
        let mut given = Vec::new();
        for (name, value) in lengths {
            let argument = || SceneError::Argument {
                argument: format!("{name} = {value}"),
                valid: "a length of this flow with its unit, as radius=2mm",
            };
            let length = length(value).filter(|_| kind.lengths().contains(&name.as_str())).ok_or_else(argument)?;
            given.push((name.clone(), length));
        }
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        parse(text, kind, &given)
            .and_then(|(flow, rows, lines)| {
                let measured = Self { path: path.clone(), flow, rows, lines };
                match measured.check() {
                    Ok(()) => Ok(measured),
                    Err(error) => Err(vec![measured.mistake(&error)]),
                }
            })
            .map_err(|mistakes| SceneError::Table(TableReport::new(path, mistakes)))
    }

    /// The name of the file without folder and ending.
    #[must_use]
    pub fn name(&self) -> String {
        self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// The names of the columns with their SI units.
    pub(super) fn columns(&self) -> [String; 2] {
        self.flow.kind().columns().map(|(name, _, unit)| format!("{name} [{unit}]"))
    }

    /// The table as data of a fit.
    pub(super) fn data(&self) -> Result<FlowData, ViscometryError> {
        Ok(match self.flow {
            Flow::Pipe { radius } => FlowData::pipe(&FlowTable::pipe(radius, &self.rows)?),
            Flow::Channel { half_width } => FlowData::channel(&FlowTable::channel(half_width, &self.rows)?),
            Flow::Couette { inner_radius, outer_radius } => {
                FlowData::couette(&FlowTable::couette(inner_radius, outer_radius, &self.rows)?)
            }
            Flow::Curve => FlowData::flow_curve(&self.rows)?,
        })
    }

    fn check(&self) -> Result<(), ViscometryError> {
        self.data().map(|_| ())
    }

    /// What viscometry refuses, with the line of the row.
    fn mistake(&self, error: &ViscometryError) -> TableMistake {
        let line = |row: usize| self.lines.get(row).copied().unwrap_or(1);
        let (row, valid) = match error {
            ViscometryError::Row { row, .. } => (Some(*row), "positive numbers"),
            ViscometryError::RowTwice { row, .. } => (Some(*row), "each value of the first column once"),
            ViscometryError::RowNotSorted { row, .. } => (Some(*row), "rows that rise in the first column"),
            ViscometryError::ResponseFalls { row, .. } => (Some(*row), "a second column that rises with the first"),
            _ => (None, "a table of this flow"),
        };
        let text = error.to_string();
        // The error counts rows from 0; the line says it to a reader.
        let what = text.split_once(": ").filter(|_| row.is_some()).map_or(text.as_str(), |(_, what)| what);
        TableMistake::new(row.map_or_else(|| line(0), line), what, valid)
    }

    /// An error of viscometry, with the line where it has one.
    pub(super) fn refused(&self, error: ViscometryError) -> SceneError {
        match error {
            ViscometryError::Row { .. }
            | ViscometryError::RowTwice { .. }
            | ViscometryError::RowNotSorted { .. }
            | ViscometryError::ResponseFalls { .. } => {
                SceneError::Table(TableReport::new(self.path.clone(), vec![self.mistake(&error)]))
            }
            _ => SceneError::Viscometry(error),
        }
    }
}

/// A positive length, m.
fn length(text: &str) -> Option<f64> {
    let quantity: Quantity = text.parse().ok()?;
    let value = quantity.to_si().ok()?;
    let is_length = quantity.dimension().is_none_or(|dimension| dimension == Dimension::LENGTH);
    (is_length && 0.0 < value).then_some(value)
}

type Read = Result<(Flow, Vec<[f64; 2]>, Vec<u64>), Vec<TableMistake>>;

fn parse(text: &str, kind: FlowKind, given: &[(String, f64)]) -> Read {
    let mut mistakes = Vec::new();
    let flow = geometry(text, kind, given, &mut mistakes);
    let mut reader = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(Trim::All)
        .from_reader(text.as_bytes());
    let mut records = Vec::new();
    for record in reader.records() {
        match record {
            Ok(fields) => records.push((fields.position().map_or(0, |at| line_of(text, at)), fields)),
            Err(error) => {
                let line = error.position().map_or(1, csv::Position::line);
                mistakes.push(TableMistake::new(line, error.to_string(), "comma-separated values"));
                return Err(mistakes);
            }
        }
    }
    let last = u64::try_from(text.lines().count()).unwrap_or(u64::MAX).max(1);
    let [first, second] = kind.columns();
    let Some(((line, header), body)) = records.split_first() else {
        let valid = format!("a header `{},{}` and a row for each point", first.0, second.0);
        mistakes.push(TableMistake::new(last, "the table is empty", valid));
        return Err(mistakes);
    };
    let units = [units_of(header, *line, 0, first, &mut mistakes), units_of(header, *line, 1, second, &mut mistakes)];
    if header.len() != 2 && mistakes.is_empty() {
        let valid = format!("two columns, `{}` and `{}`", first.0, second.0);
        mistakes.push(TableMistake::new(*line, format!("a header of {} fields", header.len()), valid));
    }
    if body.is_empty() {
        mistakes.push(TableMistake::new(last, "the table has a header and no rows", "a row for each point"));
    }
    let (mut rows, mut lines) = (Vec::new(), Vec::new());
    for (line, fields) in body {
        if fields.len() != 2 {
            mistakes.push(TableMistake::new(*line, format!("a row of {} fields", fields.len()), "2 fields"));
            continue;
        }
        let mut number = |column: usize, (name, ..): Named| match fields[column].parse::<f64>() {
            Ok(x) if x.is_finite() && 0.0 < x => units[column].map_or(x, |unit| unit.to_si(x)),
            _ => {
                let found = if fields[column].is_empty() { "missing" } else { &fields[column] };
                mistakes.push(TableMistake::new(*line, format!("{name} is {found}"), "a positive number"));
                f64::NAN
            }
        };
        rows.push([number(0, first), number(1, second)]);
        lines.push(*line);
    }
    match flow {
        Some(flow) if mistakes.is_empty() => Ok((flow, rows, lines)),
        _ => {
            mistakes.sort_by_key(|mistake| mistake.line);
            Err(mistakes)
        }
    }
}

/// The unit of a column, if one is named and fits.
fn units_of(
    header: &StringRecord,
    line: u64,
    column: usize,
    (name, dimension, si): Named,
    mistakes: &mut Vec<TableMistake>,
) -> Option<Unit> {
    let text = header.get(column).unwrap_or_default();
    let (found, unit) = text.split_once('[').map_or((text, None), |(name, unit)| (name, Some(unit)));
    if found.trim() != name {
        let valid = format!("`{name}` or `{name} [{si}]`");
        mistakes.push(TableMistake::new(line, format!("column {} is `{text}`", column + 1), valid));
        return None;
    }
    let unit = unit?.trim_end().trim_end_matches(']').trim();
    match unit.parse::<Unit>() {
        Ok(unit) if unit.dimension == dimension => Some(unit),
        Ok(_) => {
            let valid = format!("a unit such as {si}");
            mistakes.push(TableMistake::new(line, format!("`{unit}` is no unit of {name}"), valid));
            None
        }
        Err(error) => {
            mistakes.push(TableMistake::new(line, error.to_string(), format!("a unit such as {si}")));
            None
        }
    }
}

/// The geometry from what is given and from comments such as `# radius: 2 mm`.
fn geometry(text: &str, kind: FlowKind, given: &[(String, f64)], mistakes: &mut Vec<TableMistake>) -> Option<Flow> {
    let mut found = Vec::new();
    for name in kind.lengths() {
        if let Some((_, value)) = given.iter().find(|(other, _)| other == name) {
            found.push(*value);
            continue;
        }
        let in_comment = |(index, line): (usize, &str)| {
            let (key, value) = line.strip_prefix('#')?.split_once(':')?;
            (key.trim() == *name).then(|| (index, value.trim().to_owned()))
        };
        let valid = format!("a comment `# {name}: 2 mm`, or the argument --{}", name.replace('_', "-"));
        match text.lines().enumerate().find_map(in_comment) {
            None => mistakes.push(TableMistake::new(1, format!("{name} is not given"), valid)),
            Some((index, value)) => {
                if let Some(value) = length(&value) {
                    found.push(value);
                } else {
                    let line = u64::try_from(index + 1).unwrap_or(u64::MAX);
                    mistakes.push(TableMistake::new(line, format!("{name} is `{value}`"), "a positive length"));
                }
            }
        }
    }
    match (kind, found.as_slice()) {
        (FlowKind::Pipe, [radius]) => Some(Flow::Pipe { radius: *radius }),
        (FlowKind::Channel, [half_width]) => Some(Flow::Channel { half_width: *half_width }),
        (FlowKind::Couette, [inner_radius, outer_radius]) if inner_radius < outer_radius => {
            Some(Flow::Couette { inner_radius: *inner_radius, outer_radius: *outer_radius })
        }
        (FlowKind::Couette, [inner_radius, outer_radius]) => {
            let what = format!("inner_radius = {inner_radius} m, outer_radius = {outer_radius} m");
            mistakes.push(TableMistake::new(1, what, "inner_radius < outer_radius"));
            None
        }
        (FlowKind::Curve, _) => Some(Flow::Curve),
        _ => None,
    }
}
