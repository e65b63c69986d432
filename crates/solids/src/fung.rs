//! Fung's exponential law of soft tissue.

use piola_continuum::strain::GreenStrain;
use piola_continuum::{Deformation, FirstPiola, Symmetric};
use piola_numerics::Real;
use piola_tensor::{MajorSymmetric, PairSymmetric};

use super::Stiffness;
use super::exponent_range::check_range;
use super::strain_energy::{GreenEnergy, StrainEnergy, constant_tangent, hyperelastic_of_strain};
use crate::SolidsError;
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
/// | c | `modulus` | Pa | 0 < c |
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
/// use piola_solids::{Fung, Hyperelastic, Stiffness};
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
#[cfg_attr(feature = "serde", serde(try_from = "Written"))]
pub struct Fung {
    modulus: f64,
    exponents: Stiffness,
    /// c · max(9 |A|, 1), |A| the largest component.
    #[cfg_attr(feature = "serde", serde(skip))]
    size: f64,
}

impl Fung {
    /// From c and A.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn new(modulus: f64, exponents: Stiffness) -> Result<Self, SolidsError> {
        check_bound(LAW, "modulus", modulus, "0 < c", 0.0 < modulus)?;
        let largest = exponents.tensor().components.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        Ok(Self { modulus, exponents, size: modulus * (9.0 * largest).max(1.0) })
    }

    /// c, Pa.
    #[doc(alias = "c")]
    #[must_use]
    pub const fn modulus(&self) -> f64 {
        self.modulus
    }

    /// A.
    #[must_use]
    pub const fn exponents(&self) -> &Stiffness {
        &self.exponents
    }

    /// A : E and Q.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn exponent<T: Real>(&self, strain: &Symmetric<T>) -> (Symmetric<T>, T) {
        let image = constant_tangent(self.exponents.tensor()).contract(strain);
        (image, strain.double_contraction(&image))
    }

    /// Upper bound of the factor of e^Q in ∂P/∂F: (A : E)² ≤ |A| Q, and |F|² = tr C.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn factor<T: Real>(&self, strain: &Symmetric<T>, q: T) -> T {
        let two = T::lit(2.0);
        T::lit(self.size) * ((T::one() + two * q) * (T::lit(4.0) + two * strain.trace()))
    }

    /// 1 where the tangent is within the range of the scalar, NaN elsewhere; e^Q is given.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn within<T: Real>(&self, strain: &Symmetric<T>, q: T, power: T) -> T {
        T::select((self.factor(strain, q) * power).is_finite(), T::one(), T::lit(f64::NAN))
    }

    /// e^Q − 1, NaN where e^Q is refused.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn growth<T: Real>(&self, strain: &Symmetric<T>, q: T) -> T {
        q.exp_m1() * self.within(strain, q, q.exp())
    }

    /// S and ∂S/∂E of A : E and e^Q.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn scaled<T: Real>(&self, image: &Symmetric<T>, power: T) -> (Symmetric<T>, MajorSymmetric<T>) {
        let scale = T::lit(self.modulus) * power;
        let whole = constant_tangent(self.exponents.tensor()) + MajorSymmetric::dyad(image) * T::lit(2.0);
        (*image * scale, whole * scale)
    }
}

impl GreenEnergy for Fung {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn green_stress<T: Real>(&self, strain: &Symmetric<T>) -> Symmetric<T> {
        self.green_stress_and_tangent(strain).0
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn green_stress_and_tangent<T: Real>(&self, strain: &Symmetric<T>) -> (Symmetric<T>, MajorSymmetric<T>) {
        let (image, q) = self.exponent(strain);
        let power = q.exp();
        self.scaled(&image, power * self.within(strain, q, power))
    }
}

impl StrainEnergy for Fung {
    const REFUSED_IS_NOT_FINITE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let strain = GreenStrain::of(deformation).0;
        let q = self.exponent(&strain).1;
        T::lit(0.5 * self.modulus) * self.growth(&strain, q)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stress<T: Real>(&self, deformation: &impl Deformation<T>) -> Symmetric<T> {
        self.green_stress(&GreenStrain::of(deformation).0)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> MajorSymmetric<T> {
        self.stress_and_tangent(deformation).1
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stress_and_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> (Symmetric<T>, MajorSymmetric<T>) {
        self.green_stress_and_tangent(&GreenStrain::of(deformation).0)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        self.in_lanes(deformation)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn upper_triangle<T: Real>(&self, deformation: &impl Deformation<T>) -> [T; 54] {
        self.both_in_lanes(deformation)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy_stress_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (T, Symmetric<T>, MajorSymmetric<T>) {
        let strain = GreenStrain::of(deformation).0;
        let (image, q) = self.exponent(&strain);
        let growth = self.growth(&strain, q);
        let (stress, tangent) = self.scaled(&image, T::one() + growth);
        (T::lit(0.5 * self.modulus) * growth, stress, tangent)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        let strain = GreenStrain::of(deformation).0;
        let q = self.exponent(&strain).1;
        check_range(LAW, "Q", q, self.factor(&strain, q))
    }
}

hyperelastic_of_strain!(Fung);

read_with!(new of Fung<> { modulus as "c": f64, exponents: Stiffness });
