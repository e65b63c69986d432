//! The search of Levenberg and Marquardt over unbounded coordinates of bounded parameters.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use nalgebra::DMatrix;
use nalgebra_0_34 as searched;

use crate::Outcome;

/// The range of a parameter, and its unbounded coordinate.
///
/// ```text
/// low ≤ θ ≤ high    θ = low + ½ (high − low) (1 + sin x)
/// low ≤ θ           θ = low + eˣ
/// θ ≤ high          θ = high − eˣ
/// ```
#[derive(Clone, Copy, Debug)]
pub(crate) struct Range {
    /// The least and the greatest value; infinite where there is none.
    pub(crate) bounds: [f64; 2],
    /// The least distance from a single bound at which a search starts, 0 < least.
    pub(crate) least: f64,
}

impl Range {
    /// 0 < θ.
    #[cfg(feature = "fluids")]
    pub(crate) const POSITIVE: Self = Self { bounds: [0.0, f64::INFINITY], least: f64::MIN_POSITIVE };

    /// The unbounded coordinate of a parameter.
    pub(crate) fn inward(self, value: f64) -> f64 {
        match self.bounds {
            [low, high] if low.is_finite() && high.is_finite() => {
                let half = 0.5 * (high - low);
                if 0.0 < half { ((value - low) / half - 1.0).clamp(-0.999, 0.999).asin() } else { 0.0 }
            }
            [low, _] if low.is_finite() => (value - low).max(self.least).ln(),
            [_, high] if high.is_finite() => (high - value).max(self.least).ln(),
            _ => value,
        }
    }

    /// The parameter of an unbounded coordinate, and its derivative.
    pub(crate) fn outward(self, x: f64) -> [f64; 2] {
        match self.bounds {
            [low, high] if low.is_finite() && high.is_finite() => {
                let half = 0.5 * (high - low);
                [low + half * (1.0 + x.sin()), half * x.cos()]
            }
            [low, _] if low.is_finite() => [low + x.exp(), x.exp()],
            [_, high] if high.is_finite() => [high - x.exp(), -x.exp()],
            _ => [x, 1.0],
        }
    }
}

/// A sum of squares that is minimised.
pub(crate) trait Misfit {
    /// The state at a point with finite residuals.
    type State;

    /// The number of residuals.
    fn rows(&self) -> usize;
    /// Moves to the coordinates x; nothing where a residual is not finite.
    fn visit(&mut self, x: &[f64]) -> Option<Self::State>;
    /// The residuals.
    fn residuals<'s>(&self, state: &'s Self::State) -> &'s [f64];
    /// The derivatives of the residuals with respect to x, a row for each.
    fn jacobian(&self, state: &Self::State, x: &[f64]) -> DMatrix<f64>;
}

/// The end of a search.
pub(crate) struct End<M: Misfit> {
    pub(crate) misfit: M,
    pub(crate) state: M::State,
    pub(crate) outcome: Outcome,
}

/// Searches from the coordinates `start`; nothing if no residuals are finite there, or at the end.
pub(crate) fn minimise<M: Misfit>(misfit: M, start: Vec<f64>, patience: usize) -> Option<End<M>> {
    let mut walk = Walk { misfit, state: None };
    let outcome = walk_down(&mut walk, start, patience)?;
    Some(End { state: walk.state?, misfit: walk.misfit, outcome })
}

/// The same for any misfit: the search itself is compiled once.
fn walk_down(walk: &mut dyn Steps, start: Vec<f64>, patience: usize) -> Option<Outcome> {
    let x = searched::DVector::from_vec(start);
    let mut search = Search { walk, x: x.clone() };
    search.set_params(&x);
    search.walk.residuals()?;
    let method = LevenbergMarquardt::new().with_ftol(1e-14).with_xtol(1e-12).with_gtol(1e-12).with_patience(patience);
    let (mut end, report) = method.minimize(search);
    let x = end.x.clone();
    end.set_params(&x);
    Some(match report.termination {
        TerminationReason::ResidualsZero => Outcome::ExactFit,
        TerminationReason::Orthogonal => Outcome::GradientZero,
        TerminationReason::Converged { .. } | TerminationReason::NoImprovementPossible(_) => Outcome::NoFurtherDecrease,
        TerminationReason::LostPatience => Outcome::OutOfPatience,
        _ => Outcome::NotFinite,
    })
}

/// A misfit and where a search of it stands.
struct Walk<M: Misfit> {
    misfit: M,
    state: Option<M::State>,
}

/// What a search asks of a walk.
trait Steps {
    /// The number of residuals.
    fn rows(&self) -> usize;
    /// Moves to the coordinates x.
    fn visit(&mut self, x: &[f64]);
    /// The residuals; nothing where one is not finite.
    fn residuals(&self) -> Option<&[f64]>;
    /// The derivatives of the residuals with respect to x, a row for each; nothing where a residual is not finite.
    fn jacobian(&self, x: &[f64]) -> Option<DMatrix<f64>>;
}

impl<M: Misfit> Steps for Walk<M> {
    fn rows(&self) -> usize {
        self.misfit.rows()
    }
    fn visit(&mut self, x: &[f64]) {
        self.state = self.misfit.visit(x);
    }
    fn residuals(&self) -> Option<&[f64]> {
        Some(self.misfit.residuals(self.state.as_ref()?))
    }
    fn jacobian(&self, x: &[f64]) -> Option<DMatrix<f64>> {
        Some(self.misfit.jacobian(self.state.as_ref()?, x))
    }
}

/// A walk as the library of least squares sees it.
struct Search<'w> {
    walk: &'w mut dyn Steps,
    x: searched::DVector<f64>,
}

impl LeastSquaresProblem<f64, searched::Dyn, searched::Dyn> for Search<'_> {
    type ResidualStorage = searched::Owned<f64, searched::Dyn>;
    type JacobianStorage = searched::Owned<f64, searched::Dyn, searched::Dyn>;
    type ParameterStorage = searched::Owned<f64, searched::Dyn>;

    fn set_params(&mut self, x: &searched::DVector<f64>) {
        self.x.copy_from(x);
        self.walk.visit(self.x.as_slice());
    }

    fn params(&self) -> searched::DVector<f64> {
        self.x.clone()
    }

    fn residuals(&self) -> Option<searched::DVector<f64>> {
        Some(match self.walk.residuals() {
            Some(residuals) => searched::DVector::from_column_slice(residuals),
            // A step to where there is no answer is taken back.
            None => searched::DVector::from_element(self.walk.rows(), 1e100),
        })
    }

    fn jacobian(&self) -> Option<searched::DMatrix<f64>> {
        let jacobian = self.walk.jacobian(self.x.as_slice())?;
        Some(searched::DMatrix::from_column_slice(jacobian.nrows(), jacobian.ncols(), jacobian.as_slice()))
    }
}
