//! Relaxation spectra from tables of moduli, of one temperature or of several.
//!
//! ```text
//! angular frequency [rad/s],G' [Pa],G'' [Pa]          small oscillations
//! time [s],G(t) [Pa]                                   relaxation after a step of strain
//! temperature [°C],frequency [Hz],G' [kPa],G'' [kPa]   several temperatures: shifted to one curve
//! ```
//! A temperature may also stand in a comment, `# temperature: 150 °C`, one for each of several files. Shifts are horizontal:
//!
//! ```text
//! G(ω, θ) = G(ω aₜ, θ₀)      G(t, θ) = G(t/aₜ, θ₀)
//! ```

mod card;
mod figure;
mod output;
mod table;

pub use card::prony;
pub use piola_spectra::{RelaxationMode, RelaxationSpectrum};
pub use table::{Isotherm, Response, ResponseRow, SpectrumTable};

use piola_fluids::{Arrhenius, WilliamsLandelFerry};
use piola_spectra::{
    ContinuousSpectrum, IsothermalCurve, ShiftFit, SpectraError, SpectrumData, SpectrumFit, SpectrumOptions,
    fit_arrhenius, fit_continuous, fit_spectrum, fit_williams_landel_ferry, horizontal_shifts,
};

use crate::MeasuredError;

/// A request for the spectra of a table.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct SpectrumRequest {
    /// The number of modes; without it, the one of the least `AICc`.
    pub modes: Option<usize>,
    /// Whether there is an equilibrium modulus, as of a solid.
    pub equilibrium: bool,
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
    /// The measured row at the reference temperature: ω aₜ or t/aₜ, and the moduli.
    pub row: ResponseRow,
    /// The moduli of the spectrum there.
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
}

/// Finds the spectra of a table.
///
/// Several temperatures are first shifted over each other, by |G*| or by G(t). The discrete spectrum minimises the sum of squares of
/// model/measured − 1.
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
    let superposition = superposed(table, request)?;
    let response = table.response;
    let mut rows: Vec<(Option<f64>, ResponseRow)> = Vec::new();
    for (index, isotherm) in table.isotherms.iter().enumerate() {
        let shift = superposition.as_ref().map_or(1.0, |found| found.shifts[index][1].exp());
        let factor = if response == Response::Oscillation { shift } else { shift.recip() };
        let shifted = isotherm.rows.iter().map(|row| ResponseRow { at: factor * row.at, ..*row });
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
    };
    let SpectrumRequest { modes, equilibrium, .. } = *request;
    let options = SpectrumOptions { modes, equilibrium, ..SpectrumOptions::default() };
    let fit = fit_spectrum(data, options)?;
    let is_at_most = modes.is_none() && fit.spectrum.modes().len() == options.most_modes;
    let continuous = if equilibrium {
        Err("it is that of a liquid".to_owned())
    } else {
        fit_continuous(data).map_err(|error| error.to_string())
    };
    let model = |at: f64| match response {
        Response::Oscillation => [fit.spectrum.storage_modulus(at), fit.spectrum.loss_modulus(at)],
        Response::Relaxation => [fit.spectrum.relaxation_modulus(at); 2],
    };
    let rows = rows.into_iter().map(|(temperature, row)| ShiftedRow { temperature, row, model: model(row.at) });
    let rows = rows.collect();
    Ok(MeasuredSpectrum { response, superposition, fit, is_at_most, continuous, rows })
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
    // Moduli over a frequency that rises: of relaxation 1/t.
    let curve = |isotherm: &Isotherm| -> (Vec<f64>, Vec<f64>) {
        let size = |row: &ResponseRow| match table.response {
            Response::Oscillation => (row.at, row.moduli[0].hypot(row.moduli[1])),
            Response::Relaxation => (row.at.recip(), row.moduli[0]),
        };
        let mut points: Vec<(f64, f64)> = isotherm.rows.iter().map(size).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points.dedup_by(|a, b| a.0 <= b.0);
        points.into_iter().unzip()
    };
    let curves: Vec<(Vec<f64>, Vec<f64>)> = table.isotherms.iter().map(curve).collect();
    let isotherms: Vec<IsothermalCurve<'_>> = curves
        .iter()
        .map(|(frequencies, moduli)| IsothermalCurve { angular_frequencies: frequencies, moduli })
        .collect();
    let logarithms = horizontal_shifts(&isotherms, reference)?;
    let reference_temperature = temperatures[reference];
    let shifts = temperatures.iter().zip(&logarithms).map(|(&temperature, &shift)| [temperature, shift]).collect();
    Ok(Some(Superposition {
        reference_temperature,
        shifts,
        arrhenius: fit_arrhenius(&temperatures, &logarithms, reference_temperature),
        williams_landel_ferry: fit_williams_landel_ferry(&temperatures, &logarithms, reference_temperature),
    }))
}
