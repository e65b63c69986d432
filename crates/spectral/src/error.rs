//! Violated conditions of fields on a box: each variant names one and holds the numbers.

/// A violated condition on a grid, a material, a field or a motion.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpectralError {
    /// A number is infinite or NaN.
    #[error("{quantity}[{index}] = {value} is not finite")]
    NotFinite {
        /// What the number is.
        quantity: &'static str,
        /// Its position in the list.
        index: usize,
        /// The number itself.
        value: f64,
    },
    /// A list has the wrong length.
    #[error("{quantity} has length {found}; {expected} is expected")]
    WrongLength {
        /// What the list is.
        quantity: &'static str,
        /// Its length.
        found: usize,
        /// The length that is expected.
        expected: usize,
    },
    /// An axis has too few points.
    #[error("axis {axis} has {points} points; at least {least} are needed")]
    TooFewPoints {
        /// The axis, from 0.
        axis: usize,
        /// The points along it.
        points: usize,
        /// The least number.
        least: usize,
    },
    /// The product of the numbers of points exceeds what memory can address.
    #[error("a grid of {points:?} points is too large to address")]
    TooManyPoints {
        /// The points along the axes; the third is 1 in a rectangle.
        points: [usize; 3],
    },
    /// A quantity is outside its bounds.
    #[error("{quantity} = {value:e} violates {bound}")]
    OutOfBounds {
        /// The name of the quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// The bound, such as `0 < h`.
        bound: &'static str,
    },
    /// 0 < λ + 2μ is violated: the operator is not elliptic.
    #[error("λ = {first:e} and μ = {shear_modulus:e} violate 0 < λ + 2μ")]
    NotElliptic {
        /// λ.
        first: f64,
        /// μ.
        shear_modulus: f64,
    },
    /// The eigenfunction of these indices is zero everywhere.
    #[error("the eigenfunction {indices:?} of family {family} vanishes identically")]
    VanishingMode {
        /// The indices; the third is 0 in a rectangle.
        indices: [usize; 3],
        /// The family, from 1.
        family: usize,
    },
    /// A force that must balance itself does not: its mean pushes the whole body.
    #[error(
        "component {component} of the force has the mean {mean:e} beside the largest value {largest:e}: nothing holds the body"
    )]
    UnbalancedForce {
        /// The component, from 0.
        component: usize,
        /// Its mean.
        mean: f64,
        /// Its largest absolute value.
        largest: f64,
    },
    /// The grid of one field is not the grid of another.
    #[error("{quantity} is on another grid, or between other walls")]
    OtherGrid {
        /// Which field.
        quantity: &'static str,
    },
    /// 0 < det(1 − ∇u) is violated: the map folds.
    #[error("the map folds at point {index}: det(1 − ∇u) = {jacobian:e} violates {bound:e} < det(1 − ∇u)")]
    Folded {
        /// The point, in the order of the samples.
        index: usize,
        /// The determinant there.
        jacobian: f64,
        /// The bound.
        bound: f64,
    },
    /// An adaptive step fell below the least step.
    #[error("at t = {time} the step fell to {step:e}")]
    StepTooSmall {
        /// The time.
        time: f64,
        /// The step.
        step: f64,
    },
}

/// Refuses the first number that is infinite or NaN.
pub(crate) fn check_finite(quantity: &'static str, values: &[f64]) -> Result<(), SpectralError> {
    match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(SpectralError::NotFinite { quantity, index, value: values[index] }),
        None => Ok(()),
    }
}

/// Refuses a list of another length.
pub(crate) fn check_length(quantity: &'static str, found: usize, expected: usize) -> Result<(), SpectralError> {
    if found == expected { Ok(()) } else { Err(SpectralError::WrongLength { quantity, found, expected }) }
}

/// Refuses a value for which `holds` is false, or that is not finite.
pub(crate) fn check_bound(
    quantity: &'static str,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), SpectralError> {
    check_finite(quantity, &[value])?;
    if holds { Ok(()) } else { Err(SpectralError::OutOfBounds { quantity, value, bound }) }
}
