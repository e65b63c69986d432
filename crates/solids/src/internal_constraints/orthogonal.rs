//! A few columns made orthonormal, which tells how many of them are independent.

/// Least share of a column that must remain after projection off the columns before it.
const LEAST_SHARE: f64 = 1e-10;

/// Columns `a_k = Σ q_j r_jk` in the order in which they were taken.
pub(super) struct Orthogonal<const ROWS: usize, const COLUMNS: usize> {
    /// Orthonormal columns; those from `rank` on are zero.
    pub(super) basis: [[f64; ROWS]; COLUMNS],
    /// `triangle[j][k]`: part of column `order[k]` along basis j.
    pub(super) triangle: [[f64; COLUMNS]; COLUMNS],
    /// Which column each is, the independent first.
    pub(super) order: [usize; COLUMNS],
    pub(super) rank: usize,
    /// Independent part of the first dependent column, as a share of it.
    pub(super) share: f64,
}

pub(super) fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The largest column first, each made orthogonal to those before it, twice.
pub(super) fn orthogonalise<const ROWS: usize, const COLUMNS: usize>(
    columns: &[[f64; ROWS]; COLUMNS],
) -> Orthogonal<ROWS, COLUMNS> {
    let sizes = columns.map(|column| dot(&column, &column).sqrt());
    let mut rest = *columns;
    let mut parts = [[0.0; COLUMNS]; COLUMNS];
    let mut basis = [[0.0; ROWS]; COLUMNS];
    let mut order: [usize; COLUMNS] = core::array::from_fn(|k| k);
    let mut rank = 0;
    let mut share = 1.0;
    for step in 0..COLUMNS {
        let left = |k: usize| {
            let size = sizes[k];
            if 0.0 < size { dot(&rest[k], &rest[k]).sqrt() / size } else { 0.0 }
        };
        let mut best = step;
        for place in step + 1..COLUMNS {
            if left(order[best]) < left(order[place]) {
                best = place;
            }
        }
        order.swap(step, best);
        let column = order[step];
        share = left(column);
        if share.is_nan() || share <= LEAST_SHARE {
            break;
        }
        let length = dot(&rest[column], &rest[column]).sqrt();
        basis[step] = rest[column].map(|x| x / length);
        parts[step][column] = length;
        rank += 1;
        for &other in &order[step + 1..] {
            for _ in 0..2 {
                let along = dot(&basis[step], &rest[other]);
                parts[step][other] += along;
                for (entry, q) in rest[other].iter_mut().zip(&basis[step]) {
                    *entry -= along * q;
                }
            }
        }
    }
    let mut triangle = [[0.0; COLUMNS]; COLUMNS];
    for (row, parts) in triangle.iter_mut().zip(&parts) {
        for (entry, &column) in row.iter_mut().zip(&order) {
            *entry = parts[column];
        }
    }
    Orthogonal { basis, triangle, order, rank, share }
}

impl<const ROWS: usize, const COLUMNS: usize> Orthogonal<ROWS, COLUMNS> {
    /// R x = y for the leading independent columns, y a column of R or coordinates in the basis.
    pub(super) fn back_substituted(&self, mut y: [f64; COLUMNS]) -> [f64; COLUMNS] {
        for k in (0..self.rank).rev() {
            y[k] /= self.triangle[k][k];
            for j in 0..k {
                y[j] -= self.triangle[j][k] * y[k];
            }
        }
        y
    }
}

/// The part of a vector outside the span of the columns.
#[must_use]
pub fn outside_of_columns<const ROWS: usize, const COLUMNS: usize>(
    columns: &[[f64; ROWS]; COLUMNS],
    mut vector: [f64; ROWS],
) -> [f64; ROWS] {
    let orthogonal = orthogonalise(columns);
    for q in &orthogonal.basis[..orthogonal.rank] {
        let along = dot(q, &vector);
        for (entry, q) in vector.iter_mut().zip(q) {
            *entry -= along * q;
        }
    }
    vector
}

/// Rank of the columns, and the first dependent one.
#[must_use]
pub fn rank_of_columns<const ROWS: usize, const COLUMNS: usize>(
    columns: &[[f64; ROWS]; COLUMNS],
) -> (usize, Option<usize>) {
    let orthogonal = orthogonalise(columns);
    (orthogonal.rank, orthogonal.order.get(orthogonal.rank).copied())
}
