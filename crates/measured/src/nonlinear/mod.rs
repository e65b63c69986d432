//! Viscoelastic fluids from start-up of shear and extension, steady flows and normal stresses.
//!
//! ```text
//! header of the file                                      flow
//! shear rate [1/s],time [s],shear stress [Pa],N1 [Pa]     start-up of shear; without the time: steady shear
//! extension rate [1/s],time [s],viscosity [Pa s]          start-up of extension; without the time: steady extension
//! ```
//! A file of one rate may have it in a comment, `# shear rate: 2 1/s`, instead of a column.
//!
//! Each flow has a file of its own; several rates stand in the column of the rate or in several files. Rates within 1 % are those of one
//! start-up. N₁ and N₂ are differences of normal stresses, N₂ negative; their coefficients are ψ₁ = N₁/k² and ψ₂ = N₂/k². Of extension the response is the stress difference that drives it, or this over the rate.
//! `# extension: planar` or `biaxial` says which; without it, it is uniaxial.

mod columns;
mod curves;
mod figure;
mod output;
mod table;

pub use piola_fit::nonlinear::{NonlinearModel, RelaxationModes};
pub use table::NonlinearTable;

use core::ops::ControlFlow;
use std::path::Path;

use piola_fit::nonlinear::{NonlinearFit, Options, ShearResponse, fit_nonlinear_until};
use piola_fit::{FitError, Intervals};
use piola_fluids::Relaxation;
use serde_json::Value;

use crate::MeasuredError;
use crate::comparison::{Comparison, Judged, Watch};
use crate::sheet::read;

/// Fluids to compare, and how.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct NonlinearRequest {
    /// The fluids; without any, all that have the measured responses.
    pub fluids: Vec<NonlinearModel>,
    /// The relaxation modes: a number of modes whose viscosities and times are fitted, or given ones.
    pub modes: RelaxationModes,
    /// The probability of the intervals.
    pub confidence: f64,
    /// How intervals are found.
    pub intervals: Intervals,
}

impl Default for NonlinearRequest {
    fn default() -> Self {
        Self { fluids: Vec::new(), modes: RelaxationModes::default(), confidence: 0.95, intervals: Intervals::Linear }
    }
}

/// Viscoelastic fluids fitted to the same flows.
pub type NonlinearComparison = Comparison<NonlinearModel, FittedNonlinear, FitError>;

/// A fitted viscoelastic fluid, and the modes that it was fitted with.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FittedNonlinear {
    /// The fit.
    pub fit: NonlinearFit,
    /// The modes.
    pub modes: RelaxationModes,
}

impl Judged for FittedNonlinear {
    fn aicc(&self) -> Option<f64> {
        self.fit.criteria.aicc
    }
    fn is_converged(&self) -> bool {
        self.fit.outcome.is_converged()
    }
    fn widening(&self) -> f64 {
        self.fit.autocorrelation.map_or(1.0, |found| found.widening)
    }
}

/// Fits each fluid to all flows at once.
///
/// # Errors
/// [`MeasuredError::Fit`] for invalid relaxation modes, or a confidence that is not between 0 and 1. The refusal of a single fluid stands in
/// its [`Candidate`](crate::comparison::Candidate).
///
/// # Example
/// ```
/// use piola_measured::nonlinear::{NonlinearRequest, NonlinearTable, compare_nonlinear};
/// // Oldroyd's fluid B: N₁ = 2 ηₚ λ k² = 16 k², and τ = ηₛ k + ηₚ k (1 − e^(−t/λ)) with ηₛ = 1, ηₚ = 2, λ = 4.
/// let normal = "shear rate [1/s],N1 [Pa]\n1,16\n2,64\n";
/// let start = "# shear rate: 1 1/s\ntime [s],shear stress [Pa]\n1,1.44239843\n4,2.26424112\n16,2.96336872\n";
/// let mut table = NonlinearTable::parse("normal.csv", normal)?;
/// table.flows.extend(NonlinearTable::parse("start.csv", start)?.flows);
/// let mut request = NonlinearRequest::default();
/// request.fluids = vec!["oldroyd-b".parse()?];
/// let comparison = compare_nonlinear(&table, &request)?;
/// let (_, found) = comparison.fits().next().expect("a fit");
/// assert!((found.fit.parameters[2].value - 4.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn compare_nonlinear(
    table: &NonlinearTable,
    request: &NonlinearRequest,
) -> Result<NonlinearComparison, MeasuredError> {
    compare_nonlinear_until(table, request, &mut |_| ControlFlow::Continue(()))
}

/// The same while `watch`, which is told the finished part of the fluids, lets it go on.
///
/// # Errors
/// As [`compare_nonlinear`].
pub fn compare_nonlinear_until(
    table: &NonlinearTable,
    request: &NonlinearRequest,
    watch: Watch<'_>,
) -> Result<NonlinearComparison, MeasuredError> {
    let NonlinearRequest { fluids, modes, confidence, intervals } = request;
    if !(0.0 < *confidence && *confidence < 1.0) {
        return Err(FitError::ConfidenceOutOfRange { value: *confidence }.into());
    }
    modes.check()?;
    let (modes, intervals) = (modes.clone(), *intervals);
    let options = Options { confidence: *confidence, intervals, modes, ..Options::default() };
    let second = Some(ShearResponse::SecondNormalStressDifference);
    let has_second = table.flows.iter().any(|set| set.flow().shear_response() == second);
    let fluids = if fluids.is_empty() {
        let has_all = |model: &NonlinearModel| !has_second || model.has_second_normal_stress();
        NonlinearModel::ALL.into_iter().filter(has_all).collect()
    } else {
        fluids.clone()
    };
    Ok(Comparison::of(&fluids, watch, |fluid, stop| {
        let fit = fit_nonlinear_until(fluid, &table.flows, &options, stop)?;
        Ok(FittedNonlinear { fit, modes: options.modes.clone() })
    }))
}

/// The modes of a relaxation spectrum in the `summary.json` of `piola spectrum`: ηᵢ = gᵢ τᵢ.
///
/// # Errors
/// [`MeasuredError::Unreadable`], [`MeasuredError::TooLarge`], [`MeasuredError::NotText`]; [`MeasuredError::Argument`] for a file that
/// is no such summary, or of a solid.
pub fn modes_of_spectrum(path: &Path) -> Result<RelaxationModes, MeasuredError> {
    let text = read(path)?;
    let wrong = |valid: &'static str| MeasuredError::Argument { argument: path.display().to_string(), valid };
    let summary: Value = serde_json::from_str(&text).map_err(|error| MeasuredError::Argument {
        argument: format!("{}: {error}", path.display()),
        valid: "the summary.json of `piola spectrum`",
    })?;
    if summary["equilibrium_modulus"].as_f64().is_some_and(|modulus| 0.0 < modulus) {
        return Err(wrong("the spectrum of a liquid: without --equilibrium"));
    }
    let mode = |mode: &Value| {
        let (modulus, time) = (mode["modulus"].as_f64()?, mode["relaxation_time"].as_f64()?);
        Some(Relaxation { viscosity: modulus * time, time })
    };
    let modes = summary["modes"].as_array().and_then(|modes| modes.iter().map(mode).collect::<Option<Vec<_>>>());
    let modes = modes.filter(|modes| !modes.is_empty());
    Ok(RelaxationModes::Given(modes.ok_or_else(|| wrong("the summary.json of `piola spectrum`"))?))
}
