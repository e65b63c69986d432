//! A smooth curve through, or close to, ln y over ln x.
//!
//! ```text
//! exact   a spline of degree 7 through every row
//! noisy   minimise Σ (yᵢ − f(uᵢ))² + λ ∫ f″² du      λ: least  n RSS/(n − 1.4 ν)²,   ν = trace of the smoother
//!                                                     or, with a known σ, least  RSS + 2 σ² ν
//! ```
//! A power law costs nothing. 1.4 makes generalised cross-validation undersmooth less often (Y.-J. Kim, C. Gu, 2004). The covariance
//! of the coefficients is that of Bayes' posterior with λ ∫f″² as prior, which holds the bias of smoothing too (G. Wahba, 1983).

use nalgebra::{DMatrix, DVector};

use super::banded::Gathered;
use super::splines::Splines;

/// Criterion by which a curve was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Criterion {
    /// It goes through every row: no noise above 10⁻⁵ was found or stated.
    Interpolation,
    /// The smoothing parameter makes the generalised cross-validation least.
    GeneralisedCrossValidation,
    /// The smoothing parameter makes the expected error least at the known noise.
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
    /// Whether λ was raised beyond the criterion so that the curve rises.
    pub raised: bool,
}

/// Noise up to here is none to smooth away.
pub(super) const EXACT: f64 = 1e-5;
/// Splines of a smoothed curve, at most.
const MOST: usize = 48;

/// A sum of splines.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fitted {
    pub(super) splines: Splines,
    pub(super) coefficients: Vec<f64>,
}

impl Fitted {
    pub(super) fn at(&self, u: f64) -> super::splines::Derivatives {
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

/// A penalised fit with what its errors follow from.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Penalised {
    pub(super) fitted: Fitted,
    pub(super) smoothing: Smoothing,
    /// √Cov: the coefficients are independent columns of it times noise.
    pub(super) root: DMatrix<f64>,
    /// Degrees of freedom of the noise; infinite where it is known.
    pub(super) freedom: f64,
}

/// The rotated problem, in which every λ is at hand.
pub(super) struct Smoother {
    splines: Splines,
    /// Coefficients of the modes.
    modes: DMatrix<f64>,
    /// Roughness of each mode.
    roughness: Vec<f64>,
    /// Share of the data in each mode.
    data: Vec<f64>,
    /// What no spline reaches, squared.
    beyond: f64,
    rows: f64,
}

/// λ from least to most, over the median roughness.
const LADDER: core::ops::RangeInclusive<i32> = -40..=40;
/// Steps of the ladder for a factor of e.
const STEPS: f64 = 2.0;

impl Smoother {
    /// With ∫ f⁽ᵐ⁾² as penalty.
    pub(super) fn new(u: &[f64], values: &[f64], order: usize) -> Option<Self> {
        let knots: Vec<f64> =
            if u.len() <= MOST { u.to_vec() } else { (0..MOST).map(|k| u[k * (u.len() - 1) / (MOST - 1)]).collect() };
        let splines = Splines::on(&knots, if knots.len() < 7 { 3 } else { 5 });
        let mut gathered = Gathered::new(splines.count());
        for (&u, &value) in u.iter().zip(values) {
            let (first, splines_there) = splines.values(u);
            gathered.add(first, &splines_there[..=splines.degree()], value);
        }
        let (r, right, beyond) = gathered.finish()?;
        let lower = r.transpose();
        let half = lower.solve_lower_triangular(&splines.roughness(order))?;
        let both = lower.solve_lower_triangular(&half.transpose())?;
        let eigen = (0.5 * (&both + both.transpose())).symmetric_eigen();
        let mut places: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        places.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
        let vectors = eigen.eigenvectors.select_columns(&places);
        let roughness =
            places.iter().enumerate().map(|(k, &i)| if k < order { 0.0 } else { eigen.eigenvalues[i].max(0.0) });
        let data = vectors.tr_mul(&DVector::from_vec(right));
        let modes = r.solve_upper_triangular(&vectors)?;
        let (roughness, data) = (roughness.collect(), data.as_slice().to_vec());
        Some(Self { splines, modes, roughness, data, beyond, rows: u.len() as f64 })
    }

    fn parameter(&self, rung: i32) -> f64 {
        (f64::from(rung) / STEPS).exp() / self.roughness[self.roughness.len() / 2].max(f64::MIN_POSITIVE)
    }

    /// RSS and ν at a λ.
    fn state(&self, parameter: f64) -> (f64, f64) {
        let (mut squares, mut freedom) = (self.beyond, 0.0);
        for (roughness, data) in self.roughness.iter().zip(&self.data) {
            let share = (1.0 + parameter * roughness).recip();
            squares += ((1.0 - share) * data).powi(2);
            freedom += share;
        }
        (squares, freedom)
    }

    /// The rung that the criterion chooses.
    pub(super) fn choose(&self, known: Option<f64>) -> i32 {
        /// Cost of a degree of freedom.
        const COST: f64 = 1.4;
        let score = |rung: i32| {
            let (squares, freedom) = self.state(self.parameter(rung));
            match known {
                Some(noise) => squares + 2.0 * noise * noise * freedom,
                None if self.rows <= COST * freedom => f64::INFINITY,
                None => squares / (self.rows - COST * freedom).powi(2),
            }
        };
        LADDER.min_by(|&a, &b| score(a).total_cmp(&score(b))).unwrap_or(0)
    }

    /// The next rung up, if there is one.
    pub(super) fn rougher(rung: i32) -> Option<i32> {
        LADDER.contains(&(rung + 1)).then_some(rung + 1)
    }

    /// The fit at a rung.
    pub(super) fn fit(&self, rung: i32, known: Option<f64>, raised: bool) -> Penalised {
        let parameter = self.parameter(rung);
        let (squares, degrees_of_freedom) = self.state(parameter);
        let left = (self.rows - degrees_of_freedom).max(1.0);
        let noise = known.unwrap_or_else(|| (squares / left).sqrt());
        let criterion = if known.is_some() { Criterion::KnownNoise } else { Criterion::GeneralisedCrossValidation };
        let shares: Vec<f64> = self.roughness.iter().map(|roughness| (1.0 + parameter * roughness).recip()).collect();
        let coefficients = (0..self.modes.nrows())
            .map(|i| (0..shares.len()).map(|k| self.modes[(i, k)] * shares[k] * self.data[k]).sum())
            .collect();
        let root =
            DMatrix::from_fn(self.modes.nrows(), shares.len(), |i, k| noise * self.modes[(i, k)] * shares[k].sqrt());
        let fitted = Fitted { splines: self.splines.clone(), coefficients };
        let smoothing = Smoothing { criterion, noise, parameter, degrees_of_freedom, raised };
        Penalised { fitted, smoothing, root, freedom: if known.is_some() { f64::INFINITY } else { left } }
    }
}
