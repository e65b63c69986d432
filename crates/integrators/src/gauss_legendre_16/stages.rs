//! The stages of a step: sweeps until they stand still.
//!
//! Nodes and weights are symmetric about the middle of the step. With sums and differences of mirrored stages,
//!
//! ```text
//! s = A + A′        d = A − A′        of Aᵢ and A′ᵢ = A₉₋ᵢ, i = 1…4
//! ```
//!
//! the matrices of positions and velocities fall into two blocks of four rows each, and a sweep needs half the products. Stages are
//! stored mirrored: 1, 2, 3, 4, 8, 7, 6, 5.

use piola_numerics::{Lanes, Real};

use super::tableau::{
    FIRST_POWERS, Half, LAST, NODES, OFFSETS, POSITION_OF_DIFFERENCES, POSITION_OF_SUMS, POSITION_WEIGHTS, POWERS,
    Stages, VELOCITY_OF_DIFFERENCES, VELOCITY_OF_SUMS, WEIGHTS, mirrored,
};
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
}

const ZERO: Stages = Lanes([0.0; 8]);

/// Stages and their mirror images.
#[cfg_attr(not(debug_assertions), inline(always))]
fn halves(x: Stages) -> (Half, Half) {
    let [a, b, c, d, e, f, g, h] = x.0;
    (Lanes([a, b, c, d]), Lanes([e, f, g, h]))
}

/// Sums and differences of mirrored stages.
#[cfg_attr(not(debug_assertions), inline(always))]
fn sums_and_differences(x: Stages) -> (Half, Half) {
    let (first, last) = halves(x);
    (first + last, first - last)
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn joined(first: Half, last: Half) -> Stages {
    let ([a, b, c, d], [e, f, g, h]) = (first.0, last.0);
    Lanes([a, b, c, d, e, f, g, h])
}

/// base + (same ± opposite): all stages, from the part that mirrored stages share and the part in which they have opposite signs.
#[cfg_attr(not(debug_assertions), inline(always))]
fn mirrored_about(base: f64, same: Half, opposite: Half) -> Stages {
    joined(Lanes::splat(base) + (same + opposite), Lanes::splat(base) + (same - opposite))
}

/// The sum of the lanes, in pairs.
#[cfg_attr(not(debug_assertions), inline(always))]
fn sum(x: Half) -> f64 {
    (x.0[0] + x.0[2]) + (x.0[1] + x.0[3])
}

/// The sum over the stages.
#[cfg_attr(not(debug_assertions), inline(always))]
fn sum_of_all(x: Stages) -> f64 {
    let (first, last) = halves(x);
    sum(first + last)
}

/// A block, by its columns, times four numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
fn times(columns: &[Half; 4], x: Half) -> Half {
    let product = |j: usize| columns[j] * Lanes::splat(x.0[j]);
    (product(0) + product(2)) + (product(1) + product(3))
}

/// A block times a number.
#[cfg_attr(not(debug_assertions), inline(always))]
fn scaled(columns: &[Half; 4], factor: f64) -> [Half; 4] {
    let [a, b, c, d] = *columns;
    let factor = Lanes::splat(factor);
    [a * factor, b * factor, c * factor, d * factor]
}

/// |γ₇| of all components over their mean modulus at a stage.
#[cfg_attr(not(debug_assertions), inline(always))]
fn last_coefficient(accelerations: &[Stages], size: f64) -> f64 {
    let last: f64 = accelerations.iter().map(|&a| sum(LAST * sums_and_differences(a).1).abs()).sum();
    if 0.0 < size { last / (0.125 * size) } else { 0.0 }
}

/// A polynomial of degree seven, by its even and its odd powers.
#[cfg_attr(not(debug_assertions), inline(always))]
fn polynomial(even: Half, odd: Half, x: Half) -> Half {
    let square = x * x;
    let even = [
        Lanes::splat(even.0[0]) + Lanes::splat(even.0[1]) * square,
        Lanes::splat(even.0[2]) + Lanes::splat(even.0[3]) * square,
    ];
    let odd = [
        Lanes::splat(odd.0[0]) + Lanes::splat(odd.0[1]) * square,
        Lanes::splat(odd.0[2]) + Lanes::splat(odd.0[3]) * square,
    ];
    let fourth = square * square;
    (even[0] + even[1] * fourth) + (odd[0] + odd[1] * fourth) * x
}

/// The accelerations of a step, by the powers of their polynomial, continued to the stages of the next. Times are from the middle of that step, in
/// halves of it: even powers come from sums, odd ones from differences.
#[cfg_attr(not(debug_assertions), inline(always))]
fn continued(previous: Stages, powers: &[[Half; 4]; 2], [first, last]: [Half; 2]) -> Stages {
    let (sums, differences) = sums_and_differences(previous);
    let (even, odd) = (times(&powers[0], sums), times(&powers[1], differences));
    joined(polynomial(even, odd, first), polynomial(even, odd, last))
}

impl Workspace {
    pub(super) fn begin(&mut self, n: usize) {
        for stages in
            [&mut self.accelerations, &mut self.previous, &mut self.positions, &mut self.velocities, &mut self.swept]
        {
            stages.clear();
            stages.resize(n, ZERO);
        }
        for values in [&mut self.start, &mut self.next, &mut self.next_carry] {
            values.clear();
            values.resize(2 * n, 0.0);
        }
        self.previous_step = 0.0;
        self.expected = 0.1;
    }

    /// The polynomial of the last step, its length, and the contraction that is expected, for a checkpoint: stages in the order of time.
    pub(super) fn saved(&self) -> (Vec<f64>, [f64; 2]) {
        (self.previous.iter().flat_map(|&stages| mirrored(stages).0).collect(), [self.previous_step, self.expected])
    }

    /// The same from a checkpoint.
    pub(super) fn restore(&mut self, memory: &[f64], [previous_step, expected]: [f64; 2]) {
        for (stages, saved) in self.previous.iter_mut().zip(memory.as_chunks::<8>().0) {
            *stages = mirrored(Lanes(*saved));
        }
        (self.previous_step, self.expected) = (previous_step, expected);
    }
}

/// A step that is attempted.
struct Attempted<'a> {
    state: &'a State,
    h: f64,
    tolerance: f64,
    most: f64,
}

/// The stages of the coordinates.
struct Coordinates<'a> {
    accelerations: &'a mut [Stages],
    positions: &'a mut [Stages],
    velocities: &'a mut [Stages],
    swept: &'a mut [Stages],
}

/// Sweeps over the stages, from the accelerations that are given. All slices of coordinates have the same length, which the compiler may
/// know.
#[cfg_attr(not(debug_assertions), inline(always))]
fn sweep<F: SecondOrder<Stages>>(
    field: &mut F,
    step: &Attempted<'_>,
    coordinates: Coordinates<'_>,
    expected: &mut f64,
    evaluations: &mut u64,
) -> Result<Attempt, F::Error> {
    let Coordinates { accelerations, positions, velocities, swept } = coordinates;
    let &Attempted { state, h, tolerance, most } = step;
    let n = accelerations.len();
    let (q, v) = (&state.values[..n], &state.values[n..2 * n]);
    let (q_carry, v_carry) = (&state.carry[..n], &state.carry[n..2 * n]);
    let time = Lanes::splat(state.time) + Lanes::splat(h) * NODES;
    let square = h * h;
    let (half, half_square) = (0.5 * h, 0.5 * square);
    let positions_of_sums = scaled(&POSITION_OF_SUMS, square);
    let positions_of_differences = scaled(&POSITION_OF_DIFFERENCES, square);
    let velocities_of_sums = scaled(&VELOCITY_OF_SUMS, h);
    let velocities_of_differences = scaled(&VELOCITY_OF_DIFFERENCES, h);
    let mut attempt = Attempt::begin(*expected);
    let (mut size, mut rises) = (0.0, 0);
    while attempt.sweeps < MOST_SWEEPS {
        for k in 0..n {
            let (sums, differences) = sums_and_differences(accelerations[k]);
            // Symmetric in time whatever the rounding of the coefficients: from the middle of both ends, with the mean of both velocities.
            let gained = sum(WEIGHTS * sums);
            if F::VELOCITY_DEPENDENT {
                let mean = v_carry[k] + half * gained;
                let same = Lanes::splat(mean) + times(&velocities_of_differences, differences);
                velocities[k] = mirrored_about(v[k], same, times(&velocities_of_sums, sums));
            }
            let moved = h * (v[k] + v_carry[k]);
            let middle = (q_carry[k] + 0.5 * moved) + half_square * sum(POSITION_WEIGHTS * differences);
            let same = times(&positions_of_sums, sums) + Lanes::splat(middle);
            let turned = Lanes::splat(moved) * OFFSETS + times(&positions_of_differences, differences);
            let opposite = turned + Lanes::splat(half_square * gained) * OFFSETS;
            positions[k] = mirrored_about(q[k], same, opposite);
        }
        attempt.sweeps += 1;
        *evaluations += 8;
        field.acceleration(time, positions, velocities, swept)?;
        // Sums, not maxima: what is not finite stays in them.
        let (mut change, mut all) = (ZERO, ZERO);
        for k in 0..n {
            change += (swept[k] - accelerations[k]).abs();
            accelerations[k] = swept[k];
        }
        // Later sweeps hardly change it.
        if attempt.sweeps <= 2 {
            for acceleration in &*accelerations {
                all += acceleration.abs();
            }
            size = sum_of_all(all);
        }
        let change = if 0.0 < size { sum_of_all(change) / size } else { sum_of_all(change) };
        if !change.is_finite() {
            return Ok(attempt);
        }
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
    *expected = attempt.contraction.min(0.5);
    attempt.ratio = last_coefficient(accelerations, size);
    Ok(attempt)
}

impl Workspace {
    /// The accelerations at the stages as the last step, continued, foretells them.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn foretell(&mut self, h: f64, accelerations: &mut [Stages]) {
        if self.previous_step.abs() <= 0.0 {
            accelerations.fill(ZERO);
            return;
        }
        let ratio = h / self.previous_step;
        let (first, last) = halves(NODES);
        let times = [first, last].map(|node| Lanes::splat(1.0) + Lanes::splat(2.0 * ratio) * node);
        let n = accelerations.len();
        let pairs = accelerations.iter_mut().zip(&self.previous[..n]);
        if ratio.abs() <= FAR {
            for (acceleration, &previous) in pairs {
                *acceleration = continued(previous, &POWERS, times);
            }
        } else {
            for (acceleration, &previous) in pairs {
                *acceleration = continued(previous, &FIRST_POWERS, times);
            }
        }
    }

    /// Sweeps over the stages of N coordinates: the compiler unrolls their loops, and holds them in registers.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sweep_few<F: SecondOrder<Stages>, const N: usize>(
        &mut self,
        field: &mut F,
        step: &Attempted<'_>,
        evaluations: &mut u64,
    ) -> Result<Attempt, F::Error> {
        let [mut accelerations, mut positions, mut velocities, mut swept] = [[ZERO; N]; 4];
        self.foretell(step.h, &mut accelerations);
        let coordinates = Coordinates {
            accelerations: &mut accelerations,
            positions: &mut positions,
            velocities: &mut velocities,
            swept: &mut swept,
        };
        let attempt = sweep(field, step, coordinates, &mut self.expected, evaluations);
        self.accelerations[..N].copy_from_slice(&accelerations);
        // Nobody reads this. But without it a run takes a quarter longer: it seems that stores of whole stages make the compiler compute
        // the sweep in whole vectors.
        self.swept[..N].copy_from_slice(&swept);
        attempt
    }

    /// The same of any number.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sweep_many<F: SecondOrder<Stages>>(
        &mut self,
        field: &mut F,
        step: &Attempted<'_>,
        evaluations: &mut u64,
    ) -> Result<Attempt, F::Error> {
        let mut accelerations = core::mem::take(&mut self.accelerations);
        self.foretell(step.h, &mut accelerations);
        let n = accelerations.len();
        let coordinates = Coordinates {
            accelerations: &mut accelerations,
            positions: &mut self.positions[..n],
            velocities: &mut self.velocities[..n],
            swept: &mut self.swept[..n],
        };
        let attempt = sweep(field, step, coordinates, &mut self.expected, evaluations);
        self.accelerations = accelerations;
        attempt
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
        let step = Attempted { state, h, tolerance, most };
        match F::FREEDOM {
            Some(1) => self.sweep_few::<F, 1>(field, &step, evaluations),
            Some(2) => self.sweep_few::<F, 2>(field, &step, evaluations),
            Some(3) => self.sweep_few::<F, 3>(field, &step, evaluations),
            Some(4) => self.sweep_few::<F, 4>(field, &step, evaluations),
            _ => self.sweep_many(field, &step, evaluations),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn accept(&mut self, state: &mut State, h: f64) -> Result<(), IntegratorsError<F::Error>> {
        let n = F::FREEDOM.unwrap_or(self.accelerations.len());
        self.start[..2 * n].copy_from_slice(&state.values[..2 * n]);
        self.next[..2 * n].copy_from_slice(&state.values[..2 * n]);
        self.next_carry[..2 * n].copy_from_slice(&state.carry[..2 * n]);
        let (q, v) = self.next[..2 * n].split_at_mut(n);
        let (q_carry, v_carry) = self.next_carry[..2 * n].split_at_mut(n);
        let accelerations = &self.accelerations[..n];
        for k in 0..n {
            let (sums, differences) = sums_and_differences(accelerations[k]);
            let gained = h * sum(WEIGHTS * sums);
            // With the velocities of both ends: symmetric in time whatever the rounding of the weights.
            let mean = v[k] + (v_carry[k] + 0.5 * gained);
            compensated_add(&mut q[k], &mut q_carry[k], h * mean + (h * h) * sum(POSITION_WEIGHTS * differences));
            compensated_add(&mut v[k], &mut v_carry[k], gained);
        }
        check_finite("state", Some(state.time), &self.next[..2 * n])?;
        state.values[..2 * n].copy_from_slice(&self.next[..2 * n]);
        state.carry[..2 * n].copy_from_slice(&self.next_carry[..2 * n]);
        core::mem::swap(&mut self.accelerations, &mut self.previous);
        self.previous_step = h;
        Ok(())
    }

    fn check_rates(&self, t: f64) -> Result<(), IntegratorsError<F::Error>> {
        check_finite("rate", Some(t), &self.accelerations)
    }

    fn state_at(&self, part: f64, out: &mut [f64]) {
        self.state_between(part, out);
    }
}
