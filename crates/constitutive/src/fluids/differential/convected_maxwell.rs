//! The fluids of Maxwell and Oldroyd: linear in the convected rate, and so exact in every motion.
//!
//! ```text
//! λ (τ̇ − L τ − τ Lᵀ) + τ = 2 ηₚ D      τ(t) = ∫ (ηₚ/λ²) exp(−s/λ) (Cₜ⁻¹(t − s) − 1) ds
//! ```

use piola_continuum::rates::{RelativeDeformation, VelocityGradient, exponential_rows, logarithm};
use piola_continuum::tensor::rows::{difference, identity, scaled};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::Real;

use super::mode::{DifferentialFluid, Mode, ShearStresses, convected, only_mode};
use crate::ConstitutiveError;
use piola_numerics::internal::excess_of_exponential;
use crate::error::{check_bound, check_finite};
use crate::fluids::answers::finite_rate;
use crate::fluids::parameters::Parameters;
use crate::fluids::quadrature::{Integral, integrate};
use crate::fluids::{FlowMoment, Newtonian, ViscometricFluid};
use piola_numerics::parameters;

parameters! {
    ConstitutiveError;
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
    /// use piola_constitutive::fluids::{ConvectedMaxwell, UpperConvectedMaxwell, ViscometricFluid};
    /// let fluid = UpperConvectedMaxwell::new(2.0, 0.5)?;
    /// assert_eq!(fluid.first_normal_stress_difference(10.0), 200.0);
    /// // After t ≪ λ the stress is elastic: G k t.
    /// assert!((fluid.start_up(3.0, 1e-8)?.shear / 1.2e-7 - 1.0).abs() < 1.1e-8);
    /// # Ok::<(), piola_constitutive::ConstitutiveError>(())
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
    ConstitutiveError;
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
    /// use piola_constitutive::fluids::{OldroydB, ViscometricFluid};
    /// let boger = OldroydB::new(0.25, 0.5, 2.0)?;
    /// assert_eq!(boger.shear_stress(4.0), 3.0);
    /// assert_eq!(boger.first_normal_stress_difference(4.0), 32.0);
    /// # Ok::<(), piola_constitutive::ConstitutiveError>(())
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

impl Parameters<2> for UpperConvectedMaxwell {
    const NAMES: [&'static str; 2] = ["polymer_viscosity", "time"];

    fn parameters(&self) -> [f64; 2] {
        [self.polymer_viscosity, self.time]
    }

    fn from_parameters([viscosity, time]: [f64; 2]) -> Result<Self, ConstitutiveError> {
        Self::new(viscosity, time)
    }

    #[inline(always)]
    fn shear_stress_of<T: Real>([viscosity, _]: [T; 2], shear_rate: T) -> T {
        viscosity * shear_rate
    }
}

impl Parameters<3> for OldroydB {
    const NAMES: [&'static str; 3] = ["solvent_viscosity", "polymer_viscosity", "time"];

    fn parameters(&self) -> [f64; 3] {
        [self.solvent_viscosity, self.polymer_viscosity, self.time]
    }

    fn from_parameters([solvent, polymer, time]: [f64; 3]) -> Result<Self, ConstitutiveError> {
        Self::new(solvent, polymer, time)
    }

    #[inline(always)]
    fn shear_stress_of<T: Real>([solvent, polymer, _]: [T; 3], shear_rate: T) -> T {
        (solvent + polymer) * shear_rate
    }
}

/// A mode with R(τ) = τ: what [`ConvectedMaxwell`] is exact for.
pub trait LinearMode: Mode {}

macro_rules! linear_mode {
    ($mode:ident, $self:ident => $solvent:expr) => {
        impl ViscometricFluid for $mode {
            const NAME: &'static str = Self::NAME;
            const NORMAL_STRESSES: bool = true;

            #[inline(always)]
            fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
                Self::shear_stress_of(self.parameters().map(T::lit), shear_rate)
            }

            #[inline(always)]
            fn sigma2<T: Real>(&self, shear_rate: T) -> T {
                T::lit(2.0 * self.polymer_viscosity * self.time) * shear_rate * shear_rate
            }

            #[inline(always)]
            fn viscosity<T: Real>(&self, _shear_rate: T) -> T {
                T::lit(self.zero_rate_viscosity())
            }

            #[inline(always)]
            fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, ConstitutiveError> {
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

            #[inline(always)]
            fn relaxing<T: Real>(&self, stress: &Symmetric<T>) -> Symmetric<T> {
                *stress
            }

            /// 2 ηₚ ε̇ᵢ/(1 − 2 λ ε̇ᵢ), while 2 λ ε̇ᵢ < 1.
            fn steady_extension(&self, rates: [f64; 3]) -> Result<[f64; 3], ConstitutiveError> {
                let mut stresses = [0.0; 3];
                for (stress, rate) in stresses.iter_mut().zip(rates) {
                    let left = 1.0 - 2.0 * self.time * rate;
                    if left <= 0.0 {
                        return Err(ConstitutiveError::BeyondLimit {
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

/// The exact answers of the fluids of Maxwell and Oldroyd, of one mode or of several.
///
/// # Example
/// ```
/// use piola_constitutive::fluids::{ConvectedMaxwell, DifferentialFluid, OldroydB};
/// use piola_continuum::rates::VelocityGradient;
/// let fluid = OldroydB::new(0.25, 1.5, 0.75)?;
/// let shear = VelocityGradient::from_rows([[0.0; 3], [0.5, 0.0, 0.0], [0.0; 3]])?;
/// assert_eq!(fluid.steady_stress(&shear)?.components, [0.0, 0.5625, 0.0, 0.875, 0.0, 0.0]);
/// let after = fluid.cessation(0.5, 0.75)?; // after one λ
/// assert_eq!(after.shear, 0.75 * (-1.0_f64).exp());
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
/// ```
pub trait ConvectedMaxwell: DifferentialFluid<Mode: LinearMode> {
    /// The stresses at the time t after the start of shear at the rate k from rest.
    ///
    /// ```text
    /// T₁₂ = ηₛ k + Σ ηₚ k (1 − e^(−t/λ))      N₁ = Σ 2 ηₚ λ k² (1 − e^(−t/λ) (1 + t/λ))
    /// ```
    ///
    /// # Errors
    /// [`ConstitutiveError::NotFinite`]; [`ConstitutiveError::OutOfBounds`] unless 0 ≤ t.
    ///
    /// # Accuracy
    /// 8 ulp of each, for t/λ → 0 too.
    fn start_up(&self, shear_rate: f64, time: f64) -> Result<ShearStresses, ConstitutiveError> {
        check_flow::<Self>(shear_rate, time)?;
        let started = if 0.0 < time { 1.0 } else { 0.0 };
        let mut stresses =
            ShearStresses { shear: started * self.total_solvent_viscosity() * shear_rate, ..ShearStresses::default() };
        for mode in self.modes() {
            let x = time / mode.time();
            let drawn = mode.polymer_viscosity() * shear_rate;
            stresses.shear -= drawn * (-x).exp_m1();
            // 1 − e⁻ˣ (1 + x) = e⁻ˣ (eˣ − 1 − x); beyond e⁻⁴⁰ x there is nothing left to subtract.
            let share = if x < 50.0 { (-x).exp() * excess_of_exponential(x) } else { 1.0 };
            stresses.first += 2.0 * drawn * (mode.time() * shear_rate) * share;
        }
        Ok(stresses)
    }

    /// The stresses at the time t after the end of a long steady shear at the rate k.
    ///
    /// ```text
    /// T₁₂ = Σ ηₚ k e^(−t/λ)      N₁ = Σ 2 ηₚ λ k² e^(−t/λ)
    /// ```
    ///
    /// # Errors
    /// As [`start_up`](Self::start_up).
    fn cessation(&self, shear_rate: f64, time: f64) -> Result<ShearStresses, ConstitutiveError> {
        check_flow::<Self>(shear_rate, time)?;
        let mut stresses = ShearStresses::default();
        for mode in self.modes() {
            let left = mode.polymer_viscosity() * shear_rate * (-time / mode.time()).exp();
            stresses.shear += left;
            stresses.first += 2.0 * left * (mode.time() * shear_rate);
        }
        Ok(stresses)
    }

    /// T + p 1, Pa, at the time t after the start, from rest, of a motion with the constant velocity gradient L; of the solvent
    /// from 0 < t.
    ///
    /// # Errors
    /// [`ConstitutiveError::OutOfBounds`] unless 0 ≤ t; [`ConstitutiveError::BeyondLimit`] where the stress is beyond all
    /// numbers.
    ///
    /// # Accuracy
    /// 32 ulp of its norm for |L| t ≤ 1; beyond, that of exp(L t).
    fn start_up_stress(&self, velocity_gradient: &VelocityGradient, time: f64) -> Result<Symmetric, ConstitutiveError> {
        check_flow::<Self>(0.0, time)?;
        let started = if 0.0 < time { 2.0 * self.total_solvent_viscosity() } else { 0.0 };
        let mut total = velocity_gradient.stretching().0 * started;
        for mode in self.modes() {
            total += bounded::<Self>(from_rest(mode, velocity_gradient, time), time)?;
        }
        Ok(total)
    }

    /// Advances τ of each mode, Pa, over the time Δt of a motion with the constant velocity gradient L, exactly.
    ///
    /// ```text
    /// τ ← G τ Gᵀ + ∫ 2 (ηₚ/λ) G(s) D G(s)ᵀ ds      G(s) = exp(s L − s/(2 λ))
    /// ```
    ///
    /// # Errors
    /// As [`start_up_stress`](Self::start_up_stress); `memory` is then of no use.
    fn advance(
        &self,
        memory: &mut [Symmetric],
        velocity_gradient: &VelocityGradient,
        duration: f64,
    ) -> Result<(), ConstitutiveError> {
        check_flow::<Self>(0.0, duration)?;
        for (mode, stress) in self.modes().iter().zip(memory) {
            let left = stress.congruence(remaining(mode, velocity_gradient, duration));
            *stress = bounded::<Self>(left + from_rest(mode, velocity_gradient, duration), duration)?;
        }
        Ok(())
    }

    /// Advances τ of each mode, Pa, through the deformations F at the times of the `samples`, s, from the first to the last.
    ///
    /// Between two samples the velocity gradient is taken as constant, L = ln(F₂ F₁⁻¹)/(t₂ − t₁), and the motion is followed
    /// exactly; a motion that is sampled finely enough is followed to the second order of the steps.
    ///
    /// # Errors
    /// [`ConstitutiveError::OutOfBounds`] unless the times grow; [`ConstitutiveError::Continuum`] where two samples are half a
    /// turn or more apart; as [`advance`](Self::advance).
    fn advance_through(
        &self,
        memory: &mut [Symmetric],
        samples: &[(f64, DeformationGradient)],
    ) -> Result<(), ConstitutiveError> {
        for pair in samples.windows(2) {
            let [(before, first), (time, second)] = pair else { continue };
            check_bound(Self::Mode::NAME, "time", *time, "each time is later than the one before", before < time)?;
            let step = RelativeDeformation::of(first, second)?;
            let velocity_gradient = VelocityGradient::new(logarithm(step.displacement.matrix())? / (time - before))?;
            self.advance(memory, &velocity_gradient, time - before)?;
        }
        Ok(())
    }

    /// T + p 1, Pa, now, from the history Cₜ⁻¹(t − s) − 1 of a motion that began from rest `age` seconds ago; without the
    /// solvent, which asks for the present rate.
    ///
    /// ```text
    /// Σ ∫ (ηₚ/λ²) e^(−s/λ) (Cₜ⁻¹(t − s) − 1) ds from 0 to age + (ηₚ/λ) e^(−age/λ) (Cₜ⁻¹(t − age) − 1)
    /// ```
    /// By adaptive quadrature in ln s, with its error bound. Histories with kinks are better followed in pieces with
    /// [`advance`](Self::advance).
    ///
    /// # Errors
    /// [`ConstitutiveError::OutOfBounds`] unless 0 < age.
    fn stress_of_history(
        &self,
        strain: impl Fn(f64) -> Symmetric,
        age: f64,
    ) -> Result<Integral<Symmetric>, ConstitutiveError> {
        check_bound(Self::Mode::NAME, "age", age, "0 < age", 0.0 < age)?;
        let modes = self.modes();
        let memory = |s: f64| -> f64 {
            modes.iter().map(|m| m.polymer_viscosity() / m.time() * (-s / m.time()).exp() / m.time()).sum()
        };
        let remembered = integrate(|s| strain(s).components.map(|c| c * memory(s)), age);
        let left: f64 = modes.iter().map(|m| m.polymer_viscosity() / m.time() * (-age / m.time()).exp()).sum();
        let value = Symmetric { components: remembered.value } + strain(age) * left;
        Ok(remembered.within(value, value.norm()))
    }
}

impl<F: DifferentialFluid<Mode: LinearMode> + ?Sized> ConvectedMaxwell for F {}

fn check_flow<F: DifferentialFluid + ?Sized>(shear_rate: f64, time: f64) -> Result<(), ConstitutiveError> {
    check_finite(F::Mode::NAME, "shear rate", shear_rate)?;
    check_bound(F::Mode::NAME, "time", time, "0 ≤ time", 0.0 <= time)
}

/// A stress that is beyond all numbers is refused.
fn bounded<F: DifferentialFluid + ?Sized>(stress: Symmetric, duration: f64) -> Result<Symmetric, ConstitutiveError> {
    if stress.components.iter().all(|x| x.is_finite()) {
        return Ok(stress);
    }
    let (law, quantity) = (F::Mode::NAME, "duration");
    Err(ConstitutiveError::BeyondLimit { law, quantity, value: duration, limit: duration })
}

/// exp(t L − t/(2 λ)).
fn remaining<M: Mode>(mode: &M, velocity_gradient: &VelocityGradient, time: f64) -> [[f64; 3]; 3] {
    let decay = scaled(identity(), 0.5 / mode.time());
    exponential_rows(scaled(difference(velocity_gradient.rows(), decay), time))
}

/// τ after the time t from rest: a series over a short time, doubled by τ(2h) = τ(h) + G(h) τ(h) G(h)ᵀ.
fn from_rest<M: LinearMode>(mode: &M, velocity_gradient: &VelocityGradient, time: f64) -> Symmetric {
    let size = 2.0 * velocity_gradient.0.norm() + mode.time().recip();
    let mut doublings = 0;
    let mut step = time;
    while 0.5 < size * step && doublings < 2000 {
        step /= 2.0;
        doublings += 1;
    }
    // Σ hʲ⁺¹/(j + 1)! Mʲ (2 ηₚ/λ D) with M x = L x + x Lᵀ − x/λ.
    let mut term = velocity_gradient.stretching().0 * (2.0 * mode.polymer_viscosity() / mode.time() * step);
    let mut stress = term;
    for j in 2..24 {
        let next = convected(&term, velocity_gradient) - term * mode.time().recip();
        term = next * (step / f64::from(j));
        stress += term;
    }
    for _ in 0..doublings {
        stress += stress.congruence(remaining(mode, velocity_gradient, step));
        step *= 2.0;
    }
    stress
}
