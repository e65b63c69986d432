//! Fung's exponential law of soft tissue.

use piola_continuum::strain::GreenStrain;
use piola_continuum::tensor::{MajorSymmetric, PairSymmetric};
use piola_continuum::{Deformation, Symmetric};
use piola_numerics::{Mask, Real};

use super::Stiffness;
use super::strain_energy::{StrainEnergy, constant_tangent, hyperelastic_of_strain};
use crate::ConstitutiveError;
use crate::error::check_bound;

const LAW: &str = "Fung";

/// The exponent at which the exponential leaves the range of numbers.
pub(super) const LARGEST_EXPONENT: f64 = 700.0;

/// Refuses an exponent beyond the range of numbers.
#[inline]
pub(super) fn check_exponent<T: Real>(
    law: &'static str,
    quantity: &'static str,
    exponent: T,
) -> Result<(), ConstitutiveError> {
    if exponent.less_than(T::lit(LARGEST_EXPONENT)).all() {
        return Ok(());
    }
    let value = (0..T::LANES).map(|lane| exponent.primal(lane)).fold(0.0, f64::max);
    Err(ConstitutiveError::BeyondLimit { law, quantity, value, limit: LARGEST_EXPONENT })
}

/// Fung's solid: a stiffness that grows exponentially with the strain, of any symmetry.
///
/// ```text
/// W = ½ c (e^Q − 1)        Q = E : A : E        S = c e^Q A : E        ∂S/∂E = c e^Q (A + 2 (A : E) ⊗ (A : E))
/// ```
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | c | `c` | Pa | 0 < c |
/// | A | `exponents` | – | positive definite |
///
/// The stiffness of the reference is c A. [`check`](super::Hyperelastic::check) refuses Q ≥ 700.
///
/// # Accuracy
/// Stresses relative 1e-13 down to ∇u = 1e-16; at large Q, Q ulp.
///
/// # Example
/// ```
/// use piola_constitutive::solids::{Fung, Hyperelastic, Stiffness};
/// use piola_continuum::DeformationGradient;
/// let law = Fung::new(2.0, Stiffness::isotropic(0.0, 0.5)?)?; // Q = E : E
/// let bar = DeformationGradient::diagonal([3.0_f64.sqrt(), 1.0, 1.0])?; // E₁₁ = 1
/// assert!((law.energy(&bar) - 1.0_f64.exp_m1()).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// Y. C. Fung, K. Fronek and P. Patitucci, Am. J. Physiol. 237 (1979) H620–H631.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written", into = "Written"))]
pub struct Fung {
    c: f64,
    exponents: Stiffness,
}

impl Fung {
    /// From c and A.
    ///
    /// # Errors
    /// [`ConstitutiveError::NotFinite`], [`ConstitutiveError::OutOfBounds`].
    pub fn new(c: f64, exponents: Stiffness) -> Result<Self, ConstitutiveError> {
        check_bound(LAW, "c", c, "0 < c", 0.0 < c)?;
        Ok(Self { c, exponents })
    }

    /// c, Pa.
    #[must_use]
    pub const fn c(&self) -> f64 {
        self.c
    }

    /// A.
    #[must_use]
    pub const fn exponents(&self) -> &Stiffness {
        &self.exponents
    }

    /// A : E and Q.
    #[inline(always)]
    fn exponent<T: Real>(&self, deformation: &impl Deformation<T>) -> (Symmetric<T>, T) {
        let strain = GreenStrain::of(deformation).0;
        let image = constant_tangent(self.exponents.tensor()).contract(&strain);
        (image, strain.double_contraction(&image))
    }
}

impl StrainEnergy for Fung {
    #[inline(always)]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        T::lit(0.5 * self.c) * self.exponent(deformation).1.exp_m1()
    }
    #[inline(always)]
    fn stress<T: Real>(&self, deformation: &impl Deformation<T>) -> Symmetric<T> {
        let (image, q) = self.exponent(deformation);
        image * (T::lit(self.c) * q.exp())
    }
    #[inline(always)]
    fn tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> MajorSymmetric<T> {
        let (image, q) = self.exponent(deformation);
        let whole = constant_tangent(self.exponents.tensor()) + MajorSymmetric::dyad(&image) * T::lit(2.0);
        whole * (T::lit(self.c) * q.exp())
    }
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), ConstitutiveError> {
        check_exponent(LAW, "Q", self.exponent(deformation).1)
    }
}

hyperelastic_of_strain!(Fung);

/// The parameters as they are written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    c: f64,
    exponents: Stiffness,
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for Fung {
    type Error = ConstitutiveError;

    fn try_from(Written { c, exponents }: Written) -> Result<Self, ConstitutiveError> {
        Self::new(c, exponents)
    }
}

#[cfg(feature = "serde")]
impl From<Fung> for Written {
    fn from(Fung { c, exponents }: Fung) -> Self {
        Self { c, exponents }
    }
}
