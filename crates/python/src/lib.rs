//! The compiled half of the Python package `piola`: the module `piola._native`.
//!
//! Arrays cross as flat views of `numpy`'s own memory. The Python half, `python/piola/__init__.py`, checks shapes, makes the
//! output arrays and holds the documentation.
#![forbid(unsafe_code)]

mod arrays;
mod fits;
mod fluids;
#[cfg(feature = "history")]
mod histories;
#[cfg(feature = "scenes")]
mod scenes;
mod solids;

use pyo3::prelude::*;

/// What Python imports.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::fits::{fit_fluid, fit_solid};
    #[pymodule_export]
    use crate::fluids::Fluid;
    #[cfg(feature = "history")]
    #[pymodule_export]
    use crate::histories::History;
    #[cfg(feature = "scenes")]
    #[pymodule_export]
    use crate::scenes::run_scene;
    #[pymodule_export]
    use crate::solids::Solid;

    /// The version of the library.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
