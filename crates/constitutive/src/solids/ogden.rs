//! Ogden's solids: series of powers of the principal stretches.

use piola_continuum::spectral::{Exponential, IsotropicFunction};
use piola_numerics::Real;

use super::stretch::{StretchEnergy, Volume, hyperelastic_of_stretches};
use crate::ConstitutiveError;
use crate::elementary::excess_of_exponential;
use crate::error::{check_bound, check_finite};

/// The largest number of terms.
const CAPACITY: usize = 8;

/// One term μ/α (λ₁^α + λ₂^α + λ₃^α − 3) of an Ogden solid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct OgdenTerm {
    /// μ, Pa.
    pub mu: f64,
    /// The exponent α, not zero.
    pub alpha: f64,
}

/// Σ μ/α (e^(α x) − 1 − α x), of terms in place so that laws are `Copy`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Series {
    terms: [OgdenTerm; CAPACITY],
    count: usize,
}

impl Series {
    fn new(law: &'static str, given: &[OgdenTerm]) -> Result<Self, ConstitutiveError> {
        let count = given.len();
        check_bound(law, "terms", count as f64, "1 ≤ number of terms ≤ 8", (1..=CAPACITY).contains(&count))?;
        for term in given {
            check_finite(law, "mu", term.mu)?;
            check_bound(law, "alpha", term.alpha, "alpha ≠ 0", 0.0 < term.alpha.abs())?;
        }
        let mut terms = [OgdenTerm::default(); CAPACITY];
        terms[..count].copy_from_slice(given);
        let series = Self { terms, count };
        let modulus = series.shear_modulus();
        check_bound(law, "½ Σ mu alpha", modulus, "0 < ½ Σ mu alpha", 0.0 < modulus)?;
        Ok(series)
    }

    fn terms(&self) -> &[OgdenTerm] {
        &self.terms[..self.count]
    }

    fn shear_modulus(&self) -> f64 {
        0.5 * self.terms().iter().map(|term| term.mu * term.alpha).sum::<f64>()
    }

    #[inline(always)]
    fn sum<T: Real>(&self, term: impl Fn(f64, f64) -> T) -> T {
        let mut sum = T::zero();
        for OgdenTerm { mu, alpha } in self.terms() {
            sum += term(*mu, *alpha);
        }
        sum
    }

    #[inline(always)]
    fn part<T: Real>(&self, x: T) -> T {
        self.sum(|mu, alpha| T::lit(mu / alpha) * excess_of_exponential(T::lit(alpha) * x))
    }

    #[inline(always)]
    fn slope<T: Real>(&self, x: T) -> T {
        self.sum(|mu, alpha| T::lit(mu) * (T::lit(alpha) * x).exp_m1())
    }

    #[inline(always)]
    fn curvature<T: Real>(&self, x: T) -> T {
        self.sum(|mu, alpha| T::lit(mu * alpha) * (T::lit(alpha) * x).exp())
    }

    #[inline(always)]
    fn secant<T: Real>(&self, x: T, y: T) -> T {
        self.sum(|mu, alpha| {
            let alpha_over_scalar = T::lit(alpha);
            let (x, y) = (alpha_over_scalar * x, alpha_over_scalar * y);
            T::lit(mu * alpha) * Exponential.divided_difference(x, y)
        })
    }
}

/// Ogden's compressible solid, with ln J.
///
/// ```text
/// W = Σₚ μₚ/αₚ (λ₁^αₚ + λ₂^αₚ + λ₃^αₚ − 3) − (Σₚ μₚ) ln J + ½ λ (ln J)²
/// τ = Σₚ μₚ (V^αₚ − 1) + λ ln J 1
/// ```
/// The shear modulus is ½ Σ μₚ αₚ, the bulk modulus λ + ⅓ Σ μₚ αₚ.
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | μₚ, αₚ | `terms`, 1 to 8 of them | Pa, – | αₚ ≠ 0, 0 < ½ Σ μₚ αₚ |
/// | λ | `lambda` | Pa | 0 < λ + ⅓ Σ μₚ αₚ |
///
/// Terms with 0 < μₚ αₚ each make the law stable in the sense of Baker and Ericksen; others may.
///
/// # Accuracy
/// Stresses relative 1e-13 down to ∇u = 1e-16, tangents a few ulp of their norm, for equal and nearly equal stretches too.
///
/// # Example
/// ```
/// use piola_constitutive::solids::{Hyperelastic, Ogden, OgdenTerm};
/// use piola_continuum::DeformationGradient;
/// let law = Ogden::new(&[OgdenTerm { mu: 1.0, alpha: 2.0 }], 0.0)?;
/// let bar = DeformationGradient::diagonal([2.0, 1.0, 1.0])?;
/// assert!((law.kirchhoff(&bar).0.components[0] - 3.0_f64).abs() < 4e-15); // μ (λ² − 1)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// R. W. Ogden, Proc. R. Soc. Lond. A 328 (1972) 567–583.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written", into = "Written"))]
pub struct Ogden {
    series: Series,
    lambda: f64,
}

impl Ogden {
    /// From the terms and Lamé's λ.
    ///
    /// # Errors
    /// [`ConstitutiveError::NotFinite`], [`ConstitutiveError::OutOfBounds`].
    pub fn new(terms: &[OgdenTerm], lambda: f64) -> Result<Self, ConstitutiveError> {
        let series = Series::new("Ogden", terms)?;
        let bulk = lambda + 2.0 / 3.0 * series.shear_modulus();
        check_bound("Ogden", "lambda", lambda, "0 < lambda + ⅓ Σ mu alpha", 0.0 < bulk)?;
        Ok(Self { series, lambda })
    }

    /// The terms.
    #[must_use]
    pub fn terms(&self) -> &[OgdenTerm] {
        self.series.terms()
    }

    /// λ, Pa.
    #[must_use]
    pub const fn lambda(&self) -> f64 {
        self.lambda
    }

    /// The shear modulus ½ Σ μₚ αₚ, Pa.
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        self.series.shear_modulus()
    }
}

/// Ogden's solid split into isochoric and volumetric parts, λ̄ₐ = J^(−1/3) λₐ.
///
/// ```text
/// W = Σₚ μₚ/αₚ (λ̄₁^αₚ + λ̄₂^αₚ + λ̄₃^αₚ − 3) + ½ κ (J − 1)²
/// τ = dev Σₚ μₚ V̄^αₚ + κ J (J − 1) 1
/// ```
/// The shear modulus is ½ Σ μₚ αₚ. With κ = 0 it is what the incompressible Ogden solid has beside its pressure.
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | μₚ, αₚ | `terms`, 1 to 8 of them | Pa, – | αₚ ≠ 0, 0 < ½ Σ μₚ αₚ |
/// | κ | `kappa` | Pa | 0 ≤ κ (the bulk modulus) |
///
/// # Accuracy
/// Stresses relative 1e-13 down to ∇u = 1e-16, tangents a few ulp of their norm, for equal and nearly equal stretches too.
/// The isochoric part of a mere change of volume is rounding of the shear modulus × the strain.
///
/// # Example
/// ```
/// use piola_constitutive::solids::{Hyperelastic, IsochoricOgden, OgdenTerm};
/// use piola_continuum::DeformationGradient;
/// let law = IsochoricOgden::new(&[OgdenTerm { mu: 1.0, alpha: 2.0 }], 10.0)?;
/// let ball = DeformationGradient::dilatation(2.0)?;
/// assert!((law.cauchy(&ball).0.components[0] - 70.0_f64).abs() < 1e-13); // κ (J − 1), J = 8
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// R. W. Ogden, Proc. R. Soc. Lond. A 328 (1972) 567–583; J. C. Simo and R. L. Taylor, Comput. Meth. Appl. Mech. Eng. 85
/// (1991) 273–310.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "WrittenIsochoric", into = "WrittenIsochoric"))]
pub struct IsochoricOgden {
    series: Series,
    kappa: f64,
}

impl IsochoricOgden {
    /// From the terms and the bulk modulus.
    ///
    /// # Errors
    /// [`ConstitutiveError::NotFinite`], [`ConstitutiveError::OutOfBounds`].
    pub fn new(terms: &[OgdenTerm], kappa: f64) -> Result<Self, ConstitutiveError> {
        let series = Series::new("isochoric Ogden", terms)?;
        check_bound("isochoric Ogden", "kappa", kappa, "0 ≤ kappa", 0.0 <= kappa)?;
        Ok(Self { series, kappa })
    }

    /// The terms.
    #[must_use]
    pub fn terms(&self) -> &[OgdenTerm] {
        self.series.terms()
    }

    /// κ, Pa.
    #[must_use]
    pub const fn kappa(&self) -> f64 {
        self.kappa
    }

    /// The shear modulus ½ Σ μₚ αₚ, Pa.
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        self.series.shear_modulus()
    }
}

/// w and its derivatives are those of the series.
macro_rules! parts_of_series {
    () => {
        #[inline(always)]
        fn part<T: Real>(&self, x: T) -> T {
            self.series.part(x)
        }
        #[inline(always)]
        fn slope<T: Real>(&self, x: T) -> T {
            self.series.slope(x)
        }
        #[inline(always)]
        fn curvature<T: Real>(&self, x: T) -> T {
            self.series.curvature(x)
        }
        #[inline(always)]
        fn secant<T: Real>(&self, x: T, y: T) -> T {
            self.series.secant(x, y)
        }
    };
}

impl StretchEnergy for Ogden {
    const ISOCHORIC: bool = false;
    parts_of_series!();

    #[inline(always)]
    fn volume_energy<T: Real>(&self, volume: &Volume<T>) -> T {
        T::lit(0.5 * self.lambda) * (volume.logarithm * volume.logarithm)
    }
    #[inline(always)]
    fn volume_slope<T: Real>(&self, volume: &Volume<T>) -> T {
        T::lit(self.lambda) * volume.logarithm
    }
    #[inline(always)]
    fn volume_curvature<T: Real>(&self, _volume: &Volume<T>) -> T {
        T::lit(self.lambda)
    }
}

impl StretchEnergy for IsochoricOgden {
    const ISOCHORIC: bool = true;
    parts_of_series!();

    #[inline(always)]
    fn volume_energy<T: Real>(&self, volume: &Volume<T>) -> T {
        T::lit(0.5 * self.kappa) * (volume.change * volume.change)
    }
    #[inline(always)]
    fn volume_slope<T: Real>(&self, volume: &Volume<T>) -> T {
        T::lit(self.kappa) * (volume.jacobian * volume.change)
    }
    #[inline(always)]
    fn volume_curvature<T: Real>(&self, volume: &Volume<T>) -> T {
        T::lit(self.kappa) * (volume.jacobian * (volume.jacobian + volume.change))
    }
}

hyperelastic_of_stretches!(Ogden);
hyperelastic_of_stretches!(IsochoricOgden);

/// The parameters as they are written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    terms: Vec<OgdenTerm>,
    lambda: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for Ogden {
    type Error = ConstitutiveError;

    fn try_from(Written { terms, lambda }: Written) -> Result<Self, ConstitutiveError> {
        Self::new(&terms, lambda)
    }
}

#[cfg(feature = "serde")]
impl From<Ogden> for Written {
    fn from(law: Ogden) -> Self {
        Self { terms: law.terms().to_vec(), lambda: law.lambda }
    }
}

/// The parameters as they are written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenIsochoric {
    terms: Vec<OgdenTerm>,
    kappa: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<WrittenIsochoric> for IsochoricOgden {
    type Error = ConstitutiveError;

    fn try_from(WrittenIsochoric { terms, kappa }: WrittenIsochoric) -> Result<Self, ConstitutiveError> {
        Self::new(&terms, kappa)
    }
}

#[cfg(feature = "serde")]
impl From<IsochoricOgden> for WrittenIsochoric {
    fn from(law: IsochoricOgden) -> Self {
        Self { terms: law.terms().to_vec(), kappa: law.kappa }
    }
}
