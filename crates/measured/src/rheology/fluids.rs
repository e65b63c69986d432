//! Parameters of fluids from flow curves, discharges and speeds.

use core::cell::{Cell, RefCell};
use core::fmt::Write as _;
use core::ops::ControlFlow;

use piola_charts::{Folder, Written};
use piola_fit::FitError;
use piola_fit::fluids::{
    Autocorrelation, Criteria, FlowData, FluidModel, FluidParameter, Intervals, Options, Outcome, State, Weighting,
};
use piola_fluids::ViscometricFluid as _;
use piola_viscometry::recover::Noise;
use serde_json::{Value, json};

use super::contained::{CONTAINED, with_contained};
use super::{Flow, Measured, figure};
use crate::MeasuredError;
use crate::comparison::{self, Judged, Watch};

/// Points of a curve.
const POINTS: u32 = 120;

/// Magnitudes of the data, from which searches start.
struct Look {
    /// The least and the greatest apparent viscosity, Pa s.
    viscosity: [f64; 2],
    /// The least stress, Pa, and the stress in the middle.
    stress: [f64; 2],
    /// The rate in the middle, 1/s.
    rate: f64,
    /// K and n of a power law through all.
    power: [f64; 2],
}

impl Look {
    fn at(measured: &Measured) -> Self {
        let apparent: Vec<[f64; 2]> = measured.rows().iter().map(|row| measured.flow.apparent(*row)).collect();
        let count = apparent.len().max(1) as f64;
        let logarithms = || apparent.iter().map(|[stress, rate]| [stress.ln(), rate.ln()]);
        let [y, x] = logarithms().fold([0.0; 2], |sum, l| [sum[0] + l[0] / count, sum[1] + l[1] / count]);
        let [above, below] =
            logarithms().fold([0.0; 2], |sum, l| [sum[0] + (l[0] - y) * (l[1] - x), sum[1] + (l[1] - x) * (l[1] - x)]);
        let exponent = if 0.0 < below { (above / below).clamp(0.05, 3.0) } else { 1.0 };
        let extremes = |values: &mut dyn Iterator<Item = f64>| {
            values.fold([f64::INFINITY, 0.0_f64], |[low, high], value| [low.min(value), high.max(value)])
        };
        Self {
            viscosity: extremes(&mut apparent.iter().map(|[stress, rate]| stress / rate)),
            stress: [extremes(&mut apparent.iter().map(|[stress, _]| *stress))[0], y.exp()],
            rate: x.exp(),
            power: [(y - exponent * x).exp(), exponent],
        }
    }
}

/// The fit of a fluid of any type.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FittedFluid {
    /// Its parameters.
    pub parameters: Vec<FluidParameter>,
    /// Residuals of the rows: ln(answer/measured), or answer − measured over the largest.
    pub residuals: Vec<f64>,
    /// S, the sum of squares of the residuals.
    pub squares: f64,
    /// Criteria to choose by.
    pub criteria: Criteria,
    /// Correlation of neighbouring residuals.
    pub autocorrelation: Option<Autocorrelation>,
    /// How the search ended.
    pub outcome: Outcome,
    /// Shear rates and stresses of the fitted fluid.
    pub curve: Vec<[f64; 2]>,
}

/// Searches from the usual starts, or from `more`.
fn fitted(
    model: FluidModel,
    task: &Task<'_>,
    more: &[Vec<f64>],
    stop: &dyn Fn() -> bool,
) -> Result<FittedFluid, FitError> {
    let measured = task.measured;
    let usual = task.look.starts(model);
    let fit = model.fit_until(task.data, if more.is_empty() { &usual } else { more }, task.options, stop)?;
    let curve = curve(measured, &|rate| fit.fluid.shear_stress(rate));
    Ok(FittedFluid {
        parameters: fit.parameters,
        residuals: fit.residuals.into_iter().next().unwrap_or_default(),
        squares: fit.squares,
        criteria: fit.criteria,
        autocorrelation: fit.autocorrelation,
        outcome: fit.outcome,
        curve,
    })
}

/// What all fluids are fitted to.
struct Task<'t> {
    measured: &'t Measured,
    data: &'t [FlowData],
    look: Look,
    options: &'t Options,
}

/// Shear rates over the range that was measured, and the stresses there.
fn curve(measured: &Measured, stress: &dyn Fn(f64) -> f64) -> Vec<[f64; 2]> {
    let rates = measured.rows().iter().map(|row| measured.flow.apparent(*row)[1]);
    let (low, high) = rates.fold((f64::INFINITY, 0.0_f64), |(low, high), rate| (low.min(rate), high.max(rate)));
    let rate = |k: u32| low * (high / low).powf(f64::from(k) / f64::from(POINTS));
    (0..=POINTS).map(|k| [rate(k), stress(rate(k))]).collect()
}

impl Look {
    /// Where the searches of a fluid start.
    fn starts(&self, model: FluidModel) -> Vec<Vec<f64>> {
        let Self { viscosity, stress, rate, power } = self;
        match model {
            FluidModel::Newtonian => vec![vec![stress[1] / rate]],
            FluidModel::PowerLaw => vec![power.to_vec()],
            FluidModel::Bingham => vec![vec![0.8 * stress[0], viscosity[0]], vec![0.1 * stress[0], viscosity[0]]],
            FluidModel::Casson => {
                vec![vec![0.8 * stress[0], 0.5 * viscosity[0]], vec![0.1 * stress[0], 0.5 * viscosity[0]]]
            }
            FluidModel::HerschelBulkley => vec![
                vec![0.8 * stress[0], 0.5 * power[0], power[1].max(0.4)],
                vec![0.1 * stress[0], power[0], power[1]],
            ],
            FluidModel::Papanastasiou => vec![
                vec![0.8 * stress[0], 0.5 * power[0], power[1].max(0.4), 10.0 / rate],
                vec![0.1 * stress[0], power[0], power[1], 100.0 / rate],
            ],
            FluidModel::Eyring => vec![vec![stress[1], viscosity[1] / stress[1]]],
            FluidModel::Sisko => vec![vec![0.5 * viscosity[0], power[0], power[1].min(0.9)]],
            FluidModel::Ellis => vec![vec![viscosity[1], stress[1], (1.0 / power[1]).clamp(1.2, 5.0)]],
            FluidModel::Cross => {
                let exponent = (1.0 - power[1]).clamp(0.2, 0.95);
                vec![
                    vec![1.2 * viscosity[1], 0.1 * viscosity[0], 1.0 / rate, exponent],
                    vec![2.0 * viscosity[1], 1e-3 * viscosity[0], 10.0 / rate, exponent],
                ]
            }
            FluidModel::CarreauYasuda => {
                let exponent = power[1].clamp(0.1, 0.9);
                vec![
                    vec![1.1 * viscosity[1], 0.1 * viscosity[0], 1.0 / rate, exponent, 2.0],
                    vec![2.0 * viscosity[1], 1e-3 * viscosity[0], 10.0 / rate, exponent, 1.0],
                ]
            }
            // No other has starts: it is refused for want of them.
            _ => Vec::new(),
        }
    }
}

/// Fluids to compare, and how.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Request {
    /// The fluids.
    pub fluids: Vec<FluidModel>,
    /// The scale of residuals.
    pub weighting: Weighting,
    /// The probability of the intervals.
    pub confidence: f64,
    /// How intervals are found.
    pub intervals: Intervals,
    /// The noise of the measurements. A response may fall by this much.
    pub noise: Noise,
}

impl Request {
    /// A request for some fluids, with errors in proportion to each measured response.
    #[must_use]
    pub fn of(fluids: Vec<FluidModel>) -> Self {
        let (weighting, intervals) = (Weighting::Relative, Intervals::Linear);
        Self { fluids, weighting, confidence: 0.95, intervals, noise: Noise::Estimated }
    }
}

/// Fluids fitted to the same measurements.
pub type Comparison = comparison::Comparison<FluidModel, FittedFluid, FitError>;

impl Judged for FittedFluid {
    fn aicc(&self) -> Option<f64> {
        self.criteria.aicc
    }
    fn is_converged(&self) -> bool {
        self.outcome.is_converged()
    }
    fn widening(&self) -> f64 {
        self.autocorrelation.map_or(1.0, |found| found.widening)
    }
}

/// Fits each fluid that is asked for.
///
/// # Errors
/// [`MeasuredError::Table`] with the line of a row that viscometry refuses, or at which the response falls by more than the noise;
/// [`MeasuredError::Argument`] for capillaries, whose ends are not known, and thrusts alone. The refusal of a single fluid stands in its
/// [`Candidate`](crate::comparison::Candidate).
///
/// # Example
/// ```
/// use piola_measured::rheology::{FlowKind, Measured, Request, compare};
/// let text = "shear_rate,shear_stress\n1,3\n4,6\n9,9\n100,30\n"; // 3 √k
/// let measured = Measured::parse("curve.csv", text, FlowKind::Curve, &[])?;
/// let comparison = compare(&measured, &Request::of(vec!["power-law".parse()?]))?;
/// let fit = comparison.candidates[0].fit.clone()?;
/// assert!((fit.parameters[1].value - 0.5).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn compare(measured: &Measured, request: &Request) -> Result<Comparison, MeasuredError> {
    compare_until(measured, request, &mut |_| ControlFlow::Continue(()))
}

/// The same while `watch` lets it go on; it is told the finished part of the fluids.
///
/// # Errors
/// As [`compare`].
pub fn compare_until(measured: &Measured, request: &Request, watch: Watch<'_>) -> Result<Comparison, MeasuredError> {
    let is_capillary = matches!(measured.flow, Flow::Capillary { .. });
    if is_capillary || measured.sheared().is_none() {
        let column = measured.answers.first().map_or("nothing", |answer| answer.what.column().0);
        let argument = format!("--flow {} with {column}", measured.flow.kind().name());
        let valid = "discharges of pipes or channels, speeds of cylinders, torques of plates or cones, or a flow curve";
        return Err(MeasuredError::Argument { argument, valid });
    }
    let checked = |data: FlowData| data.check_rising().map(|()| [data]);
    let data = measured.data().and_then(|data| data.with_noise(request.noise)).and_then(checked);
    let data = data.map_err(|error| match error {
        FitError::Viscometry(error) => measured.refused(error),
        error => MeasuredError::Fit(error),
    })?;
    let look = Look::at(measured);
    let Request { weighting, confidence, intervals, .. } = *request;
    let linear = Options { weighting, confidence, intervals: Intervals::Linear, ..Options::default() };
    let options = Options { intervals, ..linear.clone() };
    let task = Task { measured, data: &data, look, options: &linear };
    // First all optima with linear intervals: a fluid alone then comes as far as in the company of those that it contains.
    let mut comparison =
        Comparison::of(&with_contained(&request.fluids), watch, |fluid, stop| fitted(fluid, &task, &[], stop));
    comparison.contain(&task, watch);
    comparison.candidates.retain(|candidate| request.fluids.contains(&candidate.model));
    comparison.unranked = request.fluids.iter().copied().filter(|fluid| fluid.is_regularisation()).collect();
    if intervals != Intervals::Linear {
        comparison.refine(&Task { options: &options, ..task }, watch);
    }
    Ok(comparison)
}

impl Comparison {
    /// Fits again, from there, every fluid that came out worse than one that it contains.
    fn contain(&mut self, task: &Task<'_>, watch: Watch<'_>) {
        for (larger, smaller, embed) in CONTAINED {
            let of = |fluid| self.candidates.iter().position(|candidate| candidate.model == fluid);
            let (Some(larger), Some(smaller)) = (of(larger), of(smaller)) else { continue };
            let Ok(contained) = &self.candidates[smaller].fit else { continue };
            let squares = self.candidates[larger].fit.as_ref().map_or(f64::INFINITY, |fit| fit.squares);
            if squares <= contained.squares * (1.0 + 1e-9) {
                continue;
            }
            if self.interrupted || watch(1.0).is_break() {
                self.interrupted = true;
                return;
            }
            let again = fitted(self.candidates[larger].model, task, &[embed(&contained.values())], &|| false);
            if let Ok(again) = again
                && again.squares < squares
            {
                self.candidates[larger].fit = Ok(again);
            }
        }
    }

    /// Finds the intervals that are asked for, from the optima; those that are interrupted stay linear.
    fn refine(&mut self, task: &Task<'_>, watch: Watch<'_>) {
        let (count, watch) = (self.candidates.len() as f64, RefCell::new(watch));
        let broken = Cell::new(self.interrupted);
        for (index, candidate) in self.candidates.iter_mut().enumerate() {
            let stop = || {
                if !broken.get() {
                    broken.set((*watch.borrow_mut())(index as f64 / count).is_break());
                }
                broken.get()
            };
            if stop() {
                break;
            }
            let Ok(found) = &candidate.fit else { continue };
            if let Ok(again) = fitted(candidate.model, task, &[found.values()], &stop) {
                candidate.fit = Ok(again);
            }
        }
        self.interrupted = broken.get();
    }
}

impl FittedFluid {
    fn values(&self) -> Vec<f64> {
        self.parameters.iter().map(|parameter| parameter.value).collect()
    }
}

impl Comparison {
    /// The numbers, as they stand in `summary.json`.
    #[must_use]
    pub fn summary(&self, measured: &Measured) -> String {
        let fluids: Vec<Value> = self
            .candidates
            .iter()
            .map(|candidate| match &candidate.fit {
                Ok(fit) => json!({
                    "fluid": candidate.model.name(),
                    "is_regularisation": candidate.model.is_regularisation(),
                    "parameters": serde_json::to_value(&fit.parameters).unwrap_or_default(),
                    "rms_residual": rms(&fit.residuals),
                    "largest_residual": largest(&fit.residuals),
                    "criteria": serde_json::to_value(fit.criteria).unwrap_or_default(),
                    "autocorrelation": serde_json::to_value(fit.autocorrelation).unwrap_or_default(),
                    "converged": fit.outcome.is_converged(),
                }),
                Err(error) => json!({ "fluid": candidate.model.name(), "failure": error.to_string() }),
            })
            .collect();
        let summary = json!({
            "data": measured.path.display().to_string(),
            "flow": measured.flow.kind().name(),
            "rows": measured.rows().len(),
            "read": measured.notes,
            "best_by_aicc": self.best().map(|(fluid, _)| fluid.name()),
            "not_told_apart_from_the_best": self.rivals().map(|(fluid, _)| fluid.name()).collect::<Vec<_>>(),
            "interrupted": self.interrupted,
            "fluids": fluids,
        });
        let mut text = serde_json::to_string_pretty(&summary).unwrap_or_default();
        text.push('\n');
        text
    }

    /// A table for a reader.
    #[must_use]
    pub fn table(&self, measured: &Measured) -> String {
        let mut text = String::new();
        let _ = writeln!(text, "{}", measured.heading());
        text.push_str("least sum of squares of ln(model/measured); intervals and AICc suppose independent errors\n\n");
        let _ =
            writeln!(text, "{:<18}{:>3}{:>14}{:>12}{:>10}  search", "fluid", "k", "RMS residual", "largest", "AICc");
        for (fluid, fit) in self.fits() {
            let aicc = fit.criteria.aicc.map_or_else(|| "-".to_owned(), |x| format!("{x:.1}"));
            let (count, residual) = (fit.parameters.len(), 100.0 * rms(&fit.residuals));
            let most = 100.0 * largest(&fit.residuals);
            let _ = write!(text, "{:<18}{count:>3}{residual:>12.2} %{most:>10.2} %{aicc:>10}", fluid.name());
            let _ = writeln!(text, "  {}", fit.outcome.reason());
        }
        text.push('\n');
        text.push_str(&self.judgement());
        text.push('\n');
        for (fluid, fit) in self.fits() {
            let _ = writeln!(text, "{fluid}");
            for found in &fit.parameters {
                let line = parameter_in_words(
                    (found.name, 26),
                    found.value,
                    "",
                    (found.standard_error, found.interval, found.state),
                );
                let _ = writeln!(text, "{line}");
            }
        }
        text.push('\n');
        text
    }

    /// Lines on the best fluid: how it was chosen, and warnings.
    fn judgement(&self) -> String {
        let unranked = if self.fits().any(|(fluid, _)| fluid.is_regularisation()) {
            "papanastasiou regularises herschel-bulkley for computations: it is not ranked.\n"
        } else {
            ""
        };
        let Some((best, fit)) = self.best() else {
            let none = "No fluid has an AICc: that takes at least three rows more than parameters.\n";
            let is_any_ranked = self.fits().any(|(fluid, _)| !fluid.is_regularisation());
            return if is_any_ranked || unranked.is_empty() {
                format!("{none}{unranked}")
            } else {
                unranked.to_owned()
            };
        };
        let mut text = format!("{best} has the least AICc.\n");
        let rivals: Vec<&str> = self.rivals().map(|(fluid, _)| fluid.name()).collect();
        if !rivals.is_empty() {
            let _ = writeln!(text, "These data do not tell it from {}.", rivals.join(", "));
        }
        if let Some(found) = fit.autocorrelation.filter(|found| 1.0 < found.widening) {
            let Autocorrelation { lag_one, widening, .. } = found;
            let within = self.indifference().unwrap_or(2.0);
            let _ = writeln!(
                text,
                "Its neighbouring residuals are correlated ({lag_one:.2}): the curve misses the fluid systematically. Its intervals are\n\
                 {widening:.1} times those of independent errors, and differences of AICc below {within:.0} say nothing."
            );
        }
        text + unranked
    }

    /// Writes summary, tables and figure.
    #[must_use]
    pub fn write(&self, folder: &Folder, measured: &Measured) -> Written {
        let mut curves = String::from("fluid,shear_rate [1/s],shear_stress [Pa],viscosity [Pa s]\n");
        for (fluid, fit) in self.fits() {
            for [rate, stress] in &fit.curve {
                let _ = writeln!(curves, "{fluid},{rate:?},{stress:?},{:?}", stress / rate);
            }
        }
        let [drive, response] = measured.first_columns();
        let mut residuals = format!("{drive},{response}");
        for (fluid, _) in self.fits() {
            let _ = write!(residuals, ",residual of {fluid}");
        }
        residuals.push('\n');
        for (row, [drive, response]) in measured.rows().iter().enumerate() {
            let _ = write!(residuals, "{drive:?},{response:?}");
            for (_, fit) in self.fits() {
                let _ = write!(residuals, ",{:?}", fit.residuals.get(row).copied().unwrap_or(f64::NAN));
            }
            residuals.push('\n');
        }
        Written::of(
            folder,
            [
                ("summary.json", self.summary(measured)),
                ("curves.csv", curves),
                ("residuals.csv", residuals),
                ("fit.svg", figure::comparison(measured, self)),
            ],
        )
    }
}

/// A parameter with its interval for a reader; its name is padded, its unit stands after its value.
pub(crate) fn parameter_in_words(
    (name, width): (&str, usize),
    value: f64,
    unit: &str,
    (standard_error, interval, state): (Option<f64>, Option<[f64; 2]>, State),
) -> String {
    let mut line = format!("  {name:<width$}");
    let _ = match (state, standard_error, interval) {
        (State::AtBound, _, Some([_, high])) => write!(line, "{:>13}{unit}  at its bound, below {high:.4e}", 0),
        (State::AtBound, _, None) => write!(line, "{value:>13.5e}{unit}  at its bound"),
        (State::Held, ..) => write!(line, "{value:>13.5e}{unit}  held"),
        (State::Determined, Some(error), Some([low, high])) => {
            write!(line, "{value:>13.5e} ± {error:.1e}{unit}  [{}, {}]", end(low), end(high))
        }
        (State::NoDegreesOfFreedom, _, _) => write!(line, "{value:>13.5e}{unit}  no error: no degrees of freedom"),
        _ => write!(line, "{value:>13.5e}{unit}  not determined by these data"),
    };
    line
}

/// An end of an interval.
fn end(x: f64) -> String {
    if x.is_infinite() {
        "no end".to_owned()
    } else if x.abs() < f64::MIN_POSITIVE {
        "0".to_owned()
    } else {
        format!("{x:.4e}")
    }
}

pub(crate) fn largest(residuals: &[f64]) -> f64 {
    residuals.iter().fold(0.0, |most, r| most.max(r.abs()))
}

pub(crate) fn rms(residuals: &[f64]) -> f64 {
    (residuals.iter().map(|r| r * r).sum::<f64>() / residuals.len().max(1) as f64).sqrt()
}
