//! The middle slice of a grid, and its points that a table holds.

use piola_spectral::BoxGrid;

/// Rows of a table, at most.
pub const MOST_ROWS: usize = 100_000;

/// The third coordinate of the slice in the middle of a box, m; none of a rectangle.
#[must_use]
pub fn middle_height<const D: usize>(grid: &BoxGrid<D>) -> Option<f64> {
    (D == 3).then(|| grid.position(grid.points().map(|points| points / 2))[D - 1])
}

/// |u| at a position of the lists.
#[must_use]
pub fn size_at<const D: usize>(field: &[Vec<f64>; D], position: usize) -> f64 {
    field.iter().map(|list| list[position].powi(2)).sum::<f64>().sqrt()
}

/// Each of so many points along each axis that a table of them has at most `MOST_ROWS` rows.
#[must_use]
pub fn stride_of<const D: usize>(grid: &BoxGrid<D>) -> usize {
    let rows = |stride: usize| grid.points().iter().map(|points| points.div_ceil(stride) as f64).product::<f64>();
    let mut stride = 1;
    while (MOST_ROWS as f64) < rows(stride) {
        stride += 1;
    }
    stride
}

/// The positions of these points in the lists of samples, and their stride.
#[must_use]
pub fn points_with_stride<const D: usize>(grid: &BoxGrid<D>) -> (Vec<usize>, usize) {
    let stride = stride_of(grid);
    let is_kept = |position: &usize| grid.indices(*position).iter().all(|index| index.is_multiple_of(stride));
    ((0..grid.len()).filter(is_kept).collect(), stride)
}
