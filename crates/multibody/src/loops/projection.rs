//! States brought back to where the closures hold.

use super::{ClosedTree, LoopWorkspace};
use crate::error::{MultibodyError, check_length};
use crate::forward_dynamics;

impl ClosedTree {
    /// Brings a state back to where the closures hold: q by the displacement that is least in the metric of M, v likewise.
    ///
    /// # Errors
    /// [`MultibodyError::NoClosedState`] where twenty steps of Newton's method do not get there, as from too far away or
    /// where the closures contradict each other; the state is unchanged then. As
    /// [`accelerations`](Self::accelerations) else.
    ///
    /// # Accuracy
    /// Residuals within some ulp of the size of the tree.
    pub fn project(
        &self,
        work: &mut LoopWorkspace,
        q: &mut [f64],
        v: &mut [f64],
        t: f64,
    ) -> Result<(), MultibodyError> {
        let n = self.tree.freedoms;
        check_length("q", self.tree.coordinates, q.len())?;
        check_length("v", n, v.len())?;
        work.start_q.copy_from_slice(q);
        work.start_v.copy_from_slice(v);
        let result = self.close_positions(work, q, t).and_then(|()| self.close_velocities(work, q, v, t));
        if result.is_err() {
            q.copy_from_slice(&work.start_q);
            v.copy_from_slice(&work.start_v);
        }
        result
    }

    fn close_positions(&self, work: &mut LoopWorkspace, q: &mut [f64], t: f64) -> Result<(), MultibodyError> {
        let mut before = f64::INFINITY;
        for _ in 0..20 {
            self.reach(work, q, t)?;
            let largest = work.residuals.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
            // At rounding it no longer falls.
            if largest <= 4.0 * f64::EPSILON || (largest < 1e-9 && 0.5 * before <= largest) {
                return Ok(());
            }
            before = largest;
            for (right, residual) in work.right.iter_mut().zip(&work.residuals) {
                *right = -residual;
            }
            self.solve(work)?;
            self.step_of_multipliers(work);
            self.tree.move_configuration(q, &work.step)?;
        }
        let condition = (0..self.conditions)
            .fold(0, |worst, i| if work.residuals[worst].abs() < work.residuals[i].abs() { i } else { worst });
        let residual = work.residuals.get(condition).copied().unwrap_or(0.0);
        Err(MultibodyError::NoClosedState { closure: self.closure_of(condition).to_owned(), residual })
    }

    fn close_velocities(
        &self,
        work: &mut LoopWorkspace,
        q: &[f64],
        v: &mut [f64],
        t: f64,
    ) -> Result<(), MultibodyError> {
        let n = self.tree.freedoms;
        self.reach(work, q, t)?;
        // Twice: the second time removes the rounding of the first.
        for _ in 0..2 {
            for (i, right) in work.right.iter_mut().enumerate() {
                let rate: f64 = work.gradients[i * n..(i + 1) * n].iter().zip(&*v).map(|(g, v)| g * v).sum();
                *right = work.rates[i] - rate;
            }
            self.solve(work)?;
            self.step_of_multipliers(work);
            for (v, step) in v.iter_mut().zip(&work.step) {
                *v += step;
            }
        }
        Ok(())
    }

    /// Residuals, gradients and factors at a configuration.
    fn reach(&self, work: &mut LoopWorkspace, q: &[f64], t: f64) -> Result<(), MultibodyError> {
        let zero = core::mem::take(&mut work.zero);
        let result = self.evaluate_at_rest(work, q, &zero, t);
        work.zero = zero;
        result?;
        self.factorise(work);
        Ok(())
    }

    fn evaluate_at_rest(
        &self,
        work: &mut LoopWorkspace,
        q: &[f64],
        zero: &[f64],
        t: f64,
    ) -> Result<(), MultibodyError> {
        forward_dynamics::pass_outwards(&self.tree, &mut work.tree.articulation, q, zero);
        if !forward_dynamics::pass_inwards(&self.tree, &mut work.tree, zero, &mut work.step) {
            self.tree.explain_inertia(&work.tree)?;
        }
        self.evaluate(work, q, zero, zero, t)
    }

    /// M⁻¹ Gᵀ λ.
    fn step_of_multipliers(&self, work: &mut LoopWorkspace) {
        work.step.fill(0.0);
        for (column, &multiplier) in work.columns.chunks_exact(self.tree.freedoms.max(1)).zip(&work.multipliers) {
            for (step, &x) in work.step.iter_mut().zip(column) {
                *step += multiplier * x;
            }
        }
    }
}
