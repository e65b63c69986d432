//! The stages of a step: sweeps until they stand still.

use piola_numerics::Real;

use super::tables::Tables;
use crate::collocation::{Attempt, Collocation};
use crate::state::{check_finite, compensated_add};
use crate::{IntegratorsError, SecondOrder, State};

/// The name in a checkpoint.
pub(super) const NAME: &str = "GaussRadau15";
/// Sweeps after which a fixed step is given up.
const MOST_SWEEPS: u64 = 40;
/// Values that settle in fewer sweeps may have been at rest.
const FEW_SWEEPS: u64 = 4;
/// Sweeps that bring in derivatives of each order where they may have been.
const SWEEPS_AT_REST: usize = 12;
/// Sweeps after which an adaptive step is given up: a shorter one is cheaper.
const MOST_ADAPTIVE_SWEEPS: u64 = 12;
/// Changes larger than the one before after which sweeps of an adaptive step are given up.
const MOST_RISES: u32 = 3;
/// The change of a sweep, in units of rounding of the accelerations, whose fall tells of the step.
const MEASURABLE: f64 = 4096.0;
/// The smallest factor by which a sweep is expected to shorten the change.
const BEST_CONTRACTION: f64 = 1e-4;
/// The sweeps end when the error that they leave is below this part of the tolerance. This error has the same sign in every
/// step of a circular motion, so the position error grows with the square of the time: with 1e-2 here, ten revolutions end
/// thirty tolerances away.
const UNSWEPT: f64 = 1e-3;
/// The sweeps also end when their error is below this part of the rounding of the accelerations.
const UNROUNDED: f64 = 0.01;

/// Memory of a run.
#[derive(Clone, Debug)]
pub(super) struct Workspace<T> {
    tables: Tables<T>,
    /// The unit of rounding of the scalar.
    rounding: f64,
    /// Row k: the acceleration of component k at the start of the step, then its differences from that at the other seven nodes.
    stages: Vec<[T; 8]>,
    /// The polynomial of the last accepted step: the acceleration at its start, and b₀ … b₆.
    last: Vec<[T; 8]>,
    positions: Vec<T>,
    velocities: Vec<T>,
    accelerations: Vec<T>,
    /// The state at the start of the step.
    pub(super) start: Vec<T>,
    next: Vec<T>,
    next_carry: Vec<T>,
    /// The length of the last accepted step; zero before the first.
    previous_step: f64,
    /// The factor of contraction that the next step is expected to have.
    expected: f64,
    /// Whether the accelerations at the start of the step are known.
    begun: bool,
}

/// Σ of the products of two rows, in pairs.
#[cfg_attr(not(debug_assertions), inline(always))]
fn dot<T: Real>(a: &[T; 8], b: &[T; 8]) -> T {
    let mut x = [T::zero(); 8];
    for j in 0..8 {
        x[j] = a[j] * b[j];
    }
    ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]))
}

/// The largest ratio of two sums of moduli among the lanes; zero over zero is zero.
#[cfg_attr(not(debug_assertions), inline(always))]
fn largest_ratio<T: Real>(part: T, whole: T) -> f64 {
    let mut largest = 0.0_f64;
    for lane in 0..T::LANES {
        let (part, whole) = (part.primal(lane), whole.primal(lane));
        largest = largest.max(if 0.0 < part { part / whole } else { 0.0 });
    }
    largest
}

/// The unit of rounding of a scalar, from two differences that are zero in exact arithmetic: 3 (4/3 − 1) − 1 and √2² − 2.
fn unit_of_rounding<T: Real>() -> f64 {
    let (one, two, three) = (T::one(), T::lit(2.0), T::lit(3.0));
    let third = (three * (T::lit(4.0) / three - one) - one).abs().primal(0);
    let root = (two.sqrt() * two.sqrt() - two).abs().primal(0);
    third.max(root).max(1e-40)
}

impl<T: Real> Default for Workspace<T> {
    fn default() -> Self {
        Self {
            tables: Tables::new(),
            rounding: unit_of_rounding::<T>(),
            stages: Vec::new(),
            last: Vec::new(),
            positions: Vec::new(),
            velocities: Vec::new(),
            accelerations: Vec::new(),
            start: Vec::new(),
            next: Vec::new(),
            next_carry: Vec::new(),
            previous_step: 0.0,
            expected: 0.0,
            begun: false,
        }
    }
}

impl<T: Real> Workspace<T> {
    pub(super) fn begin(&mut self, n: usize) {
        for stages in [&mut self.stages, &mut self.last] {
            stages.clear();
            stages.resize(n, [T::zero(); 8]);
        }
        for values in [&mut self.positions, &mut self.velocities, &mut self.accelerations] {
            values.clear();
            values.resize(n, T::zero());
        }
        for values in [&mut self.start, &mut self.next, &mut self.next_carry] {
            values.clear();
            values.resize(2 * n, T::zero());
        }
        self.previous_step = 0.0;
        self.expected = 0.1;
        self.begun = false;
    }

    /// The polynomial of the last step, its length, and the contraction that is expected, for a checkpoint.
    pub(super) fn saved(&self) -> (Vec<T>, [f64; 2]) {
        (self.last.iter().flatten().copied().collect(), [self.previous_step, self.expected])
    }

    /// The same from a checkpoint.
    pub(super) fn restore(&mut self, memory: &[T], [previous_step, expected]: [f64; 2]) {
        for (last, saved) in self.last.iter_mut().zip(memory.as_chunks::<8>().0) {
            *last = *saved;
        }
        (self.previous_step, self.expected) = (previous_step, expected);
    }

    /// The ratio |b₆|/|a| that rounding alone can make.
    pub(super) fn smallest_ratio(&self) -> f64 {
        self.rounding * self.tables.last.iter().map(|x| x.primal(0).abs()).sum::<f64>()
    }

    /// The stages that the polynomial of the last step, continued, has in a step that is `ratio` times as long.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn predict(&mut self, ratio: f64) {
        let mut weights = [[T::zero(); 8]; 8];
        for (weights, &node) in weights.iter_mut().zip(&self.tables.nodes) {
            // sᵐ − 1 from the end of the last step, s = 1, on.
            let place = T::one() + T::lit(ratio) * node;
            let mut power = place;
            for weight in &mut weights[1..] {
                *weight = power - T::one();
                power *= place;
            }
        }
        for (stages, last) in self.stages.iter_mut().zip(&self.last) {
            for n in 1..8 {
                stages[n] = dot(&weights[n], last);
            }
        }
    }

    /// Writes the state at the part s of the last accepted step.
    pub(super) fn state_between(&self, part: f64, out: &mut [T]) {
        let n = self.last.len();
        let (q0, v0) = self.start.split_at(n);
        let (q, v) = out.split_at_mut(n);
        let s = T::lit(part);
        let moved = s * T::lit(self.previous_step);
        for (k, polynomial) in self.last.iter().enumerate() {
            let (mut once, mut twice) = (T::zero(), T::zero());
            for (degree, &coefficient) in polynomial.iter().enumerate().rev() {
                let degree = degree as f64;
                once = once * s + coefficient * T::lit(1.0 / (degree + 1.0));
                twice = twice * s + coefficient * T::lit(1.0 / ((degree + 1.0) * (degree + 2.0)));
            }
            v[k] = v0[k] + moved * once;
            q[k] = q0[k] + moved * (v0[k] + moved * twice);
        }
    }
}

/// |b₆| of all components over their mean modulus at a node.
#[cfg_attr(not(debug_assertions), inline(always))]
fn last_coefficient<T: Real>(row: &[T; 8], stages: &[[T; 8]], size: T) -> f64 {
    let mut last = T::zero();
    for stages in stages {
        last += dot(row, stages).abs();
    }
    largest_ratio(last, size * T::lit(0.125))
}

impl<T: Real, F: SecondOrder<T>> Collocation<T, F> for Workspace<T> {
    type Error = F::Error;

    /// The accelerations at the start of a step, once for all attempts at it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn begin_step(
        &mut self,
        field: &mut F,
        state: &State<T>,
        evaluations: &mut u64,
    ) -> Result<(), IntegratorsError<F::Error>> {
        if self.begun {
            return Ok(());
        }
        let (q, v) = state.values.split_at(self.stages.len());
        *evaluations += 1;
        field
            .acceleration(T::lit(state.time) + T::lit(state.time_carry), q, v, &mut self.accelerations)
            .map_err(|source| IntegratorsError::Field { t: state.time, source })?;
        check_finite("rate", Some(state.time), &self.accelerations)?;
        for (stages, &acceleration) in self.stages.iter_mut().zip(&self.accelerations) {
            stages[0] = acceleration;
        }
        self.begun = true;
        Ok(())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn attempt(
        &mut self,
        field: &mut F,
        state: &State<T>,
        h: f64,
        tolerance: f64,
        most: f64,
        evaluations: &mut u64,
    ) -> Result<Attempt, F::Error> {
        let n = self.stages.len();
        if self.previous_step.abs() <= 0.0 {
            for stages in &mut self.stages {
                stages[1..].fill(T::zero());
            }
        } else {
            self.predict(h / self.previous_step);
        }
        let (q, v) = state.values.split_at(n);
        let (q_carry, v_carry) = state.carry.split_at(n);
        let (length, square) = (T::lit(h), T::lit(h) * T::lit(h));
        let (time, time_carry) = (T::lit(state.time), T::lit(state.time_carry));
        let stages = &mut self.stages[..n];
        let (positions, velocities) = (&mut self.positions[..n], &mut self.velocities[..n]);
        let accelerations = &mut self.accelerations[..n];
        let mut at_start = T::zero();
        for stages in &*stages {
            at_start += stages[0].abs();
        }
        let mut attempt = Attempt::begin(self.expected);
        let adaptive = most.is_finite();
        let most_sweeps = if adaptive { MOST_ADAPTIVE_SWEEPS } else { MOST_SWEEPS };
        let negligible = (UNSWEPT * tolerance).max(UNROUNDED * self.rounding);
        // Sweeps that bring in derivatives, once the values stand still.
        let mut more = None;
        let (mut size, mut rises) = (at_start, 0);
        while attempt.sweeps < most_sweeps || more.is_some() {
            // Sums, not maxima: what is not finite stays in them.
            let mut change = T::zero();
            size = at_start;
            for j in 1..8 {
                let (velocity, position) = (&self.tables.velocity[j], &self.tables.position[j]);
                let part = length * self.tables.nodes[j];
                for k in 0..n {
                    if F::VELOCITY_DEPENDENT {
                        velocities[k] = v[k] + (v_carry[k] + length * dot(velocity, &stages[k]));
                    }
                    positions[k] = q[k] + (q_carry[k] + (part * v[k] + square * dot(position, &stages[k])));
                }
                *evaluations += 1;
                field.acceleration(time + (time_carry + part), positions, velocities, accelerations)?;
                // The next stage already moves by this one.
                for k in 0..n {
                    let difference = accelerations[k] - stages[k][0];
                    size += accelerations[k].abs();
                    change += (difference - stages[k][j]).abs();
                    stages[k][j] = difference;
                }
            }
            if let Some(left) = &mut more {
                *left -= 1;
                if *left == 0 {
                    attempt.converged = true;
                    break;
                }
                continue;
            }
            attempt.sweeps += 1;
            if !(0..T::LANES).all(|lane| size.primal(lane).is_finite()) {
                return Ok(attempt);
            }
            let change = largest_ratio(change, size);
            let fell = change / attempt.change;
            // Near rounding the changes fall no more, whatever the step.
            if attempt.change.is_finite() && MEASURABLE * self.rounding < change {
                attempt.contraction = fell.max(BEST_CONTRACTION);
            }
            attempt.change = change;
            let settled = change * attempt.contraction.min(1.0) <= negligible;
            let rounded = 0.5 < fell && change < self.rounding.sqrt();
            if settled || rounded {
                if T::ORDER == 0 {
                    attempt.converged = true;
                    break;
                }
                // Values at rest settle at once and tell nothing of the pace of derivatives.
                more = Some(T::ORDER * if attempt.sweeps < FEW_SWEEPS { SWEEPS_AT_REST } else { 1 });
                continue;
            }
            // A shorter step is cheaper than waiting; a fixed one waits: changes may grow at first and fall then.
            rises += u32::from(1.0 < fell);
            if adaptive && rises == MOST_RISES {
                break;
            }
            if adaptive && attempt.sweeps == 1 {
                attempt.ratio = last_coefficient(&self.tables.last, stages, size);
                attempt.hopeless = most < attempt.ratio;
                if attempt.hopeless {
                    return Ok(attempt);
                }
            }
        }
        self.expected = attempt.contraction.min(0.5);
        attempt.ratio = last_coefficient(&self.tables.last, stages, size);
        Ok(attempt)
    }

    /// Positions moved by their rounding move the acceleration at the last node by its noise.
    fn noise(&mut self, field: &mut F, state: &State<T>, h: f64, evaluations: &mut u64) -> Result<f64, F::Error> {
        /// Units of rounding by which positions are moved.
        const MOVED: f64 = 1024.0;
        /// The golden ratio: no two components move alike.
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        for (k, position) in self.positions.iter_mut().enumerate() {
            let part = 2.0 * (k as f64 * GOLDEN).fract() - 1.0;
            *position *= T::lit(1.0 + MOVED * self.rounding * part);
        }
        *evaluations += 1;
        let t = T::lit(state.time) + (T::lit(state.time_carry) + T::lit(h) * self.tables.nodes[7]);
        field.acceleration(t, &self.positions, &self.velocities, &mut self.accelerations)?;
        let (mut moved, mut size) = (T::zero(), T::zero());
        for (stages, &acceleration) in self.stages.iter().zip(&self.accelerations) {
            moved += (acceleration - (stages[0] + stages[7])).abs();
            size += acceleration.abs();
        }
        let noise = largest_ratio(moved, size) / (MOVED * self.rounding);
        Ok(if noise.is_finite() { noise * self.smallest_ratio() } else { 0.0 })
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn accept(&mut self, state: &mut State<T>, h: f64) -> Result<(), IntegratorsError<F::Error>> {
        let n = self.stages.len();
        self.start.copy_from_slice(&state.values);
        self.next.copy_from_slice(&state.values);
        self.next_carry.copy_from_slice(&state.carry);
        let (q, v) = self.next.split_at_mut(n);
        let (q_carry, v_carry) = self.next_carry.split_at_mut(n);
        let (length, square) = (T::lit(h), T::lit(h) * T::lit(h));
        for k in 0..n {
            let a = self.stages[k][0];
            let [b0, b1, b2, b3, b4, b5, b6] = self.tables.coefficients(&self.stages[k]);
            let mut once = T::zero();
            let mut twice = T::zero();
            for (degree, b) in [(7, b6), (6, b5), (5, b4), (4, b3), (3, b2), (2, b1), (1, b0)] {
                let degree = T::lit(f64::from(degree));
                once += b / (degree + T::one());
                twice += b / ((degree + T::one()) * (degree + T::lit(2.0)));
            }
            let bent = length * v_carry[k] + square * (T::lit(0.5) * a + twice);
            compensated_add(&mut q[k], &mut q_carry[k], length * v[k] + bent);
            compensated_add(&mut v[k], &mut v_carry[k], length * (a + once));
            self.last[k] = [a, b0, b1, b2, b3, b4, b5, b6];
        }
        check_finite("state", Some(state.time), &self.next)?;
        core::mem::swap(&mut state.values, &mut self.next);
        core::mem::swap(&mut state.carry, &mut self.next_carry);
        self.previous_step = h;
        self.begun = false;
        Ok(())
    }

    fn check_rates(&self, t: f64) -> Result<(), IntegratorsError<F::Error>> {
        check_finite("rate", Some(t), &self.accelerations)
    }

    fn state_at(&self, part: f64, out: &mut [T]) {
        self.state_between(part, out);
    }
}
