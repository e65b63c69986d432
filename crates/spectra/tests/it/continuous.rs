//! Continuous spectra and their bands against spectra that are known.

use piola_spectra::{RelaxationSpectrum, SpectrumData, fit_continuous};

use super::{Normal, spectrum};

/// A smooth H as modes that are 0.05 decades apart, which is the integral to ten digits and more.
fn smooth(density: impl Fn(f64) -> f64) -> RelaxationSpectrum {
    let step = 0.05 * core::f64::consts::LN_10;
    let times = (-120..=120).map(|k| (step * f64::from(k)).exp());
    let modes: Vec<(f64, f64)> = times.map(|time| ((density(time) * step).max(f64::MIN_POSITIVE), time)).collect();
    spectrum(&modes, 0.0)
}

#[test]
fn bands_of_noisy_relaxation_hold_the_spectrum_as_often_as_they_say() {
    const TABLES: u64 = 12;
    let two_peaks = |t: f64| {
        let peak = |at: f64| (-0.5 * ((t / at).ln() / 1.2).powi(2)).exp();
        peak(0.1) + 0.2 * peak(20.0)
    };
    let densities: [&dyn Fn(f64) -> f64; 3] =
        [&|t| (-1.0 / t).exp() / t, &two_peaks, &|t| t.powf(-0.5) * (-t / 30.0).exp()];
    let times: Vec<f64> = (0..41).map(|k| 10.0_f64.powf(0.1 * f64::from(k) - 2.0)).collect();
    let (mut inside, mut counted, mut errors, mut halves) = (0_usize, 0_usize, Vec::new(), Vec::new());
    for density in densities {
        let exact: Vec<f64> = times.iter().map(|&t| smooth(density).relaxation_modulus(t)).collect();
        for seed in 1..=TABLES {
            let mut normal = Normal::new(seed);
            let moduli: Vec<f64> = exact.iter().map(|g| g * (1.0 + 0.02 * normal.next())).collect();
            let data = SpectrumData::Relaxation { times: &times, moduli: &moduli };
            let found = fit_continuous(data, false).expect("a spectrum");
            assert!(0.01 < found.relative_error && found.relative_error < 0.03, "{}", found.relative_error);
            for ((&t, height), &[low, high]) in found.times.iter().zip(&found.spectrum).zip(&found.band) {
                if (0.1..=30.0).contains(&t) {
                    counted += 1;
                    inside += usize::from(low <= density(t) && density(t) <= high);
                    errors.push((height / density(t)).ln().abs());
                    halves.push((high / height).ln());
                }
            }
        }
    }
    // 600 nodes, of which some twenty are independent in each table: the standard deviation is near 1 %.
    let share = inside as f64 / counted as f64;
    assert!((0.92..=0.98).contains(&share), "{share}");
    errors.sort_by(f64::total_cmp);
    halves.sort_by(f64::total_cmp);
    let ratio = halves[halves.len() / 2] / errors[errors.len() * 95 / 100];
    assert!(ratio < 3.0, "half width over the 95th percentile of the error: {ratio}");
}

#[test]
fn ends_that_the_data_would_not_miss_reach_down_to_zero() {
    // Nothing of H = e^(−1/τ)/τ is left at τ = 0.01.
    let times: Vec<f64> = (0..41).map(|k| 10.0_f64.powf(0.1 * f64::from(k) - 2.0)).collect();
    let mut normal = Normal::new(5);
    let moduli: Vec<f64> = times.iter().map(|t| (1.0 + 0.02 * normal.next()) / (1.0 + t)).collect();
    let found = fit_continuous(SpectrumData::Relaxation { times: &times, moduli: &moduli }, false).expect("a spectrum");
    let (first, middle) = (found.band[0], found.times.iter().position(|t| 1.0 < *t).expect("a node"));
    assert!(first[0] <= 0.0 && 0.0 < first[1], "{first:?}");
    assert!(0.0 < found.band[middle][0]);
}

#[test]
fn few_numbers_are_refused() {
    let refused = fit_continuous(SpectrumData::Relaxation { times: &[1.0, 2.0], moduli: &[2.0, 1.0] }, false);
    let found = refused.expect_err("two numbers").to_string();
    assert_eq!(found, "`number of measured numbers`, entry 0: 2e0 violates 10 ≤ number of measured numbers");
}
