//! Any law of rubber or foam as one type, for programs that read which law it is.

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola};
use piola_numerics::Real;
use piola_solids::isochoric::Isochoric;
use piola_solids::{AnySolid, AnyVolumetric, Compressible, Hyperelastic, IncompressibleSolid, SolidsError};

use super::{Carroll, ExtendedTube, Hyperfoam, LopezPamies, VanDerWaals};
use crate::methods::answers;
use crate::{OfStretches, Sum};

/// Any energy of a change of shape of [this module](super) that depends on I₁ and I₂ alone, written with its name.
///
/// # Example
/// ```
/// use piola_laws::rubber::{LopezPamies, RubberShape};
/// use piola_solids::isochoric::Isochoric;
/// let shape = RubberShape::from(LopezPamies::new(0.25, 0.5, 0.5, 3.0)?);
/// assert_eq!(shape.shear_modulus(), 0.75); // μ₁ + μ₂
/// # Ok::<(), piola_solids::SolidsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "law", rename_all = "snake_case"))]
#[non_exhaustive]
pub enum RubberShape {
    /// A (I₁ − 3) + B (I₁⁴ − 81) + C (√I₂ − √3).
    Carroll(Carroll),
    /// Two powers of I₁.
    LopezPamies(LopezPamies),
    /// Chains that end and attract each other.
    VanDerWaals(VanDerWaals),
}

macro_rules! of_shape {
    ($self:expr, $part:ident => $answer:expr) => {
        match $self {
            RubberShape::Carroll($part) => $answer,
            RubberShape::LopezPamies($part) => $answer,
            RubberShape::VanDerWaals($part) => $answer,
        }
    };
}

impl Isochoric for RubberShape {
    const SECOND: bool = true;
    const REFUSED_IS_NOT_FINITE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, first: T, second: T) -> T {
        of_shape!(self, part => part.energy(first, second))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, first: T, second: T) -> [T; 2] {
        of_shape!(self, part => part.slopes(first, second))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, first: T, second: T) -> [T; 3] {
        of_shape!(self, part => part.curvatures(first, second))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes_and_curvatures<T: Real>(&self, first: T, second: T) -> ([T; 2], [T; 3]) {
        of_shape!(self, part => part.slopes_and_curvatures(first, second))
    }
    fn check(&self, first: f64, second: f64) -> Result<(), SolidsError> {
        of_shape!(self, part => part.check(first, second))
    }
}

/// Any law of rubber or foam: those of [this module](super) and every [`AnySolid`], written with its name and its parameters by name.
///
/// | `law` | parameters |
/// |---|---|
/// | `rubber` | `shape`, a [`RubberShape`] with a `law` of its own, and `volumetric` unless it keeps its volume |
/// | `extended_tube` | `tube`, an [`ExtendedTube`], and `volumetric` unless it keeps its volume |
/// | `hyperfoam` | `terms`, see [`Hyperfoam`] |
/// | any other | those of [`AnySolid`] |
///
/// # Example
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_laws::rubber::{AnyRubber, Carroll};
/// use piola_solids::Hyperelastic;
/// use piola_solids::volumetric::SimoTaylor;
/// let rubber = AnyRubber::of_shape(Carroll::new(0.5, 0.0, 0.0)?, Some(SimoTaylor::new(100.0)?.into()))?;
/// let shear: f64 = rubber.cauchy(&DeformationGradient::simple_shear(0.5)?).0.components[3];
/// assert!((shear - 0.5).abs() < 1e-15 && !rubber.is_incompressible()); // 2 A k
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(tag = "law", rename_all = "snake_case"))]
#[non_exhaustive]
pub enum AnyRubber {
    /// An energy of I₁ and I₂.
    Rubber {
        /// W.
        shape: RubberShape,
        /// U; none if the body keeps its volume.
        volumetric: Option<AnyVolumetric>,
    },
    /// Cross-links and tubes.
    ExtendedTube {
        /// W.
        tube: ExtendedTube,
        /// U; none if the body keeps its volume.
        volumetric: Option<AnyVolumetric>,
    },
    /// Foam.
    Hyperfoam(Hyperfoam),
    /// A built-in law.
    #[cfg_attr(feature = "serde", serde(untagged))]
    Solid(AnySolid),
}

impl AnyRubber {
    /// A body of an energy of I₁ and I₂, that keeps its volume unless it has an energy of it.
    ///
    /// # Errors
    /// [`SolidsError::OutOfBounds`] where the bulk modulus U″(1) is negative.
    pub fn of_shape(shape: impl Into<RubberShape>, volumetric: Option<AnyVolumetric>) -> Result<Self, SolidsError> {
        let shape = shape.into();
        if let Some(volumetric) = volumetric {
            Compressible::checked(shape, volumetric)?;
        }
        Ok(Self::Rubber { shape, volumetric })
    }

    /// A body of an extended tube, that keeps its volume unless it has an energy of it.
    ///
    /// # Errors
    /// [`SolidsError::OutOfBounds`] where the bulk modulus U″(1) is negative.
    pub fn of_tube(tube: ExtendedTube, volumetric: Option<AnyVolumetric>) -> Result<Self, SolidsError> {
        if let Some(volumetric) = volumetric {
            tube.compressible(volumetric)?;
        }
        Ok(Self::ExtendedTube { tube, volumetric })
    }

    /// The built-in law, if it is one.
    #[must_use]
    pub const fn solid(&self) -> Option<&AnySolid> {
        if let Self::Solid(solid) = self { Some(solid) } else { None }
    }
}

impl From<Carroll> for RubberShape {
    fn from(part: Carroll) -> Self {
        Self::Carroll(part)
    }
}

impl From<LopezPamies> for RubberShape {
    fn from(part: LopezPamies) -> Self {
        Self::LopezPamies(part)
    }
}

impl From<VanDerWaals> for RubberShape {
    fn from(part: VanDerWaals) -> Self {
        Self::VanDerWaals(part)
    }
}

impl<S: Into<AnySolid>> From<S> for AnyRubber {
    fn from(solid: S) -> Self {
        Self::Solid(solid.into())
    }
}

impl From<Hyperfoam> for AnyRubber {
    fn from(foam: Hyperfoam) -> Self {
        Self::Hyperfoam(foam)
    }
}

/// `answer` for the law, its type known.
macro_rules! of_law {
    ($self:expr, $law:ident => $answer:expr) => {
        match $self {
            AnyRubber::Rubber { shape, volumetric: None } => {
                let $law = &IncompressibleSolid::new(*shape);
                $answer
            }
            AnyRubber::Rubber { shape, volumetric: Some(volumetric) } => {
                let $law = &Compressible::unchecked(*shape, *volumetric);
                $answer
            }
            AnyRubber::ExtendedTube { tube, volumetric: None } => {
                let $law = &tube.incompressible();
                $answer
            }
            AnyRubber::ExtendedTube { tube, volumetric: Some(volumetric) } => {
                let $law = &tube.unchecked(*volumetric);
                $answer
            }
            AnyRubber::Hyperfoam(foam) => {
                let $law = &OfStretches(*foam);
                $answer
            }
            AnyRubber::Solid($law) => $answer,
        }
    };
}

impl Hyperelastic for AnyRubber {
    fn reference_energy(&self) -> f64 {
        of_law!(self, law => law.reference_energy())
    }

    fn is_incompressible(&self) -> bool {
        of_law!(self, law => law.is_incompressible())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_derivative<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
        direction: &Matrix3<T>,
    ) -> FirstPiola<T> {
        of_law!(self, law => law.first_piola_derivative(deformation, direction))
    }

    answers! { |self, deformation|
        energy -> T { of_law!(self, law => law.energy(deformation)) }
        check -> Result<(), SolidsError> { of_law!(self, law => law.check(deformation)) }
        first_piola -> FirstPiola<T> { of_law!(self, law => law.first_piola(deformation)) }
        energy_and_first_piola -> (T, FirstPiola<T>) { of_law!(self, law => law.energy_and_first_piola(deformation)) }
        energy_first_piola_and_tangent -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
            of_law!(self, law => law.energy_first_piola_and_tangent(deformation))
        }
        second_piola -> SecondPiola<T> { of_law!(self, law => law.second_piola(deformation)) }
        kirchhoff -> KirchhoffStress<T> { of_law!(self, law => law.kirchhoff(deformation)) }
        cauchy -> CauchyStress<T> { of_law!(self, law => law.cauchy(deformation)) }
        first_piola_tangent -> FirstPiolaTangent<T> { of_law!(self, law => law.first_piola_tangent(deformation)) }
        first_piola_and_tangent -> (FirstPiola<T>, FirstPiolaTangent<T>) {
            of_law!(self, law => law.first_piola_and_tangent(deformation))
        }
        material_tangent -> MaterialTangent<T> { of_law!(self, law => law.material_tangent(deformation)) }
        truesdell_tangent -> TruesdellTangent<T> { of_law!(self, law => law.truesdell_tangent(deformation)) }
        second_piola_and_tangent -> (SecondPiola<T>, MaterialTangent<T>) {
            of_law!(self, law => law.second_piola_and_tangent(deformation))
        }
        cauchy_and_tangent -> (CauchyStress<T>, TruesdellTangent<T>) {
            of_law!(self, law => law.cauchy_and_tangent(deformation))
        }
    }
}

impl ExtendedTube {
    /// The law with an energy of the volume whose bulk modulus was checked.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn unchecked(
        &self,
        volumetric: AnyVolumetric,
    ) -> Sum<Compressible<super::CrosslinkedNetwork, AnyVolumetric>, OfStretches<super::EntanglementTube<true>>> {
        Sum(Compressible::unchecked(self.network(), volumetric), OfStretches(self.tube()))
    }
}

/// A law as it is written: its name tells how the rest is read, so that a refusal names the parameter and its bound.
#[cfg(feature = "serde")]
mod written {
    use serde::de::Error as _;
    use serde::{Deserialize, Deserializer};
    use serde_json::Value;

    use super::{AnyRubber, AnySolid, AnyVolumetric, ExtendedTube, Hyperfoam, RubberShape};

    /// The laws of this module.
    #[derive(Deserialize)]
    #[serde(tag = "law", rename_all = "snake_case", deny_unknown_fields)]
    enum Own {
        Rubber {
            shape: RubberShape,
            #[serde(default)]
            volumetric: Option<AnyVolumetric>,
        },
        ExtendedTube {
            tube: ExtendedTube,
            #[serde(default)]
            volumetric: Option<AnyVolumetric>,
        },
        Hyperfoam(Hyperfoam),
    }

    /// Their names.
    const NAMES: [&str; 3] = ["rubber", "extended_tube", "hyperfoam"];

    impl<'de> Deserialize<'de> for AnyRubber {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            let written = Value::deserialize(deserializer)?;
            let law = written.get("law").and_then(Value::as_str).unwrap_or_default().to_owned();
            if !NAMES.contains(&law.as_str()) {
                let solid: Result<AnySolid, _> = serde_json::from_value(written);
                return solid.map(Self::Solid).map_err(|error| {
                    let message = error.to_string();
                    // A name that is not known: those of this module are valid, too.
                    let is_unknown = message.starts_with(&format!("unknown variant `{law}`"));
                    let own = if is_unknown {
                        format!(", {}", NAMES.map(|name| format!("`{name}`")).join(", "))
                    } else {
                        String::new()
                    };
                    D::Error::custom(message + &own)
                });
            }
            match serde_json::from_value(written).map_err(D::Error::custom)? {
                Own::Rubber { shape, volumetric } => Self::of_shape(shape, volumetric).map_err(D::Error::custom),
                Own::ExtendedTube { tube, volumetric } => Self::of_tube(tube, volumetric).map_err(D::Error::custom),
                Own::Hyperfoam(foam) => Ok(foam.into()),
            }
        }
    }
}
