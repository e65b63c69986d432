//! Violated conditions of registration: each variant names one and holds the numbers.

use piola_numerics::{Mask, Real};
use piola_spectral::SpectralError;

/// A violated condition on images, grids, maps or the parameters of a registration.
///
/// # Example
/// ```
/// use piola_registration::{Image, ImageGrid, RegistrationError};
/// let refused = ImageGrid::new([64, 1], [1e-3, 1e-3]);
/// assert!(matches!(refused, Err(RegistrationError::TooFewSamples { axis: 1, found: 1, .. })));
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RegistrationError {
    /// A number is infinite or NaN.
    #[error("{quantity}[{index}] = {value} is not finite; every value must be a finite number")]
    NotFinite {
        /// What the number is.
        quantity: &'static str,
        /// Its position, in row-major order.
        index: usize,
        /// The number itself.
        value: f64,
    },
    /// A list has the wrong length.
    #[error("{quantity} has length {found}; {expected} is expected, the product of the sizes")]
    WrongLength {
        /// What the list is.
        quantity: &'static str,
        /// Its length.
        found: usize,
        /// The length that is expected.
        expected: usize,
    },
    /// Images have two or three dimensions.
    #[error("an image of dimension {found}; dimensions 2 and 3 are valid")]
    Dimension {
        /// The number of dimensions.
        found: usize,
    },
    /// A grid has too few samples along an axis.
    #[error("size {found} along axis {axis}; at least {least} samples are needed along every axis")]
    TooFewSamples {
        /// The axis, from 0.
        axis: usize,
        /// The number of samples.
        found: usize,
        /// The least valid number.
        least: usize,
    },
    /// The product of the sizes exceeds the address space.
    #[error("a grid of sizes {sizes:?} has more samples than memory has addresses")]
    TooManySamples {
        /// The sizes.
        sizes: Vec<usize>,
    },
    /// A quantity is outside its bounds.
    #[error("{quantity} = {value:e} violates {bound}")]
    OutOfBounds {
        /// The name of the quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// The bound, such as `0 < spacing`.
        bound: &'static str,
    },
    /// Two images or maps have different sizes.
    #[error("axis {axis}: the fixed grid has {fixed} samples, the moving one {moving}; both must have the same")]
    UnequalSizes {
        /// The axis, from 0.
        axis: usize,
        /// The size of the fixed grid.
        fixed: usize,
        /// The size of the moving grid.
        moving: usize,
    },
    /// Two images or maps have different spacings.
    #[error(
        "axis {axis}: the fixed grid has the spacing {fixed:e}, the moving one {moving:e}; both must have the same"
    )]
    UnequalSpacings {
        /// The axis, from 0.
        axis: usize,
        /// The spacing of the fixed grid, m.
        fixed: f64,
        /// The spacing of the moving grid, m.
        moving: f64,
    },
    /// An image has one value everywhere, so nothing in it can drive a registration.
    #[error("the {image} image has the constant value {value:e}; at least two different values are needed")]
    ConstantImage {
        /// `fixed` or `moving`.
        image: &'static str,
        /// The value.
        value: f64,
    },
    /// 0 < det(1 − ∇u) is violated: the map folds and has no inverse.
    #[error("the map folds: its least Jacobian is {least:e}; only maps with a positive one have an inverse")]
    Folded {
        /// The least determinant.
        least: f64,
    },
    /// The solver of Lu + f = 0 refuses the grid, the operator or the force.
    #[error(transparent)]
    Spectral(SpectralError),
}

impl From<SpectralError> for RegistrationError {
    fn from(error: SpectralError) -> Self {
        match error {
            SpectralError::NotFinite { quantity, index, value } => Self::NotFinite { quantity, index, value },
            other => Self::Spectral(other),
        }
    }
}

/// Refuses the first number that is infinite or NaN.
pub(crate) fn check_finite<T: Real>(quantity: &'static str, values: &[T]) -> Result<(), RegistrationError> {
    match values.iter().position(|value| !value.is_finite().all()) {
        Some(index) => Err(RegistrationError::NotFinite { quantity, index, value: values[index].primal(0) }),
        None => Ok(()),
    }
}

/// Refuses a parameter for which `holds` is false, or that is not finite.
pub(crate) fn check_bound(
    quantity: &'static str,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), RegistrationError> {
    if !value.is_finite() {
        return Err(RegistrationError::NotFinite { quantity, index: 0, value });
    }
    if holds { Ok(()) } else { Err(RegistrationError::OutOfBounds { quantity, value, bound }) }
}
