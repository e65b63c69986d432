//! The hyperfoam law of Storåkers.

use piola_numerics::Real;
use piola_numerics::internal::excess_of_exponential;
use piola_solids::SolidsError;
use piola_solids::stretch::Volume;

use crate::EnergyOfStretches;
use crate::error::{check_bound, check_finite};

const LAW: &str = "hyperfoam";
/// The largest number of terms.
const CAPACITY: usize = 6;

/// One term 2 μ/α² (λ₁^α + λ₂^α + λ₃^α − 3 + (J^(−α β) − 1)/β) of a [`Hyperfoam`].
///
/// # Example
/// ```
/// use piola_laws::rubber::FoamTerm;
/// let term = FoamTerm { modulus: 2.0, exponent: 8.0, poisson_ratio: 0.25 };
/// assert_eq!(term.compressibility(), 0.5); // β = ν/(1 − 2 ν)
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct FoamTerm {
    /// μ, Pa.
    #[doc(alias = "mu")]
    #[cfg_attr(feature = "serde", serde(alias = "mu"))]
    pub modulus: f64,
    /// α, not zero.
    #[doc(alias = "alpha")]
    #[cfg_attr(feature = "serde", serde(alias = "alpha"))]
    pub exponent: f64,
    /// ν with β = ν/(1 − 2 ν), −1 < ν < ½.
    #[doc(alias = "nu")]
    #[cfg_attr(feature = "serde", serde(alias = "nu"))]
    pub poisson_ratio: f64,
}

impl FoamTerm {
    /// β = ν/(1 − 2 ν).
    #[must_use]
    pub fn compressibility(&self) -> f64 {
        self.poisson_ratio / (1.0 - 2.0 * self.poisson_ratio)
    }
}

/// The hyperfoam law of Storåkers for compressible foams; [`OfStretches`](crate::OfStretches) makes the law of it.
///
/// ```text
/// W = Σ 2 μᵢ/αᵢ² (λ₁^αᵢ + λ₂^αᵢ + λ₃^αᵢ − 3 + (J^(−αᵢ βᵢ) − 1)/βᵢ)      βᵢ = νᵢ/(1 − 2 νᵢ)
/// principal stresses:  λₐ Pₐ = Σ 2 μᵢ/αᵢ (λₐ^αᵢ − J^(−αᵢ βᵢ))
/// ```
/// The moduli of the reference are Σ μᵢ (shear) and Σ 2 μᵢ (⅓ + βᵢ) (bulk). If all νᵢ are ν, a bar has the lateral stretch λ^(−ν).
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | μᵢ, αᵢ, νᵢ | `terms`, 1 to 6 of them | Pa, 1, 1 | αᵢ ≠ 0, −1 < νᵢ < ½, 0 < Σ μᵢ, 0 < Σ 2 μᵢ (⅓ + βᵢ) |
///
/// # Accuracy
/// Stresses a few ulp of the terms, for small strain too.
///
/// # Example
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_laws::OfStretches;
/// use piola_laws::rubber::{FoamTerm, Hyperfoam};
/// use piola_solids::Hyperelastic;
/// let foam = OfStretches(Hyperfoam::new(&[FoamTerm { modulus: 2.0, exponent: 2.0, poisson_ratio: 0.0 }])?);
/// // ν = 0: the sides of a bar stay, and P = (2 μ/α)(λ^α − 1)/λ.
/// let pressed = foam.first_piola(&DeformationGradient::diagonal([0.5, 1.0, 1.0])?).0;
/// assert!((pressed[(0, 0)] + 3.0_f64).abs() < 1e-15 && pressed[(1, 1)].abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// B. Storåkers, J. Mech. Phys. Solids 34 (1986) 125–145.
#[doc(alias("Ogden–Hill", "Storakers", "hyperelastic foam"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written", into = "Written"))]
pub struct Hyperfoam {
    terms: [FoamTerm; CAPACITY],
    count: usize,
}

impl Hyperfoam {
    /// From its terms.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn new(given: &[FoamTerm]) -> Result<Self, SolidsError> {
        let count = given.len();
        check_bound(LAW, "terms", count as f64, "1 ≤ number of terms ≤ 6", (1..=CAPACITY).contains(&count))?;
        for FoamTerm { modulus, exponent, poisson_ratio: ratio } in given {
            check_finite(LAW, "modulus", *modulus)?;
            check_bound(LAW, "exponent", *exponent, "α ≠ 0", 0.0 < exponent.abs())?;
            check_bound(LAW, "poisson_ratio", *ratio, "−1 < ν < ½", -1.0 < *ratio && *ratio < 0.5)?;
        }
        let mut terms = [FoamTerm::default(); CAPACITY];
        terms[..count].copy_from_slice(given);
        let foam = Self { terms, count };
        let (shear, bulk) = (foam.shear_modulus(), foam.bulk_modulus());
        check_bound(LAW, "Σ μ", shear, "0 < Σ μ", 0.0 < shear)?;
        check_bound(LAW, "Σ 2 μ (⅓ + β)", bulk, "0 < Σ 2 μ (⅓ + β)", 0.0 < bulk)?;
        Ok(foam)
    }

    /// The terms.
    #[must_use]
    pub fn terms(&self) -> &[FoamTerm] {
        &self.terms[..self.count]
    }

    /// The shear modulus of the reference, Σ μᵢ, Pa.
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        self.terms().iter().map(|term| term.modulus).sum()
    }

    /// The bulk modulus of the reference, Σ 2 μᵢ (⅓ + βᵢ), Pa.
    #[must_use]
    pub fn bulk_modulus(&self) -> f64 {
        self.terms().iter().map(|term| 2.0 * term.modulus * (1.0 / 3.0 + term.compressibility())).sum()
    }
}

/// The energy of a term by μ, α and ν at the logarithms of the stretches, over any scalar: parameters may have derivatives too.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn hyperfoam_term<T: Real>([modulus, exponent, ratio]: [T; 3], [x, y, z]: [T; 3]) -> T {
    let factor = T::lit(2.0) * modulus / (exponent * exponent);
    let shapes = [x, y, z].map(|x| excess_of_exponential(exponent * x));
    factor * (shapes[0] + shapes[1] + shapes[2] + volume_part(exponent, ratio, x + y + z))
}

/// (e^(−α β θ) − 1 + α β θ)/β of θ = ln J, zero for ν = 0.
#[cfg_attr(not(debug_assertions), inline(always))]
fn volume_part<T: Real>(exponent: T, ratio: T, logarithm: T) -> T {
    // Near ν = 0 it is ½ β (α θ)², which a β that is no number of its own must not hide.
    let tiny = T::lit(1e-30);
    let beta = ratio / (T::one() - T::lit(2.0) * ratio);
    let apart = beta + T::select(beta.abs().less_than(tiny), tiny, T::zero());
    excess_of_exponential(-(exponent * apart * logarithm)) / apart
}

impl EnergyOfStretches for Hyperfoam {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn part<T: Real>(&self, logarithm: T) -> T {
        let mut sum = T::zero();
        for &FoamTerm { modulus, exponent, .. } in self.terms() {
            let factor = T::lit(2.0 * modulus / (exponent * exponent));
            sum += factor * excess_of_exponential(T::lit(exponent) * logarithm);
        }
        sum
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_energy<T: Real>(&self, volume: &Volume<T>) -> T {
        let mut sum = T::zero();
        for &FoamTerm { modulus, exponent, poisson_ratio } in self.terms() {
            let factor = T::lit(2.0 * modulus / (exponent * exponent));
            sum += factor * volume_part(T::lit(exponent), T::lit(poisson_ratio), volume.logarithm);
        }
        sum
    }
}

/// The terms as they are written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    terms: Vec<FoamTerm>,
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for Hyperfoam {
    type Error = SolidsError;

    fn try_from(written: Written) -> Result<Self, SolidsError> {
        Self::new(&written.terms)
    }
}

#[cfg(feature = "serde")]
impl From<Hyperfoam> for Written {
    fn from(foam: Hyperfoam) -> Self {
        Self { terms: foam.terms().to_vec() }
    }
}
