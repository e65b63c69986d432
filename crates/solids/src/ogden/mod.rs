//! Ogden's solids: series of powers of the principal stretches.

use piola_continuum::Deformation;
use piola_numerics::Real;

use super::stretch::{StretchEnergy, Volume, hyperelastic_of_stretches};
use super::volumetric::{Lame, Quadratic, Volumetric};
use crate::SolidsError;
use crate::error::check_bound;

mod incompressible;
pub(crate) mod terms;

pub use incompressible::IncompressibleOgden;
pub use terms::OgdenTerm;
use terms::{Series, parts_of_series};

/// Ogden's compressible solid, with ln J and any energy of the change of volume.
///
/// ```text
/// W = Σₚ μₚ/αₚ (λ₁^αₚ + λ₂^αₚ + λ₃^αₚ − 3) − (Σₚ μₚ) ln J + U(J)        U = ½ λ (ln J)² unless another is chosen
/// τ = Σₚ μₚ (V^αₚ − 1) + J U′ 1
/// ```
/// The shear modulus is ½ Σ μₚ αₚ, the bulk modulus λ + ⅓ Σ μₚ αₚ with λ = U″(1).
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | μₚ, αₚ | `terms`, 1 to 8 of them | Pa, – | αₚ ≠ 0, 0 < ½ Σ μₚ αₚ |
/// | λ | `first_lame_parameter`, U″(1) of `volumetric` | Pa | 0 < λ + ⅓ Σ μₚ αₚ |
///
/// Terms with 0 < μₚ αₚ each make the law stable in the sense of Baker and Ericksen; others may.
///
/// # Accuracy
/// Stresses relative 1e-13 down to ∇u = 1e-16, tangents a few ulp of their norm, for equal and nearly equal stretches too.
///
/// # Example
/// ```
/// use piola_solids::{Hyperelastic, Ogden, OgdenTerm, volumetric::SimoTaylor};
/// use piola_continuum::DeformationGradient;
/// let terms = [OgdenTerm { modulus: 1.0, exponent: 2.0 }];
/// let bar = DeformationGradient::diagonal([2.0, 1.0, 1.0])?;
/// let law = Ogden::new(&terms, 0.0)?;
/// assert!((law.kirchhoff(&bar).0.components[0] - 3.0_f64).abs() < 4e-15); // μ (λ² − 1)
/// let stiffer = Ogden::with_volumetric(&terms, SimoTaylor::new(2.0)?)?;
/// assert!((stiffer.kirchhoff(&bar).0.components[1] - 3.0_f64).abs() < 4e-15); // ½ κ (J² − 1)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// R. W. Ogden, Proc. R. Soc. Lond. A 328 (1972) 567–583.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written<U>", into = "Written<U>"))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "U: Volumetric + Clone + serde::Serialize",
        deserialize = "U: Volumetric + serde::Deserialize<'de>"
    ))
)]
pub struct Ogden<U = Lame> {
    series: Series,
    volumetric: U,
}

impl Ogden {
    /// From the terms and Lamé's λ.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn new(terms: &[OgdenTerm], first_lame_parameter: f64) -> Result<Self, SolidsError> {
        let series = Series::new(LAW, terms)?;
        let lambda = first_lame_parameter;
        let bulk = lambda + 2.0 / 3.0 * series.shear_modulus();
        check_bound(LAW, "first_lame_parameter", lambda, "0 < λ + ⅓ Σ μ α", 0.0 < bulk)?;
        Ok(Self { series, volumetric: Lame::new(lambda)? })
    }

    /// λ, Pa.
    #[doc(alias = "lambda")]
    #[must_use]
    pub const fn first_lame_parameter(&self) -> f64 {
        self.volumetric.first_lame_parameter()
    }
}

const LAW: &str = "Ogden";

impl<U: Volumetric> Ogden<U> {
    /// From the terms and any U.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn with_volumetric(terms: &[OgdenTerm], volumetric: U) -> Result<Self, SolidsError> {
        let series = Series::new(LAW, terms)?;
        let lambda = volumetric.bulk_modulus();
        let bulk = lambda + 2.0 / 3.0 * series.shear_modulus();
        check_bound(LAW, "U″(1)", lambda, "0 < U″(1) + ⅓ Σ μ α", 0.0 < bulk)?;
        Ok(Self { series, volumetric })
    }
}

/// Ogden's solid split into isochoric and volumetric parts, λ̄ₐ = J^(−1/3) λₐ.
///
/// ```text
/// W = Σₚ μₚ/αₚ (λ̄₁^αₚ + λ̄₂^αₚ + λ̄₃^αₚ − 3) + U(J)        U = ½ κ (J − 1)² unless another is chosen
/// τ = dev Σₚ μₚ V̄^αₚ + J U′ 1
/// ```
/// The shear modulus is ½ Σ μₚ αₚ, the bulk modulus κ = U″(1).
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | μₚ, αₚ | `terms`, 1 to 8 of them | Pa, – | αₚ ≠ 0, 0 < ½ Σ μₚ αₚ |
/// | κ | `bulk_modulus`, U″(1) of `volumetric` | Pa | 0 ≤ κ (the bulk modulus) |
///
/// # Accuracy
/// Stresses relative 1e-13 down to ∇u = 1e-16, tangents a few ulp of their norm, for equal and nearly equal stretches too.
/// The isochoric part of a mere change of volume is rounding of the shear modulus × the strain.
///
/// # Example
/// ```
/// use piola_solids::{Hyperelastic, IsochoricOgden, OgdenTerm, volumetric::Miehe};
/// use piola_continuum::DeformationGradient;
/// let terms = [OgdenTerm { modulus: 1.0, exponent: 2.0 }];
/// let ball = DeformationGradient::dilatation(2.0)?;
/// let law = IsochoricOgden::new(&terms, 10.0)?;
/// assert!((law.cauchy(&ball).0.components[0] - 70.0_f64).abs() < 1e-13); // κ (J − 1), J = 8
/// let other = IsochoricOgden::with_volumetric(&terms, Miehe::new(8.0)?)?;
/// assert!((other.cauchy(&ball).0.components[0] - 7.0_f64).abs() < 1e-14); // κ (J − 1)/J
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// R. W. Ogden, Proc. R. Soc. Lond. A 328 (1972) 567–583; J. C. Simo and R. L. Taylor, Comput. Meth. Appl. Mech. Eng. 85
/// (1991) 273–310.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written<U>", into = "Written<U>"))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "U: Volumetric + Clone + serde::Serialize",
        deserialize = "U: Volumetric + serde::Deserialize<'de>"
    ))
)]
pub struct IsochoricOgden<U = Quadratic> {
    series: Series,
    volumetric: U,
}

const ISOCHORIC: &str = "isochoric Ogden";

impl IsochoricOgden {
    /// From the terms and the bulk modulus.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn new(terms: &[OgdenTerm], bulk_modulus: f64) -> Result<Self, SolidsError> {
        let series = Series::new(ISOCHORIC, terms)?;
        check_bound(ISOCHORIC, "bulk_modulus", bulk_modulus, "0 ≤ κ", 0.0 <= bulk_modulus)?;
        Ok(Self { series, volumetric: Quadratic::new(bulk_modulus)? })
    }

    /// κ, Pa.
    #[doc(alias = "kappa")]
    #[must_use]
    pub const fn bulk_modulus(&self) -> f64 {
        self.volumetric.bulk_modulus()
    }
}

impl<U: Volumetric> IsochoricOgden<U> {
    /// From the terms and any U.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn with_volumetric(terms: &[OgdenTerm], volumetric: U) -> Result<Self, SolidsError> {
        let series = Series::new(ISOCHORIC, terms)?;
        let kappa = volumetric.bulk_modulus();
        check_bound(ISOCHORIC, "U″(1)", kappa, "0 ≤ U″(1)", 0.0 <= kappa)?;
        Ok(Self { series, volumetric })
    }
}

/// Getters and closed forms of both laws.
macro_rules! ogden {
    ($law:ident, $name:ident, isochoric: $isochoric:literal) => {
        impl<U: Volumetric> $law<U> {
            /// The same with U in another form.
            pub(super) fn map<V>(self, volumetric: impl FnOnce(U) -> V) -> $law<V> {
                $law { series: self.series, volumetric: volumetric(self.volumetric) }
            }

            /// The terms.
            #[must_use]
            pub fn terms(&self) -> &[OgdenTerm] {
                self.series.terms()
            }

            /// U.
            #[must_use]
            pub const fn volumetric(&self) -> &U {
                &self.volumetric
            }

            /// The shear modulus ½ Σ μₚ αₚ, Pa.
            #[must_use]
            pub fn shear_modulus(&self) -> f64 {
                self.series.shear_modulus()
            }
        }

        impl<U: Volumetric> StretchEnergy for $law<U> {
            const ISOCHORIC: bool = $isochoric;
            parts_of_series!();

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
                self.series.check($name, deformation, $isochoric)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn volume_energy<T: Real>(&self, volume: &Volume<T>) -> T {
                self.volumetric.energy(volume.change, volume.jacobian)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn volume_slope<T: Real>(&self, volume: &Volume<T>) -> T {
                self.volumetric.mean_kirchhoff(volume.change, volume.jacobian)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn volume_curvature<T: Real>(&self, volume: &Volume<T>) -> T {
                self.volumetric.stiffness(volume.change, volume.jacobian)
            }
        }

        hyperelastic_of_stretches!([U: Volumetric] $law<U>);

        #[cfg(feature = "serde")]
        impl<U: Volumetric> TryFrom<Written<U>> for $law<U> {
            type Error = SolidsError;

            fn try_from(Written { terms, volumetric }: Written<U>) -> Result<Self, SolidsError> {
                Self::with_volumetric(&terms, volumetric)
            }
        }

        #[cfg(feature = "serde")]
        impl<U> From<$law<U>> for Written<U> {
            fn from($law { series, volumetric }: $law<U>) -> Self {
                Self { terms: series.terms().to_vec(), volumetric }
            }
        }
    };
}
ogden!(Ogden, LAW, isochoric: false);
ogden!(IsochoricOgden, ISOCHORIC, isochoric: true);

/// The parameters as they are written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written<U> {
    terms: Vec<OgdenTerm>,
    volumetric: U,
}
