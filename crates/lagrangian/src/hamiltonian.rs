//! The Hamiltonian at a point of phase space.
//!
//! ```text
//! H(q, p, t) = p·q̇ − L        where ∂L/∂q̇ = p                                         W(9.7), W(10.9)
//! ```

use nalgebra::DVector;
use piola_kinematics::Holonomic;
use piola_numerics::Real;

use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The Hamiltonian at a point of phase space, J.
    ///
    /// ```text
    /// H(q, p, t) = p·q̇ − L(q, q̇, t)        where ∂L/∂q̇ = p
    /// ```
    ///
    /// The velocities are found by [`velocities_into`](Self::velocities_into): one solve where the kinetic energy is
    /// quadratic and the potential at most linear in them, a damped Newton iteration otherwise.
    ///
    /// # Errors
    /// As [`velocities_into`](Self::velocities_into): a singular Hessian ∂²L/∂q̇∂q̇ names its null direction.
    ///
    /// # Accuracy
    /// Twice as good as that of the velocities: p·q̇ − L is stationary in them.
    ///
    /// # Example
    /// A relativistic particle, L = −√(1 − v²), has H = √(1 + p²):
    /// ```
    /// use piola_lagrangian::{Lagrangian, LagrangianFunction};
    /// use piola_numerics::Real;
    /// struct Relativistic; // unit mass, unit speed of light
    /// impl LagrangianFunction for Relativistic {
    ///     fn lagrangian<T: Real>(&self, _q: &[T], v: &[T], _t: T) -> T {
    ///         -(T::one() - v[0] * v[0]).sqrt()
    ///     }
    /// }
    /// let particle = Lagrangian::from_function(Relativistic);
    /// assert!((particle.hamiltonian(&[0.0], &[0.75], 0.0)? - 1.25_f64).abs() < 1e-15);
    /// let differential = particle.hamiltonian_differential(&[0.0], &[0.75], 0.0)?; // (0, v)
    /// assert!((differential[1] - 0.6).abs() < 1e-15);
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    ///
    /// # Source
    /// W(9.7–9.9), W(10.9).
    pub fn hamiltonian<T: Real>(&self, q: &[T], p: &[T], t: T) -> Result<T, LagrangianError> {
        let (mut work, mut v) = (Workspace::default(), vec![T::zero(); q.len()]);
        self.velocities_into(&mut work, q, p, t, &mut v)?;
        let power = p.iter().zip(&v).fold(T::zero(), |sum, (&p, &v)| sum + p * v);
        Ok(power - self.energies_with(&mut work, q, &v, t)?.lagrangian())
    }

    /// The differential of the Hamiltonian, (∂H/∂q, ∂H/∂p) = (−∂L/∂q, q̇), without differentiating H.
    ///
    /// # Errors
    /// As [`velocities_into`](Self::velocities_into).
    ///
    /// # Source
    /// W(9.11).
    pub fn hamiltonian_differential<T: Real>(&self, q: &[T], p: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let n = q.len();
        let (mut work, mut v) = (Workspace::default(), vec![T::zero(); n]);
        self.velocities_into(&mut work, q, p, t, &mut v)?;
        let gradient = self.coordinate_gradient(q, &v, t)?;
        Ok(DVector::from_fn(2 * n, |i, _| if i < n { -gradient[i] } else { v[i - n] }))
    }
}
