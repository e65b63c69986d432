//! Newton's iteration over any scalar, for what is given by equations only.

use piola_numerics::linear::lu;
use piola_numerics::{Gradient, Real};

use super::differential::CHUNK;
use super::forms::jacobian_of;
use crate::HamiltonianError;

/// Steps after which the iteration is given up.
const ITERATIONS: usize = 60;
/// How often one of them is halved.
const HALVINGS: usize = 30;

/// Solves r(x) = 0 from the guess in x. The values are found first; then the derivatives that x should carry follow in
/// as many more steps as its scalar has orders.
///
/// `condition` names what is solved for in the error.
pub(crate) fn solve<T: Real>(
    condition: &'static str,
    x: &mut [T],
    mut residual: impl FnMut(&[Gradient<T, CHUNK>], &mut [Gradient<T, CHUNK>]) -> Result<(), HamiltonianError>,
) -> Result<(), HamiltonianError> {
    let n = x.len();
    let (mut values, mut jacobian, mut exchanges) = (vec![T::zero(); n], vec![T::zero(); n * n], vec![0; n]);
    let (mut trial, mut step) = (x.to_vec(), vec![T::zero(); n]);
    let mut evaluate = |x: &[T], values: &mut [T], jacobian: &mut [T]| {
        let mut refusal = None;
        jacobian_of(x, values, jacobian, |x, out| {
            if let Err(error) = residual(x, out) {
                refusal = Some(error);
            }
        });
        refusal.map_or(Ok(()), Err)
    };
    evaluate(x, &mut values, &mut jacobian)?;
    let (mut previous, mut correction) = (f64::INFINITY, f64::INFINITY);
    let mut lifts = 0;
    for _ in 0..ITERATIONS {
        step.copy_from_slice(&values);
        lu::factor_in_place(&mut jacobian, &mut exchanges)?;
        lu::solve_in_place(&jacobian, &exchanges, &mut step)?;
        correction = relative_size(&step, x);
        let settled = correction <= 4.0 * f64::EPSILON || (correction <= 1e-9 && previous <= 2.0 * correction);
        let norm = size(&values);
        if !correction.is_finite() {
            return Err(HamiltonianError::NotSolved { condition, residual: norm, correction });
        }
        let mut fraction = 1.0;
        for halving in 0..=HALVINGS {
            for ((trial, &x), &step) in trial.iter_mut().zip(&*x).zip(&step) {
                *trial = x - T::lit(fraction) * step;
            }
            let accepted = evaluate(&trial, &mut values, &mut jacobian);
            let lower = accepted.is_ok() && size(&values) <= norm;
            // Near convergence residuals are made of rounding: steps are taken as they are.
            if lower || correction <= 1e-9 {
                accepted?;
                break;
            }
            if halving == HALVINGS {
                return Err(HamiltonianError::NotSolved { condition, residual: norm, correction });
            }
            fraction *= 0.5;
        }
        x.copy_from_slice(&trial);
        if settled {
            if T::ORDER <= lifts {
                return Ok(());
            }
            lifts += 1;
        }
        previous = correction;
    }
    Err(HamiltonianError::NotSolved { condition, residual: size(&values), correction })
}

/// The largest value of all components and lanes; infinite where one is no number.
fn size<T: Real>(values: &[T]) -> f64 {
    let lanes = values.iter().flat_map(|x| (0..T::LANES).map(|lane| x.primal(lane).abs()));
    lanes.fold(0.0, |m: f64, x| if x.is_nan() { f64::INFINITY } else { m.max(x) })
}

/// The largest correction relative to the largest component, of the worst lane.
fn relative_size<T: Real>(step: &[T], x: &[T]) -> f64 {
    let largest = |values: &[T], lane: usize| {
        let sizes = values.iter().map(|x| x.primal(lane).abs());
        sizes.fold(0.0, |m: f64, x| if x.is_nan() { f64::INFINITY } else { m.max(x) })
    };
    let ratio = |lane: usize| {
        let step = largest(step, lane);
        if step <= 0.0 {
            0.0
        } else if step < f64::INFINITY {
            step / largest(x, lane).max(step)
        } else {
            step
        }
    };
    (0..T::LANES).map(ratio).fold(0.0, f64::max)
}
