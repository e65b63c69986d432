//! Simplified Newton iteration to rounding: x ← x − A⁻¹ r(x) with a matrix that is kept while it serves.

use piola_integrators::IntegratorsError;
use piola_integrators::internal::largest_lane;
use piola_numerics::linear::lu;
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{NumericsError, Real};

use crate::kept::{Kept, Visitor};

/// Iterations after which a step is given up.
const MOST_ITERATIONS: usize = 100;
/// The part of the rounding error of an increment that may be left out of it.
const UNROUNDED: f64 = 1e-4;
/// Corrections, in units of the last place, that are within rounding: they may be all that the last iteration leaves.
const ROUNDING: f64 = 64.0;
/// Corrections that fall more slowly than this ask for a new matrix.
const SLOW: f64 = 0.2;
/// A matrix that needs more iterations than these is not kept for the next step.
const MOST_WITH_OLD_MATRIX: usize = 6;

/// Equations r(x) = 0 for the increments x of one step.
pub(crate) trait Equations<T: Real> {
    /// Why the field cannot be evaluated.
    type Error;
    /// Whether the iteration is x ← x − r(x), without a matrix.
    const BY_FIXED_POINT: bool = false;
    /// Writes r(x).
    fn residual(&mut self, x: &[T], residual: &mut [T]) -> Result<(), IntegratorsError<Self::Error>>;
    /// Writes ∂r/∂x, or a matrix close to it, down its columns; and for each component of r by how much it changes if the
    /// state changes by its own size, which is what rounding of the state does to it. That is zero unless it is written.
    fn matrix(&mut self, x: &[T], matrix: &mut [T], response: &mut [f64]) -> Result<(), IntegratorsError<Self::Error>>;
    /// Writes the magnitude against which each component of x is rounded, no less than its own.
    fn magnitudes(&self, x: &[T], magnitudes: &mut [f64]);
}

/// The factors of the matrix, and memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct Newton<T> {
    factors: Vec<T>,
    exchanges: Vec<usize>,
    residual: Vec<T>,
    guess: Vec<T>,
    magnitudes: Vec<f64>,
    /// Of the matrix: see [`Equations::matrix`].
    response: Vec<f64>,
    /// Residuals computed in a step.
    residuals: u64,
    /// Whether `factors` are those of a step before, of the same size.
    kept: bool,
}

impl<T: Real> Kept<T> for Newton<T> {
    fn visit<V: Visitor<T>>(&mut self, visitor: &mut V) {
        visitor.flag(&mut self.kept);
        visitor.values(&mut self.factors);
        visitor.exchanges(&mut self.exchanges);
        visitor.numbers(&mut self.response);
    }
}

/// How far the iteration has come.
enum Progress {
    Converged,
    Slow,
    Going,
}

impl<T: Real> Newton<T> {
    pub(crate) const fn new() -> Self {
        Self {
            factors: Vec::new(),
            exchanges: Vec::new(),
            residual: Vec::new(),
            guess: Vec::new(),
            magnitudes: Vec::new(),
            response: Vec::new(),
            residuals: 0,
            kept: false,
        }
    }

    /// Makes room for n unknowns, and forgets the matrix.
    pub(crate) fn begin(&mut self, n: usize, with_matrix: bool) {
        self.factors.resize(if with_matrix { n * n } else { 0 }, T::zero());
        self.exchanges.resize(n, 0);
        self.residual.resize(n, T::zero());
        self.guess.resize(n, T::zero());
        self.magnitudes.resize(n, 0.0);
        self.response.clear();
        self.response.resize(n, 0.0);
        self.kept = false;
    }

    /// Solves r(x) = 0 from the guess x; returns the number of residuals computed. `(t, step)` are those of the step, for
    /// errors.
    pub(crate) fn solve<Q: Equations<T>>(
        &mut self,
        equations: &mut Q,
        x: &mut [T],
        (t, step): (f64, f64),
    ) -> Result<u64, IntegratorsError<Q::Error>> {
        self.guess.copy_from_slice(x);
        self.residuals = 0;
        if self.kept && T::ORDER == 0 {
            // An old matrix that leads astray is no reason to give up.
            if self.iterate(equations, x, (t, step)).is_ok() {
                return Ok(self.residuals);
            }
            x.copy_from_slice(&self.guess);
        }
        self.kept = false;
        self.iterate(equations, x, (t, step))?;
        Ok(self.residuals)
    }

    fn iterate<Q: Equations<T>>(
        &mut self,
        equations: &mut Q,
        x: &mut [T],
        (t, step): (f64, f64),
    ) -> Result<(), IntegratorsError<Q::Error>> {
        let mut fresh = self.kept;
        let (mut previous, mut change) = (f64::INFINITY, 0.0);
        for iteration in 1..=MOST_ITERATIONS {
            if !fresh && !Q::BY_FIXED_POINT {
                self.response.fill(0.0);
                equations.matrix(x, &mut self.factors, &mut self.response)?;
                self.factor((t, step))?;
                fresh = true;
            }
            let mut progress;
            (change, progress) = self.correct(equations, x, previous)?;
            if iteration == MOST_ITERATIONS && change < ROUNDING * unit_in_last_place::<T>() {
                progress = Progress::Converged;
            }
            match progress {
                Progress::Converged => {
                    self.kept = iteration <= MOST_WITH_OLD_MATRIX;
                    // Derivatives that the scalars carry converge as fast as the values did, each order after the one before.
                    // Values that stood still at once tell nothing of a fixed point.
                    let more = if Q::BY_FIXED_POINT { iteration.max(MOST_ITERATIONS / 2) } else { iteration };
                    for _ in 0..more * T::ORDER {
                        self.guess.copy_from_slice(x);
                        self.correct(equations, x, previous)?;
                        if self.guess == *x {
                            break;
                        }
                    }
                    return Ok(());
                }
                Progress::Slow => fresh = false,
                Progress::Going => {}
            }
            previous = change;
        }
        Err(IntegratorsError::StagesDiverged { t, step, iterations: MOST_ITERATIONS, change })
    }

    /// Factors the matrix in place.
    fn factor<E>(&mut self, (t, step): (f64, f64)) -> Result<(), IntegratorsError<E>> {
        lu::factor_in_place(&mut self.factors, &mut self.exchanges).map_err(|error| match error {
            NumericsError::Singular { pivot, .. } => IntegratorsError::SingularMatrix { t, step, pivot },
            // The lengths fit: nothing else can be wrong.
            _ => IntegratorsError::SingularMatrix { t, step, pivot: 0 },
        })
    }

    /// One iteration: the largest change of a component relative to its magnitude, and what follows from it.
    fn correct<Q: Equations<T>>(
        &mut self,
        equations: &mut Q,
        x: &mut [T],
        previous: f64,
    ) -> Result<(f64, Progress), IntegratorsError<Q::Error>> {
        equations.residual(x, &mut self.residual)?;
        self.residuals += 1;
        // The lengths fit: nothing is refused.
        if !Q::BY_FIXED_POINT {
            let _ = lu::solve_in_place(&self.factors, &self.exchanges, &mut self.residual);
        }
        for (x, &correction) in x.iter_mut().zip(&self.residual) {
            *x -= correction;
        }
        equations.magnitudes(x, &mut self.magnitudes);
        let (mut change, mut size) = (0.0_f64, 0.0_f64);
        for (magnitude, &response) in self.magnitudes.iter_mut().zip(&self.response) {
            *magnitude = magnitude.max(response);
        }
        for ((&x, &correction), &magnitude) in x.iter().zip(&self.residual).zip(&self.magnitudes) {
            let (correction, x) = (largest_lane(correction), largest_lane(x));
            if !correction.is_finite() || magnitude.is_infinite() {
                change = f64::INFINITY; // the next residual says so
            } else if 0.0 < correction {
                change = change.max(correction / magnitude);
            }
            if 0.0 < x {
                size = size.max(x / magnitude);
            }
        }
        let ulp = unit_in_last_place::<T>();
        // Converged when the next change would be far below the rounding of the increments, since what is left out has
        // the same sign in every step and adds up; or when rounding has stopped the fall.
        let predicted = if previous.is_finite() { change * (change / previous).min(1.0) } else { change };
        let is_rounding = change < ROUNDING * ulp;
        let progress = if predicted <= UNROUNDED * ulp * size.min(1.0) || previous <= change && is_rounding {
            Progress::Converged
        } else if SLOW * previous < change && !is_rounding {
            Progress::Slow
        } else {
            Progress::Going
        };
        Ok((change, progress))
    }
}
