//! The middle slice of a grid.

use piola_charts::Lattice;
use piola_spectral::BoxGrid;
use piola_studies::internal::{middle_height, size_at};

/// The rectangle itself, or the slice of a box in the middle of its third axis.
pub(super) struct Slice<'g, const D: usize> {
    grid: &'g BoxGrid<D>,
    /// The third coordinate, m, of a box.
    pub(super) height: Option<f64>,
}

impl<'g, const D: usize> Slice<'g, D> {
    pub(super) fn of(grid: &'g BoxGrid<D>) -> Self {
        Self { grid, height: middle_height(grid) }
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
