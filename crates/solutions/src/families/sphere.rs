//! Family 4: a sphere inflated or everted.

use piola_fields::Spherical;
use piola_numerics::{Dual, Real};
use piola_tensor::internal::rows::Rows;

use super::Family;
use super::profile;
use crate::error::check_finite;
use crate::{ResponseFunctions, SolutionsError};

/// Whether a shell is as it was or turned inside out.
///
/// # Example
/// See [`SphereDeformation`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Orientation {
    /// The inner face stays inside: the upper signs.
    #[default]
    Kept,
    /// The inner face is outside: the lower signs.
    #[doc(alias = "eversion")]
    Everted,
}

impl Orientation {
    /// ±1.
    pub(crate) const fn sign(self) -> f64 {
        match self {
            Self::Kept => 1.0,
            Self::Everted => -1.0,
        }
    }
}

/// Family 4: inflation or eversion of a sphere.
///
/// ```text
/// r = ∛(±R³ + A)      θ = ±Θ (azimuth)      φ = Φ (colatitude)
/// F = diag(±R²/r², ±r/R, r/R)        det F = 1 for both signs
/// T_rr' = 2 (N_θθ − N_rr)/r        W(25.20–25.22)
/// ```
/// | constant | unit |
/// |---|---|
/// | A | m³ |
///
/// The signs change together. The text's angle in W(25.10) is the colatitude; here it is the last coordinate.
///
/// # Example
/// ```
/// use piola_solutions::families::{Family, Orientation, SphereDeformation};
/// let inflated = SphereDeformation::new(Orientation::Kept, 7.0)?;
/// assert_eq!(inflated.place([1.0, 0.5, 1.0]), [2.0, 0.5, 1.0]); // ∛(1 + 7)
/// let everted = SphereDeformation::new(Orientation::Everted, 9.0)?;
/// assert_eq!(everted.place([1.0, 0.5, 1.0]), [2.0, -0.5, 1.0]); // ∛(9 − 1)
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
///
/// # Source
/// W §25, family 4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereDeformation {
    profile: profile::Spherical<f64>,
}

impl SphereDeformation {
    /// From the signs and A, m³.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`].
    pub fn new(orientation: Orientation, a: f64) -> Result<Self, SolutionsError> {
        check_finite("A", &[a])?;
        Ok(Self { profile: profile::Spherical { sign: orientation.sign(), a } })
    }

    /// A, m³.
    #[must_use]
    pub const fn constant(&self) -> f64 {
        self.profile.a
    }

    /// Whether it is turned inside out.
    #[must_use]
    pub fn orientation(&self) -> Orientation {
        if self.profile.sign < 0.0 { Orientation::Everted } else { Orientation::Kept }
    }
}

impl profile::Spherical<f64> {
    pub(crate) fn over<T: Real>(&self) -> profile::Spherical<T> {
        profile::Spherical { sign: self.sign, a: T::lit(self.a) }
    }
}

impl Family for SphereDeformation {
    type Reference = Spherical;
    type Current = Spherical;

    fn place<T: Real>(&self, [r, theta, phi]: [T; 3]) -> [T; 3] {
        [self.profile.over::<T>().radius(r), T::lit(self.profile.sign) * theta, phi]
    }

    fn gradient<T: Real>(&self, [r, _, _]: [T; 3]) -> Rows<T> {
        self.profile.over::<T>().gradient(r)
    }

    fn check_domain(&self, reference: [f64; 3]) -> Result<(), SolutionsError> {
        check_finite("reference coordinates", &reference)?;
        let coordinate = reference[0];
        let outside = |quantity, value, bound| SolutionsError::OutsideDomain { quantity, value, bound, coordinate };
        let value = self.profile.radicand(coordinate);
        if coordinate <= 0.0 {
            Err(outside("R", coordinate, "0 < R"))
        } else if value <= 0.0 {
            Err(outside("±R³ + A", value, "0 < ±R³ + A"))
        } else {
            Ok(())
        }
    }

    fn rise(&self, law: &impl ResponseFunctions, from: [f64; 3], to: [f64; 3]) -> Result<f64, SolutionsError> {
        self.profile.rise(law, from[0], to[0])
    }

    fn rise_and_slope(
        &self,
        law: &impl ResponseFunctions,
        from: [f64; 3],
        to: [f64; 3],
    ) -> Result<(f64, [f64; 3]), SolutionsError> {
        let profile = self.profile.over::<Dual<f64>>();
        let rise = profile.rise(law, Dual::constant(from[0]), Dual::variable(to[0]))?;
        Ok((rise.value, [rise.tangent, 0.0, 0.0]))
    }
}
