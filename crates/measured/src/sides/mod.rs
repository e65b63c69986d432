//! Laws of foam and of fibres from tables of tests whose sides are free, measured or held.
//!
//! ```text
//! mode,stretch,stress [MPa],lateral stretch       the lateral stretch may be left out, in a row or as a column
//! ```
//! | column | meaning |
//! |---|---|
//! | `mode` | uniaxial, transverse, equibiaxial, planar, simple shear, volumetric |
//! | `angle` | of a uniaxial specimen from axis 1, degrees: 0 is `uniaxial`, 90 is `transverse`, between them it is a strip that is free to shear |
//! | `stretch` or `strain` | along the load; of simple shear the amount, of volumetric tests det F |
//! | `stress` | first Piola–Kirchhoff stress; of volumetric tests the pressure |
//! | `lateral stretch` or `lateral strain` | of the side: λ₂ of uniaxial, λ₁ of transverse, λ₃ of equibiaxial and planar tests |

mod anew;
pub(crate) mod columns;
mod table;

pub use piola_fit::Intervals;
pub use piola_fit::sides::{Loading, SidesFit, SidesModel, SidesOptions, SidesTest};
pub use table::SidesMeasurements;

use core::cell::{Cell, RefCell};
use core::fmt::Write as _;
use core::ops::ControlFlow;

use piola_charts::{Folder, Written};
use piola_fit::FitError;
use piola_fit::sides::fit_sides;
use serde_json::{Value, json};

use crate::MeasuredError;
use crate::comparison::Watch;
use crate::fitting::{MOST_OF_CALCULIX, Program, lines, short_lines};

/// Laws fitted to the same tests.
///
/// # Example
/// See [`compare_sides`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SidesComparison {
    /// Each law with its fit, or why it has none.
    pub laws: Vec<(SidesModel, Result<SidesFit, FitError>)>,
    /// Whether the caller stopped it. Laws not fitted by then are left out. A law whose intervals were being computed keeps linear ones.
    pub interrupted: bool,
}

/// Fits each law, with linear intervals.
///
/// # Example
/// ```
/// use piola_measured::sides::{SidesMeasurements, SidesOptions, compare_sides};
/// // ν = 0 and α = 2: the sides stay, P = (2 μ/α)(λ² − 1)/λ with μ = 1 MPa.
/// let text = "mode,stretch,stress [MPa],lateral stretch\nuniaxial,0.5,-1.5,1\nuniaxial,0.8,-0.45,1\n";
/// let measurements = SidesMeasurements::parse("foam.csv", text)?;
/// let found = compare_sides(&measurements, &["hyperfoam:1".parse()?], &SidesOptions::default());
/// let (_, foam) = found.fits().next().expect("a fit");
/// assert!((foam.values()[0] - 1.0).abs() < 1e-6 && (foam.values()[1] - 2.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn compare_sides(measurements: &SidesMeasurements, laws: &[SidesModel], options: &SidesOptions) -> SidesComparison {
    compare_sides_with(measurements, laws, options, Intervals::Linear)
}

/// The same with intervals of any kind. Those by profile likelihood and by the bootstrap make many fits, each from all starts.
///
/// # Example
/// ```
/// use piola_measured::sides::{Intervals, SidesMeasurements, SidesOptions, compare_sides_with};
/// let text = "mode,stretch,stress [MPa],lateral stretch\nuniaxial,0.5,-1.51,1\nuniaxial,0.8,-0.45,1\nuniaxial,0.9,-0.21,1\n";
/// let measurements = SidesMeasurements::parse("foam.csv", text)?;
/// let laws = ["hyperfoam:1".parse()?];
/// let found = compare_sides_with(&measurements, &laws, &SidesOptions::default(), Intervals::Profile);
/// let (_, foam) = found.fits().next().expect("a fit");
/// let modulus = &foam.parameters[0];
/// let [low, high] = modulus.interval.expect("determined");
/// assert!(low < modulus.value && modulus.value < high);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn compare_sides_with(
    measurements: &SidesMeasurements,
    laws: &[SidesModel],
    options: &SidesOptions,
    intervals: Intervals,
) -> SidesComparison {
    compare_sides_until(measurements, laws, options, intervals, &mut |_| ControlFlow::Continue(()))
}

/// The same until `watch`, which is told the finished part of the work, breaks: laws that were fitted until then are returned. It is asked
/// before each law and before each fit of its intervals.
///
/// # Example
/// ```
/// use core::ops::ControlFlow;
/// use piola_measured::sides::{Intervals, SidesMeasurements, SidesOptions, compare_sides_until};
/// let text = "mode,stretch,stress [MPa],lateral stretch\nuniaxial,0.5,-1.51,1\nuniaxial,0.8,-0.45,1\nuniaxial,0.9,-0.21,1\n";
/// let measurements = SidesMeasurements::parse("foam.csv", text)?;
/// let (laws, bootstrap) = (["hyperfoam:1".parse()?], "bootstrap:1000".parse()?);
/// let mut asked = 0;
/// let found = compare_sides_until(&measurements, &laws, &SidesOptions::default(), bootstrap, &mut |_| {
///     asked += 1;
///     if asked < 5 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
/// });
/// // The law is fitted; its intervals are the linear ones.
/// assert!(found.interrupted && found.fits().count() == 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn compare_sides_until(
    measurements: &SidesMeasurements,
    laws: &[SidesModel],
    options: &SidesOptions,
    intervals: Intervals,
    watch: Watch<'_>,
) -> SidesComparison {
    let (watch, done, broken) = (RefCell::new(watch), Cell::new(0.0), Cell::new(false));
    let stop = || {
        if !broken.get() {
            broken.set((*watch.borrow_mut())(done.get()).is_break());
        }
        broken.get()
    };
    let mut fitted = Vec::new();
    for (index, law) in laws.iter().enumerate() {
        let part = |done: f64| (index as f64 + done) / laws.len() as f64;
        done.set(part(0.0));
        if stop() {
            break;
        }
        let fit = fit_sides(*law, &measurements.tests, options);
        let step = |share: f64| done.set(part(share));
        let with_intervals =
            |fit| anew::with_intervals(fit, *law, &measurements.tests, options, intervals, (&step, &stop));
        fitted.push((*law, fit.and_then(with_intervals)));
    }
    SidesComparison { laws: fitted, interrupted: broken.get() }
}

impl SidesComparison {
    /// The laws that were fitted.
    pub fn fits(&self) -> impl Iterator<Item = (SidesModel, &SidesFit)> {
        self.laws.iter().filter_map(|(law, fit)| Some((*law, fit.as_ref().ok()?)))
    }

    /// Whether every law was fitted, and its search converged.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        !self.interrupted && self.laws.iter().all(|(_, fit)| fit.as_ref().is_ok_and(|fit| fit.outcome.is_converged()))
    }

    /// The law of the least `AICc`.
    #[must_use]
    pub fn best(&self) -> Option<(SidesModel, &SidesFit)> {
        let told = self.fits().filter_map(|(law, fit)| Some((law, fit, fit.criteria.aicc?)));
        told.min_by(|a, b| a.2.total_cmp(&b.2)).map(|(law, fit, _)| (law, fit))
    }

    /// Laws, residuals and parameters as text.
    #[must_use]
    pub fn table(&self, measurements: &SidesMeasurements) -> String {
        let unit = measurements.unit.as_deref().unwrap_or_default();
        let mut text = String::new();
        for note in &measurements.notes {
            let _ = writeln!(text, "{note}.");
        }
        for (law, fit) in &self.laws {
            let fit = match fit {
                Ok(fit) => fit,
                Err(error) => {
                    let _ = writeln!(text, "\n{law}: {error}");
                    continue;
                }
            };
            let aicc = fit.criteria.aicc.map_or_else(|| "none".to_owned(), |aicc| format!("{aicc:.1}"));
            let _ = writeln!(text, "\n{law}: AICc {aicc}, search: {}", fit.outcome.reason());
            for test in &fit.tests {
                let side = test.lateral_rms.map_or_else(String::new, |rms| {
                    format!(", of the lateral stretches {:.2} % of their largest change", 100.0 * rms)
                });
                let _ = writeln!(
                    text,
                    "  {}: RMS residual {:.2} % of the largest stress{side}",
                    test.test,
                    100.0 * test.relative_rms
                );
            }
            for parameter in &fit.parameters {
                let unit = if parameter.is_stress { unit } else { "" };
                let interval = parameter.interval.map_or_else(
                    || format!("  {}", state(parameter.state)),
                    |[low, high]| format!("  [{low:.5}, {high:.5}]"),
                );
                let _ = writeln!(text, "  {:<12}{:>14.6} {unit}{interval}", parameter.name, parameter.value);
            }
        }
        text
    }

    /// The numbers, as they stand in `summary.json`.
    #[must_use]
    pub fn summary(&self, measurements: &SidesMeasurements) -> String {
        let law = |(law, fit): &(SidesModel, Result<SidesFit, FitError>)| match fit {
            Ok(fit) => {
                let mut value = serde_json::to_value(fit).unwrap_or_default();
                value["converged"] = json!(fit.outcome.is_converged());
                value
            }
            Err(error) => json!({ "model": law.to_string(), "failure": error.to_string() }),
        };
        let summary = json!({
            "data": measurements.path.display().to_string(),
            "stress_unit": measurements.unit,
            "read": measurements.notes,
            "interrupted": self.interrupted,
            "best_by_aicc": self.best().map(|(law, _)| law.to_string()),
            "laws": self.laws.iter().map(law).collect::<Vec<Value>>(),
        });
        let mut text = serde_json::to_string_pretty(&summary).unwrap_or_default();
        text.push('\n');
        text
    }

    /// Writes `summary.json` and the cards.
    #[must_use]
    pub fn write(&self, folder: &Folder, measurements: &SidesMeasurements, cards: &[(String, String)]) -> Written {
        let summary = ("summary.json", self.summary(measurements));
        let cards = cards.iter().map(|(name, text)| (name.as_str(), text.clone()));
        Written::of(folder, core::iter::once(summary).chain(cards))
    }
}

const fn state(state: piola_fit::State) -> &'static str {
    match state {
        piola_fit::State::AtBound => "at its bound",
        piola_fit::State::Held => "held",
        piola_fit::State::Undetermined => "not determined",
        piola_fit::State::NoDegreesOfFreedom => "no degrees of freedom",
        piola_fit::State::Determined => "",
    }
}

/// The card of a fitted foam, in the unit of the stresses.
///
/// ```text
/// Abaqus, CalculiX   *HYPERFOAM, N: μ₁, α₁, …, then ν₁, …      W = Σ 2μ/α² (λ₁ᵅ + λ₂ᵅ + λ₃ᵅ − 3 + (J^(−αβ) − 1)/β), β = ν/(1 − 2ν)
/// ```
///
/// # Errors
/// [`MeasuredError::NoCard`] for other laws and programs; [`MeasuredError::Argument`] for more than three terms in `CalculiX`.
pub fn card_of_foam(program: Program, model: SidesModel, fit: &SidesFit) -> Result<String, MeasuredError> {
    let (SidesModel::Hyperfoam(series), Program::Abaqus | Program::CalculiX) = (model, program) else {
        return Err(MeasuredError::NoCard { law: model.to_string(), program: program.to_string() });
    };
    let count = series.count();
    if program == Program::CalculiX && MOST_OF_CALCULIX < count {
        let argument = format!("a card of CalculiX for {model}");
        return Err(MeasuredError::Argument { argument, valid: "laws of at most three terms" });
    }
    let values = fit.values();
    let terms = values.chunks_exact(3);
    let numbers: Vec<f64> =
        terms.clone().flat_map(|term| [term[0], term[1]]).chain(terms.map(|term| term[2])).collect();
    let lines = if program == Program::CalculiX { short_lines(&numbers) } else { lines(&numbers) };
    Ok(format!("*MATERIAL, NAME=hyperfoam-{count}\n*HYPERFOAM, N={count}\n{lines}\n"))
}
