//! Mass matrix, Jacobian and the factored matrices of a step by their entries.

use num_complex::Complex64;

use super::sparse_lu::{ColumnOrder, SparseFactors};
use super::tableau::{MOST_STAGES, Tableau};
use crate::{Sparsity, StiffField};

/// M, J, γ/h M − J and (α − iβ)/h M − J on the union of the patterns of M and J.
#[derive(Clone, Debug)]
pub(super) struct SparseMatrices {
    /// That of J, and J.
    sparsity: Sparsity,
    pub(super) jacobian: Vec<f64>,
    /// Where the entries of J stand in the union.
    places: Vec<usize>,
    /// The entries of M; none where M is the identity.
    mass_entries: Option<Vec<(usize, usize, f64)>>,
    union: Sparsity,
    /// M on the union.
    mass: Vec<f64>,
    order: ColumnOrder,
    real: SparseFactors<f64>,
    complex: [SparseFactors<Complex64>; MOST_STAGES / 2],
}

/// The entries of M in the form in which the field holds them.
fn mass_entries<F: StiffField>(field: &F, n: usize) -> Option<impl Iterator<Item = (usize, usize, f64)>> {
    let (columns, entries) = (field.mass(), field.mass_entries());
    let columns = columns.unwrap_or_default().iter().enumerate();
    let nonzero = columns.filter(|(_, value)| 0.0 < value.abs()).map(move |(k, &value)| (k % n, k / n, value));
    let entries = entries.filter(|_| field.mass().is_none()).unwrap_or_default().iter().copied();
    (field.mass().is_some() || field.mass_entries().is_some()).then(|| nonzero.chain(entries))
}

impl SparseMatrices {
    pub(super) fn new<F: StiffField>(sparsity: &Sparsity, field: &F) -> Self {
        let n = sparsity.dimension();
        let mass_entries: Option<Vec<_>> = mass_entries(field, n).map(Iterator::collect);
        let ones = (0..n).map(|k| (k, k, 1.0));
        let entries: Vec<(usize, usize, f64)> =
            mass_entries.as_ref().map_or_else(|| ones.collect(), |entries: &Vec<_>| entries.clone());
        let of_mass =
            entries.iter().map(|&(row, column, _)| (row, column)).filter(|&(row, column)| row.max(column) < n);
        // All entries lie within the matrix: nothing is refused.
        let union = Sparsity::from_entries(n, sparsity.entries().chain(of_mass)).unwrap_or_else(|_| sparsity.clone());
        let mut mass = vec![0.0; union.count()];
        for (row, column, value) in entries {
            if let Some(place) = union.place(row, column) {
                mass[place] += value;
            }
        }
        let places = sparsity.entries().filter_map(|(row, column)| union.place(row, column)).collect();
        Self {
            sparsity: sparsity.clone(),
            jacobian: vec![0.0; sparsity.count()],
            places,
            mass_entries,
            mass,
            order: ColumnOrder::of(&union),
            real: SparseFactors::of(&union),
            complex: core::array::from_fn(|_| SparseFactors::of(&union)),
            union,
        }
    }

    /// Whether these are the matrices of a field, so that pattern and order of elimination serve again.
    pub(super) fn is_of<F: StiffField>(&self, sparsity: &Sparsity, field: &F) -> bool {
        let is_same_mass = match (&self.mass_entries, mass_entries(field, sparsity.dimension())) {
            (None, None) => true,
            (Some(known), Some(given)) => known.iter().copied().eq(given),
            _ => false,
        };
        is_same_mass && self.sparsity == *sparsity
    }

    pub(super) fn factor(&mut self, tableau: &Tableau, h: f64) -> Result<(), usize> {
        let gamma = tableau.real / h;
        for (entry, mass) in self.real.entries.iter_mut().zip(&self.mass) {
            *entry = gamma * mass;
        }
        for (&place, j) in self.places.iter().zip(&self.jacobian) {
            self.real.entries[place] -= j;
        }
        self.real.factor(&self.union, &mut self.order)?;
        for (factors, [alpha, beta]) in self.complex.iter_mut().zip(tableau.pairs) {
            let (alpha, beta) = (alpha / h, beta / h);
            for (entry, mass) in factors.entries.iter_mut().zip(&self.mass) {
                *entry = Complex64::new(alpha * mass, -beta * mass);
            }
            for (&place, j) in self.places.iter().zip(&self.jacobian) {
                factors.entries[place].re -= j;
            }
            factors.factor(&self.union, &mut self.order)?;
        }
        Ok(())
    }

    pub(super) fn solve_real(&mut self, b: &mut [f64]) {
        self.real.solve(&mut self.order, b);
    }

    pub(super) fn solve_complex(&mut self, pair: usize, b: &mut [Complex64]) {
        self.complex[pair].solve(&mut self.order, b);
    }

    pub(super) fn subtract_mass_times(&self, x: &[f64], r: &mut [f64]) {
        if self.mass_entries.is_none() {
            for (r, x) in r.iter_mut().zip(x) {
                *r -= x;
            }
            return;
        }
        let (starts, rows) = self.union.columns();
        for (ends, x) in starts.windows(2).zip(x) {
            for (&row, m) in rows[ends[0]..ends[1]].iter().zip(&self.mass[ends[0]..ends[1]]) {
                r[row] -= m * x;
            }
        }
    }
}
