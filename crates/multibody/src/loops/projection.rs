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

    /// Brings the state of a stage onto the smooth branch beside a singular position.
    ///
    /// Newton's method displaces a state at x from the singular position and at δ from the branch by δ²/x along the branch. The
    /// part of the displacement along the branch is undone, so that the motion along it stays smooth.
    pub(super) fn follow_branch(
        &self,
        work: &mut LoopWorkspace,
        q: &mut [f64],
        v: &mut [f64],
        t: f64,
    ) -> Result<(), MultibodyError> {
        work.start_q.copy_from_slice(q);
        self.close_positions(work, q, t)?;
        let mut along = core::mem::take(&mut work.start_v);
        let mut result = self.tree.displacement(q, &work.start_q, &mut along);
        if result.is_ok() {
            result = self.remove_across(work, &mut along, &[]);
        }
        if result.is_ok() {
            result = self.tree.move_configuration(q, &along);
        }
        work.start_v = along;
        result?;
        self.close_positions(work, q, t)?;
        self.close_velocities(work, q, v, t)
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
            // Whether conditions contradict each other shows in the residuals that are left.
            self.solve(work, f64::INFINITY)?;
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
        self.reach(work, q, t)?;
        let rates = core::mem::take(&mut work.rates);
        let result = self.remove_across(work, v, &rates);
        work.rates = rates;
        result
    }

    /// Takes from a velocity what violates G v = rates; rates that are missing are zero. G and its factors are there.
    fn remove_across(&self, work: &mut LoopWorkspace, v: &mut [f64], rates: &[f64]) -> Result<(), MultibodyError> {
        let n = self.tree.freedoms;
        // Twice: the second time removes the rounding of the first.
        for _ in 0..2 {
            let mut size = 0.0_f64;
            for (i, right) in work.right.iter_mut().enumerate() {
                let wanted = rates.get(i).copied().unwrap_or(0.0);
                let (mut rate, mut terms) = (0.0, wanted.abs());
                for (g, v) in work.gradients[i * n..(i + 1) * n].iter().zip(&*v) {
                    rate += g * v;
                    terms += (g * v).abs();
                }
                *right = wanted - rate;
                size = size.max(terms * work.scales[i]);
            }
            self.solve(work, size)?;
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
