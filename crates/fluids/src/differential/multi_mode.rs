//! Several modes side by side: a spectrum of relaxation times.

use piola_numerics::Real;

use super::mode::{DifferentialFluid, Mode};
use crate::FluidsError;
use crate::ViscometricFluid;

/// Modes of one kind side by side, each with its own parameters: T + p 1 is the sum of theirs.
///
/// # Example
/// ```
/// use piola_fluids::{Modes, OldroydB, ViscometricFluid};
/// let melt = Modes::new(vec![OldroydB::new(0.5, 2.0, 1.0)?, OldroydB::new(0.0, 1.0, 10.0)?])?;
/// assert_eq!(melt.shear_stress(2.0), 7.0); // 3.5 k
/// assert_eq!(melt.first_normal_stress_difference(1.0), 24.0); // 2 (2 · 1 + 1 · 10)
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written<M>", into = "Written<M>"))]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "M: Mode + serde::Serialize", deserialize = "M: Mode + serde::Deserialize<'de>"))
)]
pub struct Modes<M> {
    modes: Vec<M>,
}

/// As it is written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written<M> {
    modes: Vec<M>,
}

#[cfg(feature = "serde")]
impl<M: Mode> TryFrom<Written<M>> for Modes<M> {
    type Error = FluidsError;

    fn try_from(written: Written<M>) -> Result<Self, FluidsError> {
        Self::new(written.modes)
    }
}

#[cfg(feature = "serde")]
impl<M> From<Modes<M>> for Written<M> {
    fn from(fluid: Modes<M>) -> Self {
        Self { modes: fluid.modes }
    }
}

impl<M: Mode> Modes<M> {
    /// From its modes, in any order.
    ///
    /// # Errors
    /// [`FluidsError::OutOfBounds`] without any.
    pub fn new(modes: Vec<M>) -> Result<Self, FluidsError> {
        let count = modes.len() as f64;
        crate::error::check_bound(M::NAME, "number of modes", count, "0 < number of modes", 0.0 < count)?;
        Ok(Self { modes })
    }
}

impl<M: Mode> DifferentialFluid for Modes<M> {
    type Mode = M;

    fn modes(&self) -> &[M] {
        &self.modes
    }
}

macro_rules! sums {
    ($($function:ident),+) => {
        $(#[cfg_attr(not(debug_assertions), inline(always))]
        fn $function<T: Real>(&self, shear_rate: T) -> T {
            self.modes.iter().fold(T::zero(), |sum, mode| sum + mode.$function(shear_rate))
        })+
    };
}

impl<M: Mode> ViscometricFluid for Modes<M> {
    const NAME: &'static str = M::NAME;
    const NORMAL_STRESSES: bool = M::NORMAL_STRESSES;

    sums!(shear_stress, sigma1, sigma2, viscosity, first_normal_stress_difference);
}
