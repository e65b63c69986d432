//! Inflation of a spherical shell: the balloon.

use piola_numerics::Dual;

use super::Shell;
use crate::error::check_bound;
use crate::families::profile::Spherical;
use crate::families::{Orientation, SphereDeformation};
use crate::integral::Packed;
use crate::{LoadCurve, ResponseFunctions, SolutionsError};

/// The pressure inside a spherical shell over the stretch of its cavity.
///
/// ```text
/// p = 2 ∫ (N_θθ − N_rr) dr/r from the inner face to the outer,   λ = (radius of the cavity)/R_i
/// ```
/// The outer face is free. Where the shell is turned inside out the cavity is bounded by the face `R_o`; p = 0 then gives the
/// everted shell without loads.
///
/// The curve of a rubber balloon rises to a limit point, falls, and may rise again.
///
/// # Example
/// A thin neo-Hookean balloon: p ≈ 2 μ (h/R) (1/λ − 1/λ⁷), with the limit at λ = 7^(1/6).
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::{LoadCurve, SolutionsError};
/// use piola_solutions::families::Orientation;
/// use piola_solutions::loads::{Shell, SphereInflation};
/// let law = NeoHookean::new(1.0)?;
/// let balloon = SphereInflation { shell: Shell::new(1.0, 1.0001)?, law: &law, orientation: Orientation::Kept };
/// let limits = balloon.limit_points((1.0, 8.0))?;
/// assert_eq!(limits.len(), 1);
/// assert!((limits[0].parameter - 7.0_f64.powf(1.0 / 6.0)).abs() < 1e-3);
/// assert_eq!(balloon.states_at(0.9 * limits[0].load, (1.0, 8.0))?.len(), 2);
/// let beyond = balloon.states_at(1.1 * limits[0].load, (1.0, 8.0));
/// assert!(matches!(beyond, Err(SolutionsError::BeyondLimitPoint { .. })));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// A. E. Green and R. T. Shield, Proc. R. Soc. A 202 (1950) 407; family 4.
#[doc(alias("balloon", "inflation", "eversion"))]
#[derive(Clone, Copy, Debug)]
pub struct SphereInflation<'a, L> {
    /// The shell.
    pub shell: Shell,
    /// The law.
    pub law: &'a L,
    /// Whether it is turned inside out.
    pub orientation: Orientation,
}

impl<L: ResponseFunctions> SphereInflation<'_, L> {
    /// The deformation at a stretch of the cavity.
    ///
    /// # Errors
    /// [`SolutionsError::OutOfBounds`] unless 0 < λ.
    pub fn deformation(&self, stretch: f64) -> Result<SphereDeformation, SolutionsError> {
        check_bound("stretch", stretch, "0 < λ", 0.0 < stretch)?;
        SphereDeformation::new(self.orientation, self.profile(stretch).a)
    }

    fn profile<T: Packed>(&self, stretch: T) -> Spherical<T> {
        let sign = self.orientation.sign();
        let inner = T::lit(self.shell.inner()) * stretch;
        let face = if sign < 0.0 { self.shell.outer() } else { self.shell.inner() };
        Spherical { sign, a: inner * inner * inner - T::lit(sign * face * face * face) }
    }

    pub(crate) fn pressure<T: Packed>(&self, stretch: T) -> Result<T, SolutionsError> {
        let profile = self.profile(stretch);
        let rise = profile.rise(self.law, T::lit(self.shell.inner()), T::lit(self.shell.outer()))?;
        Ok(rise * T::lit(self.orientation.sign()))
    }
}

impl<L: ResponseFunctions> LoadCurve for SphereInflation<'_, L> {
    const LOAD: &'static str = "pressure";
    const PARAMETER: &'static str = "stretch";

    fn load_and_slope(&self, stretch: f64) -> Result<[f64; 2], SolutionsError> {
        check_bound("stretch", stretch, "0 < λ", 0.0 < stretch)?;
        let pressure = self.pressure(Dual::variable(stretch))?;
        Ok([pressure.value, pressure.tangent])
    }
}
