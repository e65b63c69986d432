//! Summary, table and files of a spectrum.

use core::fmt::Write as _;

use piola_charts::{Folder, Written};
use serde_json::{Value, json};

use super::{MeasuredSpectrum, Response, SpectrumTable, Superposition, figure};

/// K at 0 °C.
const ICE: f64 = 273.15;

impl MeasuredSpectrum {
    /// Whether the search of the discrete spectrum converged.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        self.fit.outcome.is_converged()
    }

    /// The numbers, as they stand in `summary.json`.
    #[must_use]
    pub fn summary(&self, table: &SpectrumTable) -> String {
        let fit = &self.fit;
        let modes = fit.spectrum.modes().iter().zip(fit.modulus_intervals.iter().zip(&fit.relaxation_time_intervals));
        let modes: Vec<Value> = modes
            .map(|(mode, (modulus, time))| {
                json!({
                    "modulus": mode.modulus,
                    "modulus_interval": modulus,
                    "relaxation_time": mode.relaxation_time,
                    "relaxation_time_interval": time,
                })
            })
            .collect();
        let tried = |count: &piola_spectra::ModeCount| json!({ "modes": count.modes, "relative_error": count.relative_error, "aicc": count.criteria.aicc });
        let tried: Vec<Value> = fit.tried.iter().map(tried).collect();
        let continuous = match &self.continuous {
            Ok(found) => json!({
                "regularisation": found.regularisation,
                "effective_parameters": found.effective_parameters,
                "relative_error": found.relative_error,
                "converged": found.outcome.is_converged(),
            }),
            Err(why) => json!({ "none": why }),
        };
        let summary = json!({
            "data": table.path.display().to_string(),
            "response": if self.response == Response::Oscillation { "oscillation" } else { "relaxation" },
            "rows": self.rows.len(),
            "read": table.notes,
            "superposition": self.superposition.as_ref().map(shifts),
            "modes": modes,
            "equilibrium_modulus": fit.spectrum.equilibrium_modulus(),
            "equilibrium_interval": fit.equilibrium_interval,
            "glassy_modulus": fit.spectrum.glassy_modulus(),
            "zero_shear_viscosity": fit.spectrum.zero_shear_viscosity(),
            "steady_state_compliance": fit.spectrum.steady_state_compliance(),
            "relative_error": fit.relative_error,
            "converged": fit.outcome.is_converged(),
            "tried": tried,
            "most_modes_reached": self.is_at_most,
            "continuous": continuous,
        });
        let mut text = serde_json::to_string_pretty(&summary).unwrap_or_default();
        text.push('\n');
        text
    }

    /// A table for a reader.
    #[must_use]
    pub fn table(&self, table: &SpectrumTable) -> String {
        let fit = &self.fit;
        let what = if self.response == Response::Oscillation { "G′ and G″" } else { "G(t)" };
        let mut text = format!("{}: {} rows of {what}", table.name(), self.rows.len());
        let isotherms = table.isotherms.len();
        let _ =
            writeln!(text, "{}", if 1 < isotherms { format!(" at {isotherms} temperatures") } else { String::new() });
        for note in &table.notes {
            let _ = writeln!(text, "{note}.");
        }
        text.push_str("least sum of squares of model/measured − 1\n\n");
        if let Some(superposition) = &self.superposition {
            text.push_str(&told(superposition));
        }
        let _ = writeln!(text, "{:>14}{:>14}   95 % intervals", "g, Pa", "τ, s");
        let intervals = fit.modulus_intervals.iter().zip(&fit.relaxation_time_intervals);
        for (mode, (modulus, time)) in fit.spectrum.modes().iter().zip(intervals) {
            let (modulus, time) = (interval(*modulus), interval(*time));
            let _ = writeln!(text, "{:>14.6e}{:>14.6e}   {modulus}  {time}", mode.modulus, mode.relaxation_time);
        }
        if let Some(found) = fit.equilibrium_interval {
            let modulus = fit.spectrum.equilibrium_modulus();
            let _ = writeln!(text, "{modulus:>14.6e}{:>14}   {}", "∞", interval(Some(found)));
        }
        let count = fit.spectrum.modes().len();
        let _ = writeln!(
            text,
            "\n{count} mode{}, RMS of model/measured − 1: {:.2} %, search: {}",
            if count == 1 { "" } else { "s" },
            100.0 * fit.relative_error,
            fit.outcome.reason()
        );
        if self.is_at_most {
            text.push_str("These are the most modes that were tried; --modes asks for more.\n");
        }
        if let (Some(viscosity), Some(compliance)) =
            (fit.spectrum.zero_shear_viscosity(), fit.spectrum.steady_state_compliance())
        {
            let _ =
                writeln!(text, "viscosity at rest η₀ = {viscosity:.4e} Pa s, compliance Jₑ⁰ = {compliance:.4e} 1/Pa");
        }
        match &self.continuous {
            Ok(found) => {
                let _ = writeln!(
                    text,
                    "continuous spectrum: {:.1} parameters told by the data, RMS {:.2} %, search: {}",
                    found.effective_parameters,
                    100.0 * found.relative_error,
                    found.outcome.reason()
                );
            }
            Err(why) => {
                let _ = writeln!(text, "no continuous spectrum: {why}");
            }
        }
        text.push('\n');
        text
    }

    /// Writes summary, tables, figure and the cards that are given with their names.
    #[must_use]
    pub fn write(&self, folder: &Folder, table: &SpectrumTable, cards: &[(String, String)]) -> Written {
        let mut files = vec![
            ("summary.json", self.summary(table)),
            ("modes.csv", self.modes()),
            ("response.csv", self.responses()),
            ("spectrum.svg", figure::drawn(table, self)),
        ];
        if let Ok(found) = &self.continuous {
            let rows = found.relaxation_times.iter().zip(&found.spectrum).zip(&found.band);
            let lines = rows.map(|((time, height), [low, high])| format!("{time:?},{height:?},{low:?},{high:?}\n"));
            files.push((
                "continuous.csv",
                lines.fold("relaxation_time [s],H [Pa],low,high\n".to_owned(), |t, l| t + &l),
            ));
        }
        if let Some(superposition) = &self.superposition {
            let lines = superposition.shifts.iter().map(|[t, shift]| format!("{t:?},{shift:?}\n"));
            files.push(("shifts.csv", lines.fold("temperature [K],ln a\n".to_owned(), |text, line| text + &line)));
        }
        files.extend(cards.iter().map(|(name, text)| (name.as_str(), text.clone())));
        Written::of(folder, files)
    }

    fn modes(&self) -> String {
        let mut text = String::from("modulus [Pa],relaxation_time [s],modulus_low,modulus_high,time_low,time_high\n");
        let intervals = self.fit.modulus_intervals.iter().zip(&self.fit.relaxation_time_intervals);
        for (mode, (modulus, time)) in self.fit.spectrum.modes().iter().zip(intervals) {
            let ends = |found: &Option<[f64; 2]>| found.map_or_else(|| ",".to_owned(), |[a, b]| format!("{a:?},{b:?}"));
            let _ = writeln!(text, "{:?},{:?},{},{}", mode.modulus, mode.relaxation_time, ends(modulus), ends(time));
        }
        text
    }

    /// The shifted rows with what the spectrum answers.
    fn responses(&self) -> String {
        let mut text = String::from(match self.response {
            Response::Oscillation => "temperature [K],angular_frequency [rad/s],G' [Pa],G'' [Pa],model G',model G''\n",
            Response::Relaxation => "temperature [K],time [s],G [Pa],model G\n",
        });
        for shifted in &self.rows {
            let temperature = shifted.temperature.map_or_else(String::new, |t| format!("{t:?}"));
            let ([first, second], [model, other]) = (shifted.row.moduli, shifted.model);
            let at = shifted.row.at;
            let _ = match self.response {
                Response::Oscillation => {
                    writeln!(text, "{temperature},{at:?},{first:?},{second:?},{model:?},{other:?}")
                }
                Response::Relaxation => writeln!(text, "{temperature},{at:?},{first:?},{model:?}"),
            };
        }
        text
    }
}

fn interval(found: Option<[f64; 2]>) -> String {
    found.map_or_else(|| "not determined".to_owned(), |[low, high]| format!("[{low:.3e}, {high:.3e}]"))
}

fn shifts(found: &Superposition) -> Value {
    let rows = found.shifts.iter().map(|[t, shift]| json!({ "temperature": t, "ln_a": shift }));
    let arrhenius = match &found.arrhenius {
        Ok(fit) => json!({
            "activation_energy": fit.law.activation_energy(),
            "interval": fit.intervals[0],
            "error": fit.error,
        }),
        Err(error) => json!({ "none": error.to_string() }),
    };
    let free_volume = match &found.williams_landel_ferry {
        Ok(fit) => json!({
            "c1": fit.law.strength(),
            "c2": fit.law.width(),
            "c1_interval": fit.intervals[0],
            "c2_interval": fit.intervals[1],
            "error": fit.error,
        }),
        Err(error) => json!({ "none": error.to_string() }),
    };
    json!({
        "reference_temperature": found.reference_temperature,
        "shifts": rows.collect::<Vec<_>>(),
        "arrhenius": arrhenius,
        "williams_landel_ferry": free_volume,
    })
}

/// Shifts in words.
fn told(found: &Superposition) -> String {
    let mut text = format!("shifted to {:.1} °C\n", found.reference_temperature - ICE);
    for [temperature, shift] in &found.shifts {
        let _ = writeln!(text, "{:>10.1} °C   ln aₜ = {shift:.4}", temperature - ICE);
    }
    match &found.arrhenius {
        Ok(fit) => {
            let energy = 1e-3 * fit.law.activation_energy();
            let within = fit.intervals[0].map(|ends| ends.map(|x| 1e-3 * x));
            let _ = writeln!(
                text,
                "Arrhenius: E = {energy:.2} kJ/mol {}, RMS of ln aₜ {:.3}",
                within.map_or_else(|| "without interval".to_owned(), |[low, high]| format!("[{low:.2}, {high:.2}]")),
                fit.error
            );
        }
        Err(error) => {
            let _ = writeln!(text, "Arrhenius: {error}");
        }
    }
    match &found.williams_landel_ferry {
        Ok(fit) => {
            let (strength, width) = (fit.law.strength(), fit.law.width());
            let within = |k: usize| {
                fit.intervals[k]
                    .map_or_else(|| "without interval".to_owned(), |[low, high]| format!("[{low:.2}, {high:.2}]"))
            };
            let _ = writeln!(
                text,
                "Williams, Landel and Ferry: C₁ = {strength:.3} {}, C₂ = {width:.2} K {}, RMS of ln aₜ {:.3}",
                within(0),
                within(1),
                fit.error
            );
        }
        Err(error) => {
            let _ = writeln!(text, "Williams, Landel and Ferry: {error}");
        }
    }
    text.push('\n');
    text
}
