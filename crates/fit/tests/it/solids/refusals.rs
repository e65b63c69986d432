//! What cannot be fitted is refused by name.

use piola_fit::FitError;
use piola_fit::solids::{
    AnyModel, Component, Data, Fitted, Measure, Model, Options, Outcome, Parameter, StableSign, State, Table, Test, fit,
};
use piola_numerics::Real;

fn bar(points: Vec<[f64; 2]>) -> Result<Test, FitError> {
    Test::new("bar", Table::Uniaxial(points), Measure::FirstPiola)
}

fn data(count: u32) -> Data {
    let points = (1..=count).map(|k| 1.0 + 0.1 * f64::from(k)).map(|x| [x, x - 1.0 / (x * x)]).collect();
    Data::new(vec![bar(points).expect("a test")]).expect("data")
}

fn sentence<T: core::fmt::Debug>(result: Result<T, FitError>) -> String {
    result.expect_err("refused").to_string()
}

#[test]
fn impossible_tests_are_refused_with_their_point() {
    assert_eq!(sentence(bar(vec![])), "test `bar` has no points");
    assert_eq!(
        sentence(bar(vec![[1.0, 0.0], [0.0, 1.0]])),
        "test `bar`, point 1: the stretch 0 is not positive and finite"
    );
    assert_eq!(sentence(bar(vec![[1.0, f64::NAN]])), "test `bar`, point 0: the stress NaN is not finite");
    let good = bar(vec![[1.5, 1.0]]).expect("a test");
    assert_eq!(sentence(good.clone().with_weight(0.0)), "test `bar`: the weight 0 is not positive and finite");
    assert_eq!(sentence(Data::new(vec![])), "there is no test to fit to");
    assert_eq!(sentence(Data::new(vec![good.clone(), good])), "two tests are called `bar`");
    let component = |deformation, free| Component { deformation, component: [0, 0], free, stress: 1.0 };
    let general = |point| Test::new("sheet", Table::General(vec![point]), Measure::FirstPiola);
    let swollen = component([[2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], 2);
    assert_eq!(
        sentence(general(swollen)),
        "test `sheet`, point 0: det F = 2, but it must be 1 for an incompressible material"
    );
    let outside = component([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], 3);
    assert_eq!(sentence(general(outside)), "test `sheet`, point 0: there is no axis 3; the axes are 0, 1 and 2");
}

#[test]
fn impossible_models_and_options_are_refused() {
    assert!(sentence("odgen:3".parse::<AnyModel>()).starts_with("no model is called `odgen:3`"));
    assert_eq!(sentence("ogden:9".parse::<AnyModel>()), "the number of terms of a series is 9; it must be 1 to 6");
    let ogden: AnyModel = "ogden:3".parse().expect("a model");
    assert_eq!(
        sentence(fit(&ogden, &data(5), &Options::default())),
        "ogden:3: too few measured points (5) for the number of parameters (6)"
    );
    let with = |name: &str, bounds| Options { bounds: vec![(name.to_owned(), bounds)], ..Options::default() };
    let gent = |options: &Options| sentence(fit(&AnyModel::Gent, &data(20), options));
    assert_eq!(gent(&with("kappa", [0.0, 1.0])), "gent has no parameter `kappa`");
    // A limit of extensibility below what was measured: I₁ − 3 = 9 + 2/3 − 3.
    assert!(
        gent(&with("Jm", [0.0, 5.0])).starts_with("gent: no value of `Jm` is at least 6.66"),
        "{}",
        gent(&with("Jm", [0.0, 5.0]))
    );
    let chains = sentence(fit(&AnyModel::ArrudaBoyce, &data(20), &with("N", [1.0, 3.0])));
    assert!(chains.starts_with("arruda-boyce: no value of `N` is at least 3.2"), "{chains}");
    assert!(gent(&with("mu", [2.0, 1.0])).contains("no value of `mu`"));
    assert!(gent(&with("mu", [f64::NAN, 1.0])).contains("no value of `mu`"));
    assert_eq!(gent(&Options { confidence: 1.0, ..Options::default() }), "the confidence 1 is not between 0 and 1");
    // No factor has both the sign of its exponent and the bounds asked for.
    let ogden: AnyModel = "ogden:1".parse().expect("a model");
    let bounds = vec![("mu1".to_owned(), [-2.0, -1.0]), ("alpha1".to_owned(), [1.0, 3.0])];
    let contradiction = fit(&ogden, &data(20), &Options { bounds, ..Options::default() });
    assert_eq!(
        sentence(contradiction),
        "ogden:1: no starting point of the search has finite answers within the bounds"
    );
}

/// Stresses beyond a limiting stretch are no numbers: a model asked there has no start, and a fit stays below.
#[test]
fn stretches_beyond_a_limit_have_no_stress_and_no_fit_ends_there() {
    use piola_specimens::homogeneous::{Mode, first_piola};
    for (model, parameters) in [(AnyModel::Gent, [1.0, 3.0]), (AnyModel::ArrudaBoyce, [1.0, 2.0])] {
        let law = Fitted::new(&model, parameters).expect("as many");
        assert!(first_piola(Mode::Uniaxial, 2.0_f64, &law).is_finite());
        assert!(first_piola(Mode::Uniaxial, 3.0_f64, &law).is_nan());
        let found = fit(&model, &data(20), &Options::default()).expect("a fit");
        let reach = data(20).largest_first_invariant();
        let limit = if model == AnyModel::Gent { found.values()[1] + 3.0 } else { 3.0 * found.values()[1] };
        assert!(reach < limit && found.tests[0].rms.is_finite(), "{model}: {limit} {reach}");
    }
}

/// A neo-Hookean solid with parameters as they come.
struct Given(Vec<Parameter>);

impl Model for Given {
    fn name(&self) -> String {
        "given".into()
    }
    fn parameters(&self, _largest_first_invariant: f64) -> Vec<Parameter> {
        self.0.clone()
    }
    fn energy<T: Real>(&self, [a, b, c]: [T; 3], parameters: &[T]) -> T {
        parameters.iter().fold(T::zero(), |sum, &x| sum + x) * (a * a + b * b + c * c)
    }
    fn starts(&self, _largest_first_invariant: f64) -> Vec<Vec<f64>> {
        vec![vec![1.0]]
    }
}

#[test]
fn impossible_models_of_ones_own_are_refused() {
    let given = |parameters: Vec<Parameter>| fit(&Given(parameters), &data(20), &Options::default());
    for bounds in [[1.0, 0.0], [f64::NAN, 1.0], [0.0, f64::NAN], [f64::INFINITY, f64::INFINITY]] {
        let error = given(vec![Parameter::number("x", bounds)]).expect_err("no number is between");
        assert!(matches!(error, FitError::ImpossibleBounds { .. }), "{bounds:?}: {error}");
    }
    let signed = |index| Parameter::factor("mu").stable_if(StableSign::SameAs(index));
    for index in [0, 1, 99] {
        let parameters = vec![signed(index), Parameter::factor("nu"), Parameter::number("x", [0.0, 1.0])];
        let error = given(parameters).expect_err("no such parameter, or a factor");
        let (model, parameter) = ("given".to_owned(), "mu".to_owned());
        assert_eq!(error, FitError::NoSuchSign { model, parameter, index });
    }
    assert!(given(vec![signed(1), Parameter::number("x", [0.0, 1.0])]).is_ok());
    for values in [vec![], vec![1.0], vec![1.0; 3]] {
        let count = values.len();
        let error = Fitted::new(&AnyModel::Gent, values).expect_err("two parameters");
        assert_eq!(error.to_string(), format!("gent: the number of parameter values is {count}; it must be 2"));
    }
    let patient = Options { patience: usize::MAX, ..Options::default() };
    assert!(fit(&AnyModel::Gent, &data(20), &patient).is_ok());
}

#[test]
fn stresses_that_are_all_zero_are_those_of_no_stiffness() {
    let zero: Vec<[f64; 2]> = (1..=12).map(|k| [1.0 + 0.1 * f64::from(k), 0.0]).collect();
    let data = Data::new(vec![bar(zero).expect("a test")]).expect("data");
    let names = ["neo-hookean", "mooney-rivlin", "yeoh", "gent", "arruda-boyce", "polynomial:2", "ogden:2"];
    for name in names {
        let model: AnyModel = name.parse().expect("a model");
        let found = fit(&model, &data, &Options::default()).expect("a fit");
        assert!(found.outcome.is_converged(), "{name}: {:?}", found.outcome);
        assert!(found.weighted_squares <= 0.0 && found.worst_relative_rms() <= 0.0, "{name}: {found:?}");
    }
}

#[test]
fn stretches_at_which_no_law_has_a_stress_are_refused_with_their_point() {
    let error = bar(vec![[1.5, 1.0], [1e200, 1.0]]).expect_err("beyond");
    assert!(matches!(error, FitError::StretchOutOfRange { index: 1, .. }), "{error}");
    assert!(bar(vec![[1e-200, 1.0]]).is_err());
    let sheared = |k| Test::new("block", Table::SimpleShear(vec![[k, 0.0]]), Measure::FirstPiola);
    assert!(sheared(0.0).is_ok() && sheared(-1e-200).is_ok() && sheared(1e200).is_err());
}

#[test]
fn search_without_patience_keeps_the_best_that_it_had() {
    let ogden: AnyModel = "ogden:2".parse().expect("a model");
    let mut points: Vec<[f64; 2]> = (1..=20).map(|k| 1.0 + 0.2 * f64::from(k)).map(|x| [x, x.ln()]).collect();
    points[7][1] *= 1.3;
    let data = Data::new(vec![bar(points).expect("a test")]).expect("data");
    let hasty = fit(&ogden, &data, &Options { patience: 1, ..Options::default() }).expect("the best");
    let patient = fit(&ogden, &data, &Options::default()).expect("a fit");
    assert_eq!(hasty.outcome, Outcome::OutOfPatience);
    assert!(hasty.values().iter().all(|x| x.is_finite()));
    assert!(patient.weighted_squares <= hasty.weighted_squares && hasty.worst_relative_rms() < 0.5);
}

#[test]
fn parameters_that_data_cannot_tell_apart_have_no_error() {
    // At one stretch of a bar only C₁₀ + C₀₁/λ shows.
    let points = [0.9, 1.0, 1.1].map(|stress| [2.0, stress]).to_vec();
    let data = Data::new(vec![bar(points).expect("a test")]).expect("data");
    let fit = fit(&AnyModel::MooneyRivlin, &data, &Options::default()).expect("a fit");
    assert!(fit.parameters.iter().all(|parameter| parameter.standard_error.is_none()), "{:?}", fit.parameters);
}

#[test]
fn limit_of_extensibility_that_no_datum_shows_is_undetermined() {
    // Stresses of a neo-Hookean bar, less and less of them at large stretches: every large limit serves.
    let softening = |x: f64| (x - 1.0 / (x * x)) * (1.0 - 0.01 * (x - 1.0));
    let points = (1..=20).map(|k| 1.0 + 0.1 * f64::from(k)).map(|x| [x, softening(x)]).collect();
    let data = Data::new(vec![bar(points).expect("a test")]).expect("data");
    let fit = fit(&AnyModel::Gent, &data, &Options::default()).expect("a fit");
    let [modulus, limit] = [&fit.parameters[0], &fit.parameters[1]];
    assert!((modulus.value - 1.0).abs() < 0.02 && modulus.state == State::Determined, "{modulus:?}");
    assert!(1e3 < limit.value && limit.state == State::Undetermined && limit.interval.is_none(), "{limit:?}");
}

#[cfg(feature = "serde")]
#[test]
fn written_tests_are_checked_when_they_are_read() {
    let data = data(3);
    let text = serde_json::to_string(&data).expect("text");
    assert_eq!(serde_json::from_str::<Data>(&text).expect("data"), data);
    // The name that this measure had in older files.
    let old = text.replace("first_piola", "nominal");
    assert_ne!(old, text);
    assert_eq!(serde_json::from_str::<Data>(&old).expect("data"), data);
    let wrong = text.replacen("1.1", "-1.1", 1);
    assert!(
        serde_json::from_str::<Data>(&wrong).expect_err("refused").to_string().contains("point 0: the stretch -1.1")
    );
    let unknown = text.replacen("\"name\"", "\"title\"", 1);
    assert!(serde_json::from_str::<Data>(&unknown).is_err());
    assert_eq!(serde_json::from_str::<AnyModel>("\"ogden:3\"").expect("a model"), "ogden:3".parse().expect("a model"));
}
