//! Summary, table and files of a spectrum.

use core::fmt::Write as _;

use piola_charts::{Folder, Written};
use piola_spectra::RetardationFit;
use serde_json::{Value, json};

use super::{MeasuredSpectrum, Response, SpectrumTable, Superposition, figure};

/// K at 0 °C.
const ICE: f64 = 273.15;

impl MeasuredSpectrum {
    /// Whether the search of the discrete spectrum converged, and nobody stopped it.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        self.fit.outcome.is_converged() && !self.interrupted
    }

    /// The intervals of each relaxation mode.
    fn intervals(&self) -> impl Iterator<Item = [Option<[f64; 2]>; 2]> {
        let fit = &self.fit;
        let of = |list: &[Option<[f64; 2]>], k: usize| list.get(k).copied().flatten();
        (0..fit.spectrum.modes().len())
            .map(move |k| [of(&fit.modulus_intervals, k), of(&fit.relaxation_time_intervals, k)])
    }

    /// The numbers, as they stand in `summary.json`.
    #[must_use]
    pub fn summary(&self, table: &SpectrumTable) -> String {
        let fit = &self.fit;
        let modes: Vec<Value> = fit
            .spectrum
            .modes()
            .iter()
            .zip(self.intervals())
            .map(|(mode, [modulus, time])| {
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
                "equilibrium_modulus": found.equilibrium_modulus,
                "glassy_compliance": found.glassy_compliance,
                "fluidity": found.fluidity,
            }),
            Err(why) => json!({ "none": why }),
        };
        let summary = json!({
            "data": table.path.display().to_string(),
            "response": match self.response {
                Response::Oscillation => "oscillation",
                Response::Relaxation => "relaxation",
                Response::Creep => "creep",
            },
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
            "interrupted": self.interrupted,
            "retardation": fit.retardation.as_ref().map(retardation),
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
        let what = match self.response {
            Response::Oscillation => "G′ and G″",
            Response::Relaxation => "G(t)",
            Response::Creep => "J(t)",
        };
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
        if let Some(creep) = &fit.retardation {
            text.push_str(&told_of_creep(creep));
            text.push_str("relaxation, converted exactly\n");
        }
        let _ = writeln!(text, "{:>14}{:>14}   95 % intervals", "g, Pa", "τ, s");
        for (mode, [modulus, time]) in fit.spectrum.modes().iter().zip(self.intervals()) {
            let (modulus, time) = (interval(modulus), interval(time));
            let _ = writeln!(text, "{:>14.6e}{:>14.6e}   {modulus}  {time}", mode.modulus, mode.relaxation_time);
        }
        if !fit.spectrum.is_liquid() {
            let modulus = fit.spectrum.equilibrium_modulus();
            let _ = writeln!(text, "{modulus:>14.6e}{:>14}   {}", "∞", interval(fit.equilibrium_interval));
        }
        let fitted = fit.retardation.as_ref().map(|creep| creep.spectrum.modes().len());
        let count = fitted.unwrap_or(fit.spectrum.modes().len());
        let _ = writeln!(
            text,
            "\n{count} {}mode{}, RMS of model/measured − 1: {:.2} %, search: {}",
            if fitted.is_some() { "retardation " } else { "" },
            if count == 1 { "" } else { "s" },
            100.0 * fit.relative_error,
            fit.outcome.reason()
        );
        if self.interrupted {
            text.push_str("interrupted: the best until then\n");
        }
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
            let rows = found.times.iter().zip(&found.spectrum).zip(&found.band);
            let lines = rows.map(|((time, height), [low, high])| format!("{time:?},{height:?},{low:?},{high:?}\n"));
            let header = match self.response {
                Response::Creep => "retardation_time [s],L [1/Pa],low,high\n",
                _ => "relaxation_time [s],H [Pa],low,high\n",
            };
            files.push(("continuous.csv", lines.fold(header.to_owned(), |t, l| t + &l)));
        }
        if let Some(superposition) = &self.superposition {
            let vertical = superposition.vertical.as_ref();
            let lines = superposition.shifts.iter().enumerate().map(|(k, [t, shift])| {
                let across = vertical.map_or_else(String::new, |b| {
                    let [along, across] = superposition.intervals[k].map(ends);
                    format!(",{:?},{along},{across}", b[k])
                });
                format!("{t:?},{shift:?}{across}\n")
            });
            let header = match vertical {
                Some(_) => "temperature [K],ln a,ln b,ln a low,ln a high,ln b low,ln b high\n",
                None => "temperature [K],ln a\n",
            };
            files.push(("shifts.csv", lines.fold(header.to_owned(), |text, line| text + &line)));
        }
        if let Some(creep) = &self.fit.retardation {
            files.push(("retardation.csv", retardation_rows(creep)));
        }
        files.extend(cards.iter().map(|(name, text)| (name.as_str(), text.clone())));
        Written::of(folder, files)
    }

    fn modes(&self) -> String {
        let mut text = String::from("modulus [Pa],relaxation_time [s],modulus_low,modulus_high,time_low,time_high\n");
        for (mode, [modulus, time]) in self.fit.spectrum.modes().iter().zip(self.intervals()) {
            let _ = writeln!(text, "{:?},{:?},{},{}", mode.modulus, mode.relaxation_time, ends(modulus), ends(time));
        }
        text
    }

    /// The shifted rows with what the spectrum answers.
    fn responses(&self) -> String {
        let mut text = String::from(match self.response {
            Response::Oscillation => "temperature [K],angular_frequency [rad/s],G' [Pa],G'' [Pa],model G',model G''\n",
            Response::Relaxation => "temperature [K],time [s],G [Pa],model G\n",
            Response::Creep => "temperature [K],time [s],J [1/Pa],model J\n",
        });
        for shifted in &self.rows {
            let temperature = shifted.temperature.map_or_else(String::new, |t| format!("{t:?}"));
            let ([first, second], [model, other]) = (shifted.row.moduli, shifted.model);
            let at = shifted.row.at;
            let _ = match self.response {
                Response::Oscillation => {
                    writeln!(text, "{temperature},{at:?},{first:?},{second:?},{model:?},{other:?}")
                }
                Response::Relaxation | Response::Creep => writeln!(text, "{temperature},{at:?},{first:?},{model:?}"),
            };
        }
        text
    }
}

/// Both ends, as fields of a row.
fn ends(found: Option<[f64; 2]>) -> String {
    found.map_or_else(|| ",".to_owned(), |[a, b]| format!("{a:?},{b:?}"))
}

/// The fitted retardation spectrum, as rows: the glassy compliance at time 0, the flow at infinite time.
fn retardation_rows(creep: &RetardationFit) -> String {
    let mut text = String::from("part,size,retardation_time [s],low,high,time_low,time_high\n");
    let spectrum = &creep.spectrum;
    let _ = writeln!(text, "J_g [1/Pa],{:?},,{},,", spectrum.glassy_compliance(), ends(creep.glassy_interval));
    let intervals = creep.compliance_intervals.iter().zip(&creep.retardation_time_intervals);
    for (mode, (compliance, time)) in spectrum.modes().iter().zip(intervals) {
        let (size, at) = (mode.compliance, mode.retardation_time);
        let _ = writeln!(text, "J [1/Pa],{size:?},{at:?},{},{}", ends(*compliance), ends(*time));
    }
    if 0.0 < spectrum.fluidity() {
        let _ = writeln!(text, "1/η₀ [1/(Pa s)],{:?},,{},,", spectrum.fluidity(), ends(creep.fluidity_interval));
    }
    text
}

fn retardation(creep: &RetardationFit) -> Value {
    let intervals = creep.compliance_intervals.iter().zip(&creep.retardation_time_intervals);
    let mut modes = Vec::new();
    for (mode, (compliance, time)) in creep.spectrum.modes().iter().zip(intervals) {
        modes.push(json!({
            "compliance": mode.compliance,
            "compliance_interval": compliance,
            "retardation_time": mode.retardation_time,
            "retardation_time_interval": time,
        }));
    }
    json!({
        "modes": modes,
        "glassy_compliance": creep.spectrum.glassy_compliance(),
        "glassy_interval": creep.glassy_interval,
        "fluidity": creep.spectrum.fluidity(),
        "fluidity_interval": creep.fluidity_interval,
    })
}

/// The retardation spectrum in words.
fn told_of_creep(creep: &RetardationFit) -> String {
    let spectrum = &creep.spectrum;
    let mut text = format!("{:>14}{:>14}   95 % intervals\n", "J, 1/Pa", "λ, s");
    let glassy = interval(creep.glassy_interval);
    let _ = writeln!(text, "{:>14.6e}{:>14}   {glassy}", spectrum.glassy_compliance(), "J_g");
    let intervals = creep.compliance_intervals.iter().zip(&creep.retardation_time_intervals);
    for (mode, (compliance, time)) in spectrum.modes().iter().zip(intervals) {
        let (compliance, time) = (interval(*compliance), interval(*time));
        let _ = writeln!(text, "{:>14.6e}{:>14.6e}   {compliance}  {time}", mode.compliance, mode.retardation_time);
    }
    if 0.0 < spectrum.fluidity() {
        let viscosity = spectrum.fluidity().recip();
        let within = creep.fluidity_interval.map(|[low, high]| [high.recip(), low.recip()]);
        let _ = writeln!(text, "η₀ = {viscosity:.6e} Pa s   {}", interval(within));
    }
    if creep.glassy_interval.is_none() {
        text.push_str("The data do not determine J_g: nor do they the shortest relaxation mode, and G₀ of a card.\n");
    }
    text.push('\n');
    text
}

fn interval(found: Option<[f64; 2]>) -> String {
    found.map_or_else(|| "not determined".to_owned(), |[low, high]| format!("[{low:.3e}, {high:.3e}]"))
}

fn shifts(found: &Superposition) -> Value {
    let rows = found.shifts.iter().enumerate().map(|(k, [t, shift])| {
        let across = found.vertical.as_ref().map(|b| b[k]);
        let [along, above] = found.intervals[k];
        json!({ "temperature": t, "ln_a": shift, "ln_b": across, "ln_a_interval": along, "ln_b_interval": above })
    });
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
    for (k, [temperature, shift]) in found.shifts.iter().enumerate() {
        let range =
            |ends: Option<[f64; 2]>| ends.map_or_else(String::new, |[low, high]| format!(" [{low:.4}, {high:.4}]"));
        let across = found.vertical.as_ref().map_or_else(String::new, |b| {
            format!("   ln bₜ = {:.4}{}", b[k], range(found.intervals.get(k).and_then(|both| both[1])))
        });
        let along = range(found.intervals.get(k).and_then(|both| both[0]));
        let _ = writeln!(text, "{:>10.1} °C   ln aₜ = {shift:.4}{along}{across}", temperature - ICE);
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
