//! Point transformations: new coordinates, and the momenta that belong to them.

use piola_numerics::linear::lu;
use piola_numerics::{Dual, Gradient, Real};

use crate::HamiltonianError;
use crate::check::check_length;
use crate::newton;
use crate::{InvertiblePhaseMap, PhaseMap};
use piola_lagrangian::ChangeOfCoordinates;

/// The canonical transformation of a change of coordinates q = c(Q, t).
///
/// ```text
/// q = c(Q, t)        P = (∂c/∂Q)ᵀ p        F = −p·∂c/∂t
/// ```
///
/// New coordinates are found by Newton's iteration from a guess; the way back, to old ones, needs none.
///
/// # Errors
/// [`HamiltonianError::WrongLength`]; [`HamiltonianError::Numerics`] where ∂c/∂Q is singular;
/// [`HamiltonianError::NotSolved`] where no new coordinates are found.
///
/// # Example
/// Sum and difference, q₁ = Q₁ + Q₂ and q₂ = Q₁ − Q₂:
/// ```
/// use piola_hamiltonian::{PhaseMap, PointTransformation};
/// use piola_lagrangian::ChangeOfCoordinates;
/// use piola_numerics::Real;
/// struct SumAndDifference;
/// impl ChangeOfCoordinates<2> for SumAndDifference {
///     fn old_coordinates<T: Real>(&self, new: &[T], _t: T) -> [T; 2] {
///         [new[0] + new[1], new[0] - new[1]]
///     }
/// }
/// let map = PointTransformation::new(SumAndDifference, [0.0; 2]);
/// let mut new = [0.0; 4];
/// map.map(&[5.0, 1.0], &[2.0, 3.0], 0.0, &mut new)?;
/// assert_eq!(new, [3.0, 2.0, 5.0, -1.0]);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(8.5), W(8.17).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointTransformation<C, const N: usize> {
    change: C,
    guess: [f64; N],
}

impl<C: ChangeOfCoordinates<N>, const N: usize> PointTransformation<C, N> {
    /// The transformation of a change; new coordinates are sought near `guess`.
    pub const fn new(change: C, guess: [f64; N]) -> Self {
        Self { change, guess }
    }

    /// The new coordinates.
    fn new_coordinates<T: Real>(&self, q: &[T], t: T) -> Result<[T; N], HamiltonianError> {
        check_length("q", N, q.len())?;
        let mut new = self.guess.map(T::lit);
        newton::solve("the new coordinates of a point", &mut new, |x, residual| {
            let old = self.change.old_coordinates(x, Gradient::constant(t));
            for ((residual, old), &q) in residual.iter_mut().zip(old).zip(q) {
                *residual = old - Gradient::constant(q);
            }
            Ok(())
        })?;
        Ok(new)
    }

    /// p·∂c/∂t at new coordinates.
    fn drag<T: Real>(&self, new: &[T; N], p: &[T], t: T) -> T {
        let moving = self.change.old_coordinates(&new.map(Dual::constant), Dual::variable(t));
        moving.iter().zip(p).fold(T::zero(), |sum, (q, &p)| sum + q.tangent * p)
    }
}

impl<C: ChangeOfCoordinates<N>, const N: usize> PhaseMap for PointTransformation<C, N> {
    const TIME_DEPENDENT: bool = C::TIME_DEPENDENT;
    fn map<T: Real>(&self, q: &[T], p: &[T], t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
        check_length("p", N, p.len())?;
        check_length("(Q, P)", 2 * N, new.len())?;
        let found = self.new_coordinates(q, t)?;
        new[..N].copy_from_slice(&found);
        for i in 0..N {
            let tangent = self.change.tangent(&found, t, i);
            new[N + i] = tangent.iter().zip(p).fold(T::zero(), |sum, (&h, &p)| sum + h * p);
        }
        Ok(())
    }
    fn excess<T: Real>(&self, q: &[T], p: &[T], t: T) -> Result<T, HamiltonianError> {
        if C::TIME_DEPENDENT { Ok(-self.drag(&self.new_coordinates(q, t)?, p, t)) } else { Ok(T::zero()) }
    }
}

impl<C: ChangeOfCoordinates<N>, const N: usize> InvertiblePhaseMap for PointTransformation<C, N> {
    fn invert<T: Real>(&self, new_q: &[T], new_p: &[T], t: T, old: &mut [T]) -> Result<(), HamiltonianError> {
        check_length("Q", N, new_q.len())?;
        check_length("P", N, new_p.len())?;
        check_length("(q, p)", 2 * N, old.len())?;
        let mut columns: [[T; N]; N] = core::array::from_fn(|i| self.change.tangent(new_q, t, i));
        let mut exchanges = [0; N];
        let flat = columns.as_flattened_mut();
        lu::factor_in_place(flat, &mut exchanges)?;
        let (q, p) = old.split_at_mut(N);
        q.copy_from_slice(&self.change.old_coordinates(new_q, t));
        p.copy_from_slice(new_p);
        lu::solve_transposed_in_place(flat, &exchanges, p)?;
        Ok(())
    }
}
