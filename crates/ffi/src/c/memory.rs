//! Memory and texts of the caller as slices and strings, checked as far as it can be.

use std::ffi::{CStr, c_char};

use crate::FfiError;

/// Refuses what can be no array of this length.
fn check<T>(argument: &'static str, pointer: *const T, length: usize) -> Result<(), FfiError> {
    if pointer.is_null() {
        return Err(FfiError::NullPointer { argument });
    }
    if !pointer.is_aligned() {
        return Err(FfiError::Misaligned { argument });
    }
    let most = isize::MAX.unsigned_abs() / size_of::<T>().max(1);
    if most < length {
        Err(FfiError::WrongLength { quantity: argument, expected: most, found: length })
    } else {
        Ok(())
    }
}

/// An array to read. A null pointer will do where the length is 0.
///
/// # Safety
/// The pointer leads to `length` values, which nobody changes while the slice is in use.
pub(super) unsafe fn slice<'a, T>(
    argument: &'static str,
    pointer: *const T,
    length: usize,
) -> Result<&'a [T], FfiError> {
    if length == 0 {
        return Ok(&[]);
    }
    check(argument, pointer, length)?;
    // SAFETY: not null, on a boundary, and as long as the caller promises.
    Ok(unsafe { core::slice::from_raw_parts(pointer, length) })
}

/// An array to write.
///
/// # Safety
/// The pointer leads to `length` values, which nobody else uses while the slice is in use.
pub(super) unsafe fn slice_mut<'a, T>(
    argument: &'static str,
    pointer: *mut T,
    length: usize,
) -> Result<&'a mut [T], FfiError> {
    if length == 0 {
        return Ok(&mut []);
    }
    check(argument, pointer, length)?;
    // SAFETY: not null, on a boundary, and as long as the caller promises.
    Ok(unsafe { core::slice::from_raw_parts_mut(pointer, length) })
}

/// An array of numbers by its name, its place and its length.
pub(super) type Array = (&'static str, *const f64, usize);

/// Refuses outputs that overlap inputs or one another.
pub(super) fn check_apart(outputs: &[Array], inputs: &[Array]) -> Result<(), FfiError> {
    let ends = |&(_, pointer, length): &Array| {
        let start = pointer.addr();
        (start, start.saturating_add(length.saturating_mul(size_of::<f64>())))
    };
    // What can be no array is refused where it is made a slice.
    let is_some = |&(argument, pointer, length): &Array| 0 < length && check(argument, pointer, length).is_ok();
    for (number, output) in outputs.iter().enumerate() {
        let (start, end) = ends(output);
        for other in outputs[number + 1..].iter().chain(inputs) {
            let (from, to) = ends(other);
            if start < to && from < end && is_some(output) && is_some(other) {
                return Err(FfiError::Overlap { output: output.0, other: other.0 });
            }
        }
    }
    Ok(())
}

/// Numbers as points of K each.
pub(super) fn points<'a, const K: usize>(
    argument: &'static str,
    numbers: &'a [f64],
) -> Result<&'a [[f64; K]], FfiError> {
    match numbers.as_chunks() {
        (points, []) => Ok(points),
        (points, _) => Err(incomplete::<K>(argument, points.len(), numbers.len())),
    }
}

/// Numbers as points of K each, to write.
pub(super) fn points_mut<'a, const K: usize>(
    argument: &'static str,
    numbers: &'a mut [f64],
) -> Result<&'a mut [[f64; K]], FfiError> {
    let found = numbers.len();
    match numbers.as_chunks_mut() {
        (points, []) => Ok(points),
        (points, _) => Err(incomplete::<K>(argument, points.len(), found)),
    }
}

fn incomplete<const K: usize>(quantity: &'static str, points: usize, found: usize) -> FfiError {
    FfiError::WrongLength { quantity, expected: K * (points + 1), found }
}

/// A text that ends with a zero byte.
///
/// # Safety
/// The pointer is null or leads to such a text, which nobody changes while the string is in use.
pub(super) unsafe fn text<'a>(argument: &'static str, pointer: *const c_char) -> Result<&'a str, FfiError> {
    if pointer.is_null() {
        return Err(FfiError::NullPointer { argument });
    }
    // SAFETY: not null, and it ends with a zero byte as the caller promises.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map_err(|error| FfiError::NotText { argument, index: error.valid_up_to() })
}

/// A text that may be left out by a null pointer.
///
/// # Safety
/// As [`text`].
pub(super) unsafe fn optional_text<'a>(
    argument: &'static str,
    pointer: *const c_char,
) -> Result<Option<&'a str>, FfiError> {
    // SAFETY: as the caller promises.
    if pointer.is_null() { Ok(None) } else { unsafe { text(argument, pointer) }.map(Some) }
}

/// Texts, each of which ends with a zero byte.
///
/// # Safety
/// The pointer leads to `count` pointers, each as for [`text`].
pub(super) unsafe fn texts<'a>(
    argument: &'static str,
    pointers: *const *const c_char,
    count: usize,
) -> Result<Vec<&'a str>, FfiError> {
    // SAFETY: as the caller promises.
    let pointers = unsafe { slice(argument, pointers, count) }?;
    // SAFETY: as the caller promises.
    pointers.iter().map(|pointer| unsafe { text(argument, *pointer) }).collect()
}

/// A handle that this library made.
///
/// # Safety
/// The pointer is null or comes from this library and was not freed.
pub(super) unsafe fn handle<'a, T>(argument: &'static str, pointer: *const T) -> Result<&'a T, FfiError> {
    // SAFETY: as the caller promises.
    unsafe { pointer.as_ref() }.ok_or(FfiError::NullPointer { argument })
}

/// Makes a value and hands it over; the place holds a null pointer where it could not be made.
///
/// # Safety
/// `place` is null or leads to a pointer that may be written.
pub(super) unsafe fn hand_over<T>(
    place: *mut *mut T,
    make: impl FnOnce() -> Result<T, FfiError>,
) -> Result<(), FfiError> {
    check("made", place, 1)?;
    // SAFETY: not null and on a boundary.
    unsafe { place.write(core::ptr::null_mut()) };
    let made = Box::new(make()?);
    // SAFETY: as above.
    unsafe { place.write(Box::into_raw(made)) };
    Ok(())
}

/// Writes one value.
///
/// # Safety
/// `place` is null or leads to a value that may be written.
pub(super) unsafe fn put<T>(argument: &'static str, place: *mut T, value: T) -> Result<(), FfiError> {
    check(argument, place, 1)?;
    // SAFETY: not null and on a boundary.
    unsafe { place.write(value) };
    Ok(())
}

/// The choice of a number, counted from 0.
pub(super) fn choice<T: Copy>(name: &'static str, all: &[(&'static str, T)], number: i32) -> Result<T, FfiError> {
    let found = usize::try_from(number).ok().and_then(|number| all.get(number));
    found.map(|(_, choice)| *choice).ok_or_else(|| FfiError::UnknownChoice {
        choice: name,
        given: number.to_string(),
        valid: all
            .iter()
            .enumerate()
            .map(|(number, (name, _))| format!("{number} ({name})"))
            .collect::<Vec<_>>()
            .join(", "),
    })
}
