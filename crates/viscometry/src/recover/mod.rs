//! Fluids back from their flows: shear rates, normal stresses and viscosities from discharges, torques and speeds.
//!
//! | what was measured | as a function ([`functions`]) | as a table ([`FlowTable`]) |
//! |---|---|---|
//! | discharge of a pipe | [`functions::pipe`] | [`pipe`] |
//! | discharge of a channel | [`functions::channel`] | [`channel`] |
//! | speeds of coaxial cylinders | [`functions::couette`] | [`couette`] |
//! | their normal stresses | [`functions::normal_stress_data`], [`functions::couette`] | [`normal_stress`]; of a fluid with density, [`normal_stress_with_inertia`] |
//! | torque of parallel plates | [`functions::parallel_plates`] | [`parallel_plates`] |
//! | thrust of parallel plates | [`functions::parallel_plates_thrust`] | [`parallel_plates_thrust`] |
//! | torque of cone and plate | [`cone_and_plate`], row by row | [`cone_and_plate_torque`] |
//! | thrust of cone and plate | [`cone_and_plate`], row by row | [`cone_and_plate_thrust`] |
//! | pipes of several radii | | [`slip_at_walls`] (Mooney) |
//! | capillaries of several lengths | | [`end_correction`] (Bagley) |
//!
//! A table needs a derivative, which noise spoils: its logarithms are smoothed by a stated criterion ([`Smoothing`]), and the curve that
//! comes out has a band. Exact rows are interpolated by splines of degree 7; their bands hold the differences to other degrees and to
//! curves without one of the rows. Noisy rows are smoothed along the curve, by penalised splines of the logarithm of its slope; their bands hold the whole
//! curve at once with the stated confidence.
//!
//! # Example
//! A Newtonian fluid of viscosity 2 in a pipe of radius 1, Q = π c/16.
//! ```
//! use piola_viscometry::recover::{self, FlowTable};
//! let rows: Vec<_> = (1..=12).map(f64::from).map(|c| [c, core::f64::consts::PI * c / 16.0]).collect();
//! let table = FlowTable::pipe(1.0, &rows)?;
//! let curve = recover::pipe(&table)?.with_band(0.95)?; // Weissenberg–Rabinowitsch–Mooney
//! let point = curve.at(3.0)?;
//! assert!((point.shear_rate - 1.5).abs() < 1e-12);
//! let [low, high] = point.band.expect("asked for");
//! assert!(low < 1.5 && 1.5 < high && high - low < 1e-10);
//! # Ok::<(), piola_viscometry::ViscometryError>(())
//! ```

mod band;
mod banded;
mod corrected;
mod corrections;
mod curve;
pub mod functions;
mod geometry;
mod inertia;
mod log_slope;
mod plain;
mod repeats;
mod rotational;
mod rule;
mod series;
mod smoother;
mod smoothing;
mod splines;
mod table;
mod yielding;

pub use corrections::{Capillary, EndCorrection, EndPoint, SlipCorrection, SlipPoint, end_correction, slip_at_walls};
pub use curve::{BelowSmallest, Monotonicity, Options, Rise};
pub use functions::{Approximation, FlowPoint, MeasuredCurve, RatePoint, Series};
pub use geometry::{ChannelGeometry, ConeGeometry, CouetteGeometry, PipeGeometry, PlatesGeometry};
pub use inertia::{NormalStressRecovery, RadialStressRow, normal_stress_with_inertia};
pub use repeats::{mean, repeats};
pub use rotational::{ConePoint, cone_and_plate};
pub use smoothing::{Criterion, Smoothing};
pub use table::{FlowTable, Noise};

use crate::ViscometryError;
use curve::Recovered;
use rule::{Below, Rule};
use series::Order;

/// A recovered point with its band.
///
/// # Example
/// See [`pipe`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FlowCurvePoint {
    /// τ, Pa.
    pub shear_stress: f64,
    /// k, 1/s.
    pub shear_rate: f64,
    /// Where k lies, if a band was asked for.
    pub band: Option<[f64; 2]>,
}

/// A recovered point over the shear rate with its band.
///
/// # Example
/// See [`parallel_plates`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StressCurvePoint {
    /// k, 1/s.
    pub shear_rate: f64,
    /// τ, N₁ or N₁ − N₂, Pa.
    pub stress: f64,
    /// Where the stress lies, if a band was asked for.
    pub band: Option<[f64; 2]>,
}

/// A recovered normal stress difference with its band.
///
/// # Example
/// See [`normal_stress`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NormalStressPoint {
    /// τ, Pa.
    pub shear_stress: f64,
    /// N₁ = σ₂ − σ₁, Pa.
    pub first_normal_stress_difference: f64,
    /// Where N₁ lies, if a band was asked for.
    pub band: Option<[f64; 2]>,
}

macro_rules! recovered_curve {
    ($(#[$documentation:meta])* $name:ident, $point:ident, $at:ident, $value:ident, $unit:literal) => {
        $(#[$documentation])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name {
            recovered: Recovered,
        }

        impl $name {
            /// With a band that holds the true curve at once everywhere between the first and the last row with this
            /// confidence, if the rows' errors are independent and normal; for exact rows it bounds the error of interpolation.
            ///
            /// # Errors
            /// [`ViscometryError::ConfidenceOutOfRange`] unless 0 < `confidence` < 1.
            pub fn with_band(self, confidence: f64) -> Result<Self, ViscometryError> {
                Ok(Self { recovered: self.recovered.with_band(confidence)? })
            }

            #[doc = concat!("The point at an abscissa, ", $unit, ", between the first and the last row. Allocates nothing.")]
            ///
            /// # Errors
            /// [`ViscometryError::NotMeasured`] elsewhere; [`ViscometryError::NotRecovered`] where noise makes the value negative.
            pub fn at(&self, $at: f64) -> Result<$point, ViscometryError> {
                let ($value, band) = self.recovered.at($at)?;
                Ok($point { $at, $value, band })
            }

            /// The points of the rows.
            pub fn points(&self) -> impl Iterator<Item = Result<$point, ViscometryError>> + '_ {
                self.recovered.abscissas().map(|abscissa| self.at(abscissa))
            }

            /// Response over smoothed response − 1, of each row.
            #[must_use]
            pub fn residuals(&self) -> &[f64] {
                &self.recovered.residuals
            }

            /// The smoothing of the table.
            #[must_use]
            pub const fn smoothing(&self) -> Smoothing {
                self.recovered.smoothing
            }

            /// The assumption below the smallest drive.
            #[must_use]
            pub const fn below_smallest(&self) -> BelowSmallest {
                self.recovered.below
            }

            /// Whether the curve rises.
            #[must_use]
            pub const fn monotonicity(&self) -> Monotonicity {
                self.recovered.monotonicity
            }

            /// The confidence of the band, if there is one.
            #[must_use]
            pub fn confidence(&self) -> Option<f64> {
                self.recovered.confidence()
            }
        }
    };
}

recovered_curve! {
    /// Shear rates over shear stresses, with what they were recovered by.
    ///
    /// # Accuracy
    /// Of exact rows: rounding for power laws; for smooth fluids with 25 rows over a factor of 40 in the stress 10⁻⁸ to 10⁻⁶ inside and 10⁻⁵ at the
    /// ends. Of noisy rows: the band.
    ///
    /// # Example
    /// See the [module](self).
    FlowCurve, FlowCurvePoint, shear_stress, shear_rate, "Pa"
}

recovered_curve! {
    /// Stresses over shear rates, with what they were recovered by.
    ///
    /// # Accuracy
    /// As [`FlowCurve`].
    ///
    /// # Example
    /// See [`parallel_plates`].
    StressCurve, StressCurvePoint, shear_rate, stress, "1/s"
}

recovered_curve! {
    /// First normal stress differences over shear stresses, with what they were recovered by.
    ///
    /// # Accuracy
    /// As [`FlowCurve`].
    ///
    /// # Example
    /// See [`normal_stress`].
    NormalStressCurve, NormalStressPoint, shear_stress, first_normal_stress_difference, "Pa"
}

impl FlowCurve {
    /// τ/k, Pa s, at a shear stress, Pa.
    ///
    /// # Errors
    /// As [`FlowCurve::at`].
    pub fn viscosity(&self, shear_stress: f64) -> Result<f64, ViscometryError> {
        Ok(shear_stress / self.at(shear_stress)?.shear_rate)
    }
}

/// The flow curve of a pipe's table, after Weissenberg, Rabinowitsch and Mooney.
///
/// ```text
/// k = Q (3 + d ln Q/d ln c)/(π R³)      τ = ½ c R
/// ```
///
/// # Errors
/// [`ViscometryError::TooFewRows`], [`ViscometryError::ResponseFalls`], [`ViscometryError::RowsTooClose`],
/// [`ViscometryError::NotRecovered`].
///
/// # Example
/// See the [module](self).
///
/// # Source
/// W(23.64).
pub fn pipe(table: &FlowTable<PipeGeometry>) -> Result<FlowCurve, ViscometryError> {
    pipe_with(table, Options::default())
}

/// As [`pipe`], with options.
///
/// # Errors
/// As [`pipe`].
pub fn pipe_with(table: &FlowTable<PipeGeometry>, options: Options) -> Result<FlowCurve, ViscometryError> {
    let radius = table.geometry.radius;
    let logarithm = -(core::f64::consts::PI * radius * radius * radius).ln();
    let rule = Rule::Local { multiple: 3.0, logarithm };
    Ok(FlowCurve { recovered: Recovered::new(table, rule, 0.5 * radius, options)? })
}

/// The flow curve of a channel's table.
///
/// ```text
/// k = Q (2 + d ln Q/d ln c)/(2 d²)      τ = c d
/// ```
///
/// # Errors
/// As [`pipe`].
///
/// # Example
/// See the [module](self).
///
/// # Source
/// W(23.44).
pub fn channel(table: &FlowTable<ChannelGeometry>) -> Result<FlowCurve, ViscometryError> {
    channel_with(table, Options::default())
}

/// As [`channel`], with options.
///
/// # Errors
/// As [`pipe`].
pub fn channel_with(table: &FlowTable<ChannelGeometry>, options: Options) -> Result<FlowCurve, ViscometryError> {
    let half_width = table.geometry.half_width;
    let rule = Rule::Local { multiple: 2.0, logarithm: -(2.0 * half_width * half_width).ln() };
    Ok(FlowCurve { recovered: Recovered::new(table, rule, half_width, options)? })
}

/// The flow curve of a table of coaxial cylinders, by the series W(23.82).
///
/// The series is summed down to the smallest torque and below it at once from ΔΩ and its derivatives
/// there: what this takes to hold is [`FlowCurve::below_smallest`].
///
/// # Errors
/// As [`pipe`].
///
/// # Accuracy
/// That of [`FlowCurve`] where (R₂/R₁)² is small beside the range of the torques. In wider gaps it is what the rows below the stress
/// of interest allow: ΔΩ is an integral of ζ over δ = 2 ln(R₂/R₁) of ln T, and no table tells ζ from ζ and a wave of the period δ. Waves
/// are taken to be none, which holds the more surely the smaller ζ is at the smallest torque. For R₁/R₂ = 0.5 and rows over a factor
/// of e³ the median error is up to 10⁻⁴, whatever their number; rows that reach lower by e⁴ make it less than 10⁻⁶.
///
/// # Example
/// ζ = T with T = M/(2πR²): ΔΩ = (M/4π)(1 − 1/4) for R₁ = 1, R₂ = 2.
/// ```
/// use piola_viscometry::recover::{self, BelowSmallest, FlowTable};
/// let factor = 0.75 / (4.0 * core::f64::consts::PI);
/// let rows: Vec<_> = (1..=12).map(f64::from).map(|torque| [torque, factor * torque]).collect();
/// let curve = recover::couette(&FlowTable::couette(1.0, 2.0, &rows)?)?;
/// assert!((curve.at(1.0)?.shear_rate - 1.0).abs() < 1e-12);
/// assert_eq!(curve.below_smallest(), BelowSmallest::Newtonian);
/// # Ok::<(), piola_viscometry::ViscometryError>(())
/// ```
///
/// # Source
/// W(23.80)–W(23.82).
pub fn couette(table: &FlowTable<CouetteGeometry>) -> Result<FlowCurve, ViscometryError> {
    couette_with(table, Options::default())
}

/// As [`couette`], with options.
///
/// # Errors
/// As [`pipe`].
pub fn couette_with(table: &FlowTable<CouetteGeometry>, options: Options) -> Result<FlowCurve, ViscometryError> {
    let rule = Rule::Series { step: table.geometry.step(), order: Order::Full, below: Below::Powers };
    Ok(FlowCurve { recovered: Recovered::new(table, rule, table.geometry.stress_per_torque(), options)? })
}

/// N₁ = σ₂ − σ₁ over the shear stress at the inner of coaxial cylinders, by the series W(23.92): from a table of torques for each
/// length, N, and positive differences `T_rr(R₂) − T_rr(R₁)` with the centrifugal part made good
/// ([`functions::normal_stress_data`]), Pa. [`normal_stress_with_inertia`] makes it good itself, from the flow curve that it recovers.
///
/// # Errors
/// As [`pipe`].
///
/// # Example
/// N₁ = 4 T² with T = M/(2πR²): the difference is ½ ∫ N₁ ds/s = T₁² − T₂², for R₁ = 1, R₂ = 2.
/// ```
/// use core::f64::consts::TAU;
/// use piola_viscometry::recover::{self, FlowTable};
/// let difference = |stress: f64| stress * stress * (1.0 - 1.0 / 16.0);
/// let rows: Vec<_> = (1..=12).map(f64::from).map(|stress| [TAU * stress, difference(stress)]).collect();
/// let curve = recover::normal_stress(&FlowTable::couette(1.0, 2.0, &rows)?)?;
/// assert!((curve.at(3.0)?.first_normal_stress_difference - 36.0).abs() < 1e-9);
/// # Ok::<(), piola_viscometry::ViscometryError>(())
/// ```
///
/// # Source
/// W(23.88)–W(23.92).
pub fn normal_stress(table: &FlowTable<CouetteGeometry>) -> Result<NormalStressCurve, ViscometryError> {
    normal_stress_with(table, Options::default())
}

/// As [`normal_stress`], with options.
///
/// # Errors
/// As [`pipe`].
pub fn normal_stress_with(
    table: &FlowTable<CouetteGeometry>,
    options: Options,
) -> Result<NormalStressCurve, ViscometryError> {
    let rule = Rule::Series { step: table.geometry.step(), order: Order::Full, below: Below::Powers };
    let recovered = Recovered::without_yield(table, rule, table.geometry.stress_per_torque(), options)?;
    Ok(NormalStressCurve { recovered })
}

/// The shear stress over the shear rate at the rim of parallel plates, from a table of torques.
///
/// ```text
/// τ = (𝓜/(2πR³)) (3 + d ln 𝓜/d ln Ω)      k = Ω R/h
/// ```
///
/// # Errors
/// As [`pipe`].
///
/// # Example
/// τ = 2 k² between plates of radius and gap 1: 𝓜 = 2π·2 Ω²/5.
/// ```
/// use piola_viscometry::recover::{self, FlowTable};
/// let factor = 0.8 * core::f64::consts::PI;
/// let rows: Vec<_> = (1..=12).map(f64::from).map(|speed| [speed, factor * speed * speed]).collect();
/// let curve = recover::parallel_plates(&FlowTable::parallel_plates(1.0, 1.0, &rows)?)?;
/// assert!((curve.at(3.0)?.stress - 18.0).abs() < 1e-10);
/// # Ok::<(), piola_viscometry::ViscometryError>(())
/// ```
///
/// # Source
/// The analogue of W(23.64); see [`functions::parallel_plates`].
pub fn parallel_plates(table: &FlowTable<PlatesGeometry>) -> Result<StressCurve, ViscometryError> {
    parallel_plates_with(table, Options::default())
}

/// As [`parallel_plates`], with options.
///
/// # Errors
/// As [`pipe`].
pub fn parallel_plates_with(
    table: &FlowTable<PlatesGeometry>,
    options: Options,
) -> Result<StressCurve, ViscometryError> {
    let PlatesGeometry { radius, gap } = table.geometry;
    let logarithm = -(core::f64::consts::TAU * radius * radius * radius).ln();
    let rule = Rule::Local { multiple: 3.0, logarithm };
    Ok(StressCurve { recovered: Recovered::new(table, rule, radius / gap, options)? })
}

/// N₁ − N₂ over the shear rate at the rim of parallel plates, from a table of thrusts.
///
/// ```text
/// N₁ − N₂ = (𝓕/(πR²)) (2 + d ln 𝓕/d ln Ω)      k = Ω R/h
/// ```
///
/// # Errors
/// As [`pipe`].
///
/// # Example
/// See [`parallel_plates`].
///
/// # Source
/// See [`functions::parallel_plates_thrust`].
pub fn parallel_plates_thrust(table: &FlowTable<PlatesGeometry>) -> Result<StressCurve, ViscometryError> {
    parallel_plates_thrust_with(table, Options::default())
}

/// As [`parallel_plates_thrust`], with options.
///
/// # Errors
/// As [`pipe`].
pub fn parallel_plates_thrust_with(
    table: &FlowTable<PlatesGeometry>,
    options: Options,
) -> Result<StressCurve, ViscometryError> {
    let PlatesGeometry { radius, gap } = table.geometry;
    let rule = Rule::Local { multiple: 2.0, logarithm: -(core::f64::consts::PI * radius * radius).ln() };
    Ok(StressCurve { recovered: Recovered::new(table, rule, radius / gap, options)? })
}

/// The shear stress over the shear rate from a table of torques of a cone on a plate. Nothing is differentiated: the band is that of the
/// smoothed torques.
///
/// ```text
/// τ = 3 𝓜/(2πR³)      k = Ω/α
/// ```
///
/// # Errors
/// As [`pipe`].
///
/// # Accuracy
/// That of [`StressCurve`]; of the model, α².
///
/// # Example
/// See [`parallel_plates`].
///
/// # Source
/// See [`cone_and_plate`].
pub fn cone_and_plate_torque(table: &FlowTable<ConeGeometry>) -> Result<StressCurve, ViscometryError> {
    cone_and_plate_torque_with(table, Options::default())
}

/// As [`cone_and_plate_torque`], with options.
///
/// # Errors
/// As [`pipe`].
pub fn cone_and_plate_torque_with(
    table: &FlowTable<ConeGeometry>,
    options: Options,
) -> Result<StressCurve, ViscometryError> {
    let ConeGeometry { radius, angle } = table.geometry;
    let rule = Rule::Plain { logarithm: (1.5 / (core::f64::consts::PI * radius * radius * radius)).ln() };
    Ok(StressCurve { recovered: Recovered::new(table, rule, angle.recip(), options)? })
}

/// N₁ over the shear rate from a table of thrusts of a cone on a plate. Nothing is differentiated: the band is that of the smoothed
/// thrusts.
///
/// ```text
/// N₁ = 2 𝓕/(πR²)      k = Ω/α
/// ```
///
/// # Errors
/// As [`pipe`].
///
/// # Accuracy
/// That of [`StressCurve`]; of the model, α².
///
/// # Example
/// See [`parallel_plates`].
///
/// # Source
/// See [`cone_and_plate`].
pub fn cone_and_plate_thrust(table: &FlowTable<ConeGeometry>) -> Result<StressCurve, ViscometryError> {
    cone_and_plate_thrust_with(table, Options::default())
}

/// As [`cone_and_plate_thrust`], with options.
///
/// # Errors
/// As [`pipe`].
pub fn cone_and_plate_thrust_with(
    table: &FlowTable<ConeGeometry>,
    options: Options,
) -> Result<StressCurve, ViscometryError> {
    let ConeGeometry { radius, angle } = table.geometry;
    let rule = Rule::Plain { logarithm: (2.0 / (core::f64::consts::PI * radius * radius)).ln() };
    Ok(StressCurve { recovered: Recovered::new(table, rule, angle.recip(), options)? })
}
