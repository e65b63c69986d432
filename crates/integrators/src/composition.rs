//! Explicit symplectic compositions of the Störmer–Verlet step, of orders 2, 4, 6 and 8.
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
//! drift.
//!
//! # Which order?
//! Two for games and pictures, four to six for long runs at 1e-6…1e-9, eight when errors near rounding are
//! wanted. The step stays fixed: for close encounters use an adaptive method.
//!
//! # References
//! Order 4: Suzuki, Phys. Lett. A 146 (1990) 319, five stages. Orders 6 (nine stages) and 8 (seventeen):
//! Kahan & Li, Math. Comp. 66 (1997) 1089; also Hairer, Lubich & Wanner, *Geometric Numerical Integration*,
//! V.3.2.

use core::ops::ControlFlow;

use piola_numerics::Real;

use crate::state::{check_finite, check_run, check_step, compensated_add, equal_steps};
use crate::{Ending, IntegratorsError, Report, Separable, State, Step, unobserved};

/// The order of a fixed-step method: the error of a run falls as hᵒʳᵈᵉʳ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Order {
    /// Second order.
    Two,
    /// Fourth order.
    Four,
    /// Sixth order.
    Six,
    /// Eighth order.
    Eight,
}

impl Order {
    /// All orders, ascending.
    pub const ALL: [Self; 4] = [Self::Two, Self::Four, Self::Six, Self::Eight];

    /// The order as a number.
    #[must_use]
    pub const fn value(self) -> u32 {
        match self {
            Self::Two => 2,
            Self::Four => 4,
            Self::Six => 6,
            Self::Eight => 8,
        }
    }

    /// The steps of second order that a step of this order is composed of, in units of the step: γ₁, …, γₛ.
    ///
    /// Any symmetric map of second order may be composed, as a free rotation between two kicks.
    ///
    /// # Example
    /// ```
    /// use piola_integrators::Order;
    /// assert_eq!(Order::Two.substeps().collect::<Vec<_>>(), [1.0]);
    /// // ẋ = v, v̇ = −x by kick, drift, kick: a radian in ten steps of order eight.
    /// let [mut x, mut v] = [1.0_f64, 0.0];
    /// for _ in 0..10 {
    ///     for h in Order::Eight.substeps().map(|part| 0.1 * part) {
    ///         v -= 0.5 * h * x;
    ///         x += h * v;
    ///         v -= 0.5 * h * x;
    ///     }
    /// }
    /// assert!((x - 1.0_f64.cos()).abs() < 1e-11);
    /// ```
    pub fn substeps(self) -> impl Iterator<Item = f64> {
        let half: &[f64] = match self {
            Self::Two => &[],
            Self::Four => &SUZUKI_4,
            Self::Six => &KAHAN_LI_6,
            Self::Eight => &KAHAN_LI_8,
        };
        let middle = 1.0 - 2.0 * half.iter().sum::<f64>();
        half.iter().copied().chain([middle]).chain(half.iter().rev().copied())
    }
}

// First halves of the symmetric coefficient lists; the middle one is 1 − 2 Σ, so that each list sums to one.
const SUZUKI_4: [f64; 2] = [0.414_490_771_794_375_7, 0.414_490_771_794_375_7];
const KAHAN_LI_6: [f64; 4] =
    [0.392_161_444_007_314_1, 0.332_599_136_789_359_44, -0.706_246_172_557_639_4, 0.082_213_596_293_550_8];
const KAHAN_LI_8: [f64; 8] = [
    0.130_202_483_088_890_08,
    0.561_162_981_775_108_4,
    -0.389_474_962_644_847_3,
    0.158_841_906_555_155_6,
    -0.395_903_894_133_237_57,
    0.184_539_640_978_315_7,
    0.258_374_387_686_322_04,
    0.295_011_723_609_310_3,
];

/// The largest number of stages of any order.
const MOST_STAGES: usize = 17;

/// An explicit symplectic composition with a fixed step.
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
    order: Order,
    step: f64,
    stages: usize,
    /// γ₁ … γₛ.
    kicks: [f64; MOST_STAGES],
    rate: Vec<T>,
    /// The step's end and its carry while the step is made; the state is touched only when it is complete.
    next: (Vec<T>, Vec<T>),
}

impl<T: Real> Composition<T> {
    /// A composition of the given order whose steps are no longer than `step` (s).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn new(order: Order, step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        let (mut kicks, mut stages) = ([0.0; MOST_STAGES], 0);
        for (kick, gamma) in kicks.iter_mut().zip(order.substeps()) {
            *kick = gamma;
            stages += 1;
        }
        Ok(Self { order, step, stages, kicks, rate: Vec::new(), next: (Vec::new(), Vec::new()) })
    }

    /// The order.
    #[must_use]
    pub const fn order(&self) -> Order {
        self.order
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
    pub fn integrate_to<F: Separable<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.integrate(field, state, end, unobserved)
    }

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step); backwards if `end` is
    /// earlier than the state's time. The observer sees every step and may stop the run.
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
        let n = field.freedom();
        check_run(2 * n, state, end)?;
        let start = state.time;
        let (steps, h) = equal_steps(start, end, self.step)?;
        self.rate.resize(n, T::zero());
        self.next.0.resize(2 * n, T::zero());
        self.next.1.resize(2 * n, T::zero());
        let mut report = Report::begin();
        for number in 1..=steps {
            self.advance(field, state, h)?;
            core::mem::swap(&mut state.values, &mut self.next.0);
            core::mem::swap(&mut state.carry, &mut self.next.1);
            state.set_time(if number == steps { end } else { start + h * number as f64 });
            report.steps = number;
            report.evaluations += self.stages as u64;
            if observer(Step { number, time: state.time, values: &state.values }).is_break() {
                report.ending = Ending::Stopped;
                break;
            }
        }
        Ok(report)
    }

    /// Makes one step from the state to `next`.
    fn advance<F: Separable<T>>(
        &mut self,
        field: &mut F,
        state: &State<T>,
        h: f64,
    ) -> Result<(), IntegratorsError<F::Error>> {
        let n = self.rate.len();
        let start = state.time;
        let rate = &mut self.rate[..];
        let (q, p) = self.next.0.split_at_mut(n);
        let (q_carry, p_carry) = self.next.1.split_at_mut(n);
        let (q_start, p_start) = state.values.split_at(n);
        let (q_carry_start, p_carry_start) = state.carry.split_at(n);
        // Velocities belong to the ends of the substeps, forces to their middles; both in units of h.
        let (mut reached, mut previous) = (0.0, 0.0);
        for (stage, &gamma) in self.kicks[..self.stages].iter().enumerate() {
            let time = start + reached * h;
            let momentum = if stage == 0 { p_start } else { &*p };
            field.velocity(time, momentum, rate).map_err(|source| IntegratorsError::Field { t: time, source })?;
            let drift = 0.5 * (previous + gamma) * h;
            if stage == 0 {
                update_from((q_start, q_carry_start), q, q_carry, rate, drift);
            } else {
                update(q, q_carry, rate, drift);
            }
            let time = start + (reached + 0.5 * gamma) * h;
            field.force(time, q, rate).map_err(|source| IntegratorsError::Field { t: time, source })?;
            check_finite("rate", Some(start), rate)?;
            if stage == 0 {
                update_from((p_start, p_carry_start), p, p_carry, rate, gamma * h);
            } else {
                update(p, p_carry, rate, gamma * h);
            }
            reached += gamma;
            previous = gamma;
        }
        let time = start + h;
        field.velocity(time, p, rate).map_err(|source| IntegratorsError::Field { t: time, source })?;
        update(q, q_carry, rate, 0.5 * previous * h);
        // A velocity that was infinite or NaN at any stage has left its mark on the position for good.
        check_finite("state", Some(start), q)
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
