//! Maps of phase space made of others: inverses and compositions.

use piola_numerics::{Gradient, Real};

use super::canonical::{InvertiblePhaseMap, PhaseMap};
use super::differential::with_room;
use super::newton;
use crate::HamiltonianError;
use crate::check::check_length;

/// The inverse of a map: it takes new coordinates to old ones, and its F is that of the map with the other sign.
///
/// # Example
/// ```
/// use piola_hamiltonian::{Inverse, PhaseMap, PolarCoordinates};
/// let mut cartesian = [0.0; 4];
/// Inverse(PolarCoordinates).map(&[2.0, 0.0], &[3.0, 8.0], 0.0, &mut cartesian)?;
/// assert_eq!(cartesian, [2.0, 0.0, 3.0, 4.0]);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inverse<M>(pub M);

impl<M: InvertiblePhaseMap> PhaseMap for Inverse<M> {
    const TIME_DEPENDENT: bool = M::TIME_DEPENDENT;
    fn map<T: Real>(&self, q: &[T], p: &[T], t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
        self.0.invert(q, p, t, new)
    }
    fn excess<T: Real>(&self, q: &[T], p: &[T], t: T) -> Result<T, HamiltonianError> {
        with_room(T::zero(), 2 * q.len(), |old| {
            self.0.invert(q, p, t, old)?;
            let (q, p) = old.split_at(q.len());
            Ok(-self.0.excess(q, p, t)?)
        })
    }
}

impl<M: InvertiblePhaseMap> InvertiblePhaseMap for Inverse<M> {
    fn invert<T: Real>(&self, new_q: &[T], new_p: &[T], t: T, old: &mut [T]) -> Result<(), HamiltonianError> {
        self.0.map(new_q, new_p, t, old)
    }
}

/// One map after another: first `.0`, then `.1`. Their F add up.
///
/// # Example
/// Polar coordinates in a frame that turns: the angle runs back with it.
/// ```
/// use piola_hamiltonian::{Composed, PhaseMap, PolarCoordinates, RotatingFrame};
/// let turning = Composed(RotatingFrame::new(0.5)?, PolarCoordinates);
/// let mut new = [0.0_f64; 4];
/// turning.map(&[2.0, 0.0], &[0.0, 3.0], 1.0, &mut new)?;
/// assert!((new[1] + 0.5).abs() < 1e-15 && (new[3] - 6.0).abs() < 1e-14); // φ, p_φ
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(10.20).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composed<A, B>(pub A, pub B);

impl<A: PhaseMap, B: PhaseMap> PhaseMap for Composed<A, B> {
    const TIME_DEPENDENT: bool = A::TIME_DEPENDENT || B::TIME_DEPENDENT;
    fn map<T: Real>(&self, q: &[T], p: &[T], t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
        with_room(T::zero(), 2 * q.len(), |between| {
            self.0.map(q, p, t, between)?;
            let (q, p) = between.split_at(q.len());
            self.1.map(q, p, t, new)
        })
    }
    fn excess<T: Real>(&self, q: &[T], p: &[T], t: T) -> Result<T, HamiltonianError> {
        with_room(T::zero(), 2 * q.len(), |between| {
            self.0.map(q, p, t, between)?;
            let first = self.0.excess(q, p, t)?;
            let (q, p) = between.split_at(q.len());
            Ok(first + self.1.excess(q, p, t)?)
        })
    }
}

impl<A: InvertiblePhaseMap, B: InvertiblePhaseMap> InvertiblePhaseMap for Composed<A, B> {
    fn invert<T: Real>(&self, new_q: &[T], new_p: &[T], t: T, old: &mut [T]) -> Result<(), HamiltonianError> {
        with_room(T::zero(), 2 * new_q.len(), |between| {
            self.1.invert(new_q, new_p, t, between)?;
            let (q, p) = between.split_at(new_q.len());
            self.0.invert(q, p, t, old)
        })
    }
}

/// Any map with an inverse found by Newton's iteration from a guess of the old point.
///
/// # Example
/// ```
/// use piola_hamiltonian::HamiltonianError;
/// use piola_hamiltonian::{InvertedByNewton, InvertiblePhaseMap, PhaseMap};
/// use piola_numerics::Real;
/// struct Kick; // p jumps by q³
/// impl PhaseMap for Kick {
///     fn map<T: Real>(&self, q: &[T], p: &[T], _t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
///         new[1] = p[0] + q[0] * q[0] * q[0];
///         new[0] = q[0] + new[1];
///         Ok(())
///     }
/// }
/// let mut old = [0.0; 2];
/// InvertedByNewton { map: Kick, guess: vec![0.0, 0.0] }.invert(&[3.0], &[2.0], 0.0, &mut old)?;
/// assert_eq!(old, [1.0, 1.0]);
/// # Ok::<(), HamiltonianError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct InvertedByNewton<M> {
    /// The map.
    pub map: M,
    /// Where the iteration starts: (q, p).
    pub guess: Vec<f64>,
}

impl<M: PhaseMap> PhaseMap for InvertedByNewton<M> {
    const TIME_DEPENDENT: bool = M::TIME_DEPENDENT;
    fn map<T: Real>(&self, q: &[T], p: &[T], t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
        self.map.map(q, p, t, new)
    }
    fn excess<T: Real>(&self, q: &[T], p: &[T], t: T) -> Result<T, HamiltonianError> {
        self.map.excess(q, p, t)
    }
}

impl<M: PhaseMap> InvertiblePhaseMap for InvertedByNewton<M> {
    fn invert<T: Real>(&self, new_q: &[T], new_p: &[T], t: T, old: &mut [T]) -> Result<(), HamiltonianError> {
        let n = new_q.len();
        check_length("guess", 2 * n, self.guess.len())?;
        for (old, &guess) in old.iter_mut().zip(&self.guess) {
            *old = T::lit(guess);
        }
        newton::solve("the point that a map takes to (Q, P)", old, |x, residual| {
            let (q, p) = x.split_at(n);
            self.map.map(q, p, Gradient::constant(t), residual)?;
            for (residual, &new) in residual.iter_mut().zip(new_q.iter().chain(new_p)) {
                *residual -= Gradient::constant(new);
            }
            Ok(())
        })
    }
}
