//! Mass matrix, Jacobian and the factored matrices of a step, dense or sparse.

use core::ops::{AddAssign, Mul};

use num_complex::Complex64;

use super::lu::Factors;

#[cfg(feature = "sparse")]
use super::sparse::SparseMatrices;
use super::tableau::{MOST_STAGES, Tableau};
use crate::StiffField;
use piola_integrators::IntegratorsError;
use piola_integrators::internal::check_finite;

/// M, J, γ/h M − J and (α − iβ)/h M − J.
#[derive(Clone, Debug)]
pub(super) enum Matrices {
    Dense(Box<DenseMatrices>),
    #[cfg(feature = "sparse")]
    Sparse(Box<SparseMatrices>),
}

impl Default for Matrices {
    fn default() -> Self {
        Self::Dense(Box::default())
    }
}

impl Matrices {
    /// Takes the mass matrix of a field and makes room for the rest, with so many complex matrices.
    ///
    /// # Errors
    /// Mass matrix and pattern must fit the field.
    pub(super) fn begin<F: StiffField>(
        &mut self,
        n: usize,
        pairs: usize,
        field: &F,
    ) -> Result<(), IntegratorsError<F::Error>> {
        check_mass(n, field)?;
        #[cfg(feature = "sparse")]
        if let Some(sparsity) = field.sparsity() {
            let found = sparsity.dimension();
            if found != n {
                return Err(IntegratorsError::WrongLength { quantity: "sparsity", expected: n, found });
            }
            let known = match self {
                Self::Sparse(matrices) => matrices.is_of(sparsity, field),
                Self::Dense(_) => false,
            };
            if !known {
                *self = Self::Sparse(Box::new(SparseMatrices::new(sparsity, field)));
            }
            return Ok(());
        }
        match self {
            Self::Dense(dense) => dense.begin(n, pairs, field),
            #[cfg(feature = "sparse")]
            Self::Sparse(_) => {
                let mut dense = Box::<DenseMatrices>::default();
                dense.begin(n, pairs, field);
                *self = Self::Dense(dense);
            }
        }
        Ok(())
    }

    /// J: n×n down the columns, or the entries of the field's pattern.
    pub(super) fn jacobian(&mut self) -> &mut [f64] {
        match self {
            Self::Dense(dense) => &mut dense.jacobian,
            #[cfg(feature = "sparse")]
            Self::Sparse(sparse) => &mut sparse.jacobian,
        }
    }

    /// J as it is.
    pub(super) fn jacobian_in_memory(&self) -> &[f64] {
        match self {
            Self::Dense(dense) => &dense.jacobian,
            #[cfg(feature = "sparse")]
            Self::Sparse(sparse) => &sparse.jacobian,
        }
    }

    /// Factors γ/h M − J and (α − iβ)/h M − J; the index of a pivot that is zero where there is one.
    pub(super) fn factor(&mut self, tableau: &Tableau, h: f64) -> Result<(), usize> {
        match self {
            Self::Dense(dense) => dense.factor(tableau, h),
            #[cfg(feature = "sparse")]
            Self::Sparse(sparse) => sparse.factor(tableau, h),
        }
    }

    /// b ← (γ/h M − J)⁻¹ b.
    pub(super) fn solve_real(&mut self, b: &mut [f64]) {
        match self {
            Self::Dense(dense) => dense.real.solve(b),
            #[cfg(feature = "sparse")]
            Self::Sparse(sparse) => sparse.solve_real(b),
        }
    }

    /// b ← ((α − iβ)/h M − J)⁻¹ b for one of the pairs.
    pub(super) fn solve_complex(&mut self, pair: usize, b: &mut [Complex64]) {
        match self {
            Self::Dense(dense) => dense.complex[pair].solve(b),
            #[cfg(feature = "sparse")]
            Self::Sparse(sparse) => sparse.solve_complex(pair, b),
        }
    }

    /// r ← r − M x.
    pub(super) fn subtract_mass_times(&self, x: &[f64], r: &mut [f64]) {
        match self {
            Self::Dense(dense) => dense.subtract_mass_times(x, r),
            #[cfg(feature = "sparse")]
            Self::Sparse(sparse) => sparse.subtract_mass_times(x, r),
        }
    }
}

/// Refuses a mass matrix that does not fit or is not finite.
fn check_mass<F: StiffField>(n: usize, field: &F) -> Result<(), IntegratorsError<F::Error>> {
    if let Some(mass) = field.mass() {
        if mass.len() != n * n {
            return Err(IntegratorsError::WrongLength { quantity: "mass", expected: n * n, found: mass.len() });
        }
        return check_finite("mass", None, mass);
    }
    for (index, &(row, column, value)) in field.mass_entries().unwrap_or_default().iter().enumerate() {
        if n <= row.max(column) {
            return Err(IntegratorsError::OutsideMatrix { quantity: "mass", row, column, dimension: n });
        }
        if !value.is_finite() {
            return Err(IntegratorsError::NotFinite { quantity: "mass", index, value, t: None });
        }
    }
    Ok(())
}

/// entries ← entries + factor M; M is the identity where it is empty.
fn add_mass<T: Copy + AddAssign + Mul<f64, Output = T>>(mass: &[f64], factor: T, n: usize, entries: &mut [T]) {
    if mass.is_empty() {
        for entry in entries.iter_mut().step_by(n + 1) {
            *entry += factor;
        }
    } else {
        for (entry, &m) in entries.iter_mut().zip(mass) {
            *entry += factor * m;
        }
    }
}

/// Matrices of n×n entries, down their columns.
#[derive(Clone, Debug, Default)]
pub(super) struct DenseMatrices {
    jacobian: Vec<f64>,
    /// Empty for the identity.
    mass: Vec<f64>,
    real: Factors<f64>,
    complex: [Factors<Complex64>; MOST_STAGES / 2],
}

impl DenseMatrices {
    fn begin<F: StiffField>(&mut self, n: usize, pairs: usize, field: &F) {
        self.jacobian.resize(n * n, 0.0);
        self.mass.clear();
        if let Some(mass) = field.mass() {
            self.mass.extend_from_slice(mass);
        } else if let Some(entries) = field.mass_entries() {
            self.mass.resize(n * n, 0.0);
            for &(row, column, value) in entries {
                if let Some(entry) = self.mass.get_mut(row + column * n) {
                    *entry += value;
                }
            }
        }
        self.real.resize(n);
        for factors in self.complex.iter_mut().take(pairs) {
            factors.resize(n);
        }
    }

    fn factor(&mut self, tableau: &Tableau, h: f64) -> Result<(), usize> {
        let n = self.real.order();
        let gamma = tableau.real / h;
        for (entry, j) in self.real.entries.iter_mut().zip(&self.jacobian) {
            *entry = -j;
        }
        add_mass(&self.mass, gamma, n, &mut self.real.entries);
        self.real.factor()?;
        for (factors, &[alpha, beta]) in self.complex.iter_mut().zip(tableau.pairs) {
            for (entry, j) in factors.entries.iter_mut().zip(&self.jacobian) {
                *entry = Complex64::new(-j, 0.0);
            }
            add_mass(&self.mass, Complex64::new(alpha / h, -beta / h), n, &mut factors.entries);
            factors.factor()?;
        }
        Ok(())
    }

    fn subtract_mass_times(&self, x: &[f64], r: &mut [f64]) {
        if self.mass.is_empty() {
            for (r, x) in r.iter_mut().zip(x) {
                *r -= x;
            }
            return;
        }
        for (column, x) in self.mass.chunks_exact(r.len().max(1)).zip(x) {
            for (r, m) in r.iter_mut().zip(column) {
                *r -= m * x;
            }
        }
    }
}
