//! Images: samples of a scalar on a grid.

use piola_numerics::Real;

use crate::error::{RegistrationError, check_finite};
use crate::grid::ImageGrid;

/// A scalar image in two or three dimensions.
///
/// | symbol | method | shape | unit |
/// |---|---|---|---|
/// | I | `values` | n₀ n₁ (n₂), row-major: the last index varies fastest | that of the intensity |
///
/// # Example
/// ```
/// use piola_registration::{Image, ImageGrid};
/// let grid = ImageGrid::new([32, 32], [1e-3, 1e-3])?;
/// let disc = Image::from_fn(grid, |[y, x]| if (x - 0.016).hypot(y - 0.016) < 0.008 { 1.0 } else { 0.0 })?;
/// let area = disc.values().iter().sum::<f64>() * 1e-6;
/// assert!((area - std::f64::consts::PI * 0.008_f64.powi(2)).abs() < 0.04 * area);
/// # Ok::<(), piola_registration::RegistrationError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Image<const D: usize, T> {
    grid: ImageGrid<D>,
    values: Vec<T>,
}

impl<const D: usize, T: Real> Image<D, T> {
    /// The image with these `values` in row-major order.
    ///
    /// # Errors
    /// [`RegistrationError::WrongLength`] unless there is a value for each sample; `NotFinite` for the first infinite or NaN value.
    pub fn new(grid: ImageGrid<D>, values: Vec<T>) -> Result<Self, RegistrationError> {
        if values.len() != grid.len() {
            let (quantity, found, expected) = ("values", values.len(), grid.len());
            return Err(RegistrationError::WrongLength { quantity, found, expected });
        }
        check_finite("values", &values)?;
        Ok(Self { grid, values })
    }

    /// The image of a function of the place, m.
    ///
    /// # Errors
    /// [`RegistrationError::NotFinite`] for the first infinite or NaN value.
    pub fn from_fn(grid: ImageGrid<D>, mut value: impl FnMut([f64; D]) -> T) -> Result<Self, RegistrationError> {
        Self::new(grid, (0..grid.len()).map(|position| value(grid.place(position))).collect())
    }

    /// Computed values, which need no check.
    pub(crate) fn computed(grid: ImageGrid<D>, values: Vec<T>) -> Self {
        Self { grid, values }
    }

    /// The grid.
    #[must_use]
    pub fn grid(&self) -> &ImageGrid<D> {
        &self.grid
    }

    /// The values in row-major order.
    #[must_use]
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// The values, taken out.
    #[must_use]
    pub fn into_values(self) -> Vec<T> {
        self.values
    }

    /// The least and the greatest value.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        self.values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, greatest], value| {
            [least.min(value.primal(0)), greatest.max(value.primal(0))]
        })
    }

    /// The mean and the variance of the values.
    pub(crate) fn mean_and_variance(&self) -> [f64; 2] {
        let count = self.values.len() as f64;
        let mean = self.values.iter().map(|value| value.primal(0)).sum::<f64>() / count;
        let variance = self.values.iter().map(|value| (value.primal(0) - mean).powi(2)).sum::<f64>() / count;
        [mean, variance]
    }

    /// An image with at least two values.
    pub(crate) fn check_contrast(&self, image: &'static str) -> Result<(), RegistrationError> {
        let [least, greatest] = self.range();
        if least < greatest { Ok(()) } else { Err(RegistrationError::ConstantImage { image, value: least }) }
    }

    /// Dice's coefficient of the sets where the two images exceed `threshold`: 2 |A ∩ B| / (|A| + |B|); 1 where both are empty.
    ///
    /// # Errors
    /// [`RegistrationError::UnequalSizes`] or `UnequalSpacings` where the grids differ.
    ///
    /// # Example
    /// ```
    /// use piola_registration::{Image, ImageGrid};
    /// let grid = ImageGrid::new([2, 2], [1.0, 1.0])?;
    /// let a = Image::new(grid, vec![1.0, 1.0, 1.0, 0.0])?;
    /// let b = Image::new(grid, vec![1.0, 0.0, 0.0, 0.0])?;
    /// assert_eq!(a.dice(&b, 0.5)?, 0.5);
    /// # Ok::<(), piola_registration::RegistrationError>(())
    /// ```
    pub fn dice(&self, other: &Self, threshold: f64) -> Result<f64, RegistrationError> {
        self.grid.check_same(&other.grid)?;
        let (mut both, mut sum) = (0_usize, 0_usize);
        for (a, b) in self.values.iter().zip(&other.values) {
            let (a, b) = (threshold < a.primal(0), threshold < b.primal(0));
            both += usize::from(a && b);
            sum += usize::from(a) + usize::from(b);
        }
        Ok(if sum == 0 { 1.0 } else { 2.0 * both as f64 / sum as f64 })
    }
}
