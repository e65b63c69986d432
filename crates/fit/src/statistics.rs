//! Errors of the parameters and criteria for choosing between laws, from the residuals.
//!
//! ```text
//! s² = S/(m − k)      Cov = s² (JᵀJ)⁻¹      θ ± t √Cov      J = W ∂P/∂θ,   t of Student with m − k degrees
//! AIC = m ln(S/m) + 2 K      AICc = AIC + 2 K (K + 1)/(m − K − 1)      BIC = m ln(S/m) + K ln m      K = k + 1
//! ```
//! m numbers were measured with errors that are independent and normal, of standard deviation σ/w each; σ is the
//! parameter that K counts beyond those of the law. Criteria compare laws on the same data with the same weights: the
//! least is the best, and differences below 2 say nothing (H. Akaike, 1974; C. M. Hurvich, C.-L. Tsai, 1989; G. Schwarz,
//! 1978). With m ≤ k the law can pass through all that was measured, ln S is that of rounding, and there are no criteria;
//! `AICc` needs k + 2 < m.

use nalgebra::DMatrix;
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

/// Criteria for choosing between laws; less is better.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Criteria {
    /// Akaike's; none unless there are more numbers than parameters.
    pub aic: Option<f64>,
    /// Akaike's for small samples; none unless there are at least three numbers more than parameters.
    pub aicc: Option<f64>,
    /// Schwarz's; none unless there are more numbers than parameters.
    pub bic: Option<f64>,
}

impl Criteria {
    /// Criteria of a fit of so many parameters to so many numbers that leaves a sum of squares. Zero counts as the smallest positive
    /// number.
    ///
    /// # Example
    /// ```
    /// use piola_fit::Criteria;
    /// // One parameter, six numbers, S = 6: only the count is left, 2 K = 4; AICc adds 2·2·3/3.
    /// let criteria = Criteria::new(6, 1, 6.0);
    /// assert_eq!((criteria.aic, criteria.aicc), (Some(4.0), Some(8.0)));
    /// // Two parameters pass through two numbers: nothing is left to judge by.
    /// assert_eq!(Criteria::new(2, 2, 1e-32).aic, None);
    /// ```
    #[must_use]
    pub fn new(points: usize, parameters: usize, squares: f64) -> Self {
        let (m, counted) = (points as f64, parameters as f64 + 1.0);
        let misfit = m * (squares.max(f64::MIN_POSITIVE) / m).ln();
        let aic = misfit + 2.0 * counted;
        let left = m - counted - 1.0;
        let aicc = (0.0 < left).then(|| aic + 2.0 * counted * (counted + 1.0) / left);
        let told = parameters < points;
        Self { aic: told.then_some(aic), aicc, bic: told.then(|| misfit + counted * m.ln()) }
    }
}

/// The covariance of those parameters that the data determine.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Covariance {
    /// Their places among the parameters.
    pub parameters: Vec<usize>,
    /// The matrix by rows.
    pub matrix: Vec<Vec<f64>>,
    /// (JᵀJ)⁻¹ over the roots of its diagonal, by rows.
    #[cfg_attr(feature = "serde", serde(skip))]
    correlation: Vec<Vec<f64>>,
}

impl Covariance {
    /// The correlation matrix by rows: that of (JᵀJ)⁻¹, of residuals that are all zero too.
    #[must_use]
    pub fn correlation(&self) -> &[Vec<f64>] {
        &self.correlation
    }

    /// The standard error of a parameter that is determined.
    #[cfg(any(feature = "fluids", feature = "solids"))]
    pub(crate) fn standard_error(&self, parameter: usize) -> Option<f64> {
        let place = self.parameters.iter().position(|&other| other == parameter)?;
        Some(self.matrix[place][place].sqrt())
    }

    /// The covariance from J for the parameters `free`, less those that no measurement depends on or that cannot be told apart.
    ///
    /// | symbol | argument |
    /// |---|---|
    /// | J = W ∂P/∂θ | `slopes`, a row for each number and a column for each parameter |
    /// | s² | `variance` |
    #[must_use]
    pub fn new(slopes: &DMatrix<f64>, free: &[usize], variance: f64) -> Self {
        /// Parameters whose share in a direction that nothing depends on is below this are determined.
        const SHARE: f64 = 1e-4;
        let sizes: Vec<f64> = free.iter().map(|&k| slopes.column(k).norm()).collect();
        let kept: Vec<usize> = (0..free.len()).filter(|&k| 0.0 < sizes[k] && sizes[k].is_finite()).collect();
        let none = Self { parameters: Vec::new(), matrix: Vec::new(), correlation: Vec::new() };
        if kept.is_empty() {
            return none;
        }
        let mut scaled =
            DMatrix::from_fn(slopes.nrows(), kept.len(), |i, k| slopes[(i, free[kept[k]])] / sizes[kept[k]]);
        let rounding = f64::EPSILON * slopes.nrows().min(1000) as f64;
        if 4 * kept.len() < scaled.nrows() {
            // Of many rows the triangle of J = Q R has the same directions.
            scaled = scaled.qr().r();
        }
        let svd = scaled.svd(false, true);
        let Some(directions) = svd.v_t else { return none };
        let threshold = rounding * svd.singular_values.max();
        let (mut inverse, mut determined) = (DMatrix::zeros(kept.len(), kept.len()), vec![true; kept.len()]);
        for (row, &value) in svd.singular_values.iter().enumerate() {
            let direction = directions.row(row);
            if threshold < value {
                inverse += direction.tr_mul(&direction) / (value * value);
            } else {
                for (k, share) in direction.iter().enumerate() {
                    determined[k] &= share.abs() < SHARE;
                }
            }
        }
        let shown: Vec<usize> = (0..kept.len()).filter(|&k| determined[k]).collect();
        let entry = |&i: &usize, &j: &usize| variance * inverse[(i, j)] / (sizes[kept[i]] * sizes[kept[j]]);
        let root = |k: usize| inverse[(k, k)].sqrt();
        let correlation = |&i: &usize, &j: &usize| if i == j { 1.0 } else { inverse[(i, j)] / (root(i) * root(j)) };
        Self {
            parameters: shown.iter().map(|&k| free[kept[k]]).collect(),
            matrix: shown.iter().map(|i| shown.iter().map(|j| entry(i, j)).collect()).collect(),
            correlation: shown.iter().map(|i| shown.iter().map(|j| correlation(i, j)).collect()).collect(),
        }
    }
}

/// Degrees of freedom from which on Student's law is the normal one to six digits; the search for its quantile would no
/// longer end.
const MANY: usize = 1_000_000;

/// t such that a Student variable is in ±t with this probability; none without degrees of freedom.
///
/// # Example
/// ```
/// use piola_fit::student;
/// let t = student(0.5, 1).expect("a degree of freedom");
/// assert!((t - 1.0).abs() < 1e-9); // tan(π/4)
/// ```
#[must_use]
pub fn student(confidence: f64, degrees: usize) -> Option<f64> {
    if MANY <= degrees {
        return Some(Normal::standard().inverse_cdf(0.5 * (1.0 + confidence)));
    }
    let law = StudentsT::new(0.0, 1.0, degrees as f64).ok()?;
    let t = law.inverse_cdf(0.5 * (1.0 + confidence));
    t.is_finite().then_some(t)
}

/// The interval of a parameter between its bounds; it crosses none of them.
///
/// ```text
/// θ − L ≥ t σ     [θ − t σ, L + (θ − L) e^h],   h = t σ/(θ − L): holds the one symmetric in θ and the one symmetric in ln(θ − L)
/// otherwise       [L, θ + t σ]: the bound is among the values that the data allow
/// ```
/// Where h is near one, either interval alone can cover the truth too rarely; which one depends on the law. For small h they differ by ½ h² of the
/// distance.
#[cfg(any(feature = "fluids", feature = "solids"))]
pub(crate) fn interval(value: f64, [low, high]: [f64; 2], half: f64) -> [f64; 2] {
    let far = |distance: f64| distance * (half / distance).exp();
    match (low.is_finite(), high.is_finite()) {
        (true, false) if half <= value - low => [value - half, low + far(value - low)],
        (false, true) if half <= high - value => [high - far(high - value), value + half],
        _ => [(value - half).max(low), (value + half).min(high)],
    }
}

/// Correlation of neighbouring residuals: what intervals of independent errors miss.
///
/// ```text
/// ρ = Σ rᵢ rᵢ₊₁ / Σ ½ (rᵢ² + rᵢ₊₁²)      widening √((1 + ρ)/(1 − ρ)) where 2/√n < ρ, of n pairs; 1 otherwise
/// ```
/// Smooth measured curves that a law misses a little leave ρ near 0.8. The mean of such residuals is as uncertain as that of
/// (1 − ρ)/(1 + ρ) as many independent ones; intervals are widened accordingly.
///
/// # Example
/// ```
/// use piola_fit::Autocorrelation;
/// let slow: Vec<f64> = (0..40).map(|i| (0.1 * f64::from(i)).sin()).collect();
/// let found = Autocorrelation::of([slow.as_slice()]).expect("39 pairs");
/// assert!(0.9 < found.lag_one && 4.0 < found.widening);
/// let alternating = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0];
/// assert_eq!(Autocorrelation::of([alternating.as_slice()]).expect("5 pairs").widening, 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Autocorrelation {
    /// ρ of neighbours, all tests together.
    pub lag_one: f64,
    /// Pairs of neighbours.
    pub pairs: usize,
    /// What intervals are multiplied by.
    pub widening: f64,
}

impl Autocorrelation {
    /// Of residuals in the order of their abscissas, one series for each test. `None` for fewer than three pairs, or residuals that
    /// are all zero.
    pub fn of<'r>(series: impl IntoIterator<Item = &'r [f64]>) -> Option<Self> {
        /// Standard deviations of ρ of independent residuals beyond which it counts.
        const TOLD: f64 = 2.0;
        /// The largest ρ of the widening.
        const MOST: f64 = 0.98;
        let (mut product, mut squares, mut pairs) = (0.0, 0.0, 0);
        for residuals in series {
            for pair in residuals.windows(2) {
                product += pair[0] * pair[1];
                squares += 0.5 * (pair[0] * pair[0] + pair[1] * pair[1]);
                pairs += 1;
            }
        }
        let lag_one = product / squares;
        (3 <= pairs && lag_one.is_finite()).then(|| {
            let told = TOLD < lag_one * (pairs as f64).sqrt();
            let rho = lag_one.min(MOST);
            let widening = if told { ((1.0 + rho) / (1.0 - rho)).sqrt() } else { 1.0 };
            Self { lag_one, pairs, widening }
        })
    }
}

/// How intervals are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Intervals {
    /// From the covariance, as if the law were linear in its parameters near the best ones.
    #[default]
    Linear,
    /// By profile likelihood: each parameter is moved, with all others fitted anew, until S exceeds its least by the share (t w)²/(m − k),
    /// w the widening by correlated residuals.
    Profile,
    /// By the bootstrap: the law is fitted anew to data that it would have made with errors drawn from the residuals of each test, in blocks where
    /// neighbours are correlated. Linear intervals stay where more than a tenth of these fits fail.
    Bootstrap {
        /// Fits made anew, 200 to 100,000; 1000 tell the ends of a 95 % interval to some 3 % of its width.
        samples: usize,
        /// The seed of the random numbers.
        seed: u64,
    },
}

/// Where the least S at a fixed value of a parameter exceeds its least of all by the share (t w)²/(m − k), on both sides.
///
/// `squares(v)` is the least S with the parameter at v; `scale` a first step; an end at which no such value is found is the bound.
#[cfg(any(feature = "fluids", feature = "solids"))]
pub(crate) fn profile(
    value: f64,
    [low, high]: [f64; 2],
    scale: f64,
    (least, limit): (f64, f64),
    squares: &mut dyn FnMut(f64) -> Option<f64>,
) -> [f64; 2] {
    /// The farthest from the value, in ln of the distance to the bound, or in first steps.
    const FARTHEST: f64 = 14.0;
    let (is_above, is_below) = (low.is_finite() && high.is_infinite(), high.is_finite() && low.is_infinite());
    let distance = if is_above { value - low } else { high - value };
    let in_logarithm = (is_above || is_below) && 0.0 < distance;
    let at = |x: f64| match (in_logarithm, is_above) {
        (true, true) => low + distance * x.exp(),
        (true, false) => high - distance * x.exp(),
        _ => (value + scale * x).clamp(low, high),
    };
    let first = if in_logarithm { (scale / distance).clamp(1e-6, 1.0) } else { 1.0 };
    // √(S − S₀) is nearly linear in x.
    let target = (limit - least).sqrt();
    let mut end = |sign: f64| -> Option<f64> {
        let mut root = |x: f64| squares(at(sign * x)).map(|s| (s - least).max(0.0).sqrt() - target);
        let (mut inside, mut below) = (0.0, -target);
        let mut step = first;
        let (mut outside, mut above) = loop {
            let x = inside + step;
            if FARTHEST * if in_logarithm { 1.0 } else { 50.0 } < x {
                return None;
            }
            match root(x) {
                Some(found) if found < 0.0 => (inside, below) = (x, found),
                Some(found) => break (x, found),
                None => break (x, target),
            }
            if (at(sign * inside) - low).abs() <= 0.0 || (at(sign * inside) - high).abs() <= 0.0 {
                return None;
            }
            step *= 1.6;
        };
        for _ in 0..12 {
            if (outside - inside) <= 1e-4 * outside {
                break;
            }
            let share = (-below / (above - below)).clamp(0.05, 0.95);
            let x = inside + (outside - inside) * share;
            match root(x) {
                Some(found) if found < 0.0 => (inside, below) = (x, found),
                Some(found) => (outside, above) = (x, found),
                None => outside = x,
            }
        }
        Some(at(sign * outside))
    };
    let (a, b) = (end(-1.0), end(1.0));
    if in_logarithm && !is_above {
        // Towards the bound x falls and the value rises.
        [b.unwrap_or(low), a.unwrap_or(high)]
    } else {
        [a.unwrap_or(low), b.unwrap_or(high)]
    }
}

#[cfg(all(test, any(feature = "fluids", feature = "solids")))]
mod tests {
    use super::interval;

    #[test]
    fn an_interval_holds_those_of_the_distance_and_of_its_logarithm() {
        let e = core::f64::consts::E;
        let close = |found: [f64; 2], expected: [f64; 2]| {
            assert!(found.iter().zip(expected).all(|(x, y)| (x - y).abs() < 1e-15), "{found:?}, {expected:?}");
        };
        close(interval(2.0, [1.0, f64::INFINITY], 1.0), [1.0, 1.0 + e]);
        close(interval(-2.0, [f64::NEG_INFINITY, -1.0], 1.0), [-1.0 - e, -1.0]);
        close(interval(2.0, [1.0, f64::INFINITY], 1.5), [1.0, 3.5]);
        close(interval(2.0, [1.0, 2.5], 1.5), [1.0, 2.5]);
        close(interval(2.0, [f64::NEG_INFINITY, f64::INFINITY], 1.5), [0.5, 3.5]);
    }
}
