//! Runge–Kutta–Munthe-Kaas methods of orders 2, 4, 6 and 8: explicit.
//!
//! ```text
//! θᵢ = h Σⱼ aᵢⱼ kⱼ        kᵢ = dexp⁻¹_{−θᵢ} ξ(t + cᵢh, g exp θᵢ)        g ← g exp(h Σᵢ bᵢ kᵢ)
//! ```
//!
//! # References
//! H. Munthe-Kaas, *High order Runge–Kutta methods on manifolds*, Appl. Numer. Math. 29 (1999) 115.

use core::ops::ControlFlow;

use piola_integrators::internal::check_step;
use piola_integrators::{IntegratorsError, Order, Report, State, Step, order_and_step, unobserved_run};
use piola_numerics::Real;

use super::run::{Trial, check_start, equal_steps_on_a_group, evaluate};
use super::tableaux::{DORMAND_PRINCE_8, HALF_STEP_2, KUTTA_4, Row, SIX, Tableau};
use super::{GroupField, LieGroup};
use crate::fixed_step::take_equal_steps;

/// A Runge–Kutta–Munthe-Kaas method with a fixed step.
///
/// The differential of the exponential is inverted exactly, so that the order is that of the tableau:
///
/// | order | tableau | evaluations a step |
/// |---|---|---|
/// | 2 | explicit midpoint | 2 |
/// | 4 | Kutta's classical | 4 |
/// | 6 | Butcher's | 7 |
/// | 8 | Dormand and Prince's, of the pair 8(5,3) | 12 |
///
/// A step must turn by less than one turn, and well by less than half a turn. [`AdaptiveMuntheKaas`](crate::AdaptiveMuntheKaas)
/// chooses its steps.
///
/// # Accuracy
/// Global error O(hᵒʳᵈᵉʳ). The element is multiplied with compensation. On [`Translations`](crate::Translations) it is the
/// classical method. It is not symplectic: the energy drifts as the error does.
///
/// # Example
/// ```
/// use piola_geometric::{MuntheKaas, Rotations, group_field};
/// use piola_integrators::{Order, State};
/// // At 1 rad/s about an axis that turns in the body: q is known in closed form.
/// let mut field = group_field(Rotations, |t: f64, _q: &[f64], omega: &mut [f64]| {
///     omega.copy_from_slice(&[t.cos(), -t.sin(), 0.0]);
/// });
/// let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0])?;
/// MuntheKaas::new(Order::Six, 0.05)?.integrate_to(&mut field, &mut state, 2.0)?;
/// // q = exp((1, 0, −1) t) exp((0, 0, 1) t), of which the first turns by √2 t.
/// let (s, c) = 2.0_f64.sqrt().sin_cos();
/// let w = c * 1.0_f64.cos() + s / 2.0_f64.sqrt() * 1.0_f64.sin();
/// assert!((state.values[0] - w).abs() < 1e-10);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("RKMK", "Runge-Kutta", "Lie group integrator"))]
#[derive(Clone, Debug)]
pub struct MuntheKaas<T = f64> {
    order: Order,
    step: f64,
    /// k₁ … kₛ.
    stages: Vec<Vec<T>>,
    displacement: Vec<T>,
    trial: Trial<T>,
}

impl<T: Real> MuntheKaas<T> {
    /// The method of the given order whose steps are no longer than `step` (s).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn new(order: Order, step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        let stages = vec![Vec::new(); tableau(order).rows.len()];
        Ok(Self { order, step, stages, displacement: Vec::new(), trial: Trial::new() })
    }

    order_and_step!();

    equal_steps_on_a_group!();

    /// Makes one step; the state changes only when it is complete.
    fn advance<F: GroupField<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        h: f64,
    ) -> Result<u64, IntegratorsError<F::Error>> {
        let tableau = tableau(self.order);
        let Self { stages, displacement, trial, .. } = self;
        evaluate(field, state.time, state.time, &state.values, &mut stages[0])?;
        make_stages(tableau, field, state, h, (stages, displacement, trial))?;
        trial.accept(field.group(), state)?;
        Ok(tableau.rows.len() as u64)
    }
}

/// Makes the stages k₂ … kₛ of a step from k₁, and the end of the step in `trial`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn make_stages<T: Real, F: GroupField<T>>(
    tableau: &Tableau,
    field: &mut F,
    state: &State<T>,
    h: f64,
    (stages, displacement, trial): (&mut [Vec<T>], &mut [T], &mut Trial<T>),
) -> Result<(), IntegratorsError<F::Error>> {
    for (i, (row, c)) in tableau.rows.iter().zip(tableau.nodes).enumerate().skip(1) {
        combine(row, stages, h, displacement);
        trial.begin(state);
        trial.advance(field.group(), displacement);
        evaluate(field, state.time, state.time + c * h, &trial.element, &mut stages[i])?;
        field.group().inverse_differential(displacement, &mut stages[i]);
    }
    combine(tableau.weights, stages, h, displacement);
    trial.begin(state);
    trial.advance(field.group(), displacement);
    Ok(())
}

const fn tableau(order: Order) -> &'static Tableau {
    match order {
        Order::Two => &HALF_STEP_2,
        Order::Four => &KUTTA_4,
        Order::Six => &SIX,
        Order::Eight => &DORMAND_PRINCE_8,
    }
}

/// θ = h Σⱼ aⱼ kⱼ.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn combine<T: Real>(row: Row, stages: &[Vec<T>], h: f64, displacement: &mut [T]) {
    displacement.fill(T::zero());
    for &(stage, weight) in row {
        let weight = T::lit(weight);
        for (sum, &k) in displacement.iter_mut().zip(&stages[stage]) {
            *sum += weight * k;
        }
    }
    let h = T::lit(h);
    for sum in displacement {
        *sum *= h;
    }
}
