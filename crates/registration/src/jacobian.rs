//! Determinants of ∇h = 1 − ∇u, at samples and on the simplices between them.

use piola_numerics::Real;

use crate::grid::{ImageGrid, advance};
use crate::parallel::{each, fold};

/// Index and sign of the normal component of a neighbour, counted from the ghost sample before the first one.
#[inline(always)]
pub(crate) fn reflected(index: usize, size: usize) -> (usize, bool) {
    if index == 0 {
        (0, true)
    } else if size < index {
        (size - 1, true)
    } else {
        (index - 1, false)
    }
}

/// The determinant of a 2×2 or 3×3 matrix of rows.
#[inline(always)]
pub(crate) fn determinant<const D: usize, T: Real>(m: &[[T; D]; D]) -> T {
    if D == 2 {
        m[0][0] * m[1][1] - m[0][1] * m[1][0]
    } else {
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    }
}

/// Rows b ↦ ∂u/∂x_b at a sample, by central differences; reflected beyond the walls.
#[inline(always)]
pub(crate) fn slopes_at<const D: usize, T: Real>(
    grid: &ImageGrid<D>,
    field: &[[T; D]],
    position: usize,
    index: &[usize; D],
) -> [[T; D]; D] {
    let (sizes, spacing, strides) = (grid.sizes(), grid.spacing(), grid.strides());
    let mut slopes = [[T::zero(); D]; D];
    for axis in 0..D {
        let (is_first, is_last) = (index[axis] == 0, index[axis] + 1 == sizes[axis]);
        let before = field[if is_first { position } else { position - strides[axis] }];
        let after = field[if is_last { position } else { position + strides[axis] }];
        let factor = T::lit(0.5 / spacing[axis]);
        for component in 0..D {
            let is_normal = component == axis;
            let before = if is_first && is_normal { -before[component] } else { before[component] };
            let after = if is_last && is_normal { -after[component] } else { after[component] };
            slopes[axis][component] = (after - before) * factor;
        }
    }
    slopes
}

/// det(1 − ∇u) at the samples.
pub(crate) fn nodal_jacobian<const D: usize, T: Real>(grid: &ImageGrid<D>, field: &[[T; D]]) -> Vec<T> {
    let mut values = vec![T::zero(); grid.len()];
    each(&mut values[..], &|start, part: &mut [T]| {
        let mut index = grid.index(start);
        for (position, value) in (start..).zip(part) {
            let mut matrix = slopes_at(grid, field, position, &index);
            for row in 0..D {
                for column in 0..D {
                    let unit = if row == column { T::one() } else { T::zero() };
                    matrix[row][column] = unit - matrix[row][column];
                }
            }
            *value = determinant(&matrix);
            advance(&mut index, &grid.sizes());
        }
    });
    values
}

/// `factor` u at the corners of the cell whose first corner is counted from the ghost sample before the first one; bit a of a corner is its step
/// along axis a. Only the first 2^D entries are used.
#[inline(always)]
pub(crate) fn corners<const D: usize, T: Real>(
    grid: &ImageGrid<D>,
    field: &[[T; D]],
    factor: T,
    cell: &[usize; D],
) -> [[T; D]; 8] {
    let (sizes, strides) = (grid.sizes(), grid.strides());
    let mut found = [[T::zero(); D]; 8];
    for (corner, vector) in found.iter_mut().enumerate().take(1 << D) {
        let mut offset = 0;
        let mut signs = [factor; D];
        for axis in 0..D {
            let (index, is_turned) = reflected(cell[axis] + (corner >> axis & 1), sizes[axis]);
            offset += index * strides[axis];
            if is_turned {
                signs[axis] = -factor;
            }
        }
        *vector = std::array::from_fn(|axis| signs[axis] * field[offset][axis]);
    }
    found
}

/// The least determinant over the simplices of one cell, along all its diagonals.
#[inline(always)]
fn least_of_cell<const D: usize, T: Real>(u: &[[T; D]; 8], spacing: &[f64; D]) -> T {
    // ∂h/∂x_a along the edge of direction a that begins at `from`.
    let edge = |from: usize, axis: usize| -> [T; D] {
        let (low, high) = (from & !(1 << axis), from | 1 << axis);
        let factor = T::lit(1.0 / spacing[axis]);
        std::array::from_fn(|component| {
            let unit = if component == axis { T::one() } else { T::zero() };
            unit - (u[high][component] - u[low][component]) * factor
        })
    };
    let mut least = T::lit(f64::INFINITY);
    let mut take = |value: T| least = T::select(value.less_than(least), value, least);
    if D == 2 {
        for corner in 0..4 {
            let mut rows = [[T::zero(); D]; D];
            for axis in 0..D {
                rows[axis] = edge(corner, axis);
            }
            take(determinant(&rows));
        }
        return least;
    }
    // A simplex is a path along three edges from a corner to the opposite one; a path and its reverse are the same, so half of the corners
    // suffice: those with bit 2 clear.
    const PATHS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    for corner in 0..4 {
        for path in PATHS {
            let mut rows = [[T::zero(); D]; D];
            let mut from = corner;
            for axis in path {
                rows[axis] = edge(from, axis);
                from ^= 1 << axis;
            }
            take(determinant(&rows));
        }
    }
    least
}

/// The least determinant of 1 − `factor` ∇u over the simplices of all cells, those between a wall and the outermost samples included.
pub(crate) fn least_jacobian<const D: usize, T: Real>(grid: &ImageGrid<D>, field: &[[T; D]], factor: f64) -> f64 {
    let cells = grid.sizes().map(|size| size + 1);
    let count: usize = cells.iter().product();
    fold(
        0..count,
        &|start, range: std::ops::Range<usize>| {
            let mut cell = [0; D];
            let mut rest = start;
            for axis in (0..D).rev() {
                cell[axis] = rest % cells[axis];
                rest /= cells[axis];
            }
            let spacing = grid.spacing();
            let mut least = f64::INFINITY;
            for _ in range {
                let value = least_of_cell(&corners(grid, field, T::lit(factor), &cell), &spacing).primal(0);
                // NaN is never positive: it must not be lost.
                if !(least <= value) {
                    least = value;
                }
                advance(&mut cell, &cells);
            }
            least
        },
        &|a: f64, b: f64| if a <= b { a } else { b },
    )
}
