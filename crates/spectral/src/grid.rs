//! Points of a box at which a field is given.

use std::f64::consts::PI;

use crate::SpectralError;
use crate::error::check_bound;

/// Where the points of a grid are.
///
/// # Example
/// ```
/// use piola_spectral::{BoxGrid, PointLocation};
/// assert_eq!(BoxGrid::cells([4, 4], [1.0, 1.0])?.location(), PointLocation::Cells);
/// # Ok::<(), piola_spectral::SpectralError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PointLocation {
    /// At the centres of cells, like the voxels of an image: x = (m + ½) h, side L = n h.
    Cells,
    /// From wall to wall: x = m h, side L = (n − 1) h.
    Nodes,
}

/// A grid of points in a rectangle (D = 2) or a box (D = 3), in row-major order: the last index runs fastest.
///
/// # Example
/// ```
/// use piola_spectral::BoxGrid;
/// let image = BoxGrid::cells([128, 128, 40], [0.5e-3, 0.5e-3, 2e-3])?;
/// assert_eq!(image.sides(), [0.064, 0.064, 0.08]);
/// assert_eq!(BoxGrid::nodes([5, 3], [0.25, 0.5])?.sides(), [1.0, 1.0]);
/// # Ok::<(), piola_spectral::SpectralError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxGrid<const D: usize> {
    points: [usize; D],
    spacings: [f64; D],
    location: PointLocation,
}

impl<const D: usize> BoxGrid<D> {
    /// A grid of centres of cells: `points` cells of sides `spacings`, m.
    ///
    /// # Errors
    /// Fewer than two points along an axis, a spacing that is not finite and positive, too many points to address.
    pub fn cells(points: [usize; D], spacings: [f64; D]) -> Result<Self, SpectralError> {
        Self::new(points, spacings, PointLocation::Cells)
    }

    /// A grid whose first and last points are on the walls: `points` nodes `spacings` apart, m.
    ///
    /// # Errors
    /// Fewer than three points along an axis, a spacing that is not finite and positive, too many points to address.
    pub fn nodes(points: [usize; D], spacings: [f64; D]) -> Result<Self, SpectralError> {
        Self::new(points, spacings, PointLocation::Nodes)
    }

    fn new(points: [usize; D], spacings: [f64; D], location: PointLocation) -> Result<Self, SpectralError> {
        const { assert!(D == 2 || D == 3, "a rectangle or a box") };
        let least = match location {
            PointLocation::Cells => 2,
            PointLocation::Nodes => 3,
        };
        if let Some(axis) = points.iter().position(|&points| points < least) {
            return Err(SpectralError::TooFewPoints { axis, points: points[axis], least });
        }
        for spacing in spacings {
            check_bound("spacing", spacing, "0 < h", 0.0 < spacing)?;
        }
        let bytes = points.iter().try_fold(size_of::<f64>(), |product, &points| product.checked_mul(points));
        if bytes.is_none_or(|bytes| isize::MAX.unsigned_abs() < bytes) {
            return Err(SpectralError::TooManyPoints { points: in_space(points, 1) });
        }
        let grid = Self { points, spacings, location };
        for side in grid.sides() {
            // The squares of the smallest and of the largest wave number must be numbers too.
            check_bound("side", side, "1e-70 < L < 1e70", 1e-70 < side && side < 1e70)?;
        }
        for spacing in spacings {
            check_bound("spacing", spacing, "1e-70 < h", 1e-70 < spacing)?;
        }
        Ok(grid)
    }

    /// The points along each axis.
    #[must_use]
    pub fn points(&self) -> [usize; D] {
        self.points
    }

    /// The distances between neighbouring points along each axis, m.
    #[must_use]
    pub fn spacings(&self) -> [f64; D] {
        self.spacings
    }

    /// Where the points are.
    #[must_use]
    pub fn location(&self) -> PointLocation {
        self.location
    }

    /// The number of all points.
    #[must_use]
    #[allow(clippy::len_without_is_empty, reason = "a grid has at least four points")]
    pub fn len(&self) -> usize {
        self.points.iter().product()
    }

    /// The sides of the box, m: n h for cells, (n − 1) h for nodes.
    #[must_use]
    pub fn sides(&self) -> [f64; D] {
        std::array::from_fn(|axis| self.intervals(axis) as f64 * self.spacings[axis])
    }

    /// The place of the point with these indices, m.
    #[must_use]
    pub fn position(&self, indices: [usize; D]) -> [f64; D] {
        let offset = match self.location {
            PointLocation::Cells => 0.5,
            PointLocation::Nodes => 0.0,
        };
        std::array::from_fn(|axis| (indices[axis] as f64 + offset) * self.spacings[axis])
    }

    /// The indices of the point at this position in the list of samples.
    #[must_use]
    pub fn indices(&self, position: usize) -> [usize; D] {
        let mut rest = position;
        let mut indices = [0; D];
        for axis in (0..D).rev() {
            indices[axis] = rest % self.points[axis];
            rest /= self.points[axis];
        }
        indices
    }

    /// Spacings from wall to wall.
    pub(crate) fn intervals(&self, axis: usize) -> usize {
        match self.location {
            PointLocation::Cells => self.points[axis],
            PointLocation::Nodes => self.points[axis] - 1,
        }
    }

    /// The wave number of index 1, π/L.
    pub(crate) fn first_wave_number(&self, axis: usize) -> f64 {
        PI / self.sides()[axis]
    }
}

/// Numbers of a rectangle or a box as three, for messages.
pub(crate) fn in_space<const D: usize>(numbers: [usize; D], rest: usize) -> [usize; 3] {
    std::array::from_fn(|axis| numbers.get(axis).copied().unwrap_or(rest))
}
