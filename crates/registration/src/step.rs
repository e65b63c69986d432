//! What steps of both models take and return.

/// Limits of a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    /// The largest displacement of one step, in samples.
    pub(crate) largest_step: f64,
    /// Steps that would take the least Jacobian of the whole map below this are shortened.
    pub(crate) least_jacobian: f64,
    /// The fluid is regridded when the least Jacobian since the last regridding falls below this.
    pub(crate) regrid_below: f64,
    /// Trials of one step before it is given up.
    pub(crate) halvings: usize,
}

/// A step that was taken.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    pub(crate) measure: f64,
    /// The decrease of what the model makes small.
    pub(crate) decrease: f64,
    pub(crate) least_jacobian: f64,
    pub(crate) regridded: bool,
}
