//! A law with history that is chosen at run time: by scenes, fits and other languages.

use core::marker::PhantomData;

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{DeformationGradient, FirstPiola};
use piola_solids::{AnySolid, Hyperelastic};

use crate::{
    BergstromBoyce, ByTangent, DrivenGrowth, Effort, Evolution, GivenGrowth, InSeries, InelasticError, InelasticPoint,
    Kinematic, Mullins, ReeseGovindjee, StepControl, Thermal, Viscoplastic,
};

/// An elastic law of a law with history.
type Spring = ByTangent<AnySolid>;

/// Numbers of the longest state: those of `Kinematic`.
pub const MOST_STATE: usize = 19;

/// Stress and consistent tangent at the end of an increment of [`AnyInelastic`].
///
/// # Example
/// See [`AnyInelastic`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnyAdvanced {
    /// P, Pa.
    pub first_piola: FirstPiola,
    /// dP/dF, Pa, through all steps of the increment; without major symmetry in general.
    pub tangent: FirstPiolaTangent,
    /// Steps, iterations and the estimated error.
    pub effort: Effort,
}

macro_rules! laws {
    ($($(#[$about:meta])* $law:ident($type:ty), $name:literal, [$($part:ident: $kind:ident),+];)+) => {
        /// A law with history, its elastic parts any laws of [`AnySolid`].
        ///
        /// | `law` | type | internal variables |
        /// |---|---|---|
        /// | `bergstrom_boyce` | [`BergstromBoyce`] | 9: Fᵢ by rows |
        /// | `reese_govindjee` | [`ReeseGovindjee`] | 9: Fᵢ by rows |
        /// | `in_series` | [`InSeries`] | 9: Fᵢ by rows |
        /// | `viscoplastic` | [`Viscoplastic`] | 10: Fᵢ by rows, α |
        /// | `kinematic` | [`Kinematic`] | 19: Fᵢ by rows, α, Fₖ by rows |
        /// | `mullins` | [`Mullins`] | 1: the largest energy |
        /// | `driven_growth` | [`DrivenGrowth`] | 1: ϑ |
        /// | `given_growth` | [`GivenGrowth`] | 9: G by rows, written by the user |
        /// | `thermal` | [`Thermal`] | 1: θ, written by the user |
        ///
        /// Parts that flow must be isotropic, and all parts compressible laws of finite strain.
        ///
        /// # Errors
        /// What is read is refused by the constructors of the laws; [`InelasticError::WrongSpring`].
        ///
        /// # Example
        /// ```
        /// use piola_continuum::DeformationGradient;
        /// use piola_inelastic::{AnyInelastic, ByTangent, ReeseGovindjee, StepControl};
        /// use piola_solids::{AnySolid, NeoHookeanCiarlet};
        /// let spring = ByTangent(AnySolid::from(NeoHookeanCiarlet::with_constants(1.0, 2.0)?));
        /// let law = AnyInelastic::ReeseGovindjee(ReeseGovindjee::new(spring.clone(), spring, 0.5)?).checked()?;
        /// let mut state = [0.0; 9];
        /// law.initial_into(&mut state)?;
        /// let (still, shear) = (DeformationGradient::identity(), DeformationGradient::simple_shear(0.3)?);
        /// let control = StepControl::one_step();
        /// let fast = law.advance(&mut state, [&still, &shear], 1e-6, &control)?;
        /// assert!((fast.first_piola.0[(0, 1)] - 0.6).abs() < 1e-5); // 2 μ k
        /// let held = law.advance(&mut state, [&shear, &shear], 1e3, &control)?;
        /// assert!((held.first_piola.0[(0, 1)] - 0.3).abs() < 1e-3); // μ k
        /// # Ok::<(), Box<dyn std::error::Error>>(())
        /// ```
        #[derive(Clone, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(tag = "law", rename_all = "snake_case", try_from = "written::Any"))]
        #[non_exhaustive]
        pub enum AnyInelastic {
            $($(#[$about])* $law($type),)+
        }

        /// The law as it is read, its parts not yet checked.
        #[cfg(feature = "serde")]
        mod written {
            use super::*;

            #[derive(serde::Deserialize)]
            #[serde(tag = "law", rename_all = "snake_case")]
            pub(super) enum Any {
                $($law($type),)+
            }

            impl TryFrom<Any> for AnyInelastic {
                type Error = InelasticError;

                fn try_from(read: Any) -> Result<Self, InelasticError> {
                    match read {
                        $(Any::$law(law) => Self::$law(law).checked(),)+
                    }
                }
            }
        }

        impl AnyInelastic {
            /// The word for its law.
            #[must_use]
            pub const fn name(&self) -> &'static str {
                match self {
                    $(Self::$law(_) => $name,)+
                }
            }

            /// The same, if each elastic law can be what it is.
            ///
            /// # Errors
            /// [`InelasticError::WrongSpring`].
            pub fn checked(self) -> Result<Self, InelasticError> {
                self.check_parts()?;
                Ok(self)
            }

            /// Refuses an elastic law that cannot be what it is.
            fn check_parts(&self) -> Result<(), InelasticError> {
                match self {
                    $(Self::$law(law) => { $(check($name, stringify!($part), &law.$part.0, Part::$kind)?;)+ })+
                }
                Ok(())
            }

            /// The number of its internal variables.
            #[must_use]
            pub const fn state_length(&self) -> usize {
                match self {
                    $(Self::$law(law) => length(law),)+
                }
            }

            /// The number of internal variables of the law with this [`name`](Self::name); none where there is no such law.
            #[must_use]
            pub fn state_length_of(name: &str) -> Option<usize> {
                match name {
                    $($name => Some(length_of(PhantomData::<$type>)),)+
                    _ => None,
                }
            }

            /// Writes the internal variables of the body as it was made.
            ///
            /// # Errors
            /// [`InelasticError::WrongLength`].
            pub fn initial_into(&self, state: &mut [f64]) -> Result<(), InelasticError> {
                match self {
                    $(Self::$law(law) => copied(&law.initial(), state),)+
                }
            }

            /// Leads a point with this state from a deformation to another in the time `dt`, s: its new state in the place of the old one,
            /// stress and consistent tangent.
            ///
            /// # Errors
            /// [`InelasticError::WrongSpring`], as [`checked`](Self::checked); those of [`InelasticPoint::with_state`], and of [`InelasticPoint::advance`]: where the update fails on its way, the state is the
            /// last admissible one, and the error says at which share of the increment that lies.
            pub fn advance(
                &self,
                state: &mut [f64],
                [from, to]: [&DeformationGradient; 2],
                dt: f64,
                control: &StepControl,
            ) -> Result<AnyAdvanced, InelasticError> {
                self.check_parts()?;
                match self {
                    $(Self::$law(law) => advance(law, state, [from, to], dt, control),)+
                }
            }

            /// As [`advance`](Self::advance), but returns P, Pa, and the effort alone. It computes no derivatives of the state or of the stress.
            ///
            /// # Errors
            /// Those of [`advance`](Self::advance).
            ///
            /// # Example
            /// ```
            /// use piola_continuum::DeformationGradient;
            /// use piola_inelastic::{AnyInelastic, ByTangent, Mullins, StepControl};
            /// use piola_solids::{AnySolid, NeoHookeanCiarlet};
            /// let spring = ByTangent(AnySolid::from(NeoHookeanCiarlet::with_constants(1.0, 2.0)?));
            /// let law = AnyInelastic::Mullins(Mullins::new(spring, 2.0, 0.25, 0.0)?).checked()?;
            /// let (still, shear) = (DeformationGradient::identity(), DeformationGradient::simple_shear(0.3)?);
            /// let (stress, _) = law.advance_stress(&mut [0.0], [&still, &shear], 1.0, &StepControl::one_step())?;
            /// assert!((stress.0[(0, 1)] - 0.3).abs() < 1e-15); // μ k, first loading
            /// # Ok::<(), Box<dyn std::error::Error>>(())
            /// ```
            pub fn advance_stress(
                &self,
                state: &mut [f64],
                [from, to]: [&DeformationGradient; 2],
                dt: f64,
                control: &StepControl,
            ) -> Result<(FirstPiola, Effort), InelasticError> {
                self.check_parts()?;
                match self {
                    $(Self::$law(law) => advance_stress(law, state, [from, to], dt, control),)+
                }
            }
        }
    };
}

laws! {
    /// Rubber whose flow is a power of the stress.
    BergstromBoyce(BergstromBoyce<Spring, Spring>), "bergstrom_boyce", [equilibrium: Any, overstress: Flowing];
    /// Finite linear viscosity.
    ReeseGovindjee(ReeseGovindjee<Spring, Spring>), "reese_govindjee", [equilibrium: Any, overstress: Flowing];
    /// Two springs in series.
    InSeries(InSeries<Spring, Spring>), "in_series", [first: Flowing, second: Flowing];
    /// Von Mises plasticity with or without viscosity.
    Viscoplastic(Viscoplastic<Spring>), "viscoplastic", [elastic: Flowing];
    /// The same with a back stress.
    Kinematic(Kinematic<Spring, Spring>), "kinematic", [elastic: Flowing, back: Flowing];
    /// Stress softening.
    Mullins(Mullins<Spring>), "mullins", [elastic: Any];
    /// Growth that the stress drives.
    DrivenGrowth(DrivenGrowth<Spring>), "driven_growth", [elastic: Any];
    /// Growth that the user gives.
    GivenGrowth(GivenGrowth<Spring>), "given_growth", [elastic: Any];
    /// Thermal expansion at temperatures that the user gives.
    Thermal(Thermal<Spring>), "thermal", [elastic: Any];
}

/// What an elastic law is in a law with history.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    /// It stands beside what flows.
    Any,
    /// It flows.
    Flowing,
}

/// Refuses an elastic law that cannot be this part.
fn check(law: &'static str, part: &'static str, spring: &AnySolid, kind: Part) -> Result<(), InelasticError> {
    let is_linear = matches!(spring, AnySolid::LinearElastic(_) | AnySolid::AnisotropicLinear(_));
    let is_isotropic = matches!(
        spring,
        AnySolid::MooneyRivlin(_)
            | AnySolid::NeoHookean(_)
            | AnySolid::Compressible(_)
            | AnySolid::Polynomial(_)
            | AnySolid::BlatzKo(_)
            | AnySolid::SaintVenantKirchhoff(_)
            | AnySolid::Ogden(_)
            | AnySolid::IsochoricOgden(_)
            | AnySolid::Hencky(_)
    );
    let found = if spring.is_incompressible() {
        "incompressible"
    } else if is_linear {
        "linear elasticity"
    } else if kind == Part::Flowing && !is_isotropic {
        "anisotropic"
    } else {
        return Ok(());
    };
    let needed = match kind {
        Part::Any => "a compressible law of finite strain",
        Part::Flowing => "an isotropic, compressible law of finite strain",
    };
    Err(InelasticError::WrongSpring { law, part, found, needed })
}

const fn length_of<L: Evolution<S, X>, const S: usize, const X: usize>(_law: PhantomData<L>) -> usize {
    S
}

const fn length<L: Evolution<S, X>, const S: usize, const X: usize>(_law: &L) -> usize {
    S
}

fn copied(from: &[f64], to: &mut [f64]) -> Result<(), InelasticError> {
    let (expected, found) = (from.len(), to.len());
    if expected != found {
        return Err(InelasticError::WrongLength { quantity: "state", expected, found });
    }
    to.copy_from_slice(from);
    Ok(())
}

/// One function for each law.
#[inline(never)]
fn advance<L: Evolution<S, X>, const S: usize, const X: usize>(
    law: &L,
    state: &mut [f64],
    [from, to]: [&DeformationGradient; 2],
    dt: f64,
    control: &StepControl,
) -> Result<AnyAdvanced, InelasticError> {
    let mut point = InelasticPoint::with_state(law, state, from)?;
    let result = point.advance(to, dt, control);
    state.copy_from_slice(point.state());
    let advanced = result?;
    Ok(AnyAdvanced { first_piola: advanced.first_piola, tangent: advanced.tangent, effort: advanced.effort })
}

/// One function for each law.
#[inline(never)]
fn advance_stress<L: Evolution<S, X>, const S: usize, const X: usize>(
    law: &L,
    state: &mut [f64],
    [from, to]: [&DeformationGradient; 2],
    dt: f64,
    control: &StepControl,
) -> Result<(FirstPiola, Effort), InelasticError> {
    let mut point = InelasticPoint::with_state(law, state, from)?;
    let result = point.advance_stress(to, dt, control);
    state.copy_from_slice(point.state());
    result
}
