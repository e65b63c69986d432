//! What steps of both models take and return.

use piola_numerics::Real;

use crate::parallel::each;

/// The factor of a displacement that folds on a finer grid.
pub(crate) const SHRINKING: f64 = 0.97;

/// The most shrinkings of a displacement. Together they leave 10⁻⁵ of it.
pub(crate) const SHRINKINGS: usize = 400;

/// Multiplies a field.
pub(crate) fn scale<const D: usize, T: Real>(field: &mut [[T; D]], factor: f64) {
    let factor = T::lit(factor);
    each(field, &|_, part: &mut [[T; D]]| {
        for component in part.as_flattened_mut() {
            *component *= factor;
        }
    });
}

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
