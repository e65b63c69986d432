//! Parameters of laws from tables: data and options come as JSON, results go as JSON.

use piola::fit::fluids::{FlowData, Options as FluidOptions, fit_flow};
use piola::fit::solids::{AnyModel, Data, Options, fit};
use piola::fluids::{
    AnyFluid, Bingham, CarreauYasuda, Casson, Cross, Ellis, Eyring, HerschelBulkley, Newtonian, Papanastasiou,
    Parameters, PowerLaw, Sisko, ViscometricFluid,
};
use pyo3::prelude::*;
use serde_json::{Value, json};

use crate::arrays::refused;

/// Fits a law of a solid to tests.
#[pyfunction]
pub(crate) fn fit_solid(py: Python<'_>, model: &str, tests: &str, options: &str) -> PyResult<String> {
    let model: AnyModel = model.parse().map_err(refused)?;
    let data: Data = serde_json::from_str(tests).map_err(refused)?;
    let options: Options = serde_json::from_str(options).map_err(refused)?;
    let found = py.detach(|| fit(&model, &data, &options)).map_err(refused)?;
    let mut result = serde_json::to_value(&found).map_err(refused)?;
    result["converged"] = json!(found.outcome.is_converged());
    result["stable"] = json!(found.stability.is_stable());
    Ok(result.to_string())
}

/// A fluid whose parameters are searched for.
fn found<F, const N: usize>(rows: &[[f64; 2]], start: &[f64], options: &FluidOptions) -> PyResult<Value>
where
    F: Parameters<N> + ViscometricFluid + Into<AnyFluid>,
{
    let start: [f64; N] = start.try_into().map_err(|_| {
        refused(format!("the start has {} numbers; the parameters are {}", start.len(), F::NAMES.join(", ")))
    })?;
    let data = FlowData::flow_curve(rows).map_err(refused)?;
    let fit = fit_flow::<F, N>(&[data], &[start], options).map_err(refused)?;
    let fluid: AnyFluid = fit.fluid.into();
    Ok(json!({
        "fluid": fluid,
        "parameters": fit.parameters,
        "covariance": fit.covariance,
        "residuals": fit.residuals,
        "squares": fit.squares,
        "degrees_of_freedom": fit.degrees_of_freedom,
        "criteria": fit.criteria,
        "outcome": fit.outcome,
        "converged": fit.outcome.is_converged(),
    }))
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
    let search = match name {
        "newtonian" => found::<Newtonian, 1>,
        "power_law" => found::<PowerLaw, 2>,
        "bingham" => found::<Bingham, 2>,
        "casson" => found::<Casson, 2>,
        "eyring" => found::<Eyring, 2>,
        "herschel_bulkley" => found::<HerschelBulkley, 3>,
        "sisko" => found::<Sisko, 3>,
        "ellis" => found::<Ellis, 3>,
        "cross" => found::<Cross, 4>,
        "papanastasiou" => found::<Papanastasiou, 4>,
        "carreau_yasuda" => found::<CarreauYasuda, 5>,
        other => {
            return Err(refused(format!(
                "`{other}` is no fluid that can be fitted; there are newtonian, power_law, bingham, casson, eyring, \
                 herschel_bulkley, sisko, ellis, cross, papanastasiou, carreau_yasuda"
            )));
        }
    };
    py.detach(|| search(&rows, &start, &options)).map(|result| result.to_string())
}
