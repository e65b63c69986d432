//! The fluids of Phan-Thien and Tanner.

use piola_numerics::{Dual, Real, parameters};

use super::mode::{Mode, only_mode};
use super::slipping::{NetworkMode, network_extension};
use crate::FluidsError;
use crate::answers::{Relation, finite_rate, moment_of_power, moving, solve_from_above};
use crate::parameters::{Parameters, listed};
use crate::viscometric::rate_at_stress;
use crate::{FlowMoment, ViscometricFluid};

parameters! {
    FluidsError;
    /// The linear fluid of Phan-Thien and Tanner: a network whose junctions break the faster the more it is drawn out.
    ///
    /// ```text
    /// V = 2 ηₛ D + τ      λ (τ̇ − L τ − τ Lᵀ) + f τ = 2 ηₚ D      f = 1 + ε (λ/ηₚ) tr τ
    /// in steady shear, with y = λ τ₁₂/ηₚ: y (1 + 2 ε y²) = λ k      N₁ = 2 (ηₚ/λ) y²,  N₂ = 0
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | ηₛ | `solvent_viscosity` | Pa s | 0 ≤ ηₛ |
    /// | ηₚ | `polymer_viscosity` | Pa s | 0 < ηₚ |
    /// | λ | `time` | s | 0 < λ |
    /// | ε | `extensibility`; 0 is Oldroyd's fluid B | – | 0 ≤ ε |
    ///
    /// Without solvent ζ and its moments are closed.
    ///
    /// # Accuracy
    /// 8 ulp of T₁₂ and N₁ at every rate.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{LinearPhanThienTanner, ViscometricFluid};
    /// let melt = LinearPhanThienTanner::new(0.0, 3.0, 1.0, 0.5)?;
    /// assert_eq!(melt.shear_rate(6.0)?, 10.0); // y = 2: 2 (1 + 4)
    /// assert_eq!(melt.shear_stress(10.0), 6.0);
    /// assert_eq!(melt.first_normal_stress_difference(10.0), 24.0);
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// N. Phan-Thien, R. I. Tanner, J. Non-Newtonian Fluid Mech. 2 (1977) 353, without slip of the network, ξ = 0: that is
    /// [`Slipping`](super::Slipping)'s; an example of the functions of W(23.13–23.24).
    pub struct LinearPhanThienTanner("linear Phan-Thien-Tanner") {
        /// ηₛ, Pa s.
        solvent_viscosity: "0 ≤ ηₛ" => 0.0 <= solvent_viscosity,
        /// ηₚ, Pa s.
        polymer_viscosity: "0 < ηₚ" => 0.0 < polymer_viscosity,
        /// λ, s.
        time: "0 < λ" => 0.0 < time,
        /// ε.
        extensibility: "0 ≤ ε" => 0.0 <= extensibility,
    }
}

parameters! {
    FluidsError;
    /// The exponential fluid of Phan-Thien and Tanner.
    ///
    /// ```text
    /// V = 2 ηₛ D + τ      λ (τ̇ − L τ − τ Lᵀ) + f τ = 2 ηₚ D      f = exp(ε (λ/ηₚ) tr τ)
    /// in steady shear, with y = λ τ₁₂/ηₚ: y exp(2 ε y²) = λ k      N₁ = 2 (ηₚ/λ) y²,  N₂ = 0
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | ηₛ | `solvent_viscosity` | Pa s | 0 ≤ ηₛ |
    /// | ηₚ | `polymer_viscosity` | Pa s | 0 < ηₚ |
    /// | λ | `time` | s | 0 < λ |
    /// | ε | `extensibility`; 0 is Oldroyd's fluid B | – | 0 ≤ ε |
    ///
    /// Without solvent ζ is closed.
    ///
    /// # Accuracy
    /// 8 ulp of T₁₂ and N₁ at every rate.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{ExponentialPhanThienTanner, ViscometricFluid};
    /// let melt = ExponentialPhanThienTanner::new(0.0, 3.0, 1.0, 0.5)?;
    /// let rate = melt.shear_rate(3.0)?; // y = 1
    /// assert!((rate - core::f64::consts::E).abs() < 1e-15);
    /// assert!((melt.shear_stress(rate) - 3.0).abs() < 1e-14);
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// N. Phan-Thien, J. Rheol. 22 (1978) 259, without slip of the network (ξ = 0); an example of the functions of
    /// W(23.13–23.24).
    pub struct ExponentialPhanThienTanner("exponential Phan-Thien-Tanner") {
        /// ηₛ, Pa s.
        solvent_viscosity: "0 ≤ ηₛ" => 0.0 <= solvent_viscosity,
        /// ηₚ, Pa s.
        polymer_viscosity: "0 < ηₚ" => 0.0 < polymer_viscosity,
        /// λ, s.
        time: "0 < λ" => 0.0 < time,
        /// ε.
        extensibility: "0 ≤ ε" => 0.0 <= extensibility,
    }
}

/// w = y (1 + 2 ε y²).
struct Cubic<T> {
    extensibility: T,
}

impl<T: Real> Relation<T> for Cubic<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at(&self, y: Dual<T>) -> Dual<T> {
        y * (Dual::lit(1.0) + Dual::constant(self.extensibility + self.extensibility) * y * y)
    }
}

/// w = y exp(2 ε y²).
struct Exponential<T> {
    extensibility: T,
}

impl<T: Real> Relation<T> for Exponential<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at(&self, y: Dual<T>) -> Dual<T> {
        y * (Dual::constant(self.extensibility + self.extensibility) * y * y).exp()
    }
}

/// y of the cubic at w, 0 ≤ w.
#[cfg_attr(not(debug_assertions), inline(always))]
fn cubic<T: Real>(extensibility: T, w: T) -> T {
    // y ≤ w and 2 ε y³ ≤ w.
    let (_, size) = moving(w.frozen());
    let start = size.min((size / (extensibility + extensibility).frozen()).cbrt());
    solve_from_above(&Cubic { extensibility }, w, start)
}

/// y of the exponential at w, 0 ≤ w.
#[cfg_attr(not(debug_assertions), inline(always))]
fn exponential<T: Real>(extensibility: T, w: T) -> T {
    // 4 ε y² = W(4 ε w²) ≤ ln(1 + 4 ε w²) with Lambert's W.
    let (_, size) = moving(w.frozen());
    let (none, four) = moving(T::lit(4.0) * extensibility.frozen());
    let square = four * size * size;
    // What is slow is linear, and its square may be no number.
    let slow = square.at_most(T::lit(1e-30));
    let start = T::select(none | slow, size, (square.ln_1p() / four).sqrt().min(size));
    solve_from_above(&Exponential { extensibility }, w, start)
}

macro_rules! phan_thien_tanner {
    ($fluid:ident, $solve:ident, $relation:ident, $breaking:ident, $moments:ident) => {
        impl $fluid {
            /// y = λ |τ₁₂|/ηₚ of the polymer.
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn share<T: Real>(&self, shear_rate: T) -> T {
                $solve(T::lit(self.extensibility), T::lit(self.time) * shear_rate.abs())
            }

            /// ηₚ/λ.
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn modulus(&self) -> f64 {
                self.polymer_viscosity / self.time
            }
        }

        listed! {
            $fluid<4>: solvent_viscosity, polymer_viscosity, time, extensibility;
            |[solvent, polymer, time, extensibility], shear_rate|
                solvent * shear_rate + polymer / time * $solve(extensibility, time * shear_rate)
        }

        impl ViscometricFluid for $fluid {
            const NAME: &'static str = Self::NAME;
            const NORMAL_STRESSES: bool = true;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
                let size = Self::shear_stress_of(self.parameters().map(T::lit), shear_rate.abs());
                T::select(shear_rate.less_than(T::zero()), -size, size)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sigma2<T: Real>(&self, shear_rate: T) -> T {
                let y = self.share(shear_rate);
                T::lit(2.0 * self.modulus()) * y * y
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
                if 0.0 < self.solvent_viscosity {
                    return rate_at_stress(self, shear_stress);
                }
                let y = shear_stress / T::lit(self.modulus());
                let w = $relation { extensibility: T::lit(self.extensibility) }.at(Dual::constant(y)).value;
                finite_rate::<Self, T>(shear_stress, w / T::lit(self.time))
            }

            fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
                if 0.0 < self.solvent_viscosity {
                    return None;
                }
                $moments(self, moment, from, to)
            }
        }

        impl Mode for $fluid {
            fn solvent_viscosity(&self) -> f64 {
                self.solvent_viscosity
            }

            fn polymer_viscosity(&self) -> f64 {
                self.polymer_viscosity
            }

            fn time(&self) -> f64 {
                self.time
            }

            fn steady_extension(&self, rates: [f64; 3]) -> Result<[f64; 3], FluidsError> {
                network_extension(self, |trace| self.breaking(trace), rates)
            }
        }

        impl NetworkMode for $fluid {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn breaking<T: Real>(&self, trace: T) -> T {
                $breaking(T::lit(self.extensibility) * trace)
            }
        }
    };
}

/// 1 + x.
#[cfg_attr(not(debug_assertions), inline(always))]
fn linear_breaking<T: Real>(x: T) -> T {
    T::one() + x
}

/// eˣ.
#[cfg_attr(not(debug_assertions), inline(always))]
fn exponential_breaking<T: Real>(x: T) -> T {
    x.exp()
}

/// Those of ζ = (s/ηₚ) (1 + 2 ε (s/G)²) with G = ηₚ/λ.
#[expect(clippy::unnecessary_wraps, reason = "the other fluid has none")]
fn linear_moments(fluid: &LinearPhanThienTanner, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
    let power = moment.power() + 2;
    let sum = moment_of_power(power, 0.0, 1.0, from, to)
        + 2.0 * fluid.extensibility * moment_of_power(power, 2.0, fluid.modulus(), from, to);
    Some(sum / fluid.polymer_viscosity)
}

/// None are closed.
fn no_moments(_: &ExponentialPhanThienTanner, _: FlowMoment, _: f64, _: f64) -> Option<f64> {
    None
}

phan_thien_tanner!(LinearPhanThienTanner, cubic, Cubic, linear_breaking, linear_moments);
phan_thien_tanner!(ExponentialPhanThienTanner, exponential, Exponential, exponential_breaking, no_moments);
only_mode!(LinearPhanThienTanner, ExponentialPhanThienTanner);
