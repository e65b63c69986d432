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
use piola_integrators::{IntegratorsError, Report, State, Step, longest_step, unobserved_run};
use piola_numerics::Real;

use super::run::{Trial, check_start, equal_steps_on_a_group, evaluate};
use super::{GroupField, LieGroup};
use crate::fixed_step::take_equal_steps;

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

    longest_step!();

    equal_steps_on_a_group!();

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
