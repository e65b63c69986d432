//! Any of the built-in fluids as one type, for programs that read which fluid it is.

use piola_numerics::Real;

use super::viscometric::{FlowMoment, ViscometricFluid};
use super::{
    Bingham, CarreauYasuda, Casson, Cross, Ellis, Eyring, HerschelBulkley, Newtonian, Papanastasiou, PowerLaw, Sisko,
};
use crate::ConstitutiveError;

/// Declares the enum of the fluids with its conversions and its dispatch.
macro_rules! any_fluid {
    ($(#[$documentation:meta])* pub enum AnyFluid { $($(#[$about:meta])* $fluid:ident),+ $(,)? }) => {
        $(#[$documentation])*
        #[derive(Clone, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(tag = "fluid", rename_all = "snake_case"))]
        #[non_exhaustive]
        pub enum AnyFluid {
            $($(#[$about])* $fluid($fluid)),+
        }

        $(impl From<$fluid> for AnyFluid {
            fn from(fluid: $fluid) -> Self {
                Self::$fluid(fluid)
            }
        })+

        /// Does `$does` with whichever fluid it is.
        macro_rules! chosen {
            ($any:expr, $one:ident => $does:expr) => {
                match $any {
                    $(AnyFluid::$fluid($one) => $does),+
                }
            };
        }

        impl AnyFluid {
            /// The name of the fluid it is.
            #[must_use]
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$fluid(_) => <$fluid as ViscometricFluid>::NAME),+
                }
            }
        }
    };
}

any_fluid! {
    /// Any of the built-in fluids, written with its name and its parameters by name.
    ///
    /// | `fluid` | type | parameters |
    /// |---|---|---|
    /// | `newtonian` | [`Newtonian`] | `viscosity_coefficient` |
    /// | `power_law` | [`PowerLaw`] | `consistency`, `exponent` |
    /// | `bingham` | [`Bingham`] | `yield_stress`, `plastic_viscosity` |
    /// | `herschel_bulkley` | [`HerschelBulkley`] | `yield_stress`, `consistency`, `exponent` |
    /// | `casson` | [`Casson`] | `yield_stress`, `plastic_viscosity` |
    /// | `carreau_yasuda` | [`CarreauYasuda`] | `zero_rate_viscosity`, `infinite_rate_viscosity`, `time`, `exponent`, `transition` |
    /// | `cross` | [`Cross`] | `zero_rate_viscosity`, `infinite_rate_viscosity`, `time`, `exponent` |
    /// | `ellis` | [`Ellis`] | `zero_rate_viscosity`, `half_stress`, `exponent` |
    /// | `eyring` | [`Eyring`] | `stress`, `time` |
    /// | `sisko` | [`Sisko`] | `infinite_rate_viscosity`, `consistency`, `exponent` |
    /// | `papanastasiou` | [`Papanastasiou`] | `apparent_yield_stress`, `consistency`, `exponent`, `growth_time` |
    ///
    /// What is read is validated as by the constructors, and names that a fluid does not have are refused. A call chooses the
    /// fluid once and then runs its own function.
    ///
    /// # Example
    /// ```
    /// # #[cfg(feature = "serde")]
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// use piola_constitutive::fluids::{AnyFluid, ViscometricFluid};
    /// let mud: AnyFluid = toml::from_str(r#"
    ///     fluid = "bingham"
    ///     yield_stress = 3.0
    ///     plastic_viscosity = 0.5
    /// "#)?;
    /// assert_eq!(mud.shear_stress(4.0), 5.0);
    /// let wrong = toml::from_str::<AnyFluid>(r#"
    ///     fluid = "newtonian"
    ///     viscosity_coefficient = -1.0
    /// "#);
    /// assert!(wrong.unwrap_err().to_string().contains("viscosity_coefficient = -1e0 violates 0 < μ"));
    /// # Ok(())
    /// # }
    /// # #[cfg(not(feature = "serde"))]
    /// # fn main() {}
    /// ```
    pub enum AnyFluid {
    /// μ k.
    Newtonian,
    /// K |k|ⁿ.
    PowerLaw,
    /// τ_y + μ k.
    Bingham,
    /// τ_y + K kⁿ.
    HerschelBulkley,
    /// (√τ_y + √(μ k))².
    Casson,
    /// (η_∞ + (η₀ − η_∞) (1 + (λ k)^a)^((n − 1)/a)) k.
    CarreauYasuda,
    /// (η_∞ + (η₀ − η_∞)/(1 + (λ k)^m)) k.
    Cross,
    /// k = (τ/η₀) (1 + (τ/τ_½)^(α − 1)).
    Ellis,
    /// τ₀ arsinh(λ k).
    Eyring,
    /// η_∞ k + K kⁿ.
    Sisko,
    /// K kⁿ + τ_y (1 − exp(−m k)).
    Papanastasiou,
    }
}

impl ViscometricFluid for AnyFluid {
    const NAME: &'static str = "fluid";
    const NORMAL_STRESSES: bool = true;

    #[inline(always)]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        chosen!(self, fluid => fluid.shear_stress(shear_rate))
    }

    #[inline(always)]
    fn sigma1<T: Real>(&self, shear_rate: T) -> T {
        chosen!(self, fluid => fluid.sigma1(shear_rate))
    }

    #[inline(always)]
    fn sigma2<T: Real>(&self, shear_rate: T) -> T {
        chosen!(self, fluid => fluid.sigma2(shear_rate))
    }

    #[inline(always)]
    fn yield_stress(&self) -> f64 {
        chosen!(self, fluid => ViscometricFluid::yield_stress(fluid))
    }

    #[inline(always)]
    fn viscosity<T: Real>(&self, shear_rate: T) -> T {
        chosen!(self, fluid => fluid.viscosity(shear_rate))
    }

    #[inline(always)]
    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, ConstitutiveError> {
        chosen!(self, fluid => fluid.shear_rate(shear_stress))
    }

    fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
        chosen!(self, fluid => fluid.flow_moment(moment, from, to))
    }
}
