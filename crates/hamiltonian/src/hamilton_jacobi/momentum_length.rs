//! The length of a momentum of given direction.
//!
//! ```text
//! H(q, λ d, t) + λ r = E        for λ
//! ```

use piola_numerics::{Dual, Real};

use crate::PhaseFunction;
use crate::{HamiltonJacobiError, HamiltonianError};

/// Newton iterations after which the length is given up.
const ITERATIONS: usize = 60;
/// How often one of them is halved.
const HALVINGS: usize = 30;

/// What is solved: the direction d, the rate r, and E.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'d, T> {
    pub(super) direction: &'d [T],
    pub(super) rate: T,
    pub(super) energy: T,
}

/// Powers of a hundred by which another guess may differ.
const DECADES: i32 = 24;

/// λ, and d/dλ of what vanishes there. Newton's iteration from the guess, or, where that fails, from a guess of the
/// right size: of the nearest change of sign over 96 decades.
pub(super) fn momentum_scale<H: PhaseFunction, T: Real>(
    hamiltonian: &H,
    point: (&[T], T),
    line: Line<'_, T>,
    guess: f64,
) -> Result<(T, T), HamiltonianError> {
    let refused = match from_guess(hamiltonian, point, line, guess) {
        Err(refused @ HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NotFound { .. })) => refused,
        other => return other,
    };
    let (q, t) = point;
    let mut p = Vec::with_capacity(q.len());
    let mut left = |scale: f64| {
        let scale = T::lit(scale);
        p.clear();
        p.extend(line.direction.iter().map(|&d| d * scale));
        (hamiltonian.value(q, &p, t) + line.rate * scale - line.energy).primal(0)
    };
    for power in 0..DECADES {
        for (near, far) in [(power, power + 1), (-power, -power - 1)] {
            let (near, far) = (guess * 100_f64.powi(near), guess * 100_f64.powi(far));
            if left(near) * left(far) < 0.0 {
                // From the larger one: what grows faster than the momentum is then convex on the way.
                return from_guess(hamiltonian, point, line, if near.abs() < far.abs() { far } else { near });
            }
        }
    }
    Err(refused)
}

/// Newton's iteration from the guess; the derivatives of T follow the value.
fn from_guess<H: PhaseFunction, T: Real>(
    hamiltonian: &H,
    (q, t): (&[T], T),
    line: Line<'_, T>,
    guess: f64,
) -> Result<(T, T), HamiltonianError> {
    let q: Vec<Dual<T>> = q.iter().map(|&q| Dual::constant(q)).collect();
    let mut p = Vec::with_capacity(q.len());
    let mut evaluate = |scale: T| {
        let scale = Dual::variable(scale);
        p.clear();
        p.extend(line.direction.iter().map(|&d| Dual::constant(d) * scale));
        let energy = hamiltonian.value(&q, &p, Dual::constant(t));
        let terms = energy.value.primal(0).abs() + (line.rate * scale.value).primal(0).abs();
        (energy + Dual::constant(line.rate) * scale - Dual::constant(line.energy), terms + line.energy.primal(0).abs())
    };
    let mut scale = T::lit(guess);
    let (mut found, mut terms) = evaluate(scale);
    let mut left = f64::INFINITY;
    for _ in 0..ITERATIONS {
        left = found.value.primal(0).abs();
        let step = found.value / found.tangent;
        if !step.primal(0).is_finite() && (left.is_nan() || f64::EPSILON * terms < left) {
            break;
        }
        // At a double root the value is rounding long before the step is.
        let settled =
            step.primal(0).abs() <= 4.0 * f64::EPSILON * scale.primal(0).abs() || left <= f64::EPSILON * terms;
        let (mut fraction, mut accepted) = (1.0, false);
        for _ in 0..HALVINGS {
            let trial = scale - T::lit(fraction) * step;
            let next = evaluate(trial);
            if settled || next.0.value.primal(0).abs() < (1.0 - 0.25 * fraction) * left {
                (scale, (found, terms), accepted) = (trial, next, true);
                break;
            }
            fraction *= 0.5;
        }
        // What a step of the size of rounding cannot improve is found.
        let small = step.primal(0).abs() <= 1e-12 * scale.primal(0).abs();
        if settled || (!accepted && small) {
            for _ in 0..T::ORDER {
                scale -= found.value / found.tangent;
                (found, _) = evaluate(scale);
            }
            return Ok((scale, found.tangent));
        }
        if !accepted {
            break;
        }
    }
    Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NotFound {
        unknown: "lengths of the momentum",
        iterations: ITERATIONS,
        residual: left,
    }))
}
