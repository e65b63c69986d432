//! The search of Levenberg and Marquardt over unbounded coordinates of bounded parameters.

use nalgebra::DMatrix;
use rmpfit::{MPConfig, MPError, MPFitter, MPMaxFev, MPPar, MPResult, MPSide, MPSuccess};

use crate::Outcome;

/// The range of a parameter, and its unbounded coordinate.
///
/// ```text
/// low ≤ θ ≤ high    θ = low + ½ (high − low) (1 + sin x)
/// low ≤ θ           θ = low + eˣ
/// θ ≤ high          θ = high − eˣ
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Range {
    /// The least and the greatest value; infinite where there is none.
    pub bounds: [f64; 2],
    /// The least distance from a single bound at which a search starts, 0 < least.
    pub least: f64,
}

impl Range {
    /// 0 < θ.
    pub const POSITIVE: Self = Self { bounds: [0.0, f64::INFINITY], least: f64::MIN_POSITIVE };

    /// Whether the bounds leave one value.
    #[cfg(feature = "solids")]
    pub(crate) fn is_fixed(self) -> bool {
        let [low, high] = self.bounds;
        high <= low
    }

    /// The unbounded coordinate of a parameter.
    #[must_use]
    pub fn inward(self, value: f64) -> f64 {
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
    #[must_use]
    pub fn outward(self, x: f64) -> [f64; 2] {
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
pub trait Misfit {
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
#[derive(Debug)]
pub struct End<M: Misfit> {
    /// The misfit.
    pub misfit: M,
    /// Its state at the end.
    pub state: M::State,
    /// How the search ended.
    pub outcome: Outcome,
}

/// Searches from the coordinates `start`; nothing if no residuals are finite there, or at the end.
///
/// `stop` is asked before each evaluation; once it says so, the search ends at the best point until then.
pub fn minimise<M: Misfit>(misfit: M, start: Vec<f64>, patience: usize, stop: &dyn Fn() -> bool) -> Option<End<M>> {
    let mut walk = Walk { misfit, state: None };
    let outcome = walk_down(&mut walk, start, patience, stop)?;
    Some(End { state: walk.state?, misfit: walk.misfit, outcome })
}

/// The same for any misfit: the search itself is compiled once.
fn walk_down(walk: &mut dyn Steps, mut x: Vec<f64>, patience: usize, stop: &dyn Fn() -> bool) -> Option<Outcome> {
    walk.visit(&x);
    walk.residuals()?;
    let most = patience.saturating_mul(x.len() + 1);
    let mut method = MPConfig::new();
    (method.ftol, method.xtol, method.gtol) = (1e-14, 1e-12, 1e-12);
    (method.max_iter, method.max_fev) = (usize::MAX, MPMaxFev::Limited(most));
    let derivatives_given = || MPPar { side: MPSide::User, ..MPPar::new() };
    let coordinates = x.iter().map(|_| derivatives_given()).collect();
    let (at, best) = (x.clone(), (x.clone(), f64::INFINITY));
    let mut search = Search { walk, at, best, method, coordinates, stop, is_stopped: false };
    let ended = search.mpfit(&mut x);
    if search.is_stopped {
        x.clone_from(&search.best.0);
    }
    search.go_to(&x);
    let residuals = search.walk.residuals()?;
    Some(match ended {
        Ok(_) if residuals.iter().all(|r| r.abs() <= 0.0) => Outcome::ExactFit,
        Ok(status) => match status.success {
            MPSuccess::Dir => Outcome::GradientZero,
            MPSuccess::MaxIter => Outcome::OutOfPatience,
            _ => Outcome::NoFurtherDecrease,
        },
        Err(_) if search.is_stopped => Outcome::Interrupted,
        Err(_) => Outcome::NotFinite,
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
    /// The coordinates that the walk visited last.
    at: Vec<f64>,
    /// The coordinates of the least sum of squares, and that sum.
    best: (Vec<f64>, f64),
    method: MPConfig,
    coordinates: Vec<MPPar>,
    stop: &'w dyn Fn() -> bool,
    is_stopped: bool,
}

impl Search<'_> {
    fn go_to(&mut self, x: &[f64]) {
        if self.at != x {
            self.at.copy_from_slice(x);
            self.walk.visit(x);
        }
    }
}

impl MPFitter for Search<'_> {
    fn number_of_points(&self) -> usize {
        self.walk.rows()
    }

    fn config(&self) -> &MPConfig {
        &self.method
    }

    fn parameters(&self) -> &[MPPar] {
        &self.coordinates
    }

    fn eval(&mut self, x: &[f64], residuals: &mut [f64]) -> MPResult<()> {
        if (self.stop)() {
            self.is_stopped = true;
            return Err(MPError::Eval);
        }
        self.go_to(x);
        match self.walk.residuals() {
            Some(found) => {
                residuals.copy_from_slice(found);
                let squares = found.iter().map(|r| r * r).sum();
                if squares < self.best.1 {
                    self.best.0.copy_from_slice(x);
                    self.best.1 = squares;
                }
            }
            // A step to where there is no answer is taken back.
            None => residuals.fill(1e100),
        }
        Ok(())
    }

    fn jacobian(&mut self, x: &[f64], residuals: &mut [f64], columns: &mut [Option<Vec<f64>>]) -> MPResult<()> {
        self.eval(x, residuals)?;
        let jacobian = self.walk.jacobian(x).ok_or(MPError::Nan)?;
        for (column, derivatives) in columns.iter_mut().flatten().zip(jacobian.column_iter()) {
            column.iter_mut().zip(&derivatives).for_each(|(entry, derivative)| *entry = *derivative);
        }
        Ok(())
    }
}
