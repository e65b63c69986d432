//! The state of a run, updated with compensation; its checks, and its division into equal steps.

use piola_numerics::Real;
use piola_numerics::sums::two_sum;

use crate::IntegratorsError;
use crate::field::largest_lane;

/// A time and a state, each with the rounding error that the last updates left behind.
///
/// Updates are compensated: the low part of every increment is carried to the next step, so that after N
/// steps the rounding error of the sum is of the order of one ulp instead of √N or N.
///
/// Time and values may be changed between runs; the carry, at most half an ulp of the old value, is then
/// still added. Where that matters make a new state.
///
/// A run of equal steps that an observer stopped goes on with the same steps, to the last bit, when the same method continues it to
/// the same end: the state knows its steps, also after it was written and read (feature `serde`). This holds for methods that keep
/// nothing but the state from step to step: [`Composition`](crate::Composition), and in `piola-geometric` `MuntheKaas` and
/// `CommutatorFree`. Methods with `resume` need a [`Checkpoint`](crate::Checkpoint); the rest go on to rounding.
///
/// # Example
/// ```
/// use piola_integrators::State;
/// let state = State::new(0.0, vec![1.0, 0.0])?;
/// assert_eq!(state.values, [1.0, 0.0]);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Unchecked<T>", into = "Unchecked<T>"))]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>"))
)]
pub struct State<T = f64> {
    /// The time t, s.
    pub time: f64,
    /// The components y; for a mechanical system positions first, then velocities or momenta.
    pub values: Vec<T>,
    /// What rounding left of the last updates: y + carry is the compensated state.
    #[doc(hidden)]
    pub carry: Vec<T>,
    pub(crate) time_carry: f64,
    /// The last run of equal steps: it may have been stopped.
    pub(crate) run: Option<Run>,
}

/// What a run of equal steps was asked for.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub(crate) struct Run {
    start: f64,
    end: f64,
    /// The longest step.
    longest: f64,
}

/// Equal steps from one time to another.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct EqualSteps {
    start: f64,
    end: f64,
    /// The step, s.
    pub length: f64,
    /// Their number.
    pub count: u64,
}

impl EqualSteps {
    /// The fewest that are no longer than was asked for.
    fn of<E>(Run { start, end, longest }: Run) -> Result<Self, IntegratorsError<E>> {
        let (count, length) = equal_steps(start, end, longest)?;
        Ok(Self { start, end, length, count })
    }

    /// The time at the end of a step, counted from 1.
    #[must_use]
    pub fn time(&self, number: u64) -> f64 {
        if number == self.count { self.end } else { self.start + self.length * number as f64 }
    }

    /// The steps that are behind a time, if it ends one of them.
    fn behind(&self, time: f64) -> Option<u64> {
        let steps = ((time - self.start) / self.length).round();
        if !(0.0 < steps && steps < self.count as f64) {
            return None;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and a count")]
        let steps = steps as u64;
        self.time(steps).total_cmp(&time).is_eq().then_some(steps)
    }
}

/// States are equal whose times and values are, whatever runs made them.
impl<T: PartialEq> PartialEq for State<T> {
    fn eq(&self, other: &Self) -> bool {
        let are_same_times = self.time.eq(&other.time) && self.time_carry.eq(&other.time_carry);
        are_same_times && self.values == other.values && self.carry == other.carry
    }
}

impl<T: Real> State<T> {
    /// A state at a time.
    ///
    /// # Errors
    /// [`IntegratorsError::NotFinite`].
    pub fn new(t: f64, values: Vec<T>) -> Result<Self, IntegratorsError> {
        let carry = vec![T::zero(); values.len()];
        let state = Self { time: t, values, carry, time_carry: 0.0, run: None };
        state.check()?;
        Ok(state)
    }

    fn check<E>(&self) -> Result<(), IntegratorsError<E>> {
        check_time("t", self.time)?;
        check_finite("state", None, &self.values)
    }

    #[doc(hidden)]
    #[must_use]
    pub fn remaining(&self, end: f64) -> f64 {
        (end - self.time) - self.time_carry
    }

    /// The time after a step, as [`advance_time`](Self::advance_time) leaves it.
    #[doc(hidden)]
    #[must_use]
    pub fn time_after(&self, step: f64) -> f64 {
        let (mut time, mut carry) = (self.time, self.time_carry);
        compensated_add(&mut time, &mut carry, step);
        time
    }

    #[doc(hidden)]
    pub fn advance_time(&mut self, step: f64) {
        compensated_add(&mut self.time, &mut self.time_carry, step);
    }

    /// The fewest equal steps to `end` that are no longer than `longest`, and how many of them were taken: those of the run that the
    /// state is in, if it was to the same end with the same longest step.
    ///
    /// # Errors
    /// As [`equal_steps`].
    #[doc(hidden)]
    pub fn begin_equal_steps<E>(&mut self, end: f64, longest: f64) -> Result<(EqualSteps, u64), IntegratorsError<E>> {
        let is_same = |run: &Run| run.end.total_cmp(&end).is_eq() && run.longest.total_cmp(&longest).is_eq();
        if let Some(run) = self.run.filter(is_same).filter(|_| self.time_carry.abs() <= 0.0) {
            let steps = EqualSteps::of(run)?;
            if let Some(taken) = steps.behind(self.time) {
                return Ok((steps, taken));
            }
        }
        let run = Run { start: self.time, end, longest };
        let steps = EqualSteps::of(run)?;
        self.run = Some(run);
        Ok((steps, 0))
    }

    #[doc(hidden)]
    pub fn set_time(&mut self, time: f64) {
        self.time = time;
        self.time_carry = 0.0;
    }
}

/// A state as it is written, with the carry that makes a continued run bit-identical to an unbroken one.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked<T> {
    time: f64,
    values: Vec<T>,
    carry: Vec<T>,
    time_carry: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    run: Option<Run>,
}

#[cfg(feature = "serde")]
impl<T: Real> TryFrom<Unchecked<T>> for State<T> {
    type Error = IntegratorsError;
    fn try_from(unchecked: Unchecked<T>) -> Result<Self, IntegratorsError> {
        let Unchecked { time, values, carry, time_carry, run } = unchecked;
        if carry.len() != values.len() {
            let (expected, found) = (values.len(), carry.len());
            return Err(IntegratorsError::WrongLength { quantity: "carry", expected, found });
        }
        check_finite("carry", None, &carry)?;
        check_time("time_carry", time_carry)?;
        if let Some(run) = run {
            check_time("run.start", run.start)?;
            check_time("run.end", run.end)?;
            check_step(run.longest)?;
            EqualSteps::of(run)?;
        }
        Ok(Self { carry, time_carry, run, ..Self::new(time, values)? })
    }
}

#[cfg(feature = "serde")]
impl<T> From<State<T>> for Unchecked<T> {
    fn from(state: State<T>) -> Self {
        let State { time, values, carry, time_carry, run } = state;
        Self { time, values, carry, time_carry, run }
    }
}

/// y + carry ← y + carry + increment, where y alone is the rounded value.
///
/// The exact sum of two numbers of any size is wanted, not Kahan's for a large y: states start from rest.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn compensated_add<T: Real>(y: &mut T, carry: &mut T, increment: T) {
    (*y, *carry) = two_sum(*y, increment + *carry);
}

/// The order and the longest step of a method that has them in `order` and `step`.
#[doc(hidden)]
#[macro_export]
macro_rules! order_and_step {
    () => {
        /// The order.
        #[must_use]
        pub const fn order(&self) -> $crate::Order {
            self.order
        }

        $crate::longest_step!();
    };
}

/// The longest step of a method that has it in `step`.
#[doc(hidden)]
#[macro_export]
macro_rules! longest_step {
    () => {
        /// The longest step, s.
        #[must_use]
        pub const fn step(&self) -> f64 {
            self.step
        }
    };
}

/// The unobserved run of a method of equal steps, over scalars `T`, that has an observed one.
#[doc(hidden)]
#[macro_export]
macro_rules! unobserved_run {
    ($F:ident: $Bound:path, $field:ident: $Field:ty, $Error:ty) => {
        /// Integrates to `end` in equal steps no longer than [`step`](Self::step), unobserved.
        ///
        /// # Errors
        /// As [`integrate`](Self::integrate).
        pub fn integrate_to<$F: $Bound>(
            &mut self,
            $field: $Field,
            state: &mut $crate::State<T>,
            end: f64,
        ) -> Result<$crate::Report, $Error> {
            self.integrate($field, state, end, $crate::unobserved)
        }
    };
}

/// The continued run of a method over scalars `T` that has `run(field, resumed, state, end, observer)`: its type parameters, their
/// bounds, its field and its error.
#[doc(hidden)]
#[macro_export]
macro_rules! resumed_run {
    (<$($F:ident),+> [$($bounds:tt)+] $field:ident: $Field:ty, $Error:ty) => {
        /// Continues a run from a [`Checkpoint`] that this method made with the same settings: the state becomes that of the
        /// checkpoint. To the same end the run takes the same steps, to the last bit.
        ///
        /// # Errors
        /// As [`integrate`](Self::integrate); [`IntegratorsError::WrongMethod`] for a checkpoint of another method, and
        /// [`IntegratorsError::WrongLength`] for one of another order or system or of a method that has not run. The state is then
        /// left alone.
        pub fn resume<$($F),+>(
            &mut self,
            $field: $Field,
            checkpoint: &$crate::Checkpoint<T>,
            state: &mut $crate::State<T>,
            end: f64,
            observer: impl FnMut($crate::Step<'_, T>) -> core::ops::ControlFlow<()>,
        ) -> Result<$crate::Report, $Error>
        where
            $($bounds)+
        {
            self.run($field, Some(checkpoint), state, end, observer)
        }
    };
}

/// Splits [start, end] into the fewest equal steps no longer than `step`; backwards in time if end < start.
///
/// # Errors
/// [`IntegratorsError::StepTooSmall`] where the steps cannot be counted or told from one another.
pub fn equal_steps<E>(start: f64, end: f64, step: f64) -> Result<(u64, f64), IntegratorsError<E>> {
    /// 2⁵³: beyond it steps can neither be counted nor told from one another.
    const MOST_STEPS: f64 = 9_007_199_254_740_992.0;
    let span = end - start;
    if span.abs() <= 0.0 {
        return Ok((0, 0.0));
    }
    // A span that is a whole number of steps but for rounding is not given one more.
    let count = (span.abs() / step * (1.0 - 4.0 * f64::EPSILON)).ceil().max(1.0);
    let h = span / count;
    if MOST_STEPS < count || h.abs() < 0.5 * f64::EPSILON * start.abs().max(end.abs()) {
        return Err(IntegratorsError::StepTooSmall { t: start, step });
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count between 1 and 2⁵³")]
    let steps = count as u64;
    Ok((steps, h))
}

/// Refuses a step that is not positive and finite.
///
/// # Errors
/// [`IntegratorsError::InvalidStep`].
pub fn check_step<E>(step: f64) -> Result<(), IntegratorsError<E>> {
    if 0.0 < step && step < f64::INFINITY { Ok(()) } else { Err(IntegratorsError::InvalidStep { step }) }
}

/// Checks the longest step of a run; ∞ is no bound.
///
/// # Errors
/// [`IntegratorsError::InvalidStep`].
pub fn check_longest(step: f64) -> Result<f64, IntegratorsError> {
    if 0.0 < step { Ok(step) } else { Err(IntegratorsError::InvalidStep { step }) }
}

/// Checks what a run starts from; the caller may have changed the state since it was made.
///
/// # Errors
/// [`IntegratorsError::WrongLength`], [`IntegratorsError::NotFinite`].
pub fn check_run<T: Real, E>(expected: usize, state: &mut State<T>, end: f64) -> Result<(), IntegratorsError<E>> {
    if state.values.len() != expected {
        return Err(IntegratorsError::WrongLength { quantity: "state", expected, found: state.values.len() });
    }
    state.check()?;
    check_time("end", end)?;
    check_time("end - t", end - state.time)?;
    state.carry.resize(expected, T::zero());
    Ok(())
}

fn check_time<E>(quantity: &'static str, value: f64) -> Result<(), IntegratorsError<E>> {
    if value.is_finite() { Ok(()) } else { Err(IntegratorsError::NotFinite { quantity, index: 0, value, t: None }) }
}

/// What rounding left of the time of a state.
#[must_use]
pub const fn carry_of_time<T>(state: &State<T>) -> f64 {
    state.time_carry
}

/// A state of its parts: the time with what rounding left of it, the components with theirs.
#[must_use]
pub const fn state_of<T>([time, time_carry]: [f64; 2], values: Vec<T>, carry: Vec<T>) -> State<T> {
    State { time, values, carry, time_carry, run: None }
}

/// Refuses numbers that are infinite or NaN in some lane: of a step from the time `t`, or as they were given.
///
/// # Errors
/// [`IntegratorsError::NotFinite`].
pub fn check_finite<T: Real, E>(
    quantity: &'static str,
    t: Option<f64>,
    values: &[T],
) -> Result<(), IntegratorsError<E>> {
    match first_non_finite(values) {
        None => Ok(()),
        Some((index, value)) => Err(IntegratorsError::NotFinite { quantity, index, value, t }),
    }
}

/// Refuses a step from the time `t` whose sums would not be finite.
///
/// # Errors
/// [`IntegratorsError::NotFinite`].
pub fn check_sums<T: Real, E>(t: f64, values: &[T], increments: &[T]) -> Result<(), IntegratorsError<E>> {
    for (index, (&y, &increment)) in values.iter().zip(increments).enumerate() {
        let value = largest_lane(y + increment);
        if !value.is_finite() {
            return Err(IntegratorsError::NotFinite { quantity: "state", index, value, t: Some(t) });
        }
    }
    Ok(())
}

/// The first component that is infinite or NaN in some lane, and its value there.
#[cfg_attr(not(debug_assertions), inline(always))]
fn first_non_finite<T: Real>(values: &[T]) -> Option<(usize, f64)> {
    // One pass without branches where all is well.
    if values.iter().fold(true, |finite, &x| finite & largest_lane(x).is_finite()) {
        return None;
    }
    values.iter().enumerate().find_map(|(index, x)| {
        (0..T::LANES).map(|lane| x.primal(lane)).find(|x| !x.is_finite()).map(|value| (index, value))
    })
}
