//! Explicit symplectic compositions of the Störmer–Verlet step, of orders 2, 4, 6, 8 and 10, and other symmetric splittings.
//!
//! For separable systems q̇ = u(t, p), ṗ = w(t, q). One step of size h composes symmetric second-order
//! steps of sizes γ₁h, …, γₛh, each drift–kick–drift:
//!
//! ```text
//! q ← q + ½γh u(p)      p ← p + γh w(q)      q ← q + ½γh u(p)
//! ```
//!
//! Neighbouring drifts merge, so a step costs s forces. The map is symplectic, time-symmetric and keeps
//! linear and, with q̇ = p, angular momentum exactly but for rounding; the energy oscillates and does not
//! drift. [`SplittingScheme`](crate::SplittingScheme) lists what else runs in this loop.
//!
//! # Which order?
//! Two for games and pictures, four to six for long runs at 1e-6…1e-9, eight or ten when errors near rounding are
//! wanted. Where q̇ = M⁻¹p, Runge–Kutta–Nyström splittings need fewer forces. The step stays fixed: for
//! close encounters use an adaptive method.
//!
//! # References
//! Order 4: Suzuki, Phys. Lett. A 146 (1990) 319, five stages. Orders 6 (nine stages) and 8 (seventeen):
//! Kahan & Li, Math. Comp. 66 (1997) 1089; also Hairer, Lubich & Wanner, *Geometric Numerical Integration*,
//! V.3.2.

use core::ops::ControlFlow;

use piola_numerics::Real;

use crate::splitting::{MOST_STAGES, SplittingStage};
use crate::state::{check_finite, check_run, check_step, compensated_add};
use crate::{Ending, IntegratorsError, Order, Report, Separable, SplittingScheme, State, Step};

/// An explicit symplectic composition, or another [`SplittingScheme`], with a fixed step.
///
/// # Accuracy
/// Global error O(hᵒʳᵈᵉʳ); the state and its increments are summed with compensation, so that rounding
/// grows as √N ulp at worst.
///
/// # Example
/// ```
/// use piola_integrators::{Composition, Order, State, separable};
/// let mut kepler = separable(2, |_t, q: &[f64], force: &mut [f64]| {
///     let cube = (q[0] * q[0] + q[1] * q[1]).powf(1.5);
///     force[0] = -q[0] / cube;
///     force[1] = -q[1] / cube;
/// });
/// let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 1.0])?; // a circle of period 2π
/// let period = 2.0 * std::f64::consts::PI;
/// let mut method = Composition::new(Order::Eight, period / 100.0)?;
/// let report = method.integrate_to(&mut kepler, &mut state, period)?;
/// assert_eq!((report.steps, report.evaluations), (100, 1700));
/// assert!((state.values[0] - 1.0).abs() < 1e-12);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("Verlet", "leapfrog", "Yoshida", "symplectic"))]
#[derive(Clone, Debug)]
pub struct Composition<T = f64> {
    scheme: SplittingScheme,
    step: f64,
    splitter: Splitter<T>,
}

/// The steps of a splitting, and the memory of a run.
#[derive(Clone, Debug)]
pub(crate) struct Splitter<T = f64> {
    stages: [SplittingStage; MOST_STAGES],
    count: usize,
    rate: Vec<T>,
    /// The force at the end of a step that ends with a kick: the next one begins with it.
    force: Vec<T>,
    /// Whether `force` belongs to the state.
    continued: bool,
    /// The step's end and its carry while the step is made; the state is touched only when it is complete.
    next: (Vec<T>, Vec<T>),
}

impl<T: Real> Composition<T> {
    /// A composition of the given order whose steps are no longer than `step` (s).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn new(order: Order, step: f64) -> Result<Self, IntegratorsError> {
        Self::with_scheme(SplittingScheme::Composition(order), step)
    }

    /// Another splitting, whose steps are no longer than `step` (s).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    ///
    /// # Example
    /// ```
    /// use piola_integrators::{Composition, SplittingScheme, State, separable};
    /// let mut pendulum = separable(1, |_t, q: &[f64], force: &mut [f64]| force[0] = -q[0].sin());
    /// let mut state = State::new(0.0, vec![1.0, 0.0])?;
    /// let mut method = Composition::with_scheme(SplittingScheme::Nystrom6, 0.25)?;
    /// let report = method.integrate_to(&mut pendulum, &mut state, 100.0)?;
    /// assert_eq!(report.evaluations, 400 * 11 + 1); // eleven a step, and one to begin with
    /// let energy = 0.5 * state.values[1].powi(2) - state.values[0].cos();
    /// assert!((energy + 1.0_f64.cos()).abs() < 2e-10);
    /// # Ok::<(), piola_integrators::IntegratorsError>(())
    /// ```
    pub fn with_scheme(scheme: SplittingScheme, step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        Ok(Self { scheme, step, splitter: Splitter::new(scheme.table()) })
    }

    /// The splitting.
    #[must_use]
    pub const fn scheme(&self) -> SplittingScheme {
        self.scheme
    }

    crate::longest_step!();

    crate::unobserved_run!(F: Separable<T>, field: &mut F, IntegratorsError<F::Error>);

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step); backwards if `end` is
    /// earlier than the state's time. The observer sees every step and may stop the run. Continued to the same end, a
    /// stopped run goes on with the same steps, to the last bit.
    ///
    /// # Errors
    /// The state does not fit or is not finite, the step is too small to advance the time, or the field fails
    /// or gives a rate that is not finite. The state then stands at the last complete step.
    pub fn integrate<F: Separable<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        mut observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        check_run(2 * field.freedom(), state, end)?;
        let (steps, taken) = state.begin_equal_steps(end, self.step)?;
        self.splitter.begin(field.freedom());
        let mut report = Report::begin();
        for number in 1..=steps.count - taken {
            let time = steps.time(taken + number);
            report.evaluations += self.splitter.advance(field, state, steps.length, time)?;
            state.set_time(time);
            report.steps = number;
            if observer(Step { number, time: state.time, values: &state.values }).is_break() {
                report.ending = Ending::Stopped;
                break;
            }
        }
        Ok(report)
    }

    /// Begins a run of n degrees of freedom.
    #[doc(hidden)]
    pub fn begin(&mut self, n: usize) {
        self.splitter.begin(n);
    }

    /// Makes one step: see [`Splitter::advance`].
    #[doc(hidden)]
    pub fn advance<F: Separable<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        h: f64,
        end: f64,
    ) -> Result<u64, IntegratorsError<F::Error>> {
        self.splitter.advance(field, state, h, end)
    }
}

impl<T: Real> Splitter<T> {
    pub(crate) const fn new((stages, count): ([SplittingStage; MOST_STAGES], usize)) -> Self {
        let next = (Vec::new(), Vec::new());
        Self { stages, count, rate: Vec::new(), force: Vec::new(), continued: false, next }
    }

    /// Begins a run of n degrees of freedom.
    pub(crate) fn begin(&mut self, n: usize) {
        self.rate.resize(n, T::zero());
        self.force.resize(n, T::zero());
        self.continued = false;
        self.next.0.resize(2 * n, T::zero());
        self.next.1.resize(2 * n, T::zero());
    }

    /// Makes one step of length h, which ends at the time `end`, of a run that was begun, on the state's values; the caller sets the
    /// state's time to `end`. Returns the number of evaluations of the force.
    ///
    /// # Errors
    /// The field fails or gives a rate that is not finite; the state is then left alone.
    pub(crate) fn advance<F: Separable<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        h: f64,
        end: f64,
    ) -> Result<u64, IntegratorsError<F::Error>> {
        let evaluations = self.make_step(field, state, h, end).inspect_err(|_| self.continued = false)?;
        core::mem::swap(&mut state.values, &mut self.next.0);
        core::mem::swap(&mut state.carry, &mut self.next.1);
        Ok(evaluations)
    }

    /// Makes one step from the state to `next`.
    fn make_step<F: Separable<T>>(
        &mut self,
        field: &mut F,
        state: &State<T>,
        h: f64,
        end: f64,
    ) -> Result<u64, IntegratorsError<F::Error>> {
        let n = self.rate.len();
        let (start, kicks) = (state.time, self.count - 1);
        // The end of a step and the start of the next are one moment: a force that is kept is that of a run begun anew.
        let moment = |part: f64| if part.total_cmp(&1.0).is_eq() { end } else { start + part * h };
        let (rate, force) = (&mut self.rate[..], &mut self.force[..]);
        let (q, p) = self.next.0.split_at_mut(n);
        let (q_carry, p_carry) = self.next.1.split_at_mut(n);
        let (q_start, p_start) = state.values.split_at(n);
        let (q_carry_start, p_carry_start) = state.carry.split_at(n);
        let kick_first = self.stages[0].drift.abs() <= 0.0;
        let mut evaluations = kicks as u64;
        // Velocities belong to the moments of the kicks that are done, forces to those of the drifts.
        for (number, &SplittingStage { drift, kick, drift_time, kick_time }) in self.stages[..kicks].iter().enumerate()
        {
            if number == 0 && kick_first {
                q.copy_from_slice(q_start);
                q_carry.copy_from_slice(q_carry_start);
            } else {
                let t = moment(drift_time);
                let momentum = if number == 0 { p_start } else { &*p };
                field.velocity(t, momentum, rate).map_err(|source| IntegratorsError::Field { t, source })?;
                if number == 0 {
                    update_from((q_start, q_carry_start), q, q_carry, rate, drift * h);
                } else {
                    update(q, q_carry, rate, drift * h);
                }
            }
            if number == 0 && kick_first && self.continued {
                evaluations -= 1;
            } else {
                let t = moment(kick_time);
                field.force(t, q, force).map_err(|source| IntegratorsError::Field { t, source })?;
                check_finite("rate", Some(start), force)?;
            }
            if number == 0 {
                update_from((p_start, p_carry_start), p, p_carry, force, kick * h);
            } else {
                update(p, p_carry, force, kick * h);
            }
        }
        self.continued = kick_first;
        if !kick_first {
            let SplittingStage { drift, drift_time, .. } = self.stages[kicks];
            let t = moment(drift_time);
            field.velocity(t, p, rate).map_err(|source| IntegratorsError::Field { t, source })?;
            update(q, q_carry, rate, drift * h);
        }
        // A velocity that was infinite or NaN at any stage has left its mark on the position for good.
        check_finite("state", Some(start), q)?;
        Ok(evaluations)
    }
}

/// y ← y + h ẏ with compensation.
#[cfg_attr(not(debug_assertions), inline(always))]
fn update<T: Real>(y: &mut [T], carry: &mut [T], rate: &[T], h: f64) {
    let h = T::lit(h);
    for ((y, carry), &rate) in y.iter_mut().zip(carry).zip(rate) {
        compensated_add(y, carry, rate * h);
    }
}

/// y ← y₀ + h ẏ with compensation.
#[cfg_attr(not(debug_assertions), inline(always))]
fn update_from<T: Real>((start, carry_start): (&[T], &[T]), y: &mut [T], carry: &mut [T], rate: &[T], h: f64) {
    let h = T::lit(h);
    for ((((y, carry), &start), &carry_start), &rate) in y.iter_mut().zip(carry).zip(start).zip(carry_start).zip(rate) {
        (*y, *carry) = (start, carry_start);
        compensated_add(y, carry, rate * h);
    }
}
