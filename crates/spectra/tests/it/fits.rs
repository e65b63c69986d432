//! Spectra found again from their own responses, exact and with noise.

use core::ops::ControlFlow;

use piola_fit::Outcome;
use piola_spectra::{
    RelaxationSpectrum, RetardationSpectrum, SpectrumData, SpectrumFit, SpectrumOptions, fit_continuous,
    fit_continuous_until, fit_spectrum, fit_spectrum_until,
};
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

/// Creep of a spectrum at times.
fn creep(of: &RelaxationSpectrum, times: &[f64], noise: f64) -> Vec<f64> {
    let creep = RetardationSpectrum::of(of);
    let disturbed = |(k, &t): (u8, &f64)| {
        let k = f64::from(k);
        creep.compliance(t) * (1.0 + noise * (2.0 * (k * k * 0.618_033_988_749_895).fract() - 1.0))
    };
    (1_u8..).zip(times).map(disturbed).collect()
}

#[test]
fn fit_to_exact_creep_equals_the_spectrum_of_a_liquid_and_of_a_solid() {
    for equilibrium in [0.0, 3e3] {
        let material = spectrum(&[(1e5, 0.01), (3e4, 0.3), (1e4, 20.0)], equilibrium);
        let expected = RetardationSpectrum::of(&material);
        let times = decades(-3.0);
        let compliances = creep(&material, &times, 0.0);
        let data = SpectrumData::Creep { times: &times, compliances: &compliances };
        let modes = Some(expected.modes().len());
        let options = SpectrumOptions { modes, equilibrium: 0.0 < equilibrium, ..SpectrumOptions::default() };
        let fit = fit_spectrum(data, options).expect("a spectrum");
        assert!(fit.outcome.is_converged());
        let found = fit.retardation.expect("creep");
        let all = |of: &RetardationSpectrum| -> Vec<f64> {
            let modes = of.modes().iter().flat_map(|mode| [mode.compliance, mode.retardation_time]);
            modes.chain([of.glassy_compliance(), of.fluidity()]).collect()
        };
        assert_each_close("J, λ, J_g, 1/η₀", &all(&found.spectrum), &all(&expected), SEARCH);
        assert_each_close("g, τ", &flat(&fit.spectrum), &flat(&material), SEARCH);
        assert_each_close("Gₑ", &[fit.spectrum.equilibrium_modulus()], &[equilibrium], SEARCH);
        assert!(found.glassy_interval.is_some() && found.fluidity_interval.is_some() == (equilibrium <= 0.0));
    }
}

#[test]
fn creep_of_a_fluid_of_maxwell_needs_no_retardation_mode() {
    let fluid = spectrum(&[(2.0, 3.0)], 0.0);
    let times = decades(-2.0);
    let compliances = creep(&fluid, &times, 0.02);
    let data = SpectrumData::Creep { times: &times, compliances: &compliances };
    let fit = fit_spectrum(data, SpectrumOptions::default()).expect("a spectrum");
    assert_eq!(fit.retardation.expect("creep").spectrum.modes().len(), 0, "{:?}", fit.tried);
    let mode = fit.spectrum.modes()[0];
    assert_each_close("g, τ", &[mode.modulus, mode.relaxation_time], &[2.0, 3.0], Tol::stated(0.02, "2 % noise"));
    // A solid without a mode would not relax.
    let none = SpectrumOptions { modes: Some(0), equilibrium: true, ..SpectrumOptions::default() };
    let refused = fit_spectrum(data, none).expect_err("no mode").to_string();
    assert_eq!(refused, "`number of modes`, entry 0: 0e0 violates 0 < number of modes");
}

#[test]
fn number_of_modes_chosen_from_noisy_creep_equals_that_of_the_spectrum() {
    let melt = spectrum(&[(1e5, 0.01), (3e4, 0.3), (1e3, 20.0)], 0.0);
    let times = decades(-3.5);
    let compliances = creep(&melt, &times, 0.02);
    let data = SpectrumData::Creep { times: &times, compliances: &compliances };
    let fit = fit_spectrum(data, SpectrumOptions::default()).expect("a spectrum");
    let found = fit.retardation.expect("creep");
    assert_eq!(found.spectrum.modes().len(), 2, "{:?}", fit.tried);
    let viscosity = melt.zero_shear_viscosity().expect("a liquid");
    let [low, high] = found.fluidity_interval.expect("determined");
    assert!(low < viscosity.recip() && viscosity.recip() < high, "{low} {high}");
    // The continuous spectrum answers as well, and flows as much.
    let smooth = fit_continuous(data, false).expect("a spectrum");
    assert!(smooth.relative_error < 0.02, "{smooth:?}");
    let fluidity = smooth.fluidity.expect("a liquid");
    assert_each_close("1/η₀", &[fluidity], &[viscosity.recip()], Tol::stated(0.05, "2 % noise, late rows"));
}

#[test]
fn continuous_spectrum_of_a_solid_has_its_equilibrium_modulus() {
    let gel = spectrum(&[(1e4, 0.05), (1e4, 0.2), (1e4, 1.0)], 2e3);
    let times = decades(-3.0);
    let moduli: Vec<f64> = times.iter().map(|&t| gel.relaxation_modulus(t)).collect();
    let found = fit_continuous(SpectrumData::Relaxation { times: &times, moduli: &moduli }, true).expect("a spectrum");
    let modulus = found.equilibrium_modulus.expect("a solid");
    assert_each_close("Gₑ", &[modulus], &[2e3], Tol::stated(0.02, "modes are three lines, the spectrum is smooth"));
}

#[test]
fn stopped_fits_return_the_best_until_then() {
    let melt = spectrum(&[(1e5, 0.01), (3e4, 0.3), (1e3, 20.0)], 0.0);
    let [frequencies, storage, loss] = oscillation(&melt, 0.01);
    let data =
        SpectrumData::Oscillation { angular_frequencies: &frequencies, storage_moduli: &storage, loss_moduli: &loss };
    let mut calls = 0;
    let mut least = 0.0;
    let mut watch = |fraction: f64| {
        assert!((least..=1.0).contains(&fraction), "progress goes on: {least} {fraction}");
        (least, calls) = (fraction, calls + 1);
        if calls < 60 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let fit = fit_spectrum_until(data, SpectrumOptions::default(), &mut watch).expect("the first modes");
    assert!(fit.interrupted && fit.relative_error.is_finite() && fit.spectrum.modes().len() < 3);
    let mut calls = 0;
    let mut watch = |_: f64| {
        calls += 1;
        if calls < 20 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let smooth = fit_continuous_until(data, false, &mut watch).expect("the smoothest");
    assert_eq!(smooth.outcome, Outcome::Interrupted);
}

#[test]
fn intervals_hold_the_truth_as_often_as_they_say() {
    let melt = spectrum(&[(1e5, 0.01), (3e4, 0.3), (1e3, 20.0)], 0.0);
    let retardation = RetardationSpectrum::of(&melt);
    let frequencies = decades(-3.0);
    let times = decades(-3.5);
    let (mut inside, mut counted) = ([0_usize; 2], [0_usize; 2]);
    let mut count = |kind: usize, value: f64, interval: Option<[f64; 2]>| {
        let [low, high] = interval.expect("determined");
        counted[kind] += 1;
        inside[kind] += usize::from(low <= value && value <= high);
    };
    for seed in 1..=200 {
        let mut normal = super::Normal::new(seed);
        let mut disturbed = |value: f64| value * (1.0 + 0.01 * normal.next());
        let storage: Vec<f64> = frequencies.iter().map(|&w| disturbed(melt.storage_modulus(w))).collect();
        let loss: Vec<f64> = frequencies.iter().map(|&w| disturbed(melt.loss_modulus(w))).collect();
        let data = SpectrumData::Oscillation {
            angular_frequencies: &frequencies,
            storage_moduli: &storage,
            loss_moduli: &loss,
        };
        let fit = fit_spectrum(data, SpectrumOptions { modes: Some(3), ..SpectrumOptions::default() }).expect("modes");
        let intervals = fit.modulus_intervals.iter().zip(&fit.relaxation_time_intervals);
        for (mode, (modulus, time)) in melt.modes().iter().zip(intervals) {
            count(0, mode.modulus, *modulus);
            count(0, mode.relaxation_time, *time);
        }
        let compliances: Vec<f64> = times.iter().map(|&t| disturbed(retardation.compliance(t))).collect();
        let data = SpectrumData::Creep { times: &times, compliances: &compliances };
        let fit = fit_spectrum(data, SpectrumOptions { modes: Some(2), ..SpectrumOptions::default() }).expect("modes");
        let found = fit.retardation.expect("creep");
        let intervals = found.compliance_intervals.iter().zip(&found.retardation_time_intervals);
        for (mode, (compliance, time)) in retardation.modes().iter().zip(intervals) {
            count(1, mode.compliance, *compliance);
            count(1, mode.retardation_time, *time);
        }
        count(1, retardation.glassy_compliance(), found.glassy_interval);
        count(1, retardation.fluidity(), found.fluidity_interval);
    }
    for (inside, counted) in inside.into_iter().zip(counted) {
        assert_eq!(counted, 1200);
        let share = inside as f64 / counted as f64;
        assert!((0.92..=0.98).contains(&share), "{share}");
    }
}

#[test]
fn intervals_of_converted_modes_follow_from_those_of_creep() {
    // J = J_g + t/η₀: g = 1/J_g, so both have the same interval of their logarithms; τ = J_g η₀.
    let mut k = 0.0_f64;
    let mut disturbed = |value: f64| {
        k += 1.0;
        value * (1.0 + 0.02 * (2.0 * (k * k * 0.618_033_988_749_895).fract() - 1.0))
    };
    let times = decades(-3.0);
    let compliances: Vec<f64> = times.iter().map(|t| disturbed(1e-5 + t / 4e5)).collect();
    let data = SpectrumData::Creep { times: &times, compliances: &compliances };
    let fit = fit_spectrum(data, SpectrumOptions { modes: Some(0), ..SpectrumOptions::default() }).expect("a spectrum");
    let creep = fit.retardation.as_ref().expect("creep");
    let [low, high] = creep.glassy_interval.expect("determined");
    let found = fit.modulus_intervals[0].expect("determined");
    assert_each_close("g", &found, &[1.0 / high, 1.0 / low], Tol::stated(1e-7, "central differences over 1e-4"));
    let [low, high] = fit.relaxation_time_intervals[0].expect("determined");
    assert!(low < 4.0 && 4.0 < high && high / low < 1.1, "{low} {high}");
}

#[test]
fn intervals_of_converted_modes_hold_the_spectrum_as_often_as_they_say() {
    const TABLES: u64 = 60;
    let melt = spectrum(&[(1e5, 0.05), (1e4, 8.0)], 0.0);
    let creep = RetardationSpectrum::of(&melt);
    let times = decades(-3.0);
    let (mut inside, mut counted) = (0_usize, 0_usize);
    for seed in 1..=TABLES {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        // The sum of twelve uniform numbers.
        let mut disturbed = |y: f64| y * (1.0 + 0.01 * ((0..12).map(|_| uniform()).sum::<f64>() - 6.0));
        let compliances: Vec<f64> = times.iter().map(|&t| disturbed(creep.compliance(t))).collect();
        let data = SpectrumData::Creep { times: &times, compliances: &compliances };
        let fit =
            fit_spectrum(data, SpectrumOptions { modes: Some(1), ..SpectrumOptions::default() }).expect("a spectrum");
        for (k, mode) in melt.modes().iter().enumerate() {
            for (interval, truth) in
                [(fit.modulus_intervals[k], mode.modulus), (fit.relaxation_time_intervals[k], mode.relaxation_time)]
            {
                let Some([low, high]) = interval else { continue };
                counted += 1;
                inside += usize::from(low <= truth && truth <= high);
            }
        }
    }
    assert_eq!(counted, 4 * 60);
    // 240 intervals, four of a table: the standard deviation of their share is below 2 %.
    let share = inside as f64 / counted as f64;
    assert!((0.91..=0.99).contains(&share), "{share}");
}
