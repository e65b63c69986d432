//! Viscometric functions of a fluid at many shear rates, and two flows: pipe and coaxial cylinders.

use piola::fluids::{AnyFluid, ViscometricFluid};
use piola::viscometry::{Couette, Estimate, Poiseuille};

use crate::FfiError;
use crate::error::{check_finite, check_length};

/// A viscometric function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViscometricFunction {
    /// τ(k), Pa, of shear rates, 1/s.
    ShearStress,
    /// τ/k, Pa s, of shear rates, 1/s.
    Viscosity,
    /// N₁ = T₂₂ − T₁₁, Pa, with direction 2 that of the flow, of shear rates, 1/s.
    FirstNormalStressDifference,
    /// N₂ = T₁₁ − T₃₃, Pa, of shear rates, 1/s.
    SecondNormalStressDifference,
    /// ζ = τ⁻¹, 1/s, of shear stresses, Pa.
    ShearRate,
}

impl ViscometricFunction {
    /// The functions by name.
    pub const ALL: [(&'static str, Self); 5] = [
        ("shear_stress", Self::ShearStress),
        ("viscosity", Self::Viscosity),
        ("first_normal_stress_difference", Self::FirstNormalStressDifference),
        ("second_normal_stress_difference", Self::SecondNormalStressDifference),
        ("shear_rate", Self::ShearRate),
    ];
}

/// A viscometric function at each entry.
///
/// # Errors
/// [`FfiError::WrongLength`], [`FfiError::NotFinite`] for an entry, before anything is computed; [`FfiError::Fluids`] where no
/// rate has a stress: entries up to that one are written.
///
/// # Example
/// ```
/// use piola::fluids::Bingham;
/// use piola_ffi::flows::{ViscometricFunction, viscometric};
/// let mud = Bingham::new(3.0, 0.5)?.into();
/// let mut stresses = [0.0; 2];
/// viscometric(&mud, ViscometricFunction::ShearStress, &[4.0, -4.0], &mut stresses)?;
/// assert_eq!(stresses, [5.0, -5.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn viscometric(
    fluid: &AnyFluid,
    function: ViscometricFunction,
    entries: &[f64],
    out: &mut [f64],
) -> Result<(), FfiError> {
    check_length("values", entries.len(), out.len())?;
    check_finite("entries", entries)?;
    for (out, entry) in out.iter_mut().zip(entries) {
        *out = match function {
            ViscometricFunction::ShearStress => fluid.shear_stress(*entry),
            ViscometricFunction::Viscosity => fluid.viscosity(*entry),
            ViscometricFunction::FirstNormalStressDifference => fluid.first_normal_stress_difference(*entry),
            ViscometricFunction::SecondNormalStressDifference => fluid.second_normal_stress_difference(*entry),
            ViscometricFunction::ShearRate => fluid.shear_rate(*entry)?,
        };
    }
    Ok(())
}

/// Discharge Q, m³/s, along a pipe of this radius, m, under a pressure gradient c = −∂p/∂z, Pa/m.
///
/// # Errors
/// [`FfiError::Viscometry`].
///
/// # Example
/// ```
/// use piola::fluids::Newtonian;
/// let oil = Newtonian::new(0.5)?.into();
/// let discharge = piola_ffi::flows::pipe_discharge(&oil, 2.0, 3.0)?;
/// assert!((discharge.value - 12.0 * std::f64::consts::PI).abs() <= discharge.error); // π c R⁴/(8 μ)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn pipe_discharge(fluid: &AnyFluid, radius: f64, pressure_gradient: f64) -> Result<Estimate, FfiError> {
    Ok(Poiseuille::new(radius, pressure_gradient)?.discharge(fluid)?)
}

/// Pressure gradient, Pa/m, that drives a discharge, m³/s, along a pipe, with its error bound.
///
/// # Errors
/// [`FfiError::Viscometry`].
pub fn pipe_pressure_gradient(fluid: &AnyFluid, radius: f64, discharge: f64) -> Result<Estimate, FfiError> {
    let flow = Poiseuille::with_discharge(radius, discharge, fluid)?;
    Ok(Estimate { value: flow.pressure_gradient(), error: flow.pressure_gradient_error(fluid, discharge)? })
}

/// Velocities, m/s, along a pipe at distances from its axis, m.
///
/// # Errors
/// [`FfiError::WrongLength`]; [`FfiError::Viscometry`].
pub fn pipe_velocities(
    fluid: &AnyFluid,
    radius: f64,
    pressure_gradient: f64,
    distances: &[f64],
    out: &mut [f64],
) -> Result<(), FfiError> {
    check_length("velocities", distances.len(), out.len())?;
    let flow = Poiseuille::new(radius, pressure_gradient)?;
    for (out, r) in out.iter_mut().zip(distances) {
        *out = flow.velocity(fluid, *r)?.value;
    }
    Ok(())
}

/// Difference of the angular velocities, rad/s, of coaxial cylinders of these radii, m, under a moment per length, N m/m.
///
/// # Errors
/// [`FfiError::Viscometry`].
pub fn couette_speed_difference(fluid: &AnyFluid, [inner, outer]: [f64; 2], moment: f64) -> Result<Estimate, FfiError> {
    Ok(Couette::new(inner, outer, moment)?.speed_difference(fluid)?)
}

/// Moment per length, N m/m, that turns coaxial cylinders with this difference of angular velocities, rad/s, with its error
/// bound.
///
/// # Errors
/// [`FfiError::Viscometry`].
pub fn couette_moment(fluid: &AnyFluid, [inner, outer]: [f64; 2], speed_difference: f64) -> Result<Estimate, FfiError> {
    let flow = Couette::with_speed_difference(inner, outer, speed_difference, fluid)?;
    Ok(Estimate { value: flow.moment(), error: flow.moment_error(fluid, speed_difference)? })
}

/// Angular velocities, rad/s, of the fluid between coaxial cylinders at distances from their axis, m, the inner cylinder at rest.
///
/// # Errors
/// [`FfiError::WrongLength`]; [`FfiError::Viscometry`].
pub fn couette_angular_velocities(
    fluid: &AnyFluid,
    [inner, outer]: [f64; 2],
    moment: f64,
    distances: &[f64],
    out: &mut [f64],
) -> Result<(), FfiError> {
    check_length("angular velocities", distances.len(), out.len())?;
    let flow = Couette::new(inner, outer, moment)?;
    for (out, r) in out.iter_mut().zip(distances) {
        *out = flow.angular_velocity(fluid, *r)?.value;
    }
    Ok(())
}
