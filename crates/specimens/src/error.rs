//! Violated conditions of specimens and of checks of laws: each variant names one.

use piola_continuum::ContinuumError;
use piola_solids::SolidsError;

/// A violated condition of a specimen or of a check of a law.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpecimensError {
    /// A parameter is infinite or NaN.
    #[error("{law}: {parameter} = {value} is not finite")]
    NotFinite {
        /// The law.
        law: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// A parameter is outside its bounds.
    #[error("{law}: {parameter} = {value:e} violates {bound}")]
    OutOfBounds {
        /// The law.
        law: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// The bound, such as `0 < μ`.
        bound: &'static str,
    },
    /// No state was found in which everything prescribed holds.
    #[error(
        "no equilibrium was reached in {iterations} iterations: the best state, F = {gradient:?}, carries the share \
         {share} of the load; its largest error from the prescribed stresses is {residual:e} Pa"
    )]
    NotConverged {
        /// The largest difference from the prescribed stresses in the best state, Pa.
        residual: f64,
        /// Evaluations of the tangent.
        iterations: usize,
        /// The share of the load that the best state carries.
        share: f64,
        /// F of the best state, by rows.
        gradient: [[f64; 3]; 3],
    },
    /// The tangent of the free components is singular: a rotation or another mode is left free.
    #[error(
        "the prescribed components do not determine the deformation near F = {gradient:?}: the tangent is singular"
    )]
    Indeterminate {
        /// F where it was found, by rows.
        gradient: [[f64; 3]; 3],
    },
    /// Both Tᵢⱼ and Tⱼᵢ are prescribed.
    #[error("T is symmetric: of the components ({row}, {column}) and ({column}, {row}) only one can be prescribed")]
    PrescribedTwice {
        /// i, from 0.
        row: usize,
        /// j, from 0.
        column: usize,
    },
    /// A face that a test leaves free carries a traction.
    #[error(
        "T{component:?} = {stress:e} Pa is a traction on a free face: the axes of the law are not those of the test"
    )]
    TractionOnFreeFace {
        /// The component of T, from 0.
        component: [usize; 2],
        /// Its value, Pa.
        stress: f64,
    },
    /// Displacements that are prescribed violate a constraint, whatever the free components do.
    #[error(
        "the prescribed components contradict constraint {index}: at F = {gradient:?} its value is {value:e}, and no \
         free component can make it 0"
    )]
    ContradictedConstraint {
        /// The constraint, from 0.
        index: usize,
        /// Its value, or what of it no free component can change.
        value: f64,
        /// F with what is prescribed, by rows.
        gradient: [[f64; 3]; 3],
    },
    /// The deformation or stress itself is refused.
    #[error(transparent)]
    Continuum(#[from] ContinuumError),
    /// The law or a constraint refuses.
    #[error(transparent)]
    Solids(#[from] SolidsError),
}

/// Refuses a parameter that is not finite.
pub(crate) fn check_finite(law: &'static str, parameter: &'static str, value: f64) -> Result<(), SpecimensError> {
    if value.is_finite() { Ok(()) } else { Err(SpecimensError::NotFinite { law, parameter, value }) }
}

/// Refuses a parameter that is not finite or for which `holds` is false.
pub(crate) fn check_bound(
    law: &'static str,
    parameter: &'static str,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), SpecimensError> {
    check_finite(law, parameter, value)?;
    if holds { Ok(()) } else { Err(SpecimensError::OutOfBounds { law, parameter, value, bound }) }
}
