//! Fluids and their flows.

use piola::fluids::{AnyFluid, ViscometricFluid};
use piola::viscometry::Estimate;
use piola_ffi::flows::{self, ViscometricFunction};
use piola_ffi::{FfiError, text};
use pyo3::prelude::*;

use crate::arrays::{Read, Write, choice, numbers, numbers_mut, refused};

/// A fluid.
#[pyclass(frozen, module = "piola._native")]
pub(crate) struct Fluid(AnyFluid);

/// A number and its error bound.
fn pair(found: Result<Estimate, FfiError>) -> PyResult<(f64, f64)> {
    found.map(|Estimate { value, error }| (value, error)).map_err(refused)
}

#[pymethods]
impl Fluid {
    /// From JSON.
    #[new]
    fn new(json: &str) -> PyResult<Self> {
        text::fluid_from_json(json).map(Self).map_err(refused)
    }

    /// The fluid as JSON.
    fn json(&self) -> PyResult<String> {
        serde_json::to_string(&self.0).map_err(refused)
    }

    /// The yield stress, Pa.
    fn yield_stress(&self) -> f64 {
        ViscometricFluid::yield_stress(&self.0)
    }

    /// A viscometric function at each entry.
    #[expect(clippy::needless_pass_by_value, reason = "borrows of arrays end here")]
    fn viscometric(&self, py: Python<'_>, function: &str, entries: Read<'_>, mut out: Write<'_>) -> PyResult<()> {
        let function = choice("viscometric function", &ViscometricFunction::ALL, function)?;
        let (entries, out) = (numbers(&entries)?, numbers_mut(&mut out)?);
        py.detach(|| flows::viscometric(&self.0, function, entries, out)).map_err(refused)
    }

    /// Discharge of a pipe, with its error bound.
    fn pipe_discharge(&self, radius: f64, pressure_gradient: f64) -> PyResult<(f64, f64)> {
        pair(flows::pipe_discharge(&self.0, radius, pressure_gradient))
    }

    /// Pressure gradient of a pipe, with its error bound.
    fn pipe_pressure_gradient(&self, radius: f64, discharge: f64) -> PyResult<(f64, f64)> {
        pair(flows::pipe_pressure_gradient(&self.0, radius, discharge))
    }

    /// Velocities in a pipe.
    #[expect(clippy::needless_pass_by_value, reason = "borrows of arrays end here")]
    fn pipe_velocities(
        &self,
        py: Python<'_>,
        radius: f64,
        pressure_gradient: f64,
        distances: Read<'_>,
        mut out: Write<'_>,
    ) -> PyResult<()> {
        let (distances, out) = (numbers(&distances)?, numbers_mut(&mut out)?);
        py.detach(|| flows::pipe_velocities(&self.0, radius, pressure_gradient, distances, out)).map_err(refused)
    }

    /// Difference of the angular velocities of coaxial cylinders, with its error bound.
    fn couette_speed_difference(&self, radii: [f64; 2], moment: f64) -> PyResult<(f64, f64)> {
        pair(flows::couette_speed_difference(&self.0, radii, moment))
    }

    /// Moment of coaxial cylinders, with its error bound.
    fn couette_moment(&self, radii: [f64; 2], speed_difference: f64) -> PyResult<(f64, f64)> {
        pair(flows::couette_moment(&self.0, radii, speed_difference))
    }

    /// Angular velocities between coaxial cylinders.
    #[expect(clippy::needless_pass_by_value, reason = "borrows of arrays end here")]
    fn couette_angular_velocities(
        &self,
        py: Python<'_>,
        radii: [f64; 2],
        moment: f64,
        distances: Read<'_>,
        mut out: Write<'_>,
    ) -> PyResult<()> {
        let (distances, out) = (numbers(&distances)?, numbers_mut(&mut out)?);
        py.detach(|| flows::couette_angular_velocities(&self.0, radii, moment, distances, out)).map_err(refused)
    }
}
