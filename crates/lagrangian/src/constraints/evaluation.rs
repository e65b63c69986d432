//! The constraints and their derivatives at a state, by one pass.

use nalgebra::{DMatrix, DVector};
use piola_kinematics::Holonomic;
use piola_numerics::internal::zeros;
use piola_numerics::{Jet, Real};

use super::workspace::{Gradients, Pass, Workspace};
use super::{Constrained, Constraints};
use crate::check::{check_finite, check_length};
use crate::{ConstraintError, LagrangianError};
use crate::{Forces, Potential};

impl<T: Real, const N: usize> Pass<T, N> {
    /// φ, φ̇, γ and the partial derivatives in the directions from `first` on.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take<C: Constraints>(
        &mut self,
        constraints: &C,
        (q, v): (&[T], &[T]),
        t: T,
        first: usize,
        out: &mut Gradients<T>,
    ) {
        let n = q.len();
        let jet = |(i, (&q, &v)): (usize, (&T, &T))| Jet::coordinate(q, v, i.wrapping_sub(first));
        self.coordinates.clear();
        self.coordinates.extend(q.iter().zip(v).enumerate().map(jet));
        self.residuals.clear();
        self.residuals.resize(constraints.count(), Jet::constant(T::zero()));
        let time = if C::TIME_DEPENDENT { Jet::time(t) } else { Jet::constant(t) };
        constraints.residuals(&self.coordinates, time, &mut self.residuals);
        for (i, jet) in self.residuals.iter().enumerate() {
            out.residuals[i] = jet.value;
            out.rates[i] = jet.rate;
            out.second_rates[i] = jet.second_rate;
            for (entry, &partial) in out.rows[i * n + first..(i + 1) * n].iter_mut().zip(&jet.partials) {
                *entry = partial;
            }
        }
    }
}

impl<S, P, F, C: Constraints> Constrained<S, P, F, C> {
    /// Leaves φ, φ̇, γ and G in `work.gradients`.
    pub(super) fn differentiate<T: Real>(&self, work: &mut Workspace<T>, q: &[T], v: &[T], t: T) {
        let (n, count) = (q.len(), self.constraints.count());
        let Gradients { residuals, rates, second_rates, rows } = &mut work.gradients;
        for values in [residuals, rates, second_rates] {
            zeros(values, count);
        }
        zeros(rows, n * count);
        if n <= 4 {
            work.few.take(&self.constraints, (q, v), t, 0, &mut work.gradients);
        } else {
            for first in (0..n).step_by(8) {
                work.many.take(&self.constraints, (q, v), t, first, &mut work.gradients);
            }
        }
    }
}

impl<S: Holonomic, P: Potential, F: Forces, C: Constraints> Constrained<S, P, F, C> {
    /// The residuals φ(q, t).
    pub fn residuals<T: Real>(&self, q: &[T], t: T) -> DVector<T> {
        let mut out = DVector::from_element(self.constraints.count(), T::zero());
        self.constraints.residuals(q, t, out.as_mut_slice());
        out
    }

    /// The rates of the residuals, φ̇ = G q̇ + ∂φ/∂t.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`].
    pub fn residual_rates<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        check_length("q̇", q.len(), v.len())?;
        let mut work = Workspace::default();
        self.differentiate(&mut work, q, v, t);
        Ok(DVector::from_vec(work.gradients.rates))
    }

    /// The gradients of the constraints, G = ∂φ/∂q, one row for each.
    pub fn jacobian<T: Real>(&self, q: &[T], t: T) -> DMatrix<T> {
        let mut work = Workspace::default();
        let at_rest = vec![T::zero(); q.len()];
        self.differentiate(&mut work, q, &at_rest, t);
        DMatrix::from_row_slice(self.constraints.count(), q.len(), &work.gradients.rows)
    }

    /// Checks what evaluations trust: as [`Lagrangian::check`](crate::Lagrangian::check), and that
    /// residuals and gradients are finite and that constraints without declared time dependence have none.
    ///
    /// # Errors
    /// As [`Lagrangian::check`](crate::Lagrangian::check);
    /// [`ConstraintError::UndeclaredTimeDependence`].
    pub fn check(&self, q: &[f64], v: &[f64], t: f64) -> Result<(), LagrangianError> {
        self.lagrangian.check(q, v, t)?;
        let mut work = Workspace::default();
        self.differentiate(&mut work, q, v, t);
        Self::check_gradients(&work)?;
        if !C::TIME_DEPENDENT {
            // Time that is not a number leaves no trace where it is not used.
            let without_time = self.residuals(q, f64::NAN);
            if let Some(constraint) = without_time.iter().position(|residual| residual.is_nan()) {
                let name = self.name_of(constraint);
                return Err(LagrangianError::Constraint(ConstraintError::UndeclaredTimeDependence {
                    constraint,
                    name,
                }));
            }
        }
        Ok(())
    }

    /// Residuals, rates and gradients that are not finite, by name.
    pub(super) fn check_gradients<T: Real>(work: &Workspace<T>) -> Result<(), LagrangianError> {
        let Gradients { residuals, rates, second_rates, rows } = &work.gradients;
        check_finite("φ", residuals)?;
        check_finite("φ̇", rates)?;
        check_finite("γ", second_rates)?;
        check_finite("G", rows)
    }

    /// What a constraint is called.
    pub(super) fn name_of(&self, constraint: usize) -> Option<String> {
        self.constraints.name(constraint).map(String::from)
    }
}
