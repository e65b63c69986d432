//! L U with row exchanges of sparse matrices, column by column, by `faer`.
//!
//! The order of the columns (COLAMD) is all that is found before: rows are exchanged as the pivots ask. It serves the real
//! and the complex matrices of all steps. A factorisation writes to the memory of the one before, which grows only where the
//! pivots of later ones fill in more entries.

use core::fmt;

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::perm::{Perm, PermRef};
use faer::sparse::linalg::lu::simplicial::{
    SimplicialLu, factorize_simplicial_numeric_lu, factorize_simplicial_numeric_lu_scratch, solve_in_place_scratch,
};
use faer::sparse::linalg::{LuError, colamd};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::traits::ComplexField;
use faer::{Conj, MatMut, Par};
use num_complex::Complex64;

use super::lu::Entry;
use crate::Sparsity;

/// The order in which the columns of a pattern are eliminated, and memory for the work.
#[derive(Clone, Debug)]
pub(super) struct ColumnOrder {
    columns: Perm<usize>,
    memory: Memory,
}

impl ColumnOrder {
    pub(super) fn of(sparsity: &Sparsity) -> Self {
        let n = sparsity.dimension();
        let of_one = |one| StackReq::any_of(&[one, colamd::order_scratch::<usize>(n, n, sparsity.count())]);
        let needed = StackReq::any_of(&[of_one(scratch::<f64>(n)), of_one(scratch::<Complex64>(n))]);
        let mut memory = Memory::new(needed);
        let (mut forward, mut inverse) = (vec![0; n], vec![0; n]);
        let stack = MemStack::new(&mut memory.buffer);
        let control = colamd::Control::default();
        if n == 0 || colamd::order(&mut forward, &mut inverse, symbolic(sparsity), control, stack).is_err() {
            // Any order serves.
            forward = (0..n).collect();
            inverse.clone_from(&forward);
        }
        Self { columns: Perm::new_checked(forward.into(), inverse.into(), n), memory }
    }
}

fn scratch<T: ComplexField>(n: usize) -> StackReq {
    let factoring = factorize_simplicial_numeric_lu_scratch::<usize, T>(n, n);
    StackReq::any_of(&[factoring, solve_in_place_scratch::<usize, T>(n, 1, Par::Seq)])
}

fn symbolic(sparsity: &Sparsity) -> SymbolicSparseColMatRef<'_, usize> {
    let (n, (starts, rows)) = (sparsity.dimension(), sparsity.columns());
    SymbolicSparseColMatRef::new_checked(n, n, starts, None, rows)
}

/// Memory for the work of `faer`, which has nothing in it between two calls.
struct Memory {
    needed: StackReq,
    buffer: MemBuffer,
}

impl Memory {
    fn new(needed: StackReq) -> Self {
        Self { needed, buffer: MemBuffer::new(needed) }
    }
}

impl Clone for Memory {
    fn clone(&self) -> Self {
        Self::new(self.needed)
    }
}

impl fmt::Debug for Memory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Memory").field(&self.needed).finish()
    }
}

/// The entries of a matrix on a pattern, and its factors.
#[derive(Clone, Debug)]
pub(super) struct SparseFactors<T> {
    pub(super) entries: Vec<T>,
    factors: SimplicialLu<usize, T>,
    rows: Vec<usize>,
    rows_inverse: Vec<usize>,
}

impl<T: Entry + ComplexField> SparseFactors<T> {
    pub(super) fn of(sparsity: &Sparsity) -> Self {
        let n = sparsity.dimension();
        Self {
            entries: vec![T::default(); sparsity.count()],
            factors: SimplicialLu::new(),
            rows: vec![0; n],
            rows_inverse: vec![0; n],
        }
    }

    /// Factors the matrix.
    ///
    /// # Errors
    /// The column of the first pivot that is zero or not finite.
    pub(super) fn factor(&mut self, sparsity: &Sparsity, order: &mut ColumnOrder) -> Result<(), usize> {
        let matrix = SparseColMatRef::new(symbolic(sparsity), &self.entries);
        let columns = order.columns.as_ref();
        let column_of = |pivot: usize| columns.arrays().0.get(pivot).copied().unwrap_or(pivot);
        let stack = MemStack::new(&mut order.memory.buffer);
        let (rows, rows_inverse) = (&mut self.rows, &mut self.rows_inverse);
        match factorize_simplicial_numeric_lu(rows, rows_inverse, &mut self.factors, matrix, columns, stack) {
            Ok(()) => {}
            Err(LuError::SymbolicSingular { index }) => return Err(column_of(index)),
            // Out of memory.
            Err(LuError::Generic(_)) => return Err(0),
        }
        // The pivot is the last entry of its column of U.
        let upper = self.factors.u_factor_unsorted();
        for (pivot, &end) in upper.col_ptr().iter().skip(1).enumerate() {
            let size = upper.val()[end - 1].size();
            if !(0.0 < size && size < f64::INFINITY) {
                return Err(column_of(pivot));
            }
        }
        Ok(())
    }

    /// Overwrites b with the solution.
    pub(super) fn solve(&self, order: &mut ColumnOrder, b: &mut [T]) {
        let n = self.rows.len();
        let rows = PermRef::new_checked(&self.rows, &self.rows_inverse, n);
        let columns = order.columns.as_ref();
        let stack = MemStack::new(&mut order.memory.buffer);
        let b = MatMut::from_column_major_slice_mut(b, n, 1);
        self.factors.solve_in_place_with_conj(rows, columns, Conj::No, b, Par::Seq, stack);
    }
}
