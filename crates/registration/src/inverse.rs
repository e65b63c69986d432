//! The inverse of a map: samples located in the images of simplices, then Newton's method.

use piola_numerics::Real;

use crate::field::sample;
use crate::grid::{ImageGrid, advance};
use crate::jacobian::{corners, determinant};
use crate::parallel::each;

/// Steps of Newton's method; each squares the error, which begins at the second order in the spacing.
const STEPS: usize = 20;

/// The displacements w of g(y) = y − w(y) with h(g(y)) = y, for a map h(x) = x − u(x) without folds.
pub(crate) fn invert<const D: usize, T: Real>(grid: &ImageGrid<D>, field: &[[T; D]]) -> Vec<[T; D]> {
    let mut found = locate(grid, field);
    each(&mut found[..], &|start, part: &mut [[T; D]]| {
        for (position, w) in (start..).zip(part) {
            let y: [f64; D] = grid.place(position);
            *w = refine(grid, field, y.map(T::lit), *w);
        }
    });
    found
}

/// −(h(x) − y) for x = y − w.
#[cfg_attr(not(debug_assertions), inline(always))]
fn defect<const D: usize, T: Real>(grid: &ImageGrid<D>, field: &[[T; D]], y: &[T; D], w: &[T; D]) -> [T; D] {
    let x = std::array::from_fn(|axis| y[axis] - w[axis]);
    let u = sample(grid, field, x);
    std::array::from_fn(|axis| w[axis] + u[axis])
}

fn size<const D: usize, T: Real>(vector: &[T; D]) -> f64 {
    vector.iter().map(|component| component.primal(0).powi(2)).sum::<f64>()
}

/// Newton's method for w + u(y − w) = 0, with steps halved until the defect falls.
fn refine<const D: usize, T: Real>(grid: &ImageGrid<D>, field: &[[T; D]], y: [T; D], start: [T; D]) -> [T; D] {
    let spacing = grid.spacing();
    let mut w = start;
    let mut left = defect(grid, field, &y, &w);
    for _ in 0..STEPS {
        if size(&left) <= 0.0 {
            break;
        }
        // ∂(defect)/∂w = 1 − ∇u by differences within a small part of a cell: u is linear along each axis there.
        let mut columns = [[T::zero(); D]; D];
        for axis in 0..D {
            let step = T::lit(1e-3 * spacing[axis]);
            let mut beside = w;
            beside[axis] += step;
            let moved = defect(grid, field, &y, &beside);
            for row in 0..D {
                columns[axis][row] = (moved[row] - left[row]) / step;
            }
        }
        let Some(step) = solve(&columns, &left) else { break };
        let mut factor = 1.0;
        let mut is_better = false;
        for _ in 0..8 {
            let trial = std::array::from_fn(|axis| w[axis] - T::lit(factor) * step[axis]);
            let defect = defect(grid, field, &y, &trial);
            if size(&defect) < size(&left) {
                (w, left, is_better) = (trial, defect, true);
                break;
            }
            factor *= 0.5;
        }
        if !is_better {
            break;
        }
    }
    w
}

/// Cramer's rule for the matrix with these columns.
fn solve<const D: usize, T: Real>(columns: &[[T; D]; D], right: &[T; D]) -> Option<[T; D]> {
    let whole = determinant(columns);
    if whole.primal(0).abs() <= 0.0 {
        return None;
    }
    Some(std::array::from_fn(|axis| {
        let mut replaced = *columns;
        replaced[axis] = *right;
        determinant(&replaced) / whole
    }))
}

/// Displacements of the inverse of the piecewise linear interpolant: each sample is found in the image of a simplex.
///
/// One diagonal divides each cell into D! simplices. Samples that lie in none, because their cell is reflected, keep the displacement −u(y).
fn locate<const D: usize, T: Real>(grid: &ImageGrid<D>, field: &[[T; D]]) -> Vec<[T; D]> {
    const PATHS_2: &[&[usize]] = &[&[0, 1], &[1, 0]];
    const PATHS_3: &[&[usize]] = &[&[0, 1, 2], &[0, 2, 1], &[1, 0, 2], &[1, 2, 0], &[2, 0, 1], &[2, 1, 0]];
    let paths = if D == 2 { PATHS_2 } else { PATHS_3 };
    let (sizes, spacing, strides) = (grid.sizes(), grid.spacing(), grid.strides());
    let mut found: Vec<[T; D]> = field.iter().map(|u| u.map(|component| -component)).collect();
    let cells = sizes.map(|size| size + 1);
    let mut cell = [0; D];
    for _ in 0..cells.iter().product::<usize>() {
        let u = corners(grid, field, T::one(), &cell);
        // The corners of the cell under h, counted in samples.
        let image: [[f64; D]; 8] = std::array::from_fn(|corner| {
            std::array::from_fn(|axis| {
                let index = cell[axis] as f64 - 1.0 + f64::from(u8::from(corner >> axis & 1 == 1));
                index - u[corner & ((1 << D) - 1)][axis].primal(0) / spacing[axis]
            })
        });
        for path in paths {
            let mut nodes = [0_usize; 4];
            for (step, axis) in path.iter().enumerate() {
                nodes[step + 1] = nodes[step] | 1 << axis;
            }
            let nodes = &nodes[..=D];
            let (mut low, mut high) = ([0_usize; D], [0_usize; D]);
            let mut is_empty = false;
            for axis in 0..D {
                let at = || nodes.iter().map(|&node| image[node][axis]);
                let first = at().fold(f64::INFINITY, f64::min).ceil().max(0.0);
                let last = at().fold(f64::NEG_INFINITY, f64::max).floor().min((sizes[axis] - 1) as f64);
                is_empty |= last < first;
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "between zero and the size"
                )]
                if !is_empty {
                    (low[axis], high[axis]) = (first as usize, last as usize);
                }
            }
            if is_empty {
                continue;
            }
            let columns: [[f64; D]; D] = std::array::from_fn(|edge| {
                std::array::from_fn(|axis| image[nodes[edge + 1]][axis] - image[nodes[0]][axis])
            });
            let mut index = low;
            loop {
                let from: [f64; D] = std::array::from_fn(|axis| index[axis] as f64 - image[nodes[0]][axis]);
                if let Some(shares) = solve(&columns, &from).filter(is_inside) {
                    let position: usize = (0..D).map(|axis| index[axis] * strides[axis]).sum();
                    found[position] = std::array::from_fn(|axis| {
                        // The share of the edges with direction `axis`: x − (first corner), counted in samples.
                        let along: f64 =
                            (0..D).filter(|&edge| nodes[edge + 1] >> axis & 1 == 1).map(|edge| shares[edge]).sum();
                        let x = cell[axis] as f64 - 1.0 + along;
                        T::lit((index[axis] as f64 - x) * spacing[axis])
                    });
                }
                if !next(&mut index, &low, &high) {
                    break;
                }
            }
        }
        advance(&mut cell, &cells);
    }
    found
}

/// Barycentric coordinates of a point in a simplex, to rounding.
fn is_inside<const D: usize>(shares: &[f64; D]) -> bool {
    const ROUNDING: f64 = 1e-9;
    shares.iter().all(|&share| -ROUNDING <= share) && shares.iter().sum::<f64>() <= 1.0 + ROUNDING
}

/// Moves to the next index between `low` and `high`, both included.
fn next<const D: usize>(index: &mut [usize; D], low: &[usize; D], high: &[usize; D]) -> bool {
    for axis in (0..D).rev() {
        if index[axis] < high[axis] {
            index[axis] += 1;
            return true;
        }
        index[axis] = low[axis];
    }
    false
}
