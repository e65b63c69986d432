//! Poisson brackets, nested at will.
//!
//! ```text
//! {K, H} = ∂K/∂q·∂H/∂p − ∂K/∂p·∂H/∂q                                                    W(9.20)
//! dK/dt = ∂K/∂t + {K, H}                                                                 W(10.17)
//! ```

use piola_numerics::{Gradient, Real};

use super::PhaseFunction;
use super::differential::{check_result, rate_in_time, with_room};
use crate::HamiltonianError;
use crate::check::check_length;

/// Coordinates, each with its momentum, in one pass.
const PAIRS: usize = 3;
/// Directions of differentiation in one pass.
const DIRECTIONS: usize = 2 * PAIRS;

/// Σ K_q H_p − K_p H_q, unchecked. Both functions are differentiated along a few conjugate pairs at a time, so that
/// nothing is stored, and {H, H} is zero to the last bit.
#[inline]
fn bracket<T: Real>(left: &impl PhaseFunction, right: &impl PhaseFunction, (q, p, t): (&[T], &[T], T)) -> T {
    let n = q.len();
    let time = Gradient::<T, DIRECTIONS>::constant(t);
    with_room(time, 2 * n, |seeds| {
        let mut sum = T::zero();
        for first in (0..n).step_by(PAIRS) {
            let (seeds_q, seeds_p) = seeds.split_at_mut(n);
            for i in 0..n {
                let direction = i.wrapping_sub(first);
                // The momenta of the pairs are the directions behind those of the coordinates.
                let conjugate = if direction < PAIRS { direction + PAIRS } else { DIRECTIONS };
                seeds_q[i] = Gradient::variable(q[i], if direction < PAIRS { direction } else { DIRECTIONS });
                seeds_p[i] = Gradient::variable(p[i], conjugate);
            }
            let (k, h) = (left.value(seeds_q, seeds_p, time), right.value(seeds_q, seeds_p, time));
            for pair in 0..PAIRS {
                sum += k.partials[pair] * h.partials[pair + PAIRS] - k.partials[pair + PAIRS] * h.partials[pair];
            }
        }
        sum
    })
}

/// The same of n degrees of freedom in one pass of D = 2n directions.
#[cfg_attr(not(debug_assertions), inline(always))]
fn bracket_at_once<T: Real, const D: usize>(
    left: &impl PhaseFunction,
    right: &impl PhaseFunction,
    (q, p, t): (&[T], &[T], T),
) -> T {
    let (n, time) = (D / 2, Gradient::<T, D>::constant(t));
    let seeds: [Gradient<T, D>; D] =
        core::array::from_fn(|i| Gradient::variable(if i < n { q[i] } else { p[i - n] }, i));
    let (q, p) = seeds.split_at(n);
    let (k, h) = (left.value(q, p, time).partials, right.value(q, p, time).partials);
    (0..n).fold(T::zero(), |sum, i| sum + (k[i] * h[n + i] - k[n + i] * h[i]))
}

/// The Poisson bracket {K, H} at a point of phase space.
///
/// ```text
/// {K, H} = ∂K/∂q·∂H/∂p − ∂K/∂p·∂H/∂q
/// ```
///
/// # Errors
/// [`HamiltonianError::WrongLength`]; [`HamiltonianError::NotFinite`], of the point or of the bracket.
///
/// # Accuracy
/// A few ulp of Σ |K_q H_p| + |K_p H_q| beside what K and H lose themselves; {K, H} = −{H, K} to the last bit.
///
/// # Example
/// The components of the angular momentum: {L₁, L₂} = L₃.
/// ```
/// use piola_hamiltonian::{PhaseFunction, poisson_bracket, rate_along};
/// use piola_numerics::Real;
/// struct Moment(usize);
/// impl PhaseFunction for Moment {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         let (j, k) = ((self.0 + 1) % 3, (self.0 + 2) % 3);
///         q[j] * p[k] - q[k] * p[j]
///     }
/// }
/// let (q, p) = ([1.0, 2.0, 3.0], [4.0, 5.0, 7.0]);
/// assert_eq!(poisson_bracket(&Moment(0), &Moment(1), &q, &p, 0.0)?, 1.0 * 5.0 - 2.0 * 4.0);
/// assert_eq!(rate_along(&Moment(0), &Moment(1), &q, &p, 0.0)?, -3.0); // L₂ as the Hamiltonian
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(9.20–9.21).
pub fn poisson_bracket<T: Real>(
    left: &impl PhaseFunction,
    right: &impl PhaseFunction,
    q: &[T],
    p: &[T],
    t: T,
) -> Result<T, HamiltonianError> {
    check_length("p", q.len(), p.len())?;
    // Few degrees of freedom go in one pass of numbers of that size; brackets inside brackets do not, for each size of
    // each would be compiled.
    let point = (q, p, t);
    let value = match q.len() {
        1 => bracket_at_once::<T, 2>(left, right, point),
        2 => bracket_at_once::<T, 4>(left, right, point),
        3 => bracket_at_once::<T, 6>(left, right, point),
        _ => bracket(left, right, point),
    };
    check_result((q, p, t), "{K, H}", &[value])?;
    Ok(value)
}

/// The bracket {K, H} as a function on phase space, for brackets of brackets.
///
/// # Example
/// Jacobi's identity, {K, {L, M}} + {L, {M, K}} + {M, {K, L}} = 0:
/// ```
/// use piola_hamiltonian::{Bracket, PhaseFunction, poisson_bracket};
/// use piola_numerics::Real;
/// struct Monomial(i32, i32); // qᵃ pᵇ
/// impl PhaseFunction for Monomial {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         q[0].powi(self.0) * p[0].powi(self.1)
///     }
/// }
/// let (k, l, m) = (Monomial(2, 1), Monomial(0, 3), Monomial(1, 2));
/// let nested = |a, b, c| poisson_bracket(a, &Bracket(b, c), &[2.0], &[3.0], 0.0);
/// assert_eq!(nested(&k, &l, &m)? + nested(&l, &m, &k)? + nested(&m, &k, &l)?, 0.0);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(9.20).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bracket<K, H>(pub K, pub H);

impl<K: PhaseFunction, H: PhaseFunction> PhaseFunction for Bracket<K, H> {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        bracket(&self.0, &self.1, (q, p, t))
    }
}

/// The rate of K along the motion of H.
///
/// ```text
/// dK/dt = ∂K/∂t + {K, H}
/// ```
///
/// The same number, read the other way, is the rate of a function along the flow of another: where K is an integral of
/// H, `rate_along(H, K)` = ∂H/∂t + ∂K/∂t.
///
/// # Errors
/// As [`poisson_bracket`].
///
/// # Source
/// W(10.17–10.19).
pub fn rate_along<T: Real>(
    function: &impl PhaseFunction,
    hamiltonian: &impl PhaseFunction,
    q: &[T],
    p: &[T],
    t: T,
) -> Result<T, HamiltonianError> {
    check_length("p", q.len(), p.len())?;
    let value = rate_in_time(function, q, p, t) + bracket(function, hamiltonian, (q, p, t));
    check_result((q, p, t), "dK/dt", &[value])?;
    Ok(value)
}
