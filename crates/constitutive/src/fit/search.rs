//! The search for the parameters: Levenberg and Marquardt's, with the linear ones eliminated.
//!
//! ```text
//! S(θ) = Σ wᵢ² (Pᵢ(θ) − P̂ᵢ)²        θ = (c, α),   P = Φ(α) c
//! c(α) = argmin |W (Φ c − P̂)|  between bounds        J = (1 − Φ Φ⁺) W ∂P/∂α
//! ```
//! The gradient by that J is exact (G. H. Golub, V. Pereyra, 1973; L. Kaufman, 1975). What is searched for is only α.

use core::cell::Cell;

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, MinimizationReport, TerminationReason};
use nalgebra::{DMatrix, DVector};
use nalgebra_of_search as searched;
use piola_numerics::Gradient;

use super::model::Fitted;
use super::{Data, Model, Outcome, Parameter, Role, StableSign, linear, stability};

/// Parameters of one evaluation.
const CHUNK: usize = 4;

/// Everything that a search knows.
pub(super) struct Problem<'a, M> {
    pub(super) model: &'a M,
    pub(super) data: &'a Data,
    pub(super) parameters: Vec<Parameter>,
    /// wᵢ.
    pub(super) weights: Vec<f64>,
    /// The largest stress of all.
    pub(super) stress: f64,
    /// Whether the signs that make terms stable are kept.
    pub(super) signs: bool,
    pub(super) patience: usize,
    evaluations: Cell<usize>,
}

/// Where a search has come to.
#[derive(Clone, Debug)]
pub(super) struct Best {
    pub(super) parameters: Vec<f64>,
    /// S.
    pub(super) squares: f64,
    pub(super) outcome: Outcome,
}

impl<'a, M: Model> Problem<'a, M> {
    pub(super) fn new(
        model: &'a M,
        data: &'a Data,
        parameters: Vec<Parameter>,
        weights: Vec<f64>,
        signs: bool,
        patience: usize,
    ) -> Self {
        let stress = data.tests().iter().map(super::Test::largest_stress).fold(0.0, f64::max);
        Self { model, data, parameters, weights, stress, signs, patience, evaluations: Cell::new(0) }
    }

    /// Evaluations of all stresses so far.
    pub(super) fn evaluations(&self) -> usize {
        self.evaluations.get()
    }

    fn places(&self, role: Role) -> Vec<usize> {
        (0..self.parameters.len()).filter(|&k| self.parameters[k].role == role).collect()
    }

    fn observed(&self) -> DVector<f64> {
        let stresses = self.data.tests().iter().flat_map(super::Test::stresses);
        DVector::from_iterator(self.weights.len(), stresses.zip(&self.weights).map(|(stress, weight)| stress * weight))
    }

    /// wᵢ Pᵢ and their derivatives.
    pub(super) fn stresses(&self, theta: &[f64]) -> (DVector<f64>, DMatrix<f64>) {
        self.evaluations.set(self.evaluations.get() + 1);
        let rows = self.weights.len();
        let mut values = DVector::zeros(rows);
        let mut slopes = DMatrix::zeros(rows, theta.len());
        for begin in (0..theta.len()).step_by(CHUNK) {
            let lifted = theta.iter().enumerate().map(|(k, x)| {
                // Those of other chunks have a direction that no chunk has.
                Gradient::<f64, CHUNK>::variable(*x, if k < begin { CHUNK } else { k - begin })
            });
            let law = Fitted::trusted(self.model, lifted);
            let mut row = 0;
            for test in self.data.tests() {
                for point in 0..test.len() {
                    let stress = test.answer(point, &law);
                    values[row] = self.weights[row] * stress.value;
                    for k in begin..theta.len().min(begin + CHUNK) {
                        slopes[(row, k)] = self.weights[row] * stress.partials[k - begin];
                    }
                    row += 1;
                }
            }
        }
        (values, slopes)
    }

    /// The bounds of a parameter, those of stability included.
    pub(super) fn bounds(&self, k: usize, theta: &[f64]) -> [f64; 2] {
        let [low, high] = self.parameters[k].bounds;
        let (positive, negative) = ([low.max(0.0), high], [low, high.min(0.0)]);
        match self.parameters[k].stable {
            StableSign::NotNegative if self.signs => positive,
            StableSign::SameAs(j) if self.signs => {
                if 0.0 < theta[j] {
                    positive
                } else {
                    negative
                }
            }
            _ => [low, high],
        }
    }

    /// Sets the linear parameters to the best; the columns of those that no bound holds are an orthonormal basis.
    fn eliminate(&self, theta: &mut [f64], observed: &DVector<f64>) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let places = self.places(Role::Linear);
        if places.is_empty() {
            let (values, _) = self.stresses(theta);
            return Some((values - observed, DMatrix::zeros(observed.len(), 0)));
        }
        let bounds: Vec<[f64; 2]> = places.iter().map(|&k| self.bounds(k, theta)).collect();
        if bounds.iter().any(|[low, high]| high < low) {
            return None;
        }
        for &k in &places {
            theta[k] = 1.0;
        }
        let columns = self.stresses(theta).1.select_columns(&places);
        if columns.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let (solution, free) = linear::solve(&columns, observed, &bounds);
        for (&k, value) in places.iter().zip(solution.iter()) {
            theta[k] = *value;
        }
        Some((&columns * solution - observed, linear::range(&columns, &free)))
    }

    /// The best over all starts, and how many starts came to it; nothing if no start has finite stresses.
    pub(super) fn search(&self, starts: &[Vec<f64>]) -> Option<(Best, usize)> {
        let searched = self.places(Role::Nonlinear);
        let observed = self.observed();
        let starts = if searched.is_empty() { vec![Vec::new()] } else { starts.to_vec() };
        let mut found: Vec<Best> = Vec::new();
        for start in &starts {
            let mut theta = vec![1.0; self.parameters.len()];
            for (&k, value) in searched.iter().zip(start) {
                theta[k] = value.clamp(self.parameters[k].bounds[0], self.parameters[k].bounds[1]);
            }
            if searched.is_empty() {
                let (residuals, _) = self.eliminate(&mut theta, &observed)?;
                let outcome = Outcome::LinearSolution;
                found.push(Best { parameters: theta, squares: residuals.norm_squared(), outcome });
                continue;
            }
            let inner = searched.iter().map(|&k| self.inward(k, theta[k]));
            let x = searched::DVector::from_iterator(searched.len(), inner);
            let target = Separable { problem: self, searched: &searched, observed: &observed, theta, x, state: None };
            found.extend(target.run());
        }
        let best = found.iter().min_by(|a, b| a.squares.total_cmp(&b.squares))?.clone();
        let agree = found.iter().filter(|other| other.squares <= best.squares * (1.0 + 1e-6)).count();
        Some((best, agree))
    }

    /// Whether every factor is zero, and the law with them.
    pub(super) fn has_no_stiffness(&self, best: &Best) -> bool {
        let places = self.places(Role::Linear);
        !places.is_empty() && places.into_iter().all(|k| best.parameters[k].abs() <= 0.0)
    }

    /// A search over all parameters at once, with what Drucker's condition lacks added to the residuals.
    pub(super) fn stabilise(&self, best: &Best, fan: &[[f64; 3]]) -> Option<Best> {
        let observed = self.observed();
        let mut theta = best.parameters.clone();
        let mut found = None;
        // From soft to hard, until nothing is lacking.
        for power in 0..7 {
            let hardness = 10_f64.powi(power);
            let inner = (0..theta.len()).map(|k| self.inward(k, theta[k]));
            let x = searched::DVector::from_iterator(theta.len(), inner);
            let start = theta.clone();
            let target = Penalised { problem: self, observed: &observed, fan, hardness, theta: start, x, state: None };
            let reached = target.run()?;
            let (values, _) = self.stresses(&reached.parameters);
            let squares = (values - &observed).norm_squared();
            theta.clone_from(&reached.parameters);
            let lacking = fan.iter().any(|point| stability::least_modulus(self.model, *point, &theta) <= 0.0);
            found = Some(Best { squares, ..reached });
            if !lacking {
                break;
            }
        }
        found
    }

    /// The unbounded coordinate of a parameter.
    fn inward(&self, k: usize, value: f64) -> f64 {
        let least = 1e-6 * if self.parameters[k].is_stress { self.stress } else { 1.0 };
        match self.parameters[k].bounds {
            [low, high] if low.is_finite() && high.is_finite() => {
                let half = 0.5 * (high - low);
                if 0.0 < half { ((value - low) / half - 1.0).clamp(-0.999, 0.999).asin() } else { 0.0 }
            }
            [low, _] if low.is_finite() => (value - low).max(least).ln(),
            [_, high] if high.is_finite() => (high - value).max(least).ln(),
            _ => value,
        }
    }

    /// The parameter of an unbounded coordinate, and its derivative.
    fn outward(&self, k: usize, x: f64) -> (f64, f64) {
        match self.parameters[k].bounds {
            [low, high] if low.is_finite() && high.is_finite() => {
                let half = 0.5 * (high - low);
                (low + half * (1.0 + x.sin()), half * x.cos())
            }
            [low, _] if low.is_finite() => (low + x.exp(), x.exp()),
            [_, high] if high.is_finite() => (high - x.exp(), -x.exp()),
            _ => (x, 1.0),
        }
    }

    fn minimiser(&self) -> LevenbergMarquardt<f64> {
        LevenbergMarquardt::new().with_ftol(1e-14).with_xtol(1e-12).with_gtol(1e-12).with_patience(self.patience)
    }
}

fn outcome(report: &MinimizationReport<f64>) -> Outcome {
    match report.termination {
        TerminationReason::ResidualsZero => Outcome::ExactFit,
        TerminationReason::Orthogonal => Outcome::GradientZero,
        TerminationReason::Converged { .. } | TerminationReason::NoImprovementPossible(_) => Outcome::NoFurtherDecrease,
        TerminationReason::LostPatience => Outcome::OutOfPatience,
        _ => Outcome::NotFinite,
    }
}

/// Residuals of a point without finite stresses: the step there is taken back.
fn refused(rows: usize) -> searched::DVector<f64> {
    searched::DVector::from_element(rows, 1e100)
}

fn to_search(matrix: &DMatrix<f64>) -> searched::DMatrix<f64> {
    searched::DMatrix::from_column_slice(matrix.nrows(), matrix.ncols(), matrix.as_slice())
}

type Dynamic = searched::Dyn;
type Column = searched::Owned<f64, Dynamic>;
type Rectangle = searched::Owned<f64, Dynamic, Dynamic>;

/// The search for α alone.
struct Separable<'p, 'a, M> {
    problem: &'p Problem<'a, M>,
    searched: &'p [usize],
    observed: &'p DVector<f64>,
    theta: Vec<f64>,
    x: searched::DVector<f64>,
    /// Residuals and basis at x.
    state: Option<(DVector<f64>, DMatrix<f64>)>,
}

impl<M: Model> Separable<'_, '_, M> {
    fn rows(&self) -> usize {
        self.observed.len()
    }

    fn run(mut self) -> Option<Best> {
        let minimiser = self.problem.minimiser();
        let x = self.x.clone();
        self.set_params(&x);
        self.state.as_ref()?;
        let (mut end, report) = minimiser.minimize(self);
        let x = end.x.clone();
        end.set_params(&x);
        let (residuals, _) = end.state?;
        let squares = residuals.norm_squared();
        squares.is_finite().then_some(Best { parameters: end.theta, squares, outcome: outcome(&report) })
    }
}

impl<M: Model> LeastSquaresProblem<f64, Dynamic, Dynamic> for Separable<'_, '_, M> {
    type ResidualStorage = Column;
    type JacobianStorage = Rectangle;
    type ParameterStorage = Column;

    fn set_params(&mut self, x: &searched::DVector<f64>) {
        self.x.copy_from(x);
        for (index, &k) in self.searched.iter().enumerate() {
            self.theta[k] = self.problem.outward(k, x[index]).0;
        }
        self.state = self.problem.eliminate(&mut self.theta, self.observed);
    }

    fn params(&self) -> searched::DVector<f64> {
        self.x.clone()
    }

    fn residuals(&self) -> Option<searched::DVector<f64>> {
        Some(match &self.state {
            Some((residuals, _)) => searched::DVector::from_column_slice(residuals.as_slice()),
            None => refused(self.rows()),
        })
    }

    fn jacobian(&self) -> Option<searched::DMatrix<f64>> {
        let (_, basis) = self.state.as_ref()?;
        let mut slopes = self.problem.stresses(&self.theta).1.select_columns(self.searched);
        for (index, &k) in self.searched.iter().enumerate() {
            let slope = self.problem.outward(k, self.x[index]).1;
            slopes.column_mut(index).scale_mut(slope);
        }
        let within = basis.tr_mul(&slopes);
        Some(to_search(&(slopes - basis * within)))
    }
}

/// The search for all parameters under a penalty.
struct Penalised<'p, 'a, M> {
    problem: &'p Problem<'a, M>,
    observed: &'p DVector<f64>,
    fan: &'p [[f64; 3]],
    hardness: f64,
    theta: Vec<f64>,
    x: searched::DVector<f64>,
    state: Option<(DVector<f64>, DMatrix<f64>)>,
}

impl<M: Model> Penalised<'_, '_, M> {
    /// The least modulus that is asked for, as a part of the largest stress.
    const MARGIN: f64 = 1e-3;

    fn rows(&self) -> usize {
        self.observed.len() + self.fan.len()
    }

    fn run(mut self) -> Option<Best> {
        let minimiser = self.problem.minimiser();
        let x = self.x.clone();
        self.set_params(&x);
        self.state.as_ref()?;
        let (mut end, report) = minimiser.minimize(self);
        let x = end.x.clone();
        end.set_params(&x);
        let (residuals, _) = end.state?;
        Some(Best { parameters: end.theta, squares: residuals.norm_squared(), outcome: outcome(&report) })
    }

    /// Residuals of the data, then of Drucker's condition.
    fn evaluate(&self) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let (values, slopes) = self.problem.stresses(&self.theta);
        let (rows, unknowns) = (values.len(), self.theta.len());
        let mut residuals = DVector::zeros(rows + self.fan.len());
        let mut jacobian = DMatrix::zeros(rows + self.fan.len(), unknowns);
        residuals.rows_mut(0, rows).copy_from(&(values - self.observed));
        jacobian.rows_mut(0, rows).copy_from(&slopes);
        for begin in (0..unknowns).step_by(CHUNK) {
            let lifted: Vec<_> = self
                .theta
                .iter()
                .enumerate()
                .map(|(k, x)| Gradient::<f64, CHUNK>::variable(*x, if k < begin { CHUNK } else { k - begin }))
                .collect();
            for (index, point) in self.fan.iter().enumerate() {
                let modulus = stability::least_modulus(self.problem.model, *point, &lifted);
                let lacking = Self::MARGIN - modulus.value / self.problem.stress;
                if lacking.is_nan() || 0.0 < lacking {
                    residuals[rows + index] = self.hardness * lacking;
                    for k in begin..unknowns.min(begin + CHUNK) {
                        let slope = modulus.partials[k - begin] / self.problem.stress;
                        jacobian[(rows + index, k)] = -self.hardness * slope;
                    }
                }
            }
        }
        for k in 0..unknowns {
            let slope = self.problem.outward(k, self.x[k]).1;
            jacobian.column_mut(k).scale_mut(slope);
        }
        residuals.iter().all(|x| x.is_finite()).then_some((residuals, jacobian))
    }
}

impl<M: Model> LeastSquaresProblem<f64, Dynamic, Dynamic> for Penalised<'_, '_, M> {
    type ResidualStorage = Column;
    type JacobianStorage = Rectangle;
    type ParameterStorage = Column;

    fn set_params(&mut self, x: &searched::DVector<f64>) {
        self.x.copy_from(x);
        for k in 0..self.theta.len() {
            self.theta[k] = self.problem.outward(k, x[k]).0;
        }
        self.state = self.evaluate();
    }

    fn params(&self) -> searched::DVector<f64> {
        self.x.clone()
    }

    fn residuals(&self) -> Option<searched::DVector<f64>> {
        Some(match &self.state {
            Some((residuals, _)) => searched::DVector::from_column_slice(residuals.as_slice()),
            None => refused(self.rows()),
        })
    }

    fn jacobian(&self) -> Option<searched::DMatrix<f64>> {
        let (_, jacobian) = self.state.as_ref()?;
        Some(to_search(jacobian))
    }
}
