//! The search of Levenberg and Marquardt over unbounded coordinates of the parameters.

use core::cell::Cell;
use core::marker::PhantomData;

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use nalgebra_of_search as searched;
use piola_constitutive::fit::Outcome;
use piola_constitutive::fluids::{Parameters, ViscometricFluid};
use piola_numerics::{Gradient, Real};

use super::{FlowData, Weighting};
use crate::ViscometryError;

/// Everything that a search knows.
pub(super) struct Problem<'a, F, const N: usize> {
    data: &'a [FlowData],
    weighting: Weighting,
    bounds: [Option<[f64; 2]>; N],
    patience: usize,
    evaluations: Cell<usize>,
    fluid: PhantomData<F>,
}

/// Where a search has come to.
#[derive(Clone, Debug)]
pub(super) struct Best<const N: usize> {
    pub(super) parameters: [f64; N],
    pub(super) squares: f64,
    pub(super) outcome: Outcome,
}

/// Residuals and their derivatives, row by row.
type Rows<const N: usize> = (Vec<f64>, Vec<[f64; N]>);

impl<'a, F: Parameters<N> + ViscometricFluid, const N: usize> Problem<'a, F, N> {
    pub(super) const fn new(
        data: &'a [FlowData],
        weighting: Weighting,
        bounds: [Option<[f64; 2]>; N],
        patience: usize,
    ) -> Self {
        Self { data, weighting, bounds, patience, evaluations: Cell::new(0), fluid: PhantomData }
    }

    pub(super) fn evaluations(&self) -> usize {
        self.evaluations.get()
    }

    /// Residuals at parameters.
    pub(super) fn evaluate(&self, parameters: [f64; N]) -> Result<Rows<N>, ViscometryError> {
        self.evaluations.set(self.evaluations.get() + 1);
        let fluid = F::from_parameters(parameters)?;
        let lifted: [Gradient<f64, N>; N] = core::array::from_fn(|k| Gradient::variable(parameters[k], k));
        let (mut residuals, mut slopes) = (Vec::new(), Vec::new());
        for set in self.data {
            let largest = set.rows().iter().map(|row| row[1]).fold(0.0, f64::max);
            for (index, [_, measured]) in set.rows().iter().enumerate() {
                let answer = set.answer(&fluid, lifted, index)?;
                let residual = match self.weighting {
                    Weighting::Relative => (answer / Gradient::lit(*measured)).ln(),
                    Weighting::Equal => (answer - Gradient::lit(*measured)) / Gradient::lit(largest),
                };
                residuals.push(residual.value);
                slopes.push(residual.partials);
            }
        }
        Ok((residuals, slopes))
    }

    /// The unbounded coordinate of a parameter.
    fn inward(&self, k: usize, value: f64) -> f64 {
        match self.bounds[k] {
            Some([low, high]) => (2.0 * (value - low) / (high - low) - 1.0).clamp(-0.999, 0.999).asin(),
            None => value.max(f64::MIN_POSITIVE).ln(),
        }
    }

    /// The parameter of an unbounded coordinate, and its derivative.
    fn outward(&self, k: usize, x: f64) -> [f64; 2] {
        match self.bounds[k] {
            Some([low, high]) => [low + 0.5 * (high - low) * (1.0 + x.sin()), 0.5 * (high - low) * x.cos()],
            None => [x.exp(), x.exp()],
        }
    }

    /// From a start; nothing if it has no finite answers.
    pub(super) fn search(&self, start: [f64; N]) -> Option<Best<N>> {
        let x = searched::DVector::from_iterator(N, (0..N).map(|k| self.inward(k, start[k])));
        let mut walk = Walk { problem: self, x: x.clone(), state: None };
        walk.set_params(&x);
        walk.state.as_ref()?;
        let search = LevenbergMarquardt::new().with_ftol(1e-14).with_xtol(1e-12).with_gtol(1e-12);
        let (mut end, report) = search.with_patience(self.patience).minimize(walk);
        let x = end.x.clone();
        end.set_params(&x);
        let squares = end.state.as_ref()?.0.iter().map(|r| r * r).sum();
        let outcome = match report.termination {
            TerminationReason::ResidualsZero => Outcome::ExactFit,
            TerminationReason::Orthogonal => Outcome::GradientZero,
            TerminationReason::Converged { .. } | TerminationReason::NoImprovementPossible(_) => {
                Outcome::NoFurtherDecrease
            }
            TerminationReason::LostPatience => Outcome::OutOfPatience,
            _ => Outcome::NotFinite,
        };
        Some(Best { parameters: end.parameters(), squares, outcome })
    }
}

/// One walk of a search.
struct Walk<'p, 'a, F, const N: usize> {
    problem: &'p Problem<'a, F, N>,
    x: searched::DVector<f64>,
    state: Option<Rows<N>>,
}

impl<F: Parameters<N> + ViscometricFluid, const N: usize> Walk<'_, '_, F, N> {
    fn parameters(&self) -> [f64; N] {
        core::array::from_fn(|k| self.problem.outward(k, self.x[k])[0])
    }

    fn rows(&self) -> usize {
        self.problem.data.iter().map(FlowData::len).sum()
    }
}

impl<F, const N: usize> LeastSquaresProblem<f64, searched::Dyn, searched::Dyn> for Walk<'_, '_, F, N>
where
    F: Parameters<N> + ViscometricFluid,
{
    type ResidualStorage = searched::Owned<f64, searched::Dyn>;
    type JacobianStorage = searched::Owned<f64, searched::Dyn, searched::Dyn>;
    type ParameterStorage = searched::Owned<f64, searched::Dyn>;

    fn set_params(&mut self, x: &searched::DVector<f64>) {
        self.x.copy_from(x);
        let finite =
            |(residuals, slopes): &Rows<N>| residuals.iter().chain(slopes.iter().flatten()).all(|x| x.is_finite());
        self.state = self.problem.evaluate(self.parameters()).ok().filter(finite);
    }

    fn params(&self) -> searched::DVector<f64> {
        self.x.clone()
    }

    fn residuals(&self) -> Option<searched::DVector<f64>> {
        Some(match &self.state {
            Some((residuals, _)) => searched::DVector::from_column_slice(residuals),
            // A step to where there is no answer is taken back.
            None => searched::DVector::from_element(self.rows(), 1e100),
        })
    }

    fn jacobian(&self) -> Option<searched::DMatrix<f64>> {
        let (residuals, slopes) = self.state.as_ref()?;
        let outward: [f64; N] = core::array::from_fn(|k| self.problem.outward(k, self.x[k])[1]);
        Some(searched::DMatrix::from_fn(residuals.len(), N, |i, k| slopes[i][k] * outward[k]))
    }
}
