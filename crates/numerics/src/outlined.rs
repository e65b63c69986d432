//! Functions that stay apart from their callers.

/// Calls a function that is compiled once for its type, not once in each of its callers: many long laws in one function take the compiler ten times
/// as long.
///
/// It is compiled for the least capable machine: lanes, which need the instructions of their caller, must not come here.
#[inline(never)]
pub fn outlined<R>(f: impl FnOnce() -> R) -> R {
    f()
}
