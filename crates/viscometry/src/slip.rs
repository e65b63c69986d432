//! Slip at a wall.

use crate::ViscometryError;
use crate::error::check_bound;

/// The speed of a fluid past a wall, a power of the shear stress there.
///
/// ```text
/// v_s = b |τ_w|ᵐ sign τ_w
/// ```
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | b | `coefficient` | m/(s Paᵐ) | 0 ≤ b |
/// | m | `exponent` | – | 0 < m |
///
/// # Example
/// ```
/// use piola_viscometry::WallSlip;
/// let slip = WallSlip::new(0.5, 2.0)?;
/// assert_eq!(slip.speed(-4.0), -8.0);
/// assert_eq!(slip.stress(8.0), 4.0);
/// # Ok::<(), piola_viscometry::ViscometryError>(())
/// ```
///
/// # Source
/// M. Mooney, *J. Rheol.* 2 (1931) 210, who takes `v_s` as a function of `τ_w` alone; m = 1 is Navier's condition.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct WallSlip {
    coefficient: f64,
    exponent: f64,
}

impl WallSlip {
    /// The fluid sticks to the wall.
    pub const NONE: Self = Self { coefficient: 0.0, exponent: 1.0 };

    /// From the coefficient and the exponent.
    ///
    /// # Errors
    /// [`ViscometryError::NotFinite`], [`ViscometryError::OutOfBounds`].
    pub fn new(coefficient: f64, exponent: f64) -> Result<Self, ViscometryError> {
        check_bound("wall slip", "coefficient", coefficient, "0 ≤ b", 0.0 <= coefficient)?;
        check_bound("wall slip", "exponent", exponent, "0 < m", 0.0 < exponent)?;
        Ok(Self { coefficient, exponent })
    }

    /// b, m/(s Paᵐ).
    #[must_use]
    pub const fn coefficient(&self) -> f64 {
        self.coefficient
    }

    /// m.
    #[must_use]
    pub const fn exponent(&self) -> f64 {
        self.exponent
    }

    /// Whether the fluid sticks.
    #[must_use]
    pub const fn is_none(&self) -> bool {
        self.coefficient <= 0.0
    }

    /// `v_s`, m/s, at a wall's shear stress, Pa.
    #[must_use]
    pub fn speed(&self, stress: f64) -> f64 {
        if self.is_none() { 0.0 } else { (self.coefficient * stress.abs().powf(self.exponent)).copysign(stress) }
    }

    /// |`τ_w`|, Pa, at 0 ≤ `speed`, m/s; infinite where nothing slips.
    #[must_use]
    pub fn stress(&self, speed: f64) -> f64 {
        (speed / self.coefficient).powf(self.exponent.recip())
    }

    /// `dv_s/dτ_w` for 0 < `stress`.
    pub(crate) fn slope(&self, stress: f64) -> f64 {
        self.exponent * self.speed(stress) / stress
    }
}

impl Default for WallSlip {
    fn default() -> Self {
        Self::NONE
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for WallSlip {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        /// The parameters as they are written.
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Written {
            coefficient: f64,
            exponent: f64,
        }
        let written = Written::deserialize(deserializer)?;
        Self::new(written.coefficient, written.exponent).map_err(serde::de::Error::custom)
    }
}
