//! Parameters of laws from tables: data and options come as JSON, results go as JSON.

use piola::fit::fluids::{FlowData, FluidModel, Options as FluidOptions};
use piola::fit::solids::{AnyModel, Data, Options};
use pyo3::prelude::*;
use serde_json::json;

use crate::arrays::refused;

/// Fits a law of a solid to tests.
#[pyfunction]
pub(crate) fn fit_solid(py: Python<'_>, model: &str, tests: &str, options: &str) -> PyResult<String> {
    let model: AnyModel = model.parse().map_err(refused)?;
    let data: Data = serde_json::from_str(tests).map_err(refused)?;
    let options: Options = serde_json::from_str(options).map_err(refused)?;
    let found = py.detach(|| model.fit_until(&data, &options, &|| false)).map_err(refused)?;
    let mut result = serde_json::to_value(&found).map_err(refused)?;
    result["converged"] = json!(found.outcome.is_converged());
    result["stable"] = json!(found.stability.is_stable());
    Ok(result.to_string())
}

/// Fits a fluid to a flow curve.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "Python gives the lists away")]
pub(crate) fn fit_fluid(
    py: Python<'_>,
    name: &str,
    rows: Vec<[f64; 2]>,
    start: Vec<f64>,
    options: &str,
) -> PyResult<String> {
    let options: FluidOptions = serde_json::from_str(options).map_err(refused)?;
    // Written fluids have names of Python's kind, `power_law`.
    let model: FluidModel = name.replace('_', "-").parse().map_err(refused)?;
    let data = FlowData::flow_curve(&rows).map_err(refused)?;
    let fit = py.detach(|| model.fit_until(&[data], &[start], &options, &|| false)).map_err(refused)?;
    let result = json!({
        "fluid": fit.fluid,
        "parameters": fit.parameters,
        "covariance": fit.covariance,
        "residuals": fit.residuals,
        "squares": fit.squares,
        "degrees_of_freedom": fit.degrees_of_freedom,
        "criteria": fit.criteria,
        "outcome": fit.outcome,
        "converged": fit.outcome.is_converged(),
    });
    Ok(result.to_string())
}
