//! Roots of functions of one variable, and of small systems.

use nalgebra::{SMatrix, SVector};
use piola_numerics::Gradient;
use piola_numerics::linear::lu;

use crate::SolutionsError;

/// Steps after which a bracket of doubles is as small as it gets, with room for slow starts.
const STEPS: usize = 200;

/// The root of f between a and b, where f has different signs: Brent's method, to the last bits.
///
/// # Source
/// R. P. Brent, *Algorithms for Minimization without Derivatives*, ch. 4 (1973).
pub(crate) fn bracketed(
    mut f: impl FnMut(f64) -> Result<f64, SolutionsError>,
    (a, fa): (f64, f64),
    (b, fb): (f64, f64),
) -> Result<f64, SolutionsError> {
    let (mut a, mut fa, mut b, mut fb) = (a, fa, b, fb);
    let (mut c, mut fc) = (a, fa);
    let mut last = b - a;
    let mut step = last;
    for _ in 0..STEPS {
        if (fb < 0.0) == (fc < 0.0) {
            (c, fc) = (a, fa);
            last = b - a;
            step = last;
        }
        if fc.abs() < fb.abs() {
            (a, fa, b, fb, c, fc) = (b, fb, c, fc, b, fb);
        }
        let tolerance = 2.0 * f64::EPSILON * b.abs();
        let half = 0.5 * (c - b);
        if half.abs() <= tolerance || fb.abs() <= 0.0 {
            return Ok(b);
        }
        if last.abs() < tolerance || fa.abs() <= fb.abs() {
            (last, step) = (half, half);
        } else {
            let s = fb / fa;
            let (mut p, mut q) = if (a - c).abs() <= 0.0 {
                (2.0 * half * s, 1.0 - s)
            } else {
                let (q, r) = (fa / fc, fb / fc);
                (s * (2.0 * half * q * (q - r) - (b - a) * (r - 1.0)), (q - 1.0) * (r - 1.0) * (s - 1.0))
            };
            if 0.0 < p {
                q = -q;
            } else {
                p = -p;
            }
            let is_small = 2.0 * p < (3.0 * half * q - (tolerance * q).abs()).min((last * q).abs());
            (last, step) = if is_small { (step, p / q) } else { (half, half) };
        }
        (a, fa) = (b, fb);
        b += if tolerance < step.abs() { step } else { tolerance.copysign(half) };
        fb = f(b)?;
    }
    Ok(b)
}

/// Places of a range, evenly spaced; in proportion where both ends are positive.
pub(crate) fn places((low, high): (f64, f64), count: usize) -> impl Iterator<Item = f64> {
    let ratio = high / low;
    (0..=count).map(move |i| {
        let share = i as f64 / count as f64;
        match i {
            0 => low,
            _ if i == count => high,
            _ if 0.0 < low && 0.0 < high => low * ratio.powf(share),
            _ => low + (high - low) * share,
        }
    })
}

/// Newton's iteration for N equations in the first N of M variables; the others are given. Equations come divided by their
/// scales. A step that leaves the domain or makes things worse is halved.
pub(crate) fn newton<const N: usize, const M: usize>(
    load: &'static str,
    start: [f64; M],
    equations: impl Fn([Gradient<f64, M>; M]) -> Result<[Gradient<f64, M>; N], SolutionsError>,
) -> Result<[f64; M], SolutionsError> {
    const MOST: usize = 60;
    const { assert!(N <= M) };
    let at = |x: [f64; M]| equations(core::array::from_fn(|i| Gradient::variable(x[i], i)));
    let size = |values: &[Gradient<f64, M>; N]| values.iter().map(|r| r.value.abs()).fold(0.0, f64::max);
    let mut x = start;
    let mut values = at(x)?;
    for iteration in 0..MOST {
        let before = size(&values);
        if before <= 0.0 {
            return Ok(x);
        }
        let matrix = SMatrix::<f64, N, N>::from_fn(|i, j| values[i].partials[j]);
        let step = lu::solve(matrix, SVector::from(values.map(|value| -value.value)))?;
        let mut share = 1.0;
        let next = loop {
            let trial: [f64; M] = core::array::from_fn(|i| if i < N { x[i] + share * step[i] } else { x[i] });
            match at(trial) {
                Ok(found) if size(&found) < before => break Some((trial, found)),
                _ if share < 1e-6 || before < ROUNDING => break None,
                _ => share *= 0.5,
            }
        };
        match next {
            Some(next) => (x, values) = next,
            // Nothing improves: what is left is rounding, or there is no solution here.
            None if before < ROUNDING => return Ok(x),
            None => return Err(SolutionsError::NotConverged { load, residual: before, iterations: iteration }),
        }
    }
    Err(SolutionsError::NotConverged { load, residual: size(&values), iterations: MOST })
}

/// Residuals beside their scales that may be rounding.
const ROUNDING: f64 = 1e-11;

/// A load and its derivative with respect to the last of M variables, the first N of which satisfy N equations.
///
/// ```text
/// dL/dp = L_p − L_x (g_x)⁻¹ g_p
/// ```
pub(crate) fn implicit<const N: usize, const M: usize>(
    name: &'static str,
    start: [f64; M],
    state: impl Fn([Gradient<f64, M>; M]) -> Result<([Gradient<f64, M>; N], Gradient<f64, M>), SolutionsError>,
) -> Result<([f64; M], [f64; 2]), SolutionsError> {
    const { assert!(N + 1 == M) };
    let x = newton(name, start, |x| Ok(state(x)?.0))?;
    let (equations, load) = state(core::array::from_fn(|i| Gradient::variable(x[i], i)))?;
    let matrix = SMatrix::<f64, N, N>::from_fn(|i, j| equations[i].partials[j]);
    let rates = lu::solve(matrix, SVector::from(equations.map(|equation| -equation.partials[N])))?;
    let slope = (0..N).fold(load.partials[N], |slope, i| slope + load.partials[i] * rates[i]);
    Ok((x, [load.value, slope]))
}
