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
        // Counted from two points before the first, so that it is no negative number.
        let first = x.floor().clamp(-1.0, points[axis] as f64);
        let shifted = whole(first + 2.0);
        let t = x - first;
        let weights = [
            -t * (t - 1.0) * (t - 2.0) / 6.0,
            (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
            -(t + 1.0) * t * (t - 2.0) / 2.0,
            (t + 1.0) * t * (t - 1.0) / 6.0,
        ];
        let parity = walls.parity(component, axis);
        std::array::from_fn(|k| {
            let (index, is_mirrored) = mirrored(shifted + k, points[axis], grid.location());
            let sign = if is_mirrored && parity == Parity::Sine { -1.0 } else { 1.0 };
            (index, sign * weights[k])
        })
    });
    let mut sum = 0.0;
    for corner in 0..(if D == 3 { 64 } else { 16 }) {
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

/// A small whole number that is not negative.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between 1 and the points of an axis plus 2"
)]
fn whole(value: f64) -> usize {
    value as usize
}

/// The point that a point beyond the walls mirrors, and whether it does. `shifted` is the index plus 3.
fn mirrored(shifted: usize, points: usize, location: PointLocation) -> (usize, bool) {
    // Cells mirror −1 to 0, nodes to 1; at the other end n to n − 1 or n − 2.
    let (low, high) = match location {
        PointLocation::Cells => (2, 2 * points + 2),
        PointLocation::Nodes => (3, 2 * points + 1),
    };
    let (index, is_mirrored) = match shifted {
        shifted if shifted < 3 => (low - shifted.min(low), true),
        shifted if points + 3 <= shifted => (high.saturating_sub(shifted), true),
        shifted => (shifted - 3, false),
    };
    (index.min(points - 1), is_mirrored)
}
