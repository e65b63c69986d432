//! Gauss–Legendre collocation of orders 2, 4, 6 and 8: implicit, symplectic, for any field.
//!
//! With s stages, order 2s. The stages are solved for the increments Lᵢ = h bᵢ f(t + cᵢh, Yᵢ):
//!
//! ```text
//! Yᵢ = y + Σⱼ μᵢⱼ Lⱼ        y ← y + Σᵢ Lᵢ        μᵢⱼ = aᵢⱼ/bⱼ,   μᵢⱼ + μⱼᵢ = 1
//! ```
//!
//! The last identity is the condition of symplecticity; it holds for the *stored* coefficients exactly, so
//! rounding of coefficients causes no drift of the energy. All quadratic integrals are kept.
//!
//! # When?
//! For Hamiltonians that do not separate, velocity-dependent forces, and general Lagrangians in their
//! canonical form (q, p): there the map is symplectic. In (q, q̇) it is merely of high order.
//!
//! # References
//! Hairer, Lubich & Wanner, *Geometric Numerical Integration*, II.1.3, VIII.6; the form with μ and the
//! stopping criterion: Antoñana, Makazaga & Murua, Numer. Algor. 76 (2017) 861.

#[expect(clippy::unreadable_literal, reason = "seventeen digits, to be compared with printed tables")]
mod tableaux;

use core::ops::ControlFlow;

use piola_numerics::Real;

use self::tableaux::{STAGES_1, STAGES_2, STAGES_3, STAGES_4, Tableau};
use crate::field::largest_lane;
use crate::state::{check_finite, check_run, check_step, check_sums, compensated_add};
use crate::{Checkpoint, Ending, Field, IntegratorsError, Order, Report, State, Step};

/// The name in a checkpoint.
const NAME: &str = "GaussLegendre";
/// Sweeps over the stages after which a step is given up.
const MOST_SWEEPS: usize = 100;
/// Values that settle in fewer sweeps were at rest.
const FEW_SWEEPS: usize = 4;
/// Most sweeps that bring in derivatives of each order where the values were at rest.
const MOST_SWEEPS_AT_REST: usize = 40;

/// The part of the rounding error of an increment that may be left out of it: in a million steps it adds up to
/// less than rounding does.
const UNROUNDED: f64 = 1e-4;

/// Gauss–Legendre collocation with a fixed step.
///
/// # Accuracy
/// Global error O(hᵒʳᵈᵉʳ). The stages are iterated until rounding stops them; the state is summed with
/// compensation.
///
/// # Example
/// ```
/// use piola_integrators::{GaussLegendre, Order, State, field};
/// // A pendulum in canonical form, H = p²/2 − cos q: the energy returns to rounding.
/// let mut pendulum = field(2, |_t, y: &[f64], rate: &mut [f64]| {
///     rate[0] = y[1];
///     rate[1] = -y[0].sin();
/// });
/// let energy = |y: &[f64]| 0.5 * y[1] * y[1] - y[0].cos();
/// let mut state = State::new(0.0, vec![2.0, 0.0])?;
/// let before = energy(&state.values);
/// GaussLegendre::new(Order::Eight, 0.1)?.integrate_to(&mut pendulum, &mut state, 100.0)?;
/// assert!((energy(&state.values) - before).abs() < 1e-10);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("implicit midpoint", "collocation", "symplectic"))]
#[derive(Clone, Debug)]
pub struct GaussLegendre<T = f64> {
    order: Order,
    step: f64,
    workspace: Workspace<T>,
}

#[derive(Clone, Debug, Default)]
struct Workspace<T> {
    /// L₁ … Lₛ, one after the other.
    increments: Vec<T>,
    guess: Vec<T>,
    stage: Vec<T>,
    rate: Vec<T>,
    magnitudes: Vec<f64>,
    magnitudes_at_last_stage: Vec<f64>,
    /// Whether `increments` belong to the step just before, of the same size.
    continued: bool,
}

impl<T: Real> GaussLegendre<T> {
    /// Collocation of the given order whose steps are no longer than `step` (s).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn new(order: Order, step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        let workspace = Workspace {
            increments: Vec::new(),
            guess: Vec::new(),
            stage: Vec::new(),
            rate: Vec::new(),
            magnitudes: Vec::new(),
            magnitudes_at_last_stage: Vec::new(),
            continued: false,
        };
        Ok(Self { order, step, workspace })
    }

    crate::order_and_step!();

    crate::unobserved_run!(F: Field<T>, field: &mut F, IntegratorsError<F::Error>);

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step); backwards if `end` is
    /// earlier than the state's time. The observer sees every step and may stop the run.
    ///
    /// # Errors
    /// The state does not fit, the field fails or gives a rate that is not finite, or the stages do not
    /// converge ([`IntegratorsError::StagesDiverged`]: take a smaller step). The state then stands at the
    /// last complete step.
    pub fn integrate<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.run(field, None, state, end, observer)
    }

    /// The run where it stands, to be continued by [`resume`](Self::resume): the state and the report of a run of this method that has
    /// ended or that the observer has stopped.
    #[must_use]
    pub fn checkpoint(&self, state: &State<T>, report: Report) -> Checkpoint<T> {
        Checkpoint::of(NAME, state.clone(), report, self.workspace.increments.clone(), Vec::new())
    }

    crate::resumed_run!(<F> [F: Field<T>] field: &mut F, IntegratorsError<F::Error>);

    fn run<F: Field<T>>(
        &mut self,
        field: &mut F,
        resumed: Option<&Checkpoint<T>>,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        match self.order {
            Order::Two => self.run_with(&STAGES_1, field, resumed, state, end, observer),
            Order::Four => self.run_with(&STAGES_2, field, resumed, state, end, observer),
            Order::Six => self.run_with(&STAGES_3, field, resumed, state, end, observer),
            Order::Eight => self.run_with(&STAGES_4, field, resumed, state, end, observer),
        }
    }

    fn run_with<const S: usize, F: Field<T>>(
        &mut self,
        tableau: &Tableau<S>,
        field: &mut F,
        resumed: Option<&Checkpoint<T>>,
        state: &mut State<T>,
        end: f64,
        mut observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        let n = field.dimension();
        match resumed {
            None => check_run(n, state, end)?,
            Some(checkpoint) => checkpoint.open(NAME, [S * n, 0], &[], state, |state| check_run(n, state, end))?,
        }
        let work = &mut self.workspace;
        work.increments.resize(S * n, T::zero());
        work.guess.resize(S * n, T::zero());
        work.stage.resize(S * n, T::zero());
        work.rate.resize(n, T::zero());
        work.magnitudes.resize(n, 0.0);
        work.magnitudes_at_last_stage.resize(n, 0.0);
        work.continued = false;
        if let Some(checkpoint) = resumed {
            work.increments.copy_from_slice(checkpoint.memory().0);
            work.continued = 0 < checkpoint.report().steps;
        }

        let (steps, taken) = state.begin_equal_steps(end, self.step)?;
        let h = steps.length;
        // The increments' weights sum to the step exactly.
        let mut weights = tableau.weights.map(|b| h * b);
        let others: f64 = weights.iter().sum::<f64>() - weights[S / 2];
        weights[S / 2] = h - others;

        let mut report = resumed.map_or(Report::begin(), Checkpoint::report).continued();
        for number in taken + 1..=steps.count {
            report.evaluations += solve_stages(tableau, &weights, h, field, state, work)?;
            for (i, total) in work.rate.iter_mut().enumerate() {
                // The increments of all stages are of one size, and one order is as good as another; what
                // matters is that their sum enters the state compensated.
                *total = work.increments[i];
                for j in 1..S {
                    *total += work.increments[j * n + i];
                }
            }
            check_sums(state.time, &state.values, &work.rate)?;
            for ((y, carry), &total) in state.values.iter_mut().zip(&mut state.carry).zip(&work.rate) {
                compensated_add(y, carry, total);
            }
            work.continued = true;
            state.set_time(steps.time(number));
            report.steps += 1;
            if observer(Step { number: report.steps, time: state.time, values: &state.values }).is_break() {
                report.ending = Ending::Stopped;
                break;
            }
        }
        Ok(report)
    }
}

/// Solves the stage equations by sweeps; returns the number of evaluations. On success `work.increments`
/// hold L₁ … Lₛ.
fn solve_stages<const S: usize, T: Real, F: Field<T>>(
    tableau: &Tableau<S>,
    weights: &[f64; S],
    h: f64,
    field: &mut F,
    state: &State<T>,
    work: &mut Workspace<T>,
) -> Result<u64, IntegratorsError<F::Error>> {
    let n = state.values.len();
    let time = state.time;
    field.magnitudes(&state.values, &mut work.magnitudes);
    let mut evaluations = 0;
    if work.continued {
        for (i, row) in tableau.extrapolation.iter().enumerate() {
            for k in 0..n {
                let mut guess = T::zero();
                for (j, &factor) in row.iter().enumerate() {
                    guess += T::lit(factor) * work.increments[j * n + k];
                }
                work.guess[i * n + k] = guess;
            }
        }
        work.increments.copy_from_slice(&work.guess);
    } else {
        field
            .rate(time, &state.values, &mut work.rate)
            .map_err(|source| IntegratorsError::Field { t: time, source })?;
        evaluations += 1;
        for (increments, &weight) in work.increments.chunks_mut(n.max(1)).zip(weights) {
            for (increment, &rate) in increments.iter_mut().zip(&work.rate) {
                *increment = T::lit(weight) * rate;
            }
        }
    }

    let second_order = field.is_second_order() && n.is_multiple_of(2);
    let half = n / 2;
    let mut previous = f64::INFINITY;
    // Sweeps that bring in derivatives, once the values stand still.
    let mut more = None;
    for sweep in 1..=MOST_SWEEPS + T::ORDER * MOST_SWEEPS_AT_REST {
        let (mut change, mut size, mut is_same) = (0.0_f64, 0.0_f64, true);
        if second_order {
            // q̇ = v is known: take it at the newest velocities of all stages before any force is asked for.
            velocities_to_position_increments(tableau, weights, state, work);
        }
        for (i, &weight) in weights.iter().enumerate() {
            stage_values(tableau, state, work, i, 0..if second_order { half } else { n });
            let stage_time = time + tableau.nodes[i] * h;
            field
                .rate(stage_time, &work.stage[i * n..(i + 1) * n], &mut work.rate)
                .map_err(|source| IntegratorsError::Field { t: stage_time, source })?;
            evaluations += 1;
            check_finite("rate", Some(time), &work.rate)?;
            if i == S - 1 {
                // A start from rest has no magnitude; where the step leads it has one.
                field.magnitudes(&work.stage[i * n..], &mut work.magnitudes_at_last_stage);
                for (largest, &magnitude) in work.magnitudes.iter_mut().zip(&work.magnitudes_at_last_stage) {
                    *largest = largest.max(magnitude);
                }
            }
            for k in if second_order { half } else { 0 }..n {
                let new = T::lit(weight) * work.rate[k];
                let difference = largest_lane(new - work.increments[i * n + k]);
                if 0.0 < difference {
                    change = change.max(difference / work.magnitudes[k]);
                }
                let increment = largest_lane(new);
                if 0.0 < increment {
                    size = size.max(increment / work.magnitudes[k]);
                }
                is_same &= T::ORDER == 0 || new == work.increments[i * n + k];
                work.increments[i * n + k] = new;
            }
        }
        if let Some(left) = &mut more {
            *left -= 1;
            if is_same || *left == 0 {
                break;
            }
            continue;
        }
        // Converged when the next change would be far below the rounding of the increments, since what is
        // left out has the same sign in every step and adds up; or when rounding has stopped the fall.
        let predicted = if previous.is_finite() { change * (change / previous).min(1.0) } else { change };
        let negligible = UNROUNDED * f64::EPSILON * size.min(1.0);
        let stalled = previous <= change || sweep == MOST_SWEEPS;
        if predicted <= negligible && change <= 1e-3 || stalled && change < 64.0 * f64::EPSILON {
            if T::ORDER == 0 {
                break;
            }
            // Derivatives follow the values order by order, a few sweeps behind; values at rest told nothing of their pace.
            more = Some(T::ORDER * if sweep < FEW_SWEEPS { MOST_SWEEPS_AT_REST } else { 2 + sweep / 4 });
        } else if sweep == MOST_SWEEPS {
            return Err(IntegratorsError::StagesDiverged { t: time, step: h, iterations: sweep, change });
        }
        // The first change may be out of proportion: it can be relative to a velocity near rest.
        previous = change.min(1.0);
    }
    if second_order {
        velocities_to_position_increments(tableau, weights, state, work);
    }
    Ok(evaluations)
}

/// The increments of q from the newest velocities of all stages, for fields with q̇ = v.
#[cfg_attr(not(debug_assertions), inline(always))]
fn velocities_to_position_increments<const S: usize, T: Real>(
    tableau: &Tableau<S>,
    weights: &[f64; S],
    state: &State<T>,
    work: &mut Workspace<T>,
) {
    let n = state.values.len();
    let half = n / 2;
    for (i, &weight) in weights.iter().enumerate() {
        stage_values(tableau, state, work, i, half..n);
        for k in 0..half {
            work.increments[i * n + k] = T::lit(weight) * work.stage[i * n + half + k];
        }
    }
}

/// Yᵢ = y + (carry + Σⱼ μᵢⱼ Lⱼ), for some of the components.
#[cfg_attr(not(debug_assertions), inline(always))]
fn stage_values<const S: usize, T: Real>(
    tableau: &Tableau<S>,
    state: &State<T>,
    work: &mut Workspace<T>,
    i: usize,
    components: core::ops::Range<usize>,
) {
    let n = state.values.len();
    for k in components {
        let mut increment = state.carry[k];
        for j in 0..S {
            increment += T::lit(tableau.couplings[i][j]) * work.increments[j * n + k];
        }
        work.stage[i * n + k] = state.values[k] + increment;
    }
}
