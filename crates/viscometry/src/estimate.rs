//! A number with the bound of its error.

/// A number with a bound of its error.
///
/// The error is that of the quadrature (the difference of two rules on every panel, in the manner of QUADPACK) and of rounding; where
/// a closed form serves it is of rounding alone. Errors of the inputs are not in it.
///
/// # Example
/// ```
/// use piola_viscometry::Estimate;
/// let flow = Estimate { value: 2.0, error: 0.25 };
/// assert_eq!(flow.scaled(-3.0), Estimate { value: -6.0, error: 0.75 });
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// A bound of |value − truth|, 0 ≤ error.
    pub error: f64,
}

impl Estimate {
    /// Zero, exactly: where nothing flows.
    pub const ZERO: Self = Self { value: 0.0, error: 0.0 };

    /// A number of a few operations: 16 roundings of it.
    #[must_use]
    pub const fn rounded(value: f64) -> Self {
        Self { value, error: 16.0 * f64::EPSILON * value.abs() }
    }

    /// The multiple by an exact factor.
    #[must_use]
    pub const fn scaled(self, factor: f64) -> Self {
        Self { value: self.value * factor, error: self.error * factor.abs() }
    }

    /// The sum; errors add up.
    #[must_use]
    pub const fn plus(self, other: Self) -> Self {
        Self { value: self.value + other.value, error: self.error + other.error }
    }
}
