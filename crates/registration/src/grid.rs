//! Where the samples of an image lie.

use crate::error::{RegistrationError, check_bound};

/// A regular grid of samples at the centres of equal cells, which fill a box.
///
/// ```text
/// x_a = (i_a + ½) h_a,   i_a = 0 … n_a − 1,   box [0, n_0 h_0] × [0, n_1 h_1] (× [0, n_2 h_2])
/// ```
/// | symbol | field | unit |
/// |---|---|---|
/// | n | `sizes` | – |
/// | h | `spacing` | m, or any other unit of length, used throughout |
///
/// Samples are stored in row-major order: the last index varies fastest. Axis 0 of a picture is the row (downwards), axis 1 the column.
/// Coordinates begin at the corner of the box. An image with another origin or orientation has the same registration, because the models are
/// isotropic: add the origin to the results, and turn them.
///
/// # Example
/// ```
/// use piola_registration::ImageGrid;
/// let grid = ImageGrid::new([4, 8], [0.5, 0.25])?;
/// assert_eq!((grid.len(), grid.sides()), (32, [2.0, 2.0]));
/// assert_eq!(grid.place(9), [0.75, 0.375]); // sample (1, 1)
/// # Ok::<(), piola_registration::RegistrationError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImageGrid<const D: usize> {
    sizes: [usize; D],
    spacing: [f64; D],
}

impl<const D: usize> ImageGrid<D> {
    /// A grid of `sizes` samples with distances `spacing`, in m.
    ///
    /// # Errors
    /// [`RegistrationError::Dimension`] unless D is 2 or 3; `TooFewSamples` for a size below 2; `OutOfBounds` unless 0 < spacing;
    /// `NotFinite` for an infinite or NaN spacing; `TooManySamples` where the product of the sizes overflows.
    pub fn new(sizes: [usize; D], spacing: [f64; D]) -> Result<Self, RegistrationError> {
        if D != 2 && D != 3 {
            return Err(RegistrationError::Dimension { found: D });
        }
        for (axis, &found) in sizes.iter().enumerate() {
            if found < 2 {
                return Err(RegistrationError::TooFewSamples { axis, found, least: 2 });
            }
        }
        for &h in &spacing {
            check_bound("spacing", h, "0 < spacing", 0.0 < h)?;
        }
        let total = sizes.iter().try_fold(1_usize, |product, &size| product.checked_mul(size));
        if total.and_then(|total| total.checked_mul(16 * D)).is_none_or(|bytes| isize::MAX.unsigned_abs() < bytes) {
            return Err(RegistrationError::TooManySamples { sizes: sizes.to_vec() });
        }
        Ok(Self { sizes, spacing })
    }

    /// The number of samples along each axis.
    #[must_use]
    pub fn sizes(&self) -> [usize; D] {
        self.sizes
    }

    /// The distance of neighbours along each axis, m.
    #[must_use]
    pub fn spacing(&self) -> [f64; D] {
        self.spacing
    }

    /// The sides of the box, n h, m.
    #[must_use]
    pub fn sides(&self) -> [f64; D] {
        std::array::from_fn(|axis| self.sizes[axis] as f64 * self.spacing[axis])
    }

    /// The number of samples.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a grid always has samples")]
    pub fn len(&self) -> usize {
        self.sizes.iter().product()
    }

    /// The coordinates of the sample stored at `position`, m.
    #[must_use]
    pub fn place(&self, position: usize) -> [f64; D] {
        let index = self.index(position);
        std::array::from_fn(|axis| (index[axis] as f64 + 0.5) * self.spacing[axis])
    }

    /// The indices of the sample stored at `position`.
    #[inline]
    pub(crate) fn index(&self, position: usize) -> [usize; D] {
        let mut rest = position;
        let mut index = [0; D];
        for axis in (0..D).rev() {
            index[axis] = rest % self.sizes[axis];
            rest /= self.sizes[axis];
        }
        index
    }

    /// How far apart neighbours along each axis are stored.
    #[inline]
    pub(crate) fn strides(&self) -> [usize; D] {
        let mut strides = [1; D];
        for axis in (0..D - 1).rev() {
            strides[axis] = strides[axis + 1] * self.sizes[axis + 1];
        }
        strides
    }

    /// The geometric mean of the spacings: the side of a cube with the volume of a cell.
    pub(crate) fn mean_spacing(&self) -> f64 {
        self.spacing.iter().product::<f64>().powf(1.0 / D as f64)
    }

    /// The grid of half as many samples (rounded up) along each axis that fills the same box.
    pub(crate) fn halved(&self) -> Self {
        let sizes = self.sizes.map(|size| size.div_ceil(2).max(2));
        let sides = self.sides();
        Self { sizes, spacing: std::array::from_fn(|axis| sides[axis] / sizes[axis] as f64) }
    }

    /// Both grids are the same.
    pub(crate) fn check_same(&self, moving: &Self) -> Result<(), RegistrationError> {
        for axis in 0..D {
            let (fixed, moving) = (self.sizes[axis], moving.sizes[axis]);
            if fixed != moving {
                return Err(RegistrationError::UnequalSizes { axis, fixed, moving });
            }
        }
        for axis in 0..D {
            let (fixed, moving) = (self.spacing[axis], moving.spacing[axis]);
            // Files round spacings to single precision.
            if 1e-6 * fixed < (fixed - moving).abs() {
                return Err(RegistrationError::UnequalSpacings { axis, fixed, moving });
            }
        }
        Ok(())
    }
}

/// Moves `index` to the next sample in row-major order.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn advance<const D: usize>(index: &mut [usize; D], sizes: &[usize; D]) {
    for axis in (0..D).rev() {
        index[axis] += 1;
        if index[axis] < sizes[axis] {
            return;
        }
        index[axis] = 0;
    }
}
