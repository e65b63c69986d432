//! Exact derivatives of functions on phase space: dK, its symplectic gradient, ∂K/∂t and ∂²K.
//!
//! ```text
//! dK = K_q dq + K_p dp        k = ω⁻¹(dK) = (K_p, −K_q)                                      W(9.13–9.14)
//! ```
//!
//! Vectors and covectors on phase space have 2n components: those along q, then those along p.

use nalgebra::{DMatrix, DVector};
use piola_numerics::{Dual, Gradient, Mask, Real};

use super::PhaseFunction;
use crate::HamiltonianError;
use crate::check::{check_finite, check_length};

/// Directions of differentiation in one pass.
pub(crate) const CHUNK: usize = 4;

/// Runs `body` with room for `length` numbers: on the stack for the systems that occur in text books.
#[inline]
pub(crate) fn with_room<X: Copy, R>(initial: X, length: usize, body: impl FnOnce(&mut [X]) -> R) -> R {
    match length {
        0..=4 => body(&mut [initial; 4][..length]),
        5..=8 => body(&mut [initial; 8][..length]),
        9..=16 => body(&mut [initial; 16][..length]),
        _ => body(&mut vec![initial; length]),
    }
}

/// What is not a number, and whose derivatives are not either: a constant that is none would have the derivative zero.
pub(crate) fn undefined<T: Real>() -> T {
    T::zero() / T::zero()
}

/// Writes dK to `out`, by means of `seeds` of 2n numbers, and returns K.
#[inline]
pub(crate) fn differentiate<T: Real>(
    function: &impl PhaseFunction,
    (q, p, t): (&[T], &[T], T),
    seeds: &mut [Gradient<T, CHUNK>],
    out: &mut [T],
) -> T {
    let n = q.len();
    let time = Gradient::constant(t);
    let mut value = T::zero();
    for first in (0..2 * n).step_by(CHUNK) {
        for (i, (seed, &x)) in seeds.iter_mut().zip(q.iter().chain(p)).enumerate() {
            *seed = Gradient::variable(x, i.wrapping_sub(first));
        }
        let (q, p) = seeds.split_at(n);
        let result = function.value(q, p, time);
        value = result.value;
        for (out, partial) in out[first..].iter_mut().zip(result.partials) {
            *out = partial;
        }
    }
    value
}

/// [`differentiate`] of D/2 degrees of freedom in one pass, with numbers of known size.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn differentiate_at_once<T: Real, const D: usize>(
    function: &impl PhaseFunction,
    (q, p, t): (&[T], &[T], T),
    out: &mut [T],
) {
    let seeds: [Gradient<T, D>; D] =
        core::array::from_fn(|i| Gradient::variable(if i < D / 2 { q[i] } else { p[i - D / 2] }, i));
    let (q, p) = seeds.split_at(D / 2);
    out[..D].copy_from_slice(&function.value(q, p, Gradient::constant(t)).partials);
}

/// [`differentiate`] with room of its own.
#[inline]
pub(crate) fn differentiate_at<T: Real>(function: &impl PhaseFunction, point: (&[T], &[T], T), out: &mut [T]) -> T {
    with_room(Gradient::constant(T::zero()), 2 * point.0.len(), |seeds| differentiate(function, point, seeds, out))
}

/// ∂K/∂t, unchecked.
#[inline]
pub(crate) fn rate_in_time<T: Real>(function: &impl PhaseFunction, q: &[T], p: &[T], t: T) -> T {
    with_room(Dual::constant(T::zero()), 2 * q.len(), |state| {
        for (x, &value) in state.iter_mut().zip(q.iter().chain(p)) {
            *x = Dual::constant(value);
        }
        let (q, p) = state.split_at(q.len());
        function.value(q, p, Dual::variable(t)).tangent
    })
}

/// Refuses a result that is not finite, by the name of what is not finite of the point it comes from.
pub(crate) fn check_result<T: Real>(
    point: (&[T], &[T], T),
    quantity: &'static str,
    result: &[T],
) -> Result<(), HamiltonianError> {
    let all = result.iter().fold(T::Mask::splat(true), |all, x| all & x.is_finite());
    if all.all() {
        return Ok(());
    }
    check_finite("q", point.0)?;
    check_finite("p", point.1)?;
    check_finite("t", &[point.2])?;
    check_finite(quantity, result)
}

/// The differential dK = (∂K/∂q, ∂K/∂p).
///
/// # Errors
/// [`HamiltonianError::WrongLength`]; [`HamiltonianError::NotFinite`], of the point or of dK where K has no
/// derivative.
///
/// # Accuracy
/// That of K's own operations: derivatives are exact to rounding.
///
/// # Example
/// ```
/// use piola_hamiltonian::{PhaseFunction, differential, hessian, symplectic_gradient, time_derivative};
/// use piola_numerics::Real;
/// struct Product; // K = q p²
/// impl PhaseFunction for Product {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         q[0] * p[0] * p[0]
///     }
/// }
/// assert_eq!(differential(&Product, &[3.0], &[2.0], 0.0)?.as_slice(), [4.0, 12.0]);
/// assert_eq!(symplectic_gradient(&Product, &[3.0], &[2.0], 0.0)?.as_slice(), [12.0, -4.0]);
/// assert_eq!(hessian(&Product, &[3.0], &[2.0], 0.0)?.as_slice(), [0.0, 4.0, 4.0, 6.0]);
/// assert_eq!(time_derivative(&Product, &[3.0], &[2.0], 7.0)?, 0.0);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(9.14).
pub fn differential<T: Real>(
    function: &impl PhaseFunction,
    q: &[T],
    p: &[T],
    t: T,
) -> Result<DVector<T>, HamiltonianError> {
    check_length("p", q.len(), p.len())?;
    let mut out = DVector::from_element(2 * q.len(), T::zero());
    differentiate_at(function, (q, p, t), out.as_mut_slice());
    check_result((q, p, t), "dK", out.as_slice())?;
    Ok(out)
}

/// The Hamiltonian vector field of K at a point, (∂K/∂p, −∂K/∂q): for a Hamiltonian the rates (q̇, ṗ).
///
/// # Errors
/// As [`differential`].
///
/// # Source
/// W(9.13), W p. 57.
pub fn symplectic_gradient<T: Real>(
    function: &impl PhaseFunction,
    q: &[T],
    p: &[T],
    t: T,
) -> Result<DVector<T>, HamiltonianError> {
    let differential = differential(function, q, p, t)?;
    let n = q.len();
    Ok(DVector::from_fn(2 * n, |i, _| if i < n { differential[n + i] } else { -differential[i - n] }))
}

/// ∂K/∂t at a fixed point of phase space.
///
/// Along the motion of H this is the rate of H itself: dH/dt = ∂H/∂t.
///
/// # Errors
/// As [`differential`].
///
/// # Source
/// W(10.16).
pub fn time_derivative<T: Real>(function: &impl PhaseFunction, q: &[T], p: &[T], t: T) -> Result<T, HamiltonianError> {
    check_length("p", q.len(), p.len())?;
    let rate = rate_in_time(function, q, p, t);
    check_result((q, p, t), "∂K/∂t", &[rate])?;
    Ok(rate)
}

/// The second derivatives ∂²K/∂(q, p)∂(q, p), 2n×2n.
///
/// # Errors
/// As [`differential`].
///
/// # Source
/// The linearisation of W(9.10).
pub fn hessian<T: Real>(function: &impl PhaseFunction, q: &[T], p: &[T], t: T) -> Result<DMatrix<T>, HamiltonianError> {
    check_length("p", q.len(), p.len())?;
    let n = q.len();
    let mut out = DMatrix::from_element(2 * n, 2 * n, T::zero());
    let zero = Gradient::<T, CHUNK>::constant(T::zero());
    let (mut point, mut row) = (vec![zero; 2 * n], vec![zero; 2 * n]);
    for first in (0..2 * n).step_by(CHUNK) {
        for (i, (x, &value)) in point.iter_mut().zip(q.iter().chain(p)).enumerate() {
            *x = Gradient::variable(value, i.wrapping_sub(first));
        }
        let (q, p) = point.split_at(n);
        differentiate_at(function, (q, p, Gradient::constant(t)), &mut row);
        for (i, partial) in row.iter().enumerate() {
            for (j, &second) in (first..2 * n).zip(&partial.partials) {
                out[(i, j)] = second;
            }
        }
    }
    check_result((q, p, t), "∂²K", out.as_slice())?;
    Ok(out)
}
