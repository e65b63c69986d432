//! Laws with history: parameters from tables that the laws, and independent integrations, have made.

use core::error::Error;

use piola_fit::history::{AnyHistoryModel, HistoryModel, HistoryOptions, HistoryParameter, HistoryTest, fit_history};
use piola_fit::sides::Loading;
use piola_fit::{FitError, State};
use piola_inelastic::{InelasticError, StepControl};
use piola_testkit::golden::{self, number, text, vector};
use piola_testkit::spectral::Random;
use piola_testkit::{Tol, assert_close};

type Fallible = Result<(), Box<dyn Error>>;

/// Of data without errors.
const FOUND: Tol = Tol::stated(1e-8, "what the task asks; derivatives are differences over 1e-5");

/// A model, its parameters, and tests.
type Made = (AnyHistoryModel, Vec<f64>, Vec<HistoryTest>);

/// A table of golden data as a test, and the model and the parameters that made it.
fn golden_tests(name: &str) -> Result<Made, Box<dyn Error>> {
    let model: AnyHistoryModel = name.parse()?;
    let golden = golden::load("history_tables");
    let (mut tests, mut made) = (Vec::new(), Vec::new());
    for case in golden.cases.iter().filter(|case| text(&case["law"]) == name) {
        let stresses = vector(&case["output"]["P12"]);
        let rows: Vec<[f64; 3]> = golden::matrix(&case["input"]["rows"])
            .iter()
            .zip(stresses)
            .map(|(row, stress)| [row[0], row[1], stress])
            .collect();
        tests.push(HistoryTest::new(text(&case["id"]), Loading::SimpleShear, &rows)?);
        let params = &case["params"];
        // Springs are written as pairs, of one spring as numbers.
        let of_spring =
            |key: &str, k: usize| if params[key].is_array() { number(&params[key][k]) } else { number(&params[key]) };
        made = model
            .parameters()
            .iter()
            .map(|(parameter, _, _)| match *parameter {
                "shear_modulus" => of_spring("mu", 0),
                "first_lame_parameter" => of_spring("lambda", 0),
                "overstress_shear_modulus" => of_spring("mu", 1),
                "overstress_first_lame_parameter" => of_spring("lambda", 1),
                other => number(&params[other]),
            })
            .collect();
    }
    assert!(!tests.is_empty(), "{name}");
    Ok((model, made, tests))
}

/// The same tests with the stresses that the model itself computes.
fn of_model(
    model: AnyHistoryModel,
    made: &[f64],
    tests: &[HistoryTest],
    control: &StepControl,
) -> Result<Vec<HistoryTest>, FitError> {
    let remade = |test: &HistoryTest| {
        let stresses = model.stresses(made, test, control)?;
        let rows: Vec<[f64; 3]> = test.rows().iter().zip(stresses).map(|(row, p)| [row[0], row[1], p]).collect();
        HistoryTest::new(test.name(), test.loading(), &rows)
    };
    tests.iter().map(remade).collect()
}

/// What simple shear does not tell is held at its value.
fn holding(model: AnyHistoryModel, made: &[f64], names: &[&str]) -> HistoryOptions {
    let parameters = model.parameters();
    let values = parameters.iter().zip(made).filter(|(parameter, _)| names.contains(&parameter.0));
    values.fold(HistoryOptions::default(), |options, (parameter, value)| options.with_bounds(parameter.0, [*value; 2]))
}

const HELD: [&str; 4] = ["first_lame_parameter", "overstress_first_lame_parameter", "stress", "perturbation"];

#[test]
fn stresses_along_tables_equal_those_of_an_independent_integration() -> Fallible {
    let stated = Tol::stated(1e-10, "the error of an increment is controlled to 1e-11");
    for model in AnyHistoryModel::ALL {
        let (model, made, tests) = golden_tests(&model.to_string())?;
        for test in &tests {
            // Some rows of each: a debug build integrates slowly.
            let test = &HistoryTest::new(test.name(), test.loading(), &test.rows()[..4])?;
            let found = model.stresses(&made, test, &StepControl::new(1e-11)?)?;
            let expected: Vec<f64> = test.rows().iter().map(|row| row[2]).collect();
            assert_close(test.name(), &found, &expected, stated);
        }
    }
    Ok(())
}

/// From starts that are off by a factor of two or so.
#[test]
fn fitted_parameters_equal_those_that_made_the_tables() -> Fallible {
    let control = StepControl::one_step();
    for model in AnyHistoryModel::ALL {
        let (model, made, tests) = golden_tests(&model.to_string())?;
        let tests = of_model(model, &made, &tests, &control)?;
        let options = holding(model, &made, &HELD).with_control(control);
        let start: Vec<f64> = model
            .parameters()
            .iter()
            .zip(&made)
            .enumerate()
            .map(|(k, ((_, _, bounds), value))| match bounds {
                [-1.0, 0.0] => -0.25,
                // Above one where that is the least.
                [1.0, _] => 1.0 + (value - 1.0) * 1.5,
                _ => value * if k % 2 == 0 { 1.7 } else { 0.6 },
            })
            .map(|value| if model == AnyHistoryModel::Viscoplastic && value < 0.3 { value.max(0.2) } else { value })
            .collect();
        let fit = fit_history(&model, &tests, &start, &options)?;
        assert!(fit.outcome.is_converged(), "{model}: {:?}", fit.outcome);
        assert_close(&format!("{model}: θ"), &fit.values(), &made, FOUND);
        assert_eq!(fit.parameters[1].state, State::Held);
        assert_eq!(fit.parameters[0].state, State::Determined);
        assert!(0 < fit.evaluations && fit.tests.iter().all(|test| test.relative_rms < 1e-12), "{model}");
    }
    Ok(())
}

/// Ogden and Roxburgh's law by its closed form, at full accuracy.
#[test]
fn fitted_softening_equals_that_of_the_closed_form() -> Fallible {
    let (model, made, tests) = golden_tests("ogden-roxburgh")?;
    let fit = fit_history(&model, &tests, &[3.0, 5.0, 1.2, 1.0, 0.5], &holding(model, &made, &HELD))?;
    assert_close("θ", &fit.values(), &made, FOUND);
    Ok(())
}

/// Bars, sheets pulled one and both ways: free sides are found, and tell the sum of the two λ.
#[test]
fn fitted_parameters_of_tests_with_free_sides_equal_those_that_made_them() -> Fallible {
    let (model, made, control) = (AnyHistoryModel::ReeseGovindjee, [1.0, 5.0, 2.0, 8.0, 0.75], StepControl::one_step());
    let mut tests = Vec::new();
    for loading in [Loading::Uniaxial, Loading::Equibiaxial, Loading::Planar] {
        let rows = [[0.0, 1.1, 0.0], [0.25, 1.2, 0.0], [0.5, 1.4, 0.0], [1.5, 1.4, 0.0], [1.75, 1.1, 0.0]];
        tests.push(HistoryTest::new(loading.name(), loading, &rows)?);
    }
    let tests = of_model(model, &made, &tests, &control)?;
    // Both springs resist a change of volume, and no volume flows: the tests tell the sum of the two λ.
    let options = HistoryOptions::default().with_control(control).with_bounds("first_lame_parameter", [5.0, 5.0]);
    let fit = fit_history(&model, &tests, &[1.4, 3.0, 1.5, 12.0, 1.2], &options)?;
    assert_close("θ", &fit.values(), &made, FOUND);
    // At once the bar is elastic: E = μ (3 λ + 2 μ)/(λ + μ) of the sums, to the order of the strain.
    let small = HistoryTest::new("small", Loading::Uniaxial, &[[0.0, 1.0 + 1e-7, 0.0]])?;
    let stress = model.stresses(&made, &small, &control)?[0];
    let expected = 1e-7 * 3.0 * (3.0 * 13.0 + 2.0 * 3.0) / 16.0;
    assert_close("E ε", &[stress], &[expected], Tol::stated(1e-6, "terms of the second order in the strain"));
    Ok(())
}

#[test]
fn parameters_of_noisy_data_are_within_four_standard_errors() -> Fallible {
    let (model, made, tests) = golden_tests("ogden-roxburgh")?;
    let mut random = Random::new(7);
    let rows: Vec<[f64; 3]> =
        tests[0].rows().iter().map(|row| [row[0], row[1], row[2] + 1e-3 * random.symmetric()]).collect();
    let test = HistoryTest::new("noisy", Loading::SimpleShear, &rows)?;
    let fit = fit_history(&model, &[test], &[2.0, 5.0, 1.5, 0.5, 0.25], &holding(model, &made, &HELD))?;
    for (k, parameter) in fit.parameters.iter().enumerate().filter(|(k, _)| *k != 1) {
        let error = parameter.standard_error.ok_or("a standard error")?;
        assert!(0.0 < error && (parameter.value - made[k]).abs() < 4.0 * error, "{parameter:?}");
    }
    Ok(())
}

/// Stress = p · stretch, with any bounds: the fit is linear in p.
struct Linear([f64; 2]);

impl HistoryModel for Linear {
    fn name(&self) -> String {
        "linear".to_owned()
    }
    fn parameters(&self) -> Vec<HistoryParameter> {
        vec![("modulus", true, self.0)]
    }
    fn stresses(&self, p: &[f64], test: &HistoryTest, _control: &StepControl) -> Result<Vec<f64>, FitError> {
        Ok(test.rows().iter().map(|row| p[0] * row[1]).collect())
    }
}

/// The first step of the search leaves the principal branch of the coordinate.
#[test]
fn starts_near_an_end_of_a_range_come_to_the_minimum() -> Fallible {
    let cases = [
        ([0.0, 1.0], 0.95, 0.05),
        ([0.0, 1.0], 0.05, 0.95),
        ([0.0, 1.0], 0.5, 0.0),
        ([0.0, 1.0], 0.3, 1.0),
        ([-1.0, 0.0], -0.5, -0.01),
        ([0.0, 10.0], 8.0, 0.5),
        // One bound, and values far below the usual ones.
        ([0.0, f64::INFINITY], 3e-13, 1e-12),
        ([0.0, f64::INFINITY], 3e-13, 1e-9),
        ([f64::NEG_INFINITY, 0.0], -3e-13, -1e-12),
        ([f64::NEG_INFINITY, f64::INFINITY], -4.0, 3.0),
    ];
    for (bounds, made, start) in cases {
        let rows: Vec<[f64; 3]> = (1..9).map(f64::from).map(|k| [k, 0.1 * k, 0.1 * k * made]).collect();
        let test = HistoryTest::new("t", Loading::SimpleShear, &rows)?;
        let fit = fit_history(&Linear(bounds), &[test], &[start], &HistoryOptions::default())?;
        assert!(fit.outcome.is_converged(), "{bounds:?}, {start}: {:?}", fit.outcome);
        assert_close(&format!("{bounds:?} from {start}"), &fit.values(), &[made], FOUND);
        assert_eq!(fit.parameters[0].state, State::Determined, "{bounds:?} from {start}");
    }
    // Beyond the end of a range, at that end.
    let rows: Vec<[f64; 3]> = (1..9).map(f64::from).map(|k| [k, 0.1 * k, -0.1 * k]).collect();
    let test = HistoryTest::new("t", Loading::SimpleShear, &rows)?;
    let fit = fit_history(&Linear([0.0, 1.0]), &[test], &[0.3], &HistoryOptions::default())?;
    assert!(fit.values()[0] < 1e-8 && fit.parameters[0].state == State::AtBound, "{:?}", fit.parameters);
    Ok(())
}

/// In a shear the volume stays: the tests say nothing of λ, whatever the tolerance of the integration leaves.
#[test]
fn parameters_that_tests_do_not_tell_are_undetermined() -> Fallible {
    let (model, made, tests) = golden_tests("reese-govindjee")?;
    for control in [StepControl::new(1e-7)?, StepControl::one_step()] {
        let exact = of_model(model, &made, &tests, &control)?;
        let mut random = Random::new(3);
        let noisy = |test: &HistoryTest| {
            let rows: Vec<[f64; 3]> =
                test.rows().iter().map(|row| [row[0], row[1], row[2] * (1.0 + 1e-2 * random.symmetric())]).collect();
            HistoryTest::new(test.name(), test.loading(), &rows)
        };
        let noisy: Vec<HistoryTest> = exact.iter().map(noisy).collect::<Result<_, _>>()?;
        for tests in [exact, noisy] {
            let options = HistoryOptions::default().with_control(control);
            let fit = fit_history(&model, &tests, &made, &options)?;
            let told = |name: &str| fit.parameters.iter().find(|parameter| parameter.name == name);
            let shear = told("shear_modulus").ok_or("μ")?;
            assert_eq!(shear.state, State::Determined, "{control:?}: {:?}", fit.parameters);
            let lame = told("first_lame_parameter").ok_or("λ")?;
            assert_eq!(lame.state, State::Undetermined, "{control:?}: {:?}", fit.parameters);
            assert_eq!((lame.standard_error, lame.interval), (None, None));
        }
    }
    Ok(())
}

/// One stress, however many rows.
struct Forgetful;

impl HistoryModel for Forgetful {
    fn name(&self) -> String {
        "forgetful".to_owned()
    }
    fn parameters(&self) -> Vec<HistoryParameter> {
        vec![("modulus", true, [0.0, 2.0])]
    }
    fn stresses(&self, p: &[f64], _test: &HistoryTest, _control: &StepControl) -> Result<Vec<f64>, FitError> {
        Ok(p.to_vec())
    }
}

#[test]
fn tables_starts_and_laws_without_an_answer_are_refused_by_name() -> Fallible {
    let rows = [[0.0, 1.1, 1.0], [1.0, 1.2, 2.0]];
    let error = HistoryTest::new("t", Loading::Volumetric, &rows);
    assert!(matches!(error, Err(FitError::NoHistoryLoading { loading: "volumetric", .. })));
    let error = HistoryTest::new("t", Loading::Uniaxial, &[]);
    assert!(matches!(error, Err(FitError::EmptyTest { .. })));
    let error = HistoryTest::new("t", Loading::Uniaxial, &[[1.0, 1.1, 1.0], [0.5, 1.1, 1.0]]);
    assert!(matches!(error, Err(FitError::TimeOutOfOrder { index: 1, value: 0.5, before: 1.0, .. })));
    for t in [f64::NAN, -1.0, f64::INFINITY] {
        let error = HistoryTest::new("t", Loading::Uniaxial, &[[t, 1.1, 1.0]]);
        assert!(matches!(error, Err(FitError::TimeOutOfOrder { index: 0, .. })), "{error:?}");
    }
    let error = HistoryTest::new("t", Loading::Uniaxial, &[[0.0, 0.0, 1.0]]);
    assert!(matches!(error, Err(FitError::StretchNotPositive { value: 0.0, .. })));
    let error = HistoryTest::new("t", Loading::SimpleShear, &[[0.0, f64::NAN, 1.0]]);
    assert!(matches!(error, Err(FitError::StretchNotPositive { .. })));
    let error = HistoryTest::new("t", Loading::SimpleShear, &[[0.0, 0.0, f64::INFINITY]]);
    assert!(matches!(error, Err(FitError::StressNotFinite { index: 0, .. })));

    let test = HistoryTest::new("t", Loading::Uniaxial, &rows)?;
    let only = core::slice::from_ref(&test);
    let model = AnyHistoryModel::OgdenRoxburgh;
    let (start, options) = ([1.0, 2.0, 2.0, 1.0, 0.1], HistoryOptions::default());
    let fit =
        |tests: &[HistoryTest], start: &[f64], options: &HistoryOptions| fit_history(&model, tests, start, options);
    assert_eq!(fit(&[], &start, &options), Err(FitError::NoTests));
    let error = fit(&[test.clone(), test.clone()], &start, &options);
    assert!(matches!(error, Err(FitError::TestTwice { .. })));
    let error = fit(only, &start[..4], &options);
    assert!(matches!(error, Err(FitError::NumberOfValues { parameters: 5, values: 4, .. })));
    let error = fit(only, &start, &options);
    assert!(matches!(error, Err(FitError::TooFewPoints { points: 2, parameters: 5, .. })));
    let error = fit(only, &start, &options.clone().with_bounds("viscosity", [0.0, 1.0]));
    assert!(matches!(error, Err(FitError::UnknownParameter { .. })));
    let error = fit(only, &start, &options.clone().with_bounds("share", [1.0, 0.5]));
    assert!(matches!(error, Err(FitError::ImpossibleBounds { lower: 1.0, upper: 0.5, .. })));
    let mut certain = options.clone();
    certain.confidence = 1.0;
    assert_eq!(fit(only, &start, &certain), Err(FitError::ConfidenceOutOfRange { value: 1.0 }));
    let held =
        model.parameters()[2..].iter().fold(options, |options, (name, _, _)| options.with_bounds(name, [2.0; 2]));
    let error = fit(only, &[f64::NAN, 2.0, 2.0, 2.0, 2.0], &held);
    assert!(matches!(error, Err(FitError::Solids(_))), "{error:?}");
    assert!(matches!("maxwell".parse::<AnyHistoryModel>(), Err(FitError::UnknownHistoryModel { .. })));
    let error = model.stresses(&[1.0], &test, &StepControl::one_step());
    assert!(matches!(error, Err(FitError::NumberOfValues { parameters: 5, values: 1, .. })));

    // A model of one's own that forgets a row.
    let error = fit_history(&Forgetful, only, &[1.0], &HistoryOptions::default());
    assert_eq!(error, Err(FitError::WrongLength { quantity: "stresses of a model", expected: 2, found: 1 }));

    // A flow so fast that no step converges: the row is named, and where the increment ended.
    let far = HistoryTest::new("far", Loading::SimpleShear, &[[0.0, 0.5, 1.0], [1.0, 1e6, 1.0]])?;
    let error = AnyHistoryModel::BergstromBoyce.stresses(
        &[1.0, 5.0, 2.0, 8.0, 1e12, 1e-6, 12.0, -0.5, 1e-3],
        &far,
        &StepControl::default(),
    );
    let Err(FitError::NoHistory { index, error, .. }) = error else { return Err("a flow without an answer".into()) };
    assert!(index <= 1 && !matches!(*error, InelasticError::OutOfBounds { .. }), "{error}");
    Ok(())
}

/// In a hold the strain creeps by a millionth while the stress relaxes: that is no stiffness.
#[test]
fn starts_take_no_hold_for_a_secant_and_see_an_unloading_after_it() -> Fallible {
    let loaded = (1..6).map(f64::from).map(|k| [k, 0.1 * k, 0.2 * k]);
    let held = (1..6).map(f64::from).map(|k| [5.0 + k, 0.5 + 1e-6 * k, 1.0 - 0.1 * k]);
    let rows: Vec<[f64; 3]> = loaded.chain(held).collect();
    let load_and_hold = [HistoryTest::new("t", Loading::SimpleShear, &rows)?];
    for start in AnyHistoryModel::BergstromBoyce.starts(&load_and_hold) {
        // Secants are 2.
        assert!(0.6 < start[0] && start[0] < 2.1 && 0.6 < start[2] && start[2] < 2.1, "{start:?}");
    }
    let metal = |tests: &[HistoryTest]| AnyHistoryModel::Viscoplastic.starts(tests);
    let starts = metal(&load_and_hold);
    assert!((starts[1][0] / starts[0][0] - 2.0).abs() < 1e-12, "{starts:?}");
    let unloaded = [[6.0, 0.5, 0.9], [7.0, 0.4, 0.7], [8.0, 0.3, 0.5]];
    let rows: Vec<[f64; 3]> = rows[..5].iter().copied().chain(unloaded).collect();
    let starts = metal(&[HistoryTest::new("t", Loading::SimpleShear, &rows)?]);
    assert!((starts[1][0] / starts[0][0] - 1.0).abs() < 1e-12, "{starts:?}");
    Ok(())
}
