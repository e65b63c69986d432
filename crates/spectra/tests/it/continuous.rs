//! Continuous spectra against one in closed form: G(t) = 1/(1 + t) has H(τ) = e^(−1/τ)/τ.

use piola_spectra::{SpectrumData, fit_continuous};

#[test]
fn band_from_noisy_relaxation_holds_the_spectrum() {
    let times: Vec<f64> = (0..81).map(|k| 10.0_f64.powf(0.05 * f64::from(k) - 2.0)).collect();
    // Relative errors of ± 2 % that follow no order.
    let noise = |k: f64| 0.02 * (2.0 * (k * k * 0.618_033_988_749_895).fract() - 1.0);
    let moduli: Vec<f64> = (1_u8..).zip(&times).map(|(k, t)| (1.0 + noise(f64::from(k))) / (1.0 + t)).collect();
    let found = fit_continuous(SpectrumData::Relaxation { times: &times, moduli: &moduli }, false).expect("a spectrum");
    assert!(0.008 < found.relative_error && found.relative_error < 0.014, "{}", found.relative_error);
    assert!(2.0 < found.effective_parameters && found.effective_parameters < 20.0, "{}", found.effective_parameters);
    let (mut inside, mut compared) = (0, 0);
    for (&t, &[low, high]) in found.times.iter().zip(&found.band) {
        // Within what the data determine.
        if 0.1 < t && t < 30.0 {
            compared += 1;
            let exact = (-1.0 / t).exp() / t;
            // The band is of errors of the data alone; its bias is a tenth at most.
            inside += usize::from(0.9 * low <= exact && exact <= 1.1 * high);
        }
    }
    assert!(14 <= compared && compared <= 10 * inside / 8, "{inside} of {compared}: {found:?}");
}

#[test]
fn few_numbers_are_refused() {
    let refused = fit_continuous(SpectrumData::Relaxation { times: &[1.0, 2.0], moduli: &[2.0, 1.0] }, false);
    let found = refused.expect_err("two numbers").to_string();
    assert_eq!(found, "`number of measured numbers`, entry 0: 2e0 violates 10 ≤ number of measured numbers");
}
