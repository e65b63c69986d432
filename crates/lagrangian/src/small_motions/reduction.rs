//! Coordinates in which the mass matrix is the unit matrix.

use core::cmp::Ordering;

use nalgebra::{ComplexField, DMatrix, DVector};
use piola_numerics::linear::ldlt;
use piola_numerics::{NumericsError, Real};

use crate::LagrangianError;

/// R with M = R Rᵀ, lower triangular: the coordinates y = Rᵀ q have the unit mass matrix.
///
/// The matrix is scaled to unit diagonal before it is factored, so that the units of the coordinates do not
/// matter.
pub(super) struct Reduction {
    root: DMatrix<f64>,
}

impl Reduction {
    pub(super) fn of(mass_matrix: &DMatrix<f64>) -> Result<Self, LagrangianError> {
        let n = mass_matrix.nrows();
        // The root of a diagonal entry that is not positive would hide it.
        if let Some((pivot, value)) = (0..n).map(|i| (i, mass_matrix[(i, i)])).find(|&(_, x)| x <= 0.0) {
            let mut direction = vec![0.0; n];
            direction[pivot] = 1.0;
            return Err(LagrangianError::SingularMetric {
                coordinate: pivot,
                pivot: value,
                diagonal: value,
                direction,
            });
        }
        let units = DVector::from_fn(n, |i, _| mass_matrix[(i, i)].sqrt());
        let mut factors = DMatrix::from_fn(n, n, |i, j| mass_matrix[(i, j)] / (units[i] * units[j]));
        ldlt::factor_in_place(factors.as_mut_slice(), n).map_err(|error| singular(mass_matrix, error))?;
        let root = DMatrix::from_fn(n, n, |i, j| {
            let pivot = factors[(j, j)].sqrt() * units[i];
            match i.cmp(&j) {
                Ordering::Less => 0.0,
                Ordering::Equal => pivot,
                Ordering::Greater => factors[(i, j)] * pivot,
            }
        });
        Ok(Self { root })
    }

    /// R⁻¹ A R⁻ᵀ.
    pub(super) fn of_form(&self, form: &DMatrix<f64>) -> DMatrix<f64> {
        let mut half = form.clone();
        self.solve_lower(&mut half);
        let mut whole = half.transpose();
        self.solve_lower(&mut whole);
        whole.transpose()
    }

    fn solve_lower(&self, columns: &mut DMatrix<f64>) {
        let n = self.root.nrows();
        for mut column in columns.column_iter_mut() {
            for k in 0..n {
                let x = column[k] / self.root[(k, k)];
                column[k] = x;
                for i in k + 1..n {
                    column[i] -= self.root[(i, k)] * x;
                }
            }
        }
    }

    /// q = R⁻ᵀ y.
    pub(super) fn shape<Z: ComplexField<RealField = f64> + Copy>(&self, y: &DVector<Z>) -> DVector<Z> {
        let n = self.root.nrows();
        let mut q = y.clone();
        for k in (0..n).rev() {
            let mut x = q[k];
            for i in k + 1..n {
                x -= q[i].scale(self.root[(i, k)]);
            }
            q[k] = x.unscale(self.root[(k, k)]);
        }
        q
    }
}

/// A mass matrix that is not positive definite, with the direction that has no inertia.
#[cold]
pub(super) fn singular<T: Real>(mass_matrix: &DMatrix<T>, error: NumericsError) -> LagrangianError {
    let NumericsError::NotPositiveDefinite { pivot, value, diagonal } = error else { return error.into() };
    let n = mass_matrix.nrows();
    let mut factors = mass_matrix.clone();
    let mut direction = vec![T::zero(); n];
    if ldlt::factor_in_place(factors.as_mut_slice(), n).is_ok()
        || ldlt::null_direction_into(factors.as_slice(), n, pivot, &mut direction).is_err()
    {
        direction.clear();
    }
    let direction = direction.into_iter().map(|x| x.primal(0)).collect();
    LagrangianError::SingularMetric { coordinate: pivot, pivot: value, diagonal, direction }
}
