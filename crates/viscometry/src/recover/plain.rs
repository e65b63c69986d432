//! A smooth curve close to ln y over ln x of one of several tables that are corrected together.
//!
//! ```text
//! minimise Σ (yᵢ − f(uᵢ))² + λ ∫ f″² du      λ: least  n RSS/(n − 1.4 ν)²,   ν = trace of the smoother
//!                                             or, with a known σ, least  RSS + 2 σ² ν
//! ```
//! The covariance of the coefficients is that of Bayes' posterior with λ ∫f″² as prior, which holds the bias of smoothing too
//! (G. Wahba, 1983). Single tables are smoothed along the curve instead (`smoother`).

use nalgebra::{DMatrix, DVector};

use super::smoothing::{Criterion, Fitted, Smoothing};
use super::splines::Splines;

/// Splines of a smoothed curve, at most.
const MOST: usize = 48;

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

/// Rows (first column, values) of A and a right side, gathered by ranges of columns.
///
/// R of [A b] = Q R, its last column Qᵀ b, and the length of the rest of b: of rows that come sorted, and in memory that does not grow with
/// their number.
#[derive(Debug)]
struct Gathered {
    columns: usize,
    /// R with Qᵀ b as its last column.
    triangle: DMatrix<f64>,
    waiting: Vec<Vec<f64>>,
    /// The squared length of the right side beyond all columns.
    beyond: f64,
}

/// Rows that are gathered at once.
const AT_ONCE: usize = 256;

impl Gathered {
    fn new(columns: usize) -> Self {
        Self { columns, triangle: DMatrix::zeros(0, columns + 1), waiting: Vec::new(), beyond: 0.0 }
    }

    fn add(&mut self, first: usize, values: &[f64], right: f64) {
        let mut row = vec![0.0; self.columns + 1];
        row[first..first + values.len()].copy_from_slice(values);
        row[self.columns] = right;
        self.waiting.push(row);
        if AT_ONCE <= self.waiting.len() {
            self.gather();
        }
    }

    fn gather(&mut self) {
        let (old, new) = (self.triangle.nrows(), self.waiting.len());
        let stack = DMatrix::from_fn(old + new, self.columns + 1, |i, j| {
            if i < old { self.triangle[(i, j)] } else { self.waiting[i - old][j] }
        });
        self.waiting.clear();
        self.triangle = stack.qr().r();
        let corner = self.triangle.nrows();
        if self.columns < corner {
            self.beyond += self.triangle[(self.columns, self.columns)].powi(2);
            self.triangle = self.triangle.rows(0, self.columns).into_owned();
        }
    }

    /// R, Qᵀ b and |b|² beyond; `None` for fewer rows than columns.
    fn finish(mut self) -> Option<(DMatrix<f64>, Vec<f64>, f64)> {
        if !self.waiting.is_empty() {
            self.gather();
        }
        if self.triangle.nrows() < self.columns {
            return None;
        }
        let right = self.triangle.column(self.columns).iter().copied().collect();
        Some((self.triangle.columns(0, self.columns).into_owned(), right, self.beyond))
    }
}
