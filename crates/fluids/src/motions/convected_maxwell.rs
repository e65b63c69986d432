//! The exact answers of the fluids of Maxwell and Oldroyd in every motion.
//!
//! ```text
//! λ (τ̇ − L τ − τ Lᵀ) + τ = 2 ηₚ D      τ(t) = ∫ (ηₚ/λ²) exp(−s/λ) (Cₜ⁻¹(t − s) − 1) ds
//! ```

use piola_continuum::rates::{RelativeDeformation, VelocityGradient, exponential_rows, logarithm};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::internal::excess_of_exponential;
use piola_tensor::internal::rows::{difference, identity, scaled};

use super::quadrature::integrate;
use super::shear_stresses::ShearStresses;
use super::stress_rate::convected;
use crate::error::{check_bound, check_finite};
use crate::{DifferentialFluid, FluidsError, Integral, LinearMode, Mode, ViscometricFluid};

/// The exact answers of the fluids of Maxwell and Oldroyd, of one mode or of several.
///
/// # Example
/// ```
/// use piola_fluids::{ConvectedMaxwell, OldroydB, SteadyStress};
/// use piola_continuum::rates::VelocityGradient;
/// let fluid = OldroydB::new(0.25, 1.5, 0.75)?;
/// let shear = VelocityGradient::from_rows([[0.0; 3], [0.5, 0.0, 0.0], [0.0; 3]])?;
/// assert_eq!(fluid.steady_stress(&shear)?.components, [0.0, 0.5625, 0.0, 0.875, 0.0, 0.0]);
/// let after = fluid.cessation(0.5, 0.75)?; // after one λ
/// assert_eq!(after.shear, 0.75 * (-1.0_f64).exp());
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
pub trait ConvectedMaxwell: DifferentialFluid<Mode: LinearMode> {
    /// The stresses at the time t after the start of shear at the rate k from rest.
    ///
    /// ```text
    /// T₁₂ = ηₛ k + Σ ηₚ k (1 − e^(−t/λ))      N₁ = Σ 2 ηₚ λ k² (1 − e^(−t/λ) (1 + t/λ))
    /// ```
    ///
    /// # Errors
    /// [`FluidsError::NotFinite`]; [`FluidsError::OutOfBounds`] unless 0 ≤ t.
    ///
    /// # Accuracy
    /// 8 ulp of each, for t/λ → 0 too.
    fn start_up(&self, shear_rate: f64, t: f64) -> Result<ShearStresses, FluidsError> {
        check_flow::<Self>(shear_rate, t)?;
        let started = if 0.0 < t { 1.0 } else { 0.0 };
        let mut stresses =
            ShearStresses { shear: started * self.total_solvent_viscosity() * shear_rate, ..ShearStresses::default() };
        for mode in self.modes() {
            let x = t / mode.time();
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
    fn cessation(&self, shear_rate: f64, t: f64) -> Result<ShearStresses, FluidsError> {
        check_flow::<Self>(shear_rate, t)?;
        let mut stresses = ShearStresses::default();
        for mode in self.modes() {
            let left = mode.polymer_viscosity() * shear_rate * (-t / mode.time()).exp();
            stresses.shear += left;
            stresses.first += 2.0 * left * (mode.time() * shear_rate);
        }
        Ok(stresses)
    }

    /// T + p 1, Pa, at the time t after the start, from rest, of a motion with the constant velocity gradient L; of the solvent
    /// from 0 < t.
    ///
    /// # Errors
    /// [`FluidsError::OutOfBounds`] unless 0 ≤ t; [`FluidsError::BeyondLimit`] where the stress is beyond all
    /// numbers.
    ///
    /// # Accuracy
    /// 32 ulp of its norm for |L| t ≤ 1; beyond, that of exp(L t).
    fn start_up_stress(&self, velocity_gradient: &VelocityGradient, t: f64) -> Result<Symmetric, FluidsError> {
        check_flow::<Self>(0.0, t)?;
        let started = if 0.0 < t { 2.0 * self.total_solvent_viscosity() } else { 0.0 };
        let mut total = velocity_gradient.rate_of_deformation().0 * started;
        for mode in self.modes() {
            total += bounded::<Self>(from_rest(mode, velocity_gradient, t), t)?;
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
    ) -> Result<(), FluidsError> {
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
    /// [`FluidsError::OutOfBounds`] unless the times grow; [`FluidsError::Continuum`] where two samples are half a
    /// turn or more apart; as [`advance`](Self::advance).
    fn advance_through(
        &self,
        memory: &mut [Symmetric],
        samples: &[(f64, DeformationGradient)],
    ) -> Result<(), FluidsError> {
        for pair in samples.windows(2) {
            let [(before, first), (t, second)] = pair else { continue };
            check_bound(Self::Mode::NAME, "time", *t, "each time is later than the one before", before < t)?;
            let step = RelativeDeformation::of(first, second)?;
            let velocity_gradient = VelocityGradient::new(logarithm(step.displacement.matrix())? / (t - before))?;
            self.advance(memory, &velocity_gradient, t - before)?;
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
    /// [`FluidsError::OutOfBounds`] unless 0 < age.
    fn stress_of_history(
        &self,
        strain: impl Fn(f64) -> Symmetric,
        age: f64,
    ) -> Result<Integral<Symmetric>, FluidsError> {
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

fn check_flow<F: DifferentialFluid + ?Sized>(shear_rate: f64, t: f64) -> Result<(), FluidsError> {
    check_finite(F::Mode::NAME, "shear rate", shear_rate)?;
    check_bound(F::Mode::NAME, "time", t, "0 ≤ time", 0.0 <= t)
}

/// A stress that is beyond all numbers is refused.
fn bounded<F: DifferentialFluid + ?Sized>(stress: Symmetric, duration: f64) -> Result<Symmetric, FluidsError> {
    if stress.components.iter().all(|x| x.is_finite()) {
        return Ok(stress);
    }
    let (law, quantity) = (F::Mode::NAME, "duration");
    Err(FluidsError::BeyondLimit { law, quantity, value: duration, limit: duration })
}

/// exp(t L − t/(2 λ)).
fn remaining<M: Mode>(mode: &M, velocity_gradient: &VelocityGradient, t: f64) -> [[f64; 3]; 3] {
    let decay = scaled(identity(), 0.5 / mode.time());
    exponential_rows(scaled(difference(velocity_gradient.rows(), decay), t))
}

/// τ after the time t from rest: a series over a short time, doubled by τ(2h) = τ(h) + G(h) τ(h) G(h)ᵀ.
fn from_rest<M: LinearMode>(mode: &M, velocity_gradient: &VelocityGradient, t: f64) -> Symmetric {
    let size = 2.0 * velocity_gradient.0.norm() + mode.time().recip();
    let mut doublings = 0;
    let mut step = t;
    while 0.5 < size * step && doublings < 2000 {
        step /= 2.0;
        doublings += 1;
    }
    // Σ hʲ⁺¹/(j + 1)! Mʲ (2 ηₚ/λ D) with M x = L x + x Lᵀ − x/λ.
    let mut term = velocity_gradient.rate_of_deformation().0 * (2.0 * mode.polymer_viscosity() / mode.time() * step);
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
