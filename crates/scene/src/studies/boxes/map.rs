//! The middle slice of a grid, and its points that a table holds.

use piola_charts::Lattice;
use piola_spectral::BoxGrid;

/// Rows of a table.
pub(super) const MOST_ROWS: usize = 100_000;

/// The rectangle itself, or the slice of a box in the middle of its third axis.
pub(super) struct Slice<'g, const D: usize> {
    grid: &'g BoxGrid<D>,
    /// The third coordinate, m, of a box.
    pub(super) height: Option<f64>,
}

impl<'g, const D: usize> Slice<'g, D> {
    pub(super) fn of(grid: &'g BoxGrid<D>) -> Self {
        let height = (D == 3).then(|| grid.position(grid.points().map(|points| points / 2))[D - 1]);
        Self { grid, height }
    }

    /// The points along both axes.
    pub(super) fn points(&self) -> [usize; 2] {
        [self.grid.points()[0], self.grid.points()[1]]
    }

    /// The position in the list of samples of a point of the slice.
    pub(super) fn position(&self, i: usize, j: usize) -> usize {
        let points = self.grid.points();
        let position = i * points[1] + j;
        if D == 3 { position * points[D - 1] + points[D - 1] / 2 } else { position }
    }

    /// The place of a point of the slice in its plane, m.
    pub(super) fn place(&self, i: usize, j: usize) -> [f64; 2] {
        let mut indices = [0; D];
        (indices[0], indices[1]) = (i, j);
        let place = self.grid.position(indices);
        [place[0], place[1]]
    }

    /// The size of a field, |u|, on the slice.
    pub(super) fn sizes(&self, field: &[Vec<f64>; D]) -> Lattice {
        let points = self.points();
        let mut values = Vec::with_capacity(points[0] * points[1]);
        for j in 0..points[1] {
            for i in 0..points[0] {
                values.push(size_at(field, self.position(i, j)));
            }
        }
        let spacing = [self.grid.spacings()[0], self.grid.spacings()[1]];
        Lattice { origin: self.place(0, 0), spacing, points, values }
    }
}

/// |u| at a position of the lists.
pub(super) fn size_at<const D: usize>(field: &[Vec<f64>; D], position: usize) -> f64 {
    field.iter().map(|list| list[position].powi(2)).sum::<f64>().sqrt()
}

/// Each of so many points along each axis that a table of them has at most `MOST_ROWS` rows.
pub(super) fn stride_of<const D: usize>(grid: &BoxGrid<D>) -> usize {
    let rows = |stride: usize| grid.points().iter().map(|points| points.div_ceil(stride) as f64).product::<f64>();
    let mut stride = 1;
    while (MOST_ROWS as f64) < rows(stride) {
        stride += 1;
    }
    stride
}

/// The positions of these points in the lists of samples, and their stride.
pub(super) fn points_with_stride<const D: usize>(grid: &BoxGrid<D>) -> (Vec<usize>, usize) {
    let stride = stride_of(grid);
    let is_kept = |position: &usize| grid.indices(*position).iter().all(|index| index.is_multiple_of(stride));
    ((0..grid.len()).filter(is_kept).collect(), stride)
}
