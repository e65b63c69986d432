//! Treloar's rubber: three modes at once.

use std::path::Path;

use piola_fit::solids::{AnyModel, Data, Fit, Fitted, Measure, Options, Stability, State, Table, Test, fit};
use piola_specimens::homogeneous::{Mode, first_piola};
use piola_testkit::{Tol, assert_close};

/// (stretch, stress) of the rows of a mode, from the columns F11 and S11.
fn rows(text: &str, label: &str) -> Vec<[f64; 2]> {
    let number = |text: &str| text.parse::<f64>().expect("a number");
    text.lines()
        .filter(|line| line.starts_with(label))
        .map(|line| line.split(',').collect::<Vec<_>>())
        .map(|fields| [number(fields[2]), number(fields[11])])
        .collect()
}

fn treloar() -> Data {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/rubber/treloar-1944.csv");
    let text = std::fs::read_to_string(path).expect("the data");
    let test = |label, name, mode| {
        Test::new(name, Table::of_mode(mode, rows(&text, label)), Measure::FirstPiola).expect("a test")
    };
    Data::new(vec![
        test("UT", "uniaxial", Mode::Uniaxial),
        test("ET", "equibiaxial", Mode::Equibiaxial),
        test("PS", "planar", Mode::Planar),
    ])
    .expect("the data")
}

fn fitted(name: &str, options: &Options) -> Fit {
    let model: AnyModel = name.parse().expect("a model");
    fit(&model, &treloar(), options).expect("a fit")
}

#[test]
fn three_terms_of_ogden_fit_all_modes_within_three_percent_of_the_largest_stress() {
    let fit = fitted("ogden:3", &Options::default());
    assert!(fit.outcome.is_converged() && fit.stability.is_stable(), "{fit:?}");
    for test in &fit.tests {
        assert!(test.relative_rms <= 0.03, "{}: {}", test.test, test.relative_rms);
    }
    assert!(fit.parameters.iter().all(|parameter| parameter.state == State::Determined));
    for term in fit.values().chunks_exact(2) {
        assert!(0.0 < term[0] * term[1], "{term:?}");
    }
}

#[test]
fn search_with_elimination_equals_the_minimum_of_an_independent_search() {
    // Trust-region reflective search of SciPy 1.17 over the exponents from forty random starts, factors by NNLS.
    let fit = fitted("ogden:3", &Options::default());
    let half_of_squares = 0.005_439_985_139_053_45;
    assert_close(
        "S/2",
        &[0.5 * fit.weighted_squares],
        &[half_of_squares],
        Tol::stated(1e-6, "digits of the other search"),
    );
}

#[test]
fn richer_laws_have_smaller_residuals() {
    let squares =
        |name: &str| fitted(name, &Options { stability: Stability::Free, ..Options::default() }).weighted_squares;
    let [one, two, three] = ["ogden:1", "ogden:2", "ogden:3"].map(squares);
    assert!(three < two && two < one, "{one} {two} {three}");
    assert!(squares("mooney-rivlin") <= squares("neo-hookean"));
    assert!(squares("polynomial:2") <= squares("mooney-rivlin"));
    assert!(squares("yeoh") <= squares("neo-hookean"));
}

#[test]
fn every_law_that_must_be_stable_is() {
    for name in ["neo-hookean", "mooney-rivlin", "yeoh", "gent", "arruda-boyce", "polynomial:2", "ogden:1", "ogden:2"] {
        let fit = fitted(name, &Options::default());
        assert!(fit.stability.is_stable(), "{name}: {:?} {:?}", fit.stability, fit.outcome);
        assert!(fit.outcome.is_converged(), "{name}: {:?}", fit.outcome);
    }
}

#[test]
fn stable_polynomial_differs_from_the_unstable_best() {
    let name = "polynomial:3";
    let free = fitted(name, &Options { stability: Stability::Free, ..Options::default() });
    let held = fitted(name, &Options::default());
    assert!(!free.stability.is_stable(), "{:?}", free.stability);
    assert!(held.stability.is_stable(), "{:?}", held.stability);
    assert!(free.weighted_squares < held.weighted_squares);
}

#[test]
fn bounds_hold_and_the_parameter_says_so() {
    let bounds = vec![("C10".to_owned(), [0.2, 0.25]), ("C01".to_owned(), [0.01, 1.0])];
    let fit = fitted("mooney-rivlin", &Options { bounds, ..Options::default() });
    for (parameter, [low, high]) in fit.parameters.iter().zip([[0.2, 0.25], [0.01, 1.0]]) {
        assert!(low <= parameter.value && parameter.value <= high, "{parameter:?}");
    }
    assert!(fit.parameters.iter().any(|parameter| parameter.state == State::AtBound), "{:?}", fit.parameters);
}

#[test]
fn weight_of_a_mode_lowers_its_residual() {
    let even = fitted("gent", &Options::default());
    let tests = treloar().tests().to_vec();
    let heavy = tests
        .into_iter()
        .enumerate()
        .map(|(index, test)| test.with_weight(if index == 1 { 10.0 } else { 1.0 }).expect("a weight"));
    let data = Data::new(heavy.collect()).expect("the data");
    let uneven = fit(&AnyModel::Gent, &data, &Options::default()).expect("a fit");
    assert!(uneven.tests[1].rms < even.tests[1].rms);
}

/// What `SciPy` 1.17 finds from sixty random starts: `benches/peers/rubber_fits.py`.
const OPTIMA: [(&str, f64); 4] = [
    ("carroll", 8.148_152_889_854_581e-3),
    ("lopez-pamies", 7.910_837_352_902_754e-2),
    ("van-der-waals", 2.711_023_127_854_615e-2),
    ("extended-tube", 7.439_197_233_055_826e-3),
];

#[test]
fn laws_of_rubber_reach_the_optimum_of_an_independent_search() -> Result<(), Box<dyn core::error::Error>> {
    for (name, squares) in OPTIMA {
        let found = fitted(name, &Options::default());
        assert!(found.outcome.is_converged() && found.stability.is_stable(), "{name}: {found:?}");
        let tolerance = Tol::stated(1e-12, "digits of the other search");
        assert_close(name, &[found.weighted_squares], &[squares], tolerance);
        let law = found.law()?;
        // The law that is handed over has the stresses of the fit.
        let stress: f64 = first_piola(Mode::Uniaxial, 2.0, &law);
        let model: AnyModel = name.parse()?;
        let expected: f64 = first_piola(Mode::Uniaxial, 2.0, &Fitted::new(&model, found.values())?);
        assert_close(name, &[stress], &[expected], Tol::ulps(64.0));
    }
    Ok(())
}
