//! A sampled component between its points: cubic, continued beyond the walls as its sines and cosines are.

use crate::Precision;
use crate::grid::{BoxGrid, PointLocation};
use crate::walls::{Parity, Walls};

/// The value of a component at a place, by four points along each axis: exact for cubic polynomials away from the walls.
pub(crate) fn interpolate<T: Precision, const D: usize>(
    grid: &BoxGrid<D>,
    walls: Walls,
    component: usize,
    samples: &[T],
    place: [f64; D],
) -> f64 {
    let points = grid.points();
    let stencils: [[(usize, f64); 4]; D] = std::array::from_fn(|axis| {
        let offset = if grid.location() == PointLocation::Cells { 0.5 } else { 0.0 };
        let x = place[axis] / grid.spacings()[axis] - offset;
        // Far beyond the walls is a user's matter; the index stays in range.
        let first = x.floor().clamp(-1.0, points[axis] as f64);
        let t = x - first;
        let weights = [
            -t * (t - 1.0) * (t - 2.0) / 6.0,
            (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
            -(t + 1.0) * t * (t - 2.0) / 2.0,
            (t + 1.0) * t * (t - 1.0) / 6.0,
        ];
        let parity = walls.parity(component, axis);
        std::array::from_fn(|k| {
            let (index, is_mirrored) = mirrored(first as i64 + k as i64 - 1, points[axis] as i64, grid.location());
            let sign = if is_mirrored && parity == Parity::Sine { -1.0 } else { 1.0 };
            (index, sign * weights[k])
        })
    });
    let mut sum = 0.0;
    for corner in 0..4_usize.pow(D as u32) {
        let (mut position, mut weight, mut rest) = (0, 1.0, corner);
        for axis in 0..D {
            let (index, factor) = stencils[axis][rest % 4];
            rest /= 4;
            position = position * points[axis] + index;
            weight *= factor;
        }
        sum += weight * samples[position].primal(0);
    }
    sum
}

/// The point that a point beyond the walls mirrors, and whether it does.
fn mirrored(index: i64, points: i64, location: PointLocation) -> (usize, bool) {
    let (low, high) = match location {
        PointLocation::Cells => (-1 - index, 2 * points - 1 - index),
        PointLocation::Nodes => (-index, 2 * (points - 1) - index),
    };
    let (index, is_mirrored) = match index {
        index if index < 0 => (low, true),
        index if points <= index => (high, true),
        index => (index, false),
    };
    (usize::try_from(index.clamp(0, points - 1)).unwrap_or(0), is_mirrored)
}
