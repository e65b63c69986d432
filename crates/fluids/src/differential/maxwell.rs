//! The fluids of Maxwell and Oldroyd: linear in the convected rate.
//!
//! ```text
//! λ (τ̇ − L τ − τ Lᵀ) + τ = 2 ηₚ D
//! ```

use piola_numerics::{Real, parameters};

use super::mode::{DifferentialFluid, Mode, only_mode};
use crate::FluidsError;
use crate::answers::finite_rate;
use crate::parameters::{Parameters, listed};
use crate::{FlowMoment, Newtonian, ViscometricFluid};

parameters! {
    FluidsError;
    /// The upper-convected Maxwell fluid.
    ///
    /// ```text
    /// λ (τ̇ − L τ − τ Lᵀ) + τ = 2 η D      in steady shear: T₁₂ = η k, N₁ = 2 η λ k², N₂ = 0
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | η | `polymer_viscosity` | Pa s | 0 < η |
    /// | λ | `time` | s | 0 < λ |
    ///
    /// # Accuracy
    /// 2 ulp of the viscometric functions.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{UpperConvectedMaxwell, ViscometricFluid};
    /// let fluid = UpperConvectedMaxwell::new(2.0, 0.5)?;
    /// assert_eq!(fluid.first_normal_stress_difference(10.0), 200.0);
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// J. G. Oldroyd, Proc. R. Soc. A 200 (1950) 523; an example of the simple fluids of W(18.1).
    pub struct UpperConvectedMaxwell("upper-convected Maxwell") {
        /// η, Pa s.
        polymer_viscosity: "0 < η" => 0.0 < polymer_viscosity,
        /// λ, s.
        time: "0 < λ" => 0.0 < time,
    }
}

parameters! {
    FluidsError;
    /// Oldroyd's fluid B: an upper-convected Maxwell fluid in a Newtonian solvent.
    ///
    /// ```text
    /// V = 2 ηₛ D + τ      λ (τ̇ − L τ − τ Lᵀ) + τ = 2 ηₚ D
    /// in steady shear: T₁₂ = (ηₛ + ηₚ) k, N₁ = 2 ηₚ λ k², N₂ = 0
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | ηₛ | `solvent_viscosity` | Pa s | 0 ≤ ηₛ |
    /// | ηₚ | `polymer_viscosity` | Pa s | 0 < ηₚ |
    /// | λ | `time` | s | 0 < λ |
    ///
    /// # Accuracy
    /// 2 ulp of the viscometric functions.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{OldroydB, ViscometricFluid};
    /// let boger = OldroydB::new(0.25, 0.5, 2.0)?;
    /// assert_eq!(boger.shear_stress(4.0), 3.0);
    /// assert_eq!(boger.first_normal_stress_difference(4.0), 32.0);
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// J. G. Oldroyd, Proc. R. Soc. A 200 (1950) 523; an example of the simple fluids of W(18.1).
    pub struct OldroydB("Oldroyd-B") {
        /// ηₛ, Pa s.
        solvent_viscosity: "0 ≤ ηₛ" => 0.0 <= solvent_viscosity,
        /// ηₚ, Pa s.
        polymer_viscosity: "0 < ηₚ" => 0.0 < polymer_viscosity,
        /// λ, s.
        time: "0 < λ" => 0.0 < time,
    }
}

listed! {
    UpperConvectedMaxwell<2>: polymer_viscosity, time;
    |[viscosity, _], shear_rate| viscosity * shear_rate
}

listed! {
    OldroydB<3>: solvent_viscosity, polymer_viscosity, time;
    |[solvent, polymer, _], shear_rate| (solvent + polymer) * shear_rate
}

/// A mode with R(τ) = τ: what `ConvectedMaxwell` is exact for.
pub trait LinearMode: Mode {}

macro_rules! linear_mode {
    ($mode:ident, $self:ident => $solvent:expr) => {
        impl ViscometricFluid for $mode {
            const NAME: &'static str = Self::NAME;
            const NORMAL_STRESSES: bool = true;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
                Self::shear_stress_of(self.parameters().map(T::lit), shear_rate)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sigma2<T: Real>(&self, shear_rate: T) -> T {
                T::lit(2.0 * self.polymer_viscosity * self.time) * shear_rate * shear_rate
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn viscosity<T: Real>(&self, _shear_rate: T) -> T {
                T::lit(self.zero_rate_viscosity())
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
                finite_rate::<Self, T>(shear_stress, shear_stress / T::lit(self.zero_rate_viscosity()))
            }

            fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
                Newtonian::new(self.zero_rate_viscosity()).ok()?.flow_moment(moment, from, to)
            }
        }

        impl Mode for $mode {
            fn solvent_viscosity(&$self) -> f64 {
                $solvent
            }

            fn polymer_viscosity(&self) -> f64 {
                self.polymer_viscosity
            }

            fn time(&self) -> f64 {
                self.time
            }

            /// 2 ηₚ ε̇ᵢ/(1 − 2 λ ε̇ᵢ), while 2 λ ε̇ᵢ < 1.
            fn steady_extension(&self, rates: [f64; 3]) -> Result<[f64; 3], FluidsError> {
                let mut stresses = [0.0; 3];
                for (stress, rate) in stresses.iter_mut().zip(rates) {
                    let left = 1.0 - 2.0 * self.time * rate;
                    if left <= 0.0 {
                        return Err(FluidsError::BeyondLimit {
                            law: Self::NAME,
                            quantity: "2 λ ε̇",
                            value: 2.0 * self.time * rate,
                            limit: 1.0,
                        });
                    }
                    *stress = 2.0 * self.polymer_viscosity * rate / left;
                }
                Ok(stresses)
            }
        }

        impl LinearMode for $mode {}
    };
}
linear_mode!(UpperConvectedMaxwell, self => 0.0);
linear_mode!(OldroydB, self => self.solvent_viscosity);
only_mode!(UpperConvectedMaxwell, OldroydB);
