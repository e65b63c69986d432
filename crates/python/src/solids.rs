//! Laws of solids.

use piola::solids::AnySolid;
use piola_ffi::points::{StressMeasure, TangentMeasure, VoigtNumbering};
use piola_ffi::{FfiError, points, text};
use pyo3::prelude::*;

use crate::arrays::{Read, Write, choice, numbers, numbers_mut, points as nine, points_mut, refused};

/// A law of a solid.
#[pyclass(frozen, module = "piola._native")]
pub(crate) struct Solid(AnySolid);

/// Bad points are a message, for whoever wants the others; all else is an error.
fn message(result: Result<(), FfiError>) -> PyResult<Option<String>> {
    match result {
        Ok(()) => Ok(None),
        Err(error @ FfiError::BadPoints { .. }) => Ok(Some(error.to_string())),
        Err(error) => Err(refused(error)),
    }
}

#[pymethods]
impl Solid {
    /// From JSON.
    #[new]
    fn new(json: &str) -> PyResult<Self> {
        text::solid_from_json(json).map(Self).map_err(refused)
    }

    /// From the summary of a fit.
    #[staticmethod]
    #[pyo3(signature = (summary, model=None, volumetric=None))]
    fn from_fit(summary: &str, model: Option<&str>, volumetric: Option<&str>) -> PyResult<Self> {
        let volumetric = volumetric.map(text::volumetric_from_json).transpose().map_err(refused)?;
        text::solid_from_fit(summary, model, volumetric).map(Self).map_err(refused)
    }

    /// From a name and numbers in order.
    #[staticmethod]
    #[expect(clippy::needless_pass_by_value, reason = "Python gives the list away")]
    fn from_values(name: &str, values: Vec<f64>) -> PyResult<Self> {
        piola_ffi::named::solid(name, &values).map(Self).map_err(refused)
    }

    /// The law as JSON.
    fn json(&self) -> PyResult<String> {
        serde_json::to_string(&self.0).map_err(refused)
    }

    /// The energy at each point.
    #[expect(clippy::needless_pass_by_value, reason = "borrows of arrays end here")]
    fn energy(&self, py: Python<'_>, f: Read<'_>, mut out: Write<'_>) -> PyResult<Option<String>> {
        let (f, out) = (nine(numbers(&f)?)?, numbers_mut(&mut out)?);
        message(py.detach(|| points::energy(&self.0, f, out)))
    }

    /// The stress at each point.
    #[expect(clippy::needless_pass_by_value, reason = "borrows of arrays end here")]
    fn stress(&self, py: Python<'_>, measure: &str, f: Read<'_>, mut out: Write<'_>) -> PyResult<Option<String>> {
        let measure = choice("stress", &StressMeasure::ALL, measure)?;
        let (f, out) = (nine(numbers(&f)?)?, points_mut(numbers_mut(&mut out)?)?);
        message(py.detach(|| points::stress(&self.0, measure, f, out)))
    }

    /// The tangent at each point.
    #[expect(clippy::needless_pass_by_value, reason = "borrows of arrays end here")]
    fn tangent(
        &self,
        py: Python<'_>,
        measure: &str,
        voigt: &str,
        f: Read<'_>,
        mut out: Write<'_>,
    ) -> PyResult<Option<String>> {
        let measure = choice("tangent", &TangentMeasure::ALL, measure)?;
        let voigt = choice("Voigt order", &VoigtNumbering::ALL, voigt)?;
        let (f, out) = (nine(numbers(&f)?)?, numbers_mut(&mut out)?);
        message(py.detach(|| points::tangent(&self.0, measure, voigt, f, out)))
    }

    /// Both at each point.
    #[expect(clippy::needless_pass_by_value, reason = "borrows of arrays end here")]
    fn stress_and_tangent(
        &self,
        py: Python<'_>,
        measures: (String, String, String),
        f: Read<'_>,
        mut stresses: Write<'_>,
        mut tangents: Write<'_>,
    ) -> PyResult<Option<String>> {
        let stress = choice("stress", &StressMeasure::ALL, &measures.0)?;
        let tangent = choice("tangent", &TangentMeasure::ALL, &measures.1)?;
        let voigt = choice("Voigt order", &VoigtNumbering::ALL, &measures.2)?;
        let f = nine(numbers(&f)?)?;
        let out = (points_mut(numbers_mut(&mut stresses)?)?, numbers_mut(&mut tangents)?);
        message(py.detach(|| points::stress_and_tangent(&self.0, (stress, tangent), voigt, f, out)))
    }
}
