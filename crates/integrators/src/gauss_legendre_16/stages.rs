//! The stages of a step: sweeps until they stand still.

use piola_numerics::{Lanes, Real};

use super::tableau::{COEFFICIENTS, LEGENDRE, NODES, OFFSETS, POSITION, POSITION_WEIGHTS, Stages, VELOCITY, WEIGHTS};
use crate::collocation::{Attempt, Collocation};
use crate::state::{check_finite, compensated_add};
use crate::{IntegratorsError, SecondOrder, State};

/// The name in a checkpoint.
pub(super) const NAME: &str = "GaussLegendre16";
/// Sweeps after which a step is given up.
const MOST_SWEEPS: u64 = 40;
/// Changes larger than the one before after which sweeps are given up.
const MOST_RISES: u32 = 3;
/// The change of a sweep, relative to the accelerations, below which only rounding can keep it from falling.
const NEAR_ROUNDING: f64 = 1e-9;
/// The change of a sweep, relative to the accelerations, whose fall tells of the step.
const MEASURABLE: f64 = 1e-12;
/// The part of the tolerance that the sweeps may leave.
const UNSWEPT: f64 = 0.01;
/// The longest continuation of a polynomial of degree seven, in steps; farther, its first terms are continued.
const FAR: f64 = 1.6;

/// Memory of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Workspace {
    /// The accelerations at the stages.
    pub(super) accelerations: Vec<Stages>,
    /// Those of the last accepted step.
    pub(super) previous: Vec<Stages>,
    positions: Vec<Stages>,
    velocities: Vec<Stages>,
    swept: Vec<Stages>,
    /// The state at the start of the step.
    pub(super) start: Vec<f64>,
    next: Vec<f64>,
    next_carry: Vec<f64>,
    /// The length of the last accepted step; zero before the first.
    pub(super) previous_step: f64,
    /// The factor of contraction that the next step is expected to have.
    expected: f64,
    continuation: Continuation,
}

/// Legendre's polynomials of a step at the nodes of the next.
#[derive(Clone, Debug)]
struct Continuation {
    ratio: f64,
    polynomials: [Stages; 8],
}

impl Default for Continuation {
    fn default() -> Self {
        Self { ratio: f64::NAN, polynomials: [Lanes([0.0; 8]); 8] }
    }
}

/// The sum over the stages, in pairs.
#[cfg_attr(not(debug_assertions), inline(always))]
fn sum(x: Stages) -> f64 {
    let x = x.0;
    ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]))
}

/// Σ of the products of two rows of stages, in pairs.
#[cfg_attr(not(debug_assertions), inline(always))]
fn dot(a: Stages, b: Stages) -> f64 {
    sum(a * b)
}

/// A matrix, by its columns, times a row of stages.
#[cfg_attr(not(debug_assertions), inline(always))]
fn times(columns: &[Stages; 8], x: Stages) -> Stages {
    let mut even = columns[0] * Lanes::splat(x.0[0]);
    let mut odd = columns[1] * Lanes::splat(x.0[1]);
    for j in [2, 4, 6] {
        even += columns[j] * Lanes::splat(x.0[j]);
        odd += columns[j + 1] * Lanes::splat(x.0[j + 1]);
    }
    even + odd
}

/// |γ₇| of all components over their mean modulus at a stage.
#[cfg_attr(not(debug_assertions), inline(always))]
fn last_coefficient(accelerations: &[Stages], size: f64) -> f64 {
    let last: f64 = accelerations.iter().map(|&a| dot(LEGENDRE[7], a).abs()).sum();
    if 0.0 < size { last / (0.125 * size) } else { 0.0 }
}

/// `P_(k+1) = ((2k + 1) x P_k − k P_(k−1))/(k + 1)`
#[cfg_attr(not(debug_assertions), inline(always))]
fn next_polynomial(k: f64, x: Stages, now: Stages, before: Stages) -> Stages {
    Lanes::splat((2.0 * k + 1.0) / (k + 1.0)) * x * now - Lanes::splat(k / (k + 1.0)) * before
}

impl Continuation {
    /// For a next step of this length in lengths of the last one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn to(&mut self, ratio: f64) {
        if self.ratio.to_bits() == ratio.to_bits() {
            return;
        }
        self.ratio = ratio;
        // One after the other, not in a loop: the compiler makes gathers and scatters of one, which cost more than the sweeps.
        let (one, x) = (Lanes::splat(1.0), Lanes::splat(1.0) + Lanes::splat(2.0 * ratio) * NODES);
        let second = next_polynomial(1.0, x, x, one);
        let zero = Lanes([0.0; 8]);
        self.polynomials = [one, x, second, zero, zero, zero, zero, zero];
        if ratio.abs() <= FAR {
            let third = next_polynomial(2.0, x, second, x);
            let fourth = next_polynomial(3.0, x, third, second);
            let fifth = next_polynomial(4.0, x, fourth, third);
            let sixth = next_polynomial(5.0, x, fifth, fourth);
            let seventh = next_polynomial(6.0, x, sixth, fifth);
            self.polynomials = [one, x, second, third, fourth, fifth, sixth, seventh];
        }
    }

    /// The accelerations of the last step, continued to the stages of the next.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(&self, previous: Stages) -> Stages {
        times(&self.polynomials, times(&COEFFICIENTS, previous))
    }
}

impl Workspace {
    pub(super) fn begin(&mut self, n: usize) {
        let zero = Lanes([0.0; 8]);
        for stages in
            [&mut self.accelerations, &mut self.previous, &mut self.positions, &mut self.velocities, &mut self.swept]
        {
            stages.clear();
            stages.resize(n, zero);
        }
        for values in [&mut self.start, &mut self.next, &mut self.next_carry] {
            values.clear();
            values.resize(2 * n, 0.0);
        }
        self.previous_step = 0.0;
        self.expected = 0.1;
    }

    /// The polynomial of the last step, its length, and the contraction that is expected, for a checkpoint.
    pub(super) fn saved(&self) -> (Vec<f64>, [f64; 2]) {
        (self.previous.iter().flat_map(|stages| stages.0).collect(), [self.previous_step, self.expected])
    }

    /// The same from a checkpoint.
    pub(super) fn restore(&mut self, memory: &[f64], [previous_step, expected]: [f64; 2]) {
        for (stages, saved) in self.previous.iter_mut().zip(memory.as_chunks::<8>().0) {
            *stages = Lanes(*saved);
        }
        (self.previous_step, self.expected) = (previous_step, expected);
    }
}

impl<F: SecondOrder<Stages>> Collocation<f64, F> for Workspace {
    type Error = F::Error;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn attempt(
        &mut self,
        field: &mut F,
        state: &State,
        h: f64,
        tolerance: f64,
        most: f64,
        evaluations: &mut u64,
    ) -> Result<Attempt, F::Error> {
        // Not F::FREEDOM: unrolled over two coordinates the sweep needs more registers than there are, and takes up to a third longer.
        let n = self.accelerations.len();
        let (q, v) = state.values.split_at(n);
        let (q_carry, v_carry) = state.carry.split_at(n);
        let accelerations = &mut self.accelerations[..n];
        let (positions, velocities) = (&mut self.positions[..n], &mut self.velocities[..n]);
        let swept = &mut self.swept[..n];
        if self.previous_step.abs() <= 0.0 {
            accelerations.fill(Lanes([0.0; 8]));
        } else {
            self.continuation.to(h / self.previous_step);
            for (acceleration, &previous) in accelerations.iter_mut().zip(&self.previous[..n]) {
                *acceleration = self.continuation.of(previous);
            }
        }
        let time = Lanes::splat(state.time) + Lanes::splat(h) * NODES;
        let square = h * h;
        let (h_all, square_all) = (Lanes::splat(h), Lanes::splat(square));
        let mut attempt = Attempt::begin(self.expected);
        let (mut size, mut rises) = (0.0, 0);
        while attempt.sweeps < MOST_SWEEPS {
            for k in 0..n {
                let a = accelerations[k];
                // From the middle of both ends: symmetric in time whatever the rounding of the coefficients.
                let mean = v_carry[k] + 0.5 * (h * dot(WEIGHTS, a));
                if F::VELOCITY_DEPENDENT {
                    velocities[k] = Lanes::splat(v[k]) + (Lanes::splat(mean) + h_all * times(&VELOCITY, a));
                }
                let moved = h * (v[k] + mean);
                let middle = q_carry[k] + 0.5 * (moved + square * dot(POSITION_WEIGHTS, a));
                let about = Lanes::splat(moved) * OFFSETS + square_all * times(&POSITION, a);
                positions[k] = Lanes::splat(q[k]) + (Lanes::splat(middle) + about);
            }
            attempt.sweeps += 1;
            *evaluations += 8;
            field.acceleration(time, positions, velocities, swept)?;
            // Sums, not maxima: what is not finite stays in them.
            let (mut change, mut all) = (Lanes([0.0; 8]), Lanes([0.0; 8]));
            for k in 0..n {
                change += (swept[k] - accelerations[k]).abs();
                all += swept[k].abs();
                accelerations[k] = swept[k];
            }
            size = sum(all);
            if !size.is_finite() {
                return Ok(attempt);
            }
            let change = if 0.0 < size { sum(change) / size } else { 0.0 };
            let fell = change / attempt.change;
            // Near rounding the changes fall no more, whatever the step.
            if attempt.change.is_finite() && MEASURABLE < change {
                attempt.contraction = fell.max(1e-3);
            }
            attempt.change = change;
            let left = change * attempt.contraction.min(1.0);
            if left <= UNSWEPT * tolerance || (0.5 < fell && change < NEAR_ROUNDING) {
                attempt.converged = true;
                break;
            }
            // A shorter step is cheaper than waiting; a fixed one waits: changes may grow at first and fall then.
            rises += u32::from(1.0 < fell);
            if rises == MOST_RISES && most.is_finite() {
                break;
            }
            if attempt.sweeps == 2 && most.is_finite() {
                attempt.ratio = last_coefficient(accelerations, size);
                if most < attempt.ratio {
                    attempt.hopeless = true;
                    return Ok(attempt);
                }
            }
        }
        self.expected = attempt.contraction.min(0.5);
        attempt.ratio = last_coefficient(accelerations, size);
        Ok(attempt)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn accept(&mut self, state: &mut State, h: f64) -> Result<(), IntegratorsError<F::Error>> {
        let n = self.accelerations.len();
        self.start.copy_from_slice(&state.values);
        self.next.copy_from_slice(&state.values);
        self.next_carry.copy_from_slice(&state.carry);
        let (q, v) = self.next.split_at_mut(n);
        let (q_carry, v_carry) = self.next_carry.split_at_mut(n);
        for k in 0..n {
            let a = self.accelerations[k];
            let gained = h * dot(WEIGHTS, a);
            // With the velocities of both ends: symmetric in time whatever the rounding of the weights.
            let mean = v[k] + (v_carry[k] + 0.5 * gained);
            compensated_add(&mut q[k], &mut q_carry[k], h * mean + (h * h) * dot(POSITION_WEIGHTS, a));
            compensated_add(&mut v[k], &mut v_carry[k], gained);
        }
        check_finite("state", Some(state.time), &self.next)?;
        core::mem::swap(&mut state.values, &mut self.next);
        core::mem::swap(&mut state.carry, &mut self.next_carry);
        core::mem::swap(&mut self.accelerations, &mut self.previous);
        self.previous_step = h;
        Ok(())
    }

    fn check_rates(&self, t: f64) -> Result<(), IntegratorsError<F::Error>> {
        check_finite("rate", Some(t), &self.swept)
    }

    fn state_at(&self, part: f64, out: &mut [f64]) {
        self.state_between(part, out);
    }
}
