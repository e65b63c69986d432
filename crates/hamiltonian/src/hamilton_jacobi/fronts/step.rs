//! One step of a ray of given energy, over its action.
//!
//! ```text
//! dq/dS = H_p/(p·H_p),   dp/dS = −H_q/(p·H_p),   S = ∫ p·dq
//! ```
//!
//! Gragg's modified midpoint rule with 2, 4 and 6 substeps, extrapolated in the square of the substep: order six, with
//! the result of order four as an estimate of the error. Ten evaluations of the field, no table, no memory: the state
//! is a few numbers, each with its derivatives by the parameters of the front, over any scalar.
//!
//! E. Hairer, S. P. Nørsett & G. Wanner, *Solving Ordinary Differential Equations I*, II.9.

use core::array::from_fn;

use piola_numerics::{Gradient, Real};

use crate::PhaseFunction;

/// A place or momentum with its derivatives by M parameters.
pub(super) type Varied<T, const N: usize, const M: usize> = [Gradient<T, M>; N];

/// (q, p), or their rates.
pub(super) type State<T, const N: usize, const M: usize> = [Varied<T, N, M>; 2];

/// d(q, p)/dS.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn rate<H: PhaseFunction, T: Real, const N: usize, const M: usize>(
    hamiltonian: &H,
    [q, p]: &State<T, N, M>,
) -> State<T, N, M> {
    let time = Gradient::<Gradient<T, M>, N>::constant(Gradient::constant(T::zero()));
    let fixed = |x: &Varied<T, N, M>| -> [Gradient<Gradient<T, M>, N>; N] { from_fn(|i| Gradient::constant(x[i])) };
    let free = |x: &Varied<T, N, M>| -> [Gradient<Gradient<T, M>, N>; N] { from_fn(|i| Gradient::variable(x[i], i)) };
    let by_q = hamiltonian.value(&free(q), &fixed(p), time).partials;
    let by_p = hamiltonian.value(&fixed(q), &free(p), time).partials;
    let mut along = Gradient::constant(T::zero());
    for i in 0..N {
        along += p[i] * by_p[i];
    }
    let inverse = along.recip();
    [from_fn(|i| by_p[i] * inverse), from_fn(|i| -by_q[i] * inverse)]
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn combine<T: Real, const N: usize, const M: usize>(
    a: &State<T, N, M>,
    weight: f64,
    b: &State<T, N, M>,
) -> State<T, N, M> {
    let weight = Gradient::constant(T::lit(weight));
    from_fn(|k| from_fn(|i| a[k][i] + weight * b[k][i]))
}

/// The modified midpoint rule with an even number of substeps.
#[cfg_attr(not(debug_assertions), inline(always))]
fn midpoint<H: PhaseFunction, T: Real, const N: usize, const M: usize>(
    hamiltonian: &H,
    (start, slope): (&State<T, N, M>, &State<T, N, M>),
    step: f64,
    substeps: u8,
) -> State<T, N, M> {
    let part = step / f64::from(substeps);
    let (mut before, mut now) = (*start, combine(start, part, slope));
    for _ in 1..substeps {
        let next = combine(&before, 2.0 * part, &rate(hamiltonian, &now));
        (before, now) = (now, next);
    }
    now
}

/// The state a step of the action later, and the difference to the result of order four, of q and p.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn advance<H: PhaseFunction, T: Real, const N: usize, const M: usize>(
    hamiltonian: &H,
    state: &State<T, N, M>,
    step: f64,
) -> (State<T, N, M>, [T; 2]) {
    let slope = rate(hamiltonian, state);
    let [two, four, six] = [2, 4, 6].map(|n| midpoint(hamiltonian, (state, &slope), step, n));
    // Neville's scheme: divisors (4/2)² − 1, (6/4)² − 1, (6/2)² − 1.
    let lower = |a: &State<T, N, M>, b: &State<T, N, M>, weight: f64| combine(b, weight, &combine(b, -1.0, a));
    let (coarse, fine) = (lower(&two, &four, 1.0 / 3.0), lower(&four, &six, 1.0 / 1.25));
    let result = lower(&coarse, &fine, 1.0 / 8.0);
    let mut errors = [T::zero(); 2];
    for (error, (a, b)) in errors.iter_mut().zip(result.iter().zip(&fine)) {
        for i in 0..N {
            *error = error.max((a[i].value - b[i].value).abs());
        }
    }
    (result, errors)
}
