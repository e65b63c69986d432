//! A smooth curve through, or close to, ln y over ln x.
//!
//! ```text
//! exact   a spline of degree 7 through every row
//! noisy   a rising curve close to the rows (`smoother`)
//! ```

use super::banded::Banded;
use super::log_slope::LogSlope;
use super::splines::{Derivatives, Splines};

/// Criterion by which a curve was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Criterion {
    /// It goes through every row: no noise above 10⁻⁵ was found or stated.
    Interpolation,
    /// The smoothing parameter is 0.6 times the one at which the generalised cross-validation is least.
    GeneralisedCrossValidation,
    /// The smoothing parameter is 0.6 times the one at which the expected error is least at the known noise.
    KnownNoise,
}

/// Smoothing of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Smoothing {
    /// The criterion.
    pub criterion: Criterion,
    /// The standard deviation of the noise, relative: stated, or estimated.
    pub noise: f64,
    /// λ, 0 for interpolation.
    pub parameter: f64,
    /// ν, the degrees of freedom of the curve.
    pub degrees_of_freedom: f64,
    /// Whether λ was raised so that the curve rises.
    pub raised: bool,
}

/// Noise up to here is none to smooth away.
pub(super) const EXACT: f64 = 1e-5;

/// A sum of splines.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fitted {
    pub(super) splines: Splines,
    pub(super) coefficients: Vec<f64>,
}

impl Fitted {
    pub(super) fn at(&self, u: f64) -> Derivatives {
        self.splines.sum(&self.coefficients, u)
    }

    /// Through all values, of this degree or the highest odd one that their number allows.
    pub(super) fn through(u: &[f64], values: &[f64], degree: usize) -> Option<Self> {
        let splines = Splines::on(u, degree.min((u.len() - 2) | 1));
        let coefficients = splines.through(u, values)?;
        Some(Self { splines, coefficients })
    }
}

/// The median of what is not empty.
fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// The standard deviation of the noise from differences of high order, in which a smooth curve vanishes.
pub(super) fn noise(u: &[f64], values: &[f64]) -> f64 {
    /// The median of |x| of a normal x of deviation 1.
    const NORMAL: f64 = 0.674_489_750_196_081_7;
    const MOST_WINDOWS: usize = 20_000;
    let of_order = |order: usize| {
        // Of many rows some windows tell the median as well.
        let stride = u.len().div_ceil(MOST_WINDOWS);
        let mut sizes: Vec<f64> = (0..u.len() - order)
            .step_by(stride)
            .map(|first| {
                let window = &u[first..=first + order];
                let weight = |j: usize| -> f64 {
                    let others = window.iter().enumerate().filter(|&(k, _)| k != j);
                    others.map(|(_, x)| (window[order] - window[0]) / (window[j] - x)).product()
                };
                let (mut sum, mut squares) = (0.0, 0.0);
                for j in 0..=order {
                    let weight = weight(j);
                    sum += weight * values[first + j];
                    squares += weight * weight;
                }
                sum.abs() / squares.sqrt()
            })
            .collect();
        median(&mut sizes) / NORMAL
    };
    (3..=(u.len() / 2).clamp(3, 10)).map(of_order).fold(f64::INFINITY, f64::min)
}

/// Intervals between rows of a table with more rows.
const MANY: usize = 512;

/// The rows, or of many some, the first and the last among them.
pub(super) fn thinned(u: &[f64]) -> Vec<f64> {
    if u.len() <= MANY {
        return u.to_vec();
    }
    (0..MANY).map(|k| u[k * (u.len() - 1) / (MANY - 1)]).collect()
}

/// A curve through exact rows, or close to noisy ones.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Curve {
    /// Through every row.
    Through(Fitted),
    /// Close to the rows.
    Smooth(LogSlope),
}

impl Curve {
    /// The value and its derivatives.
    pub(super) fn at(&self, u: f64) -> Derivatives {
        match self {
            Self::Through(fitted) => fitted.at(u),
            Self::Smooth(curve) => curve.at(u),
        }
    }

    /// Adds Σ `weights[k]` ∂y⁽ᵏ⁾(u)/∂p, k ≤ 2, to a row of all parameters.
    pub(super) fn accumulate(&self, row: &mut [f64], weights: Derivatives, u: f64) {
        match self {
            Self::Through(fitted) => fitted.splines.accumulate(row, weights, u),
            Self::Smooth(curve) => curve.accumulate(row, weights, u),
        }
    }

    /// The factors of the matrix of the splines at the rows of a curve through them.
    pub(super) fn factors(&self, u: &[f64]) -> Option<Banded> {
        match self {
            Self::Through(fitted) => fitted.splines.factors(u),
            Self::Smooth(_) => None,
        }
    }
}
