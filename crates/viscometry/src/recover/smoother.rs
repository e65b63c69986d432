//! The smooth rising curve close to noisy rows, and the covariance of its parameters.
//!
//! ```text
//! minimise Σ (yᵢ − y(uᵢ))² + λ ∫ (dᵐθ/dtᵐ)² dt     m = 1: a power law costs nothing; m = 2: nor does a yield stress, far from the bend
//! λ, m: least  n RSS/(n − 1.4 ν)²,  ν = tr S       or, with a known σ, least  RSS + 2 σ² ν
//! ```
//! The penalty of the curve is a step below this λ: what smoothing misses is then less beside what scatters.
//!
//! S is the linearised smoother. Smoothing pulls the curve towards a power law. A second fit, whose penalty is on the change from the
//! first, corrects this bias to its second order: (I − S)² y in place of (I − S) y. The covariance is that of this second curve, σ² S₂ S₂ᵀ with
//! S₂ = 2 S − S², so that bands are as wide as the curve scatters (S. Calonico, M. D. Cattaneo, M. H. Farrell, 2018). 1.4 makes
//! generalised cross-validation undersmooth less often (Y.-J. Kim, C. Gu, 2004).

use std::sync::Arc;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::log_slope::{DEGREE, LogSlope, Panels};
use super::smoothing::{Criterion, Smoothing};
use super::splines::Splines;

/// Splines of θ, at least and at most.
const SPLINES: [usize; 2] = [4, 28];
/// Rows that are smoothed one by one; of more, neighbours are gathered in groups within this part of the range of ln drive.
const ROWS: usize = 2048;
/// λ in steps from least to most, over what makes penalty and data alike.
const LADDER: core::ops::RangeInclusive<i32> = -40..=40;
/// Steps of the ladder for a factor of e.
const STEPS: f64 = 2.0;
/// The curve is rougher than the criterion's by so many steps: what smoothing misses is then less beside what scatters.
const UNDER: i32 = 1;
/// Cost of a degree of freedom.
const COST: f64 = 1.4;

/// A penalised fit with what its errors follow from.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Penalised {
    pub(super) curve: LogSlope,
    pub(super) smoothing: Smoothing,
    /// The parameters are independent columns of it times normal numbers.
    pub(super) root: DMatrix<f64>,
    /// Degrees of freedom of the noise; infinite where it is known.
    pub(super) freedom: f64,
}

/// The criterion's choice.
#[derive(Clone, Debug)]
pub(super) struct Choice {
    order: usize,
    rung: i32,
    parameters: DVector<f64>,
    score: f64,
    /// The standard deviation of the residuals.
    noise: f64,
}

/// Rows and splines.
#[derive(Debug)]
pub(super) struct Smoother {
    u: Vec<f64>,
    y: Vec<f64>,
    /// √ of the number of rows in each group.
    weights: Vec<f64>,
    rows: f64,
    /// The squares within groups.
    within: f64,
    /// The noise of the rows, known or estimated from their differences.
    level: f64,
    known: Option<f64>,
    splines: Splines,
    panels: Arc<Panels>,
    anchor: usize,
    start: DVector<f64>,
    /// The trace of `JᵀJ` at the start.
    size: f64,
}

/// The linearised problem at some parameters.
struct Linear {
    /// `JᵀJ` and `Jᵀr`.
    normal: DMatrix<f64>,
    right: DVector<f64>,
    /// The squares of the residuals.
    squares: f64,
}

/// Of some rows, their mean.
fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The sizes of the groups of rows. Near a yield stress ln response bends within few rows of a table that is even in the drive: the mean over
/// equal parts of ln drive does not smooth the bend away.
fn groups(u: &[f64]) -> Vec<usize> {
    if u.len() <= ROWS {
        return vec![1; u.len()];
    }
    let (width, most) = ((u[u.len() - 1] - u[0]) / ROWS as f64, u.len().div_ceil(ROWS / 4));
    let mut sizes = Vec::new();
    let mut first = 0;
    for (row, x) in u.iter().enumerate().skip(1) {
        if width <= x - u[first] || most <= row - first {
            sizes.push(row - first);
            first = row;
        }
    }
    sizes.push(u.len() - first);
    sizes
}

/// J Jᵀ: half the work of a product of two matrices.
fn square(jacobian: &DMatrix<f64>) -> DMatrix<f64> {
    let rows = jacobian.nrows();
    let mut sums = vec![0.0; rows * rows];
    for column in jacobian.as_slice().chunks_exact(rows) {
        for (k, (factor, sums)) in column.iter().zip(sums.chunks_exact_mut(rows)).enumerate() {
            for (sum, entry) in sums[k..].iter_mut().zip(&column[k..]) {
                *sum += factor * entry;
            }
        }
    }
    let mut square = DMatrix::from_vec(rows, rows, sums);
    square.fill_upper_triangle_with_lower_triangle();
    square
}

/// A Cholesky factor of a matrix, made a little more definite if it has none.
fn factor(mut matrix: DMatrix<f64>) -> Option<Cholesky<f64, Dyn>> {
    let diagonal = matrix.diagonal();
    let mut more = 1e-14;
    for _ in 0..8 {
        if let Some(found) = Cholesky::new(matrix.clone()) {
            return Some(found);
        }
        for (k, value) in diagonal.iter().enumerate() {
            matrix[(k, k)] += more * value.abs().max(f64::MIN_POSITIVE);
        }
        more *= 30.0;
    }
    None
}

impl Smoother {
    /// Of ln drive, rising, and ln response with a noise of `level`, which is known or estimated. `None` where no curve follows.
    pub(super) fn new(u: &[f64], y: &[f64], level: f64, is_known: bool) -> Option<Self> {
        let sizes = groups(u);
        let grouped = |values: &[f64]| -> Vec<f64> {
            let mut from = 0;
            let group = |size: &usize| {
                from += size;
                mean(&values[from - size..from])
            };
            sizes.iter().map(group).collect()
        };
        let [groups_u, groups_y] = [grouped(u), grouped(y)];
        let weights = sizes.iter().map(|size| (*size as f64).sqrt()).collect();
        let within = level * level * (u.len() - groups_u.len()) as f64;
        let t: Vec<f64> = groups_u.iter().zip(&groups_y).map(|(u, y)| 0.5 * (u + y)).collect();
        let (low, high) =
            t.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), t| (low.min(*t), high.max(*t)));
        let margin = 0.05 * (high - low) + 4.0 * level;
        let count = (groups_u.len() - 1).clamp(SPLINES[0], SPLINES[1]);
        let (low, width) = (low - margin, high - low + 2.0 * margin);
        let knots: Vec<f64> = (0..count).map(|k| low + width * k as f64 / (count - 1) as f64).collect();
        let splines = Splines::on(&knots, DEGREE);
        let panels = Arc::new(Panels::of(&splines));
        let mut smoother = Self {
            u: groups_u,
            y: groups_y,
            weights,
            rows: u.len() as f64,
            within,
            level,
            known: is_known.then_some(level),
            splines,
            panels,
            anchor: 0,
            start: DVector::zeros(count + 1),
            size: 0.0,
        };
        smoother.begin(level, width)?;
        smoother.size = smoother.linear(&smoother.start).normal.trace();
        Some(smoother)
    }

    /// The parameters of a curve near the rows, by slopes between rows apart.
    fn begin(&mut self, level: f64, width: f64) -> Option<()> {
        /// Slopes, at least.
        const APART: f64 = 16.0;
        let rows = self.u.len();
        let span = self.u[rows - 1] - self.u[0];
        let (mut slopes, mut from) = (Vec::new(), 0);
        for to in 1..rows {
            let [u, y] = [self.u[to] - self.u[from], self.y[to] - self.y[from]];
            if 3.0 * level < y && width < APART * 0.5 * (u + y) || span < APART * u || to + 1 == rows {
                let middle = 0.25 * (self.u[to] + self.u[from] + self.y[to] + self.y[from]);
                slopes.push((middle, (y.max(0.3 * level) / u).ln()));
                from = to;
            }
        }
        let count = self.splines.count();
        let stiffness = slopes.len() as f64 / width * (width / 8.0).powi(4);
        let (mut normal, mut right) = (stiffness * self.splines.roughness(2), DVector::zeros(count));
        for (t, theta) in &slopes {
            let (first, values) = self.splines.values(*t);
            for i in 0..=self.splines.degree() {
                right[first + i] += values[i] * theta;
                for j in 0..=self.splines.degree() {
                    normal[(first + i, first + j)] += values[i] * values[j];
                }
            }
        }
        let coefficients = factor(normal)?.solve(&right);
        let thetas = |t: &f64| self.splines.sum(coefficients.as_slice(), *t)[0];
        let at = |panel: &usize| thetas(&self.panels.from(*panel));
        self.anchor = (0..self.panels.len()).max_by(|i, j| at(i).total_cmp(&at(j)))?;
        self.start.rows_mut(1, count).copy_from(&coefficients);
        // u at the anchor: the rows' errors in y are least.
        let middle = 0.5 * (self.u[rows - 1] + self.u[0]);
        self.start[0] = middle;
        for _ in 0..4 {
            let curve = self.curve(&self.start);
            let (mut errors, mut squares) = (0.0, 0.0);
            for (u, y) in self.u.iter().zip(&self.y) {
                let [value, slope, ..] = curve.at(*u);
                errors += (value - y) * (1.0 + slope);
                squares += (1.0 + slope) * (1.0 + slope);
            }
            self.start[0] += errors / squares;
        }
        self.start.iter().all(|x| x.is_finite()).then_some(())
    }

    fn curve(&self, parameters: &DVector<f64>) -> LogSlope {
        LogSlope::new(&self.panels, self.anchor, parameters.as_slice())
    }

    /// ∫ (dᵐθ/dtᵐ)² dt of the parameters.
    fn penalty(&self, order: usize) -> DMatrix<f64> {
        let count = self.splines.count();
        let mut penalty = DMatrix::zeros(count + 1, count + 1);
        penalty.view_mut((1, 1), (count, count)).copy_from(&self.splines.roughness(order));
        penalty
    }

    fn squares(&self, parameters: &DVector<f64>) -> f64 {
        let curve = self.curve(parameters);
        let rows = self.u.iter().zip(&self.y).zip(&self.weights);
        rows.map(|((u, y), weight)| (weight * (y - curve.at(*u)[0])).powi(2)).sum()
    }

    /// The derivatives of the weighted values with respect to the parameters, and the weighted residuals.
    fn derivatives(&self, parameters: &DVector<f64>) -> (DMatrix<f64>, DVector<f64>) {
        let curve = self.curve(parameters);
        let mut jacobian = DMatrix::zeros(parameters.len(), self.u.len());
        let mut residuals = DVector::zeros(self.u.len());
        for (i, ((u, y), weight)) in self.u.iter().zip(&self.y).zip(&self.weights).enumerate() {
            let mut column = jacobian.column_mut(i);
            residuals[i] = weight * (y - curve.accumulate_value(column.as_mut_slice(), *weight, *u));
        }
        (jacobian, residuals)
    }

    fn linear(&self, parameters: &DVector<f64>) -> Linear {
        let (jacobian, residuals) = self.derivatives(parameters);
        Linear { normal: square(&jacobian), right: &jacobian * &residuals, squares: residuals.norm_squared() }
    }

    /// Levenberg and Marquardt's steps, at most so many, from some parameters; the penalty is on the change from a centre.
    fn descend(
        &self,
        from: &DVector<f64>,
        centre: Option<&DVector<f64>>,
        penalty: &DMatrix<f64>,
        most: usize,
    ) -> DVector<f64> {
        let change = |x: &DVector<f64>| centre.map_or_else(|| x.clone(), |centre| x - centre);
        let cost = |x: &DVector<f64>, squares: f64| {
            let change = change(x);
            squares + change.dot(&(penalty * &change))
        };
        let mut x = from.clone();
        let mut damping = 1e-6;
        for _ in 0..most {
            let Linear { normal, right, squares } = self.linear(&x);
            let now = cost(&x, squares);
            let down = right - penalty * change(&x);
            let matrix = normal + penalty;
            let mut moved = None;
            for _ in 0..12 {
                let mut damped = matrix.clone();
                for k in 0..damped.nrows() {
                    damped[(k, k)] *= 1.0 + damping;
                }
                let Some(step) = factor(damped).map(|factor| factor.solve(&down)) else { break };
                let next = &x + &step;
                let found = cost(&next, self.squares(&next));
                if found <= now {
                    moved = Some((next, found));
                    damping = (0.1 * damping).max(1e-12);
                    break;
                }
                damping = (10.0 * damping).max(1e-4);
            }
            let Some((next, found)) = moved else { break };
            x = next;
            if now - found <= 1e-8 * now {
                break;
            }
        }
        x
    }

    fn parameter(&self, rung: i32, penalty: &DMatrix<f64>) -> f64 {
        (f64::from(rung) / STEPS).exp() * self.size / penalty.trace()
    }

    /// The score of RSS and ν.
    fn score(&self, squares: f64, freedom: f64) -> f64 {
        match self.known {
            Some(noise) => squares + 2.0 * noise * noise * freedom,
            None if self.rows <= COST * freedom => f64::INFINITY,
            None => squares / (self.rows - COST * freedom).powi(2),
        }
    }

    /// The best rung of the problem that is linearised at some parameters, with its score.
    fn best_rung(&self, x: &DVector<f64>, penalty: &DMatrix<f64>, rung: i32, order: usize) -> Option<(i32, f64)> {
        let Linear { normal, right, squares } = self.linear(x);
        let scale = self.parameter(0, penalty);
        let now = scale * (f64::from(rung) / STEPS).exp();
        // Coordinates in which the data's form is diagonal and it and the penalty's add up to one.
        let lower = factor(&normal + now * penalty)?.unpack();
        let half = lower.solve_lower_triangular(&normal)?;
        let both = lower.solve_lower_triangular(&half.transpose())?;
        let eigen = (0.5 * (&both + both.transpose())).symmetric_eigen();
        let mut places: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        places.sort_by(|&i, &j| eigen.eigenvalues[j].total_cmp(&eigen.eigenvalues[i]));
        // Data that are reached from zero: r + J x.
        let right = &right + &normal * x;
        let all = squares + 2.0 * (&right - &normal * x).dot(x) + x.dot(&(&normal * x));
        let data = eigen.eigenvectors.tr_mul(&lower.solve_lower_triangular(&right)?);
        let score = |rung: i32| {
            let ratio = scale * (f64::from(rung) / STEPS).exp() / now;
            let (mut left, mut freedom) = (all, 0.0);
            for (k, &place) in places.iter().enumerate() {
                let told = if k <= order { 1.0 } else { eigen.eigenvalues[place].clamp(0.0, 1.0) };
                let full = told + ratio * (1.0 - told);
                let value = data[place] / full;
                left += value * (told * value - 2.0 * data[place]);
                freedom += told / full;
            }
            self.score(left.max(0.0) + self.within, freedom)
        };
        LADDER.map(|rung| (rung, score(rung))).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The choice of the criterion with this order of the penalty, found from a rung on.
    fn of_order(&self, order: usize, first: i32) -> Option<Choice> {
        let penalty = self.penalty(order);
        let scale = self.parameter(0, &penalty);
        let at = |rung: i32| &penalty * (scale * (f64::from(rung) / STEPS).exp());
        let mut rung = first;
        let mut x = self.descend(&self.start, None, &at(rung), 4);
        for turn in 0..16 {
            let (best, _) = self.best_rung(&x, &penalty, rung, order)?;
            let next = best.clamp(rung - 10, rung + 10);
            x = self.descend(&x, None, &at(next), 2);
            if next == rung && 2 < turn {
                break;
            }
            rung = next;
        }
        x = self.descend(&x, None, &at(rung), 20);
        let linear = self.linear(&x);
        let freedom = factor(&linear.normal + at(rung))?.solve(&linear.normal).trace();
        let squares = linear.squares + self.within;
        let score = self.score(squares, freedom);
        Some(Choice { order, rung, parameters: x, score, noise: (squares / (self.rows - freedom).max(1.0)).sqrt() })
    }

    /// The choice of the criterion. Where it leaves more than the rows scatter, the search has ended in a minimum that is not the least: it
    /// begins again from rougher and smoother curves.
    pub(super) fn choose(&self) -> Option<Choice> {
        const FIRST: i32 = -8;
        const OTHERS: [i32; 3] = [0, -20, -30];
        /// Residuals over the scatter, at most.
        const LEFT: f64 = 1.5;
        let from = |first: i32| [1, 2].into_iter().filter_map(move |order| self.of_order(order, first));
        let better = |a: &Choice, b: &Choice| a.score.total_cmp(&b.score);
        let found = from(FIRST).min_by(better);
        if found.as_ref().is_some_and(|found| found.noise <= LEFT * self.level) {
            return found;
        }
        found.into_iter().chain(OTHERS.into_iter().flat_map(from)).min_by(better)
    }

    /// The next rung up, if there is one.
    pub(super) fn smoother(&self, choice: &Choice) -> Option<Choice> {
        let rung = choice.rung + 1;
        LADDER.contains(&rung).then(|| {
            let penalty = self.penalty(choice.order);
            let parameters = self.descend(&choice.parameters, None, &(&penalty * self.parameter(rung, &penalty)), 20);
            Choice { rung, parameters, ..choice.clone() }
        })
    }

    /// The fit at a choice, its bias corrected.
    pub(super) fn fit(&self, choice: &Choice, raised: bool) -> Option<Penalised> {
        let penalty = self.penalty(choice.order);
        let parameter = self.parameter(choice.rung - UNDER, &penalty);
        let penalty = parameter * penalty;
        let first = self.descend(&choice.parameters, None, &penalty, 20);
        let x = self.descend(&first, Some(&first), &penalty, 20);
        let (jacobian, residuals) = self.derivatives(&x);
        let normal = square(&jacobian);
        let factor = factor(&normal + &penalty)?;
        let once = factor.solve(&normal);
        let square = &once * &once;
        let freedom = 2.0 * once.trace() - square.trace();
        // tr (I − S)⁴.
        let left = self.rows - 4.0 * once.trace() + 6.0 * square.trace() - 4.0 * (&square * &once).trace()
            + (&square * &square).trace();
        let left = left.max(1.0);
        let noise = self.known.unwrap_or_else(|| ((residuals.norm_squared() + self.within) / left).sqrt());
        let solved = factor.solve(&jacobian);
        let root = noise * (2.0 * &solved - &once * &solved);
        let criterion =
            if self.known.is_some() { Criterion::KnownNoise } else { Criterion::GeneralisedCrossValidation };
        let smoothing = Smoothing { criterion, noise, parameter, degrees_of_freedom: freedom, raised };
        let freedom = if self.known.is_some() { f64::INFINITY } else { left };
        Some(Penalised { curve: self.curve(&x), smoothing, root, freedom })
    }
}
