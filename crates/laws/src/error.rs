//! Violated conditions, and checks of parameters, which refuse as built-in laws do.

use piola_continuum::ContinuumError;

use crate::SolidsError;

/// A violated condition of an energy, of a state in the plane or of a mixed form.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LawsError {
    /// An answer is infinite or NaN at a deformation that the law does not refuse.
    #[error(
        "{quantity}[{index}] = {value} at F = {gradient:?} is not finite, and the law does not refuse this deformation"
    )]
    NotFinite {
        /// The answer.
        quantity: &'static str,
        /// Its component, from 0, by rows.
        index: usize,
        /// Its value.
        value: f64,
        /// F by rows.
        gradient: [[f64; 3]; 3],
    },
    /// The energy of the undeformed body is not zero.
    #[error("W = {energy:e} J/m³ in the reference configuration, where it must be zero")]
    ReferenceEnergy {
        /// W(1), J/m³.
        energy: f64,
    },
    /// The undeformed body has a stress.
    #[error("the reference configuration has the stress {stress:e} Pa beside a modulus of {modulus:e} Pa")]
    ReferenceStress {
        /// The largest component of S(1), Pa.
        stress: f64,
        /// The largest component of ∂S/∂E, Pa.
        modulus: f64,
    },
    /// The energy depends on the observer.
    #[error(
        "W(F) = {energy:e} J/m³ and W(Q F) = {turned:e} J/m³ at F = {gradient:?}: the energy depends on the observer"
    )]
    DependsOnObserver {
        /// W(F), J/m³.
        energy: f64,
        /// W(Q F), J/m³.
        turned: f64,
        /// F by rows.
        gradient: [[f64; 3]; 3],
    },
    /// No thickness was found at which a sheet has no normal stress.
    #[error(
        "no thickness leaves the sheet without normal stress: the best, F₃₃ = {thickness_stretch}, leaves {normal_stress:e} Pa"
    )]
    NoPlaneStress {
        /// |P₃₃| of the best thickness, Pa.
        normal_stress: f64,
        /// F₃₃ of the best thickness.
        thickness_stretch: f64,
    },
    /// A given volume, pressure or strain is not finite or out of bounds.
    #[error("{quantity} = {value} must be finite and satisfy {bound}")]
    OutOfBounds {
        /// The argument.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// What is valid.
        bound: &'static str,
    },
    /// No volume was found at which the law has the given mean stress.
    #[error(
        "no volume gives the law the mean stress {mean_stress:e} Pa: the best, θ = {volume}, misses it by {residual:e} Pa"
    )]
    NoVolume {
        /// p, Pa.
        mean_stress: f64,
        /// θ of the best volume.
        volume: f64,
        /// The mean stress of the law there less p, Pa.
        residual: f64,
    },
    /// The deformation is refused.
    #[error(transparent)]
    Continuum(#[from] ContinuumError),
    /// The law refuses.
    #[error(transparent)]
    Solids(#[from] SolidsError),
}

/// Refuses a parameter that is not finite.
pub(crate) fn check_finite(law: &'static str, parameter: &'static str, value: f64) -> Result<(), SolidsError> {
    if value.is_finite() { Ok(()) } else { Err(SolidsError::NotFinite { law, parameter, value }) }
}

/// Refuses a parameter that is not finite or for which `holds` is false.
pub(crate) fn check_bound(
    law: &'static str,
    parameter: &'static str,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), SolidsError> {
    check_finite(law, parameter, value)?;
    if holds { Ok(()) } else { Err(SolidsError::OutOfBounds { law, parameter, value, bound }) }
}
