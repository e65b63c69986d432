//! The solution in the plane on a regular grid, interpolated between characteristics.

use super::patch::Local;
use super::{CharacteristicSolution, FirstOrderPde, InitialManifold};
use crate::CharacteristicsError;
use crate::check::{check_finite, check_length};

/// A regular grid of points in the plane.
///
/// ```text
/// x = origin + (i · spacing₁, j · spacing₂),    i < points₁,  j < points₂
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Grid {
    /// The point i = j = 0.
    pub origin: [f64; 2],
    /// The distances between neighbours, positive.
    pub spacing: [f64; 2],
    /// The numbers of points.
    pub points: [usize; 2],
}

impl Grid {
    /// The point of the indices i and j.
    ///
    /// ```
    /// use piola_characteristics::Grid;
    /// let grid = Grid { origin: [1.0, 2.0], spacing: [0.5, 0.25], points: [3, 3] };
    /// assert_eq!(grid.point(2, 1), [2.0, 2.25]);
    /// ```
    #[must_use]
    pub fn point(&self, i: usize, j: usize) -> [f64; 2] {
        [self.origin[0] + i as f64 * self.spacing[0], self.origin[1] + j as f64 * self.spacing[1]]
    }
}

/// What stands at a point of the grid that several sheets of the solution cover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Overlap {
    /// The sheet with the least u.
    FirstArrival,
    /// Nothing.
    Nothing,
}

/// The solution at a point of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GridValue {
    /// u.
    pub u: f64,
    /// ξ, carried by the characteristics.
    pub xi: [f64; 2],
    /// Φ(x, u, ∇u) with the gradient of the interpolated u: the check of the whole.
    pub residual: f64,
    /// s of the characteristic through the point.
    pub s: f64,
    /// Its parameter τ.
    pub parameter: f64,
    /// det(x_s, x_τ).
    pub determinant: f64,
    /// The number of sheets that cover the point.
    pub sheets: usize,
}

/// The solution on a grid.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GridSolution {
    /// The grid.
    pub grid: Grid,
    /// At i + j · points₁ the solution at [`Grid::point`]`(i, j)`; `None` where no characteristic passes.
    pub values: Vec<Option<GridValue>>,
}

impl GridSolution {
    /// The solution at the point of the indices i and j; `None` also outside of the grid.
    #[must_use]
    pub fn get(&self, i: usize, j: usize) -> Option<&GridValue> {
        if i < self.grid.points[0] { self.values.get(i + j * self.grid.points[0])?.as_ref() } else { None }
    }
    /// The number of points that are covered.
    #[must_use]
    pub fn covered(&self) -> usize {
        self.values.iter().flatten().count()
    }
    /// The largest |Φ(x, u, ∇u)| where one sheet covers the point and |det(x_s, x_τ)| is at least the bound.
    #[must_use]
    pub fn largest_residual(&self, determinant: f64) -> f64 {
        let regular = |value: &&GridValue| value.sheets == 1 && determinant <= value.determinant.abs();
        self.values.iter().flatten().filter(regular).fold(0.0, |largest, value| largest.max(value.residual.abs()))
    }
}

impl<P: FirstOrderPde + Sync, M: InitialManifold + Sync> CharacteristicSolution<'_, P, M> {
    /// The solution of an equation in two variables at the points of a grid.
    ///
    /// Only cells of characteristics that cover points are looked at. u and ξ are interpolated from the exact values
    /// and derivatives at the corners of the cells.
    ///
    /// # Errors
    /// [`CharacteristicsError::WrongLength`] unless m = 2; [`CharacteristicsError::NotFinite`];
    /// [`CharacteristicsError::InvalidInterval`] unless 0 < spacing.
    ///
    /// # Accuracy
    /// u, in units of |ξ|, to a few times the [resolution](super::Refinement::resolution) of the solution; its gradient
    /// loses one order in the size of the cells, and `residual` tells what is left.
    pub fn onto_grid(&self, grid: Grid, overlap: Overlap) -> Result<GridSolution, CharacteristicsError> {
        check_length("x", 2, self.problem.data.variables)?;
        check_finite("origin", &grid.origin)?;
        check_finite("spacing", &grid.spacing)?;
        for spacing in grid.spacing {
            if spacing <= 0.0 {
                return Err(CharacteristicsError::InvalidInterval { quantity: "spacing", from: 0.0, to: spacing });
            }
        }
        let mut found: Vec<Vec<GridValue>> = Vec::new();
        found.resize_with(grid.points[0] * grid.points[1], Vec::new);
        for simplex in &self.simplices {
            for level in 0..self.levels.len().saturating_sub(1) {
                self.cover((simplex[0], simplex[1]), level, &grid, &mut found);
            }
        }
        let single = |mut values: Vec<GridValue>| -> Option<GridValue> {
            let sheets = values.len();
            values.sort_by(|a, b| a.u.total_cmp(&b.u));
            let first = values.first().copied()?;
            (sheets == 1 || overlap == Overlap::FirstArrival).then_some(GridValue { sheets, ..first })
        };
        Ok(GridSolution { grid, values: found.into_iter().map(single).collect() })
    }

    /// The points of the grid within one cell.
    fn cover(&self, (first, second): (usize, usize), level: usize, grid: &Grid, found: &mut [Vec<GridValue>]) {
        const MARGIN: f64 = 0.3;
        /// Neighbouring cells overlap by so little.
        const EDGE: f64 = 1e-9;
        let corners = [(first, level), (first, level + 1), (second, level), (second, level + 1)];
        let mut range = [(0, 0); 2];
        for (i, range) in range.iter_mut().enumerate() {
            let values = corners.map(|(ray, level)| self.row(&self.rays[ray].states, level)[i]);
            let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &v| (l.min(v), h.max(v)));
            let margin = MARGIN * (high - low) + self.problem_resolution();
            let index = |x: f64| (x - grid.origin[i]) / grid.spacing[i];
            let (low, high) = (index(low - margin).ceil().max(0.0), index(high + margin).floor());
            if high < low || high < 0.0 || grid.points[i] as f64 <= low {
                return;
            }
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and points")]
            let bounds = (low as usize, (high.min(grid.points[i] as f64 - 1.0)) as usize);
            *range = bounds;
        }
        let patch = self.patch((first, second), level);
        let negative = |&(ray, level): &(usize, usize)| self.rays[ray].determinants[level] < 0.0;
        let folded = corners.iter().any(negative) && !corners.iter().all(negative);
        let starts = [(0.5, 0.5), (0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
        for j in range[1].0..=range[1].1 {
            for i in range[0].0..=range[0].1 {
                for &start in if folded { &starts[..] } else { &starts[..1] } {
                    if let Some((a, b, local)) = patch.invert(grid.point(i, j), start, EDGE) {
                        let value = self.grid_value((first, second), level, (a, b), &local);
                        let cell = (
                            self.levels[level + 1] - self.levels[level],
                            (self.rays[second].parameters[0] - self.rays[first].parameters[0]).abs(),
                        );
                        keep(&mut found[i + j * grid.points[0]], value, cell);
                    }
                }
            }
        }
    }

    fn grid_value(
        &self,
        (first, second): (usize, usize),
        level: usize,
        (a, b): (f64, f64),
        local: &Local,
    ) -> GridValue {
        let (y, ya, yb) = local;
        let determinant = ya[0] * yb[1] - ya[1] * yb[0];
        // ∇u from its derivatives along the sides of the cell.
        let gradient = [(ya[2] * yb[1] - yb[2] * ya[1]) / determinant, (ya[0] * yb[2] - yb[0] * ya[2]) / determinant];
        let (s0, s1) = (self.levels[level], self.levels[level + 1]);
        let (t0, t1) = (self.rays[first].parameters[0], self.rays[second].parameters[0]);
        GridValue {
            u: y[2],
            xi: if P::QUASILINEAR { gradient } else { [y[3], y[4]] },
            residual: self.problem.data.equation.value(&y[..2], y[2], &gradient),
            s: s0 + a * (s1 - s0),
            parameter: t0 + b * (t1 - t0),
            determinant: determinant / ((s1 - s0) * (t1 - t0)),
            sheets: 1,
        }
    }
}

/// Keeps a value unless it is one found in a neighbouring cell, on their common side, or at the seam of a closed curve.
fn keep(values: &mut Vec<GridValue>, value: GridValue, (step, width): (f64, f64)) {
    /// Closer than this share of a cell two solutions are one.
    const SAME: f64 = 1e-4;
    /// What the interpolation in two cells may tell of one ξ.
    const SEAM: f64 = 1e-2;
    let size = value.xi[0].abs().max(value.xi[1].abs());
    let same = |other: &GridValue| {
        let one_strip = (0..2).all(|i| (other.xi[i] - value.xi[i]).abs() <= SEAM * size)
            && (other.u - value.u).abs() <= SAME * (value.u.abs() + size * step);
        (other.s - value.s).abs() <= SAME * step
            && ((other.parameter - value.parameter).abs() <= SAME * width || one_strip)
    };
    if !values.iter().any(same) {
        values.push(value);
    }
}
