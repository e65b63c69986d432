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
        let scaled = DMatrix::from_fn(slopes.nrows(), kept.len(), |i, k| slopes[(i, free[kept[k]])] / sizes[kept[k]]);
        let svd = scaled.svd(false, true);
        let Some(directions) = svd.v_t else { return none };
        let threshold = f64::EPSILON * slopes.nrows() as f64 * svd.singular_values.max();
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

/// value ± t error.
#[cfg(any(feature = "fluids", feature = "solids"))]
pub(crate) fn interval(value: f64, standard_error: Option<f64>, quantile: Option<f64>) -> Option<[f64; 2]> {
    standard_error.zip(quantile).map(|(error, t)| [value - t * error, value + t * error])
}
