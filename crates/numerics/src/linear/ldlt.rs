//! L D Lᵀ of a symmetric positive definite matrix, without square roots.
//!
//! ```text
//! A = L D Lᵀ        L unit lower triangular,   D diagonal,   0 < dₖ
//! ```
//!
//! No pivoting is needed for positive definite matrices, so the same operations serve every lane and every
//! derivative. A pivot dₖ is what is left of aₖₖ when the directions before it are taken out; it is compared
//! with aₖₖ, so that the units of the coordinates do not matter:
//!
//! ```text
//! n ulp · aₖₖ < dₖ
//! ```
//!
//! Where that fails, coordinate k depends on those before it, and [`null_direction_into`] tells how.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};

use super::{condition, one_norm};
use crate::error::{check_dimension, check_finite};
use crate::sums::{CompensatedSum, unit_in_last_place};
use crate::{Mask, NumericsError, Real};

/// Up to this order the loops of a factorisation are left to be unrolled.
const SMALL: usize = 8;

/// Factors a symmetric positive definite n×n matrix in place: L below the diagonal, D on it.
///
/// Only the lower triangle is read and written.
///
/// # Errors
/// [`NumericsError::WrongLength`] unless there are n² entries; [`NumericsError::NotPositiveDefinite`] with the first pivot
/// that is not positive in every lane (also when it is NaN). The columns before that pivot are then factored.
///
/// # Accuracy
/// L D Lᵀ is A to n ulp of √(aᵢᵢ aⱼⱼ) in entry (i, j).
///
/// # Example
/// ```
/// use piola_numerics::linear::ldlt;
/// let mut a = [4.0, 2.0, 2.0, 3.0];
/// ldlt::factor_in_place(&mut a, 2)?;
/// assert_eq!((a[0], a[1], a[3]), (4.0, 0.5, 2.0)); // d₁ = 4, l₂₁ = 1/2, d₂ = 3 − 4/4
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn factor_in_place<T: Real>(a: &mut [T], n: usize) -> Result<(), NumericsError> {
    factor_and_grade_in_place(a, n, 0.0).map(|_| ())
}

/// [`factor_in_place`], with a verdict: in which lanes each pivot is more than `share` of the diagonal entry
/// that it comes from.
///
/// ```text
/// share · aₖₖ < dₖ  for all k
/// ```
///
/// The reciprocal of the smallest dₖ/aₖₖ is at most the condition number of the matrix scaled to unit
/// diagonal, and seldom much less. The verdict costs nothing: it is made with the comparison that guards the
/// factorisation.
///
/// # Errors
/// As [`factor_in_place`].
///
/// # Example
/// ```
/// use piola_numerics::linear::ldlt;
/// let mut a = [1.0, 0.99, 0.99, 1.0]; // d₂ = 1 − 0.99² = 0.0199
/// assert!(ldlt::factor_and_grade_in_place(&mut a.clone(), 2, 0.01)?);
/// assert!(!ldlt::factor_and_grade_in_place(&mut a, 2, 0.02)?);
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn factor_and_grade_in_place<T: Real>(a: &mut [T], n: usize, share: f64) -> Result<T::Mask, NumericsError> {
    check_dimension("matrix", a.len(), n * n)?;
    let threshold = T::lit(n as f64 * unit_in_last_place::<T>());
    let share = threshold.max(T::lit(share));
    let mut sound = T::Mask::splat(true);
    for j in 0..n {
        let diagonal = a[j + j * n];
        let (before, column) = a.split_at_mut(j * n);
        let column = &mut column[..n];
        // Column j loses its part along column k: a_ij ← a_ij − l_ik d_k l_jk.
        let mut k = 0;
        if SMALL < n {
            // Four at a time, so that the column is read and written once.
            while k + 4 <= j {
                let left: [&[T]; 4] = core::array::from_fn(|m| &before[(k + m) * n + j..(k + m + 1) * n]);
                let weights: [T; 4] = core::array::from_fn(|m| left[m][0] * before[(k + m) * (n + 1)]);
                let rest = &mut column[j..];
                let [l0, l1, l2, l3] = left.map(|column| &column[..rest.len()]);
                for i in 0..rest.len() {
                    rest[i] = (((rest[i] - l0[i] * weights[0]) - l1[i] * weights[1]) - l2[i] * weights[2])
                        - l3[i] * weights[3];
                }
                k += 4;
            }
        }
        for k in k..j {
            let left = &before[k * n..(k + 1) * n];
            let weight = left[j] * left[k];
            for i in j..n {
                column[i] -= left[i] * weight;
            }
        }
        let pivot = column[j];
        let regular = T::zero().less_than(diagonal);
        let well = regular & (share * diagonal).less_than(pivot);
        if !well.all() {
            if !(regular & (threshold * diagonal).less_than(pivot)).all() {
                return Err(refused(j, pivot, diagonal, threshold));
            }
            sound = sound & well;
        }
        let inverse = pivot.recip();
        for entry in &mut column[j + 1..] {
            *entry *= inverse;
        }
    }
    Ok(sound)
}

/// The error for a pivot that is not positive: the numbers of the first lane that fails.
#[cold]
fn refused<T: Real>(pivot: usize, value: T, diagonal: T, threshold: T) -> NumericsError {
    let positive = |lane: usize| {
        let (value, diagonal) = (value.primal(lane), diagonal.primal(lane));
        0.0 < diagonal && threshold.primal(lane) * diagonal < value
    };
    let lane = (0..T::LANES).find(|&lane| !positive(lane)).unwrap_or(0);
    NumericsError::NotPositiveDefinite { pivot, value: value.primal(lane), diagonal: diagonal.primal(lane) }
}

/// Overwrites b with the solution of A x = b, from the factors of [`factor_in_place`].
///
/// # Errors
/// [`NumericsError::WrongLength`].
///
/// # Accuracy
/// Relative error of a few n ulp × the condition number of the matrix scaled to unit diagonal.
///
/// # Example
/// ```
/// use piola_numerics::linear::ldlt;
/// let (mut a, mut b) = ([4.0, 2.0, 2.0, 3.0], [8.0, 8.0]);
/// ldlt::factor_in_place(&mut a, 2)?;
/// ldlt::solve_in_place(&a, 2, &mut b)?;
/// assert_eq!(b, [1.0, 2.0]);
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn solve_in_place<T: Real>(factors: &[T], n: usize, b: &mut [T]) -> Result<(), NumericsError> {
    check_dimension("factors", factors.len(), n * n)?;
    check_dimension("right-hand side", b.len(), n)?;
    for k in 0..n {
        let x = b[k];
        for i in k + 1..n {
            b[i] -= factors[i + k * n] * x;
        }
    }
    for k in 0..n {
        b[k] /= factors[k + k * n];
    }
    for k in (0..n).rev() {
        let mut x = b[k];
        for i in k + 1..n {
            x -= factors[i + k * n] * b[i];
        }
        b[k] = x;
    }
    Ok(())
}

/// The direction z that a refused pivot stands for: zᵀ A z = dₖ, zₖ = 1, zᵢ = 0 for k < i.
///
/// When the matrix is a metric, z is the combination of the first k + 1 coordinates along which nothing moves.
/// `factors` is what [`factor_in_place`] left when it refused pivot `pivot`.
///
/// # Errors
/// [`NumericsError::WrongLength`], also for a pivot of n or more.
///
/// # Example
/// ```
/// use piola_numerics::linear::ldlt;
/// let mut a = [1.0, 2.0, 2.0, 4.0];
/// assert!(ldlt::factor_in_place(&mut a, 2).is_err()); // pivot 1
/// let mut z = [0.0; 2];
/// ldlt::null_direction_into(&a, 2, 1, &mut z)?;
/// assert_eq!(z, [-2.0, 1.0]); // row 2 − 2 · row 1 = 0
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
pub fn null_direction_into<T: Real>(
    factors: &[T],
    n: usize,
    pivot: usize,
    direction: &mut [T],
) -> Result<(), NumericsError> {
    check_dimension("factors", factors.len(), n * n)?;
    check_dimension("direction", direction.len(), n)?;
    if n <= pivot {
        return Err(NumericsError::WrongLength {
            quantity: "factors",
            expected: (pivot + 1) * (pivot + 1),
            found: n * n,
        });
    }
    direction.fill(T::zero());
    direction[pivot] = T::one();
    // Lᵀ z = e_k, from the last row upwards.
    for k in (0..pivot).rev() {
        let mut x = T::zero();
        for i in k + 1..=pivot {
            x -= factors[i + k * n] * direction[i];
        }
        direction[k] = x;
    }
    Ok(())
}

/// Solves A x = b for a matrix of constant size, without allocation and with unrolled loops.
///
/// # Errors
/// As [`factor_in_place`]; entries that are not finite are refused by name.
///
/// # Example
/// ```
/// use nalgebra::{matrix, vector};
/// let x = piola_numerics::linear::ldlt::solve(matrix![4.0, 2.0; 2.0, 3.0], vector![8.0, 8.0])?;
/// assert_eq!(x, vector![1.0, 2.0]);
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
#[inline]
pub fn solve<T: Real, const N: usize>(
    mut matrix: SMatrix<T, N, N>,
    mut right: SVector<T, N>,
) -> Result<SVector<T, N>, NumericsError> {
    check_finite("matrix", matrix.as_slice())?;
    check_finite("right-hand side", right.as_slice())?;
    factor_in_place(matrix.as_mut_slice(), N)?;
    solve_in_place(matrix.as_slice(), N, right.as_mut_slice())?;
    Ok(right)
}

/// The factors of a symmetric positive definite matrix whose size is known at run time.
///
/// # Example
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use piola_numerics::linear::ldlt::Ldlt;
/// let ldlt = Ldlt::new(&dmatrix![4.0, 2.0; 2.0, 3.0])?;
/// assert_eq!(ldlt.solve(&dvector![8.0, 8.0])?, dvector![1.0, 2.0]);
/// assert_eq!(ldlt.determinant(), 8.0);
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
#[doc(alias = "Cholesky")]
#[derive(Clone, Debug)]
pub struct Ldlt<T> {
    n: usize,
    factors: Vec<T>,
}

impl<T: Real> Ldlt<T> {
    /// Factors the lower triangle of a square matrix.
    ///
    /// # Errors
    /// [`NumericsError::WrongLength`], [`NumericsError::NotFinite`], [`NumericsError::NotPositiveDefinite`].
    pub fn new(matrix: &DMatrix<T>) -> Result<Self, NumericsError> {
        let n = matrix.ncols();
        let mut ldlt = Self { n, factors: vec![T::zero(); n * n] };
        ldlt.factor(matrix.as_slice())?;
        Ok(ldlt)
    }
    /// Factors another matrix of the same size, given down its columns, without allocating.
    ///
    /// # Errors
    /// As [`new`](Self::new). The factors are of no use after an error.
    pub fn factor(&mut self, matrix: &[T]) -> Result<(), NumericsError> {
        check_dimension("matrix", matrix.len(), self.n * self.n)?;
        check_finite("matrix", matrix)?;
        self.factors.copy_from_slice(matrix);
        factor_in_place(&mut self.factors, self.n)
    }
    /// The number of rows.
    #[must_use]
    pub fn order(&self) -> usize {
        self.n
    }
    /// L below the diagonal and D on it, down the columns; above the diagonal the matrix as it was given.
    #[must_use]
    pub fn factors(&self) -> &[T] {
        &self.factors
    }
    /// The solution of A x = b.
    ///
    /// # Errors
    /// [`NumericsError::WrongLength`], [`NumericsError::NotFinite`].
    pub fn solve(&self, right: &DVector<T>) -> Result<DVector<T>, NumericsError> {
        let mut solution = right.clone();
        check_finite("right-hand side", right.as_slice())?;
        self.solve_in_place(solution.as_mut_slice())?;
        Ok(solution)
    }
    /// Overwrites b with the solution of A x = b, without allocating.
    ///
    /// # Errors
    /// [`NumericsError::WrongLength`].
    #[inline]
    pub fn solve_in_place(&self, right: &mut [T]) -> Result<(), NumericsError> {
        solve_in_place(&self.factors, self.n, right)
    }
    /// det A = d₁ ⋯ dₙ.
    #[must_use]
    pub fn determinant(&self) -> T {
        (0..self.n).fold(T::one(), |product, k| product * self.factors[k + k * self.n])
    }
}

impl Ldlt<f64> {
    /// The condition number ‖A‖₁ ‖A⁻¹‖₁, by which relative errors of A and b are magnified in x: exact to
    /// rounding for n ≤ 10, an estimate from below for larger n, rarely less than a third of it.
    ///
    /// `matrix` is the matrix that was factored, both triangles, down its columns.
    ///
    /// # Errors
    /// [`NumericsError::WrongLength`].
    ///
    /// # Example
    /// ```
    /// use nalgebra::dmatrix;
    /// use piola_numerics::linear::ldlt::Ldlt;
    /// let a = dmatrix![1.0, 0.0; 0.0, 1e-8];
    /// let condition = Ldlt::new(&a)?.condition_estimate(a.as_slice())?;
    /// assert!((condition - 1e8).abs() < 1.0);
    /// # Ok::<(), piola_numerics::NumericsError>(())
    /// ```
    pub fn condition_estimate(&self, matrix: &[f64]) -> Result<f64, NumericsError> {
        check_dimension("matrix", matrix.len(), self.n * self.n)?;
        let solve = |x: &mut [f64]| {
            // The vector has the right length, so that nothing can be refused.
            let _ = self.solve_in_place(x);
        };
        Ok(one_norm(matrix, self.n) * condition::inverse_norm(self.n, solve, solve))
    }
    /// Improves a solution x of A x = b by the residual, which is computed in twice the precision:
    /// r = b − A x, x ← x + A⁻¹ r, until the correction is below an ulp or stops getting smaller (at most
    /// ten times). Returns the size of the last correction relative to x, in the largest entry: about the
    /// relative error of x before it, so the digits of x can be trusted down to an ulp when it is below
    /// 10⁻⁸.
    ///
    /// `matrix` is the matrix that was factored, both triangles, down its columns; `residual` is scratch of
    /// the length of b. Nothing is allocated.
    ///
    /// # Errors
    /// [`NumericsError::WrongLength`].
    ///
    /// # Example
    /// ```
    /// use nalgebra::dmatrix;
    /// use piola_numerics::linear::ldlt::Ldlt;
    /// let a = dmatrix![4.0, 2.0; 2.0, 3.0];
    /// let (b, mut x, mut scratch) = ([8.0, 8.0], [1.1, 1.9], [0.0; 2]);
    /// Ldlt::new(&a)?.refine(a.as_slice(), &b, &mut x, &mut scratch)?;
    /// assert_eq!(x, [1.0, 2.0]);
    /// # Ok::<(), piola_numerics::NumericsError>(())
    /// ```
    pub fn refine(
        &self,
        matrix: &[f64],
        right: &[f64],
        x: &mut [f64],
        residual: &mut [f64],
    ) -> Result<f64, NumericsError> {
        let n = self.n;
        check_dimension("matrix", matrix.len(), n * n)?;
        check_dimension("right-hand side", right.len(), n)?;
        check_dimension("solution", x.len(), n)?;
        check_dimension("residual", residual.len(), n)?;
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        let mut last = f64::INFINITY;
        for _ in 0..10 {
            for (i, r) in residual.iter_mut().enumerate() {
                let mut sum = CompensatedSum::new();
                sum.add(right[i]);
                for j in 0..n {
                    sum.add_product(-matrix[i + j * n], x[j]);
                }
                *r = sum.value();
            }
            self.solve_in_place(residual)?;
            let size = largest(x);
            let correction = if 0.0 < size { largest(residual) / size } else { largest(residual) };
            // A correction that does not shrink is rounding, or the matrix is too ill-conditioned; NaN too.
            let shrinks = correction < last;
            if !shrinks {
                break;
            }
            last = correction;
            for (x, r) in x.iter_mut().zip(residual.iter()) {
                *x += r;
            }
            if correction <= 0.5 * f64::EPSILON {
                break;
            }
        }
        Ok(if n == 0 { 0.0 } else { last })
    }
}
