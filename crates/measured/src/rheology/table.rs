//! Tables of viscometric measurements.

use core::str::FromStr;
use std::path::{Path, PathBuf};

use csv::{ReaderBuilder, StringRecord, Trim};
use piola_document::units::{Dimension, Quantity, Unit};
use piola_fit::FitError;
use piola_fit::fluids::FlowData;
use piola_viscometry::ViscometryError;
use piola_viscometry::recover::{ConeGeometry, FlowTable};

use crate::MeasuredError;
use crate::fitting::layout::{line_of, read};
use crate::fitting::{TableMistake, TableReport};

/// Pa.
const STRESS: Dimension = Dimension { length: -1, mass: 1, time: -2, angle: 0 };
const RATE: Dimension = Dimension { time: -1, ..Dimension::NONE };
const DISCHARGE: Dimension = Dimension { length: 3, time: -1, ..Dimension::NONE };
const DISCHARGE_PER_WIDTH: Dimension = Dimension { length: 2, time: -1, ..Dimension::NONE };
const PRESSURE_GRADIENT: Dimension = Dimension { length: -2, mass: 1, time: -2, angle: 0 };
const TORQUE: Dimension = Dimension { length: 2, mass: 1, time: -2, angle: 0 };
const FORCE: Dimension = Dimension { length: 1, mass: 1, time: -2, angle: 0 };

/// A column: its name, dimension and SI unit.
type Named = (&'static str, Dimension, &'static str);

const GRADIENT: Named = ("pressure_gradient", PRESSURE_GRADIENT, "Pa/m");
const SPEED: Named = ("angular_velocity", Dimension::ANGULAR_RATE, "rad/s");
const VOLUME: Named = ("discharge", DISCHARGE, "m^3/s");

/// The kind of a measurement: the quantity that was set, and one or more columns of responses.
///
/// | name | set | response | geometry |
/// |---|---|---|---|
/// | `pipe` | `pressure_gradient` (Pa/m) | `discharge` (m³/s) | `radius` |
/// | `capillary` | `discharge` (m³/s) | `pressure_difference` (Pa), ends included | `radius`, `length` |
/// | `channel` | `pressure_gradient` (Pa/m) | `discharge_per_width` (m²/s) | `half_width` |
/// | `couette` | `torque_per_length` (N) | `speed_difference` (rad/s), `radial_stress_difference` (Pa) | `inner_radius`, `outer_radius` |
/// | `plates` | `angular_velocity` (rad/s) | `torque` (N m), `thrust` (N) | `radius`, `gap` |
/// | `cone` | `angular_velocity` (rad/s) | `torque` (N m), `thrust` (N) | `radius`, `angle` |
/// | `curve` | `shear_rate` (1/s) | `shear_stress` (Pa) | |
///
/// `radial_stress_difference` is `T_rr` at the outer cylinder less that at the inner one, what rotation adds made good; `thrust` is what
/// drives the surfaces apart, counted from that at rest. These two may be negative, all of them; everything else is positive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FlowKind {
    /// The discharge of a pipe.
    Pipe,
    /// The pressure that a capillary with its ends takes.
    Capillary,
    /// The discharge of a channel.
    Channel,
    /// The speeds, or radial stresses, of coaxial cylinders.
    Couette,
    /// The torque, or thrust, of parallel plates.
    Plates,
    /// The torque, or thrust, of cone and plate.
    Cone,
    /// A flow curve itself.
    Curve,
}

impl FlowKind {
    const ALL: [Self; 7] =
        [Self::Pipe, Self::Capillary, Self::Channel, Self::Couette, Self::Plates, Self::Cone, Self::Curve];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pipe => "pipe",
            Self::Capillary => "capillary",
            Self::Channel => "channel",
            Self::Couette => "couette",
            Self::Plates => "plates",
            Self::Cone => "cone",
            Self::Curve => "curve",
        }
    }

    /// Its name in a sentence.
    const fn words(self) -> &'static str {
        match self {
            Self::Couette => "coaxial cylinders",
            Self::Plates => "parallel plates",
            Self::Cone => "cone and plate",
            Self::Curve => "flow curve",
            Self::Pipe | Self::Capillary | Self::Channel => self.name(),
        }
    }

    /// The column of the quantity that was set.
    pub(super) const fn drive(self) -> Named {
        match self {
            Self::Pipe | Self::Channel => GRADIENT,
            Self::Capillary => VOLUME,
            Self::Couette => ("torque_per_length", FORCE, "N"),
            Self::Plates | Self::Cone => SPEED,
            Self::Curve => ("shear_rate", RATE, "1/s"),
        }
    }

    /// The columns of possible responses.
    pub(super) const fn answers(self) -> &'static [Answering] {
        match self {
            Self::Pipe => &[Answering::Discharge],
            Self::Capillary => &[Answering::PressureDifference],
            Self::Channel => &[Answering::DischargePerWidth],
            Self::Couette => &[Answering::SpeedDifference, Answering::RadialStressDifference],
            Self::Plates | Self::Cone => &[Answering::Torque, Answering::Thrust],
            Self::Curve => &[Answering::ShearStress],
        }
    }

    /// The lengths and angles of the geometry.
    const fn sizes(self) -> &'static [(&'static str, Dimension)] {
        const RADIUS: (&str, Dimension) = ("radius", Dimension::LENGTH);
        match self {
            Self::Pipe => &[RADIUS],
            Self::Capillary => &[RADIUS, ("length", Dimension::LENGTH)],
            Self::Channel => &[("half_width", Dimension::LENGTH)],
            Self::Couette => &[("inner_radius", Dimension::LENGTH), ("outer_radius", Dimension::LENGTH)],
            Self::Plates => &[RADIUS, ("gap", Dimension::LENGTH)],
            Self::Cone => &[RADIUS, ("angle", Dimension::ANGLE)],
            Self::Curve => &[],
        }
    }
}

/// The measured quantity of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Answering {
    /// Q, m³/s.
    Discharge,
    /// Δp of a capillary with its ends, Pa.
    PressureDifference,
    /// Q of a channel for each width, m²/s.
    DischargePerWidth,
    /// ΔΩ of coaxial cylinders, rad/s.
    SpeedDifference,
    /// `T_rr(R₂) − T_rr(R₁)`, Pa.
    RadialStressDifference,
    /// 𝓜, N m.
    Torque,
    /// 𝓕, N.
    Thrust,
    /// τ, Pa.
    ShearStress,
}

impl Answering {
    /// Its column.
    pub(super) const fn column(self) -> Named {
        match self {
            Self::Discharge => VOLUME,
            Self::PressureDifference => ("pressure_difference", STRESS, "Pa"),
            Self::DischargePerWidth => ("discharge_per_width", DISCHARGE_PER_WIDTH, "m^2/s"),
            Self::SpeedDifference => ("speed_difference", Dimension::ANGULAR_RATE, "rad/s"),
            Self::RadialStressDifference => ("radial_stress_difference", STRESS, "Pa"),
            Self::Torque => ("torque", TORQUE, "N m"),
            Self::Thrust => ("thrust", FORCE, "N"),
            Self::ShearStress => ("shear_stress", STRESS, "Pa"),
        }
    }

    /// Whether it comes of normal stresses and may be negative.
    #[must_use]
    pub const fn is_normal(self) -> bool {
        matches!(self, Self::RadialStressDifference | Self::Thrust)
    }
}

/// A column of measured responses.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Answer {
    /// The measured quantity.
    pub what: Answering,
    /// Whether all of the column is negative.
    pub is_negative: bool,
    /// The drive and the magnitude of the response, in SI units.
    pub rows: Vec<[f64; 2]>,
}

impl Answer {
    /// −1 or 1.
    #[must_use]
    pub const fn sign(&self) -> f64 {
        if self.is_negative { -1.0 } else { 1.0 }
    }
}

impl FromStr for FlowKind {
    type Err = MeasuredError;

    fn from_str(text: &str) -> Result<Self, MeasuredError> {
        Self::ALL.into_iter().find(|kind| kind.name() == text).ok_or_else(|| MeasuredError::Argument {
            argument: text.to_owned(),
            valid: "pipe, capillary, channel, couette, plates, cone or curve",
        })
    }
}

/// A flow with its geometry. Lengths in m, angles in rad.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Flow {
    /// A pipe.
    Pipe {
        /// Its radius.
        radius: f64,
    },
    /// A capillary.
    Capillary {
        /// Its radius.
        radius: f64,
        /// Its length.
        length: f64,
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
    /// Parallel discs.
    Plates {
        /// Their radius.
        radius: f64,
        /// Their distance.
        gap: f64,
    },
    /// A cone on a plate.
    Cone {
        /// Its radius.
        radius: f64,
        /// The angle between cone and plate.
        angle: f64,
    },
    /// A flow curve.
    Curve,
}

impl Flow {
    /// The kind of the flow.
    #[must_use]
    pub const fn kind(self) -> FlowKind {
        match self {
            Self::Pipe { .. } => FlowKind::Pipe,
            Self::Capillary { .. } => FlowKind::Capillary,
            Self::Channel { .. } => FlowKind::Channel,
            Self::Couette { .. } => FlowKind::Couette,
            Self::Plates { .. } => FlowKind::Plates,
            Self::Cone { .. } => FlowKind::Cone,
            Self::Curve => FlowKind::Curve,
        }
    }

    /// Stress and rate at the wall of the Newtonian fluid that would have answered so: where searches start.
    pub(super) fn apparent(self, [drive, response]: [f64; 2]) -> [f64; 2] {
        use core::f64::consts::{PI, TAU};
        match self {
            Self::Pipe { radius } => [0.5 * drive * radius, 4.0 * response / (PI * radius.powi(3))],
            Self::Capillary { radius, length } => {
                [0.5 * response * radius / length, 4.0 * drive / (PI * radius.powi(3))]
            }
            Self::Channel { half_width } => [drive * half_width, 1.5 * response / (half_width * half_width)],
            Self::Couette { inner_radius, outer_radius } => {
                let (ratio, area) = (inner_radius / outer_radius, TAU * inner_radius.powi(2));
                [drive / area, 2.0 * response / (1.0 - ratio * ratio)]
            }
            Self::Plates { radius, gap } => [2.0 * response / (PI * radius.powi(3)), drive * radius / gap],
            Self::Cone { radius, angle } => [1.5 * response / (PI * radius.powi(3)), drive / angle],
            Self::Curve => [response, drive],
        }
    }
}

/// A table of measurements in SI units.
///
/// # Example
/// ```
/// use piola_measured::rheology::{FlowKind, Measured};
/// let text = "# radius: 2 mm\npressure_gradient [kPa/m],discharge [mm^3/s]\n10,125.5\n20,251\n";
/// let measured = Measured::parse("pipe.csv", text, FlowKind::Pipe, &[])?;
/// assert_eq!(measured.rows()[1], [20e3, 251e-9]);
/// let wrong = Measured::parse("pipe.csv", &text.replace("kPa/m", "kg"), FlowKind::Pipe, &[]);
/// assert!(wrong.unwrap_err().to_string().starts_with("pipe.csv:2: "));
/// # Ok::<(), piola_measured::MeasuredError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Measured {
    /// The file.
    pub path: PathBuf,
    /// The flow.
    pub flow: Flow,
    /// The measured columns; at least one.
    pub answers: Vec<Answer>,
    /// The line of each row.
    pub lines: Vec<u64>,
}

impl Measured {
    /// Reads a file. Lengths and angles given as `name`, `value with unit` stand before those of the file's comments.
    ///
    /// # Errors
    /// [`MeasuredError::Unreadable`], [`MeasuredError::TooLarge`], [`MeasuredError::NotText`]; [`MeasuredError::Table`] with every mistake and
    /// its line; [`MeasuredError::Argument`] for a length that cannot be read.
    pub fn load(path: &Path, kind: FlowKind, sizes: &[(String, String)]) -> Result<Self, MeasuredError> {
        Self::parse(path, &read(path)?, kind, sizes)
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
        let path = path.into();
        let mut given = Vec::new();
        for (name, value) in sizes {
            let argument = || MeasuredError::Argument {
                argument: format!("{name} = {value}"),
                valid: "a length or an angle of this flow with its unit, as radius=2mm",
            };
            let known = kind.sizes().iter().find(|(known, _)| known == name);
            let size = known.and_then(|(_, dimension)| size(value, *dimension)).ok_or_else(argument)?;
            given.push((name.clone(), size));
        }
        if let Some((_, valid)) = mismatch(kind, &given) {
            let written: Vec<String> = sizes.iter().map(|(name, value)| format!("{name} = {value}")).collect();
            return Err(MeasuredError::Argument { argument: written.join(", "), valid });
        }
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        parse(text, kind, &given)
            .and_then(|(flow, answers, lines)| {
                let measured = Self { path: path.clone(), flow, answers, lines };
                match measured.check() {
                    Ok(()) => Ok(measured),
                    Err(error) => Err(vec![measured.mistake(&error)]),
                }
            })
            .map_err(|mistakes| MeasuredError::Table(TableReport::new(path, mistakes)))
    }

    /// The name of the file without folder and ending.
    #[must_use]
    pub fn name(&self) -> String {
        self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// "ketchup: 31 rows, coaxial cylinders".
    pub(super) fn heading(&self) -> String {
        format!("{}: {} rows, {}", self.name(), self.rows().len(), self.flow.kind().words())
    }

    /// Drives and responses: of the first column that is not of normal stresses, if there is one.
    #[must_use]
    pub fn rows(&self) -> &[[f64; 2]] {
        self.sheared().or(self.answers.first()).map_or(&[], |answer| &answer.rows)
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
        Ok(match self.flow {
            Flow::Pipe { radius } => FlowData::pipe(&FlowTable::pipe(radius, rows)?),
            Flow::Capillary { radius, length } => {
                let gradients: Vec<_> =
                    rows.iter().map(|[discharge, pressure]| [pressure / length, *discharge]).collect();
                FlowData::pipe(&FlowTable::pipe(radius, &gradients)?)
            }
            Flow::Channel { half_width } => FlowData::channel(&FlowTable::channel(half_width, rows)?),
            Flow::Couette { inner_radius, outer_radius } => {
                FlowData::couette(&FlowTable::couette(inner_radius, outer_radius, rows)?)
            }
            Flow::Plates { radius, gap } => FlowData::parallel_plates(&FlowTable::parallel_plates(radius, gap, rows)?),
            Flow::Cone { radius, angle } => FlowData::cone_and_plate(&FlowTable::cone_and_plate(radius, angle, rows)?),
            Flow::Curve => FlowData::flow_curve(rows)?,
        })
    }

    fn check(&self) -> Result<(), ViscometryError> {
        self.answers.iter().try_for_each(|answer| FlowTable::new((), &answer.rows).map(|_| ()))
    }

    /// An error of viscometry, with the line of its row.
    fn mistake(&self, error: &ViscometryError) -> TableMistake {
        let line = |row: usize| self.lines.get(row).copied().unwrap_or(1);
        let (row, valid) = match error {
            ViscometryError::RowNotPositive { row, .. } => (Some(*row), "positive numbers"),
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

/// Why sizes that are known do not go together: what is wrong, and what would be valid.
fn mismatch<N: AsRef<str>>(kind: FlowKind, sizes: &[(N, f64)]) -> Option<(String, &'static str)> {
    let of = |name: &str| sizes.iter().find(|(other, _)| other.as_ref() == name).map(|(_, value)| *value);
    match kind {
        FlowKind::Couette => {
            let (inner, outer) = (of("inner_radius")?, of("outer_radius")?);
            let what = || format!("inner_radius = {inner} m, outer_radius = {outer} m");
            (outer <= inner).then(|| (what(), "inner_radius < outer_radius"))
        }
        FlowKind::Cone => {
            let refused = ConeGeometry::new(1.0, of("angle")?).err()?;
            Some((refused.to_string(), "an angle below 90 deg"))
        }
        _ => None,
    }
}

/// A positive length, m, or angle, rad.
fn size(text: &str, dimension: Dimension) -> Option<f64> {
    let quantity: Quantity = text.parse().ok()?;
    let value = quantity.to_si().ok()?;
    let fits = quantity.dimension().is_none_or(|found| found == dimension);
    (fits && 0.0 < value).then_some(value)
}

type Read = Result<(Flow, Vec<Answer>, Vec<u64>), Vec<TableMistake>>;

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
    let drive = kind.drive();
    let Some(((line, header), body)) = records.split_first() else {
        let valid = format!("a header `{},{}` and a row for each point", drive.0, kind.answers()[0].column().0);
        mistakes.push(TableMistake::new(last, "the table is empty", valid));
        return Err(mistakes);
    };
    let mut units = vec![unit_of(header, *line, 0, drive, &mut mistakes)];
    let answering = answering(header, *line, kind, &mut mistakes);
    for (column, what) in &answering {
        units.push(unit_of(header, *line, *column, what.column(), &mut mistakes));
    }
    if body.is_empty() {
        mistakes.push(TableMistake::new(last, "the table has a header and no rows", "a row for each point"));
    }
    let mut answers: Vec<Answer> =
        answering.iter().map(|(_, what)| Answer { what: *what, is_negative: false, rows: Vec::new() }).collect();
    let mut lines = Vec::new();
    for (line, fields) in body {
        if fields.len() != header.len() {
            let what = format!("a row of {} fields", fields.len());
            mistakes.push(TableMistake::new(*line, what, format!("{} fields", header.len())));
            continue;
        }
        if answering.len() + 1 != fields.len() {
            continue;
        }
        let number = |column: usize| match fields[column].parse::<f64>() {
            Ok(x) if x.is_finite() => Some(units[column].map_or(x, |unit| unit.to_si(x))),
            _ => None,
        };
        let mut refuse = |column: usize, name: &str, valid: &str| {
            let found = if fields[column].is_empty() { "missing" } else { &fields[column] };
            mistakes.push(TableMistake::new(*line, format!("{name} is {found}"), valid));
        };
        let set = number(0).filter(|x| 0.0 < *x);
        if set.is_none() {
            refuse(0, drive.0, "a positive number");
        }
        for (column, answer) in answers.iter_mut().enumerate() {
            let found = number(column + 1);
            if answer.rows.is_empty() {
                answer.is_negative = answer.what.is_normal() && found.is_some_and(|x| x < 0.0);
            }
            let size = found.map(|x| x * answer.sign()).filter(|x| 0.0 < *x);
            if size.is_none() {
                let valid = match (answer.what.is_normal(), answer.is_negative) {
                    (true, true) => "a negative number, as in the rows before",
                    (true, false) if !answer.rows.is_empty() => "a positive number, as in the rows before",
                    (true, false) => "a number other than 0",
                    _ => "a positive number",
                };
                refuse(column + 1, answer.what.column().0, valid);
            }
            answer.rows.push([set.unwrap_or(f64::NAN), size.unwrap_or(f64::NAN)]);
        }
        lines.push(*line);
    }
    match flow {
        Some(flow) if mistakes.is_empty() => Ok((flow, answers, lines)),
        _ => {
            mistakes.sort_by_key(|mistake| mistake.line);
            Err(mistakes)
        }
    }
}

/// The name in a header's field, and its unit.
fn named(field: &str) -> (&str, Option<&str>) {
    let (name, unit) = field.split_once('[').map_or((field, None), |(name, unit)| (name, Some(unit)));
    (name.trim(), unit)
}

/// The columns after the first with their measured quantities; wrong or repeated names are mistakes.
fn answering(
    header: &StringRecord,
    line: u64,
    kind: FlowKind,
    mistakes: &mut Vec<TableMistake>,
) -> Vec<(usize, Answering)> {
    let names: Vec<String> = kind.answers().iter().map(|what| format!("`{}`", what.column().0)).collect();
    let valid = names.join(" or ");
    let mut found: Vec<(usize, Answering)> = Vec::new();
    if header.len() < 2 {
        let valid = format!("a second column, {valid}");
        mistakes.push(TableMistake::new(line, format!("a header of {} fields", header.len()), valid));
    }
    for (column, field) in header.iter().enumerate().skip(1) {
        let what = kind.answers().iter().find(|what| what.column().0 == named(field).0);
        match what {
            Some(what) if found.iter().all(|(_, other)| other != what) => found.push((column, *what)),
            Some(_) => {
                mistakes.push(TableMistake::new(
                    line,
                    format!("column {} is `{field}` again", column + 1),
                    "each once",
                ));
            }
            None => {
                let what = format!("column {} is `{field}`", column + 1);
                mistakes.push(TableMistake::new(line, what, valid.clone()));
            }
        }
    }
    found
}

/// The unit of a column, if one is named and fits.
fn unit_of(
    header: &StringRecord,
    line: u64,
    column: usize,
    (name, dimension, si): Named,
    mistakes: &mut Vec<TableMistake>,
) -> Option<Unit> {
    let text = header.get(column).unwrap_or_default();
    let (found, unit) = named(text);
    if found != name {
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
    // The line of the last size that a comment states: where sizes do not go together, this one is wrong.
    let mut last = 1;
    for (name, dimension) in kind.sizes() {
        if let Some((_, value)) = given.iter().find(|(other, _)| other == name) {
            found.push((*name, *value));
            continue;
        }
        let in_comment = |(index, line): (usize, &str)| {
            let (key, value) = line.strip_prefix('#')?.split_once(':')?;
            (key.trim() == *name).then(|| (index, value.trim().to_owned()))
        };
        let is_angle = *dimension == Dimension::ANGLE;
        let example = if is_angle { "2 deg" } else { "2 mm" };
        let valid = format!("a comment `# {name}: {example}`, or the argument --{}", name.replace('_', "-"));
        match text.lines().enumerate().find_map(in_comment) {
            None => mistakes.push(TableMistake::new(1, format!("{name} is not given"), valid)),
            Some((index, value)) => {
                last = u64::try_from(index + 1).unwrap_or(u64::MAX);
                if let Some(value) = size(&value, *dimension) {
                    found.push((*name, value));
                } else {
                    let valid = if is_angle { "a positive angle" } else { "a positive length" };
                    mistakes.push(TableMistake::new(last, format!("{name} is `{value}`"), valid));
                }
            }
        }
    }
    if let Some((what, valid)) = mismatch(kind, &found) {
        mistakes.push(TableMistake::new(last, what, valid));
        return None;
    }
    let found: Vec<f64> = found.into_iter().map(|(_, value)| value).collect();
    match (kind, found.as_slice()) {
        (FlowKind::Pipe, [radius]) => Some(Flow::Pipe { radius: *radius }),
        (FlowKind::Capillary, [radius, length]) => Some(Flow::Capillary { radius: *radius, length: *length }),
        (FlowKind::Plates, [radius, gap]) => Some(Flow::Plates { radius: *radius, gap: *gap }),
        (FlowKind::Cone, [radius, angle]) => Some(Flow::Cone { radius: *radius, angle: *angle }),
        (FlowKind::Channel, [half_width]) => Some(Flow::Channel { half_width: *half_width }),
        (FlowKind::Couette, [inner_radius, outer_radius]) => {
            Some(Flow::Couette { inner_radius: *inner_radius, outer_radius: *outer_radius })
        }
        (FlowKind::Curve, _) => Some(Flow::Curve),
        _ => None,
    }
}
