//! Any of the built-in fluids as one type, for programs that read which fluid it is.

use piola_numerics::Real;
use piola_numerics::internal::outlined;

use super::viscometric::{FlowMoment, ViscometricFluid};
use super::{
    Bingham, CarreauYasuda, Casson, ConstantCoefficients, Cross, Ellis, ExponentialDamping, ExponentialPhanThienTanner,
    Eyring, Giesekus, HerschelBulkley, Kbkz, LinearPhanThienTanner, Modes, Newtonian, OldroydB, Papanastasiou,
    PowerLaw, RationalDamping, ReinerRivlin, SecondOrder, Sisko, Slipping, UpperConvectedMaxwell,
};
use crate::FluidsError;

/// A Reiner–Rivlin fluid whose coefficients are constants.
pub type ConstantReinerRivlin = ReinerRivlin<ConstantCoefficients>;
/// The fluid of Johnson and Segalman: Oldroyd's fluid B that slips.
pub type JohnsonSegalman = Slipping<OldroydB>;
/// The linear fluid of Phan-Thien and Tanner, with slip.
pub type SlippingLinearPhanThienTanner = Slipping<LinearPhanThienTanner>;
/// The exponential fluid of Phan-Thien and Tanner, with slip.
pub type SlippingExponentialPhanThienTanner = Slipping<ExponentialPhanThienTanner>;
/// Several modes of Oldroyd's fluid B.
pub type OldroydBModes = Modes<OldroydB>;
/// Several modes of Giesekus' fluid.
pub type GiesekusModes = Modes<Giesekus>;
/// Several modes of the linear fluid of Phan-Thien and Tanner.
pub type LinearPhanThienTannerModes = Modes<LinearPhanThienTanner>;
/// Several modes of the exponential fluid of Phan-Thien and Tanner.
pub type ExponentialPhanThienTannerModes = Modes<ExponentialPhanThienTanner>;
/// The K-BKZ fluid with the damping of Papanastasiou, Scriven and Macosko.
pub type KbkzRational = Kbkz<RationalDamping>;
/// The K-BKZ fluid with Wagner's damping.
pub type KbkzExponential = Kbkz<ExponentialDamping>;

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
    /// | `constant_reiner_rivlin` | [`ConstantReinerRivlin`] | `linear`, `quadratic` |
    /// | `second_order` | [`SecondOrder`] | `viscosity_coefficient`, `alpha1`, `alpha2` |
    /// | `upper_convected_maxwell` | [`UpperConvectedMaxwell`] | `polymer_viscosity`, `time` |
    /// | `oldroyd_b` | [`OldroydB`] | `solvent_viscosity`, `polymer_viscosity`, `time` |
    /// | `giesekus` | [`Giesekus`] | the same, and `mobility` |
    /// | `linear_phan_thien_tanner`, `exponential_phan_thien_tanner` | [`LinearPhanThienTanner`], [`ExponentialPhanThienTanner`] | the same, and `extensibility` |
    /// | `johnson_segalman`, `slipping_linear_phan_thien_tanner`, `slipping_exponential_phan_thien_tanner` | [`Slipping`] | `network` with its parameters, and `slip` |
    /// | `oldroyd_b_modes`, `giesekus_modes`, `linear_phan_thien_tanner_modes`, `exponential_phan_thien_tanner_modes` | [`Modes`] | `modes`, each with the parameters of one |
    /// | `kbkz_rational`, `kbkz_exponential` | [`Kbkz`] | `memory`, each term with `viscosity` and `time`; `damping` with `alpha`, `beta` or `strength`, `beta` |
    ///
    /// What is read is validated as by the constructors, and names that a fluid does not have are refused. A call chooses the
    /// fluid once and then runs its own function.
    ///
    /// # Example
    /// ```
    /// # #[cfg(feature = "serde")]
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// use piola_fluids::{AnyFluid, ViscometricFluid};
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
    /// τᵧ + μ k.
    Bingham,
    /// τᵧ + K kⁿ.
    HerschelBulkley,
    /// (√τᵧ + √(μ k))².
    Casson,
    /// (η∞ + (η₀ − η∞) (1 + (λ k)^a)^((n − 1)/a)) k.
    CarreauYasuda,
    /// (η∞ + (η₀ − η∞)/(1 + (λ k)^m)) k.
    Cross,
    /// k = (τ/η₀) (1 + (τ/τ½)^(α − 1)).
    Ellis,
    /// τ₀ arsinh(λ k).
    Eyring,
    /// η∞ k + K kⁿ.
    Sisko,
    /// K kⁿ + τᵧ (1 − exp(−m k)).
    Papanastasiou,
    /// g₁ k/2, with normal stresses.
    ConstantReinerRivlin,
    /// μ k, with normal stresses.
    SecondOrder,
    /// η k, with N₁ = 2 η λ k².
    UpperConvectedMaxwell,
    /// (ηₛ + ηₚ) k, with N₁ = 2 ηₚ λ k².
    OldroydB,
    /// τ + (α λ/ηₚ) τ² relaxes.
    Giesekus,
    /// (1 + ε (λ/ηₚ) tr τ) τ relaxes.
    LinearPhanThienTanner,
    /// exp(ε (λ/ηₚ) tr τ) τ relaxes.
    ExponentialPhanThienTanner,
    /// [`OldroydB`] that slips.
    JohnsonSegalman,
    /// [`LinearPhanThienTanner`] that slips.
    SlippingLinearPhanThienTanner,
    /// [`ExponentialPhanThienTanner`] that slips.
    SlippingExponentialPhanThienTanner,
    /// Several [`OldroydB`].
    OldroydBModes,
    /// Several [`Giesekus`].
    GiesekusModes,
    /// Several [`LinearPhanThienTanner`].
    LinearPhanThienTannerModes,
    /// Several [`ExponentialPhanThienTanner`].
    ExponentialPhanThienTannerModes,
    /// ∫ m h k s ds with h = α/(α + k² s²).
    KbkzRational,
    /// ∫ m h k s ds with h = exp(−n k s).
    KbkzExponential,
    }
}

/// A choice in a function of its own, compiled once for a scalar: a flow asks in dozens of places, and all fluids would stand in each. In
/// lanes it is inlined, for the instructions of its caller.
macro_rules! once {
    ($scalar:ty: $choice:expr) => {
        if const { <$scalar as Real>::LANES == 1 } { outlined(|| $choice) } else { $choice }
    };
}

impl ViscometricFluid for AnyFluid {
    const NAME: &'static str = "fluid";
    const NORMAL_STRESSES: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        once!(T: chosen!(self, fluid => fluid.shear_stress(shear_rate)))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sigma1<T: Real>(&self, shear_rate: T) -> T {
        once!(T: chosen!(self, fluid => fluid.sigma1(shear_rate)))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sigma2<T: Real>(&self, shear_rate: T) -> T {
        once!(T: chosen!(self, fluid => fluid.sigma2(shear_rate)))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_normal_stress_difference<T: Real>(&self, shear_rate: T) -> T {
        once!(T: chosen!(self, fluid => fluid.first_normal_stress_difference(shear_rate)))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn second_normal_stress_difference<T: Real>(&self, shear_rate: T) -> T {
        once!(T: chosen!(self, fluid => fluid.second_normal_stress_difference(shear_rate)))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn yield_stress(&self) -> f64 {
        once!(f64: chosen!(self, fluid => ViscometricFluid::yield_stress(fluid)))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn viscosity<T: Real>(&self, shear_rate: T) -> T {
        once!(T: chosen!(self, fluid => fluid.viscosity(shear_rate)))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
        once!(T: chosen!(self, fluid => fluid.shear_rate(shear_stress)))
    }

    fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
        chosen!(self, fluid => fluid.flow_moment(moment, from, to))
    }
}

#[cfg(feature = "motions")]
pub(crate) use chosen as chosen_fluid;
