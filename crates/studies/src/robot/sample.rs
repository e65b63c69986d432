//! What is recorded of a robot at an instant.

use serde::{Deserialize, Serialize};

/// Works that a run integrates.
pub(super) const WORKS: usize = 3;

/// A recorded instant.
///
/// # Example
/// See [`RobotStudy`](super::RobotStudy).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotSample {
    /// Time, s.
    pub t: f64,
    /// Coordinates.
    pub q: Vec<f64>,
    /// Rates.
    pub v: Vec<f64>,
    /// Kinetic energy, potential energy in gravity, energy of springs, J.
    pub energies: [f64; 3],
    /// Work of torques and forces, of damping, of Coulomb friction since the start, J.
    pub works: [f64; WORKS],
}

impl RobotSample {
    /// What the balance of energy compares: it is constant.
    pub(super) fn balance(&self) -> f64 {
        self.energies.iter().sum::<f64>() - self.works.iter().sum::<f64>()
    }
}
