//! The buffers of quasi-velocities.

use super::map::Map;

/// The buffers of one thread: grown at the first evaluation, then never again.
///
/// # Example
/// See [`Nonholonomic::acceleration_into`](super::Nonholonomic::acceleration_into).
#[derive(Clone, Debug)]
pub struct Workspace<T = f64> {
    pub(super) lagrangian: crate::Workspace<T>,
    pub(super) map: Map<T>,
    /// The indices of the quasi-velocities that are free, in order, and of those held.
    pub(super) free: Vec<usize>,
    pub(super) held: Vec<usize>,
    /// u, all n.
    pub(super) quasi: Vec<T>,
    /// q̇ and what q̈ is at u̇ = 0.
    pub(super) velocity: Vec<T>,
    pub(super) change: Vec<T>,
    pub(super) mass_matrix: Vec<T>,
    /// f − M c.
    pub(super) forcing: Vec<T>,
    pub(super) metric: Vec<T>,
    pub(super) product: Vec<T>,
    /// u̇ of the free ones.
    pub(super) rates: Vec<T>,
    /// k_α u̇^α, and q̈ = k_α u̇^α + c.
    pub(super) moved: Vec<T>,
    pub(super) acceleration: Vec<T>,
}

impl<T> Default for Workspace<T> {
    fn default() -> Self {
        Self {
            lagrangian: crate::Workspace::default(),
            map: Map::default(),
            free: Vec::new(),
            held: Vec::new(),
            quasi: Vec::new(),
            velocity: Vec::new(),
            change: Vec::new(),
            mass_matrix: Vec::new(),
            forcing: Vec::new(),
            metric: Vec::new(),
            product: Vec::new(),
            rates: Vec::new(),
            moved: Vec::new(),
            acceleration: Vec::new(),
        }
    }
}
