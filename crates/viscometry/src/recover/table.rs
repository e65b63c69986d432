//! Tables of measurements, checked row by row.

use super::geometry::{ChannelGeometry, ConeGeometry, CouetteGeometry, PipeGeometry, PlatesGeometry};
use super::smoothing;
use crate::ViscometryError;
use crate::error::check_bound;

/// Noise of the responses of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Noise {
    /// To be found from the table: by differences of high order, and by the smoothing.
    #[default]
    Estimated,
    /// To all digits: the curve goes through every row.
    Exact,
    /// Of this standard deviation, relative to the response.
    Relative(f64),
}

/// Measurements in one geometry: rows of a drive and a response.
///
/// | table | first column | second column |
/// |---|---|---|
/// | [`pipe`](FlowTable::pipe) | pressure gradient c, Pa/m | discharge Q, m³/s |
/// | [`channel`](FlowTable::channel) | pressure gradient c, Pa/m | discharge for each width, m²/s |
/// | [`couette`](FlowTable::couette) | torque for each length M, N | difference of angular velocity ΔΩ, rad/s |
/// | [`parallel_plates`](FlowTable::parallel_plates) | angular velocity Ω, rad/s | torque, N m; or thrust, N |
/// | [`cone_and_plate`](FlowTable::cone_and_plate) | angular velocity Ω, rad/s | torque, N m; or thrust, N |
///
/// Rows rise in the first column, and every number is positive and finite.
///
/// # Example
/// ```
/// use piola_viscometry::ViscometryError;
/// use piola_viscometry::recover::FlowTable;
/// let table = FlowTable::pipe(0.001, &[[1e4, 2e-9], [2e4, 4e-9], [4e4, 8e-9]])?;
/// assert_eq!(table.rows().count(), 3);
/// let twice = FlowTable::pipe(0.001, &[[1e4, 2e-9], [1e4, 4e-9]]);
/// assert_eq!(twice, Err(ViscometryError::RowTwice { row: 1, value: 1e4 }));
/// # Ok::<(), ViscometryError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "Written<G>",
        into = "Written<G>",
        bound(serialize = "G: Clone + serde::Serialize", deserialize = "G: serde::Deserialize<'de>")
    )
)]
pub struct FlowTable<G> {
    pub(super) geometry: G,
    pub(super) drive: Vec<f64>,
    pub(super) response: Vec<f64>,
    pub(super) noise: Noise,
}

/// Fewest rows that can be recovered from.
pub(super) const FEWEST: usize = 5;

impl<G> FlowTable<G> {
    /// Of a geometry.
    ///
    /// # Errors
    /// [`ViscometryError::RowNotPositive`] for a number that is missing (not a number), infinite, zero or negative,
    /// [`ViscometryError::RowTwice`], [`ViscometryError::RowNotSorted`]; each with its row, from 0.
    pub fn new(geometry: G, rows: &[[f64; 2]]) -> Result<Self, ViscometryError> {
        for (row, &[drive, response]) in rows.iter().enumerate() {
            for (column, value) in [drive, response].into_iter().enumerate() {
                if !(0.0 < value && value.is_finite()) {
                    return Err(ViscometryError::RowNotPositive { row, column, value });
                }
            }
            let previous = if 0 < row { rows[row - 1][0] } else { 0.0 };
            if drive < previous {
                return Err(ViscometryError::RowNotSorted { row, value: drive, previous });
            }
            if drive <= previous {
                return Err(ViscometryError::RowTwice { row, value: drive });
            }
        }
        let (drive, response) = rows.iter().map(|&[drive, response]| (drive, response)).unzip();
        Ok(Self { geometry, drive, response, noise: Noise::Estimated })
    }

    /// With its noise.
    ///
    /// # Errors
    /// [`ViscometryError::OutOfBounds`] unless it is finite and not negative.
    pub fn with_noise(self, noise: Noise) -> Result<Self, ViscometryError> {
        if let Noise::Relative(level) = noise {
            check_bound("table", "relative noise", level, "0 <= noise", 0.0 <= level)?;
        }
        Ok(Self { noise, ..self })
    }

    /// Its rows.
    pub fn rows(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.drive.iter().zip(&self.response).map(|(drive, response)| [*drive, *response])
    }

    /// The geometry.
    #[must_use]
    pub const fn geometry(&self) -> &G {
        &self.geometry
    }

    /// The noise.
    #[must_use]
    pub const fn noise(&self) -> Noise {
        self.noise
    }

    /// Refuses responses that fall, or do not rise, by more than noise explains: below any response to a smaller drive, by five
    /// standard deviations of a difference,
    ///
    /// ```text
    /// ln(max Qⱼ/Qᵢ, j < i) ≥ max(5 √2, 1 + 2 √(2 ln n)) σ
    /// ```
    /// of n rows, the second where there are hundreds: the largest of n normal errors is near √(2 ln n) σ.
    /// σ is what is stated, or estimated from the rows; of fewer than five rows nothing is estimated, and σ = 0.
    /// Whatever the noise, a table is refused in which nothing is above the first response.
    ///
    /// # Errors
    /// [`ViscometryError::ResponseFalls`] with the first such row.
    pub fn check_rising(&self) -> Result<(), ViscometryError> {
        let extremes = 1.0 + 2.0 * (2.0 * (self.response.len().max(1) as f64).ln()).sqrt();
        let allowed = extremes.max(5.0 * core::f64::consts::SQRT_2) * self.level();
        let mut previous = 0.0_f64;
        for (row, &value) in self.response.iter().enumerate() {
            if value <= previous && allowed <= (previous / value).ln() {
                return Err(ViscometryError::ResponseFalls { row, value, previous });
            }
            previous = previous.max(value);
        }
        match self.response.as_slice() {
            [first, second, ..] if previous <= *first => {
                Err(ViscometryError::ResponseFalls { row: 1, value: *second, previous })
            }
            _ => Ok(()),
        }
    }

    /// Refuses a table with too few rows for a derivative.
    pub(super) const fn check_rows(&self) -> Result<(), ViscometryError> {
        let rows = self.drive.len();
        if rows < FEWEST { Err(ViscometryError::TooFewRows { rows, least: FEWEST }) } else { Ok(()) }
    }

    /// The relative noise, stated or estimated.
    pub(super) fn level(&self) -> f64 {
        let logarithms = |values: &[f64]| -> Vec<f64> { values.iter().map(|x| x.ln()).collect() };
        match self.noise {
            Noise::Relative(level) => level,
            Noise::Estimated if FEWEST <= self.drive.len() => {
                smoothing::noise(&logarithms(&self.drive), &logarithms(&self.response))
            }
            Noise::Estimated | Noise::Exact => 0.0,
        }
    }
}

impl FlowTable<PipeGeometry> {
    /// Of a pipe of radius R, m: pressure gradients c, Pa/m, and discharges Q, m³/s.
    ///
    /// # Errors
    /// As [`PipeGeometry::new`] and [`FlowTable::new`].
    pub fn pipe(radius: f64, rows: &[[f64; 2]]) -> Result<Self, ViscometryError> {
        Self::new(PipeGeometry::new(radius)?, rows)
    }
}

impl FlowTable<ChannelGeometry> {
    /// Of a channel of half width d, m: pressure gradients c, Pa/m, and discharges for each width, m²/s.
    ///
    /// # Errors
    /// As [`ChannelGeometry::new`] and [`FlowTable::new`].
    pub fn channel(half_width: f64, rows: &[[f64; 2]]) -> Result<Self, ViscometryError> {
        Self::new(ChannelGeometry::new(half_width)?, rows)
    }
}

impl FlowTable<CouetteGeometry> {
    /// Of coaxial cylinders of radii R₁ < R₂, m: torques for each length M, N, and ΔΩ, rad/s.
    ///
    /// # Errors
    /// As [`CouetteGeometry::new`] and [`FlowTable::new`].
    pub fn couette(inner_radius: f64, outer_radius: f64, rows: &[[f64; 2]]) -> Result<Self, ViscometryError> {
        Self::new(CouetteGeometry::new(inner_radius, outer_radius)?, rows)
    }
}

impl FlowTable<PlatesGeometry> {
    /// Of discs of radius R at the distance h, m: angular velocities, rad/s, and torques, N m, or thrusts, N.
    ///
    /// # Errors
    /// As [`PlatesGeometry::new`] and [`FlowTable::new`].
    pub fn parallel_plates(radius: f64, gap: f64, rows: &[[f64; 2]]) -> Result<Self, ViscometryError> {
        Self::new(PlatesGeometry::new(radius, gap)?, rows)
    }
}

impl FlowTable<ConeGeometry> {
    /// Of a cone of radius R, m, and angle α, rad, on a plate: angular velocities, rad/s, and torques, N m, or thrusts, N.
    ///
    /// # Errors
    /// As [`ConeGeometry::new`] and [`FlowTable::new`].
    pub fn cone_and_plate(radius: f64, angle: f64, rows: &[[f64; 2]]) -> Result<Self, ViscometryError> {
        Self::new(ConeGeometry::new(radius, angle)?, rows)
    }
}

/// A table as it is written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written<G> {
    geometry: G,
    rows: Vec<[f64; 2]>,
    #[serde(default)]
    noise: Noise,
}

#[cfg(feature = "serde")]
impl<G> TryFrom<Written<G>> for FlowTable<G> {
    type Error = ViscometryError;

    fn try_from(Written { geometry, rows, noise }: Written<G>) -> Result<Self, ViscometryError> {
        Self::new(geometry, &rows)?.with_noise(noise)
    }
}

#[cfg(feature = "serde")]
impl<G> From<FlowTable<G>> for Written<G> {
    fn from(table: FlowTable<G>) -> Self {
        let rows = table.rows().collect();
        Self { geometry: table.geometry, rows, noise: table.noise }
    }
}
