//! The entries of a square matrix that may differ from zero, and columns that share no row.

use piola_integrators::{Field, IntegratorsError};
use piola_numerics::Gradient;

use super::{DIRECTIONS, Differentiable};

/// The entries of a square matrix that may differ from zero: its sparsity pattern.
///
/// Entries are ordered by columns, and by rows within a column.
///
/// # Example
/// ```
/// use piola_stiff::Sparsity;
/// // A chain of four: each row depends on itself and its neighbours.
/// let near = (0..4_usize).flat_map(|i| (i.saturating_sub(1)..(i + 2).min(4)).map(move |j| (i, j)));
/// let chain = Sparsity::from_entries(4, near)?;
/// assert_eq!(chain.count(), 10);
/// assert_eq!(chain.rows_of(1), [0, 1, 2]);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("sparsity pattern", "CSC", "graph"))]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sparsity {
    /// Where the rows of each column start in `rows`, and where the last ones end.
    starts: Vec<usize>,
    rows: Vec<usize>,
}

impl Sparsity {
    /// The pattern of these entries (row, column), in any order; repeated entries count once.
    ///
    /// # Errors
    /// [`IntegratorsError::OutsideMatrix`].
    pub fn from_entries(
        dimension: usize,
        entries: impl IntoIterator<Item = (usize, usize)>,
    ) -> Result<Self, IntegratorsError> {
        let mut sorted = Vec::new();
        for (row, column) in entries {
            if dimension <= row.max(column) {
                return Err(IntegratorsError::OutsideMatrix { quantity: "sparsity", row, column, dimension });
            }
            sorted.push((column, row));
        }
        sorted.sort_unstable();
        sorted.dedup();
        let mut starts = vec![0; dimension + 1];
        for &(column, _) in &sorted {
            starts[column + 1] += 1;
        }
        for column in 0..dimension {
            starts[column + 1] += starts[column];
        }
        Ok(Self { starts, rows: sorted.into_iter().map(|(_, row)| row).collect() })
    }

    /// The pattern of a field's Jacobian at (t, y): the rates that depend on each component, also where the derivative
    /// happens to be zero there. Costs n/4 evaluations over [`Differentiable`] numbers.
    ///
    /// Each component in turn gets NaN as its derivative. Whatever is computed from it has then a derivative that is NaN, and the
    /// values are as always. Where the
    /// field branches on its values, the pattern is that of the branch taken at (t, y).
    ///
    /// # Errors
    /// [`IntegratorsError::WrongLength`]; [`IntegratorsError::Field`] where the field is not defined at (t, y).
    ///
    /// # Example
    /// ```
    /// use core::convert::Infallible;
    /// use piola_integrators::Field;
    /// use piola_stiff::Sparsity;
    /// use piola_numerics::Real;
    /// struct Product; // ẋ = x y, ẏ = y
    /// impl<T: Real> Field<T> for Product {
    ///     type Error = Infallible;
    ///     fn dimension(&self) -> usize {
    ///         2
    ///     }
    ///     fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
    ///         rate.copy_from_slice(&[y[0] * y[1], y[1]]);
    ///         Ok(())
    ///     }
    /// }
    /// // All derivatives of x y are zero at the origin.
    /// let found = Sparsity::of_field(&mut Product, 0.0, &[0.0, 0.0])?;
    /// assert_eq!(found, Sparsity::from_entries(2, [(0, 0), (0, 1), (1, 1)])?);
    /// # Ok::<(), piola_integrators::IntegratorsError>(())
    /// ```
    pub fn of_field<F: Field<Differentiable>>(
        field: &mut F,
        t: f64,
        y: &[f64],
    ) -> Result<Self, IntegratorsError<F::Error>> {
        let n = field.dimension();
        if y.len() != n {
            return Err(IntegratorsError::WrongLength { quantity: "state", expected: n, found: y.len() });
        }
        let mut point: Vec<Differentiable> = y.iter().map(|&y| Gradient::constant(y)).collect();
        let mut rate = point.clone();
        let mut entries = Vec::new();
        for first in (0..n).step_by(DIRECTIONS) {
            let columns = first..(first + DIRECTIONS).min(n);
            for column in columns.clone() {
                point[column].partials[column - first] = f64::NAN;
            }
            field.rate(t, &point, &mut rate).map_err(|source| IntegratorsError::Field { t, source })?;
            for column in columns {
                point[column] = Gradient::constant(y[column]);
                let depends = |rate: &Differentiable| rate.partials[column - first].is_nan();
                entries.extend(rate.iter().enumerate().filter(|(_, rate)| depends(rate)).map(|(row, _)| (row, column)));
            }
        }
        Self::from_entries(n, entries).map_err(IntegratorsError::with_field_error)
    }

    /// The number of rows, and of columns.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// The number of entries.
    #[must_use]
    pub fn count(&self) -> usize {
        self.rows.len()
    }

    /// The rows of the entries of a column, in increasing order; none where there is no such column.
    #[must_use]
    pub fn rows_of(&self, column: usize) -> &[usize] {
        match self.starts.get(column..) {
            Some(&[start, end, ..]) => &self.rows[start..end],
            _ => &[],
        }
    }

    /// The entries (row, column) in their order.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        (0..self.dimension()).flat_map(|column| self.rows_of(column).iter().map(move |&row| (row, column)))
    }

    /// The place of an entry in the order of entries.
    pub(crate) fn place(&self, row: usize, column: usize) -> Option<usize> {
        let start = *self.starts.get(column)?;
        self.rows_of(column).binary_search(&row).ok().map(|k| start + k)
    }

    /// Whether every entry of the other pattern is one of this, too.
    #[must_use]
    pub fn covers(&self, other: &Self) -> bool {
        other.entries().all(|(row, column)| self.place(row, column).is_some())
    }

    /// The starts of the columns and the rows, as sparse solvers take them.
    pub(crate) fn columns(&self) -> (&[usize], &[usize]) {
        (&self.starts, &self.rows)
    }

    /// A colour for each column so that no row has two entries of one colour, and the number of colours.
    ///
    /// Greedy, once in the order of the columns and once from the fullest column on; the better one.
    pub(crate) fn colouring(&self) -> (Vec<usize>, usize) {
        let natural: Vec<usize> = (0..self.dimension()).collect();
        let mut fullest = natural.clone();
        fullest.sort_by_key(|&column| core::cmp::Reverse(self.rows_of(column).len()));
        let (one, other) = (self.colour_in_order(&natural), self.colour_in_order(&fullest));
        if other.1 < one.1 { other } else { one }
    }

    fn colour_in_order(&self, order: &[usize]) -> (Vec<usize>, usize) {
        let n = self.dimension();
        let mut columns_of_row = vec![Vec::new(); n];
        for (row, column) in self.entries() {
            columns_of_row[row].push(column);
        }
        let (mut colours, mut count) = (vec![usize::MAX; n], 0);
        // The column for which a colour was last found taken.
        let mut taken_for = vec![usize::MAX; n + 1];
        for &column in order {
            for &neighbour in self.rows_of(column).iter().flat_map(|&row| &columns_of_row[row]) {
                if let Some(taken) = taken_for.get_mut(colours[neighbour]) {
                    *taken = column;
                }
            }
            let colour = taken_for.iter().position(|&taken| taken != column).unwrap_or(n);
            colours[column] = colour;
            count = count.max(colour + 1);
        }
        (colours, count)
    }
}
