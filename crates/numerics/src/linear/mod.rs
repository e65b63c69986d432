//! Linear systems over any [`Real`](crate::Real): what nalgebra has for floats only.
//!
//! | the matrix is | use |
//! |---|---|
//! | symmetric positive definite: a metric, a mass matrix | [`ldlt`] |
//! | `AᵀA` of rows A: a metric too ill-conditioned to be formed | [`least_squares`] |
//! | any regular matrix | [`lu`] |
//! | 3×3, in a kernel or in lanes | [`matrix3`] |
//!
//! Each module has kernels on slices, which never allocate, and a type that owns its matrix. Matrices are
//! stored down the columns, entry (i, j) at `i + j * n`, as in nalgebra. Over differentiable numbers the
//! solution carries its derivatives; decisions look at values only.
//!
//! The dimension is a run-time number; all kernels are inlined, so where it is a constant of the caller the
//! loops unroll. Dimension zero is allowed: there is nothing to factor, and the determinant is one.
//!
//! How much to trust a solution in f64: [`condition_estimate`](lu::Lu::condition_estimate) bounds the loss
//! of digits, [`refine`](ldlt::Ldlt::refine) wins back those lost in the factorisation.

mod condition;
pub(crate) mod independent_rows;
pub mod ldlt;
pub mod least_squares;
pub mod lu;
pub mod matrix3;
pub(crate) mod vectors;

/// Largest column sum of |a|: the 1-norm of an n×n matrix stored down the columns.
fn one_norm(matrix: &[f64], n: usize) -> f64 {
    matrix.chunks_exact(n.max(1)).map(|column| column.iter().map(|a| a.abs()).sum()).fold(0.0, f64::max)
}
