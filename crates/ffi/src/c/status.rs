//! Results of calls: a code, and a message for each thread.

use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::FfiError;

/// The result of a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum PiolaStatus {
    /// Everything was computed.
    Ok = 0,
    /// A pointer that must lead somewhere is null or does not lead to a number's boundary, or an output overlaps another array.
    BadPointer = 1,
    /// An array has another length than the arrays beside it ask for.
    WrongLength = 2,
    /// A number that was given is infinite or NaN.
    NotFinite = 3,
    /// A choice has a number or a name that it does not have.
    UnknownChoice = 4,
    /// A text describes no law, or its parameters violate a condition.
    BadLaw = 5,
    /// The law has no answer at some points: theirs are NaN, all others are written.
    BadPoints = 6,
    /// A flow has no answer.
    BadFlow = 7,
    /// A fault of this library.
    Fault = 8,
}

impl FfiError {
    /// The code of an error.
    #[must_use]
    pub const fn status(&self) -> PiolaStatus {
        match self {
            Self::NullPointer { .. } | Self::Misaligned { .. } | Self::Overlap { .. } => PiolaStatus::BadPointer,
            Self::WrongLength { .. } => PiolaStatus::WrongLength,
            Self::NotFinite { .. } => PiolaStatus::NotFinite,
            Self::UnknownChoice { .. } | Self::Components { .. } => PiolaStatus::UnknownChoice,
            Self::BadPoints { .. } => PiolaStatus::BadPoints,
            #[cfg(feature = "history")]
            Self::BadIncrements { .. } => PiolaStatus::BadPoints,
            #[cfg(feature = "history")]
            Self::Inelastic(_) => PiolaStatus::BadLaw,
            Self::Viscometry(_) | Self::Fluids(_) => PiolaStatus::BadFlow,
            Self::NotText { .. }
            | Self::WrongCount { .. }
            | Self::WrongParameter { .. }
            | Self::Unreadable { .. }
            | Self::NoMaterial { .. }
            | Self::Solids(_)
            | Self::Fit(_) => PiolaStatus::BadLaw,
            Self::Fault { .. } => PiolaStatus::Fault,
        }
    }
}

thread_local! {
    static MESSAGE: RefCell<CString> = RefCell::new(CString::default());
}

/// Keeps a message for this thread.
fn remember(message: String) {
    let text: Vec<u8> = message.into_bytes().into_iter().filter(|byte| *byte != 0).collect();
    MESSAGE.with_borrow_mut(|kept| *kept = CString::new(text).unwrap_or_default());
}

/// The message of a panic.
fn said(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no message".to_owned())
}

/// Runs the body of a function: errors become codes and messages, panics end here.
pub fn answer(body: impl FnOnce() -> Result<(), FfiError>) -> PiolaStatus {
    let result = catch_unwind(AssertUnwindSafe(body))
        .unwrap_or_else(|payload| Err(FfiError::Fault { message: said(payload.as_ref()) }));
    match result {
        Ok(()) => PiolaStatus::Ok,
        Err(error) => {
            let status = error.status();
            remember(error.to_string());
            status
        }
    }
}

/// Message of the last call of this thread that failed; empty if none did.
///
/// It ends with a zero byte and stays valid until another call of the same thread fails.
#[unsafe(no_mangle)]
pub extern "C" fn piola_last_error() -> *const c_char {
    MESSAGE.with_borrow(|kept| kept.as_ptr())
}

/// Copies the message of the last failed call of this thread, padded with blanks as Fortran does; returns its length.
///
/// # Safety
/// `text` leads to `length` characters, or `length` is 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_last_error_padded(text: *mut c_char, length: usize) -> usize {
    MESSAGE.with_borrow(|kept| {
        let message = kept.to_bytes();
        if !text.is_null() {
            for index in 0..length {
                let byte = message.get(index).copied().unwrap_or(b' ');
                // SAFETY: below the length that the caller gave.
                unsafe { text.add(index).write(byte.cast_signed()) };
            }
        }
        message.len()
    })
}

/// Version of the library, such as `0.1.0`.
#[unsafe(no_mangle)]
pub extern "C" fn piola_version() -> *const c_char {
    const VERSION: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
        Ok(version) => version,
        Err(_) => c"",
    };
    VERSION.as_ptr()
}
