//! Measurements that a fluid is fitted to, and its answers there.

use core::f64::consts::PI;

use piola_numerics::Real;
use piola_viscometry::ViscometryError;
use piola_viscometry::recover::{
    ChannelGeometry, ConeGeometry, CouetteGeometry, FlowTable, Noise, PipeGeometry, PlatesGeometry, mean, repeats,
};

use crate::FitError;

/// Measurements of one kind.
///
/// # Example
/// ```
/// use piola_fit::fluids::FlowData;
/// let curve = FlowData::flow_curve(&[[0.1, 3.0], [1.0, 9.0], [10.0, 28.0]])?;
/// assert_eq!(curve.len(), 3);
/// # Ok::<(), piola_fit::FitError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FlowData {
    kind: Kind,
    rows: Vec<[f64; 2]>,
    noise: Noise,
}

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
enum Kind {
    FlowCurve,
    Pipe { radius: f64 },
    Channel { half_width: f64 },
    Couette { step: f64, stress_per_torque: f64 },
    ParallelPlates { radius: f64, gap: f64 },
    ConeAndPlate { radius: f64, angle: f64 },
}

impl FlowData {
    /// A flow curve: rows of the shear rate, 1/s, rising, and the shear stress, Pa.
    ///
    /// # Errors
    /// [`FitError::Viscometry`], as [`FlowTable::new`].
    pub fn flow_curve(rows: &[[f64; 2]]) -> Result<Self, FitError> {
        Ok(Self::of(Kind::FlowCurve, &FlowTable::new((), rows)?))
    }

    /// Discharges of a pipe.
    #[must_use]
    pub fn pipe(table: &FlowTable<PipeGeometry>) -> Self {
        Self::of(Kind::Pipe { radius: table.geometry().radius() }, table)
    }

    /// Discharges of a channel.
    #[must_use]
    pub fn channel(table: &FlowTable<ChannelGeometry>) -> Self {
        Self::of(Kind::Channel { half_width: table.geometry().half_width() }, table)
    }

    /// Speeds of coaxial cylinders.
    #[must_use]
    pub fn couette(table: &FlowTable<CouetteGeometry>) -> Self {
        let gap = table.geometry();
        let kind = Kind::Couette { step: gap.step(), stress_per_torque: gap.stress_per_torque() };
        Self::of(kind, table)
    }

    /// Torques of parallel plates.
    #[must_use]
    pub fn parallel_plates(table: &FlowTable<PlatesGeometry>) -> Self {
        let plates = table.geometry();
        let kind = Kind::ParallelPlates { radius: plates.radius(), gap: plates.gap() };
        Self::of(kind, table)
    }

    /// Torques of cone and plate.
    #[must_use]
    pub fn cone_and_plate(table: &FlowTable<ConeGeometry>) -> Self {
        let cone = table.geometry();
        let kind = Kind::ConeAndPlate { radius: cone.radius(), angle: cone.angle() };
        Self::of(kind, table)
    }

    fn of<G>(kind: Kind, table: &FlowTable<G>) -> Self {
        Self { kind, rows: table.rows().collect(), noise: table.noise() }
    }

    /// With these rows, rising in the drive. Repeated measurements at one drive are data of their own.
    ///
    /// # Errors
    /// [`FitError::Viscometry`] for a number that is not positive and finite, or a drive below the one before it.
    ///
    /// # Example
    /// ```
    /// use piola_fit::fluids::FlowData;
    /// let curve = FlowData::flow_curve(&[])?.with_rows(vec![[1.0, 3.0], [1.0, 3.1], [2.0, 6.0]])?;
    /// assert_eq!(curve.len(), 3);
    /// # Ok::<(), piola_fit::FitError>(())
    /// ```
    pub fn with_rows(self, rows: Vec<[f64; 2]>) -> Result<Self, FitError> {
        let mut previous = 0.0;
        for (row, &[drive, response]) in rows.iter().enumerate() {
            for (column, value) in [drive, response].into_iter().enumerate() {
                if !(0.0 < value && value.is_finite()) {
                    return Err(ViscometryError::RowNotPositive { row, column, value }.into());
                }
            }
            if drive < previous {
                return Err(ViscometryError::RowNotSorted { row, value: drive, previous }.into());
            }
            previous = drive;
        }
        Ok(Self { rows, ..self })
    }

    /// With its noise, by which its responses may seem to fall. It changes no parameter.
    ///
    /// # Errors
    /// As [`FlowTable::with_noise`].
    pub fn with_noise(self, noise: Noise) -> Result<Self, FitError> {
        let table = FlowTable::new((), &[])?.with_noise(noise)?;
        Ok(Self { noise: table.noise(), ..self })
    }

    /// Refuses responses that fall by more than noise explains.
    ///
    /// # Errors
    /// As [`FlowTable::check_rising`].
    pub fn check_rising(&self) -> Result<(), FitError> {
        let groups = repeats(&self.rows);
        let means: Vec<[f64; 2]> = groups.iter().map(|group| mean(&self.rows[group.clone()])).collect();
        let found = FlowTable::new((), &means)?.with_noise(self.noise)?.check_rising();
        Ok(found.map_err(|error| match error {
            ViscometryError::ResponseFalls { row, value, previous } => {
                ViscometryError::ResponseFalls { row: groups[row].start, value, previous }
            }
            error => error,
        })?)
    }

    /// Its rows: drive, response.
    #[must_use]
    pub fn rows(&self) -> &[[f64; 2]] {
        &self.rows
    }

    /// Their number.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are none.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The same with no more than about so many rows, evenly chosen, the last one among them.
    pub(super) fn thinned(&self, most: usize) -> Self {
        let stride = self.rows.len().div_ceil(most.max(1)).max(1);
        let from_the_end = self.rows.iter().rev().step_by(stride).copied();
        let mut rows: Vec<[f64; 2]> = from_the_end.collect();
        rows.reverse();
        Self { rows, ..self.clone() }
    }

    /// The answers to the drives of all rows. Integrals from rest on are continued from row to row, so that a row costs the stretch of
    /// rates between it and the one before.
    pub(super) fn answers<T: Real>(
        &self,
        stress: &dyn Fn(f64) -> T,
        shear_rate: &dyn Fn(f64) -> Result<f64, FitError>,
    ) -> Result<Vec<T>, FitError> {
        // The integrand over the rate, and the answer from the upper rate and the integral.
        let (power, radius) = match self.kind {
            Kind::Pipe { radius } => (3, radius),
            Kind::Channel { half_width } => (2, half_width),
            Kind::ParallelPlates { radius, .. } => (0, radius),
            _ => return (0..self.rows.len()).map(|row| self.answer(stress, shear_rate, row)).collect(),
        };
        let integrand = |k: f64| {
            let stress = stress(k);
            match power {
                3 => stress * stress * stress,
                2 => stress * stress,
                _ => T::lit(k * k) * stress,
            }
        };
        let mut answers = Vec::with_capacity(self.rows.len());
        let (mut integral, mut before) = (T::zero(), 0.0);
        for &[drive, _] in &self.rows {
            let (upper, wall) = match self.kind {
                Kind::Pipe { radius } => (shear_rate(0.5 * drive * radius)?, 0.5 * drive * radius),
                Kind::Channel { half_width } => (shear_rate(drive * half_width)?, drive * half_width),
                Kind::ParallelPlates { radius, gap } => (drive * radius / gap, 0.0),
                _ => (0.0, 0.0),
            };
            if before < upper {
                integral += if 0.0 < before { between(before, upper, &integrand) } else { below(upper, &integrand) };
                before = upper;
            }
            answers.push(match power {
                // 8π/(3c³) ∫ (T³ − τ³) dk = (π R³/3) (k − ∫τ³/T³).
                3 => {
                    T::lit(PI * radius * radius * radius / 3.0)
                        * (T::lit(upper) - integral / T::lit(wall * wall * wall))
                }
                2 => T::lit(radius * radius) * (T::lit(upper) - integral / T::lit(wall * wall)),
                _ => T::lit(2.0 * PI * (radius / upper).powi(3)) * integral,
            });
        }
        Ok(answers)
    }

    /// The answer to the drive of a row of a fluid with shear stresses τ(k) and their inverse ζ(τ), with derivatives with
    /// respect to its parameters.
    ///
    /// ```text
    /// pipe        Q = (8π/(3c³)) ∫ (T³ − τ(k)³) dk      up to ζ(T),  T = cR/2
    /// channel     Q = (1/c²) ∫ (T² − τ(k)²) dk          up to ζ(T),  T = cd
    /// cylinders   ΔΩ = ½ ∫ ln(T₁/max(τ(k), T₂)) dk      up to ζ(T₁)
    /// plates      𝓜 = 2π (R/k_R)³ ∫ k² τ(k) dk           up to k_R = ΩR/h
    /// cone        𝓜 = (2π/3) R³ τ(Ω/α)
    /// ```
    /// W(23.63), W(23.43), W(23.79) by parts: the integrands vanish at their upper ends, so that these may stay where they are while
    /// parameters vary.
    pub(super) fn answer<T: Real>(
        &self,
        stress: &dyn Fn(f64) -> T,
        shear_rate: &dyn Fn(f64) -> Result<f64, FitError>,
        row: usize,
    ) -> Result<T, FitError> {
        let drive = self.rows[row][0];
        Ok(match self.kind {
            Kind::FlowCurve => stress(drive),
            Kind::Pipe { radius } => {
                let wall = 0.5 * drive * radius;
                let inside = |k: f64| {
                    let share = stress(k) / T::lit(wall);
                    T::one() - share * share * share
                };
                // 8π T³/(3c³) = π R³/3.
                T::lit(PI * radius * radius * radius / 3.0) * below(shear_rate(wall)?, &inside)
            }
            Kind::Channel { half_width } => {
                let wall = drive * half_width;
                let inside = |k: f64| {
                    let share = stress(k) / T::lit(wall);
                    T::one() - share * share
                };
                T::lit(half_width * half_width) * below(shear_rate(wall)?, &inside)
            }
            Kind::Couette { step, stress_per_torque } => {
                let wall = drive * stress_per_torque;
                let outer = wall * (-step).exp();
                let (inner_rate, outer_rate) = (shear_rate(wall)?, shear_rate(outer)?);
                let inside = |k: f64| (T::lit(wall) / stress(k)).ln();
                let between = if 0.0 < outer_rate {
                    between(outer_rate, inner_rate, &inside)
                } else {
                    below(inner_rate, &inside)
                };
                T::lit(0.5) * (T::lit(outer_rate * step) + between)
            }
            Kind::ParallelPlates { radius, gap } => {
                let rim = drive * radius / gap;
                let inside = |k: f64| T::lit((k / rim) * (k / rim) / rim) * stress(k);
                T::lit(2.0 * PI * radius * radius * radius) * below(rim, &inside)
            }
            Kind::ConeAndPlate { radius, angle } => {
                T::lit(2.0 / 3.0 * PI * radius * radius * radius) * stress(drive / angle)
            }
        })
    }
}

/// Gauss and Legendre's eight points of [−1, 1], the positive ones.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];
/// ln of the share of the upper rate below which an integral has nothing.
const DEEP: f64 = 34.0;

/// ∫ f dk up to a rate, over ln k: rates of all sizes cost the same.
fn below<T: Real>(rate: f64, f: &dyn Fn(f64) -> T) -> T {
    // A rate that is nearly no number has nothing below it that is one.
    let low = rate * (-DEEP).exp();
    if f64::MIN_POSITIVE < low { between(low, rate, f) } else { T::zero() }
}

/// ∫ f dk between two positive rates: order 16 in panels of ln k no wider than 1.
fn between<T: Real>(low: f64, high: f64, f: &dyn Fn(f64) -> T) -> T {
    let width = ((high - low) / low).ln_1p();
    if !width.is_finite() {
        // No search may end beyond the range of numbers.
        return T::lit(f64::INFINITY);
    }
    let panels = width.ceil().max(1.0);
    let half = 0.5 * width / panels;
    let mut sum = T::zero();
    let mut centre = half;
    while centre < width {
        for (node, weight) in GAUSS {
            for node in [-node, node] {
                let k = high * (-(centre + half * node)).exp();
                sum += T::lit(half * weight * k) * f(k);
            }
        }
        centre += 2.0 * half;
    }
    sum
}
