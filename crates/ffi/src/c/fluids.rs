//! Fluids: viscometric functions, and flows along a pipe and between coaxial cylinders.

use std::ffi::c_char;

use piola::fluids::AnyFluid;
use piola::viscometry::Estimate;

use super::PiolaStatus;
use super::memory::{check_apart, choice, hand_over, handle, put, slice, slice_mut, text, texts};
use super::status::answer;
use crate::flows::{self, ViscometricFunction};
use crate::{FfiError, text};

/// A fluid. Made by `piola_fluid_from_*`, freed by `piola_fluid_free`.
#[derive(Debug)]
pub struct PiolaFluid(AnyFluid);

/// A viscometric function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum PiolaViscometric {
    /// Shear stress, Pa, of shear rates, 1/s.
    ShearStress = 0,
    /// Viscosity, Pa s, of shear rates, 1/s.
    Viscosity = 1,
    /// N1 = T22 - T11, Pa, of shear rates, 1/s; direction 1 is that of the gradient, 2 that of the flow.
    FirstNormalStressDifference = 2,
    /// N2 = T11 - T33, Pa, of shear rates, 1/s.
    SecondNormalStressDifference = 3,
    /// Shear rate, 1/s, of shear stresses, Pa.
    ShearRate = 4,
}

/// Makes a fluid from JSON, such as `{"fluid": "bingham", "yield_stress": 3.0, "plastic_viscosity": 0.5}`.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_fluid_from_json(json: *const c_char, made: *mut *mut PiolaFluid) -> PiolaStatus {
    // SAFETY: as the caller promises.
    answer(|| unsafe { hand_over(made, || Ok(PiolaFluid(text::fluid_from_json(text("json", json)?)?))) })
}

/// Makes a fluid from its name, such as `bingham`, and `count` parameters by name, in any order.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_fluid_from_names(
    name: *const c_char,
    names: *const *const c_char,
    values: *const f64,
    count: usize,
    made: *mut *mut PiolaFluid,
) -> PiolaStatus {
    let make = || {
        // SAFETY: as the caller promises.
        let (name, names, values) =
            unsafe { (text("name", name)?, texts("names", names, count)?, slice("values", values, count)?) };
        Ok(PiolaFluid(text::fluid_with_names(name, &names, values)?))
    };
    // SAFETY: as the caller promises.
    answer(|| unsafe { hand_over(made, make) })
}

/// Frees a fluid; a null pointer is no fault.
///
/// # Safety
/// The fluid comes from this library and was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_fluid_free(fluid: *mut PiolaFluid) {
    if !fluid.is_null() {
        // SAFETY: made by `hand_over`, as the caller promises.
        drop(unsafe { Box::from_raw(fluid) });
    }
}

/// A viscometric function at each entry; `function` is a `PiolaViscometric`.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_viscometric(
    fluid: *const PiolaFluid,
    function: i32,
    entries: *const f64,
    entries_length: usize,
    out: *mut f64,
    out_length: usize,
) -> PiolaStatus {
    answer(|| {
        check_apart(&[("out", out, out_length)], &[("entries", entries, entries_length)])?;
        // SAFETY: as the caller promises.
        let (fluid, entries, out) = unsafe {
            (handle("fluid", fluid)?, slice("entries", entries, entries_length)?, slice_mut("out", out, out_length)?)
        };
        flows::viscometric(&fluid.0, choice("viscometric function", &ViscometricFunction::ALL, function)?, entries, out)
    })
}

/// A number of a flow with its error bound.
///
/// # Safety
/// See the [module](super).
unsafe fn estimated(
    fluid: *const PiolaFluid,
    value: *mut f64,
    error: *mut f64,
    compute: impl FnOnce(&AnyFluid) -> Result<Estimate, FfiError>,
) -> PiolaStatus {
    answer(|| {
        // SAFETY: as the caller promises.
        let fluid = unsafe { handle("fluid", fluid) }?;
        let found = compute(&fluid.0)?;
        // SAFETY: as the caller promises.
        unsafe { put("value", value, found.value) }?;
        // SAFETY: as the caller promises.
        if error.is_null() { Ok(()) } else { unsafe { put("error", error, found.error) } }
    })
}

/// Discharge, m^3/s, along a pipe of this radius, m, under a pressure gradient -dp/dz, Pa/m; with its error bound unless `error` is null.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_pipe_discharge(
    fluid: *const PiolaFluid,
    radius: f64,
    pressure_gradient: f64,
    value: *mut f64,
    error: *mut f64,
) -> PiolaStatus {
    // SAFETY: as the caller promises.
    unsafe { estimated(fluid, value, error, |fluid| flows::pipe_discharge(fluid, radius, pressure_gradient)) }
}

/// Pressure gradient, Pa/m, that drives a discharge, m^3/s, along a pipe; with its error bound unless `error` is null.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_pipe_pressure_gradient(
    fluid: *const PiolaFluid,
    radius: f64,
    discharge: f64,
    value: *mut f64,
    error: *mut f64,
) -> PiolaStatus {
    // SAFETY: as the caller promises.
    unsafe { estimated(fluid, value, error, |fluid| flows::pipe_pressure_gradient(fluid, radius, discharge)) }
}

/// Velocities, m/s, along a pipe at distances from its axis, m.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_pipe_velocities(
    fluid: *const PiolaFluid,
    radius: f64,
    pressure_gradient: f64,
    distances: *const f64,
    distances_length: usize,
    out: *mut f64,
    out_length: usize,
) -> PiolaStatus {
    answer(|| {
        check_apart(&[("out", out, out_length)], &[("distances", distances, distances_length)])?;
        // SAFETY: as the caller promises.
        let (fluid, distances, out) = unsafe {
            (
                handle("fluid", fluid)?,
                slice("distances", distances, distances_length)?,
                slice_mut("out", out, out_length)?,
            )
        };
        flows::pipe_velocities(&fluid.0, radius, pressure_gradient, distances, out)
    })
}

/// Difference of the angular velocities, rad/s, of coaxial cylinders of these radii, m, under a moment per length, N m/m.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_couette_speed_difference(
    fluid: *const PiolaFluid,
    inner_radius: f64,
    outer_radius: f64,
    moment: f64,
    value: *mut f64,
    error: *mut f64,
) -> PiolaStatus {
    let radii = [inner_radius, outer_radius];
    // SAFETY: as the caller promises.
    unsafe { estimated(fluid, value, error, |fluid| flows::couette_speed_difference(fluid, radii, moment)) }
}

/// Moment per length, N m/m, that turns coaxial cylinders with this difference of angular velocities, rad/s.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_couette_moment(
    fluid: *const PiolaFluid,
    inner_radius: f64,
    outer_radius: f64,
    speed_difference: f64,
    value: *mut f64,
    error: *mut f64,
) -> PiolaStatus {
    let radii = [inner_radius, outer_radius];
    // SAFETY: as the caller promises.
    unsafe { estimated(fluid, value, error, |fluid| flows::couette_moment(fluid, radii, speed_difference)) }
}
