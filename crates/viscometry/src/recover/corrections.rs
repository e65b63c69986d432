//! Two corrections of capillaries: Mooney's for slip at the walls, Bagley's for the pressure lost at the ends.
//!
//! ```text
//! Mooney   4Q/(πR³) = Γ(τ) + 4 u(τ)/R      at equal wall stress τ, over 1/R
//! Bagley   Δp = 2 τ(Q) L/R + Δp_ends(Q)    at equal discharge Q, over L/R
//! ```
//! M. Mooney, 1931; E. B. Bagley, 1957.

use core::f64::consts::PI;

use super::geometry::PipeGeometry;
use super::smoothing::{EXACT, Fitted, Smoother, noise};
use super::table::{FlowTable, Noise};
use crate::ViscometryError;
use crate::error::check_bound;

/// Slip at a wall stress.
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
}

/// What pipes of several radii tell of slip.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SlipCorrection {
    /// Slip at the wall stresses of the first table that all tables reach.
    pub points: Vec<SlipPoint>,
    /// What would flow through the pipe of the first table without slip: to be recovered from.
    pub table: FlowTable<PipeGeometry>,
}

/// A capillary with the whole pressure lost in it.
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

    /// The same with what is known of the noise of Δp.
    ///
    /// # Errors
    /// As [`FlowTable::with_noise`].
    pub fn with_noise(self, noise: Noise) -> Result<Self, ViscometryError> {
        Ok(Self { table: self.table.with_noise(noise)?, ..self })
    }
}

/// The ends at a discharge.
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
}

/// What capillaries of several lengths tell of their ends.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct EndCorrection {
    /// The ends at the discharges of the first capillary that all capillaries reach.
    pub points: Vec<EndPoint>,
    /// Pressure gradients without ends and discharges: to be recovered from.
    pub table: FlowTable<PipeGeometry>,
}

/// ln response over ln drive of a table, by the criteria of recovery.
fn smooth(table: &FlowTable<PipeGeometry>) -> Result<Fitted, ViscometryError> {
    table.check_rising(f64::INFINITY)?;
    let u: Vec<f64> = table.drive.iter().map(|x| x.ln()).collect();
    let y: Vec<f64> = table.response.iter().map(|x| x.ln()).collect();
    let (level, known) = match table.noise {
        Noise::Exact => (0.0, None),
        Noise::Relative(level) => (level, Some(level)),
        Noise::Estimated => (noise(&u, &y), None),
    };
    table.check_rising(level)?;
    let singular = || ViscometryError::RowsTooClose { rows: u.len() };
    if level <= EXACT {
        return Fitted::through(&u, &y, 7).ok_or_else(singular);
    }
    let smoother = Smoother::new(&u, &y, 2).ok_or_else(singular)?;
    Ok(smoother.fit(smoother.choose(known), known, false).fitted)
}

/// A line through points by least squares: its value at 0, its slope, and their standard errors beyond two points.
struct Line {
    value: f64,
    slope: f64,
    errors: Option<[f64; 2]>,
}

fn line(points: &[[f64; 2]]) -> Line {
    let count = points.len() as f64;
    let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / count;
    let (x, y) = (mean(0), mean(1));
    let square: f64 = points.iter().map(|point| (point[0] - x).powi(2)).sum();
    let slope = points.iter().map(|point| (point[0] - x) * (point[1] - y)).sum::<f64>() / square;
    let value = y - slope * x;
    let left: f64 = points.iter().map(|point| (point[1] - value - slope * point[0]).powi(2)).sum();
    let errors = (2 < points.len()).then(|| {
        let variance = left / (count - 2.0);
        [(variance * (count.recip() + x * x / square)).sqrt(), (variance / square).sqrt()]
    });
    Line { value, slope, errors }
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
    let curves: Vec<Fitted> = tables.iter().map(smooth).collect::<Result<_, _>>()?;
    let (mut points, mut rows) = (Vec::new(), Vec::new());
    for wall_stress in stresses {
        let at = |(table, curve): (&FlowTable<PipeGeometry>, &Fitted)| {
            let radius = table.geometry.radius;
            let discharge = curve.at((2.0 * wall_stress / radius).ln())[0].exp();
            [radius.recip(), 4.0 * discharge / (PI * radius * radius * radius)]
        };
        let Line { value, slope, errors } = line(&tables.iter().zip(&curves).map(at).collect::<Vec<_>>());
        if value <= 0.0 {
            return Err(ViscometryError::NotRecovered { at: wall_stress });
        }
        let slip_error = errors.map(|[_, slope]| 0.25 * slope);
        points.push(SlipPoint { wall_stress, slip_velocity: 0.25 * slope, slip_error, apparent_rate: value });
        rows.push([2.0 * wall_stress / reference, 0.25 * PI * value * reference * reference * reference]);
    }
    Ok(SlipCorrection { points, table: FlowTable::pipe(reference, &rows)? })
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
    let curves: Vec<Fitted> = capillaries.iter().map(|capillary| smooth(&capillary.table)).collect::<Result<_, _>>()?;
    let (mut points, mut rows) = (Vec::new(), Vec::new());
    for discharge in discharges {
        let at =
            |(capillary, curve): (&Capillary, &Fitted)| [capillary.length / radius, curve.at(discharge.ln())[0].exp()];
        let Line { value, slope, errors } = line(&capillaries.iter().zip(&curves).map(at).collect::<Vec<_>>());
        if slope <= 0.0 {
            return Err(ViscometryError::NotRecovered { at: discharge });
        }
        let (wall_stress, end_error) = (0.5 * slope, errors.map(|[value, _]| value));
        points.push(EndPoint { discharge, wall_stress, end_pressure: value, end_error, end_length: value / slope });
        rows.push([slope / radius, discharge]);
    }
    Ok(EndCorrection { points, table: FlowTable::pipe(radius, &rows)? })
}
