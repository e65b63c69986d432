//! One implicit step, by Newton's method with exact derivatives.

use nalgebra::{SMatrix, SVector};
use piola_numerics::linear::lu;
use piola_numerics::{Gradient, Real};
use piola_tensor::internal::rows::Rows;

use crate::Evolution;

/// Numbers with their derivatives by the nine entries of F at the end of the increment.
pub(crate) type Varied = Gradient<f64, 9>;

/// Iterations after which an update is given up.
const MOST_ITERATIONS: usize = 40;

/// How an update came to its end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Iterations {
    pub(crate) count: usize,
    /// The largest modulus of the residual before the last iteration.
    pub(crate) residual: f64,
}

/// The largest modulus; NaN where one is.
fn size(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size: f64, x| if x.is_nan() || size < x.abs() { x.abs() } else { size })
}

fn values<const K: usize>(varied: &[Varied; K]) -> [f64; K] {
    varied.map(|x| x.value)
}

pub(crate) fn values_of_rows(varied: &Rows<Varied>) -> Rows<f64> {
    varied.map(|row| row.map(|x| x.value))
}

/// The residual and its derivatives by the unknowns.
#[inline(never)]
fn linearised<L: Evolution<S, X>, const S: usize, const X: usize>(
    law: &L,
    from: &[f64; S],
    gradient: &Rows<f64>,
    unknowns: &[f64; X],
    dt: f64,
) -> ([f64; X], SMatrix<f64, X, X>) {
    let lift = Gradient::<f64, X>::constant;
    let mut x = unknowns.map(lift);
    for (k, x) in x.iter_mut().enumerate() {
        *x = Gradient::variable(x.value, k);
    }
    let residual = law.residual(&from.map(lift), &gradient.map(|row| row.map(lift)), &x, dt);
    (residual.map(|r| r.value), SMatrix::from_fn(|i, j| residual[i].partials[j]))
}

/// Solutions of the linear equations, or why there are none.
fn solved<const X: usize>(matrix: &SMatrix<f64, X, X>, right: [f64; X]) -> Option<[f64; X]> {
    lu::solve(*matrix, SVector::from(right)).ok().map(Into::into)
}

/// The state at the end of one implicit step, with its derivatives; the iterations also where there is no such state.
#[inline(never)]
pub(crate) fn implicit_step<L: Evolution<S, X>, const S: usize, const X: usize>(
    law: &L,
    from: &[Varied; S],
    gradient: &Rows<Varied>,
    dt: f64,
) -> Result<([Varied; S], Iterations), Iterations> {
    let (start, f) = (values(from), values_of_rows(gradient));
    let mut iterations = Iterations { count: 0, residual: 0.0 };
    let mut unknowns = [0.0; X];
    if X == 0 || !law.evolves(&start, &f, dt) {
        let state = law.updated(from, gradient, &[Varied::constant(0.0); X], dt);
        return if size(&values(&state)).is_finite() { Ok((state, iterations)) } else { Err(iterations) };
    }
    let (mut residual, mut matrix) = linearised(law, &start, &f, &unknowns, dt);
    loop {
        let before = size(&residual);
        iterations.residual = before;
        if iterations.count == MOST_ITERATIONS || !before.is_finite() {
            return Err(iterations);
        }
        iterations.count += 1;
        let Some(step) = solved(&matrix, residual.map(|r| -r)) else { return Err(iterations) };
        // The whole step where it lowers the residual, otherwise a part of it.
        let mut share = 1.0;
        let mut next;
        loop {
            next = unknowns;
            for (x, step) in next.iter_mut().zip(step) {
                *x += share * step;
            }
            (residual, matrix) = linearised(law, &start, &f, &next, dt);
            let after = size(&residual);
            if after < before || after <= ROUNDING {
                break;
            }
            share *= 0.5;
            if share < SMALLEST_SHARE {
                // Where the residual is rounding alone nothing lowers it.
                if before <= NEARLY {
                    next = unknowns;
                    (residual, matrix) = linearised(law, &start, &f, &next, dt);
                    break;
                }
                return Err(iterations);
            }
        }
        let moved = size(&step) * share;
        unknowns = next;
        if size(&residual) <= ROUNDING || moved <= NEARLY {
            break;
        }
    }
    // x̂ = x − (∂r/∂x)⁻¹ r(ẑ, F̂, x): derivatives of the unknowns, and in their value one more iteration.
    let frozen = unknowns.map(Varied::constant);
    let varied = law.residual(from, gradient, &frozen, dt);
    let mut exact = frozen;
    let Some(correction) = solved(&matrix, values(&varied)) else { return Err(iterations) };
    for (x, correction) in exact.iter_mut().zip(correction) {
        x.value -= correction;
    }
    for direction in 0..9 {
        let Some(rate) = solved(&matrix, varied.map(|r| r.partials[direction])) else { return Err(iterations) };
        for (x, rate) in exact.iter_mut().zip(rate) {
            x.partials[direction] = -rate;
        }
    }
    let state = law.updated(from, gradient, &exact, dt);
    if size(&values(&state)).is_finite() { Ok((state, iterations)) } else { Err(iterations) }
}

/// A residual of rounding alone: unknowns and residuals are of the size of a strain.
pub(crate) const ROUNDING: f64 = 1e-15;
/// A residual or step after which one more iteration leaves rounding alone.
pub(crate) const NEARLY: f64 = 1e-9;
const SMALLEST_SHARE: f64 = 1e-4;

/// P and ∂P/∂F of the deformation and the state, both with derivatives.
#[inline(never)]
pub(crate) fn stress<L: Evolution<S, X>, const S: usize, const X: usize>(
    law: &L,
    gradient: &Rows<Varied>,
    state: &[Varied; S],
) -> Rows<Varied> {
    law.first_piola(gradient, state)
}

/// F₀ + s (F₁ − F₀), with derivatives by F₁.
pub(crate) fn between(start: &Rows<f64>, end: &Rows<f64>, share: f64) -> Rows<Varied> {
    let mut gradient = [[Varied::constant(0.0); 3]; 3];
    for (i, row) in gradient.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            // At the end exactly F₁.
            let value = if share < 1.0 { start[i][j] + share * (end[i][j] - start[i][j]) } else { end[i][j] };
            *entry = Varied::variable(value, 3 * i + j) * Varied::lit(1.0);
            entry.partials[3 * i + j] = share;
        }
    }
    gradient
}
