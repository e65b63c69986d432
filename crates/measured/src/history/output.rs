//! Summary, table and files of fitted laws with history.

use core::fmt::Write as _;

use piola_charts::{Folder, Panel, RGBColor, Written, colour, figure, legend};
use piola_fit::history::{AnyHistoryModel, HistoryFit};
use piola_fit::sides::Loading;
use piola_fit::{FitError, State};
use serde_json::{Value, json};

use super::{HistoryComparison, HistoryMeasurements};
use crate::rheology::parameter_in_words;

/// The unit of a parameter in the results, with that of the stresses.
fn unit(name: &str, is_stress: bool, stress: Option<&str>) -> String {
    match (name, stress) {
        ("viscosity", Some(stress)) => format!(" {stress} s"),
        ("rate", _) => " 1/s".to_owned(),
        (_, Some(stress)) if is_stress => format!(" {stress}"),
        _ => String::new(),
    }
}

impl HistoryComparison {
    /// The numbers, as they stand in `summary.json`.
    #[must_use]
    pub fn summary(&self, measurements: &HistoryMeasurements) -> String {
        let law = |law: &AnyHistoryModel, fit: &Result<HistoryFit, FitError>| match fit {
            Ok(fit) => {
                let mut value = serde_json::to_value(fit).unwrap_or_default();
                value["converged"] = json!(fit.outcome.is_converged());
                value
            }
            Err(error) => json!({ "model": law.to_string(), "failure": error.to_string() }),
        };
        let laws = self.candidates.iter().map(|candidate| law(&candidate.model, &candidate.fit));
        let summary = json!({
            "data": measurements.path.display().to_string(),
            "stress_unit": measurements.unit,
            "read": measurements.notes,
            "best_by_aicc": self.best().map(|(law, _)| law.to_string()),
            "interrupted": self.interrupted,
            "laws": laws.collect::<Vec<Value>>(),
        });
        let mut text = serde_json::to_string_pretty(&summary).unwrap_or_default();
        text.push('\n');
        text
    }

    /// A table for a reader.
    #[must_use]
    pub fn table(&self, measurements: &HistoryMeasurements) -> String {
        /// Of `overstress_first_lame_parameter`.
        const WIDTH: usize = 31;
        let rows: usize = measurements.tests.iter().map(|test| test.rows().len()).sum();
        let tests = measurements.tests.len();
        let plural = if tests == 1 { "" } else { "s" };
        let mut text = format!("{}: {rows} rows in {tests} test{plural}\n", measurements.name());
        for note in &measurements.notes {
            let _ = writeln!(text, "{note}.");
        }
        text.push_str("least sum of squares of the stress residuals over the largest stress of their test\n");
        for (law, fit) in self.fits() {
            let aicc = fit.criteria.aicc.map_or_else(|| "none".to_owned(), |aicc| format!("{aicc:.1}"));
            let _ = writeln!(text, "\n{law}: AICc {aicc}, search: {}", fit.outcome.reason());
            for test in &fit.tests {
                let _ = writeln!(text, "  {}: RMS residual {:.2} %", test.test, 100.0 * test.relative_rms);
            }
            for found in &fit.parameters {
                let unit = unit(&found.name, found.is_stress, measurements.unit.as_deref());
                let told = (found.standard_error, found.interval, found.state);
                let line = parameter_in_words((&found.name, WIDTH), found.value, &unit, told);
                let _ = writeln!(text, "{line}");
            }
            let held = fit.parameters.iter().filter(|found| found.state == State::Held);
            let held: Vec<&str> = held.map(|found| found.name.as_str()).collect();
            if !held.is_empty() {
                let _ = writeln!(
                    text,
                    "  held: {}; --bound {law}.PARAMETER=LEAST..GREATEST frees a parameter",
                    held.join(", ")
                );
            }
            if let Some(found) = fit.autocorrelation.filter(|found| 1.0 < found.widening) {
                let _ = writeln!(
                    text,
                    "  neighbouring residuals are correlated ({:.2}): intervals are {:.1} times those of independent errors",
                    found.lag_one, found.widening
                );
            }
        }
        text.push('\n');
        text
    }

    /// Writes `summary.json`, the stresses of all laws in `predictions.csv`, and `fit.svg`.
    #[must_use]
    pub fn write(&self, folder: &Folder, measurements: &HistoryMeasurements) -> Written {
        let files = [
            ("summary.json", self.summary(measurements)),
            ("predictions.csv", self.predictions(measurements)),
            ("fit.svg", self.drawn(measurements)),
        ];
        Written::of(folder, files)
    }

    /// The stresses of all laws beside the measured ones; names of tests and units are quoted where they must be.
    fn predictions(&self, measurements: &HistoryMeasurements) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let stress =
            measurements.unit.as_deref().map_or_else(|| "stress".to_owned(), |unit| format!("stress [{unit}]"));
        let heads = ["test", "time [s]", "stretch", &stress].map(str::to_owned);
        // A vector takes every record.
        let _ = writer.write_record(heads.into_iter().chain(self.fits().map(|(law, _)| law.to_string())));
        for (index, test) in measurements.tests.iter().enumerate() {
            for (row, [t, stretch, stress]) in test.rows().iter().enumerate() {
                let measured = [t, stretch, stress].map(|x| format!("{x:?}"));
                let found = self.fits().map(|(_, fit)| format!("{:?}", stress + fit.tests[index].stresses[row]));
                let _ = writer.write_record([test.name().to_owned()].into_iter().chain(measured).chain(found));
            }
        }
        String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
    }

    /// Stresses over stretches and over times, measured and fitted; a row of panels for each test.
    fn drawn(&self, measurements: &HistoryMeasurements) -> String {
        const LEGEND: u32 = 190;
        let unit = measurements.unit.as_ref().map_or_else(String::new, |unit| format!(" ({unit})"));
        let mut panels = Vec::new();
        for (index, test) in measurements.tests.iter().enumerate() {
            let along = if test.loading() == Loading::SimpleShear { "amount of shear" } else { "stretch" };
            for (place, abscissa) in [(1, along), (0, "time (s)")] {
                let points = test.rows().iter().map(|row| (row[place], row[2])).collect();
                let curve = |fit: &HistoryFit| {
                    let residuals = &fit.tests[index].stresses;
                    test.rows().iter().zip(residuals).map(|(row, residual)| (row[place], row[2] + residual)).collect()
                };
                let curves = self.fits().map(|(_, fit)| curve(fit)).collect();
                let axes = [abscissa.to_owned(), format!("stress{unit}")];
                panels.push(Panel { name: test.name().to_owned(), axes, points, curves, is_curve: true });
            }
        }
        let tests = measurements.tests.len().max(1);
        let height = u32::try_from(330 * tests + 56).unwrap_or(u32::MAX);
        let names: Vec<String> = self.fits().map(|(law, _)| law.to_string()).collect();
        figure((2 * 330 + LEGEND, height), &format!("{}: measured and fitted", measurements.name()), &|area| {
            let (width, _) = area.dim_in_pixel();
            let (plots, side) = area.split_horizontally(width - LEGEND * piola_charts::FINE);
            for (panel, part) in panels.iter().zip(plots.split_evenly((tests, 2))) {
                panel.draw(&part)?;
            }
            let entries: Vec<(&str, RGBColor)> =
                names.iter().enumerate().map(|(k, name)| (name.as_str(), colour(k))).collect();
            legend(&side, &entries)
        })
    }
}
