//! The buffers of constrained evaluations.

use piola_numerics::Jet;
use piola_numerics::internal::IndependentRows;

/// The buffers of one thread: grown at the first evaluation, then never again.
#[derive(Clone, Debug)]
pub struct Workspace<T = f64> {
    pub(super) lagrangian: crate::Workspace<T>,
    pub(super) few: Pass<T, 4>,
    pub(super) many: Pass<T, 8>,
    pub(super) gradients: Gradients<T>,
    pub(super) mass_matrix: Vec<T>,
    pub(super) forcing: Vec<T>,
    pub(super) independence: IndependentRows<T>,
    pub(super) acceleration: Vec<T>,
    pub(super) multipliers: Vec<T>,
    /// What the constraints do to the coordinates, or an increment of these.
    pub(super) along: Vec<T>,
}

/// Coordinates and residuals of one pass.
#[derive(Clone, Debug)]
pub(super) struct Pass<T, const N: usize> {
    pub(super) coordinates: Vec<Jet<T, N>>,
    pub(super) residuals: Vec<Jet<T, N>>,
}

impl<T, const N: usize> Default for Pass<T, N> {
    fn default() -> Self {
        Self { coordinates: Vec::new(), residuals: Vec::new() }
    }
}

/// The constraints at a state: φ, φ̇ = G q̇ + ∂φ/∂t, γ and G row by row.
#[derive(Clone, Debug)]
pub(super) struct Gradients<T> {
    pub(super) residuals: Vec<T>,
    pub(super) rates: Vec<T>,
    pub(super) second_rates: Vec<T>,
    pub(super) rows: Vec<T>,
}

impl<T> Default for Gradients<T> {
    fn default() -> Self {
        Self { residuals: Vec::new(), rates: Vec::new(), second_rates: Vec::new(), rows: Vec::new() }
    }
}

impl<T> Default for Workspace<T> {
    fn default() -> Self {
        Self {
            lagrangian: crate::Workspace::default(),
            few: Pass::default(),
            many: Pass::default(),
            gradients: Gradients::default(),
            mass_matrix: Vec::new(),
            forcing: Vec::new(),
            independence: IndependentRows::default(),
            acceleration: Vec::new(),
            multipliers: Vec::new(),
            along: Vec::new(),
        }
    }
}
