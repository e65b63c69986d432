//! Two corrections of capillaries: Mooney's for slip at the walls, Bagley's for the pressure lost at the ends.
//!
//! ```text
//! Mooney   4Q/(πR³) = Γ(τ) + 4 u(τ)/R      at equal wall stress τ, over 1/R
//! Bagley   Δp = 2 τ(Q) L/R + Δp_ends(Q)    at equal discharge Q, over L/R
//! ```
//! M. Mooney, 1931; E. B. Bagley, 1957.

use core::f64::consts::PI;

use super::Smoothing;
use super::corrected::{Corrected, Found, Law};
use super::geometry::PipeGeometry;
use super::table::{FlowTable, Noise};
use crate::ViscometryError;
use crate::error::check_bound;

/// Slip at a wall stress.
///
/// # Example
/// See [`slip_at_walls`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SlipPoint {
    /// τ at the wall, Pa.
    pub wall_stress: f64,
    /// u, m/s.
    pub slip_velocity: f64,
    /// Its standard error, m/s; none of two pipes.
    pub slip_error: Option<f64>,
    /// 4Q/(πR³) less that of slip, 1/s.
    pub apparent_rate: f64,
    /// k at the wall, 1/s, after Weissenberg, Rabinowitsch and Mooney.
    pub shear_rate: f64,
    /// Where k lies, if a band was asked for.
    pub band: Option<[f64; 2]>,
}

/// Slip recovered from pipes of several radii.
///
/// # Example
/// See [`slip_at_walls`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SlipCorrection {
    /// Slip at the wall stresses of the first table that all tables reach.
    pub points: Vec<SlipPoint>,
    /// The table of the first pipe without slip, smoothed: a band recovered from it would not know the noise of
    /// the tables, which that of [`with_band`](Self::with_band) does.
    pub table: FlowTable<PipeGeometry>,
    #[cfg_attr(feature = "serde", serde(skip))]
    tables: Corrected,
}

impl SlipCorrection {
    /// The same with bands of the shear rates that hold the whole curve at once with this confidence, if the errors of all rows are
    /// independent and normal and the answers lie on Mooney's line.
    ///
    /// # Errors
    /// [`ViscometryError::ConfidenceOutOfRange`] unless 0 < `confidence` < 1.
    pub fn with_band(self, confidence: f64) -> Result<Self, ViscometryError> {
        let tables = self.tables.with_band(confidence)?;
        let point = |point: &SlipPoint| slip_point(&tables, point.wall_stress);
        let points = self.points.iter().map(point).collect::<Result<_, _>>()?;
        Ok(Self { points, tables, ..self })
    }

    /// Slip and shear rate at a wall stress, Pa, between those of the first and the last point.
    ///
    /// # Errors
    /// [`ViscometryError::NotMeasured`] elsewhere; [`ViscometryError::NotRecovered`] where nothing positive is recovered.
    pub fn at(&self, wall_stress: f64) -> Result<SlipPoint, ViscometryError> {
        slip_point(&self.tables, wall_stress)
    }

    /// The smoothing of each table.
    pub fn smoothing(&self) -> impl Iterator<Item = Smoothing> + '_ {
        self.tables.smoothing()
    }
}

fn slip_point(tables: &Corrected, stress: f64) -> Result<SlipPoint, ViscometryError> {
    let Found { wall_stress, shear_rate, band, line: [value, slope], errors } = tables.at(stress)?;
    let slip_error = errors.map(|[_, slope]| 0.25 * slope);
    Ok(SlipPoint { wall_stress, slip_velocity: 0.25 * slope, slip_error, apparent_rate: value, shear_rate, band })
}

/// A capillary with the whole pressure lost in it.
///
/// # Example
/// See [`end_correction`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Capillary {
    length: f64,
    /// Discharges and pressures.
    table: FlowTable<PipeGeometry>,
}

impl Capillary {
    /// Of radius R and length L, m: rows of the discharge Q, m³/s, and the whole difference of pressure Δp, Pa.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] for R and L; as [`FlowTable::new`] for rows, which rise in Q.
    pub fn new(radius: f64, length: f64, rows: &[[f64; 2]]) -> Result<Self, ViscometryError> {
        check_bound("capillary", "length", length, "0 < L", 0.0 < length)?;
        Ok(Self { length, table: FlowTable::pipe(radius, rows)? })
    }

    /// With the noise of Δp.
    ///
    /// # Errors
    /// As [`FlowTable::with_noise`].
    pub fn with_noise(self, noise: Noise) -> Result<Self, ViscometryError> {
        Ok(Self { table: self.table.with_noise(noise)?, ..self })
    }
}

/// The ends at a discharge.
///
/// # Example
/// See [`end_correction`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct EndPoint {
    /// Q, m³/s.
    pub discharge: f64,
    /// τ at the wall far from the ends, Pa.
    pub wall_stress: f64,
    /// The pressure lost at the ends, Pa.
    pub end_pressure: f64,
    /// Its standard error, Pa; none of two capillaries.
    pub end_error: Option<f64>,
    /// That pressure over 2 τ: the length in radii by which the capillary seems too long.
    pub end_length: f64,
    /// k at the wall, 1/s, after Weissenberg, Rabinowitsch and Mooney.
    pub shear_rate: f64,
    /// Where k lies, if a band was asked for.
    pub band: Option<[f64; 2]>,
}

/// End effects recovered from capillaries of several lengths.
///
/// # Example
/// See [`end_correction`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct EndCorrection {
    /// The ends at the discharges of the first capillary that all capillaries reach.
    pub points: Vec<EndPoint>,
    /// Pressure gradients without ends, and discharges, smoothed: a band recovered from it would not know the noise of the tables, which
    /// that of [`with_band`](Self::with_band) does.
    pub table: FlowTable<PipeGeometry>,
    #[cfg_attr(feature = "serde", serde(skip))]
    tables: Corrected,
}

impl EndCorrection {
    /// The same with bands of the shear rates, each at its point's wall stress, that hold the whole curve at once with this confidence,
    /// if the errors of all rows are independent and normal and the pressures lie on Bagley's line.
    ///
    /// # Errors
    /// [`ViscometryError::ConfidenceOutOfRange`] unless 0 < `confidence` < 1.
    pub fn with_band(self, confidence: f64) -> Result<Self, ViscometryError> {
        let tables = self.tables.with_band(confidence)?;
        let points = self.points.iter().map(|point| end_point(&tables, point.discharge)).collect::<Result<_, _>>()?;
        Ok(Self { points, tables, ..self })
    }

    /// Ends and shear rate at a discharge, m³/s, between those of the first and the last point.
    ///
    /// # Errors
    /// [`ViscometryError::NotMeasured`] elsewhere; [`ViscometryError::NotRecovered`] where nothing positive is recovered.
    pub fn at(&self, discharge: f64) -> Result<EndPoint, ViscometryError> {
        end_point(&self.tables, discharge)
    }

    /// The smoothing of each table.
    pub fn smoothing(&self) -> impl Iterator<Item = Smoothing> + '_ {
        self.tables.smoothing()
    }
}

fn end_point(tables: &Corrected, discharge: f64) -> Result<EndPoint, ViscometryError> {
    let Found { wall_stress, shear_rate, band, line: [value, slope], errors } = tables.at(discharge)?;
    let end_error = errors.map(|[value, _]| value);
    let end_length = value / slope;
    Ok(EndPoint { discharge, wall_stress, end_pressure: value, end_error, end_length, shear_rate, band })
}

/// The abscissas of a table that all reach, a table being drives times a scale.
fn common(tables: &[(&FlowTable<PipeGeometry>, f64)]) -> Result<Vec<f64>, ViscometryError> {
    let Some((first, scale)) = tables.first() else {
        return Err(ViscometryError::TooFewTables { tables: 0, least: 2 });
    };
    if tables.len() < 2 {
        return Err(ViscometryError::TooFewTables { tables: 1, least: 2 });
    }
    let ends = |pick: fn(&[f64]) -> Option<&f64>| {
        tables.iter().map(move |(table, scale)| pick(&table.drive).copied().unwrap_or(f64::NAN) * scale)
    };
    let lowest = ends(<[f64]>::first).fold(0.0, f64::max) * (1.0 - 1e-12);
    let highest = ends(<[f64]>::last).fold(f64::INFINITY, f64::min) * (1.0 + 1e-12);
    let shared: Vec<f64> = first.drive.iter().map(|x| x * scale).filter(|x| lowest <= *x && *x <= highest).collect();
    if shared.is_empty() { Err(ViscometryError::NothingInCommon { lowest, highest }) } else { Ok(shared) }
}

/// Mooney's correction: the slip at the walls of pipes of several radii, and the discharge without it.
///
/// # Errors
/// [`ViscometryError::TooFewTables`], [`ViscometryError::SameGeometry`] where all radii are equal,
/// [`ViscometryError::NothingInCommon`] where no wall stress is reached in all; as [`pipe`](super::pipe);
/// [`ViscometryError::NotRecovered`] where nothing would flow without slip.
///
/// # Accuracy
/// That of the line over 1/R; rounding for exact rows at equal wall stresses.
///
/// # Example
/// A fluid of viscosity 1 that slips by u = τ/10: 4Q/(πR³) = τ + 4 u/R.
/// ```
/// use core::f64::consts::PI;
/// use piola_viscometry::recover::{FlowTable, slip_at_walls};
/// let pipe = |radius: f64| {
///     let discharge = |stress: f64| 0.25 * PI * radius.powi(3) * (stress + 0.4 * stress / radius);
///     let rows: Vec<_> = (1..9).map(f64::from).map(|stress| [2.0 * stress / radius, discharge(stress)]).collect();
///     FlowTable::pipe(radius, &rows)
/// };
/// let slip = slip_at_walls(&[pipe(1.0)?, pipe(2.0)?, pipe(4.0)?])?;
/// assert!((slip.points[3].slip_velocity - 0.4).abs() < 1e-12); // at τ = 4
/// # Ok::<(), piola_viscometry::ViscometryError>(())
/// ```
///
/// # Source
/// M. Mooney, *Explicit formulas for slip and fluidity*, 1931.
pub fn slip_at_walls(tables: &[FlowTable<PipeGeometry>]) -> Result<SlipCorrection, ViscometryError> {
    let scaled: Vec<_> = tables.iter().map(|table| (table, 0.5 * table.geometry.radius)).collect();
    let stresses = common(&scaled)?;
    let reference = tables[0].geometry.radius;
    if tables.iter().all(|table| (table.geometry.radius / reference - 1.0).abs() < 1e-9) {
        return Err(ViscometryError::SameGeometry { quantity: "radius", value: reference });
    }
    let members: Vec<_> = tables
        .iter()
        .map(|table| {
            let radius = table.geometry.radius;
            (table, 0.5 * radius, 4.0 / (PI * radius * radius * radius), radius.recip())
        })
        .collect();
    let tables = Corrected::new(Law::Slip, &members, &stresses)?;
    let points: Vec<SlipPoint> =
        stresses.iter().map(|stress| slip_point(&tables, *stress)).collect::<Result<_, _>>()?;
    let row = |point: &SlipPoint| {
        [2.0 * point.wall_stress / reference, 0.25 * PI * point.apparent_rate * reference * reference * reference]
    };
    let rows: Vec<_> = points.iter().map(row).collect();
    Ok(SlipCorrection { points, table: FlowTable::pipe(reference, &rows)?, tables })
}

/// Bagley's correction: the pressure lost at the ends of capillaries of several lengths, and the gradient without it.
///
/// # Errors
/// [`ViscometryError::TooFewTables`], [`ViscometryError::SameGeometry`] where all lengths are equal,
/// [`ViscometryError::DifferentGeometry`] where radii differ,
/// [`ViscometryError::NothingInCommon`] where no discharge is reached in all; as [`pipe`](super::pipe);
/// [`ViscometryError::NotRecovered`] where a longer capillary loses no more pressure.
///
/// # Accuracy
/// That of the line over L/R; rounding for exact rows at equal discharges.
///
/// # Example
/// Δp = 2 τ L/R + 3 τ with τ = Q.
/// ```
/// use piola_viscometry::recover::{Capillary, end_correction};
/// let capillary = |length: f64| {
///     let rows: Vec<_> = (1..9).map(f64::from).map(|q| [q, 2.0 * q * length + 3.0 * q]).collect();
///     Capillary::new(1.0, length, &rows)
/// };
/// let ends = end_correction(&[capillary(10.0)?, capillary(20.0)?, capillary(40.0)?])?;
/// assert!((ends.points[1].wall_stress - 2.0).abs() < 1e-12 && (ends.points[1].end_length - 1.5).abs() < 1e-11);
/// # Ok::<(), piola_viscometry::ViscometryError>(())
/// ```
///
/// # Source
/// E. B. Bagley, *End corrections in the capillary flow of polyethylene*, 1957.
pub fn end_correction(capillaries: &[Capillary]) -> Result<EndCorrection, ViscometryError> {
    let tables: Vec<_> = capillaries.iter().map(|capillary| (&capillary.table, 1.0)).collect();
    let discharges = common(&tables)?;
    let (radius, length) = (capillaries[0].table.geometry.radius, capillaries[0].length);
    let other = capillaries.iter().find(|other| 1e-9 < (other.table.geometry.radius / radius - 1.0).abs());
    if let Some(other) = other {
        return Err(ViscometryError::DifferentGeometry {
            quantity: "radius",
            values: [radius, other.table.geometry.radius],
        });
    }
    if capillaries.iter().all(|capillary| (capillary.length / length - 1.0).abs() < 1e-9) {
        return Err(ViscometryError::SameGeometry { quantity: "length", value: length });
    }
    let members: Vec<_> =
        capillaries.iter().map(|capillary| (&capillary.table, 1.0, 1.0, capillary.length / radius)).collect();
    let tables = Corrected::new(Law::Ends { radius }, &members, &discharges)?;
    let points: Vec<EndPoint> = discharges.iter().map(|q| end_point(&tables, *q)).collect::<Result<_, _>>()?;
    let rows: Vec<_> = points.iter().map(|point| [2.0 * point.wall_stress / radius, point.discharge]).collect();
    Ok(EndCorrection { points, table: FlowTable::pipe(radius, &rows)?, tables })
}
