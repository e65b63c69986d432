//! The two functions behind `fortran/umat.f` and `fortran/vumat.f`.

use std::ffi::c_char;

use super::PiolaStatus;
use super::memory::{check_apart, slice, slice_mut};
use super::status::answer;
use crate::materials::material;
use crate::{FfiError, abaqus};

/// A name of Fortran: so many characters, with blanks at the end.
///
/// # Safety
/// See the [module](super).
pub(super) unsafe fn padded<'a>(
    argument: &'static str,
    text: *const c_char,
    length: usize,
) -> Result<&'a str, FfiError> {
    // SAFETY: characters are bytes; as the caller promises.
    let bytes = unsafe { slice(argument, text.cast::<u8>(), length) }?;
    let text = core::str::from_utf8(bytes);
    Ok(text.map_err(|error| FfiError::NotText { argument, index: error.valid_up_to() })?.trim_end())
}

/// STRESS and DDSDDE of Abaqus at one point; see `fortran/umat.f`.
///
/// `name` has `name_length` characters: a law with its parameters in `properties`, or the name of a file in the folder
/// `PIOLA_MATERIALS`. `f` is DFGRD1, nine numbers by columns. `stress` gets NTENS = `direct` + `shear` numbers, `tangent` NTENS^2.
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
    f: *const f64,
    stress: *mut f64,
    tangent: *mut f64,
) -> PiolaStatus {
    answer(|| {
        let count = direct.saturating_add(shear);
        let outputs =
            [("stress", stress.cast_const(), count), ("tangent", tangent.cast_const(), count.saturating_mul(count))];
        check_apart(&outputs, &[("properties", properties, properties_length), ("f", f, 9)])?;
        // SAFETY: as the caller promises.
        let (name, properties) =
            unsafe { (padded("name", name, name_length)?, slice("properties", properties, properties_length)?) };
        // SAFETY: as the caller promises.
        let f = unsafe { slice("f", f, 9) }?;
        // SAFETY: as the caller promises.
        let (stress, tangent) = unsafe {
            (slice_mut("stress", stress, count)?, slice_mut("tangent", tangent, count.saturating_mul(count))?)
        };
        let law = material(name, properties)?;
        let wrong = FfiError::WrongLength { quantity: "f", expected: 9, found: f.len() };
        abaqus::umat(&law, [direct, shear], f.first_chunk().ok_or(wrong)?, stress, tangent)
    })
}

/// Corotated stresses of Abaqus/Explicit; see `fortran/vumat.f`.
///
/// `stretches` has n (`direct` + `shear`) numbers, each component an array: 11, 22, 33, 12, 23, 13. `added` is added to the
/// diagonal: 0 for stretches, 1 for small strains. `stresses` gets as many numbers in the same order.
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
    stretches: *const f64,
    added: f64,
    stresses: *mut f64,
) -> PiolaStatus {
    answer(|| {
        let count = points.saturating_mul(direct.saturating_add(shear));
        check_apart(
            &[("stresses", stresses, count)],
            &[("properties", properties, properties_length), ("stretches", stretches, count)],
        )?;
        // SAFETY: as the caller promises.
        let (name, properties) =
            unsafe { (padded("name", name, name_length)?, slice("properties", properties, properties_length)?) };
        // SAFETY: as the caller promises.
        let (stretches, stresses) =
            unsafe { (slice("stretches", stretches, count)?, slice_mut("stresses", stresses, count)?) };
        let law = material(name, properties)?;
        abaqus::vumat(&law, [direct, shear], stretches, added, stresses)
    })
}
