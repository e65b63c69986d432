//! Normal stress differences from coaxial cylinders that turn so fast that the fluid is thrown outwards.

use super::curve::Options;
use super::functions::normal_stress_data;
use super::geometry::CouetteGeometry;
use super::table::FlowTable;
use super::{FlowCurve, NormalStressCurve, couette_with, normal_stress_with};
use crate::ViscometryError;
use crate::error::check_bound;

/// A measurement of normal stresses between coaxial cylinders.
///
/// # Example
/// See [`normal_stress_with_inertia`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct RadialStressRow {
    /// M, the torque for each length, N: positive.
    pub torque: f64,
    /// `T_rr(R₂) − T_rr(R₁)`, Pa, as measured: of either sign.
    pub difference: f64,
    /// Ω₁, the angular velocity of the inner cylinder, rad/s, in the sense in which ΔΩ = Ω₂ − Ω₁ is positive.
    pub inner_speed: f64,
}

/// The first normal stress difference of a fluid, with the flow curve and the inertia that were found on the way.
///
/// # Example
/// See [`normal_stress_with_inertia`].
#[derive(Clone, Debug, PartialEq)]
pub struct NormalStressRecovery {
    /// The shear rates.
    pub flow: FlowCurve,
    /// N₁.
    pub normal: NormalStressCurve,
    /// ∫ρξω²dξ of each row, Pa.
    pub centrifugal: Vec<f64>,
}

/// N₁ = σ₂ − σ₁ over the shear stress at the inner of coaxial cylinders, from speeds and normal stresses of a fluid of the density ρ.
///
/// ```text
/// 1. ΔΩ(M) → ζ                                                                            W(23.82)
/// 2. ω(r) = Ω₁ + ½ ∫ ζ(s) ds/s from T(r) to T₁,   T(r) = M/(2πr²)                          W(23.77)
/// 3. T_rr(R₂) − T_rr(R₁) + ∫ρξω²dξ = ∫ N₁ dξ/ξ → N₁                                        W(23.87–23.92)
/// ```
/// | symbol | argument | unit |
/// |---|---|---|
/// | M, ΔΩ | `speeds` | N, rad/s |
/// | M, `T_rr(R₂) − T_rr(R₁)`, Ω₁ | `rows` | N, Pa, rad/s |
/// | ρ | `density` | kg/m³ |
///
/// The torques of `rows` must lie between those of `speeds`; they need not be the same. Below the stress T₁ of the smallest torque of
/// `speeds` no shear rate is recovered: there ζ is taken as the power of the stress with which step 2 gives the measured ΔΩ of that torque.
/// The sum of step 3 must be positive and rise with the torque, as it does where N₁ > 0.
///
/// # Errors
/// As [`couette`](super::couette) and [`normal_stress`](super::normal_stress); [`ViscometryError::NotMeasured`] for a torque of `rows`
/// beyond those of `speeds`; [`ViscometryError::OutOfBounds`] unless 0 ≤ ρ.
///
/// # Accuracy
/// That of the two curves. An error of ζ enters the centrifugal part with twice its relative size.
///
/// # Example
/// A Newtonian flow with N₁ = 4 T², R₁ = 1, R₂ = 2, ζ = T = s/r², the inner cylinder at rest: ω = (s/2)(1 − 1/r²).
/// ```
/// use core::f64::consts::{LN_2, TAU};
/// use piola_viscometry::recover::{self, FlowTable, Options, RadialStressRow};
/// let stresses = || (1..=12).map(f64::from);
/// let speeds: Vec<_> = stresses().map(|s| [TAU * s, 0.375 * s]).collect();
/// let density = 0.5;
/// let rows: Vec<_> = stresses().map(|s| {
///     let centrifugal = density * (s / 2.0).powi(2) * (1.875 - 2.0 * LN_2);
///     RadialStressRow { torque: TAU * s, difference: 0.9375 * s * s - centrifugal, inner_speed: 0.0 }
/// }).collect();
/// let speeds = FlowTable::couette(1.0, 2.0, &speeds)?;
/// let found = recover::normal_stress_with_inertia(&speeds, &rows, density, Options::default())?;
/// assert!((found.normal.at(3.0)?.first_normal_stress_difference - 36.0).abs() < 1e-9);
/// # Ok::<(), piola_viscometry::ViscometryError>(())
/// ```
///
/// # Source
/// W(23.87)–W(23.92).
pub fn normal_stress_with_inertia(
    speeds: &FlowTable<CouetteGeometry>,
    rows: &[RadialStressRow],
    density: f64,
    options: Options,
) -> Result<NormalStressRecovery, ViscometryError> {
    check_bound("coaxial cylinders", "density", density, "0 ≤ ρ", 0.0 <= density)?;
    let flow = couette_with(speeds, options)?;
    let gap = speeds.geometry;
    let below = Below::of(speeds, &flow)?;
    let rate = |stress: f64| {
        if stress < below.stress { Ok(below.rate_at(stress)) } else { flow.at(stress).map(|point| point.shear_rate) }
    };
    let (mut table, mut centrifugal) = (Vec::with_capacity(rows.len()), Vec::with_capacity(rows.len()));
    for row in rows {
        // A torque below all of the table would be answered by the assumption alone.
        flow.at(gap.stress_per_torque() * row.torque)?;
        let sum = normal_stress_data(row.difference, gap, density, row.inner_speed, row.torque, rate)?;
        centrifugal.push(sum - row.difference);
        table.push([row.torque, sum]);
    }
    let table = FlowTable::new(gap, &table)?.with_noise(speeds.noise())?;
    Ok(NormalStressRecovery { flow, normal: normal_stress_with(&table, options)?, centrifugal })
}

/// Halvings of the logarithm of the exponent, from 18 decades to rounding.
const BISECTIONS: usize = 64;

/// The power law that goes on below the smallest stress: ζ = k (s/T)ᵉ with ∫ ζ ds/(2 s) over the gap as measured.
#[derive(Clone, Copy, Debug)]
struct Below {
    stress: f64,
    rate: f64,
    exponent: f64,
}

impl Below {
    fn of(speeds: &FlowTable<CouetteGeometry>, flow: &FlowCurve) -> Result<Self, ViscometryError> {
        let gap = speeds.geometry;
        let [torque, difference] = speeds.rows().next().unwrap_or([f64::NAN; 2]);
        let stress = gap.stress_per_torque() * torque;
        let rate = flow.at(stress)?.shear_rate;
        // k (1 − e^(−eδ))/(2 e) = ΔΩ: falls with e from kδ/2 to 0.
        let (step, share) = (gap.step(), 2.0 * difference / rate);
        let over = |exponent: f64| -(-exponent * step).exp_m1() / exponent;
        let (mut low, mut high) = (1e-9_f64, 1e9_f64);
        for _ in 0..BISECTIONS {
            let middle = (low * high).sqrt();
            if share < over(middle) { low = middle } else { high = middle }
        }
        Ok(Self { stress, rate, exponent: (low * high).sqrt() })
    }

    fn rate_at(self, stress: f64) -> f64 {
        self.rate * (stress / self.stress).powf(self.exponent)
    }
}
