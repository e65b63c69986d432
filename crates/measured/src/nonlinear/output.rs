//! Summary, table and files of fitted viscoelastic fluids.

use core::fmt::Write as _;

use piola_charts::{Folder, Written};
use piola_fit::FitError;
use piola_fit::nonlinear::{NonlinearFlow, NonlinearModel};
use serde_json::{Value, json};

use super::columns::rate_of;
use super::curves::words;
use super::{FittedNonlinear, NonlinearComparison, NonlinearTable, RelaxationModes, figure};
use crate::rheology::{largest, parameter_in_words, rms};

impl NonlinearComparison {
    /// The numbers, as they stand in `summary.json`.
    #[must_use]
    pub fn summary(&self, table: &NonlinearTable) -> String {
        let fluid = |model: &NonlinearModel, found: &Result<FittedNonlinear, FitError>| -> Value {
            let found = match found {
                Ok(found) => found,
                Err(error) => return json!({ "fluid": model.name(), "failure": error.to_string() }),
            };
            let fit = &found.fit;
            let flows = table.flows.iter().zip(&fit.residuals).map(|(set, residuals)| {
                let curve = found.curve(*model, set);
                let (none, stops): (Vec<_>, Vec<_>) =
                    curve.in_words(set.flow()).into_iter().partition(|_| curve.points.is_empty());
                json!({ "flow": words(set.flow()), "rows": residuals.len(), "rms_residual": rms(residuals),
                        "largest_residual": largest(residuals), "no_curve": none.first(),
                        "curve_stops": stops.first() })
            });
            json!({
                "fluid": model.name(),
                "law": serde_json::to_value(&fit.fluid).unwrap_or_default(),
                "modes": serde_json::to_value(&found.modes).unwrap_or_default(),
                "parameters": serde_json::to_value(&fit.parameters).unwrap_or_default(),
                "flows": flows.collect::<Vec<Value>>(),
                "squares": fit.squares,
                "criteria": serde_json::to_value(fit.criteria).unwrap_or_default(),
                "autocorrelation": serde_json::to_value(fit.autocorrelation).unwrap_or_default(),
                "converged": fit.outcome.is_converged(),
                "evaluations": fit.evaluations,
                "starts_that_agree": fit.starts_that_agree,
            })
        };
        let candidates = self.candidates.iter();
        let summary = json!({
            "data": table.path.display().to_string(),
            "rows": table.rows(),
            "read": table.notes,
            "minimised": "sum of squares of ln(model/measured)",
            "best_by_aicc": self.best().map(|(fluid, _)| fluid.name()),
            "not_told_apart_from_the_best": self.rivals().map(|(fluid, _)| fluid.name()).collect::<Vec<_>>(),
            "interrupted": self.interrupted,
            "fluids": candidates.map(|candidate| fluid(&candidate.model, &candidate.fit)).collect::<Vec<Value>>(),
        });
        let mut text = serde_json::to_string_pretty(&summary).unwrap_or_default();
        text.push('\n');
        text
    }

    /// A table for a reader.
    #[must_use]
    pub fn table(&self, table: &NonlinearTable) -> String {
        let mut text = format!("{}: {} rows in {} flows\n", table.name(), table.rows(), table.flows.len());
        for note in &table.notes {
            let _ = writeln!(text, "{note}.");
        }
        text.push_str("least sum of squares of ln(model/measured); intervals and AICc suppose independent errors\n\n");
        let _ =
            writeln!(text, "{:<18}{:>3}{:>14}{:>12}{:>10}  search", "fluid", "k", "RMS residual", "largest", "AICc");
        for (fluid, FittedNonlinear { fit, .. }) in self.fits() {
            let all = fit.residuals.concat();
            let aicc = fit.criteria.aicc.map_or_else(|| "-".to_owned(), |x| format!("{x:.1}"));
            let (count, residual, most) = (fit.parameters.len(), 100.0 * rms(&all), 100.0 * largest(&all));
            let _ = write!(text, "{:<18}{count:>3}{residual:>12.2} %{most:>10.2} %{aicc:>10}", fluid.name());
            let _ = writeln!(text, "  {}", fit.outcome.reason());
        }
        text.push('\n');
        match self.best() {
            None => text.push_str("No fluid has an AICc: that takes at least three rows more than parameters.\n"),
            Some((best, found)) => {
                let _ = writeln!(text, "{best} has the least AICc. Its residuals:");
                for (set, residuals) in table.flows.iter().zip(&found.fit.residuals) {
                    let _ = writeln!(text, "  {:<44}{:>9.2} %", words(set.flow()), 100.0 * rms(residuals));
                }
                let rivals: Vec<&str> = self.rivals().map(|(fluid, _)| fluid.name()).collect();
                if !rivals.is_empty() {
                    let _ = writeln!(text, "These data do not tell it from {}.", rivals.join(", "));
                }
                if let Some(found) = found.fit.autocorrelation.filter(|found| 1.0 < found.widening) {
                    let _ = writeln!(
                        text,
                        "Its neighbouring residuals are correlated ({:.2}): its intervals are {:.1} times those of independent errors.",
                        found.lag_one, found.widening
                    );
                }
            }
        }
        text.push('\n');
        for (fluid, found) in self.fits() {
            let FittedNonlinear { fit, modes } = found;
            let _ = writeln!(text, "{fluid}");
            if let RelaxationModes::Given(spectrum) = modes {
                let _ = writeln!(text, "  {} relaxation modes are given", spectrum.len());
            }
            for found in &fit.parameters {
                let told = (found.standard_error, found.interval, found.state);
                let line = parameter_in_words((&found.name, 26), found.value, "", told);
                let _ = writeln!(text, "{line}");
            }
            for set in &table.flows {
                if let Some(why) = found.curve(fluid, set).in_words(set.flow()) {
                    let _ = writeln!(text, "  {why}");
                }
            }
        }
        text.push('\n');
        text
    }

    /// Writes `summary.json`, `residuals.csv`, the curves of all fluids in `predictions.csv`, and `fit.svg`.
    #[must_use]
    pub fn write(&self, folder: &Folder, table: &NonlinearTable) -> Written {
        let drives = |flow: NonlinearFlow, drive: f64| match rate_of(flow) {
            Some(rate) => format!("\"{}\",{rate:?},{drive:?}", words(flow)),
            None => format!("\"{}\",{drive:?},", words(flow)),
        };
        let mut predictions = String::from("fluid,flow,rate [1/s],time [s],stress [Pa]\n");
        for (fluid, found) in self.fits() {
            for set in &table.flows {
                for [drive, answer] in found.curve(fluid, set).points {
                    let _ = writeln!(predictions, "{fluid},{},{answer:?}", drives(set.flow(), drive));
                }
            }
        }
        let mut residuals = String::from("flow,rate [1/s],time [s],stress [Pa]");
        for (fluid, _) in self.fits() {
            let _ = write!(residuals, ",residual of {fluid}");
        }
        residuals.push('\n');
        for (index, set) in table.flows.iter().enumerate() {
            for (row, [drive, response]) in set.rows().iter().enumerate() {
                let _ = write!(residuals, "{},{response:?}", drives(set.flow(), *drive));
                for (_, found) in self.fits() {
                    let _ = write!(residuals, ",{:?}", found.fit.residuals[index][row]);
                }
                residuals.push('\n');
            }
        }
        Written::of(
            folder,
            [
                ("summary.json", self.summary(table)),
                ("predictions.csv", predictions),
                ("residuals.csv", residuals),
                ("fit.svg", figure::drawn(table, self)),
            ],
        )
    }
}
