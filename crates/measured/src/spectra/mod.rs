//! Relaxation and retardation spectra from tables of moduli or compliances, of one temperature or of several.
//!
//! ```text
//! angular frequency [rad/s],G' [Pa],G'' [Pa]          small oscillations
//! time [s],G(t) [Pa]                                   relaxation after a step of strain
//! time [s],J(t) [1/Pa]                                 creep after a step of stress
//! temperature [°C],frequency [Hz],G' [kPa],G'' [kPa]   several temperatures: shifted to one curve
//! ```
//! A temperature may also stand in a comment, `# temperature: 150 °C`, one for each of several files. Shifts are horizontal, and vertical
//! where they are asked for; without these bₜ = 1:
//!
//! ```text
//! bₜ G(ω, θ) = G(ω aₜ, θ₀)      bₜ G(t, θ) = G(t/aₜ, θ₀)      J(t, θ)/bₜ = J(t/aₜ, θ₀)
//! ```

mod card;
mod columns;
mod figure;
mod isotherms;
mod output;
mod response;
mod table;

pub use card::{general_viscoelastic, prony};
pub use piola_spectra::{RelaxationMode, RelaxationSpectrum, RetardationMode, RetardationSpectrum};
pub use response::{Isotherm, Response, ResponseRow};
pub use table::SpectrumTable;

use core::ops::ControlFlow;

use piola_fluids::{Arrhenius, WilliamsLandelFerry};
use piola_spectra::{
    ContinuousSpectrum, CurveShift, IsothermalCurve, ShiftFit, SpectraError, SpectrumData, SpectrumFit,
    SpectrumOptions, fit_arrhenius, fit_continuous_until, fit_spectrum_until, fit_williams_landel_ferry,
    horizontal_shifts, shifts_along_both_axes,
};

use crate::MeasuredError;
use crate::comparison::Watch;

/// A request for the spectra of a table.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct SpectrumRequest {
    /// The number of modes, of creep that of retardation modes; without it, the one of the least `AICc`.
    pub modes: Option<usize>,
    /// Whether there is an equilibrium modulus, as of a solid; then creep does not flow.
    pub equilibrium: bool,
    /// Whether isotherms are shifted vertically, too.
    pub vertical: bool,
    /// The temperature of the spectrum, K, one that was measured; without it, the middle one.
    pub reference_temperature: Option<f64>,
}

impl SpectrumRequest {
    /// Reads a reference temperature, as `150 °C` or `423 K`.
    ///
    /// # Errors
    /// [`MeasuredError::Argument`] for a text that is not a temperature.
    pub fn at_temperature(mut self, text: &str) -> Result<Self, MeasuredError> {
        let found = table::stated_temperature(text);
        let wrong =
            || MeasuredError::Argument { argument: text.to_owned(), valid: "a temperature, as 150 °C or 423 K" };
        self.reference_temperature = Some(found.ok_or_else(wrong)?);
        Ok(self)
    }
}

/// Shifts of the isotherms, and the laws of temperature that they tell.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Superposition {
    /// θ₀, K.
    pub reference_temperature: f64,
    /// θ, K, and ln aₜ of each isotherm, the coldest first.
    pub shifts: Vec<[f64; 2]>,
    /// ln bₜ of each isotherm, if vertical shifts were asked for.
    pub vertical: Option<Vec<f64>>,
    /// 95 % intervals of ln aₜ and ln bₜ of each isotherm, if vertical shifts were asked for; none of the reference.
    pub intervals: Vec<[Option<[f64; 2]>; 2]>,
    /// The activation energy.
    pub arrhenius: Result<ShiftFit<Arrhenius, 1>, SpectraError>,
    /// The constants C₁ and C₂.
    pub williams_landel_ferry: Result<ShiftFit<WilliamsLandelFerry, 2>, SpectraError>,
}

/// A row of the shifted data with what the discrete spectrum answers.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ShiftedRow {
    /// The temperature, K, if it was told.
    pub temperature: Option<f64>,
    /// The measured row at the reference temperature: ω aₜ or t/aₜ, and the moduli times bₜ, or the compliance over bₜ.
    pub row: ResponseRow,
    /// The moduli of the spectrum there, or its compliance twice.
    pub model: [f64; 2],
}

/// The spectrum of a material.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeasuredSpectrum {
    /// What was measured.
    pub response: Response,
    /// Shifts, if there are several temperatures.
    pub superposition: Option<Superposition>,
    /// The discrete spectrum.
    pub fit: SpectrumFit,
    /// Whether the number of modes was chosen, and is the most that was tried.
    pub is_at_most: bool,
    /// The continuous spectrum, or why there is none, in words.
    pub continuous: Result<ContinuousSpectrum, String>,
    /// All rows, in the order of ω or t.
    pub rows: Vec<ShiftedRow>,
    /// Whether the caller stopped it: the best spectrum until then is here.
    pub interrupted: bool,
}

/// Finds the spectra of a table.
///
/// Several temperatures are first shifted over each other, by |G*|, by G(t) or by J(t); with vertical shifts by G′ and G″ together. The
/// discrete spectrum minimises the sum of squares of model/measured − 1. Of creep it is a retardation spectrum; its relaxation spectrum is
/// the exact conversion.
///
/// # Errors
/// [`MeasuredError::Spectra`] for data that do not overlap, too few numbers, or a search that finds nothing;
/// [`MeasuredError::Argument`] for a reference temperature that was not measured.
///
/// # Example
/// ```
/// use piola_measured::spectra::{SpectrumRequest, SpectrumTable, spectrum};
/// // One Maxwell mode, g = 2 Pa and τ = 1 s: G′ = 2 ω²/(1 + ω²), G″ = 2 ω/(1 + ω²).
/// let text = "omega [rad/s],G' [Pa],G'' [Pa]\n0.5,0.4,0.8\n1,1,1\n2,1.6,0.8\n3,1.8,0.6\n";
/// let found = spectrum(&SpectrumTable::parse("melt.csv", text)?, &SpectrumRequest::default())?;
/// let mode = found.fit.spectrum.modes()[0];
/// assert!((mode.modulus - 2.0).abs() < 1e-6 && (mode.relaxation_time - 1.0).abs() < 1e-6);
/// # Ok::<(), piola_measured::MeasuredError>(())
/// ```
pub fn spectrum(table: &SpectrumTable, request: &SpectrumRequest) -> Result<MeasuredSpectrum, MeasuredError> {
    spectrum_until(table, request, &mut |_| ControlFlow::Continue(()))
}

/// The same until `watch`, which is told the finished part of the work, breaks: the best spectrum until then is returned.
///
/// # Errors
/// As [`spectrum`].
pub fn spectrum_until(
    table: &SpectrumTable,
    request: &SpectrumRequest,
    watch: Watch<'_>,
) -> Result<MeasuredSpectrum, MeasuredError> {
    /// The share of the time that the modes take.
    const MODES: f64 = 0.6;
    let superposition = superposed(table, request)?;
    let response = table.response;
    let mut rows: Vec<(Option<f64>, ResponseRow)> = Vec::new();
    for (index, isotherm) in table.isotherms.iter().enumerate() {
        let along = superposition.as_ref().map_or(1.0, |found| found.shifts[index][1].exp());
        let across = superposition.as_ref().and_then(|found| found.vertical.as_ref()).map_or(1.0, |b| b[index].exp());
        let factor = if response == Response::Oscillation { along } else { along.recip() };
        let height = if response == Response::Creep { across.recip() } else { across };
        let shifted = isotherm
            .rows
            .iter()
            .map(|row| ResponseRow { at: factor * row.at, moduli: row.moduli.map(|modulus| height * modulus) });
        rows.extend(shifted.map(|row| (isotherm.temperature, row)));
    }
    rows.sort_by(|a, b| a.1.at.total_cmp(&b.1.at));
    let at: Vec<f64> = rows.iter().map(|(_, row)| row.at).collect();
    let [first, second] = [0, 1].map(|k| rows.iter().map(|(_, row)| row.moduli[k]).collect::<Vec<f64>>());
    let data = match response {
        Response::Oscillation => {
            SpectrumData::Oscillation { angular_frequencies: &at, storage_moduli: &first, loss_moduli: &second }
        }
        Response::Relaxation => SpectrumData::Relaxation { times: &at, moduli: &first },
        Response::Creep => SpectrumData::Creep { times: &at, compliances: &first },
    };
    let SpectrumRequest { modes, equilibrium, .. } = *request;
    let options = SpectrumOptions { modes, equilibrium, ..SpectrumOptions::default() };
    let fit = fit_spectrum_until(data, options, &mut |done| watch(MODES * done))?;
    let tried = fit.retardation.as_ref().map_or(fit.spectrum.modes().len(), |found| found.spectrum.modes().len());
    let is_at_most = modes.is_none() && tried == options.most_modes;
    let continuous = if fit.interrupted {
        Err("interrupted".to_owned())
    } else {
        let found = fit_continuous_until(data, equilibrium, &mut |done| watch(MODES + (1.0 - MODES) * done));
        found.map_err(|error| error.to_string())
    };
    let interrupted =
        fit.interrupted || continuous.as_ref().is_ok_and(|found| found.outcome == piola_fit::Outcome::Interrupted);
    let model = |at: f64| match (response, &fit.retardation) {
        (Response::Oscillation, _) => [fit.spectrum.storage_modulus(at), fit.spectrum.loss_modulus(at)],
        (Response::Creep, Some(creep)) => [creep.spectrum.compliance(at); 2],
        _ => [fit.spectrum.relaxation_modulus(at); 2],
    };
    let rows = rows.into_iter().map(|(temperature, row)| ShiftedRow { temperature, row, model: model(row.at) });
    let rows = rows.collect();
    Ok(MeasuredSpectrum { response, superposition, fit, is_at_most, continuous, rows, interrupted })
}

/// Shifts of several isotherms.
fn superposed(table: &SpectrumTable, request: &SpectrumRequest) -> Result<Option<Superposition>, MeasuredError> {
    let temperatures: Vec<f64> = table.isotherms.iter().filter_map(|isotherm| isotherm.temperature).collect();
    let wanted = request.reference_temperature;
    let reference = match wanted {
        None => temperatures.len() / 2,
        Some(wanted) => {
            let far = |index: &usize| (temperatures[*index] - wanted).abs();
            let nearest = (0..temperatures.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
            nearest.filter(|index| far(index) < 0.5).ok_or_else(|| MeasuredError::Argument {
                argument: format!("reference temperature {wanted} K"),
                valid: "a temperature that was measured",
            })?
        }
    };
    if temperatures.len() < 2 {
        return Ok(None);
    }
    // Moduli over a frequency that rises: of relaxation and creep 1/t, of creep 1/J.
    let curve = |isotherm: &Isotherm, part: Part| -> (Vec<f64>, Vec<f64>) {
        let size = |row: &ResponseRow| match (table.response, part) {
            (Response::Oscillation, Part::Both) => (row.at, row.moduli[0].hypot(row.moduli[1])),
            (Response::Oscillation, Part::Of(k)) => (row.at, row.moduli[k]),
            (Response::Relaxation, _) => (row.at.recip(), row.moduli[0]),
            (Response::Creep, _) => (row.at.recip(), row.moduli[0].recip()),
        };
        let mut points: Vec<(f64, f64)> = isotherm.rows.iter().map(size).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points.dedup_by(|a, b| a.0 <= b.0);
        points.into_iter().unzip()
    };
    let parts: &[Part] = match (request.vertical, table.response) {
        (false, _) => &[Part::Both],
        (true, Response::Oscillation) => &[Part::Of(0), Part::Of(1)],
        (true, _) => &[Part::Of(0)],
    };
    let curves: Vec<Vec<(Vec<f64>, Vec<f64>)>> =
        table.isotherms.iter().map(|isotherm| parts.iter().map(|&part| curve(isotherm, part)).collect()).collect();
    let isothermal = |(frequencies, moduli)| IsothermalCurve { angular_frequencies: frequencies, moduli };
    let isotherms: Vec<Vec<IsothermalCurve<'_>>> =
        curves.iter().map(|of| of.iter().map(|(x, y)| isothermal((x.as_slice(), y.as_slice()))).collect()).collect();
    let found: Vec<CurveShift> = if request.vertical {
        let isotherms: Vec<&[IsothermalCurve<'_>]> = isotherms.iter().map(Vec::as_slice).collect();
        shifts_along_both_axes(&isotherms, reference)?
    } else {
        let isotherms: Vec<IsothermalCurve<'_>> = isotherms.into_iter().flatten().collect();
        let along = horizontal_shifts(&isotherms, reference)?;
        let of = |ln_horizontal| CurveShift { ln_horizontal, ..CurveShift::default() };
        along.into_iter().map(of).collect()
    };
    let logarithms: Vec<f64> = found.iter().map(|shift| shift.ln_horizontal).collect();
    let reference_temperature = temperatures[reference];
    let shifts = temperatures.iter().zip(&logarithms).map(|(&temperature, &shift)| [temperature, shift]).collect();
    Ok(Some(Superposition {
        reference_temperature,
        shifts,
        vertical: request.vertical.then(|| found.iter().map(|shift| shift.ln_vertical).collect()),
        intervals: found.iter().map(|shift| [shift.horizontal_interval, shift.vertical_interval]).collect(),
        arrhenius: fit_arrhenius(&temperatures, &logarithms, reference_temperature),
        williams_landel_ferry: fit_williams_landel_ferry(&temperatures, &logarithms, reference_temperature),
    }))
}

/// What of a row is shifted.
#[derive(Clone, Copy)]
enum Part {
    /// |G*|, or the only number.
    Both,
    /// G′ or G″.
    Of(usize),
}
