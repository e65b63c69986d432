//! Shear rates from a measured curve that is given as a function.
//!
//! ```text
//! pipe                ζ(cR/2) = (1/(π c² R³)) d(c³ Q)/dc = Q (3 + d ln Q/d ln c)/(π R³)                    W(23.64)
//! channel             ζ(cd) = (1/(2 c d²)) d(c² Q)/dc = Q (2 + d ln Q/d ln c)/(2 d²)                        W(23.44)
//! coaxial cylinders   φ(M) = 2 M dΔΩ/dM = ζ(T₁) − ζ(T₂),   ζ(T₁) = Σ φ((R₁/R₂)²ⁿ M),   T₁ = M/(2πR₁²)       W(23.80)–W(23.82)
//! wide gap            ζ(T₁) ≈ φ(M)                                                                           W(23.83)
//! narrow gap          ζ(T₁) ≈ R₁ ΔΩ/(R₂ − R₁)                                                                W(23.85)
//! normal stresses     ψ(M) = 2 M d/dM [T_rr(R₂) − T_rr(R₁) + ∫ρξω²dξ]: (σ₂ − σ₁) at T₁ by the same series   W(23.88)–W(23.92)
//! parallel plates     τ(ΩR/h) = (𝓜/(2πR³)) (3 + d ln 𝓜/d ln Ω),   N₁ − N₂ = (𝓕/(πR²)) (2 + d ln 𝓕/d ln Ω)
//! ```
//! Derivatives are exact: a curve is one function over any scalar.

use piola_numerics::{Dual, Real};

use super::geometry::{ChannelGeometry, CouetteGeometry, PipeGeometry, PlatesGeometry};
use super::log_slope::FOUR;
use super::series::{self, Order};
use super::splines::Derivatives;
use crate::ViscometryError;
use crate::error::check_bound;

/// A measured curve as a function over any scalar: what answers to what drives.
///
/// # Example
/// A pipe of radius 1 through which Q = c²: ζ(c/2) = c² (3 + 2)/π.
/// ```
/// use piola_numerics::Real;
/// use piola_viscometry::recover::{MeasuredCurve, PipeGeometry, functions};
/// struct Square;
/// impl MeasuredCurve for Square {
///     fn response<T: Real>(&self, drive: T) -> T {
///         drive * drive
///     }
/// }
/// let wall = functions::pipe(&Square, PipeGeometry::new(1.0)?, 2.0)?;
/// assert_eq!(wall.shear_stress, 1.0);
/// assert!((wall.shear_rate - 20.0 / core::f64::consts::PI).abs() < 1e-14);
/// # Ok::<(), piola_viscometry::ViscometryError>(())
/// ```
pub trait MeasuredCurve {
    /// The response to a positive drive, in SI units.
    #[must_use]
    fn response<T: Real>(&self, drive: T) -> T;
}

/// A point of a flow curve.
///
/// # Example
/// See [`MeasuredCurve`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FlowPoint {
    /// τ, Pa.
    pub shear_stress: f64,
    /// k, 1/s.
    pub shear_rate: f64,
}

/// A point of a curve over the shear rate.
///
/// # Example
/// See [`parallel_plates`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RatePoint {
    /// k, 1/s.
    pub shear_rate: f64,
    /// τ or N₁ − N₂, Pa.
    pub stress: f64,
}

/// The sum of the series of coaxial cylinders.
///
/// # Example
/// See [`couette`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Series {
    /// The shear stress at the inner cylinder, M/(2πR₁²), Pa.
    pub shear_stress: f64,
    /// The sum: ζ, 1/s, or σ₂ − σ₁, Pa.
    pub value: f64,
    /// Terms that were added one by one; the rest was summed at once.
    pub terms: usize,
    /// An estimate of the error: the last terms of the rest that was summed at once.
    pub error: f64,
    /// Rigorous bounds of the value, valid if the recovered function rises with the stress below the last term:
    /// the rest lies between 2ΔΩ/δ and 2ΔΩ/δ + φ there.
    pub enclosure: [f64; 2],
}

/// A limit of the gap, and how far it may be off.
///
/// # Example
/// See [`couette_wide_gap`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Approximation {
    /// The shear stress at the inner cylinder, Pa.
    pub shear_stress: f64,
    /// The approximate shear rate there, 1/s.
    pub shear_rate: f64,
    /// Error bound, valid if the shear rate rises with the stress.
    pub bound: f64,
}

/// The value and d ln/d ln of a curve.
fn logarithmic(
    curve: &impl MeasuredCurve,
    flow: &'static str,
    what: &'static str,
    drive: f64,
) -> Result<(f64, f64), ViscometryError> {
    check_bound(flow, what, drive, "0 < drive", 0.0 < drive)?;
    let at = curve.response(Dual::new(drive, drive));
    check_response(drive, at.value, at.tangent)?;
    Ok((at.value, at.tangent))
}

fn check_response(drive: f64, value: f64, slope: f64) -> Result<(), ViscometryError> {
    if value.is_finite() && slope.is_finite() { Ok(()) } else { Err(ViscometryError::CurveNotFinite { drive }) }
}

/// The shear rate at the wall of a pipe, after Weissenberg, Rabinowitsch and Mooney.
///
/// # Errors
/// [`ViscometryError::OutOfBounds`] for a drive that is not positive, [`ViscometryError::CurveNotFinite`].
///
/// # Accuracy
/// 4 ulp beyond those of the curve and its derivative.
///
/// # Example
/// See [`MeasuredCurve`].
///
/// # Source
/// W(23.64).
pub fn pipe(
    curve: &impl MeasuredCurve,
    pipe: PipeGeometry,
    pressure_gradient: f64,
) -> Result<FlowPoint, ViscometryError> {
    let (discharge, slope) = logarithmic(curve, "pipe", "pressure gradient", pressure_gradient)?;
    let radius = pipe.radius;
    let shear_rate = (3.0 * discharge + slope) / (core::f64::consts::PI * radius * radius * radius);
    Ok(FlowPoint { shear_stress: 0.5 * pressure_gradient * radius, shear_rate })
}

/// The shear rate at the wall of a channel.
///
/// # Errors
/// [`ViscometryError::OutOfBounds`] for a drive that is not positive, [`ViscometryError::CurveNotFinite`].
///
/// # Accuracy
/// 4 ulp beyond those of the curve and its derivative.
///
/// # Example
/// See [`MeasuredCurve`].
///
/// # Source
/// W(23.44).
pub fn channel(
    curve: &impl MeasuredCurve,
    channel: ChannelGeometry,
    pressure_gradient: f64,
) -> Result<FlowPoint, ViscometryError> {
    let (discharge, slope) = logarithmic(curve, "channel", "pressure gradient", pressure_gradient)?;
    let d = channel.half_width;
    Ok(FlowPoint { shear_stress: pressure_gradient * d, shear_rate: (2.0 * discharge + slope) / (2.0 * d * d) })
}

/// The shear stress at the rim of parallel plates from the torque as a function of the angular velocity.
///
/// # Errors
/// [`ViscometryError::OutOfBounds`] for a speed that is not positive, [`ViscometryError::CurveNotFinite`].
///
/// # Accuracy
/// 4 ulp beyond those of the curve and its derivative.
///
/// # Example
/// τ = 2 k² between plates of radius and gap 1: 𝓜 = 2π·2 Ω²/5.
/// ```
/// use piola_numerics::Real;
/// use piola_viscometry::recover::{MeasuredCurve, PlatesGeometry, functions};
/// struct Torque;
/// impl MeasuredCurve for Torque {
///     fn response<T: Real>(&self, speed: T) -> T {
///         T::lit(0.8 * core::f64::consts::PI) * speed * speed
///     }
/// }
/// let rim = functions::parallel_plates(&Torque, PlatesGeometry::new(1.0, 1.0)?, 3.0)?;
/// assert!((rim.stress - 18.0).abs() < 1e-14);
/// # Ok::<(), piola_viscometry::ViscometryError>(())
/// ```
///
/// # Source
/// The analogue of W(23.64) for a torque 2π (R/k)³ ∫ s² τ(s) ds up to the rate k = ΩR/h of the rim.
pub fn parallel_plates(
    torque: &impl MeasuredCurve,
    plates: PlatesGeometry,
    angular_velocity: f64,
) -> Result<RatePoint, ViscometryError> {
    let (value, slope) = logarithmic(torque, "parallel plates", "angular velocity", angular_velocity)?;
    let PlatesGeometry { radius, gap } = plates;
    let stress = (3.0 * value + slope) / (core::f64::consts::TAU * radius * radius * radius);
    Ok(RatePoint { shear_rate: angular_velocity * radius / gap, stress })
}

/// N₁ − N₂ at the rim of parallel plates from the thrust as a function of the angular velocity.
///
/// # Errors
/// [`ViscometryError::OutOfBounds`] for a speed that is not positive, [`ViscometryError::CurveNotFinite`].
///
/// # Accuracy
/// 4 ulp beyond those of the curve and its derivative.
///
/// # Example
/// See [`parallel_plates`].
///
/// # Source
/// The thrust is π (R/k)² ∫ s (N₁ − N₂) ds up to the rate k = ΩR/h of the rim.
pub fn parallel_plates_thrust(
    thrust: &impl MeasuredCurve,
    plates: PlatesGeometry,
    angular_velocity: f64,
) -> Result<RatePoint, ViscometryError> {
    let (value, slope) = logarithmic(thrust, "parallel plates", "angular velocity", angular_velocity)?;
    let PlatesGeometry { radius, gap } = plates;
    let stress = (2.0 * value + slope) / (core::f64::consts::PI * radius * radius);
    Ok(RatePoint { shear_rate: angular_velocity * radius / gap, stress })
}

/// The rest is looked at after so many terms.
const LOOKS: [usize; 22] =
    [0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 512, 1024, 2048, 4096, 8192];
/// Relative error at which the sum ends.
const AIM: f64 = 4.0 * f64::EPSILON;
/// Largest relative error that is accepted.
const REACHED: f64 = 1e-8;

/// ζ at the inner of two coaxial cylinders from ΔΩ as a function of the torque, by the series W(23.82) with its rest summed at once
/// (see the [module](super)); the recovery of σ₂ − σ₁ from [`normal_stress_data`] is the same sum.
///
/// # Errors
/// [`ViscometryError::OutOfBounds`] for a torque that is not positive, [`ViscometryError::CurveNotFinite`],
/// [`ViscometryError::SeriesNotConverged`] where the estimated error stays above 10⁻⁸ of the value.
///
/// # Accuracy
/// The estimated error; powers of the torque come out to 4 ulp of the curve's derivatives at any R₁/R₂.
///
/// # Example
/// ```
/// use piola_numerics::Real;
/// use piola_viscometry::recover::{CouetteGeometry, MeasuredCurve, functions};
/// // ζ = T²: ΔΩ = (T₁² − T₂²)/4 with T = M/(2πR²).
/// struct Squared(f64);
/// impl MeasuredCurve for Squared {
///     fn response<T: Real>(&self, torque: T) -> T {
///         let stress = torque / T::lit(core::f64::consts::TAU);
///         stress * stress * T::lit(0.25 * (1.0 - self.0.powi(-4)))
///     }
/// }
/// for outer in [2.0, 1.001] {
///     let inner = functions::couette(&Squared(outer), CouetteGeometry::new(1.0, outer)?, core::f64::consts::TAU)?;
///     assert!((inner.value - 1.0).abs() < 1e-12 && inner.terms == 0);
/// }
/// let (gap, torque) = (CouetteGeometry::new(1.0, 2.0)?, core::f64::consts::TAU);
/// let two = functions::couette_series(&Squared(2.0), gap, torque, 2)?;
/// assert!((two.value - 255.0 / 256.0).abs() < 1e-15 && 1.0 <= two.enclosure[1]); // 15/16 (1 + 1/16)
/// let wide = functions::couette_wide_gap(&Squared(2.0), gap, torque)?;
/// assert!((wide.shear_rate - 15.0 / 16.0).abs() < 1e-15 && 1.0 - wide.shear_rate <= wide.bound);
/// # Ok::<(), piola_viscometry::ViscometryError>(())
/// ```
///
/// # Source
/// W(23.80)–W(23.82), W(23.90)–W(23.92).
pub fn couette(curve: &impl MeasuredCurve, gap: CouetteGeometry, torque: f64) -> Result<Series, ViscometryError> {
    check_bound("coaxial cylinders", "torque", torque, "0 < M", 0.0 < torque)?;
    let step = gap.step();
    let mut sum = 0.0;
    let mut best: Option<Series> = None;
    let mut look = LOOKS.into_iter().peekable();
    for terms in 0..=LOOKS[LOOKS.len() - 1] {
        let at = torque * (-step * terms as f64).exp();
        let [w, slope] = if look.next_if_eq(&terms).is_some() {
            let derivatives = in_logarithm(curve, at)?;
            let found = summed(sum, derivatives, step, terms, gap.stress_per_torque() * torque);
            let better = best.is_none_or(|other| found.error < other.error);
            if better {
                best = Some(found);
            }
            if found.error <= AIM * found.value.abs() || derivatives[0].abs() < f64::MIN_POSITIVE {
                return Ok(found);
            }
            [derivatives[0], derivatives[1]]
        } else {
            let value = curve.response(Dual::new(at, at));
            check_response(at, value.value, value.tangent)?;
            [value.value, value.tangent]
        };
        let term = 2.0 * slope;
        sum += term;
        // Nothing is left of a yield stress, or of the digits.
        if w.abs() < f64::MIN_POSITIVE || (w / step).abs().max(term.abs()) <= 0.01 * AIM * sum.abs() {
            let over = (2.0 * w / step).abs();
            let shear_stress = gap.stress_per_torque() * torque;
            let enclosure = [sum - over, sum + over];
            return Ok(Series { shear_stress, value: sum, terms: terms + 1, error: AIM * sum.abs(), enclosure });
        }
    }
    match best {
        Some(found) if found.error <= REACHED * found.value.abs() => Ok(found),
        Some(Series { terms, error, .. }) => Err(ViscometryError::SeriesNotConverged { torque, terms, error }),
        None => Err(ViscometryError::CurveNotFinite { drive: torque }),
    }
}

/// A curve and its derivatives with respect to the logarithm of the torque.
fn in_logarithm(curve: &impl MeasuredCurve, torque: f64) -> Result<Derivatives, ViscometryError> {
    let variable = Real::exp(series::fourth(0.0)) * Real::lit(torque);
    let found = series::derivatives(&curve.response(variable));
    check_response(torque, found.iter().sum(), 0.0)?;
    Ok(found)
}

/// The terms so far and the rest.
fn summed(sum: f64, w: Derivatives, step: f64, terms: usize, shear_stress: f64) -> Series {
    let [w0, w1, ..] = w;
    if w0.abs() < f64::MIN_POSITIVE {
        return Series { shear_stress, value: sum, terms, error: 0.0, enclosure: [sum, sum] };
    }
    let [m1, m2, m3, m4] = [w[1] / w0, w[2] / w0, w[3] / w0, w[4] / w0];
    let k2 = m2 - m1 * m1;
    let k3 = m3 - 3.0 * m1 * m2 + 2.0 * m1 * m1 * m1;
    let k4 = m4 - 4.0 * m1 * m3 - 3.0 * m2 * m2 + 12.0 * m1 * m1 * m2 - 6.0 * m1 * m1 * m1 * m1;
    let rest = series::rest([0.0, m1, k2, k3, k4], step, Order::Full);
    let low = sum + 2.0 * w0 / step;
    let high = low + 2.0 * w1;
    let value = sum + 2.0 * w0 * rest.factor;
    Series {
        shear_stress,
        value,
        terms,
        error: (2.0 * w0).abs() * rest.error,
        enclosure: [low.min(high), low.max(high)],
    }
}

/// The first `terms` terms of the series W(23.82), with the enclosure of what they leave out.
///
/// # Errors
/// [`ViscometryError::OutOfBounds`] for a torque that is not positive, [`ViscometryError::CurveNotFinite`].
///
/// # Accuracy
/// The enclosure, wherever ζ rises with the stress; it narrows by (R₁/R₂)² a term for a Newtonian fluid.
///
/// # Example
/// See [`couette`].
///
/// # Source
/// W(23.82).
pub fn couette_series(
    curve: &impl MeasuredCurve,
    gap: CouetteGeometry,
    torque: f64,
    terms: usize,
) -> Result<Series, ViscometryError> {
    check_bound("coaxial cylinders", "torque", torque, "0 < M", 0.0 < torque)?;
    let step = gap.step();
    let (mut sum, mut compensation) = (0.0_f64, 0.0_f64);
    let at = |n: usize| {
        let drive = torque * (-step * n as f64).exp();
        let found = curve.response(Dual::new(drive, drive));
        check_response(drive, found.value, found.tangent).map(|()| (found.value, 2.0 * found.tangent))
    };
    for n in 0..terms {
        let term = at(n)?.1 - compensation;
        let next = sum + term;
        compensation = (next - sum) - term;
        sum = next;
    }
    let (w, term) = at(terms)?;
    let (low, high) = (sum + 2.0 * w / step, sum + 2.0 * w / step + term);
    let enclosure = [low.min(high), low.max(high)];
    let shear_stress = gap.stress_per_torque() * torque;
    Ok(Series { shear_stress, value: sum, terms, error: enclosure[1] - sum, enclosure })
}

/// The wide gap: ζ(T₁) ≈ φ(M), the first term of the series.
///
/// # Errors
/// [`ViscometryError::OutOfBounds`] for a torque that is not positive, [`ViscometryError::CurveNotFinite`].
///
/// # Accuracy
/// Its bound 2ΔΩ/δ, which the neglected ζ(T₂) does not exceed.
///
/// # Example
/// See [`couette`].
///
/// # Source
/// W(23.83).
pub fn couette_wide_gap(
    curve: &impl MeasuredCurve,
    gap: CouetteGeometry,
    torque: f64,
) -> Result<Approximation, ViscometryError> {
    let (difference, slope) = logarithmic(curve, "coaxial cylinders", "torque", torque)?;
    let bound = 2.0 * difference / gap.step();
    Ok(Approximation { shear_stress: gap.stress_per_torque() * torque, shear_rate: 2.0 * slope, bound })
}

/// The narrow gap: ζ(T₁) ≈ R₁ ΔΩ/(R₂ − R₁).
///
/// # Errors
/// [`ViscometryError::OutOfBounds`] for a torque that is not positive, [`ViscometryError::CurveNotFinite`].
///
/// # Accuracy
/// Its bound: the mean 2ΔΩ/δ of ζ over the gap is exceeded by ζ(T₁) by no more than φ.
///
/// # Example
/// See [`couette`].
///
/// # Source
/// W(23.85).
pub fn couette_narrow_gap(
    curve: &impl MeasuredCurve,
    gap: CouetteGeometry,
    torque: f64,
) -> Result<Approximation, ViscometryError> {
    let (difference, slope) = logarithmic(curve, "coaxial cylinders", "torque", torque)?;
    let shear_rate = difference * gap.inner_radius / (gap.outer_radius - gap.inner_radius);
    let mean = 2.0 * difference / gap.step();
    let bound = (shear_rate - mean).abs().max((mean + 2.0 * slope - shear_rate).abs());
    Ok(Approximation { shear_stress: gap.stress_per_torque() * torque, shear_rate, bound })
}

/// Panels of the gap in the integral of the centrifugal force.
const PANELS: usize = 32;
/// The difference of the radial stresses with the centrifugal part made good, Pa, of which ψ is the derivative: what the series takes to
/// σ₂ − σ₁ at the inner cylinder.
///
/// ```text
/// T_rr(R₂) − T_rr(R₁) + ∫ρξω²dξ      ω(r) = Ω₁ + ½ ∫ ζ(s) ds/s from T(r) to T₁,   T(r) = M/(2πr²)
/// ```
/// | symbol | argument | unit |
/// |---|---|---|
/// | `T_rr(R₂) − T_rr(R₁)` | `difference` | Pa |
/// | ρ | `density` | kg/m³ |
/// | Ω₁ | `inner_speed` | rad/s |
/// | M | `torque` | N |
/// | ζ | `shear_rate` | 1/s |
///
/// # Errors
/// Those of `shear_rate`; [`ViscometryError::NotFinite`], [`ViscometryError::OutOfBounds`] for arguments.
///
/// # Accuracy
/// Order 8 in 1/32 of ln(R₂/R₁): 10⁻¹² where ζ is smooth over the gap.
///
/// # Example
/// A rigid rotation: ρ Ω² (R₂² − R₁²)/2.
/// ```
/// use piola_viscometry::recover::{CouetteGeometry, functions};
/// let gap = CouetteGeometry::new(1.0, 2.0)?;
/// let inertia = functions::normal_stress_data(0.0, gap, 1000.0, 3.0, 1.0, |_| Ok(0.0))?;
/// assert!((inertia - 13_500.0).abs() < 1e-9);
/// # Ok::<(), piola_viscometry::ViscometryError>(())
/// ```
///
/// # Source
/// W(23.87)–W(23.89).
pub fn normal_stress_data(
    difference: f64,
    gap: CouetteGeometry,
    density: f64,
    inner_speed: f64,
    torque: f64,
    shear_rate: impl Fn(f64) -> Result<f64, ViscometryError>,
) -> Result<f64, ViscometryError> {
    let flow = "coaxial cylinders";
    check_bound(flow, "stress difference", difference, "finite", true)?;
    check_bound(flow, "density", density, "0 <= rho", 0.0 <= density)?;
    check_bound(flow, "inner speed", inner_speed, "finite", true)?;
    check_bound(flow, "torque", torque, "0 < M", 0.0 < torque)?;
    let wall = gap.stress_per_torque() * torque;
    let width = 0.5 * gap.step() / PANELS as f64;
    // y = ln(r/R₁): ω′ = ζ(T₁ e^(−2y)), ∫ρξω²dξ = ∫ρ r² ω² dy.
    let speed = |from: f64, to: f64| -> Result<f64, ViscometryError> {
        FOUR.iter().try_fold(0.0, |sum, (node, weight)| {
            let y = from + (to - from) * node;
            Ok(sum + weight * (to - from) * shear_rate(wall * (-2.0 * y).exp())?)
        })
    };
    let (mut omega, mut integral) = (inner_speed, 0.0);
    for panel in 0..PANELS {
        let from = width * panel as f64;
        for (node, weight) in FOUR {
            let y = from + width * node;
            let local = omega + speed(from, y)?;
            let radius = gap.inner_radius * y.exp();
            integral += weight * width * density * radius * radius * local * local;
        }
        omega += speed(from, from + width)?;
    }
    Ok(difference + integral)
}
