//! The motion from a complete integral U(q, Q, t).
//!
//! ```text
//! p = ∂U/∂q,   P = −∂U/∂Q,   Q and P constant,   det ∂²U/∂q∂Q ≠ 0                         W(12.11–12.15)
//! ```

use nalgebra::{DMatrix, DVector};
use piola_numerics::{Dual, Gradient, Real};

use crate::PhaseFunction;
use crate::check::{check_finite, check_length};
use crate::partial_derivatives::Slopes;
use crate::{HamiltonJacobiError, HamiltonianError};

/// Newton iterations after which constants or coordinates are given up.
const ITERATIONS: usize = 60;
/// How often one of them is halved.
const HALVINGS: usize = 30;
/// Below this ratio of singular values a matrix ∂²U/∂q∂Q has no inverse.
const INCOMPLETE: f64 = 1e-13;
/// Beyond this part of its terms, what is left of the Hamilton–Jacobi equation is no rounding.
const ALLOWED_RESIDUAL: f64 = 1e-9;
/// The shortest part of the way in time that continuation takes.
const SHORTEST_PART: f64 = 1.0 / 65536.0;

/// A solution U(q, Q, t) of the Hamilton–Jacobi equation with n constants Q, written once for any scalar.
///
/// # Example
/// See [`Constants`].
///
/// # Source
/// W(11.20), W(12.11).
pub trait CompleteIntegral {
    /// U(q, Q, t), J s.
    fn value<T: Real>(&self, q: &[T], constants: &[T], t: T) -> T;
}

/// The constants (Q, P) of one motion, by a complete integral.
///
/// # Accuracy
/// Constants and states to rounding times the condition number of ∂²U/∂q∂Q; no integration is made.
///
/// # Example
/// A free particle of unit mass, U = q Q − Q² t/2: Q is its momentum, and q = Q t − P.
/// ```
/// use piola_hamiltonian::hamilton_jacobi::{CompleteIntegral, Constants};
/// use piola_hamiltonian::PhaseFunction;
/// use piola_numerics::Real;
/// struct Free;
/// impl PhaseFunction for Free {
///     fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * p[0] * p[0]
///     }
/// }
/// struct Waves;
/// impl CompleteIntegral for Waves {
///     fn value<T: Real>(&self, q: &[T], c: &[T], t: T) -> T {
///         q[0] * c[0] - T::lit(0.5) * c[0] * c[0] * t
///     }
/// }
/// let motion = Constants::through(&Free, &Waves, (&[5.0], &[3.0], 1.0), &[1.0])?;
/// assert_eq!((motion.constants()[0], motion.momenta()[0]), (3.0, -2.0));
/// let (q, p) = motion.at(4.0, (&[5.0], 1.0))?;
/// assert_eq!((q[0], p[0]), (14.0, 3.0));
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(12.11–12.15).
#[derive(Clone, Debug)]
pub struct Constants<'a, H, U> {
    hamiltonian: &'a H,
    integral: &'a U,
    values: Vec<f64>,
    momenta: Vec<f64>,
    determinant: f64,
}

/// First derivatives of U by q and Q, ∂U/∂t, and the matrix ∂²U/∂qᵢ∂Qⱼ.
struct Partials {
    q: Vec<f64>,
    constants: Vec<f64>,
    time: f64,
    mixed: DMatrix<f64>,
}

fn partials<U: CompleteIntegral>(integral: &U, q: &[f64], constants: &[f64], t: f64) -> Partials {
    let n = q.len();
    let mut slopes = Slopes::<Dual<f64>>::new();
    let mut mixed = DMatrix::zeros(n, n);
    for j in 0..n {
        let direction = (0..=2 * n).map(|i| f64::from(u8::from(i == n + j)));
        let point = q.iter().chain(constants).copied().chain([t]);
        let variables = point.zip(direction).map(|(value, tangent)| Dual { value, tangent });
        slopes.of(&variables, |x| {
            let (t, x) = x.split_last().map_or((Gradient::constant(Dual::constant(0.0)), x), |(t, x)| (*t, x));
            let (q, constants) = x.split_at(n);
            integral.value(q, constants, t)
        });
        for i in 0..n {
            mixed[(i, j)] = slopes.partials[i].tangent;
        }
    }
    let value = |x: &Dual<f64>| x.value;
    let (by_q, rest) = slopes.partials.split_at(n);
    Partials {
        q: by_q.iter().map(value).collect(),
        constants: rest.iter().take(n).map(value).collect(),
        time: rest.get(n).map_or(0.0, value),
        mixed,
    }
}

/// Solves with a matrix, or says how singular it is when scaled to rows and columns of unit size.
pub(super) fn solve(matrix: &DMatrix<f64>, right: &DVector<f64>) -> Result<DVector<f64>, HamiltonianError> {
    let size = |values: &mut dyn Iterator<Item = f64>| {
        let largest = values.fold(0.0_f64, |m, x| m.max(x.abs()));
        if 0.0 < largest { largest } else { 1.0 }
    };
    let rows: Vec<f64> = matrix.row_iter().map(|row| size(&mut row.iter().copied())).collect();
    let scaled = DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)] / rows[i]);
    let columns: Vec<f64> = scaled.column_iter().map(|column| size(&mut column.iter().copied())).collect();
    let scaled = DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| scaled[(i, j)] / columns[j]);
    check_finite("∂²U/∂q∂Q", scaled.as_slice())?;
    let singular = scaled.singular_values();
    let ratio = singular.min() / singular.max();
    if ratio.is_nan() || ratio <= INCOMPLETE {
        return Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::IncompleteIntegral {
            ratio: if ratio.is_nan() { 0.0 } else { ratio },
        }));
    }
    let right = DVector::from_fn(right.len(), |i, _| right[i] / rows[i]);
    let Some(solution) = scaled.lu().solve(&right) else {
        return Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::IncompleteIntegral { ratio }));
    };
    Ok(DVector::from_fn(solution.len(), |i, _| solution[i] / columns[i]))
}

/// Newton's iteration, damped, for `residual(x) = 0`, from x; the size of the terms comes with the residual.
pub(super) fn newton(
    unknown: &'static str,
    mut x: Vec<f64>,
    mut evaluate: impl FnMut(&[f64]) -> (DVector<f64>, DMatrix<f64>, f64),
) -> Result<Vec<f64>, HamiltonianError> {
    let (mut residual, mut matrix, mut scale) = evaluate(&x);
    for _ in 0..ITERATIONS {
        if residual.iter().any(|r| !r.is_finite()) {
            break;
        }
        let step = solve(&matrix, &residual)?;
        let (mut fraction, mut next) = (1.0, None);
        for _ in 0..HALVINGS {
            let trial: Vec<f64> = x.iter().zip(step.iter()).map(|(x, s)| x - fraction * s).collect();
            let found = evaluate(&trial);
            if found.0.norm() < (1.0 - 0.25 * fraction) * residual.norm() {
                next = Some((trial, found));
                break;
            }
            if residual.norm() <= 64.0 * f64::EPSILON * scale {
                return Ok(x);
            }
            fraction *= 0.5;
        }
        match next {
            Some((trial, found)) => {
                x = trial;
                (residual, matrix, scale) = found;
            }
            None if residual.norm() <= 1e-11 * scale => return Ok(x),
            None => break,
        }
        if residual.norm() <= 0.0 {
            return Ok(x);
        }
    }
    Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NotFound {
        unknown,
        iterations: ITERATIONS,
        residual: residual.norm(),
    }))
}

impl<'a, H: PhaseFunction, U: CompleteIntegral> Constants<'a, H, U> {
    /// The constants of the motion that is in the state (q₀, p₀) at t₀: Q from p₀ = ∂U/∂q by Newton's iteration
    /// from a guess, then P = −∂U/∂Q.
    ///
    /// # Errors
    /// [`HamiltonianError::WrongLength`], [`HamiltonianError::NotFinite`]; [`HamiltonJacobiError::IncompleteIntegral`]
    /// where det ∂²U/∂q∂Q = 0; [`HamiltonJacobiError::NotFound`] when the iteration does not converge;
    /// [`HamiltonJacobiError::NoSolution`] when U does not solve the Hamilton–Jacobi equation there.
    pub fn through(
        hamiltonian: &'a H,
        integral: &'a U,
        (q, p, t): (&[f64], &[f64], f64),
        guess: &[f64],
    ) -> Result<Self, HamiltonianError> {
        check_length("p", q.len(), p.len())?;
        check_length("Q", q.len(), guess.len())?;
        check_finite("q", q)?;
        check_finite("p", p)?;
        check_finite("Q", guess)?;
        check_finite("t", &[t])?;
        let constants = newton("constants of the integral", guess.to_vec(), |constants| {
            let found = partials(integral, q, constants, t);
            let residual = DVector::from_fn(q.len(), |i, _| found.q[i] - p[i]);
            (residual, found.mixed, DVector::from_column_slice(p).norm())
        })?;
        let found = partials(integral, q, &constants, t);
        let energy = hamiltonian.value(q, &found.q, t);
        let (residual, scale) = (found.time + energy, found.time.abs() + energy.abs());
        if residual.is_nan() || ALLOWED_RESIDUAL * scale < residual.abs() {
            return Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NoSolution { residual, scale }));
        }
        // Singular matrices are refused also where no step was needed.
        solve(&found.mixed, &DVector::zeros(q.len()))?;
        let momenta = found.constants.iter().map(|x| -x).collect();
        Ok(Self { hamiltonian, integral, values: constants, momenta, determinant: found.mixed.determinant() })
    }

    /// Q.
    #[must_use]
    pub fn constants(&self) -> &[f64] {
        &self.values
    }
    /// P = −∂U/∂Q.
    #[must_use]
    pub fn momenta(&self) -> &[f64] {
        &self.momenta
    }
    /// det ∂²U/∂q∂Q at the given state.
    #[must_use]
    pub const fn determinant(&self) -> f64 {
        self.determinant
    }

    /// The state (q, p) at a time, from a place q at a time near which the motion is known to be: Newton's iteration
    /// for −∂U/∂Q = P, continued in time as far as is needed.
    ///
    /// # Errors
    /// [`HamiltonianError::WrongLength`], [`HamiltonianError::NotFinite`]; [`HamiltonJacobiError::IncompleteIntegral`] and
    /// [`HamiltonJacobiError::NotFound`] where U ends, as at a turning point of one of its branches.
    pub fn at(&self, t: f64, (q, known): (&[f64], f64)) -> Result<(Vec<f64>, Vec<f64>), HamiltonianError> {
        let n = self.values.len();
        check_length("q", n, q.len())?;
        check_finite("q", q)?;
        check_finite("t", &[t, known])?;
        let (mut place, mut time) = (self.place(known, q.to_vec())?, known);
        let (mut part, mut step) = (0.0, 1.0);
        let mut slopes = Slopes::new();
        while part < 1.0 {
            let next = f64::min(part + step, 1.0);
            let then = if 1.0 <= next { t } else { known + next * (t - known) };
            // The motion itself predicts where to look.
            let momenta = partials(self.integral, &place, &self.values, time).q;
            super::strips::slopes_of(self.hamiltonian, &mut slopes, (&place, &momenta, time));
            let velocity = &slopes.partials[n..2 * n];
            let predicted: Vec<f64> = place.iter().zip(velocity).map(|(q, v)| q + (then - time) * v).collect();
            let moved = distance(&predicted, &place);
            let size = place.iter().fold(0.0_f64, |m, q| m.max(q.abs()));
            match self.place(then, predicted.clone()) {
                // What lies farther from the prediction than half the way may belong to another motion.
                Ok(found) if 2.0 * distance(&found, &predicted) <= moved || moved <= 1e-6 * size => {
                    (place, time, part) = (found, then, next);
                    step *= 2.0;
                }
                result if step <= SHORTEST_PART => {
                    result?;
                    return Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NotFound {
                        unknown: "coordinates of the motion",
                        iterations: ITERATIONS,
                        residual: distance(&predicted, &place),
                    }));
                }
                _ => step *= 0.25,
            }
        }
        let momenta = partials(self.integral, &place, &self.values, t).q;
        Ok((place, momenta))
    }

    fn place(&self, t: f64, guess: Vec<f64>) -> Result<Vec<f64>, HamiltonianError> {
        let n = self.values.len();
        newton("coordinates of the motion", guess, |q| {
            let found = partials(self.integral, q, &self.values, t);
            let residual = DVector::from_fn(n, |i, _| found.constants[i] + self.momenta[i]);
            // U = Σ terms of which each may be larger than P: q·∂²U/∂q∂Q is their size.
            let terms = (found.mixed.transpose() * DVector::from_column_slice(q)).norm();
            let scale = DVector::from_column_slice(&self.momenta).norm() + terms;
            (residual, found.mixed.transpose(), scale)
        })
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}
