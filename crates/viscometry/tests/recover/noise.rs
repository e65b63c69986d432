//! Tables with noise: seeded trials.

use piola_testkit::NormalNoise;
use piola_testkit::golden::text;
use piola_viscometry::recover::{
    Criterion, FlowCurve, FlowTable, Monotonicity, Noise, Options, Rise, couette, pipe_with,
};
use serde_json::Value;

use super::golden::{cases, recovered};

/// Trials in which the band holds every true point at once.
fn held(case: &Value, flow: &str, trials: u32) -> u32 {
    // Each fluid and flow has noise of its own.
    let seed = text(&case["id"])
        .bytes()
        .chain(flow.bytes())
        .fold(2026_u64, |seed, byte| u64::wrapping_add(u64::wrapping_mul(seed, 31), byte.into()));
    let mut normal = NormalNoise(seed);
    let mut held = 0;
    for _ in 0..trials {
        let (curve, truth) = recovered(case, flow, || 0.01 * normal.draw()).expect("a curve");
        let curve = curve.with_band(0.95).expect("a band");
        let inside = |[stress, rate]: [f64; 2]| {
            let [low, high] = curve.at(stress).expect("measured").band.expect("asked for");
            low <= rate && rate <= high
        };
        // Every point is looked at.
        let outside = truth.into_iter().map(inside).filter(|inside| !inside).count();
        held += u32::from(outside == 0);
    }
    held
}

/// A hundred trials of every fluid, of which a coverage of 95 % holds 95 ± 2.2: three deviations are allowed. The test of each flow is apart, so
/// that they run beside one another.
fn every_fluid(flow: &str) {
    for case in cases() {
        let held = held(&case, flow, 100);
        assert!(88 <= held, "{} {flow}: {held}", text(&case["id"]));
    }
}

#[test]
fn bands_of_pipes_with_a_percent_of_noise_hold_the_truth_as_often_as_they_say() {
    every_fluid("pipe");
}

#[test]
fn bands_of_channels_with_a_percent_of_noise_hold_the_truth_as_often_as_they_say() {
    every_fluid("channel");
}

#[test]
fn bands_of_coaxial_cylinders_with_a_percent_of_noise_hold_the_truth_as_often_as_they_say() {
    every_fluid("couette");
}

fn noisy_rows(level: f64, slope: f64) -> Vec<[f64; 2]> {
    let mut normal = NormalNoise(7);
    (0..40).map(|i| (0.1 * f64::from(i)).exp()).map(|c| [c, c.powf(slope) * (1.0 + level * normal.draw())]).collect()
}

#[test]
fn the_noise_found_is_the_noise_put_in() {
    let rows = noisy_rows(0.02, 1.5);
    let estimated = FlowTable::pipe(1.0, &rows).expect("a table");
    let stated = estimated.clone().with_noise(Noise::Relative(0.02)).expect("a level");
    let found = |table: &FlowTable<_>| -> FlowCurve { pipe_with(table, Options::default()).expect("a curve") };
    let (estimated, stated) = (found(&estimated).smoothing(), found(&stated).smoothing());
    assert_eq!(estimated.criterion, Criterion::GeneralisedCrossValidation);
    assert_eq!(stated.criterion, Criterion::KnownNoise);
    assert!(0.013 < estimated.noise && estimated.noise < 0.03, "{estimated:?}");
    assert!((stated.noise - 0.02).abs() < 1e-15);
    assert!(stated.degrees_of_freedom < 10.0 && estimated.degrees_of_freedom < 10.0);
}

#[test]
fn a_curve_that_falls_is_reported_or_smoothed_until_it_rises() {
    // Nearly constant discharge up to c = 6, in noise: 3 + d ln Q/d ln c changes by more than Q.
    let mut normal = NormalNoise(3);
    let rows: Vec<_> = (0..30)
        .map(|i| (0.06 * f64::from(i)).exp())
        .map(|c| [c, c.powf(0.05) * (1.0 + 0.02 * normal.draw())])
        .collect();
    let table = FlowTable::pipe(1.0, &rows).expect("a table").with_noise(Noise::Relative(0.009)).expect("a level");
    let reported = pipe_with(&table, Options::default());
    let enforced = pipe_with(&table, Options { rise: Rise::Enforced, ..Options::default() });
    // The noise is twice what is stated: no row falls by more than five deviations of a difference, but the curve falls.
    if let (Ok(reported), Ok(enforced)) = (reported, enforced) {
        let Monotonicity::Falling { from, to } = reported.monotonicity() else { panic!("it falls") };
        // At wall stresses of the table: T = c/2 from ½ to ½ e^1.74.
        assert!(0.5 - 1e-12 <= from && from < to && to <= 0.5 * 1.74_f64.exp() + 1e-12, "{from} {to}");
        assert_eq!(enforced.monotonicity(), Monotonicity::Rising);
        assert!(enforced.smoothing().raised && reported.smoothing().parameter < enforced.smoothing().parameter);
    } else {
        panic!("refused");
    }
}

#[test]
fn a_long_noisy_table_of_coaxial_cylinders_is_recovered_in_a_narrow_gap() {
    // ζ = T: ΔΩ = (M/4π)(1 − 1/R₂²) for R₁ = 1.
    let mut normal = NormalNoise(11);
    let outer = 1.001_f64;
    let factor = (1.0 - outer.powi(-2)) / (4.0 * core::f64::consts::PI);
    let rows: Vec<_> = (0..400)
        .map(|i| (0.01 * f64::from(i)).exp())
        .map(|torque| [torque, factor * torque * (1.0 + 0.001 * normal.draw())])
        .collect();
    let curve = couette(&FlowTable::couette(1.0, outer, &rows).expect("a table")).expect("a curve");
    let stress = 10.0 / core::f64::consts::TAU;
    let rate = curve.at(stress).expect("measured").shear_rate;
    assert!((rate / stress - 1.0).abs() < 1e-3, "{rate} {stress}");
}

/// Near the yield stress ln discharge bends within few rows of a long table that is even in the drive.
#[test]
fn long_tables_that_begin_near_a_yield_stress_keep_the_rows_there() {
    use core::f64::consts::PI;
    // k = τ − 1 in a pipe of radius 1: Q = (π/T³) ∫ τ² k dτ at the wall stress T.
    let discharge = |t: f64| PI / (t * t * t) * ((t.powi(4) - 1.0) / 4.0 - (t.powi(3) - 1.0) / 3.0);
    let mut normal = NormalNoise(21);
    for (rows, most, wide) in [(1000_u32, 40.0, 1.2), (5000, 20.0, 1.1), (10_000, 20.0, 1.1)] {
        let stresses = (0..rows).map(|i| 1.01 + (most - 1.01) * f64::from(i) / f64::from(rows - 1));
        let table: Vec<_> = stresses.map(|t| [2.0 * t, discharge(t) * (1.0 + 0.007 * normal.draw())]).collect();
        let curve = pipe_with(&FlowTable::pipe(1.0, &table).expect("a table"), Options::default()).expect("a curve");
        let curve = curve.with_band(0.95).expect("a band");
        for t in [1.01, 1.02, 1.05, 1.2, 2.0, 10.0] {
            let point = curve.at(t).expect("measured");
            let [low, high] = point.band.expect("asked for");
            assert!(low <= t - 1.0 && t - 1.0 <= high, "{rows} {t}: {point:?}");
            assert!(high < wide * low, "{rows} {t}: {point:?}");
        }
    }
}

/// Bingham's fluid begins to flow at the outer cylinder at four times the yield torque, not at four times the smallest torque.
#[test]
fn bands_of_coaxial_cylinders_hold_the_truth_of_tables_that_begin_beyond_the_yield_torque() {
    let speed = |t: f64| {
        let least = (0.25 * t).max(1.0);
        0.5 * (t - least - (t / least).ln())
    };
    let mut normal = NormalNoise(5);
    let mut held = 0;
    for _ in 0..40 {
        let stresses: Vec<f64> = (0..40).map(|i| 1.3 * (0.07 * f64::from(i)).exp()).collect();
        let noisy = |t: &f64| [core::f64::consts::TAU * t, speed(*t) * (1.0 + 0.01 * normal.draw())];
        let rows: Vec<_> = stresses.iter().map(noisy).collect();
        let curve = couette(&FlowTable::couette(1.0, 2.0, &rows).expect("a table")).expect("a curve");
        let curve = curve.with_band(0.95).expect("a band");
        let is_held = |t: &f64| {
            let [low, high] = curve.at(*t).expect("measured").band.expect("asked for");
            low <= t - 1.0 && t - 1.0 <= high
        };
        held += u32::from(stresses.iter().all(is_held));
    }
    assert!(36 <= held, "{held}");
}
