//! Laws with history.

use piola::inelastic::AnyInelastic;
use piola_ffi::history::text::{history_from_fit, history_from_json};
use piola_ffi::history::{DeformationIncrement, StateLayout, States, advance, initial_states};
use piola_ffi::points::{StressMeasure, TangentMeasure, VoigtNumbering};
use piola_ffi::{FfiError, named};
use pyo3::prelude::*;

use crate::arrays::{Read, Write, choice, numbers, numbers_mut, points as nine, points_mut, refused};

/// A law with history.
#[pyclass(frozen, module = "piola._native")]
pub(crate) struct History(AnyInelastic);

#[pymethods]
impl History {
    /// From JSON.
    #[new]
    fn new(json: &str) -> PyResult<Self> {
        history_from_json(json).map(Self).map_err(refused)
    }

    /// From the summary of a fit.
    #[staticmethod]
    #[pyo3(signature = (summary, model=None))]
    fn from_fit(summary: &str, model: Option<&str>) -> PyResult<Self> {
        history_from_fit(summary, model).map(Self).map_err(refused)
    }

    /// From a name and numbers in order.
    #[staticmethod]
    #[expect(clippy::needless_pass_by_value, reason = "Python gives the list away")]
    fn from_values(name: &str, values: Vec<f64>) -> PyResult<Self> {
        named::history(name, &values).map(Self).map_err(refused)
    }

    /// The law as JSON.
    fn json(&self) -> PyResult<String> {
        serde_json::to_string(&self.0).map_err(refused)
    }

    /// The number of internal variables.
    fn state_length(&self) -> usize {
        self.0.state_length()
    }

    /// Writes the states of points of the body as it was made.
    fn initial_states(&self, layout: &str, mut states: Write<'_>) -> PyResult<()> {
        let layout = choice("layout of states", &StateLayout::ALL, layout)?;
        initial_states(&self.0, layout, numbers_mut(&mut states)?).map_err(refused)
    }

    /// One increment at each point; the message where points failed.
    #[expect(clippy::needless_pass_by_value, reason = "borrows of arrays end here")]
    #[expect(clippy::too_many_arguments, reason = "flat arrays, each an argument")]
    fn advance(
        &self,
        py: Python<'_>,
        names: (String, String, String, String),
        path: (Read<'_>, Read<'_>),
        times: (f64, Option<f64>),
        before: Read<'_>,
        mut after: Write<'_>,
        mut stresses: Write<'_>,
        mut tangents: Option<Write<'_>>,
    ) -> PyResult<Option<String>> {
        let stress = choice("stress", &StressMeasure::ALL, &names.0)?;
        let tangent = choice("tangent", &TangentMeasure::ALL, &names.1)?;
        let voigt = choice("Voigt order", &VoigtNumbering::ALL, &names.2)?;
        let layout = choice("layout of states", &StateLayout::ALL, &names.3)?;
        let (from, to) = (nine(numbers(&path.0)?)?, nine(numbers(&path.1)?)?);
        let increment = DeformationIncrement { from, to, dt: times.0, tolerance: times.1 };
        let states = States { layout, before: numbers(&before)?, after: numbers_mut(&mut after)? };
        let stresses = points_mut(numbers_mut(&mut stresses)?)?;
        let tangents = match &mut tangents {
            Some(tangents) => Some((tangent, voigt, numbers_mut(tangents)?)),
            None => None,
        };
        match py.detach(|| advance(&self.0, increment, states, stress, stresses, tangents)) {
            Ok(()) => Ok(None),
            Err(error @ FfiError::BadIncrements { .. }) => Ok(Some(error.to_string())),
            Err(error) => Err(refused(error)),
        }
    }
}
