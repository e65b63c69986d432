//! Contact transformations with identities between old and new coordinates, by multipliers.
//!
//! ```text
//! Ω_c(q, Q, t) = 0,  c = 1…r
//! p = −∂W/∂q − λ_c ∂Ω_c/∂q        P = ∂W/∂Q + λ_c ∂Ω_c/∂Q
//! K = H − ∂W/∂t − λ_c ∂Ω_c/∂t                                                        W(11.14–11.17)
//! ```
//!
//! With r = n identities these are the point transformations, the identity map among them; with r = 0 the function W
//! alone makes the transformation.

use piola_numerics::{Dual, Gradient, Real};

use super::canonical::PhaseMap;
use super::differential::{CHUNK, with_room};
use super::generating::{GeneratingFunction, check_lengths, partials_into, time_partial};
use super::newton;
use crate::HamiltonianError;
use crate::check::check_length;

/// Identities Ω_c(q, Q, t) = 0 between old and new coordinates, written once for any scalar.
///
/// # Example
/// See [`DegenerateGenerated`].
///
/// # Source
/// W(11.14).
pub trait Identities {
    /// r, how many there are.
    fn count(&self) -> usize;
    /// Writes Ω_c, r values.
    fn values<T: Real>(&self, q: &[T], new_q: &[T], t: T, out: &mut [T]);
}

/// λ_c Ω_c + W as one function of q and Q, with the multipliers held.
struct WithMultipliers<'a, W, C, T> {
    function: &'a W,
    identities: &'a C,
    multipliers: &'a [T],
}

impl<W: GeneratingFunction, C: Identities, S: Real> WithMultipliers<'_, W, C, S> {
    /// Writes the partial derivatives by q, or by Q.
    fn partials_into(&self, (q, new_q, t): (&[S], &[S], S), by_old: bool, out: &mut [S]) {
        partials_into(self.function, (q, new_q, t), by_old, out);
        let (n, r) = (q.len(), self.multipliers.len());
        let zero = Gradient::<S, CHUNK>::constant(S::zero());
        let (from, to) = if by_old { (0, n) } else { (n, 2 * n) };
        with_room(zero, 2 * n, |seeds| {
            with_room(zero, r, |values| {
                for first in (from..to).step_by(CHUNK) {
                    for (i, (seed, &x)) in seeds.iter_mut().zip(q.iter().chain(new_q)).enumerate() {
                        *seed = Gradient::variable(x, i.wrapping_sub(first));
                    }
                    let (q, new_q) = seeds.split_at(n);
                    self.identities.values(q, new_q, Gradient::constant(t), values);
                    for (value, &multiplier) in values.iter().zip(self.multipliers) {
                        for (out, &partial) in out[first - from..].iter_mut().zip(&value.partials) {
                            *out += multiplier * partial;
                        }
                    }
                }
            });
        });
    }
}

/// The contact transformation of a function W(q, Q, t) under identities.
///
/// New coordinates and multipliers are found together by Newton's iteration from a guess of both.
///
/// # Errors
/// [`HamiltonianError::WrongLength`] for guesses of other lengths; [`HamiltonianError::Numerics`] where the equations
/// are singular, so where the identities depend on each other; [`HamiltonianError::NotSolved`].
///
/// # Example
/// No W at all and Q = q: the identity map, whose multipliers are the momenta with the other sign.
/// ```
/// use piola_hamiltonian::{DegenerateGenerated, GeneratingFunction, Identities, PhaseMap};
/// use piola_numerics::Real;
/// struct Nothing;
/// impl GeneratingFunction for Nothing {
///     fn value<T: Real>(&self, _q: &[T], _new_q: &[T], _t: T) -> T {
///         T::zero()
///     }
/// }
/// struct Same;
/// impl Identities for Same {
///     fn count(&self) -> usize {
///         2
///     }
///     fn values<T: Real>(&self, q: &[T], new_q: &[T], _t: T, out: &mut [T]) {
///         for i in 0..2 {
///             out[i] = q[i] - new_q[i];
///         }
///     }
/// }
/// let identity = DegenerateGenerated::new(Nothing, Same, &[0.0; 2], &[0.0; 2]);
/// let mut new = [0.0; 4];
/// identity.map(&[1.0, 2.0], &[3.0, 5.0], 0.0, &mut new)?;
/// assert_eq!(new, [1.0, 2.0, 3.0, 5.0]);
/// assert_eq!(identity.multipliers(&[1.0, 2.0], &[3.0, 5.0], 0.0)?, [-3.0, -5.0]);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(11.14–11.17).
#[derive(Clone, Debug, PartialEq)]
pub struct DegenerateGenerated<W, C> {
    function: W,
    identities: C,
    guess: Vec<f64>,
    coordinates: usize,
}

impl<W: GeneratingFunction, C: Identities> DegenerateGenerated<W, C> {
    /// The transformation of W under identities, with guesses of the new coordinates and of the multipliers.
    pub fn new(function: W, identities: C, new_coordinates: &[f64], multipliers: &[f64]) -> Self {
        let guess = [new_coordinates, multipliers].concat();
        Self { function, identities, guess, coordinates: new_coordinates.len() }
    }

    /// The multipliers λ_c at an old point.
    ///
    /// # Errors
    /// As [`DegenerateGenerated`].
    pub fn multipliers<T: Real>(&self, q: &[T], p: &[T], t: T) -> Result<Vec<T>, HamiltonianError> {
        let mut unknown = vec![T::zero(); self.guess.len()];
        self.find((q, p, t), &mut unknown)?;
        Ok(unknown.split_off(q.len()))
    }

    /// Finds (Q, λ).
    fn find<T: Real>(&self, (q, p, t): (&[T], &[T], T), unknown: &mut [T]) -> Result<(), HamiltonianError> {
        let (n, r) = (q.len(), self.identities.count());
        check_length("p", n, p.len())?;
        check_length("guess of the new coordinates", n, self.coordinates)?;
        check_length("guess of the multipliers", r, self.guess.len() - self.coordinates)?;
        for (x, &guess) in unknown.iter_mut().zip(&self.guess) {
            *x = T::lit(guess);
        }
        newton::solve("the identities of a contact transformation", unknown, |x, residual| {
            let (new_q, multipliers) = x.split_at(n);
            let t = Gradient::constant(t);
            let (momenta, identities) = residual.split_at_mut(n);
            with_room(Gradient::constant(T::zero()), n, |given| {
                for (given, &q) in given.iter_mut().zip(q) {
                    *given = Gradient::constant(q);
                }
                let sum = WithMultipliers { function: &self.function, identities: &self.identities, multipliers };
                sum.partials_into((given, new_q, t), true, momenta);
                self.identities.values(given, new_q, t, identities);
            });
            for (residual, &p) in momenta.iter_mut().zip(p) {
                *residual += Gradient::constant(p);
            }
            Ok(())
        })
    }
}

impl<W: GeneratingFunction, C: Identities> PhaseMap for DegenerateGenerated<W, C> {
    const TIME_DEPENDENT: bool = true;
    fn map<T: Real>(&self, q: &[T], p: &[T], t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
        check_lengths(q, p, new)?;
        with_room(T::zero(), self.guess.len(), |unknown| {
            self.find((q, p, t), unknown)?;
            let (found, multipliers) = unknown.split_at(q.len());
            let (new_q, new_p) = new.split_at_mut(q.len());
            new_q.copy_from_slice(found);
            let sum = WithMultipliers { function: &self.function, identities: &self.identities, multipliers };
            sum.partials_into((q, found, t), false, new_p);
            Ok(())
        })
    }
    fn excess<T: Real>(&self, q: &[T], p: &[T], t: T) -> Result<T, HamiltonianError> {
        with_room(T::zero(), self.guess.len(), |unknown| {
            self.find((q, p, t), unknown)?;
            let (new_q, multipliers) = unknown.split_at(q.len());
            let rates = identity_rates(&self.identities, q, new_q, t);
            let total = rates.iter().zip(multipliers).fold(T::zero(), |sum, (&rate, &l)| sum + l * rate);
            Ok(-(time_partial(&self.function, q, new_q, t) + total))
        })
    }
}

/// ∂Ω_c/∂t.
fn identity_rates<T: Real>(identities: &impl Identities, q: &[T], new_q: &[T], t: T) -> Vec<T> {
    let constants = |values: &[T]| values.iter().map(|&x| Dual::constant(x)).collect::<Vec<_>>();
    let mut out = vec![Dual::constant(T::zero()); identities.count()];
    identities.values(&constants(q), &constants(new_q), Dual::variable(t), &mut out);
    out.into_iter().map(|x| x.tangent).collect()
}
