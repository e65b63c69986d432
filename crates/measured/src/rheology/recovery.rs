//! Flow curves and normal stresses out of discharges, speeds, torques and thrusts.

use piola_viscometry::ViscometryError;
use piola_viscometry::recover::{
    self, BelowSmallest, Capillary, EndCorrection, FlowCurve, FlowTable, Monotonicity, Noise, NormalStressCurve,
    Options, PipeGeometry, Rise, SlipCorrection, Smoothing, StressCurve,
};

use super::{Answer, Answering, Flow, Measured};
use crate::MeasuredError;

/// Points of a curve between the first and the last row.
const POINTS: u32 = 160;

/// How to recover.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct RecoveryRequest {
    /// The probability that the band holds the whole curve.
    pub confidence: f64,
    /// The noise of the measurements.
    pub noise: Noise,
    /// The treatment of a curve that does not rise.
    pub rise: Rise,
}

impl Default for RecoveryRequest {
    fn default() -> Self {
        Self { confidence: 0.95, noise: Noise::Estimated, rise: Rise::Reported }
    }
}

/// The quantities of a recovered curve: ordinate over abscissa.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Function {
    /// k over τ: the flow curve of discharges and speeds.
    ShearRate,
    /// τ over k: the flow curve of torques.
    ShearStress,
    /// N₁ over k: of the thrust of cone and plate.
    FirstNormalStress,
    /// N₁ − N₂ over k: of the thrust of parallel plates.
    NormalStressesOfPlates,
    /// N₁ over τ: of the radial stresses of coaxial cylinders.
    FirstNormalStressOverStress,
}

impl Function {
    /// The names of abscissa and value, each with its unit.
    pub(super) const fn axes(self) -> [(&'static str, &'static str); 2] {
        const STRESS: (&str, &str) = ("shear_stress", "Pa");
        const RATE: (&str, &str) = ("shear_rate", "1/s");
        const FIRST: (&str, &str) = ("first_normal_stress_difference", "Pa");
        match self {
            Self::ShearRate => [STRESS, RATE],
            Self::ShearStress => [RATE, STRESS],
            Self::FirstNormalStress => [RATE, FIRST],
            Self::NormalStressesOfPlates => [RATE, ("first_less_second_normal_stress_difference", "Pa")],
            Self::FirstNormalStressOverStress => [STRESS, FIRST],
        }
    }

    /// Whether it is a flow curve.
    #[must_use]
    pub const fn is_flow_curve(self) -> bool {
        matches!(self, Self::ShearRate | Self::ShearStress)
    }

    /// The name of its files and of its place in the summary.
    pub(super) const fn name(self) -> &'static str {
        if self.is_flow_curve() { "flow-curve" } else { "normal-stress" }
    }

    /// τ/k at a point.
    pub(super) fn viscosity(self, point: &Point) -> f64 {
        if self == Self::ShearRate { point.at / point.value } else { point.value / point.at }
    }
}

/// A point of a recovered curve.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Point {
    /// The abscissa, Pa or 1/s.
    pub at: f64,
    /// The recovered value.
    pub value: f64,
    /// Where it lies.
    pub band: Option<[f64; 2]>,
}

/// A recovered curve with what it was recovered by.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct RecoveredCurve {
    /// Its ordinate and abscissa.
    pub function: Function,
    /// The column it was recovered from; none if it comes from several tables.
    pub answering: Option<Answering>,
    /// Its points at the rows.
    pub rows: Vec<Point>,
    /// Its points, closely.
    pub points: Vec<Point>,
    /// Response over smoothed response − 1, of each row of the column.
    pub residuals: Vec<f64>,
    /// How each table was smoothed.
    pub smoothing: Vec<Smoothing>,
    /// The assumption below the smallest drive.
    pub below_smallest: BelowSmallest,
    /// Whether the curve rises.
    pub monotonicity: Monotonicity,
    /// The lines of the table between which it falls, if it does and one table tells it.
    pub falls_between_lines: Option<[u64; 2]>,
    /// The probability that the band holds all of it.
    pub confidence: f64,
    /// Rows at which nothing is recovered: nothing positive, or nothing that the rows tell.
    pub lost: usize,
    /// Why the first of these is lost.
    pub why_lost: Option<ViscometryError>,
}

/// The largest factor by which a band may reach on each side of a value that counts as determined.
const WIDEST: f64 = 10.0;

impl Point {
    /// Whether its band reaches by no more than a factor of ten on each side.
    #[must_use]
    pub fn is_determined(&self) -> bool {
        self.band.is_none_or(|[low, high]| {
            let (low, high) = (low / self.value, high / self.value);
            1.0 / WIDEST <= low.min(high) && low.max(high) <= WIDEST
        })
    }
}

/// A correction of capillaries.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Correction {
    /// Mooney's, for slip at the walls.
    Slip(SlipCorrection),
    /// Bagley's, for the pressure lost at the ends.
    Ends(EndCorrection),
}

/// Curves recovered from one table or several.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Recovery {
    /// One curve for each answering column.
    pub curves: Vec<RecoveredCurve>,
    /// The correction of several tables.
    pub correction: Option<Correction>,
}

/// A curve of any type of viscometry's, with its band.
struct Banded<'c> {
    /// Its points at the rows of the table.
    points: Vec<Result<Point, ViscometryError>>,
    at: &'c dyn Fn(f64) -> Result<Point, ViscometryError>,
    residuals: &'c [f64],
    smoothing: Smoothing,
    below_smallest: BelowSmallest,
    monotonicity: Monotonicity,
}

impl Banded<'_> {
    fn recovered(
        self,
        function: Function,
        measured: &Measured,
        answer: &Answer,
        request: &RecoveryRequest,
    ) -> Result<RecoveredCurve, ViscometryError> {
        let sign = answer.sign();
        let band = |band: [f64; 2]| if sign < 0.0 { [-band[1], -band[0]] } else { band };
        let signed = |point: Point| Point { value: sign * point.value, band: point.band.map(band), ..point };
        let found = self.points.iter().zip(&measured.lines);
        let (lines, rows): (Vec<u64>, Vec<Point>) =
            found.filter_map(|(point, line)| Some((*line, signed(*point.as_ref().ok()?)))).unzip();
        let Some((low, high)) = rows.first().zip(rows.last()).map(|(first, last)| (first.at, last.at)) else {
            let why = self.points.into_iter().find_map(Result::err);
            return Err(why.unwrap_or(ViscometryError::TooFewRows { rows: 0, least: 1 }));
        };
        let points = closely(low, high).filter_map(|at| (self.at)(at).ok()).map(signed).collect();
        Ok(RecoveredCurve {
            function,
            answering: Some(answer.what),
            lost: answer.rows.len() - rows.len(),
            why_lost: self.points.iter().find_map(|point| point.as_ref().err().cloned()),
            falls_between_lines: falling_lines(self.monotonicity, &rows, &lines),
            rows,
            points,
            residuals: self.residuals.to_vec(),
            smoothing: vec![self.smoothing],
            below_smallest: self.below_smallest,
            monotonicity: self.monotonicity,
            confidence: request.confidence,
        })
    }
}

/// Runs a function on a curve whose points have fields of these names.
macro_rules! banded {
    ($curve:expr, $abscissa:ident, $value:ident, $request:expr, $then:expr) => {{
        let curve = $curve.with_band($request.confidence)?;
        let points = curve.points().map(|p| p.map(|p| Point { at: p.$abscissa, value: p.$value, band: p.band }));
        $then(Banded {
            points: points.collect(),
            at: &|at| curve.at(at).map(|p| Point { at, value: p.$value, band: p.band }),
            residuals: curve.residuals(),
            smoothing: curve.smoothing(),
            below_smallest: curve.below_smallest(),
            monotonicity: curve.monotonicity(),
        })
    }};
}

/// The assumption below the smallest torque of coaxial cylinders, in words.
pub(super) fn assumption(below: BelowSmallest) -> Option<String> {
    let speed = "the speed difference is";
    match below {
        BelowSmallest::Yield => Some(
            "the fluid seems to yield: the shear rate rises from none, and the band holds every curve that does"
                .to_owned(),
        ),
        BelowSmallest::Newtonian => Some(format!("{speed} proportional to the torque")),
        BelowSmallest::PowerLaw { exponent } => {
            Some(format!("{speed} proportional to the power {exponent:.4} of the torque"))
        }
        BelowSmallest::Powers { mean, variance } => Some(format!(
            "{speed} a sum of powers of the torque, with exponents of mean {mean:.4} and variance {variance:.4}"
        )),
        _ => None,
    }
}

/// The lines of the rows around the stretch on which a curve falls.
fn falling_lines(monotonicity: Monotonicity, rows: &[Point], lines: &[u64]) -> Option<[u64; 2]> {
    let Monotonicity::Falling { from, to } = monotonicity else { return None };
    let before = rows.iter().rposition(|row| row.at <= from).unwrap_or(0);
    let after = rows.iter().position(|row| to <= row.at).unwrap_or(rows.len().saturating_sub(1));
    Some([*lines.get(before)?, *lines.get(after)?])
}

/// Abscissas from `low` to `high`, evenly in the logarithm.
fn closely(low: f64, high: f64) -> impl Iterator<Item = f64> {
    (0..=POINTS).map(move |k| (low * (high / low).powf(f64::from(k) / f64::from(POINTS))).clamp(low, high))
}

/// Recovers a curve from each measured column of a table.
///
/// | flow | column | curve |
/// |---|---|---|
/// | pipe, channel, couette | discharge or speed | k over τ |
/// | couette | radial stress | N₁ over τ |
/// | plates, cone | torque | τ over k |
/// | plates | thrust | N₁ − N₂ over k |
/// | cone | thrust | N₁ over k |
///
/// # Errors
/// [`MeasuredError::Table`] with the line of a row, [`MeasuredError::Viscometry`], [`MeasuredError::Argument`] for a table that is a flow curve
/// already or that of a capillary, for which [`recover_without_ends`] is.
///
/// # Example
/// ```
/// use piola_measured::rheology::{FlowKind, Measured, RecoveryRequest, recover};
/// let mut text = String::from("# radius: 1 m\npressure_gradient,discharge\n");
/// for c in 1..=12 {
///     text += &format!("{c},{}\n", core::f64::consts::PI * f64::from(c) / 16.0); // a Newtonian fluid of viscosity 2
/// }
/// let measured = Measured::parse("pipe.csv", &text, FlowKind::Pipe, &[])?;
/// let recovery = recover(&measured, &RecoveryRequest::default())?;
/// let point = recovery.curves[0].rows[5]; // τ = c/2 and k = τ/2
/// assert!((point.at - 3.0).abs() < 1e-14 && (point.value - 1.5).abs() < 1e-10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn recover(measured: &Measured, request: &RecoveryRequest) -> Result<Recovery, MeasuredError> {
    let kind = measured.flow.kind().name();
    match measured.flow {
        Flow::Curve => {
            let valid = "pipe, channel, couette, plates, cone, or capillary with several tables";
            return Err(MeasuredError::Argument { argument: format!("--flow {kind}"), valid });
        }
        Flow::Capillary { .. } => {
            return recover_without_ends(core::slice::from_ref(measured), request);
        }
        _ => {}
    }
    let merged = measured.merged();
    let curve = |answer| curve_of(&merged, answer, request).map_err(|error| merged.refused(error));
    Ok(Recovery { curves: merged.answers.iter().map(curve).collect::<Result<_, _>>()?, correction: None })
}

/// The curve of a column.
fn curve_of(
    measured: &Measured,
    answer: &Answer,
    request: &RecoveryRequest,
) -> Result<RecoveredCurve, ViscometryError> {
    let options = Options { rise: request.rise, ..Options::default() };
    let (rows, noise) = (&answer.rows, request.noise);
    let of = |function: Function| move |curve: Banded<'_>| curve.recovered(function, measured, answer, request);
    let flow_curve = |curve: FlowCurve| banded!(curve, shear_stress, shear_rate, request, of(Function::ShearRate));
    let stress = |curve: StressCurve, function| banded!(curve, shear_rate, stress, request, of(function));
    match (measured.flow, answer.what) {
        (Flow::Channel { half_width }, _) => {
            let table = FlowTable::channel(half_width, rows)?.with_noise(noise)?;
            flow_curve(recover::channel_with(&table, options)?)
        }
        (Flow::Couette { inner_radius, outer_radius }, Answering::RadialStressDifference) => {
            let table = FlowTable::couette(inner_radius, outer_radius, rows)?.with_noise(noise)?;
            let curve: NormalStressCurve = recover::normal_stress_with(&table, options)?;
            let function = Function::FirstNormalStressOverStress;
            banded!(curve, shear_stress, first_normal_stress_difference, request, of(function))
        }
        (Flow::Couette { inner_radius, outer_radius }, _) => {
            let table = FlowTable::couette(inner_radius, outer_radius, rows)?.with_noise(noise)?;
            flow_curve(recover::couette_with(&table, options)?)
        }
        (Flow::Plates { radius, gap }, what) => {
            let table = FlowTable::parallel_plates(radius, gap, rows)?.with_noise(noise)?;
            if what == Answering::Thrust {
                stress(recover::parallel_plates_thrust_with(&table, options)?, Function::NormalStressesOfPlates)
            } else {
                stress(recover::parallel_plates_with(&table, options)?, Function::ShearStress)
            }
        }
        (Flow::Cone { radius, angle }, what) => {
            let table = FlowTable::cone_and_plate(radius, angle, rows)?.with_noise(noise)?;
            if what == Answering::Thrust {
                stress(recover::cone_and_plate_thrust_with(&table, options)?, Function::FirstNormalStress)
            } else {
                stress(recover::cone_and_plate_torque_with(&table, options)?, Function::ShearStress)
            }
        }
        (Flow::Pipe { radius } | Flow::Capillary { radius, .. }, _) => {
            let table = FlowTable::pipe(radius, rows)?.with_noise(noise)?;
            flow_curve(recover::pipe_with(&table, options)?)
        }
        (Flow::Curve, _) => {
            // Its columns are the other way round; there is nothing to recover.
            Err(ViscometryError::TooFewTables { tables: 0, least: 1 })
        }
    }
}

/// Mooney's correction: the flow curve without slip, and the slip, of pipes of several radii.
///
/// # Errors
/// [`MeasuredError::Argument`] for tables of other flows; [`MeasuredError::Table`] with the line of a row, [`MeasuredError::Viscometry`].
///
/// # Example
/// A fluid of viscosity 1 that slips by u = τ/10: 4Q/(πR³) = τ + 4 u/R.
/// ```
/// use piola_measured::rheology::{Correction, FlowKind, Measured, RecoveryRequest, recover_without_slip};
/// let pipe = |radius: f64| {
///     let mut text = format!("# radius: {radius} m\npressure_gradient,discharge\n");
///     for stress in (1..9).map(f64::from) {
///         let discharge = 0.25 * core::f64::consts::PI * radius.powi(3) * (stress + 0.4 * stress / radius);
///         text += &format!("{},{discharge}\n", 2.0 * stress / radius);
///     }
///     Measured::parse("pipe.csv", &text, FlowKind::Pipe, &[])
/// };
/// let recovery = recover_without_slip(&[pipe(1.0)?, pipe(2.0)?, pipe(4.0)?], &RecoveryRequest::default())?;
/// let Some(Correction::Slip(slip)) = recovery.correction else { unreachable!() };
/// assert!((slip.points[3].slip_velocity - 0.4).abs() < 1e-10); // at τ = 4
/// assert!((recovery.curves[0].rows[3].value - 4.0).abs() < 1e-9);
/// # Ok::<(), piola_measured::MeasuredError>(())
/// ```
pub fn recover_without_slip(tables: &[Measured], request: &RecoveryRequest) -> Result<Recovery, MeasuredError> {
    let table = |measured: &Measured| -> Result<FlowTable<PipeGeometry>, MeasuredError> {
        let Flow::Pipe { radius } = measured.flow else {
            let argument = format!("--slip with --flow {}", measured.flow.kind().name());
            return Err(MeasuredError::Argument { argument, valid: "--flow pipe" });
        };
        let merged = measured.merged();
        let table = FlowTable::pipe(radius, merged.rows()).and_then(|table| table.with_noise(request.noise));
        table.map_err(|error| measured.refused(error))
    };
    let pipes: Vec<_> = tables.iter().map(table).collect::<Result<_, _>>()?;
    let slip = recover::slip_at_walls(&pipes)
        .and_then(|slip| slip.with_band(request.confidence))
        .map_err(|error| of_several(error, tables))?;
    let rows: Vec<Point> =
        slip.points.iter().map(|p| Point { at: p.wall_stress, value: p.shear_rate, band: p.band }).collect();
    let ends = rows.first().zip(rows.last()).map(|(first, last)| (first.at, last.at));
    let between = ends.into_iter().flat_map(|(low, high)| closely(low, high)).filter_map(|at| slip.at(at).ok());
    let points = between.map(|p| Point { at: p.wall_stress, value: p.shear_rate, band: p.band }).collect();
    let curve = of_line(rows, points, slip.smoothing().collect(), request);
    Ok(Recovery { curves: vec![curve], correction: Some(Correction::Slip(slip)) })
}

/// Bagley's correction: the flow curve without the pressure lost at the ends, and that pressure, of capillaries of one radius and several
/// lengths.
///
/// # Errors
/// [`MeasuredError::Argument`] for tables of other flows; [`MeasuredError::Table`] with the line of a row, [`MeasuredError::Viscometry`].
///
/// # Example
/// Δp = 2 τ L/R + 3 τ with 4Q/(πR³) = τ, a Newtonian fluid of viscosity 1.
/// ```
/// use piola_measured::rheology::{Correction, FlowKind, Measured, RecoveryRequest, recover_without_ends};
/// let capillary = |length: f64| {
///     let mut text = format!("# radius: 1 m\n# length: {length} m\ndischarge,pressure_difference\n");
///     for stress in (1..9).map(f64::from) {
///         text += &format!("{},{}\n", 0.25 * core::f64::consts::PI * stress, stress * (2.0 * length + 3.0));
///     }
///     Measured::parse("capillary.csv", &text, FlowKind::Capillary, &[])
/// };
/// let recovery = recover_without_ends(&[capillary(10.0)?, capillary(20.0)?], &RecoveryRequest::default())?;
/// let Some(Correction::Ends(ends)) = recovery.correction else { unreachable!() };
/// assert!((ends.points[3].end_length - 1.5).abs() < 1e-10);
/// assert!((recovery.curves[0].rows[3].value - 4.0).abs() < 1e-9);
/// # Ok::<(), piola_measured::MeasuredError>(())
/// ```
pub fn recover_without_ends(tables: &[Measured], request: &RecoveryRequest) -> Result<Recovery, MeasuredError> {
    let table = |measured: &Measured| -> Result<Capillary, MeasuredError> {
        let Flow::Capillary { radius, length } = measured.flow else {
            let argument = format!("--flow {}", measured.flow.kind().name());
            return Err(MeasuredError::Argument { argument, valid: "--flow capillary" });
        };
        let merged = measured.merged();
        let table = Capillary::new(radius, length, merged.rows()).and_then(|table| table.with_noise(request.noise));
        table.map_err(|error| measured.refused(error))
    };
    let capillaries: Vec<_> = tables.iter().map(table).collect::<Result<_, _>>()?;
    let ends = recover::end_correction(&capillaries)
        .and_then(|ends| ends.with_band(request.confidence))
        .map_err(|error| of_several(error, tables))?;
    let rows: Vec<Point> =
        ends.points.iter().map(|p| Point { at: p.wall_stress, value: p.shear_rate, band: p.band }).collect();
    let reach = ends.points.first().zip(ends.points.last()).map(|(first, last)| (first.discharge, last.discharge));
    let between = reach.into_iter().flat_map(|(low, high)| closely(low, high)).filter_map(|q| ends.at(q).ok());
    let points = between.map(|p| Point { at: p.wall_stress, value: p.shear_rate, band: p.band }).collect();
    let curve = of_line(rows, points, ends.smoothing().collect(), request);
    Ok(Recovery { curves: vec![curve], correction: Some(Correction::Ends(ends)) })
}

/// The error of several tables, with the line of the row in the one table where that row is wrong.
fn of_several(error: ViscometryError, tables: &[Measured]) -> MeasuredError {
    let ViscometryError::ResponseFalls { row, value, .. } = error else { return MeasuredError::Viscometry(error) };
    let wrong =
        |measured: &&Measured| measured.rows().get(row).is_some_and(|[_, found]| found.total_cmp(&value).is_eq());
    match tables.iter().find(wrong) {
        Some(measured) => measured.refused(error),
        None => MeasuredError::Viscometry(error),
    }
}

/// A flow curve that several tables tell.
fn of_line(
    rows: Vec<Point>,
    points: Vec<Point>,
    smoothing: Vec<Smoothing>,
    request: &RecoveryRequest,
) -> RecoveredCurve {
    let falling = points.windows(2).find(|pair| pair[1].value < pair[0].value);
    let monotonicity =
        falling.map_or(Monotonicity::Rising, |pair| Monotonicity::Falling { from: pair[0].at, to: pair[1].at });
    RecoveredCurve {
        function: Function::ShearRate,
        answering: None,
        rows,
        points,
        residuals: Vec::new(),
        smoothing,
        below_smallest: BelowSmallest::NotNeeded,
        monotonicity,
        falls_between_lines: None,
        confidence: request.confidence,
        lost: 0,
        why_lost: None,
    }
}
