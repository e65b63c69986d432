//! The commutator-free method of order 4: explicit, by exponentials alone.
//!
//! ```text
//! g₂ = g exp ½h k₁      g₃ = g exp ½h k₂      g₄ = g₂ exp h(k₃ − ½k₁)          kᵢ = ξ(t + cᵢh, gᵢ),  g₁ = g
//! g ← g exp ¹⁄₁₂h(3k₁ + 2k₂ + 2k₃ − k₄) exp ¹⁄₁₂h(−k₁ + 2k₂ + 2k₃ + 3k₄)
//! ```
//!
//! # References
//! E. Celledoni, A. Marthinsen & B. Owren, *Commutator-free Lie group methods*, Future Gener. Comput. Syst. 19 (2003) 341.

use core::ops::ControlFlow;

use piola_integrators::internal::check_step;
use piola_integrators::{IntegratorsError, Report, State, Step, unobserved};
use piola_numerics::Real;

use super::run::{Trial, check_start, evaluate};
use super::{GroupField, LieGroup};
use crate::fixed_step::take_checked_steps;

/// The commutator-free method of order 4 with a fixed step: four evaluations and six exponentials a step.
///
/// It needs nothing of the group but the exponential, and has no singular angle: a step may turn by any angle that the
/// accuracy allows. On [`Translations`](crate::Translations) it is Kutta's classical method.
///
/// # Accuracy
/// Global error O(h⁴). The element is multiplied with compensation.
///
/// # Example
/// See [`group_field`](crate::group_field).
#[doc(alias("CF4", "Lie group integrator"))]
#[derive(Clone, Debug)]
pub struct CommutatorFree<T = f64> {
    step: f64,
    stages: [Vec<T>; 4],
    displacement: Vec<T>,
    trial: Trial<T>,
}

impl<T: Real> CommutatorFree<T> {
    /// The method whose steps are no longer than `step` (s).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn new(step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        Ok(Self { step, stages: core::array::from_fn(|_| Vec::new()), displacement: Vec::new(), trial: Trial::new() })
    }

    /// The longest step, s.
    #[must_use]
    pub const fn step(&self) -> f64 {
        self.step
    }

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step), unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<F: GroupField<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.integrate(field, state, end, unobserved)
    }

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step); backwards if `end` is earlier than the
    /// state's time. The observer sees every step and may stop the run.
    ///
    /// # Errors
    /// As [`MuntheKaas::integrate`](crate::MuntheKaas::integrate).
    pub fn integrate<F: GroupField<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        check_start(field.group(), 0, state, end)?;
        let dimension = field.group().dimension();
        for vector in self.stages.iter_mut().chain([&mut self.displacement]) {
            vector.resize(dimension, T::zero());
        }
        self.trial.resize(state.values.len());
        take_checked_steps(self.step, state, end, observer, |state, h| self.advance(field, state, h))
    }

    /// Makes one step; the state changes only when it is complete.
    fn advance<F: GroupField<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        h: f64,
    ) -> Result<u64, IntegratorsError<F::Error>> {
        let Self { stages: k, displacement, trial, .. } = self;
        let (start, half) = (state.time, state.time + 0.5 * h);
        trial.begin(state);
        evaluate(field, start, start, &trial.element, &mut k[0])?;

        combine([0.5, 0.0, 0.0, 0.0], k, h, displacement);
        trial.advance(field.group(), displacement);
        evaluate(field, start, half, &trial.element, &mut k[1])?;

        trial.begin(state);
        combine([0.0, 0.5, 0.0, 0.0], k, h, displacement);
        trial.advance(field.group(), displacement);
        evaluate(field, start, half, &trial.element, &mut k[2])?;

        trial.begin(state);
        combine([0.5, 0.0, 0.0, 0.0], k, h, displacement);
        trial.advance(field.group(), displacement);
        combine([-0.5, 0.0, 1.0, 0.0], k, h, displacement);
        trial.advance(field.group(), displacement);
        evaluate(field, start, start + h, &trial.element, &mut k[3])?;

        trial.begin(state);
        combine([0.25, 1.0 / 6.0, 1.0 / 6.0, -1.0 / 12.0], k, h, displacement);
        trial.advance(field.group(), displacement);
        combine([-1.0 / 12.0, 1.0 / 6.0, 1.0 / 6.0, 0.25], k, h, displacement);
        trial.advance(field.group(), displacement);
        trial.accept(field.group(), state)?;
        Ok(4)
    }
}

/// θ = h Σᵢ wᵢ kᵢ. A weight of zero leaves its stage out: it may hold what an earlier run has left.
#[cfg_attr(not(debug_assertions), inline(always))]
fn combine<T: Real>(weights: [f64; 4], stages: &[Vec<T>; 4], h: f64, displacement: &mut [T]) {
    displacement.fill(T::zero());
    for (&weight, stage) in weights.iter().zip(stages) {
        if 0.0 < weight.abs() {
            let weight = T::lit(weight * h);
            for (sum, &k) in displacement.iter_mut().zip(stage) {
                *sum += weight * k;
            }
        }
    }
}
