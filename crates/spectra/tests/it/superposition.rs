//! Shifts and their laws found again.

use piola_fluids::{Arrhenius, TemperatureShift, WilliamsLandelFerry};
use piola_spectra::{IsothermalCurve, fit_arrhenius, fit_williams_landel_ferry, horizontal_shifts};
use piola_testkit::{Tol, assert_close, assert_each_close};

use super::spectrum;

const SEARCH: Tol = Tol::ulps_because(1e9, "the search ends where constants change by less than 1e-7 of theirs");

#[test]
fn constants_fitted_to_exact_shifts_equal_those_of_the_law() {
    let temperatures = [403.0, 423.0, 443.0, 463.0, 483.0];
    let arrhenius = Arrhenius::new(4.2e4, 423.0).expect("positive");
    let shifts = temperatures.map(|t| arrhenius.logarithm(t).expect("above zero"));
    let fit = fit_arrhenius(&temperatures, &shifts, 423.0).expect("a law");
    assert_each_close("E", &[fit.law.activation_energy()], &[4.2e4], SEARCH);
    let wlf = WilliamsLandelFerry::new(6.3, 75.0, 423.0).expect("positive");
    let shifts = temperatures.map(|t| wlf.logarithm(t).expect("above the least"));
    let fit = fit_williams_landel_ferry(&temperatures, &shifts, 423.0).expect("a law");
    assert_each_close("C₁, C₂", &[fit.law.strength(), fit.law.width()], &[6.3, 75.0], SEARCH);
}

#[test]
fn shifts_by_overlap_equal_those_of_the_law() {
    let melt = spectrum(&[(1e5, 0.001), (3e4, 0.01), (1e4, 0.1), (2e3, 1.0), (300.0, 10.0)], 0.0);
    let temperatures = [403.0, 423.0, 443.0, 463.0];
    let wlf = WilliamsLandelFerry::new(6.3, 105.0, 423.0).expect("positive");
    let expected = temperatures.map(|t| wlf.logarithm(t).expect("above the least"));
    let frequencies: Vec<f64> = (0..31).map(|k| 10.0_f64.powf(0.1 * f64::from(k) - 1.0)).collect();
    let moduli = expected.map(|s| frequencies.iter().map(|&w| melt.storage_modulus(w * s.exp())).collect::<Vec<_>>());
    let curves: Vec<_> =
        moduli.iter().map(|moduli| IsothermalCurve { angular_frequencies: &frequencies, moduli }).collect();
    let shifts = horizontal_shifts(&curves, 1).expect("shifts");
    assert_close("ln aₜ", &shifts, &expected, Tol::order(0.1, 2).times(0.5));
    let fit = fit_williams_landel_ferry(&temperatures, &shifts, 423.0).expect("a law");
    let [Some([a, b]), _] = fit.intervals else { panic!("C₁ is determined") };
    assert!(a <= 6.3 && 6.3 <= b, "{a} {b}");
}

#[test]
fn falling_frequencies_curves_apart_and_missing_references_are_refused() {
    let curve = IsothermalCurve { angular_frequencies: &[2.0, 1.0, 3.0], moduli: &[1.0, 2.0, 3.0] };
    let refused = horizontal_shifts(&[curve], 0).expect_err("falling").to_string();
    assert_eq!(refused, "`angular frequency`, entry 1: 1e0 violates 0 < ω, rising");
    let low = IsothermalCurve { angular_frequencies: &[1.0, 2.0, 3.0], moduli: &[1.0, 2.0, 3.0] };
    let high = IsothermalCurve { angular_frequencies: &[1.0, 2.0, 3.0], moduli: &[10.0, 20.0, 30.0] };
    let refused = horizontal_shifts(&[low, high], 0).expect_err("apart").to_string();
    assert_eq!(refused, "curves 0 and 1 have too few moduli in common to be shifted over each other");
    let refused = horizontal_shifts(&[], 0).expect_err("no curve").to_string();
    assert_eq!(refused, "`reference`, entry 0: 0e0 violates reference < number of curves");
}
