//! The motion of a tree with closures, for explicit methods that project.

use piola_integrators::Field;

use super::{ClosedTree, LoopWorkspace};
use crate::error::MultibodyError;

/// The motion y = (q, v) of a tree with closures under forces, as a field whose steps end where the closures hold.
///
/// The forces are a function of (t, q, v) that writes τ.
///
/// [`DormandPrince853`](piola_integrators::DormandPrince853) projects each accepted step.
#[derive(Clone, Debug)]
pub struct ClosedMotion<'a, F> {
    closed: &'a ClosedTree,
    work: LoopWorkspace,
    tau: Vec<f64>,
    forces: F,
}

impl ClosedTree {
    /// The motion under forces τ(t, q, v), written to the last argument.
    pub fn motion<F: FnMut(f64, &[f64], &[f64], &mut [f64])>(&self, forces: F) -> ClosedMotion<'_, F> {
        ClosedMotion { closed: self, work: self.workspace(), tau: vec![0.0; self.tree.freedoms], forces }
    }
}

impl<F> ClosedMotion<'_, F> {
    /// The workspace with the results of the last evaluation.
    pub const fn last(&self) -> &LoopWorkspace {
        &self.work
    }
}

impl<F: FnMut(f64, &[f64], &[f64], &mut [f64])> Field for ClosedMotion<'_, F> {
    type Error = MultibodyError;
    fn dimension(&self) -> usize {
        self.closed.tree.coordinates + self.closed.tree.freedoms
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), MultibodyError> {
        let tree = &self.closed.tree;
        let (q, v) = y.split_at(tree.coordinates);
        let (q_rate, v_rate) = rate.split_at_mut(tree.coordinates);
        (self.forces)(t, q, v, &mut self.tau);
        tree.coordinate_rates(q, v, q_rate)?;
        self.closed.accelerations(&mut self.work, q, v, &self.tau, t, v_rate)
    }
    fn is_second_order(&self) -> bool {
        self.closed.tree.quaternions.is_empty()
    }
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), MultibodyError> {
        let tree = &self.closed.tree;
        tree.normalise(&mut y[..tree.coordinates])?;
        let (q, v) = y.split_at_mut(tree.coordinates);
        self.closed.project(&mut self.work, q, v, t)
    }
}
