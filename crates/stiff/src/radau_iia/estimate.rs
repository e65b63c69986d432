//! The estimate of the error of a step.

use piola_integrators::State;

use super::aim::Aim;
use super::matrices::Matrices;
use super::norm::norm;
use super::stages::Workspace;
use super::tableau::Tableau;
use crate::StiffField;

impl Workspace {
    /// The error of the step, relative to what is allowed. Where it is too large it is estimated once more with f at the
    /// corrected start, if there is a count of evaluations to add that one to.
    pub(super) fn estimate<F: StiffField>(
        &mut self,
        field: &mut F,
        tableau: &Tableau,
        state: &State,
        h: f64,
        aim: Aim,
        again: Option<&mut u64>,
    ) -> f64 {
        let n = self.rate.len();
        self.weigh(field, tableau, state, h, aim);
        self.error.fill(0.0);
        for (defect, stage) in tableau.defect.iter().zip(self.stages.chunks_exact(n.max(1))) {
            for (error, z) in self.error.iter_mut().zip(stage) {
                *error -= defect / h * z;
            }
        }
        let (residual, rest) = self.residuals.split_at_mut(n);
        let (solution, work) = (&mut rest[..n], &mut self.rates[..n]);
        residual.copy_from_slice(&self.rate);
        self.matrices.subtract_mass_times(&self.error, residual);
        self.error.copy_from_slice(residual);
        self.matrices.solve_real(&mut self.error);
        solution.copy_from_slice(&self.error);
        let gamma = tableau.real / h;
        let error = judge(field, &mut self.matrices, &self.weights, gamma, aim, (&mut *solution, &mut *work));
        let Some(evaluations) = again.filter(|_| 1.0 <= error) else { return error };
        for (k, trial) in self.trial.iter_mut().enumerate() {
            *trial = state.values[k] + (state.carry[k] + self.error[k]);
        }
        *evaluations += 1;
        if field.rate(state.time, &self.trial, &mut self.rate_at_end).is_err() {
            return error;
        }
        for ((solution, &residual), (new, old)) in
            solution.iter_mut().zip(&*residual).zip(self.rate_at_end.iter().zip(&self.rate))
        {
            *solution = residual + (new - old);
        }
        self.matrices.solve_real(solution);
        let filtered = judge(field, &mut self.matrices, &self.weights, gamma, aim, (solution, work));
        if filtered.is_finite() { filtered } else { error }
    }
}

/// The estimate e relative to what is allowed: e itself to the weights, its stiff part (1 − F)² e to the tolerance. That part
/// is left in place of e; the second slice is memory for the work.
fn judge<F: StiffField>(
    field: &F,
    matrices: &mut Matrices,
    weights: &[f64],
    gamma: f64,
    aim: Aim,
    (e, work): (&mut [f64], &mut [f64]),
) -> f64 {
    let error = norm(e, weights);
    if aim.widening <= 1.0 {
        return error;
    }
    for _ in 0..2 {
        // F e = (γ/h M − J)⁻¹ γ/h M e.
        work.fill(0.0);
        matrices.subtract_mass_times(e, work);
        matrices.solve_real(work);
        for (e, slow) in e.iter_mut().zip(&*work) {
            *e += gamma * slow;
        }
    }
    // Reactions of index 2 have the order of the estimate, and do not act on what follows.
    for (component, e) in e.iter_mut().enumerate() {
        if 1 < field.index(component) {
            *e = 0.0;
        }
    }
    error.max(aim.widening * norm(e, weights))
}
