//! Shifts and their laws found again.

use piola_fluids::{Arrhenius, TemperatureShift, WilliamsLandelFerry};
use piola_spectra::{
    CurveShift, IsothermalCurve, SpectraError, fit_arrhenius, fit_williams_landel_ferry, horizontal_shifts,
    shifts_along_both_axes,
};
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

/// ln aₜ and ln bₜ found from G′ and G″ of four temperatures with relative normal noise, and the exact ones.
fn both_axes(noise: f64, seed: u64) -> [Vec<f64>; 4] {
    let (found, horizontal, vertical) = along_both_axes(noise, seed);
    let [along, across] =
        [found.iter().map(|s| s.ln_horizontal).collect(), found.iter().map(|s| s.ln_vertical).collect()];
    [along, across, horizontal.to_vec(), vertical.to_vec()]
}

/// The same, with the intervals of the shifts.
fn along_both_axes(noise: f64, seed: u64) -> (Vec<CurveShift>, [f64; 4], [f64; 4]) {
    let melt = spectrum(&[(1e5, 0.001), (3e4, 0.01), (1e4, 0.1), (2e3, 1.0), (300.0, 10.0)], 0.0);
    let temperatures = [403.0, 423.0, 443.0, 463.0];
    let wlf = WilliamsLandelFerry::new(6.3, 105.0, 423.0).expect("positive");
    let horizontal = temperatures.map(|t| wlf.logarithm(t).expect("above the least"));
    // Rubber elasticity: b = θ₀/θ.
    let vertical = temperatures.map(|t| (423.0_f64 / t).ln());
    let frequencies: Vec<f64> = (0..31).map(|k| 10.0_f64.powf(0.1 * f64::from(k) - 1.0)).collect();
    let mut normal = super::Normal::new(seed);
    let mut measured = |exact: f64| exact * (1.0 + noise * normal.next());
    let mut moduli = Vec::new();
    for (a, b) in horizontal.iter().zip(vertical) {
        let at = |w: &f64| w * a.exp();
        let storage = frequencies.iter().map(|w| measured(melt.storage_modulus(at(w)) / b.exp())).collect::<Vec<_>>();
        let loss = frequencies.iter().map(|w| measured(melt.loss_modulus(at(w)) / b.exp())).collect::<Vec<_>>();
        moduli.push([storage, loss]);
    }
    let curve = |moduli| IsothermalCurve { angular_frequencies: &frequencies, moduli };
    let curves: Vec<_> = moduli.iter().map(|[storage, loss]| [curve(storage), curve(loss)]).collect();
    let curves: Vec<&[IsothermalCurve<'_>]> = curves.iter().map(<[_; 2]>::as_slice).collect();
    (shifts_along_both_axes(&curves, 1).expect("shifts"), horizontal, vertical)
}

#[test]
fn intervals_of_shifts_along_both_axes_hold_them_as_often_as_they_say() {
    let (mut inside, mut counted) = (0_usize, 0_usize);
    for seed in 1..=40 {
        let (found, horizontal, vertical) = along_both_axes(0.02, seed);
        assert_eq!((found[1].horizontal_interval, found[1].vertical_interval), (None, None));
        for (k, shift) in found.iter().enumerate().filter(|(k, _)| *k != 1) {
            for (interval, truth) in
                [(shift.horizontal_interval, horizontal[k]), (shift.vertical_interval, vertical[k])]
            {
                let [low, high] = interval.expect("an interval");
                counted += 1;
                inside += usize::from(low <= truth && truth <= high);
            }
        }
    }
    assert_eq!(counted, 240);
    // ln a and ln b of a pair are correlated: 120 intervals that are independent have a standard deviation of 2 %.
    let share = inside as f64 / counted as f64;
    assert!((0.91..=0.99).contains(&share), "{share}");
}

#[test]
fn shifts_along_both_axes_equal_those_that_made_the_curves() {
    let [along, across, horizontal, vertical] = both_axes(0.0, 0);
    assert_eq!((along[1].to_bits(), across[1].to_bits()), (0, 0));
    let tol = Tol::order(0.1, 2).times(0.5);
    assert_close("ln aₜ", &along, &horizontal, tol);
    // The largest is 0.1.
    assert_close("ln bₜ", &across, &vertical, tol.times(10.0));
}

#[test]
fn vertical_shifts_of_noisy_curves_have_no_bias_beyond_their_scatter() {
    let (mut sums, mut squares) = ([0.0; 4], [0.0; 4]);
    for seed in 1..=20 {
        let [_, across, _, vertical] = both_axes(0.02, seed);
        for k in 0..4 {
            let error = across[k] - vertical[k];
            sums[k] += error;
            squares[k] += error * error;
        }
    }
    for k in [0, 2, 3] {
        let (mean, scatter) = (sums[k] / 20.0, (squares[k] / 20.0_f64).sqrt());
        // 2 % noise of some forty overlapping numbers, whose slopes differ by a half or less.
        assert!(scatter < 0.05, "{k}: scatter {scatter}");
        assert!(mean.abs() < 3.0 * scatter / 20.0_f64.sqrt(), "{k}: mean error {mean}, scatter {scatter}");
    }
}

#[test]
fn straight_lines_have_no_vertical_shift() {
    let frequencies = [1.0, 2.0, 4.0, 8.0, 16.0];
    let moduli = frequencies.map(|w: f64| 3.0 * w.sqrt());
    let curve = [IsothermalCurve { angular_frequencies: &frequencies, moduli: &moduli }];
    let refused = shifts_along_both_axes(&[&curve, &curve], 0).expect_err("straight").to_string();
    assert!(refused.starts_with("curves 0 and 1 are straight lines in logarithms"), "{refused}");
    // Noise does not bend them.
    let frequencies: Vec<f64> = (0..31).map(|k| 10.0_f64.powf(0.1 * f64::from(k))).collect();
    for (noise, seed) in [(0.0, 1), (1e-4, 1), (1e-3, 1), (1e-3, 2), (1e-2, 1), (1e-2, 2), (3e-2, 1)] {
        let mut normal = super::Normal::new(seed);
        let mut measured = |exact: f64| exact * (1.0 + noise * normal.next());
        let cold: Vec<f64> = frequencies.iter().map(|w| measured(w.sqrt())).collect();
        let warm: Vec<f64> =
            frequencies.iter().map(|w| measured((w * (-0.7_f64).exp()).sqrt() / 0.05_f64.exp())).collect();
        let [cold, warm] = [&cold, &warm].map(|moduli| [IsothermalCurve { angular_frequencies: &frequencies, moduli }]);
        let found = shifts_along_both_axes(&[&cold, &warm], 0);
        assert_eq!(found, Err(SpectraError::StraightCurves { first: 0, second: 1 }), "noise {noise}, seed {seed}");
    }
    let two = [curve[0], curve[0]];
    let refused = shifts_along_both_axes(&[&curve, &two], 0).expect_err("one and two").to_string();
    assert_eq!(refused, "`curves of a temperature` has length 2; length 1 is needed");
}

/// Curves that overlap by half of their points only at the end of what is tried.
#[test]
fn shifts_at_the_end_of_the_overlap_are_numbers() {
    let cold_frequencies: Vec<f64> = (0..12).map(|k| 2.0_f64.powi(k)).collect();
    let warm_frequencies = [1.0, 2.0, 4.0];
    // A plateau and a corner: the three points of the warm curve fit beside the end of the cold one, and nowhere else.
    let cold: Vec<f64> = cold_frequencies.iter().map(|w| if *w < 1000.0 { 1.0 } else { w / 512.0 }).collect();
    let warm = [1.0, 1.0, 2.0];
    let cold = IsothermalCurve { angular_frequencies: &cold_frequencies, moduli: &cold };
    let warm = IsothermalCurve { angular_frequencies: &warm_frequencies, moduli: &warm };
    let shifts = horizontal_shifts(&[cold, warm], 0).expect("shifts");
    assert!(shifts.iter().all(|shift| shift.is_finite()), "{shifts:?}");
}
