//! The forces that a motion needs: Lagrange's equations read from the other side.
//!
//! ```text
//! R_Δ = d/dt(∂L/∂q̇^Δ) − ∂L/∂q^Δ − Q_Δ                                                        W(5.31)
//! ```

use nalgebra::DVector;
use piola_kinematics::Holonomic;
use piola_numerics::Real;

use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;
use crate::check::{check_finite, check_length};

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The generalised forces that drives must add so that the system moves with given accelerations: what is left
    /// over of Lagrange's equations.
    ///
    /// ```text
    /// R_Δ = d/dt(∂L/∂q̇^Δ) − ∂L/∂q^Δ − Q_Δ
    /// ```
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | q, q̇, q̈ | `q`, `v`, `a` | n | the coordinates' own |
    /// | R | returned | n | J over the coordinate's unit |
    ///
    /// It is zero along a motion. No linear system is solved: a singular metric is no hindrance.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`].
    ///
    /// # Accuracy
    /// A few ulp of the terms summed.
    ///
    /// # Source
    /// W(5.31), W(7.3).
    pub fn driving_forces<T: Real>(&self, q: &[T], v: &[T], a: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut out = DVector::from_element(q.len(), T::zero());
        self.driving_forces_into(&mut Workspace::default(), q, v, a, t, out.as_mut_slice())?;
        Ok(out)
    }

    /// [`driving_forces`](Self::driving_forces) to the caller's memory, without allocation once `work` has been
    /// used.
    ///
    /// # Errors
    /// As [`driving_forces`](Self::driving_forces).
    pub fn driving_forces_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        a: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        let n = q.len();
        check_length("q̈", n, a.len())?;
        let mut mass_matrix = core::mem::take(&mut work.lent);
        mass_matrix.clear();
        mass_matrix.resize(n * n, T::zero());
        let formed = self.equations_into(work, q, v, t, &mut mass_matrix, out);
        for (i, out) in out.iter_mut().enumerate() {
            let mut sum = -*out;
            for (j, &a) in a.iter().enumerate() {
                sum += mass_matrix[i + j * n] * a;
            }
            *out = sum;
        }
        work.lent = mass_matrix;
        formed?;
        check_finite("q̈", a)?;
        self.finite([("q", q), ("q̇", v)], t, ("driving forces", out))
    }
}
