//! Velocities and momenta in other coordinates, and vectors tangent to phase space itself.
//!
//! ```text
//! v^Δ = ∂q^Δ/∂q̄^Γ v̄^Γ        p̄_Δ = ∂q^Γ/∂q̄^Δ p_Γ                                           W(8.4–8.5)
//! δq = (∂q/∂q̄) δq̄            δp = ∂p/∂q̄ δq̄ + (∂q/∂q̄)⁻ᵀ δp̄                                W(8.17)
//! ```
//!
//! A velocity and a momentum pair to a number that no change of coordinates touches: p·v = p̄·v̄.

use piola_numerics::linear::lu;
use piola_numerics::{Dual, Real};

use crate::HamiltonianError;
use crate::check::check_finite;
use piola_lagrangian::ChangeOfCoordinates;

/// ∂q^Γ/∂q̄^Δ, row Γ, column Δ, by columns.
fn tangent_map<T: Real, const N: usize>(change: &impl ChangeOfCoordinates<N>, new: &[T; N], t: T) -> [[T; N]; N] {
    core::array::from_fn(|direction| change.tangent(new, t, direction))
}

/// Solves A x = b, or Aᵀ x = b, with the columns of A.
fn solve<T: Real, const N: usize>(
    mut columns: [[T; N]; N],
    mut b: [T; N],
    transposed: bool,
) -> Result<[T; N], HamiltonianError> {
    let mut exchanges = [0; N];
    let flat = columns.as_flattened_mut();
    lu::factor_in_place(flat, &mut exchanges)?;
    if transposed {
        lu::solve_transposed_in_place(flat, &exchanges, &mut b)?;
    } else {
        lu::solve_in_place(flat, &exchanges, &mut b)?;
    }
    Ok(b)
}

/// A tangent vector of the configuration space: a velocity, contravariant.
///
/// # Example
/// A particle 2 m from the origin that turns with 3 rad/s has the speed 6 m/s along y, and back:
/// ```
/// use piola_hamiltonian::TangentVector;
/// use piola_lagrangian::ChangeOfCoordinates;
/// use piola_numerics::Real;
/// struct Polar; // x, y of r, φ
/// impl ChangeOfCoordinates<2> for Polar {
///     fn old_coordinates<T: Real>(&self, new: &[T], _t: T) -> [T; 2] {
///         let (s, c) = new[1].sin_cos();
///         [new[0] * c, new[0] * s]
///     }
/// }
/// let polar = [2.0, 0.0];
/// let old = TangentVector([0.0, 3.0]).to_old(&Polar, &polar, 0.0);
/// assert_eq!(old, TangentVector([0.0, 6.0]));
/// assert_eq!(old.to_new(&Polar, &polar, 0.0)?, TangentVector([0.0, 3.0]));
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(8.4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TangentVector<T, const N: usize>(pub [T; N]);

impl<T: Real, const N: usize> TangentVector<T, N> {
    /// v = (∂q/∂q̄) v̄: from the new coordinates of a change q = c(q̄, t) to the old ones, at fixed time.
    #[must_use]
    pub fn to_old(self, change: &impl ChangeOfCoordinates<N>, new: &[T; N], t: T) -> Self {
        let seeds: [Dual<T>; N] = core::array::from_fn(|i| Dual::new(new[i], self.0[i]));
        Self(change.old_coordinates(&seeds, Dual::constant(t)).map(|q| q.tangent))
    }

    /// v̄ = (∂q/∂q̄)⁻¹ v: from the old coordinates to the new ones, at the point of new coordinates q̄.
    ///
    /// # Errors
    /// [`HamiltonianError::Numerics`] where the change of coordinates is singular; [`HamiltonianError::NotFinite`].
    pub fn to_new(self, change: &impl ChangeOfCoordinates<N>, new: &[T; N], t: T) -> Result<Self, HamiltonianError> {
        check_finite("v", &self.0)?;
        check_finite("q̄", new)?;
        Ok(Self(solve(tangent_map(change, new, t), self.0, false)?))
    }
}

/// A cotangent vector of the configuration space: a momentum, covariant.
///
/// # Example
/// In polar coordinates the momentum along φ is the angular momentum:
/// ```
/// use piola_hamiltonian::{CotangentVector, TangentVector};
/// use piola_lagrangian::ChangeOfCoordinates;
/// use piola_numerics::Real;
/// struct Polar; // x, y of r, φ
/// impl ChangeOfCoordinates<2> for Polar {
///     fn old_coordinates<T: Real>(&self, new: &[T], _t: T) -> [T; 2] {
///         let (s, c) = new[1].sin_cos();
///         [new[0] * c, new[0] * s]
///     }
/// }
/// let polar = [2.0, 0.0];
/// let momentum = CotangentVector([5.0, 7.0]).to_new(&Polar, &polar, 0.0);
/// assert_eq!(momentum, CotangentVector([5.0, 14.0]));
/// assert_eq!(momentum.to_old(&Polar, &polar, 0.0)?, CotangentVector([5.0, 7.0]));
/// assert_eq!(momentum.of(TangentVector([1.0, 3.0])), 47.0);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(8.5).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CotangentVector<T, const N: usize>(pub [T; N]);

impl<T: Real, const N: usize> CotangentVector<T, N> {
    /// p·v, the number that a momentum makes of a velocity.
    pub fn of(self, vector: TangentVector<T, N>) -> T {
        (0..N).fold(T::zero(), |sum, i| sum + self.0[i] * vector.0[i])
    }

    /// p̄ = (∂q/∂q̄)ᵀ p: from the old coordinates of a change q = c(q̄, t) to the new ones.
    #[must_use]
    pub fn to_new(self, change: &impl ChangeOfCoordinates<N>, new: &[T; N], t: T) -> Self {
        let columns = tangent_map(change, new, t);
        Self(core::array::from_fn(|i| (0..N).fold(T::zero(), |sum, j| sum + columns[i][j] * self.0[j])))
    }

    /// p = (∂q/∂q̄)⁻ᵀ p̄: from the new coordinates to the old ones.
    ///
    /// # Errors
    /// [`HamiltonianError::Numerics`] where the change of coordinates is singular; [`HamiltonianError::NotFinite`].
    pub fn to_old(self, change: &impl ChangeOfCoordinates<N>, new: &[T; N], t: T) -> Result<Self, HamiltonianError> {
        check_finite("p", &self.0)?;
        check_finite("q̄", new)?;
        Ok(Self(solve(tangent_map(change, new, t), self.0, true)?))
    }
}
