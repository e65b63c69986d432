//! What the statistics of a fit say: rows at rest, bounds, correlation, tests that contradict each other, laws within laws.

use piola_fit::Autocorrelation;
use piola_fit::solids::{
    AnyModel, Data, Intervals, Measure, Options, Outcome, State, Table, Test, alone, contradictions, fit, fit_until,
    held_out, predict,
};
use piola_specimens::homogeneous::Mode;
use piola_testkit::{Tol, assert_close};

fn bar(points: Vec<[f64; 2]>) -> Test {
    Test::new("bar", Table::Uniaxial(points), Measure::FirstPiola).expect("a test")
}

fn of(tests: Vec<Test>) -> Data {
    Data::new(tests).expect("data")
}

/// Stresses of a bar of unit modulus, off by some percent.
fn points() -> Vec<[f64; 2]> {
    let errors = [1.0, -2.0, 1.5, -0.5, 2.0, -1.5, 0.5, -1.0];
    let stretch = |k: usize| 1.2 + 0.3 * k as f64;
    errors
        .iter()
        .enumerate()
        .map(|(k, e)| [stretch(k), (stretch(k) - stretch(k).powi(-2)) * (1.0 + 0.01 * e)])
        .collect()
}

#[test]
fn rows_at_rest_change_no_statistics() {
    let mut padded = points();
    padded.extend([[1.0, 0.0]; 200]);
    for model in [AnyModel::Yeoh, AnyModel::NeoHookean, AnyModel::Gent] {
        let [plain, padded] = [points(), padded.clone()]
            .map(|points| fit(&model, &of(vec![bar(points)]), &Options::default()).expect("a fit"));
        assert_eq!(plain.degrees_of_freedom, padded.degrees_of_freedom);
        assert_close(
            "criteria",
            &[padded.criteria.aicc.expect("rows")],
            &[plain.criteria.aicc.expect("rows")],
            Tol::ulps(64.0),
        );
        let (a, b) = (&plain.tests[0], &padded.tests[0]);
        assert_close(
            "RMS",
            &[b.relative_rms, b.relative_largest],
            &[a.relative_rms, a.relative_largest],
            Tol::stated(1e-9, "the search ends elsewhere in the last digits"),
        );
        for (a, b) in plain.parameters.iter().zip(&padded.parameters).filter(|(a, _)| a.state == State::Determined) {
            let tolerance = Tol::stated(1e-6, "the search ends where residuals are quadratic");
            assert_close("error", &[b.standard_error.expect("told")], &[a.standard_error.expect("told")], tolerance);
        }
        assert_eq!((padded.tests[0].residuals.len(), padded.tests[0].residuals[10].to_bits() << 1), (208, 0));
    }
}

#[test]
fn initial_shear_moduli_are_those_of_the_laws() {
    let data = of(vec![bar(points())]);
    let found =
        |name: &str| fit(&name.parse::<AnyModel>().expect("a model"), &data, &Options::default()).expect("a fit");
    let neo = found("neo-hookean");
    assert_close("μ", &[neo.initial_shear_modulus], &neo.values(), Tol::ulps(16.0));
    let mooney = found("mooney-rivlin");
    assert_close(
        "2 (C₁₀ + C₀₁)",
        &[mooney.initial_shear_modulus],
        &[2.0 * mooney.values().iter().sum::<f64>()],
        Tol::ulps(16.0),
    );
    let ogden = found("ogden:2");
    let sum: f64 = ogden.values().chunks_exact(2).map(|term| 0.5 * term[0] * term[1]).sum();
    assert_close("½ Σ μ α", &[ogden.initial_shear_modulus], &[sum], Tol::ulps(64.0));
}

#[test]
fn intervals_cross_no_bound() {
    // Stresses that hardly need the second term: μ₂ ≥ 0 with a wide error.
    let data = of(vec![bar(points())]);
    for intervals in [Intervals::Linear, Intervals::Profile] {
        let options = Options { intervals, ..Options::default() };
        for name in ["mooney-rivlin", "gent", "arruda-boyce", "ogden:2"] {
            let model: AnyModel = name.parse().expect("a model");
            let found = fit(&model, &data, &options).expect("a fit");
            for parameter in &found.parameters {
                let Some([low, high]) = parameter.interval else { continue };
                assert!(low <= parameter.value && parameter.value <= high, "{name} {parameter:?}");
                if parameter.is_stress && name != "ogden:2" {
                    assert!(0.0 <= low, "{name} {parameter:?}");
                }
                if parameter.is_stress && name == "ogden:2" {
                    // The sign is that of the exponent.
                    assert!(0.0 <= low * parameter.value, "{name} {parameter:?}");
                }
            }
        }
    }
}

/// With one factor S is a parabola, and the profile interval that of Student.
#[test]
fn profile_interval_of_a_factor_equals_the_linear_one() {
    let data = of(vec![bar(points())]);
    let options =
        |intervals| Options { intervals, stability: piola_fit::solids::Stability::Free, ..Options::default() };
    let [linear, profile] = [Intervals::Linear, Intervals::Profile].map(|intervals| {
        fit(&AnyModel::NeoHookean, &data, &options(intervals)).expect("a fit").parameters[0].interval.expect("told")
    });
    assert_close("interval", &profile, &linear, Tol::stated(1e-4, "the search for the ends stops there"));
}

#[test]
fn smooth_misfits_are_told_and_widen_intervals() {
    // A law of two terms seen by one of one.
    let stretch = |k: u32| 1.1 + 0.1 * f64::from(k);
    let stress = |x: f64| 2.0 * (x - x.powi(-2)) * (0.3 + 0.2 / x);
    let curve = (0..30).map(|k| [stretch(k), stress(stretch(k))]).collect();
    let found = fit(&AnyModel::NeoHookean, &of(vec![bar(curve)]), &Options::default()).expect("a fit");
    let correlation = found.autocorrelation.expect("29 pairs");
    assert!(0.8 < correlation.lag_one && 3.0 < correlation.widening, "{correlation:?}");
    let [low, high] = found.parameters[0].interval.expect("told");
    let error = found.parameters[0].standard_error.expect("told");
    assert!(2.0 * 3.0 * error < high - low);
    assert_eq!(Autocorrelation::of([[1.0, 2.0].as_slice()]), None);
}

#[test]
fn predictions_beyond_the_data_have_wider_bands() {
    let found = fit(&AnyModel::Yeoh, &of(vec![bar(points())]), &Options::default()).expect("a fit");
    let stresses =
        predict(&AnyModel::Yeoh, &found, Mode::Uniaxial, Measure::FirstPiola, &[1.0, 2.0, 6.0]).expect("three");
    assert!(stresses[0].stress.abs() <= 1e-15 && stresses[0].half_width.expect("told").abs() <= 1e-15);
    let [inside, beyond] = [1, 2].map(|k| stresses[k].half_width.expect("told") / stresses[k].stress);
    assert!(inside < 0.05 && 10.0 * inside < beyond, "{inside} {beyond}");
    assert!(predict(&AnyModel::Gent, &found, Mode::Uniaxial, Measure::FirstPiola, &[2.0]).is_err());
}

#[test]
fn tests_that_contradict_each_other_are_told_and_left_out_ones_predicted() {
    let sheet = points().into_iter().map(|[x, p]| [x, 2.0 * p * (x - x.powi(-3)) / (x - x.powi(-2))]).collect();
    let sheet = Test::new("sheet", Table::Planar(sheet), Measure::FirstPiola).expect("a test");
    let (data, options) = (of(vec![bar(points()), sheet]), Options::default());
    let joint = fit(&AnyModel::NeoHookean, &data, &options).expect("a fit");
    let both = alone(&AnyModel::NeoHookean, &data, &options, &joint, &|| false);
    let [found] = contradictions(&both).try_into().expect("one");
    let piola_fit::solids::Contradiction { tests, values, .. } = found;
    assert_eq!(tests, ["bar", "sheet"]);
    assert!((values[0] - 1.0).abs() < 0.02 && (values[1] - 2.0).abs() < 0.04, "{values:?}");
    let predicted = held_out(&AnyModel::NeoHookean, &data, &options, &|| false).expect("two fits");
    // The sheet is predicted at half its stresses, the bar at twice.
    assert!(
        (predicted[0].residuals.relative_largest - 1.0).abs() < 0.05,
        "{:?}",
        predicted[0].residuals.relative_largest
    );
    assert!((predicted[1].residuals.relative_largest - 0.5).abs() < 0.05);
    assert!(alone(&AnyModel::NeoHookean, &of(vec![bar(points())]), &options, &joint, &|| false).is_empty());
    assert!(alone(&AnyModel::NeoHookean, &data, &options, &joint, &|| true).is_empty());
    assert!(held_out(&AnyModel::NeoHookean, &data, &options, &|| true).expect("no fit").is_empty());
}

/// The law that is contained is the best of either where the data cannot tell them apart.
#[test]
fn laws_are_no_worse_than_those_that_they_contain() {
    let two = of(vec![bar(vec![[2.0, 0.9], [2.0, 1.1], [2.0, 1.4], [2.0, 0.6], [2.0, 1.0], [2.0, 1.2]])]);
    let squares = |name: &str, data: &Data| {
        fit(&name.parse::<AnyModel>().expect("a model"), data, &Options::default()).expect("a fit").weighted_squares
    };
    let pairs = [
        ("mooney-rivlin", "neo-hookean"),
        ("yeoh", "neo-hookean"),
        ("polynomial:1", "mooney-rivlin"),
        ("polynomial:2", "mooney-rivlin"),
        ("ogden:1", "neo-hookean"),
        ("ogden:2", "mooney-rivlin"),
        ("ogden:3", "ogden:2"),
    ];
    for data in [two, of(vec![bar(points())])] {
        for (larger, smaller) in pairs {
            let (own, contained) = (squares(larger, &data), squares(smaller, &data));
            assert!(own <= contained * (1.0 + 1e-8), "{larger}: {own}, {smaller}: {contained}");
        }
    }
}

#[test]
fn a_search_that_is_stopped_returns_its_best_until_then() {
    let data = of(vec![bar(points())]);
    let count = core::cell::Cell::new(0);
    let stop = || {
        count.set(count.get() + 1);
        20 < count.get()
    };
    let model: AnyModel = "ogden:3".parse().expect("a model");
    let found = fit_until(&model, &data, &Options::default(), &stop).expect("a fit");
    assert_eq!(found.outcome, Outcome::Interrupted);
    assert!(found.weighted_squares.is_finite() && !found.outcome.is_converged());
}

#[test]
fn thousands_of_rows_give_the_parameters_of_their_law() {
    let stretch = |k: u32| 1.0 + 5.0 * f64::from(k + 1) / 4000.0;
    let stress = |x: f64| 0.4 * (x.powf(0.8) - x.powf(-1.9)) + 1e-3 * (x.powi(4) - x.powf(-3.5));
    let curve = (0..4000).map(|k| [stretch(k), stress(stretch(k))]).collect();
    let model: AnyModel = "ogden:2".parse().expect("a model");
    let found = fit(&model, &of(vec![bar(curve)]), &Options::default()).expect("a fit");
    assert_close(
        "parameters",
        &found.values(),
        &[1e-3, 5.0, 0.4, 1.8],
        Tol::stated(1e-6, "the root of the rounding of S"),
    );
}
