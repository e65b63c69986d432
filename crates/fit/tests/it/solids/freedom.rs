//! As many numbers as parameters, data that ask for no stiffness, and data that say nothing: each is said by name.

use piola_fit::FitError;
use piola_fit::solids::{
    AnyModel, Component, Criteria, Data, Fit, Measure, Options, Outcome, Stability, State, Table, Test, fit,
};
use piola_testkit::{Tol, assert_close};

fn of(table: Table) -> Data {
    Data::new(vec![Test::new("bar", table, Measure::FirstPiola).expect("a test")]).expect("data")
}

fn fitted(model: AnyModel, points: &[[f64; 2]]) -> Fit {
    fit(&model, &of(Table::Uniaxial(points.to_vec())), &Options::default()).expect("a fit")
}

/// P = 2 (λ − λ⁻²)(C₁₀ + C₀₁/λ) through two points has one solution and no error.
#[test]
fn as_many_numbers_as_parameters_leave_no_errors() {
    let [c10, c01] = [0.3, 0.1];
    let points = [1.5_f64, 2.0].map(|x| [x, 2.0 * (x - 1.0 / (x * x)) * (c10 + c01 / x)]);
    let found = fitted(AnyModel::MooneyRivlin, &points);
    let tolerance = Tol::stated(1e-13, "a system of two with a condition number of about 20");
    assert_close("parameters", &found.values(), &[c10, c01], tolerance);
    assert_eq!((found.degrees_of_freedom, &found.covariance), (0, &None));
    for estimate in &found.parameters {
        assert_eq!(estimate.state, State::NoDegreesOfFreedom);
        assert!(estimate.standard_error.is_none() && estimate.interval.is_none(), "{estimate:?}");
    }
    let Criteria { aic, aicc, bic } = found.criteria;
    assert_eq!((aic, aicc, bic), (None, None, None));
    let one = fitted(AnyModel::NeoHookean, &points[..1]);
    assert_eq!((one.parameters[0].state, &one.covariance), (State::NoDegreesOfFreedom, &None));
}

/// Two numbers at one stretch fix one sum of the two parameters: that stays undetermined, whatever the count.
#[test]
fn what_as_many_numbers_do_not_fix_is_undetermined() {
    let found = fitted(AnyModel::MooneyRivlin, &[[2.0, 0.9], [2.0, 1.1]]);
    assert!(found.parameters.iter().all(|parameter| parameter.state == State::Undetermined), "{:?}", found.parameters);
}

/// `AICc` takes 0 < m − K − 1 with K = k + 1, the others k < m.
#[test]
fn criteria_are_there_from_as_many_numbers_as_they_take() {
    for parameters in 1..5 {
        for points in 1..10 {
            let Criteria { aic, aicc, bic } = Criteria::new(points, parameters, 0.25);
            assert_eq!((aic.is_some(), bic.is_some()), (parameters < points, parameters < points));
            assert_eq!(aicc.is_some(), parameters + 2 < points, "{parameters} of {points}");
            assert!([aic, aicc, bic].into_iter().flatten().all(f64::is_finite));
        }
    }
}

/// Residuals that are all zero leave errors of zero, and correlations that are those of the slopes.
#[test]
fn correlations_of_an_exact_fit_are_numbers() {
    // 2 (λ − λ⁻²)(C₁₀ + C₀₁/λ) at λ = ½, 1, 2 with C₁₀ = C₀₁ = ½: −21/2, 0, 21/8.
    let points = [[0.5, -10.5], [1.0, 0.0], [2.0, 2.625], [2.0, 2.625]];
    let found = fitted(AnyModel::MooneyRivlin, &points);
    let covariance = found.covariance.expect("two degrees of freedom");
    // Columns a = 2 (λ − λ⁻²) and b = a/λ: ρ = −a·b/(|a| |b|).
    let rows = points.map(|[x, _]| 2.0 * (x - 1.0 / (x * x))).into_iter().zip(points.map(|[x, _]| x));
    let (mut aa, mut ab, mut bb) = (0.0, 0.0, 0.0);
    for (a, x) in rows {
        (aa, ab, bb) = (aa + a * a, ab + a * a / x, bb + a * a / (x * x));
    }
    let expected = -ab / (aa * bb).sqrt();
    let tolerance = Tol::stated(1e-12, "an inverse of two columns that are all but parallel, ρ = −0.98");
    assert_close("correlation", &covariance.correlation().concat(), &[1.0, expected, expected, 1.0], tolerance);
}

/// Stresses of the wrong sign ask for μ < 0: at μ = 0 all stresses are finite, and the bound is what stops the fit.
#[test]
fn stresses_against_the_stretches_end_at_no_stiffness() {
    let points = [[1.1, -0.1], [1.5, -0.2], [2.0, -0.3], [3.0, -0.2], [3.5, -0.2]];
    for name in ["neo-hookean", "mooney-rivlin", "gent", "arruda-boyce", "ogden:2"] {
        let found = fitted(name.parse().expect("a model"), &points);
        assert_eq!(found.outcome, Outcome::NoStiffness, "{name}");
        assert!(!found.outcome.is_converged() && !found.stability.is_stable(), "{name}");
        for estimate in found.parameters.iter().filter(|estimate| estimate.is_stress) {
            assert!(estimate.state == State::AtBound && estimate.value.abs() <= 0.0, "{name}: {estimate:?}");
        }
        assert!(found.tests[0].residuals.iter().all(|x| x.is_finite()), "{name}");
    }
    // What may be unstable follows the data: μ = Σ a P/Σ a², a = λ − λ⁻².
    let free = Options { stability: Stability::Free, ..Options::default() };
    let found = fit(&AnyModel::NeoHookean, &of(Table::Uniaxial(points.to_vec())), &free).expect("a fit");
    let slope = |x: f64| x - 1.0 / (x * x);
    let (above, below) =
        points.iter().fold((0.0, 0.0), |(ap, aa), [x, p]| (ap + slope(*x) * p, aa + slope(*x).powi(2)));
    assert_eq!(found.outcome, Outcome::LinearSolution);
    let tolerance = Tol::stated(1e-14, "a quotient of two sums of five");
    assert_close("μ", &found.values(), &[above / below], tolerance);
}

/// At rest every law has the same stresses, whatever was measured there.
#[test]
fn data_in_which_nothing_is_deformed_are_refused_with_their_stretch() {
    let turned = [[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]];
    let component = Component { deformation: turned, component: [0, 0], free: 2, stress: 0.1 };
    let tables = [
        (Table::Uniaxial(vec![[1.0, 0.0], [1.0, 0.1], [1.0, 0.0]]), 1.0),
        (Table::Equibiaxial(vec![[1.0, 0.0]]), 1.0),
        (Table::SimpleShear(vec![[0.0, 0.3]]), 0.0),
        (Table::General(vec![component]), 1.0),
    ];
    for (table, stretch) in tables {
        for model in [AnyModel::NeoHookean, AnyModel::Gent, AnyModel::Yeoh] {
            let error = fit(&model, &of(table.clone()), &Options::default()).expect_err("at rest");
            let FitError::NothingDeformed { test, value } = &error else { panic!("{error}") };
            assert!(test == "bar" && (value - stretch).abs() <= 1e-15, "{error}");
            assert!(error.to_string().ends_with("the data say nothing of the parameters"), "{error}");
        }
    }
    // One point that is deformed is enough to be asked about.
    assert!(
        fit(&AnyModel::NeoHookean, &of(Table::Uniaxial(vec![[1.0, 0.0], [1.1, 0.3]])), &Options::default()).is_ok()
    );
}
