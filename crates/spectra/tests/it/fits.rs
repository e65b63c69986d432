//! Spectra found again from their own responses, exact and with noise.

use piola_spectra::{RelaxationSpectrum, SpectrumData, SpectrumFit, SpectrumOptions, fit_spectrum};
use piola_testkit::{Tol, assert_each_close};

use super::spectrum;

/// 31 abscissas from 10^`low` to 10^(`low` + 6).
fn decades(low: f64) -> Vec<f64> {
    (0..31).map(|k| 10.0_f64.powf(low + 0.2 * f64::from(k))).collect()
}

/// The response with relative errors of ± `noise` that follow no order.
fn oscillation(of: &RelaxationSpectrum, noise: f64) -> [Vec<f64>; 3] {
    let frequencies = decades(-3.0);
    let mut k = 0.0_f64;
    let mut disturbed = |value: f64| {
        k += 1.0;
        // Fractional parts of multiples of the golden ratio.
        value * (1.0 + noise * (2.0 * (k * k * 0.618_033_988_749_895).fract() - 1.0))
    };
    let storage = frequencies.iter().map(|&w| disturbed(of.storage_modulus(w))).collect();
    let loss = frequencies.iter().map(|&w| disturbed(of.loss_modulus(w))).collect();
    [frequencies, storage, loss]
}

fn fitted(of: &RelaxationSpectrum, noise: f64, options: SpectrumOptions) -> SpectrumFit {
    let [frequencies, storage, loss] = oscillation(of, noise);
    let data =
        SpectrumData::Oscillation { angular_frequencies: &frequencies, storage_moduli: &storage, loss_moduli: &loss };
    fit_spectrum(data, options).expect("a spectrum")
}

fn flat(of: &RelaxationSpectrum) -> Vec<f64> {
    of.modes().iter().flat_map(|mode| [mode.modulus, mode.relaxation_time]).collect()
}

const SEARCH: Tol = Tol::ulps_because(1e9, "the search ends where ln g and ln τ change by less than 1e-7");

#[test]
fn fit_to_exact_moduli_equals_the_spectrum() {
    let melt = spectrum(&[(1e5, 0.01), (3e4, 0.3), (1e3, 20.0)], 0.0);
    let fit = fitted(&melt, 0.0, SpectrumOptions { modes: Some(3), ..SpectrumOptions::default() });
    assert!(fit.outcome.is_converged());
    assert_each_close("modes", &flat(&fit.spectrum), &flat(&melt), SEARCH);
}

#[test]
fn fit_to_exact_moduli_of_a_solid_equals_the_spectrum() {
    let gel = spectrum(&[(1e5, 0.01), (1e4, 2.0)], 3e3);
    let fit = fitted(&gel, 0.0, SpectrumOptions { modes: Some(2), equilibrium: true, ..SpectrumOptions::default() });
    assert_each_close("modes", &flat(&fit.spectrum), &flat(&gel), SEARCH);
    assert_each_close("Gₑ", &[fit.spectrum.equilibrium_modulus()], &[3e3], SEARCH);
}

#[test]
fn fit_to_exact_relaxation_equals_the_spectrum() {
    let gel = spectrum(&[(1e5, 0.05), (1e4, 8.0)], 2e3);
    let times = decades(-3.0);
    let moduli: Vec<f64> = times.iter().map(|&t| gel.relaxation_modulus(t)).collect();
    let data = SpectrumData::Relaxation { times: &times, moduli: &moduli };
    let options = SpectrumOptions { modes: Some(2), equilibrium: true, ..SpectrumOptions::default() };
    let fit = fit_spectrum(data, options).expect("a spectrum");
    assert_each_close("modes", &flat(&fit.spectrum), &flat(&gel), SEARCH);
}

#[test]
fn number_of_modes_chosen_from_noisy_moduli_equals_that_of_the_spectrum() {
    let melt = spectrum(&[(1e5, 0.01), (3e4, 0.3), (1e3, 20.0)], 0.0);
    let fit = fitted(&melt, 0.03, SpectrumOptions::default());
    assert_eq!(fit.spectrum.modes().len(), 3, "{:?}", fit.tried);
    // The error of an even distribution in ± 3 %.
    assert!(0.01 < fit.relative_error && fit.relative_error < 0.03 / 3.0_f64.sqrt() * 1.2, "{}", fit.relative_error);
    // More modes never fit worse.
    for pair in fit.tried.windows(2) {
        assert!(pair[1].relative_error <= pair[0].relative_error * (1.0 + 1e4 * f64::EPSILON), "{pair:?}");
    }
    let intervals = fit.modulus_intervals.iter().zip(&fit.relaxation_time_intervals);
    let mut inside = 0;
    for (mode, (modulus, time)) in melt.modes().iter().zip(intervals) {
        let ([a, b], [c, d]) = (modulus.expect("determined"), time.expect("determined"));
        assert!(b < 1.1 * a && d < 1.1 * c);
        inside += usize::from(a <= mode.modulus && mode.modulus <= b);
        inside += usize::from(c <= mode.relaxation_time && mode.relaxation_time <= d);
    }
    assert!(5 <= inside, "{inside} of 6 intervals of 95 %");
}
