//! The figure of a spectrum.

use piola_charts::{LogPanel, Panel, figure};

use super::{MeasuredSpectrum, Response, SpectrumTable};

/// Moduli with the fitted ones, the spectra, and the shifts if there are any.
pub(super) fn drawn(table: &SpectrumTable, found: &MeasuredSpectrum) -> String {
    let is_oscillation = found.response == Response::Oscillation;
    let parts = if is_oscillation { 2 } else { 1 };
    let (mut marks, mut curves) = (Vec::new(), Vec::new());
    for k in 0..parts {
        marks.extend(found.rows.iter().map(|row| (row.row.at, row.row.moduli[k])));
        curves.push(found.rows.iter().map(|row| (row.row.at, row.model[k])).collect());
    }
    let reduced = found.superposition.is_some();
    let axis = match (is_oscillation, reduced) {
        (true, false) => "angular frequency (rad/s)",
        (true, true) => "angular frequency · aₜ (rad/s)",
        (false, false) => "time (s)",
        (false, true) => "time/aₜ (s)",
    };
    let ordinate = match found.response {
        Response::Oscillation => "G′ and G″ (Pa)",
        Response::Relaxation => "G (Pa)",
        Response::Creep => "J (1/Pa)",
    };
    let moduli = LogPanel { title: "measured and fitted", axes: [axis, ordinate], marks, curves, band: Vec::new() };
    let modes: Vec<(f64, f64)> = match &found.fit.retardation {
        Some(creep) => creep.spectrum.modes().iter().map(|mode| (mode.retardation_time, mode.compliance)).collect(),
        None => found.fit.spectrum.modes().iter().map(|mode| (mode.relaxation_time, mode.modulus)).collect(),
    };
    let (mut curves, mut band) = (Vec::new(), Vec::new());
    if let Ok(continuous) = &found.continuous {
        let times = continuous.times.iter();
        curves.push(times.clone().copied().zip(continuous.spectrum.iter().copied()).collect());
        band = times.copied().zip(continuous.band.iter().copied()).collect();
    }
    let (title, axes) = if found.response == Response::Creep {
        ("modes (marks) and L(λ) with its band", ["retardation time (s)", "J, L (1/Pa)"])
    } else {
        ("modes (marks) and H(τ) with its band", ["relaxation time (s)", "g, H (Pa)"])
    };
    let spectra = LogPanel { title, axes, marks: modes, curves, band };
    let shifts = found.superposition.as_ref().map(|superposition| Panel {
        name: "shifts".to_owned(),
        axes: ["temperature (°C)".to_owned(), "ln aₜ".to_owned()],
        points: superposition.shifts.iter().map(|[t, shift]| (t - 273.15, *shift)).collect(),
        curves: Vec::new(),
        is_curve: true,
    });
    let count = if shifts.is_some() { 3 } else { 2 };
    let kind = if found.response == Response::Creep { "retardation" } else { "relaxation" };
    let title = format!("{}: {kind} spectrum", table.name());
    figure((380 * count, 420), &title, &|area| {
        let parts = area.split_evenly((1, count as usize));
        moduli.draw(&parts[0])?;
        spectra.draw(&parts[1])?;
        shifts.as_ref().map_or(Ok(()), |shifts| shifts.draw(&parts[2]))
    })
}
