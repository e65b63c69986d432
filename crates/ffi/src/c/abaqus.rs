//! The two functions behind `fortran/umat.f` and `fortran/vumat.f`.

use std::ffi::c_char;

use super::PiolaStatus;
use super::memory::{check_apart, slice, slice_mut};
use super::status::answer;
use crate::FfiError;
use crate::abaqus::{PointIncrement, Stretching, umat, vumat};
use crate::materials::material;

/// A name of Fortran: so many characters, with blanks at the end.
///
/// # Safety
/// See the [module](super).
unsafe fn padded<'a>(argument: &'static str, text: *const c_char, length: usize) -> Result<&'a str, FfiError> {
    // SAFETY: characters are bytes; as the caller promises.
    let bytes = unsafe { slice(argument, text.cast::<u8>(), length) }?;
    let text = core::str::from_utf8(bytes);
    Ok(text.map_err(|error| FfiError::NotText { argument, index: error.valid_up_to() })?.trim_end())
}

/// STRESS, DDSDDE and STATEV of Abaqus at one point; see `fortran/umat.f`.
///
/// `name` has `name_length` characters: a law with its parameters in `properties`, or the name of a file in the folder
/// `PIOLA_MATERIALS`. `from` and `to` are DFGRD0 and DFGRD1, nine numbers by columns; `dt` is DTIME. `temperature` is that at the end,
/// TEMP + DTEMP; the law `thermal` takes it in the place of its state, and no other law uses it. `state` has `state_length` numbers, zeros for
/// the body as it was made; an elastic law leaves any state alone. `stress` gets NTENS = `direct` + `shear` numbers, `tangent` NTENS^2 by
/// columns.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_umat(
    name: *const c_char,
    name_length: usize,
    properties: *const f64,
    properties_length: usize,
    direct: usize,
    shear: usize,
    from: *const f64,
    to: *const f64,
    dt: f64,
    temperature: f64,
    state: *mut f64,
    state_length: usize,
    stress: *mut f64,
    tangent: *mut f64,
) -> PiolaStatus {
    answer(|| {
        let count = direct.saturating_add(shear);
        check_apart(
            &[
                ("state", state, state_length),
                ("stress", stress, count),
                ("tangent", tangent, count.saturating_mul(count)),
            ],
            &[("properties", properties, properties_length), ("from", from, 9), ("to", to, 9)],
        )?;
        // SAFETY: as the caller promises.
        let (name, properties) =
            unsafe { (padded("name", name, name_length)?, slice("properties", properties, properties_length)?) };
        // SAFETY: as the caller promises.
        let (from, to) = unsafe { (slice("from", from, 9)?, slice("to", to, 9)?) };
        // SAFETY: as the caller promises.
        let (state, stress, tangent) = unsafe {
            (
                slice_mut("state", state, state_length)?,
                slice_mut("stress", stress, count)?,
                slice_mut("tangent", tangent, count.saturating_mul(count))?,
            )
        };
        let material = material(name, properties)?;
        let wrong = || FfiError::WrongLength { quantity: "f", expected: 9, found: 0 };
        let f = [from.first_chunk().ok_or_else(wrong)?, to.first_chunk().ok_or_else(wrong)?];
        umat(&material, [direct, shear], PointIncrement { f, dt, temperature }, state, stress, tangent)
    })
}

/// Corotated stresses and states of Abaqus/Explicit; see `fortran/vumat.f`. No tangent is computed.
///
/// `before` and `after` have n (`direct` + `shear`) numbers, each component an array: 11, 22, 33, 12, 23, 13; with a null pointer
/// the body is undeformed before. `added` is added to the diagonal of `after`: 0 for stretches, 1 for small strains. `temperatures` has n
/// numbers, tempNew, which the law `thermal` takes as its new states. Without temperatures `thermal` keeps its states, and a state of zero
/// becomes the reference temperature. `old` and `new_states`
/// have n `state_length` numbers, each variable an array; a state of zeros is that of the body as it was made, and states of elastic laws are
/// copied. `stresses` gets as many numbers as `after` has. Outputs that overlap inputs or one another are refused.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_vumat(
    name: *const c_char,
    name_length: usize,
    properties: *const f64,
    properties_length: usize,
    points: usize,
    direct: usize,
    shear: usize,
    before: *const f64,
    after: *const f64,
    added: f64,
    dt: f64,
    temperatures: *const f64,
    temperatures_length: usize,
    old: *const f64,
    new_states: *mut f64,
    state_length: usize,
    stresses: *mut f64,
) -> PiolaStatus {
    answer(|| {
        let count = points.saturating_mul(direct.saturating_add(shear));
        let numbers = points.saturating_mul(state_length);
        let before_length = if before.is_null() { 0 } else { count };
        check_apart(
            &[("new_states", new_states, numbers), ("stresses", stresses, count)],
            &[
                ("properties", properties, properties_length),
                ("before", before, before_length),
                ("after", after, count),
                ("temperatures", temperatures, temperatures_length),
                ("old", old, numbers),
            ],
        )?;
        // SAFETY: as the caller promises.
        let (name, properties) =
            unsafe { (padded("name", name, name_length)?, slice("properties", properties, properties_length)?) };
        // SAFETY: as the caller promises.
        let (before, after) = unsafe { (slice("before", before, before_length)?, slice("after", after, count)?) };
        // SAFETY: as the caller promises.
        let temperatures = unsafe { slice("temperatures", temperatures, temperatures_length)? };
        // SAFETY: as the caller promises.
        let states = unsafe { (slice("old", old, numbers)?, slice_mut("new_states", new_states, numbers)?) };
        // SAFETY: as the caller promises.
        let stresses = unsafe { slice_mut("stresses", stresses, count)? };
        let material = material(name, properties)?;
        vumat(&material, [direct, shear], Stretching { before, after, added, dt, temperatures }, states, stresses)
    })
}
