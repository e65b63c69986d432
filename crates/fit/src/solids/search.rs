//! The search for the parameters: Levenberg and Marquardt's, with the linear ones eliminated.
//!
//! ```text
//! S(θ) = Σ wᵢ² (Pᵢ(θ) − P̂ᵢ)²        θ = (c, α),   P = Φ(α) c
//! c(α) = argmin |W (Φ c − P̂)|  between bounds        J = (1 − Φ Φ⁺) W ∂P/∂α
//! ```
//! The gradient by that J is exact (G. H. Golub, V. Pereyra, 1973; L. Kaufman, 1975). What is searched for is only α.

use core::cell::Cell;

use nalgebra::{DMatrix, DVector};
use piola_numerics::Gradient;

use super::model::Fitted;
use super::{Data, Model, Outcome, Parameter, Role, StableSign, linear, stability};
use crate::anew::Change;
use crate::search::{End, Misfit, Range, minimise};

/// Parameters of one evaluation.
const CHUNK: usize = 4;

/// The model, data and bounds of a search.
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
    /// What is added to the weighted residuals, if anything.
    shift: Vec<f64>,
    /// Whether the search shall end.
    pub(super) stop: &'a dyn Fn() -> bool,
    evaluations: &'a Cell<usize>,
}

/// The end of a search.
#[derive(Clone, Debug)]
pub(super) struct Best {
    pub(super) parameters: Vec<f64>,
    /// S.
    pub(super) squares: f64,
    pub(super) outcome: Outcome,
}

impl<'a, M: Model> Problem<'a, M> {
    pub(super) fn new(
        (model, data): (&'a M, &'a Data),
        parameters: Vec<Parameter>,
        (weights, stress): (Vec<f64>, f64),
        signs: bool,
        patience: usize,
        (stop, evaluations): (&'a dyn Fn() -> bool, &'a Cell<usize>),
    ) -> Self {
        Self { model, data, parameters, weights, stress, signs, patience, shift: Vec::new(), stop, evaluations }
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
        let weighted = stresses.zip(&self.weights).map(|(stress, weight)| stress * weight);
        let mut observed = DVector::from_iterator(self.weights.len(), weighted);
        observed.iter_mut().zip(&self.shift).for_each(|(observed, shift)| *observed -= shift);
        observed
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
            let x = searched.iter().map(|&k| self.range(k).inward(theta[k])).collect();
            let target = Separable { problem: self, searched: &searched, observed: &observed, theta };
            let end = minimise(target, x, self.patience, self.stop);
            found.extend(end.map(Best::from).filter(|best| best.squares.is_finite()));
        }
        let best = found.iter().min_by(|a, b| a.squares.total_cmp(&b.squares))?.clone();
        // Of an exact fit only rounding is left.
        let rounding = 1e-26 * observed.norm_squared();
        let agree = found.iter().filter(|other| other.squares <= best.squares * (1.0 + 1e-6) + rounding).count();
        Some((best, agree))
    }

    /// Whether every factor is zero, and the law with them.
    pub(super) fn has_no_stiffness(&self, best: &Best) -> bool {
        let places = self.places(Role::Linear);
        !places.is_empty() && places.into_iter().all(|k| best.parameters[k].abs() <= 0.0)
    }

    /// A search over all parameters at once, with what Drucker's condition lacks added to the residuals.
    pub(super) fn stabilise(&self, best: &Best, fan: &Fan) -> Option<Best> {
        let all = self.observed();
        let (fixed, observed) = match self.fixed(fan) {
            // The same sums of squares but for a constant, with as many rows as parameters.
            Some(Fixed { stresses, moduli }) if 4 * (stresses.ncols() + 1) < stresses.nrows() => {
                let (stresses, observed) = linear::compressed(&stresses, &all);
                (Some(Fixed { stresses, moduli }), observed)
            }
            fixed => (fixed, all.clone()),
        };
        let mut theta = best.parameters.clone();
        let mut found = None;
        // From soft to hard, until nothing is lacking.
        for power in 0..7 {
            let hardness = 10_f64.powi(power);
            let x = (0..theta.len()).map(|k| self.range(k).inward(theta[k])).collect();
            let (observed, fixed) = (&observed, fixed.as_ref());
            let target = Penalised { problem: self, observed, fan, fixed, hardness, theta: theta.clone() };
            // Where nothing but factors is searched for, an evaluation costs next to nothing.
            let patience = if fixed.is_some() { 50 * self.patience } else { self.patience };
            let reached = Best::from(minimise(target, x, patience, self.stop)?);
            let (values, _) = self.stresses(&reached.parameters);
            let squares = (values - &all).norm_squared();
            theta.clone_from(&reached.parameters);
            found = Some(Best { squares, ..reached });
            if self.is_stable(&theta, fan) {
                break;
            }
        }
        found
    }

    /// Whether Drucker's condition holds on a fan.
    pub(super) fn is_stable(&self, theta: &[f64], fan: &Fan) -> bool {
        !fan.iter().any(|point| stability::least_modulus(self.model, *point, theta) <= 0.0)
    }

    /// What does not change with parameters that are all factors: stresses and moduli of each alone.
    fn fixed(&self, fan: &Fan) -> Option<Fixed> {
        let unknowns = self.parameters.len();
        if self.parameters.iter().any(|parameter| parameter.role != Role::Linear) {
            return None;
        }
        let unit = |k: usize| (0..unknowns).map(|j| if j == k { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
        let stresses = self.stresses(&vec![1.0; unknowns]).1;
        let mut moduli = DMatrix::zeros(3 * fan.len(), unknowns);
        for k in 0..unknowns {
            let theta = unit(k);
            for (index, point) in fan.iter().enumerate() {
                for (part, value) in stability::moduli(self.model, *point, &theta).into_iter().enumerate() {
                    moduli[(3 * index + part, k)] = value;
                }
            }
        }
        Some(Fixed { stresses, moduli })
    }

    /// The values of the parameters that are searched for.
    pub(super) fn start_of(&self, best: &Best) -> Vec<f64> {
        self.places(Role::Nonlinear).into_iter().map(|k| best.parameters[k]).collect()
    }

    /// From parameters of a law that this one contains, with their sum of squares: the best, and no worse than those.
    pub(super) fn not_worse(&self, theta: &[f64], squares: f64, fan: &Fan) -> Best {
        let embedded = Best { parameters: theta.to_vec(), squares, outcome: Outcome::NoFurtherDecrease };
        let allowed = |best: &Best| best.squares <= squares && (!self.signs || self.is_stable(&best.parameters, fan));
        let found = if self.places(Role::Nonlinear).is_empty() {
            self.stabilise(&embedded, fan)
        } else {
            self.search(&[self.start_of(&embedded)]).map(|(best, _)| best)
        };
        found.filter(allowed).unwrap_or(embedded)
    }

    /// The parameters and S of a changed fit, from the best ones. Whether the law is stable is not asked: most intervals reach beyond.
    pub(super) fn again(&self, change: Change<'_>, best: &Best) -> Option<(Vec<f64>, f64)> {
        let (mut parameters, mut shift) = (self.parameters.clone(), Vec::new());
        match change {
            Change::Held(k, value) => parameters[k].bounds = [value; 2],
            Change::Shifted(of_rows) => shift = of_rows.to_vec(),
        }
        let changed = Problem { parameters, weights: self.weights.clone(), shift, ..*self };
        let (found, _) = changed.search(&[self.start_of(best)])?;
        Some((found.parameters, found.squares))
    }

    /// Where a parameter is searched for.
    fn range(&self, k: usize) -> Range {
        let least = 1e-6 * if self.parameters[k].is_stress { self.stress } else { 1.0 };
        Range { bounds: self.parameters[k].bounds, least }
    }
}

impl<M: Parametric> From<End<M>> for Best {
    fn from(end: End<M>) -> Self {
        let squares = end.state.0.norm_squared();
        Self { parameters: end.misfit.into_parameters(), squares, outcome: end.outcome }
    }
}

/// A misfit of parameters, with residuals and their derivatives or what these follow from.
trait Parametric: Misfit<State = (DVector<f64>, DMatrix<f64>)> {
    fn into_parameters(self) -> Vec<f64>;
}

/// The search for α alone.
struct Separable<'p, 'a, M> {
    problem: &'p Problem<'a, M>,
    searched: &'p [usize],
    observed: &'p DVector<f64>,
    theta: Vec<f64>,
}

impl<M: Model> Parametric for Separable<'_, '_, M> {
    fn into_parameters(self) -> Vec<f64> {
        self.theta
    }
}

impl<M: Model> Misfit for Separable<'_, '_, M> {
    /// Residuals, and the basis of what the linear parameters can change.
    type State = (DVector<f64>, DMatrix<f64>);

    fn rows(&self) -> usize {
        self.observed.len()
    }

    fn visit(&mut self, x: &[f64]) -> Option<Self::State> {
        for (&k, &x) in self.searched.iter().zip(x) {
            self.theta[k] = self.problem.range(k).outward(x)[0];
        }
        self.problem.eliminate(&mut self.theta, self.observed)
    }

    fn residuals<'s>(&self, (residuals, _): &'s Self::State) -> &'s [f64] {
        residuals.as_slice()
    }

    fn jacobian(&self, (_, basis): &Self::State, x: &[f64]) -> DMatrix<f64> {
        let mut slopes = self.problem.stresses(&self.theta).1.select_columns(self.searched);
        for (index, (&k, &x)) in self.searched.iter().zip(x).enumerate() {
            slopes.column_mut(index).scale_mut(self.problem.range(k).outward(x)[1]);
        }
        let within = basis.tr_mul(&slopes);
        slopes - basis * within
    }
}

/// Logarithmic stretches at which stability is looked at.
pub(super) type Fan = [[f64; 3]];

/// Stresses, and three moduli at each point of a fan, a column for each factor.
struct Fixed {
    stresses: DMatrix<f64>,
    moduli: DMatrix<f64>,
}

/// The search for all parameters under a penalty.
struct Penalised<'p, 'a, M> {
    problem: &'p Problem<'a, M>,
    observed: &'p DVector<f64>,
    fan: &'p Fan,
    fixed: Option<&'p Fixed>,
    hardness: f64,
    theta: Vec<f64>,
}

impl<M: Model> Penalised<'_, '_, M> {
    /// The least modulus that is asked for, as a part of the largest stress.
    const MARGIN: f64 = 1e-3;
}

impl<M: Model> Parametric for Penalised<'_, '_, M> {
    fn into_parameters(self) -> Vec<f64> {
        self.theta
    }
}

impl<M: Model> Misfit for Penalised<'_, '_, M> {
    /// Residuals of the data, then of Drucker's condition, and their derivatives.
    type State = (DVector<f64>, DMatrix<f64>);

    fn rows(&self) -> usize {
        self.observed.len() + self.fan.len()
    }

    fn visit(&mut self, x: &[f64]) -> Option<Self::State> {
        for (k, &x) in x.iter().enumerate() {
            self.theta[k] = self.problem.range(k).outward(x)[0];
        }
        let unknowns = self.theta.len();
        let (values, slopes) = match self.fixed {
            Some(fixed) => (&fixed.stresses * DVector::from_column_slice(&self.theta), fixed.stresses.clone()),
            None => self.problem.stresses(&self.theta),
        };
        let rows = values.len();
        let mut residuals = DVector::zeros(rows + self.fan.len());
        let mut jacobian = DMatrix::zeros(rows + self.fan.len(), unknowns);
        residuals.rows_mut(0, rows).copy_from(&(values - self.observed));
        jacobian.rows_mut(0, rows).copy_from(&slopes);
        let mut lack =
            |index: usize, modulus: f64, slopes: &mut dyn FnMut(usize) -> f64, columns: core::ops::Range<usize>| {
                let lacking = Self::MARGIN - modulus / self.problem.stress;
                if lacking.is_nan() || 0.0 < lacking {
                    residuals[rows + index] = self.hardness * lacking;
                    for k in columns {
                        jacobian[(rows + index, k)] = -self.hardness * slopes(k) / self.problem.stress;
                    }
                }
            };
        if let Some(fixed) = self.fixed {
            let moduli = &fixed.moduli * DVector::from_column_slice(&self.theta);
            for index in 0..self.fan.len() {
                // The least modulus with its derivatives with respect to the three.
                let three = [0, 1, 2].map(|part| Gradient::<f64, 3>::variable(moduli[3 * index + part], part));
                let least = stability::least(three);
                let mut slope =
                    |k: usize| (0..3).map(|part| least.partials[part] * fixed.moduli[(3 * index + part, k)]).sum();
                lack(index, least.value, &mut slope, 0..unknowns);
            }
        } else {
            for begin in (0..unknowns).step_by(CHUNK) {
                let lifted: Vec<_> = self
                    .theta
                    .iter()
                    .enumerate()
                    .map(|(k, x)| Gradient::<f64, CHUNK>::variable(*x, if k < begin { CHUNK } else { k - begin }))
                    .collect();
                for (index, point) in self.fan.iter().enumerate() {
                    let modulus = stability::least_modulus(self.problem.model, *point, &lifted);
                    let end = unknowns.min(begin + CHUNK);
                    lack(index, modulus.value, &mut |k| modulus.partials[k - begin], begin..end);
                }
            }
        }
        for (k, &unknown) in x.iter().enumerate().take(unknowns) {
            jacobian.column_mut(k).scale_mut(self.problem.range(k).outward(unknown)[1]);
        }
        residuals.iter().all(|x| x.is_finite()).then_some((residuals, jacobian))
    }

    fn residuals<'s>(&self, (residuals, _): &'s Self::State) -> &'s [f64] {
        residuals.as_slice()
    }

    fn jacobian(&self, (_, jacobian): &Self::State, _: &[f64]) -> DMatrix<f64> {
        jacobian.clone()
    }
}
