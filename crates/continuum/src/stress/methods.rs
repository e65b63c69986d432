//! The invariants as methods of the stresses that refer to space: Cauchy's and Kirchhoff's.
//!
//! Formulas, conventions and accuracies are those of [`invariants`]. Invariants of stresses
//! that refer to the reference configuration mean nothing to a yield criterion, so those types lack the methods;
//! the functions take any symmetric tensor.

use piola_numerics::Real;

use super::invariants::{self, HaighWestergaard};
use super::{CauchyStress, KirchhoffStress};
use crate::{ContinuumError, Symmetric};

/// The example of a bar pulled with 3 Pa, ending with a check.
macro_rules! example {
    ($name:ident, $check:literal) => {
        concat!(
            "```\nuse piola_continuum::{ContinuumError, ",
            stringify!($name),
            "};\nlet bar = ",
            stringify!($name),
            "::new(3.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;\n",
            $check,
            "\n# Ok::<(), ContinuumError>(())\n```"
        )
    };
}

macro_rules! invariants_of {
    ($name:ident) => {
        impl<T: Real> $name<T> {
            /// The mean stress ⅓ tr T, Pa: [`invariants::mean`].
            ///
            /// # Example
            #[doc = example!($name, "assert_eq!(bar.mean(), 1.0);")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn mean(&self) -> T {
                invariants::mean(&self.0)
            }

            /// The pressure p = −⅓ tr T, Pa, positive in compression.
            ///
            /// # Example
            #[doc = example!($name, "assert_eq!(bar.pressure(), -1.0); // a pulled bar")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn pressure(&self) -> T {
                -invariants::mean(&self.0)
            }

            /// The hydrostatic part ⅓ tr T 1, Pa: [`invariants::mean`].
            ///
            /// # Example
            #[doc = example!($name, "assert_eq!(bar.hydrostatic_part().0.components, [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn hydrostatic_part(&self) -> Self {
                let mean = invariants::mean(&self.0);
                Self(Symmetric::diagonal([mean, mean, mean]))
            }

            /// The deviator T − ⅓ tr T 1, Pa: [`invariants::deviator`].
            ///
            /// # Example
            #[doc = example!($name, "assert_eq!(bar.deviator().0.components, [2.0, -1.0, -1.0, 0.0, 0.0, 0.0]);")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn deviator(&self) -> Self {
                Self(invariants::deviator(&self.0))
            }

            /// (I₁, I₂, I₃): [`invariants::principal_invariants`].
            ///
            /// # Example
            #[doc = example!($name, "assert_eq!(bar.principal_invariants(), [3.0, 0.0, 0.0]);")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn principal_invariants(&self) -> [T; 3] {
                invariants::principal_invariants(&self.0)
            }

            /// J₂, Pa²: [`invariants::j2`].
            ///
            /// # Example
            #[doc = example!($name, "assert_eq!(bar.j2(), 3.0);")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn j2(&self) -> T {
                invariants::j2(&self.0)
            }

            /// J₃, Pa³: [`invariants::j3`].
            ///
            /// # Example
            #[doc = example!($name, "assert_eq!(bar.j3(), 2.0);")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn j3(&self) -> T {
                invariants::j3(&self.0)
            }

            /// Von Mises' stress √(3 J₂), Pa: [`invariants::von_mises`].
            ///
            /// # Example
            #[doc = example!($name, "assert_eq!(bar.von_mises(), 3.0);")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn von_mises(&self) -> T {
                invariants::von_mises(&self.0)
            }

            /// The octahedral shear stress √(⅔ J₂), Pa: [`invariants::octahedral_shear`].
            ///
            /// # Example
            #[doc = example!($name, "assert!((bar.octahedral_shear() - 2.0_f64.sqrt()).abs() < 1e-15);")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn octahedral_shear(&self) -> T {
                invariants::octahedral_shear(&self.0)
            }

            /// Tresca's stress σ₁ − σ₃, Pa: [`invariants::tresca`].
            ///
            /// # Example
            #[doc = example!($name, "assert!((bar.tresca() - 3.0_f64).abs() < 2e-15);")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn tresca(&self) -> T {
                invariants::tresca(&self.0)
            }

            /// The largest shear stress ½ (σ₁ − σ₃), Pa: [`invariants::maximum_shear`].
            ///
            /// # Example
            #[doc = example!($name, "assert!((bar.maximum_shear() - 1.5_f64).abs() < 1e-15);")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn maximum_shear(&self) -> T {
                invariants::maximum_shear(&self.0)
            }

            /// θ ∈ [0, π/3], from triaxial extension: [`invariants::lode_angle`].
            ///
            /// # Example
            #[doc = example!($name, "assert_eq!(bar.lode_angle(), 0.0);")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn lode_angle(&self) -> T {
                invariants::lode_angle(&self.0)
            }

            /// θₛ ∈ [−π/6, π/6], from pure shear: [`invariants::lode_angle_from_shear`].
            ///
            /// # Example
            #[doc = example!($name, "assert!((bar.lode_angle_from_shear() - std::f64::consts::FRAC_PI_6).abs() < 1e-15);")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn lode_angle_from_shear(&self) -> T {
                invariants::lode_angle_from_shear(&self.0)
            }

            /// Mean stress over von Mises' stress: [`invariants::triaxiality`].
            ///
            /// # Errors
            /// [`ContinuumError::ZeroDeviator`].
            ///
            /// # Example
            #[doc = example!($name, "assert_eq!(bar.triaxiality()?, 1.0 / 3.0);")]
            #[inline]
            pub fn triaxiality(&self) -> Result<T, ContinuumError> {
                invariants::triaxiality(&self.0)
            }

            /// (ξ, ρ, θ): [`HaighWestergaard::of`].
            ///
            /// # Example
            #[doc = example!($name, "assert!((bar.haigh_westergaard().deviatoric - 6.0_f64.sqrt()).abs() < 1e-15);")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn haigh_westergaard(&self) -> HaighWestergaard<T> {
                HaighWestergaard::of(&self.0)
            }
        }
    };
}

invariants_of!(CauchyStress);
invariants_of!(KirchhoffStress);
