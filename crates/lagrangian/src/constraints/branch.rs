//! States of stages brought onto the smooth branch beside a singular position.
//!
//! Newton's method displaces a state at x from the singular position and at δ from the branch by δ²/x along the branch. The
//! part of the displacement along the branch is undone, so that the motion along it stays smooth.

use piola_kinematics::Holonomic;
use piola_numerics::internal::dot;

use super::workspace::Workspace;
use super::{Constrained, Constraints};
use crate::{ConstraintError, LagrangianError};
use crate::{Forces, Potential};

impl<S: Holonomic, P: Potential, F: Forces, C: Constraints> Constrained<S, P, F, C> {
    /// Brings (q, v) onto the branch by the constraints chosen before. `along` and `step` are scratch of n.
    pub(super) fn follow_branch(
        &self,
        work: &mut Workspace,
        (q, v): (&mut [f64], &mut [f64]),
        t: f64,
        [along, step]: [&mut [f64]; 2],
    ) -> Result<(), LagrangianError> {
        along.copy_from_slice(q);
        self.close(work, (q, v), t, step)?;
        for (along, q) in along.iter_mut().zip(&*q) {
            *along -= q;
        }
        // Twice: the second time removes the rounding of the first.
        let mut across = core::mem::take(&mut work.multipliers);
        for _ in 0..2 {
            across.clear();
            across.extend(work.gradients.rows.chunks_exact(q.len().max(1)).map(|row| dot(row, along)));
            work.independence.correct(&across, step);
            add(along, step);
        }
        work.multipliers = across;
        add(q, along);
        self.close(work, (q, v), t, step)?;
        for _ in 0..2 {
            self.differentiate(work, q, v, t);
            work.independence.correct(&work.gradients.rates, step);
            add(v, step);
        }
        Ok(())
    }

    /// Newton's method for q, by the least changes in the metric.
    fn close(
        &self,
        work: &mut Workspace,
        (q, v): (&mut [f64], &[f64]),
        t: f64,
        step: &mut [f64],
    ) -> Result<(), LagrangianError> {
        let mut before = f64::INFINITY;
        for _ in 0..20 {
            self.form(work, q, v, t)?;
            self.factor(work, true)?;
            work.independence.follow().map_err(|constraint| self.singular(constraint, t))?;
            let (_, violation) = Self::violation(work, q);
            // At rounding it no longer falls.
            if violation <= f64::EPSILON || violation < 1e-9 && 0.5 * before <= violation {
                return Ok(());
            }
            before = violation;
            work.independence.correct(&work.gradients.residuals, step);
            add(q, step);
        }
        let (constraint, _) = Self::violation(work, q);
        let residual = work.gradients.residuals[constraint];
        let name = self.name_of(constraint);
        Err(LagrangianError::Constraint(ConstraintError::NotAssembled { constraint, name, residual }))
    }

    /// The position is singular by a constraint.
    pub(super) fn singular(&self, constraint: usize, time: f64) -> LagrangianError {
        let name = self.name_of(constraint);
        LagrangianError::Constraint(ConstraintError::Singular { constraint, name, time })
    }
}

fn add(sum: &mut [f64], terms: &[f64]) {
    for (sum, term) in sum.iter_mut().zip(terms) {
        *sum += term;
    }
}
