//! Any of the built-in laws as one type, for programs that read which law it is.

use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola};
use piola_numerics::Real;

use super::isochoric::Isochoric;
use super::volumetric::Volumetric;
use super::{
    AnisotropicLinear, AnisotropicSaintVenantKirchhoff, BlatzKo, Compressible, Fung, Hencky, HolzapfelGasserOgden,
    Hyperelastic, IncompressibleOgden, IncompressibleSolid, IsochoricOgden, LinearElastic, MooneyRivlin, NeoHookean,
    Ogden, Polynomial, ReinforcedNeoHookean, SaintVenantKirchhoff,
};
use crate::SolidsError;

mod isochoric;
mod volumetric;

pub use isochoric::AnyIsochoric;
pub use volumetric::AnyVolumetric;

/// Any of the built-in hyperelastic laws, written with its name and its parameters by name.
///
/// | `law` | type | parameters |
/// |---|---|---|
/// | `mooney_rivlin` | [`MooneyRivlin`] | `c10`, `c01`, `square_coefficient`, and `logarithm_coefficient` unless the reference is free of stress |
/// | `neo_hookean` | [`NeoHookean`] | `shear_modulus`, `volumetric` |
/// | `compressible` | [`Compressible`] | `isochoric`, `volumetric` |
/// | `incompressible` | [`IncompressibleSolid`] | `isochoric`, and `pressure` unless it is that of a body at rest |
/// | `polynomial` | [`Polynomial`] | `terms` |
/// | `blatz_ko` | [`BlatzKo`] | `shear_modulus`, `poisson_ratio`, `solid_fraction` |
/// | `saint_venant_kirchhoff` | [`SaintVenantKirchhoff`] | `first_lame_parameter`, `shear_modulus` |
/// | `linear_elastic` | [`LinearElastic`] | `shear_modulus`, `first_lame_parameter` |
/// | `ogden`, `isochoric_ogden` | [`Ogden`], [`IsochoricOgden`] | `terms`, `volumetric` |
/// | `incompressible_ogden` | [`IncompressibleOgden`] | `terms`, and `pressure` unless it is that of a body at rest |
/// | `hencky` | [`Hencky`] | `shear_modulus`, `volumetric` |
/// | `fung` | [`Fung`] | `modulus`, `exponents` |
/// | `holzapfel_gasser_ogden` | [`HolzapfelGasserOgden`] | `shear_modulus`, `bulk_modulus`, `fibre_modulus`, `fibre_exponent`, `dispersion`, `fibres` |
/// | `reinforced_neo_hookean` | [`ReinforcedNeoHookean`] | `shear_modulus`, `first_lame_parameter`, `fibre_modulus`, `fibre` |
/// | `anisotropic_linear` | [`AnisotropicLinear`] | `stiffness` |
/// | `anisotropic_saint_venant_kirchhoff` | [`AnisotropicSaintVenantKirchhoff`] | `stiffness` |
///
/// `isochoric` is an [`AnyIsochoric`], `volumetric` an [`AnyVolumetric`], each with a `law` of its own. What is read is
/// validated as by the constructors, and names that a law does not have are refused.
///
/// A call chooses the law once (a law of shape and volume: the volume once more for each scalar function of J) and then
/// runs the law's own kernel. At many points of one law [`visit`](Self::visit) chooses once for all of them, which also
/// compiles faster over lanes.
///
/// # Example
/// ```
/// # #[cfg(feature = "serde")]
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// use piola_solids::{AnySolid, Hyperelastic};
/// use piola_continuum::DeformationGradient;
/// let rubber: AnySolid = toml::from_str(r#"
///     law = "compressible"
///     isochoric = { law = "mooney_rivlin", c10 = 0.5, c01 = 0.25 }
///     volumetric = { law = "simo_taylor", bulk_modulus = 100.0 }
/// "#)?;
/// let shear = DeformationGradient::simple_shear(0.5)?;
/// let stress: f64 = rubber.cauchy(&shear).0.components[3];
/// assert!((stress - 0.75).abs() < 1e-15); // 2 (C₁₀ + C₀₁) k
/// let wrong = toml::from_str::<AnySolid>(r#"law = "blatz_ko"
///     shear_modulus = 1.0
///     poisson_ratio = 0.75
///     solid_fraction = 0.0"#);
/// assert!(wrong.unwrap_err().to_string().contains("poisson_ratio = 7.5e-1 violates 0 ≤ ν < ½"));
/// # Ok(())
/// # }
/// # #[cfg(not(feature = "serde"))]
/// # fn main() {}
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "law", rename_all = "snake_case"))]
#[non_exhaustive]
pub enum AnySolid {
    /// C₁₀ (I₁ − 3) + C₀₁ (I₂ − 3) + c J² − d ln J.
    MooneyRivlin(MooneyRivlin),
    /// ½ μ (I₁ − 3) − μ ln J + U(J).
    NeoHookean(NeoHookean<AnyVolumetric>),
    /// W̄(Ī₁, Ī₂) + U(J).
    Compressible(Compressible<AnyIsochoric, AnyVolumetric>),
    /// W(I₁, I₂) of a body that keeps its volume.
    Incompressible(IncompressibleSolid<AnyIsochoric>),
    /// A polynomial of the invariants.
    #[cfg_attr(feature = "serde", serde(with = "terms"))]
    Polynomial(Polynomial),
    /// Foamed and solid rubber.
    BlatzKo(BlatzKo),
    /// Hooke's law between E and S.
    SaintVenantKirchhoff(SaintVenantKirchhoff),
    /// Hooke's law.
    LinearElastic(LinearElastic),
    /// Powers of the stretches, with ln J.
    Ogden(Ogden<AnyVolumetric>),
    /// Powers of the stretches of the change of shape.
    IsochoricOgden(IsochoricOgden<AnyVolumetric>),
    /// Powers of the stretches of a body that keeps its volume.
    IncompressibleOgden(IncompressibleOgden),
    /// Hooke's law of the logarithmic strain.
    Hencky(Hencky<AnyVolumetric>),
    /// An exponential of a quadratic form of E.
    Fung(Fung),
    /// Two families of dispersed fibres in a soft matrix.
    HolzapfelGasserOgden(HolzapfelGasserOgden),
    /// One family of fibres in a neo-Hookean matrix.
    ReinforcedNeoHookean(ReinforcedNeoHookean),
    /// Linear elasticity of any symmetry.
    AnisotropicLinear(AnisotropicLinear),
    /// Hooke's law of any symmetry between E and S.
    AnisotropicSaintVenantKirchhoff(AnisotropicSaintVenantKirchhoff),
}

/// A computation with the law of an [`AnySolid`], its type known.
///
/// # Example
/// The energy of many points: the law is chosen once. A [batch](crate::batch) goes into a visitor in the same way.
/// ```
/// use piola_solids::{AnySolid, Hyperelastic, SaintVenantKirchhoff, SolidVisitor};
/// use piola_continuum::DeformationGradient;
/// struct Energy<'a>(&'a [DeformationGradient]);
/// impl SolidVisitor for Energy<'_> {
///     type Output = f64;
///     fn visit<L: Hyperelastic + Sync>(self, law: &L) -> f64 {
///         self.0.iter().map(|deformation| law.energy(deformation)).sum()
///     }
/// }
/// let bars = [DeformationGradient::diagonal([2.0, 1.0, 1.0])?; 100];
/// let solid = AnySolid::from(SaintVenantKirchhoff::new(1.0, 2.0)?);
/// assert_eq!(solid.visit(Energy(&bars)), 562.5); // 100 · ½ (λ + 2 μ) E₁₁²
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait SolidVisitor {
    /// The result.
    type Output;

    /// Computes with the law.
    fn visit<L: Hyperelastic + Sync>(self, law: &L) -> Self::Output;
}

/// `answer` for the law, its type known.
macro_rules! of_law {
    ($solid:expr, $law:ident => $answer:expr) => {
        match $solid {
            AnySolid::MooneyRivlin($law) => $answer,
            AnySolid::NeoHookean($law) => $answer,
            AnySolid::Compressible(Compressible { isochoric, volumetric }) => of_shape!(isochoric, shape => {
                let $law = &Compressible { isochoric: shape, volumetric };
                $answer
            }),
            AnySolid::Incompressible(solid) => of_shape!(&solid.isochoric, shape => {
                let $law = &IncompressibleSolid { isochoric: shape, pressure: solid.pressure };
                $answer
            }),
            AnySolid::Polynomial($law) => $answer,
            AnySolid::BlatzKo($law) => $answer,
            AnySolid::SaintVenantKirchhoff($law) => $answer,
            AnySolid::LinearElastic($law) => $answer,
            AnySolid::Ogden($law) => $answer,
            AnySolid::IsochoricOgden($law) => $answer,
            AnySolid::IncompressibleOgden($law) => $answer,
            AnySolid::Hencky($law) => $answer,
            AnySolid::Fung($law) => $answer,
            AnySolid::HolzapfelGasserOgden($law) => $answer,
            AnySolid::ReinforcedNeoHookean($law) => $answer,
            AnySolid::AnisotropicLinear($law) => $answer,
            AnySolid::AnisotropicSaintVenantKirchhoff($law) => $answer,
        }
    };
}

/// `answer` for the energy of a change of shape, its type known.
macro_rules! of_shape {
    ($part:expr, $shape:ident => $answer:expr) => {
        match $part {
            AnyIsochoric::NeoHookean($shape) => $answer,
            AnyIsochoric::MooneyRivlin($shape) => $answer,
            AnyIsochoric::Yeoh($shape) => $answer,
            AnyIsochoric::Rivlin($shape) => $answer,
            AnyIsochoric::Gent($shape) => $answer,
            AnyIsochoric::ArrudaBoyce($shape) => $answer,
            AnyIsochoric::ArrudaBoyceSeries($shape) => $answer,
        }
    };
}

impl AnySolid {
    /// Calls the visitor with the law, its type known: the choice is made once for all that the visitor does.
    ///
    /// # Example
    /// See [`SolidVisitor`].
    pub fn visit<V: SolidVisitor>(&self, visitor: V) -> V::Output {
        of_law!(self, law => visitor.visit(law))
    }
}

/// Tells scalars of one value from lanes: lanes stay in one function, which is compiled for the machine's registers.
struct Alone<T>(T);

impl<T: Real> Alone<T> {
    const IS: bool = T::LANES == 1;
}

/// Writes each answer by dispatch; for single values each law's kernel is a function of its own.
macro_rules! dispatched {
    ($($method:ident -> $answer:ty),+ $(,)?) => {
        impl Hyperelastic for AnySolid {
            $(
                #[cfg_attr(not(debug_assertions), inline(always))]
                fn $method<T: Real>(&self, deformation: &impl Deformation<T>) -> $answer {
                    if Alone::<T>::IS {
                        of_law!(self, law => single::$method(law, deformation))
                    } else {
                        of_law!(self, law => law.$method(deformation))
                    }
                }
            )+

            fn reference_energy(&self) -> f64 {
                of_law!(self, law => law.reference_energy())
            }

            fn is_incompressible(&self) -> bool {
                of_law!(self, law => law.is_incompressible())
            }
        }

        /// The answers of one law for single values, each compiled once.
        mod single {
            use super::{
                CauchyStress, SolidsError, Deformation, FirstPiola, FirstPiolaTangent, Hyperelastic,
                KirchhoffStress, MaterialTangent, Real, SecondPiola, TruesdellTangent,
            };

            $(
                #[inline(never)]
                pub(super) fn $method<T: Real, L: Hyperelastic>(law: &L, deformation: &impl Deformation<T>) -> $answer {
                    law.$method(deformation)
                }
            )+
        }
    };
}

dispatched! {
    energy -> T,
    check -> Result<(), SolidsError>,
    first_piola -> FirstPiola<T>,
    energy_and_first_piola -> (T, FirstPiola<T>),
    energy_first_piola_and_tangent -> (T, FirstPiola<T>, FirstPiolaTangent<T>),
    second_piola -> SecondPiola<T>,
    kirchhoff -> KirchhoffStress<T>,
    cauchy -> CauchyStress<T>,
    first_piola_tangent -> FirstPiolaTangent<T>,
    first_piola_and_tangent -> (FirstPiola<T>, FirstPiolaTangent<T>),
    material_tangent -> MaterialTangent<T>,
    truesdell_tangent -> TruesdellTangent<T>,
    second_piola_and_tangent -> (SecondPiola<T>, MaterialTangent<T>),
    cauchy_and_tangent -> (CauchyStress<T>, TruesdellTangent<T>),
}

macro_rules! from_laws {
    ($($law:ident),+ $(,)?) => { $(
        impl From<$law> for AnySolid {
            fn from(law: $law) -> Self {
                Self::$law(law)
            }
        }
    )+ };
}

from_laws!(
    MooneyRivlin,
    Polynomial,
    BlatzKo,
    SaintVenantKirchhoff,
    LinearElastic,
    IncompressibleOgden,
    Fung,
    HolzapfelGasserOgden,
    ReinforcedNeoHookean,
    AnisotropicLinear,
    AnisotropicSaintVenantKirchhoff,
);

impl<I: Isochoric + Into<AnyIsochoric>, U: Volumetric + Into<AnyVolumetric>> From<Compressible<I, U>> for AnySolid {
    fn from(Compressible { isochoric, volumetric }: Compressible<I, U>) -> Self {
        Self::Compressible(Compressible { isochoric: isochoric.into(), volumetric: volumetric.into() })
    }
}

impl<I: Isochoric + Into<AnyIsochoric>> From<IncompressibleSolid<I>> for AnySolid {
    fn from(IncompressibleSolid { isochoric, pressure }: IncompressibleSolid<I>) -> Self {
        Self::Incompressible(IncompressibleSolid { isochoric: isochoric.into(), pressure })
    }
}

macro_rules! from_laws_with_volume {
    ($($law:ident),+ $(,)?) => { $(
        impl<U: Volumetric + Into<AnyVolumetric>> From<$law<U>> for AnySolid {
            fn from(law: $law<U>) -> Self {
                Self::$law(law.map(Into::into))
            }
        }
    )+ };
}

from_laws_with_volume!(NeoHookean, Ogden, IsochoricOgden, Hencky);

/// A polynomial as it is written beside its name: a table with `terms`.
#[cfg(feature = "serde")]
mod terms {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::Polynomial;
    use crate::PolynomialTerm;

    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Written {
        terms: Vec<PolynomialTerm>,
    }

    pub(super) fn serialize<S: Serializer>(law: &Polynomial, serializer: S) -> Result<S::Ok, S::Error> {
        Written { terms: law.terms() }.serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Polynomial, D::Error> {
        Polynomial::try_from(Written::deserialize(deserializer)?.terms).map_err(serde::de::Error::custom)
    }
}
