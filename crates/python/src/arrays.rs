//! Flat arrays of `numpy` as slices, and errors as `ValueError`.

use std::fmt::Display;

use numpy::{PyReadonlyArray1, PyReadwriteArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// An array to read, without a copy.
pub(crate) type Read<'py> = PyReadonlyArray1<'py, f64>;
/// An array to write.
pub(crate) type Write<'py> = PyReadwriteArray1<'py, f64>;

/// The error that Python sees.
pub(crate) fn refused(error: impl Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// The numbers of an array.
pub(crate) fn numbers<'a>(array: &'a Read<'_>) -> PyResult<&'a [f64]> {
    array.as_slice().map_err(refused)
}

/// The numbers of an array, to write.
pub(crate) fn numbers_mut<'a>(array: &'a mut Write<'_>) -> PyResult<&'a mut [f64]> {
    array.as_slice_mut().map_err(refused)
}

/// Numbers as points of nine.
pub(crate) fn points(numbers: &[f64]) -> PyResult<&[[f64; 9]]> {
    match numbers.as_chunks() {
        (points, []) => Ok(points),
        _ => Err(incomplete(numbers.len())),
    }
}

/// Numbers as points of nine, to write.
pub(crate) fn points_mut(numbers: &mut [f64]) -> PyResult<&mut [[f64; 9]]> {
    let found = numbers.len();
    match numbers.as_chunks_mut() {
        (points, []) => Ok(points),
        _ => Err(incomplete(found)),
    }
}

fn incomplete(found: usize) -> PyErr {
    refused(format!("{found} numbers are no tensors of nine each"))
}

/// The choice of a name.
pub(crate) fn choice<T: Copy>(what: &str, all: &[(&'static str, T)], name: &str) -> PyResult<T> {
    let found = all.iter().find(|(known, _)| *known == name);
    found.map(|(_, choice)| *choice).ok_or_else(|| {
        let names: Vec<_> = all.iter().map(|(name, _)| *name).collect();
        refused(format!("`{name}` is no {what}; there are {}", names.join(", ")))
    })
}
