//! Determinants of ∇h = 1 − ∇u, at samples and on the simplices between them.

use piola_numerics::Real;

use crate::grid::{ImageGrid, advance};
use crate::parallel::{each, fold};

/// Index and sign of the normal component of a neighbour, counted from the ghost sample before the first one.
#[cfg_attr(not(debug_assertions), inline(always))]
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
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn determinant<const D: usize, T: Real>(m: &[[T; D]; D]) -> T {
    if D == 2 {
        m[0][0] * m[1][1] - m[0][1] * m[1][0]
    } else {
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    }
}

/// Rows b ↦ `∂u/∂x_b` at a sample, by central differences; reflected beyond the walls.
#[cfg_attr(not(debug_assertions), inline(always))]
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

#[cfg_attr(not(debug_assertions), inline(always))]
fn unit_minus<const D: usize, T: Real>(mut matrix: [[T; D]; D]) -> [[T; D]; D] {
    for (row, entries) in matrix.iter_mut().enumerate() {
        for (column, entry) in entries.iter_mut().enumerate() {
            let unit = if row == column { T::one() } else { T::zero() };
            *entry = unit - *entry;
        }
    }
    matrix
}

/// det(1 − ∇u) at the samples.
pub(crate) fn nodal_jacobian<const D: usize, T: Real>(grid: &ImageGrid<D>, field: &[[T; D]]) -> Vec<T> {
    let mut values = vec![T::zero(); grid.len()];
    each(&mut values[..], &|start, part: &mut [T]| {
        let mut index = grid.index(start);
        for (position, value) in (start..).zip(part) {
            *value = determinant(&unit_minus(slopes_at(grid, field, position, &index)));
            advance(&mut index, &grid.sizes());
        }
    });
    values
}

/// `factor` u at the corners of the cell whose first corner is counted from the ghost sample before the first one; bit a of a corner is its step
/// along axis a. Only the first 2^D entries are used.
#[cfg_attr(not(debug_assertions), inline(always))]
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

/// The 24 tetrahedra of a cube along its diagonals: the lower corners of their edges of direction 0, 1 and 2.
///
/// A tetrahedron is a path along three edges from a corner to the opposite one. A path and its reverse are the same, so the corners with
/// bit 2 clear suffice as starts.
const TETRAHEDRA: [[usize; 3]; 24] = tetrahedra();

const fn tetrahedra() -> [[usize; 3]; 24] {
    const PATHS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let mut found = [[0; 3]; 24];
    let mut number = 0;
    while number < 24 {
        let path = PATHS[number % 6];
        let mut from = number / 6;
        let mut step = 0;
        while step < 3 {
            found[number][path[step]] = from & !(1 << path[step]);
            from ^= 1 << path[step];
            step += 1;
        }
        number += 1;
    }
    found
}

/// The least determinant over the simplices of one cell, along all its diagonals; infinite where all exceed `known`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn least_of_cell<const D: usize, T: Real>(u: &[[T; D]; 8], factors: &[T; D], known: f64) -> T {
    // ∂h/∂x_a along each edge of direction a, by its lower corner.
    let mut edges = [[[T::zero(); D]; 8]; D];
    let mut steepest = T::zero();
    for axis in 0..D {
        for low in 0..1 << D {
            if low >> axis & 1 == 0 {
                for component in 0..D {
                    let unit = if component == axis { T::one() } else { T::zero() };
                    let slope = (u[low | 1 << axis][component] - u[low][component]) * factors[axis];
                    edges[axis][low][component] = unit - slope;
                    steepest = T::select(steepest.less_than(slope.abs()), slope.abs(), steepest);
                }
            }
        }
    }
    let mut least = T::lit(f64::INFINITY);
    if D == 2 {
        for corner in 0..4 {
            let rows: [[T; D]; D] = std::array::from_fn(|axis| edges[axis][corner & !(1 << axis)]);
            let value = determinant(&rows);
            least = T::select(value.less_than(least), value, least);
        }
        return least;
    }
    // Where no |∂u| exceeds s, 1 − 3s − 6s² − 6s³ ≤ det(1 − ∇u). Most cells cannot hold the least.
    let s = steepest.primal(0);
    if known < 1.0 - s * (3.0 + s * (6.0 + 6.0 * s)) {
        return least;
    }
    for [i, j, k] in TETRAHEDRA {
        let (p, q, r) = (&edges[0][i], &edges[1][j], &edges[D - 1][k]);
        // p · (q × r), component by component: copies of whole rows would wait for each other.
        let value = p[0] * (q[1] * r[D - 1] - q[D - 1] * r[1]) - p[1] * (q[0] * r[D - 1] - q[D - 1] * r[0])
            + p[D - 1] * (q[0] * r[1] - q[1] * r[0]);
        least = T::select(value.less_than(least), value, least);
    }
    least
}

/// The corners of the cells of one row, from cell to cell: the far corners of a cell are the near ones of the next.
struct Row<const D: usize, T> {
    /// By the bits of the axes before the last one.
    offsets: [usize; 4],
    signs: [[T; D]; 4],
}

impl<const D: usize, T: Real> Row<D, T> {
    /// The row of the cell with the indices `cell`, counted from the ghost sample before the first one.
    fn new(grid: &ImageGrid<D>, factor: T, cell: &[usize; D]) -> Self {
        let (sizes, strides) = (grid.sizes(), grid.strides());
        let mut row = Self { offsets: [0; 4], signs: [[factor; D]; 4] };
        for corner in 0..1 << (D - 1) {
            for axis in 0..D - 1 {
                let (index, is_turned) = reflected(cell[axis] + (corner >> axis & 1), sizes[axis]);
                row.offsets[corner] += index * strides[axis];
                if is_turned {
                    row.signs[corner][axis] = -factor;
                }
            }
        }
        row
    }

    /// Loads the corners at `index` along the last axis, on the near or the far side.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn load(&self, field: &[[T; D]], size: usize, index: usize, side: usize, u: &mut [[T; D]; 8]) {
        let (index, is_turned) = reflected(index, size);
        for corner in 0..1 << (D - 1) {
            let vector = &field[self.offsets[corner] + index];
            let own = &mut u[corner | side << (D - 1)];
            for axis in 0..D {
                own[axis] = self.signs[corner][axis] * vector[axis];
            }
            if is_turned {
                own[D - 1] = -own[D - 1];
            }
        }
    }
}

/// The least determinant of 1 − `factor` ∇u over the simplices of all cells, those between a wall and the outermost samples included.
pub(crate) fn least_jacobian<const D: usize, T: Real>(grid: &ImageGrid<D>, field: &[[T; D]], factor: f64) -> f64 {
    let cells = grid.sizes().map(|size| size + 1);
    let count: usize = cells.iter().product();
    let known = least_forward(grid, field, factor);
    fold(
        0..count,
        &|start, range: std::ops::Range<usize>| {
            let mut cell = [0; D];
            let mut rest = start;
            for axis in (0..D).rev() {
                cell[axis] = rest % cells[axis];
                rest /= cells[axis];
            }
            let factors = grid.spacing().map(|h| T::lit(1.0 / h));
            let size = grid.sizes()[D - 1];
            // No other cell needs an evaluation that cannot be less.
            let mut least = known;
            let mut u = [[T::zero(); D]; 8];
            let mut left = range.len();
            while 0 < left {
                let row = Row::new(grid, T::lit(factor), &cell);
                let first = cell[D - 1];
                let last = (first + left).min(size + 1);
                row.load(field, size, first, 0, &mut u);
                for index in first..last {
                    row.load(field, size, index + 1, 1, &mut u);
                    least = least.min(least_of_cell(&u, &factors, least).primal(0));
                    u.copy_within(1 << (D - 1)..1 << D, 0);
                }
                left -= last - first;
                cell[D - 1] = size;
                advance(&mut cell, &cells);
            }
            least
        },
        &f64::min,
    )
}

/// The least determinant of 1 − `factor` ∇u by differences to the next sample along each axis: one simplex of each cell inside.
fn least_forward<const D: usize, T: Real>(grid: &ImageGrid<D>, field: &[[T; D]], factor: f64) -> f64 {
    let (sizes, strides) = (grid.sizes(), grid.strides());
    let factors = grid.spacing().map(|h| T::lit(factor / h));
    fold(
        0..grid.len(),
        &|start, range: std::ops::Range<usize>| {
            let mut index = grid.index(start);
            let mut least = f64::INFINITY;
            for position in range {
                if index.iter().zip(sizes).all(|(&index, size)| index + 1 < size) {
                    let here = &field[position];
                    let mut slopes = [[T::zero(); D]; D];
                    for axis in 0..D {
                        let next = &field[position + strides[axis]];
                        for component in 0..D {
                            slopes[axis][component] = (next[component] - here[component]) * factors[axis];
                        }
                    }
                    let value = determinant(&unit_minus(slopes)).primal(0);
                    least = least.min(value);
                }
                advance(&mut index, &sizes);
            }
            least
        },
        &f64::min,
    )
}
