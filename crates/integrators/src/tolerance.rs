//! The accuracy asked of an adaptive method.

use piola_numerics::Real;
use piola_numerics::sums::unit_in_last_place;

use crate::IntegratorsError;

/// Local error allowed in one step: `absolute + relative · magnitude` for each component.
///
/// The magnitude is the field's: by default the largest component of the block (positions or velocities),
/// at the time of the step, so that a component passing through zero does not stop the run and no unit is
/// built in. See [`Field::magnitudes`](crate::Field::magnitudes).
///
/// # Tolerances below rounding
/// Methods raise a relative part that rounding alone exceeds, because steps would grow short and nothing would be won. The
/// least is two units in the last place for explicit pairs, 4.4e-16 in `f64` and 2.4e-7 in `f32`; 1e-14 for `RadauIia`;
/// 1e-17 for [`GaussLegendre16`](crate::GaussLegendre16), and what [`with_epsilon`](crate::GaussRadau15::with_epsilon) says
/// for [`GaussRadau15`](crate::GaussRadau15). A relative part of zero is raised too, but by `RadauIia`.
///
/// # Example
/// ```
/// use piola_integrators::Tolerance;
/// let tolerance = Tolerance::relative(1e-10)?;
/// assert_eq!(tolerance.relative_part(), 1e-10);
/// assert!(Tolerance::relative(-1.0).is_err());
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Unchecked", into = "Unchecked"))]
pub struct Tolerance {
    relative: f64,
    absolute: f64,
}

impl Tolerance {
    /// Relative to the magnitude of each component's group.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidTolerance`] unless 0 < relative < 1.
    pub const fn relative(relative: f64) -> Result<Self, IntegratorsError> {
        Self::new(relative, 0.0)
    }

    /// Relative plus absolute; the absolute part has the unit of each component.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidTolerance`] unless 0 ≤ relative < 1, 0 ≤ absolute < ∞ and one is positive.
    pub const fn new(relative: f64, absolute: f64) -> Result<Self, IntegratorsError> {
        let in_range = 0.0 <= relative && relative < 1.0 && 0.0 <= absolute && absolute < f64::INFINITY;
        if in_range && 0.0 < relative + absolute {
            Ok(Self { relative, absolute })
        } else {
            Err(IntegratorsError::InvalidTolerance { relative, absolute })
        }
    }

    /// A part of it, for numbers of the type T.
    pub(crate) fn times<T: Real>(self, part: f64) -> Self {
        Self { relative: self.relative * part, absolute: self.absolute * part }.above_rounding::<T>()
    }

    /// With a relative part that steps over numbers of the type T can keep.
    #[doc(hidden)]
    #[must_use]
    pub fn above_rounding<T: Real>(self) -> Self {
        Self { relative: self.relative.max(2.0 * unit_in_last_place::<T>()), ..self }
    }

    /// The relative part.
    #[must_use]
    pub const fn relative_part(self) -> f64 {
        self.relative
    }

    /// The absolute part.
    #[must_use]
    pub const fn absolute_part(self) -> f64 {
        self.absolute
    }
}

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    relative: f64,
    #[serde(default)]
    absolute: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for Tolerance {
    type Error = IntegratorsError;
    fn try_from(unchecked: Unchecked) -> Result<Self, IntegratorsError> {
        Self::new(unchecked.relative, unchecked.absolute)
    }
}

#[cfg(feature = "serde")]
impl From<Tolerance> for Unchecked {
    fn from(tolerance: Tolerance) -> Self {
        Self { relative: tolerance.relative, absolute: tolerance.absolute }
    }
}
