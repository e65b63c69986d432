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

/// Scalar of an increment: with derivatives by F where the tangent is wanted, `f64` for the stress alone.
pub(crate) trait IncrementScalar: Real {
    /// The entry at a place of F at a share of the increment, where it has this value.
    fn entry(value: f64, place: usize, share: f64) -> Self;

    /// The unknowns that solve the equations of a step: one more iteration in their value, and their derivatives.
    fn exact<L: Evolution<S, X>, const S: usize, const X: usize>(
        law: &L,
        from: &[Self; S],
        gradient: &Rows<Self>,
        dt: f64,
        solution: &Solution<X>,
    ) -> Option<[Self; X]>;
}

impl IncrementScalar for f64 {
    fn entry(value: f64, _place: usize, _share: f64) -> Self {
        value
    }

    fn exact<L: Evolution<S, X>, const S: usize, const X: usize>(
        _law: &L,
        _from: &[Self; S],
        _gradient: &Rows<Self>,
        _dt: f64,
        solution: &Solution<X>,
    ) -> Option<[Self; X]> {
        let mut exact = solution.unknowns;
        for (x, correction) in exact.iter_mut().zip(solved(&solution.matrix, solution.residual)?) {
            *x -= correction;
        }
        Some(exact)
    }
}

impl IncrementScalar for Varied {
    fn entry(value: f64, place: usize, share: f64) -> Self {
        let mut entry = Self::variable(value, place);
        entry.partials[place] = share;
        entry
    }

    /// x̂ = x − (∂r/∂x)⁻¹ r(ẑ, F̂, x).
    fn exact<L: Evolution<S, X>, const S: usize, const X: usize>(
        law: &L,
        from: &[Self; S],
        gradient: &Rows<Self>,
        dt: f64,
        solution: &Solution<X>,
    ) -> Option<[Self; X]> {
        let mut exact = solution.unknowns.map(Self::constant);
        let varied = law.residual(from, gradient, &exact, dt);
        for (x, correction) in exact.iter_mut().zip(solved(&solution.matrix, values(&varied))?) {
            x.value -= correction;
        }
        for direction in 0..9 {
            let rates = solved(&solution.matrix, varied.map(|r| r.partials[direction]))?;
            for (x, rate) in exact.iter_mut().zip(rates) {
                x.partials[direction] = -rate;
            }
        }
        Some(exact)
    }
}

/// How an update came to its end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Iterations {
    pub(crate) count: usize,
    /// The largest modulus of the residual before the last iteration.
    pub(crate) residual: f64,
}

/// The largest modulus; NaN where one is.
pub(crate) fn size(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size: f64, x| if x.is_nan() || size < x.abs() { x.abs() } else { size })
}

pub(crate) fn values<T: IncrementScalar, const K: usize>(varied: &[T; K]) -> [f64; K] {
    varied.map(|x| x.primal(0))
}

pub(crate) fn values_of_rows<T: IncrementScalar>(varied: &Rows<T>) -> Rows<f64> {
    varied.map(|row| row.map(|x| x.primal(0)))
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

/// What Newton's method has found: unknowns, their residual, and its derivatives.
pub(crate) struct Solution<const X: usize> {
    unknowns: [f64; X],
    residual: [f64; X],
    matrix: SMatrix<f64, X, X>,
    iterations: Iterations,
}

/// Solves the equations of one implicit step; the iterations where it does not.
#[inline(never)]
fn solution<L: Evolution<S, X>, const S: usize, const X: usize>(
    law: &L,
    start: &[f64; S],
    f: &Rows<f64>,
    dt: f64,
) -> Result<Solution<X>, Iterations> {
    let mut iterations = Iterations { count: 0, residual: 0.0 };
    let mut unknowns = [0.0; X];
    let (mut residual, mut matrix) = linearised(law, start, f, &unknowns, dt);
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
            (residual, matrix) = linearised(law, start, f, &next, dt);
            let after = size(&residual);
            if after < before || after <= ROUNDING {
                break;
            }
            share *= 0.5;
            if share < SMALLEST_SHARE {
                // Where the residual is rounding alone nothing lowers it.
                if before <= NEARLY {
                    next = unknowns;
                    (residual, matrix) = linearised(law, start, f, &next, dt);
                    break;
                }
                return Err(iterations);
            }
        }
        let moved = size(&step) * share;
        unknowns = next;
        if size(&residual) <= ROUNDING || moved <= NEARLY {
            return Ok(Solution { unknowns, residual, matrix, iterations });
        }
    }
}

/// Takes one implicit step and returns the state at its end with the iterations. Where Newton's method fails it returns the iterations alone.
#[inline(never)]
pub(crate) fn implicit_step<T: IncrementScalar, L: Evolution<S, X>, const S: usize, const X: usize>(
    law: &L,
    from: &[T; S],
    gradient: &Rows<T>,
    dt: f64,
) -> Result<([T; S], Iterations), Iterations> {
    let (start, f) = (values(from), values_of_rows(gradient));
    let mut unknowns = [T::zero(); X];
    let mut iterations = Iterations { count: 0, residual: 0.0 };
    if X != 0 && law.evolves(&start, &f, dt) {
        let solution = solution(law, &start, &f, dt)?;
        iterations = solution.iterations;
        unknowns = T::exact(law, from, gradient, dt, &solution).ok_or(iterations)?;
    }
    let state = law.updated(from, gradient, &unknowns, dt);
    if size(&values(&state)).is_finite() { Ok((state, iterations)) } else { Err(iterations) }
}

/// A residual of rounding alone: unknowns and residuals are of the size of a strain.
pub(crate) const ROUNDING: f64 = 1e-15;
/// A residual or step after which one more iteration leaves rounding alone.
pub(crate) const NEARLY: f64 = 1e-9;
const SMALLEST_SHARE: f64 = 1e-4;

/// P of the deformation and the state, with derivatives where both have them.
#[inline(never)]
pub(crate) fn stress<T: IncrementScalar, L: Evolution<S, X>, const S: usize, const X: usize>(
    law: &L,
    gradient: &Rows<T>,
    state: &[T; S],
) -> Rows<T> {
    law.first_piola(gradient, state)
}

/// a + s (b − a).
pub(crate) fn along(start: f64, end: f64, share: f64) -> f64 {
    start + share * (end - start)
}

/// F₀ + s (F₁ − F₀), with derivatives by F₁ where its numbers have them.
pub(crate) fn between<T: IncrementScalar>(start: &Rows<f64>, end: &Rows<f64>, share: f64) -> Rows<T> {
    let mut gradient = [[T::zero(); 3]; 3];
    for (i, row) in gradient.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            // At the end exactly F₁.
            let value = if share < 1.0 { along(start[i][j], end[i][j], share) } else { end[i][j] };
            *entry = T::entry(value, 3 * i + j, share);
        }
    }
    gradient
}
