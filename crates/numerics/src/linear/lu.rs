//! L U with row exchanges, for any regular matrix.
//!
//! ```text
//! P A = L U        L unit lower triangular with |l| ≤ 1,   U upper triangular,   P a permutation
//! ```
//!
//! The pivot of column k is its largest entry by value. Over lanes one order of rows serves all lanes: the
//! row is taken whose smallest share, over the lanes, of the lane's largest entry is greatest. Matrices
//! that belong together (neighbouring states of one system) so lose nothing; of unrelated matrices one may
//! be refused in lanes that alone would be solved.
//!
//! A pivot is compared with the largest entry that its column had in A, so that the units of the unknowns
//! do not matter: n ulp · max|aᵢₖ| < |uₖₖ|.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};

use super::{condition, one_norm};
use crate::error::{check_dimension, check_finite};
use crate::sums::unit_in_last_place;
use crate::{Mask, NumericsError, Real};

/// Factors an n×n matrix in place: L below the diagonal, U on and above it, and the row that was exchanged
/// with row k in `exchanges[k]`.
///
/// # Errors
/// [`NumericsError::WrongLength`]; [`NumericsError::Singular`] with the first pivot that is zero to rounding, or NaN, in any
/// lane.
///
/// # Accuracy
/// L U is P A to a few n ulp of the largest entry (growth of the pivots, rare, apart).
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn factor_in_place<T: Real>(a: &mut [T], exchanges: &mut [usize]) -> Result<(), NumericsError> {
    let n = exchanges.len();
    check_dimension("matrix", a.len(), n * n)?;
    let threshold = T::lit(n as f64 * unit_in_last_place::<T>());
    for j in 0..n {
        let scale = a[j * n..(j + 1) * n].iter().fold(T::zero(), |largest, x| largest.max(x.abs()));
        for k in 0..j {
            // Column j loses its part along column k: a_ij ← a_ij − l_ik u_kj.
            let (before, column) = a.split_at_mut(j * n);
            let weight = column[k];
            let (left, column) = (&before[k * n..(k + 1) * n], &mut column[..n]);
            for i in k + 1..n {
                column[i] -= left[i] * weight;
            }
        }
        let row = pivot_row(&a[j * n..(j + 1) * n], j);
        exchanges[j] = row;
        if row != j {
            for k in 0..n {
                a.swap(j + k * n, row + k * n);
            }
        }
        let pivot = a[j + j * n];
        if !(threshold * scale).less_than(pivot.abs()).all() {
            return Err(refused(j, pivot, scale, threshold));
        }
        let inverse = pivot.recip();
        for i in j + 1..n {
            a[i + j * n] *= inverse;
        }
    }
    Ok(())
}

/// The row, from `start` on, whose entry is largest; over lanes by its smallest share of the lane's largest.
#[cfg_attr(not(debug_assertions), inline(always))]
fn pivot_row<T: Real>(column: &[T], start: usize) -> usize {
    let share = |entry: T, lane: usize| {
        if T::LANES == 1 {
            return entry.primal(0).abs();
        }
        let largest = column[start..].iter().fold(0.0_f64, |m, x| m.max(x.primal(lane).abs()));
        entry.primal(lane).abs() / largest
    };
    let mut best = (start, -1.0);
    for (i, &entry) in column.iter().enumerate().skip(start) {
        let share = (0..T::LANES).map(|lane| share(entry, lane)).fold(f64::INFINITY, f64::min);
        if best.1 < share {
            best = (i, share);
        }
    }
    best.0
}

/// The error for a pivot that is zero to rounding: the numbers of the first lane that fails.
#[cold]
fn refused<T: Real>(pivot: usize, value: T, scale: T, threshold: T) -> NumericsError {
    let regular = |lane: usize| threshold.primal(lane) * scale.primal(lane) < value.primal(lane).abs();
    let lane = (0..T::LANES).find(|&lane| !regular(lane)).unwrap_or(0);
    NumericsError::Singular { pivot, value: value.primal(lane), scale: scale.primal(lane) }
}

/// Overwrites b with the solution of A x = b, from the factors of [`factor_in_place`].
///
/// # Errors
/// [`NumericsError::WrongLength`].
///
/// # Accuracy
/// Relative error of a few n ulp × the condition number.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn solve_in_place<T: Real>(factors: &[T], exchanges: &[usize], b: &mut [T]) -> Result<(), NumericsError> {
    let n = exchanges.len();
    check_dimension("factors", factors.len(), n * n)?;
    check_dimension("right-hand side", b.len(), n)?;
    for (k, &row) in exchanges.iter().enumerate() {
        b.swap(k, row);
    }
    for k in 0..n {
        let x = b[k];
        for i in k + 1..n {
            b[i] -= factors[i + k * n] * x;
        }
    }
    for k in (0..n).rev() {
        let x = b[k] / factors[k + k * n];
        b[k] = x;
        for i in 0..k {
            b[i] -= factors[i + k * n] * x;
        }
    }
    Ok(())
}

/// Overwrites b with the solution of Aᵀ x = b, from the factors of A.
///
/// # Errors
/// [`NumericsError::WrongLength`].
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn solve_transposed_in_place<T: Real>(
    factors: &[T],
    exchanges: &[usize],
    b: &mut [T],
) -> Result<(), NumericsError> {
    let n = exchanges.len();
    check_dimension("factors", factors.len(), n * n)?;
    check_dimension("right-hand side", b.len(), n)?;
    for k in 0..n {
        let mut x = b[k];
        for i in 0..k {
            x -= factors[i + k * n] * b[i];
        }
        b[k] = x / factors[k + k * n];
    }
    for k in (0..n).rev() {
        let mut x = b[k];
        for i in k + 1..n {
            x -= factors[i + k * n] * b[i];
        }
        b[k] = x;
    }
    for (k, &row) in exchanges.iter().enumerate().rev() {
        b.swap(k, row);
    }
    Ok(())
}

/// Solves A x = b for a matrix of constant size, without allocation and with unrolled loops.
///
/// # Errors
/// As [`factor_in_place`]; entries that are not finite are refused by name.
#[inline]
pub fn solve<T: Real, const N: usize>(
    mut matrix: SMatrix<T, N, N>,
    mut right: SVector<T, N>,
) -> Result<SVector<T, N>, NumericsError> {
    check_finite("matrix", matrix.as_slice())?;
    check_finite("right-hand side", right.as_slice())?;
    let mut exchanges = [0; N];
    factor_in_place(matrix.as_mut_slice(), &mut exchanges)?;
    solve_in_place(matrix.as_slice(), &exchanges, right.as_mut_slice())?;
    Ok(right)
}

/// The factors of a regular matrix whose size is known at run time.
///
/// # Example
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use piola_numerics::linear::lu::Lu;
/// let lu = Lu::new(&dmatrix![0.0, 1.0; 2.0, 0.0])?;
/// assert_eq!(lu.solve(&dvector![3.0, 4.0])?, dvector![2.0, 3.0]);
/// assert_eq!(lu.determinant(), -2.0);
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
#[doc(alias = "Gaussian elimination")]
#[derive(Clone, Debug)]
pub struct Lu<T> {
    factors: Vec<T>,
    exchanges: Vec<usize>,
}

impl<T: Real> Lu<T> {
    /// Factors a square matrix.
    ///
    /// # Errors
    /// [`NumericsError::WrongLength`], [`NumericsError::NotFinite`], [`NumericsError::Singular`].
    pub fn new(matrix: &DMatrix<T>) -> Result<Self, NumericsError> {
        let n = matrix.ncols();
        let mut lu = Self { factors: vec![T::zero(); n * n], exchanges: vec![0; n] };
        lu.factor(matrix.as_slice())?;
        Ok(lu)
    }
    /// Factors another matrix of the same size, given down its columns, without allocating.
    ///
    /// # Errors
    /// As [`new`](Self::new). The factors are of no use after an error.
    pub fn factor(&mut self, matrix: &[T]) -> Result<(), NumericsError> {
        check_dimension("matrix", matrix.len(), self.factors.len())?;
        check_finite("matrix", matrix)?;
        self.factors.copy_from_slice(matrix);
        factor_in_place(&mut self.factors, &mut self.exchanges)
    }
    /// The number of rows.
    #[must_use]
    pub fn order(&self) -> usize {
        self.exchanges.len()
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
        solve_in_place(&self.factors, &self.exchanges, right)
    }
    /// Overwrites b with the solution of Aᵀ x = b, without allocating.
    ///
    /// # Errors
    /// [`NumericsError::WrongLength`].
    #[inline]
    pub fn solve_transposed_in_place(&self, right: &mut [T]) -> Result<(), NumericsError> {
        solve_transposed_in_place(&self.factors, &self.exchanges, right)
    }
    /// det A: the product of the pivots, with a sign for each exchange of rows.
    #[must_use]
    pub fn determinant(&self) -> T {
        let n = self.order();
        self.exchanges.iter().enumerate().fold(T::one(), |product, (k, &row)| {
            let pivot = self.factors[k + k * n];
            product * if row == k { pivot } else { -pivot }
        })
    }
}

impl Lu<f64> {
    /// The condition number ‖A‖₁ ‖A⁻¹‖₁, by which relative errors of A and b are magnified in x: exact to
    /// rounding for n ≤ 10, an estimate from below for larger n, rarely less than a third of it.
    ///
    /// `matrix` is the matrix that was factored, down its columns.
    ///
    /// # Errors
    /// [`NumericsError::WrongLength`].
    pub fn condition_estimate(&self, matrix: &[f64]) -> Result<f64, NumericsError> {
        check_dimension("matrix", matrix.len(), self.factors.len())?;
        // The vectors have the right length, so that nothing can be refused.
        let solve = |x: &mut [f64]| {
            let _ = self.solve_in_place(x);
        };
        let solve_transposed = |x: &mut [f64]| {
            let _ = self.solve_transposed_in_place(x);
        };
        let n = self.order();
        Ok(one_norm(matrix, n) * condition::inverse_norm(n, solve, solve_transposed))
    }
}
