//! Vector fields on a grid: sampled, composed, measured.

use piola_numerics::Real;

use crate::grid::ImageGrid;
use crate::parallel::{each, fold};

/// The largest length of a vector.
pub(crate) fn largest<const D: usize, T: Real>(vectors: &[[T; D]]) -> f64 {
    let square = fold(
        0..vectors.len(),
        &|_, range| {
            vectors[range].iter().fold(0.0_f64, |largest, vector| {
                largest.max(vector.iter().map(|component| component.primal(0).powi(2)).sum())
            })
        },
        &f64::max,
    );
    square.sqrt()
}

/// x − `factor` u for the sample at `position`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn target<const D: usize, T: Real>(
    grid: &ImageGrid<D>,
    position: usize,
    displacement: &[T; D],
    factor: T,
) -> [T; D] {
    let index = grid.index(position);
    let spacing = grid.spacing();
    std::array::from_fn(|axis| T::lit((index[axis] as f64 + 0.5) * spacing[axis]) - factor * displacement[axis])
}

/// `out`: displacements of x ↦ h(g(x)), h and g with the displacements `outer` and `inner`: `w = u_g + u_h(x − u_g)`.
pub(crate) fn compose<const D: usize, T: Real>(
    grid: &ImageGrid<D>,
    outer: &[[T; D]],
    inner: &[[T; D]],
    out: &mut [[T; D]],
) {
    each(out, &|start, part: &mut [[T; D]]| {
        for (position, w) in (start..).zip(part) {
            let first = inner[position];
            let second = sample(grid, outer, target(grid, position, &first, T::one()));
            *w = std::array::from_fn(|axis| first[axis] + second[axis]);
        }
    });
}

/// A vector field at a place: multilinear, continued by reflection beyond the outermost samples.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sample<const D: usize, T: Real>(grid: &ImageGrid<D>, field: &[[T; D]], place: [T; D]) -> [T; D] {
    let (sizes, spacing, strides) = (grid.sizes(), grid.spacing(), grid.strides());
    let mut weights = [[T::zero(); 2]; D];
    let mut offsets = [[0; 2]; D];
    // The sign of the normal component.
    let mut signs = [[T::one(); 2]; D];
    for axis in 0..D {
        let size = sizes[axis];
        let last = size as f64;
        // Counted from the ghost sample before the first one.
        let index = place[axis] * T::lit(1.0 / spacing[axis]) + T::lit(0.5);
        let at = index.primal(0);
        let (cell, share) = if at < 0.5 {
            (0, T::lit(0.5))
        } else if last + 0.5 <= at {
            (size, T::lit(0.5))
        } else {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between zero and the size")]
            let cell = (at as usize).min(size);
            (cell, index - T::lit(cell as f64))
        };
        weights[axis] = [T::one() - share, share];
        offsets[axis] = [cell.saturating_sub(1) * strides[axis], cell.min(size - 1) * strides[axis]];
        if cell == 0 {
            signs[axis][0] = -T::one();
        }
        if cell == size {
            signs[axis][1] = -T::one();
        }
    }
    let mut value = [T::zero(); D];
    for corner in 0..1 << D {
        let mut offset = 0;
        let mut weight = T::one();
        for axis in 0..D {
            let bit = corner >> axis & 1;
            offset += offsets[axis][bit];
            weight *= weights[axis][bit];
        }
        let vector = &field[offset];
        for axis in 0..D {
            value[axis] += weight * signs[axis][corner >> axis & 1] * vector[axis];
        }
    }
    value
}
