//! Fung's exponential law of soft tissue.

use piola_continuum::strain::GreenStrain;
use piola_continuum::tensor::rows::double_contraction;
use piola_continuum::tensor::{MajorSymmetric, PairSymmetric};
use piola_continuum::{Deformation, Symmetric};
use piola_numerics::Real;

use super::Stiffness;
use super::range::check_exponent;
use super::strain_energy::{StrainEnergy, constant_tangent, hyperelastic_of_strain};
use crate::ConstitutiveError;
use crate::error::check_bound;

const LAW: &str = "Fung";

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
/// The stiffness of the reference is c A. [`check`](super::Hyperelastic::check) refuses Q at which c e^Q (1 + 2 Q) |A| |F|²
/// leaves the range of the scalar: some 700 in double precision, 80 in single.
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

    /// S and ∂S/∂E of A : E and e^Q.
    #[inline(always)]
    fn scaled<T: Real>(&self, image: &Symmetric<T>, power: T) -> (Symmetric<T>, MajorSymmetric<T>) {
        let scale = T::lit(self.c) * power;
        let whole = constant_tangent(self.exponents.tensor()) + MajorSymmetric::dyad(image) * T::lit(2.0);
        (*image * scale, whole * scale)
    }
}

impl StrainEnergy for Fung {
    #[inline(always)]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        T::lit(0.5 * self.c) * self.exponent(deformation).1.exp_m1()
    }
    #[inline(always)]
    fn stress<T: Real>(&self, deformation: &impl Deformation<T>) -> Symmetric<T> {
        self.stress_and_tangent(deformation).0
    }
    #[inline(always)]
    fn tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> MajorSymmetric<T> {
        self.stress_and_tangent(deformation).1
    }
    #[inline(always)]
    fn stress_and_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> (Symmetric<T>, MajorSymmetric<T>) {
        let (image, q) = self.exponent(deformation);
        self.scaled(&image, q.exp())
    }
    #[inline(always)]
    fn energy_stress_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (T, Symmetric<T>, MajorSymmetric<T>) {
        let (image, q) = self.exponent(deformation);
        let growth = q.exp_m1();
        let (stress, tangent) = self.scaled(&image, T::one() + growth);
        (T::lit(0.5 * self.c) * growth, stress, tangent)
    }
    #[inline(always)]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), ConstitutiveError> {
        let q = self.exponent(deformation).1;
        // (A : E)² ≤ |A| Q.
        let stiffest = self.exponents.tensor().components.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let f = deformation.gradient_rows();
        let square = double_contraction(f, f);
        let factor = T::lit(9.0 * self.c * stiffest) * (T::one() + T::lit(2.0) * q) * (T::one() + square);
        check_exponent(LAW, "Q", q, factor)
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
