//! Giesekus' fluid.

use piola_numerics::{Real, parameters};

use super::mode::{Mode, only_mode};
use crate::FluidsError;
use crate::ViscometricFluid;
use crate::parameters::{Parameters, listed};

parameters! {
    FluidsError;
    /// Giesekus' fluid: polymers drag less along the direction in which they are drawn out.
    ///
    /// ```text
    /// V = 2 ηₛ D + τ      λ (τ̇ − L τ − τ Lᵀ) + τ + (α λ/ηₚ) τ² = 2 ηₚ D
    /// in steady shear, with w = λ |k|, r = √(1 + 16 α (1 − α) w²), χ² = 2/(1 + r), d = 1 + (1 − 2 α) χ:
    /// f/α = 16 (1 − α) w²/((1 + r)² (1 + χ) d)      1 − f = 2 (1 − α) χ/d
    /// T₁₂ = ηₛ k + ηₚ k 2 (1 − α) χ²/d,  N₁ = 2 (ηₚ/λ) (f/α) (1 − α f)/(1 − f),  N₂ = −(ηₚ/λ) f
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | ηₛ | `solvent_viscosity` | Pa s | 0 ≤ ηₛ |
    /// | ηₚ | `polymer_viscosity` | Pa s | 0 < ηₚ |
    /// | λ | `time` | s | 0 < λ |
    /// | α | `mobility`; 0 is Oldroyd's fluid B | – | 0 ≤ α ≤ ½; beyond, the polymer's shear stress falls |
    ///
    /// # Accuracy
    /// 16 ulp of T₁₂, N₁ and N₂ at every rate: no difference of near numbers is formed.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{Giesekus, ViscometricFluid};
    /// // α = ½, w = √12: r = 7, χ = ½, d = 1: f = ½.
    /// let fluid = Giesekus::new(0.0, 4.0, 1.0, 0.5)?;
    /// let k = 12.0_f64.sqrt();
    /// assert!((fluid.viscosity(k) - 1.0).abs() < 1e-15); // 4 χ²
    /// assert!((fluid.second_normal_stress_difference(k) + 2.0).abs() < 1e-14); // −4 f
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// H. Giesekus, J. Non-Newtonian Fluid Mech. 11 (1982) 69; an example of the functions of W(23.13–23.24).
    pub struct Giesekus("Giesekus") {
        /// ηₛ, Pa s.
        solvent_viscosity: "0 ≤ ηₛ" => 0.0 <= solvent_viscosity,
        /// ηₚ, Pa s.
        polymer_viscosity: "0 < ηₚ" => 0.0 < polymer_viscosity,
        /// λ, s.
        time: "0 < λ" => 0.0 < time,
        /// α.
        mobility: "0 ≤ α ≤ ½" => 0.0 <= mobility && mobility <= 0.5,
    }
}

/// χ, d, and w/(1 + r), which does not overflow.
#[cfg_attr(not(debug_assertions), inline(always))]
fn parts<T: Real>(mobility: T, w: T) -> [T; 3] {
    let one = T::one();
    let root = (one + T::lit(16.0) * mobility * (one - mobility) * w * w).sqrt();
    let chi = (T::lit(2.0) / (one + root)).sqrt();
    [chi, one + (one - T::lit(2.0) * mobility) * chi, w / (one + root)]
}

impl Giesekus {
    /// f/α and f and 1 − f.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn normal<T: Real>(&self, shear_rate: T) -> [T; 3] {
        let mobility = T::lit(self.mobility);
        let free = T::one() - mobility;
        let [chi, d, ratio] = parts(mobility, T::lit(self.time) * shear_rate);
        let share = T::lit(16.0) * free * ratio * ratio / ((T::one() + chi) * d);
        [share, mobility * share, T::lit(2.0) * free * chi / d]
    }

    /// ηₚ/λ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn modulus<T: Real>(&self) -> T {
        T::lit(self.polymer_viscosity / self.time)
    }
}

listed! {
    Giesekus<4>: solvent_viscosity, polymer_viscosity, time, mobility;
    |[solvent, polymer, time, mobility], shear_rate| {
        let [chi, d, _] = parts(mobility, time * shear_rate);
        (solvent + polymer * T::lit(2.0) * (T::one() - mobility) * chi * chi / d) * shear_rate
    }
}

impl ViscometricFluid for Giesekus {
    const NAME: &'static str = Self::NAME;
    const NORMAL_STRESSES: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        Self::shear_stress_of(self.parameters().map(T::lit), shear_rate)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sigma1<T: Real>(&self, shear_rate: T) -> T {
        -(self.modulus::<T>() * self.normal(shear_rate)[1])
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sigma2<T: Real>(&self, shear_rate: T) -> T {
        self.first_normal_stress_difference(shear_rate) + self.sigma1(shear_rate)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_normal_stress_difference<T: Real>(&self, shear_rate: T) -> T {
        let [share, f, left] = self.normal(shear_rate);
        T::lit(2.0) * self.modulus::<T>() * share * (T::one() - T::lit(self.mobility) * f) / left
    }
}

impl Mode for Giesekus {
    fn solvent_viscosity(&self) -> f64 {
        self.solvent_viscosity
    }

    fn polymer_viscosity(&self) -> f64 {
        self.polymer_viscosity
    }

    fn time(&self) -> f64 {
        self.time
    }

    /// α y² + (1 − 2 w) y = 2 w with y = λ τ/ηₚ, w = λ ε̇: the root that starts at zero.
    fn steady_extension(&self, rates: [f64; 3]) -> Result<[f64; 3], FluidsError> {
        let mut stresses = [0.0; 3];
        for (stress, rate) in stresses.iter_mut().zip(rates) {
            let w = self.time * rate;
            let slope = 1.0 - 2.0 * w;
            let root = (slope * slope + 8.0 * self.mobility * w).sqrt();
            let y = if 0.0 < slope {
                4.0 * w / (slope + root)
            } else if 0.0 < self.mobility {
                (root - slope) / (2.0 * self.mobility)
            } else {
                let value = 2.0 * w;
                return Err(FluidsError::BeyondLimit { law: Self::NAME, quantity: "2 λ ε̇", value, limit: 1.0 });
            };
            *stress = self.modulus::<f64>() * y;
        }
        Ok(stresses)
    }
}
only_mode!(Giesekus);
