//! What is recorded at an instant.

use serde::{Deserialize, Serialize};

/// An instant of a motion.
///
/// # Example
/// See [`BoxStudy::run_with_checkpoints`](super::BoxStudy::run_with_checkpoints).
#[derive(Debug, Clone)]
pub struct MotionInstant<const D: usize> {
    /// The time, s.
    pub time: f64,
    /// ½∫ρ v² dV, J (in a rectangle: J/m).
    pub kinetic_energy: f64,
    /// ½∫ ε:σ dV, J (in a rectangle: J/m).
    pub elastic_energy: f64,
    /// The displacement at the probes, m.
    pub displacements: Vec<[f64; D]>,
}

impl<const D: usize> MotionInstant<D> {
    /// Kinetic and elastic energy together, J (in a rectangle: J/m).
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.kinetic_energy + self.elastic_energy
    }
}

/// A flow after a step.
///
/// # Example
/// See [`BoxStudy`](super::BoxStudy).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FlowInstant {
    /// The time, s.
    pub time: f64,
    /// The least det(1 − ∇u) of the displacement since the last regridding.
    pub least_jacobian: f64,
    /// A lower bound of the Jacobian of the whole map: the product of the least ones of its pieces.
    pub certified_jacobian: f64,
    /// Spacings that the fastest particle crossed in the step.
    pub courant_number: f64,
    /// How often the displacement has been put away.
    pub regriddings: usize,
}
