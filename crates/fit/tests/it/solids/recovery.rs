//! Known parameters from made data with seeded errors.

use piola_fit::solids::{AnyModel, Data, Fitted, Measure, Model, Options, Parameter, Stability, Table, Test, fit};
use piola_numerics::Real;
use piola_specimens::homogeneous::{Mode, first_piola};
use piola_testkit::{Tol, assert_close};

const TRIALS: u64 = 200;

/// Normal numbers from a seed: the sum of twelve uniform ones less six.
struct Errors(u64);

impl Errors {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let high = u32::try_from(self.0 >> 32).expect("32 bits");
        (f64::from(high) + 0.5) / 4_294_967_296.0
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

/// Tests in three modes with errors that are a part of each mode's largest stress.
fn made(model: &AnyModel, parameters: &[f64], error: f64, seed: u64) -> Data {
    let law = Fitted::new(model, parameters.iter().copied()).expect("as many");
    let mut errors = Errors(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let test = |(mode, largest): (Mode, f64)| {
        let count = 20;
        let stretches: Vec<f64> =
            (1..=count).map(|k| 1.0 + (largest - 1.0) * f64::from(k) / f64::from(count)).collect();
        let stresses: Vec<f64> = stretches.iter().map(|stretch| first_piola(mode, *stretch, &law)).collect();
        let scale = error * stresses.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let points = stretches.iter().zip(&stresses).map(|(x, p)| [*x, p + scale * errors.normal()]).collect();
        Test::new(mode.name(), Table::of_mode(mode, points), Measure::FirstPiola).expect("a test")
    };
    let modes = [(Mode::Uniaxial, 5.0), (Mode::Equibiaxial, 3.0), (Mode::Planar, 4.0)];
    Data::new(modes.map(test).into()).expect("the data")
}

fn known() -> Vec<(AnyModel, Vec<f64>)> {
    let laws: [(&str, &[f64]); 8] = [
        ("neo-hookean", &[0.4e6]),
        ("mooney-rivlin", &[0.16e6, 0.02e6]),
        ("yeoh", &[0.17e6, -1.0e3, 50.0]),
        ("gent", &[0.3e6, 60.0]),
        ("arruda-boyce", &[0.28e6, 20.0]),
        ("polynomial:2", &[0.15e6, 0.01e6, 2.0e3, 200.0, 30.0]),
        ("ogden:1", &[0.3e6, 2.4]),
        ("ogden:2", &[0.01e6, 4.5, 0.5e6, 1.4]),
    ];
    laws.map(|(name, parameters)| (name.parse().expect("a model"), parameters.to_vec())).into()
}

#[test]
fn parameters_from_exact_stresses_equal_those_that_made_them() {
    for (model, parameters) in known() {
        let fit = fit(&model, &made(&model, &parameters, 0.0, 1), &Options::default()).expect("a fit");
        assert!(fit.outcome.is_converged(), "{model}: {:?}", fit.outcome);
        let tolerance = Tol::stated(1e-7, "root of the rounding of the squares, through the condition of the law");
        for (found, made) in fit.values().iter().zip(&parameters) {
            assert_close(&model.to_string(), &[*found], &[*made], tolerance);
        }
    }
}

#[test]
fn known_parameters_are_inside_their_intervals_in_nine_of_ten_trials() {
    for (model, parameters) in known() {
        let options = Options { stability: Stability::Free, ..Options::default() };
        let mut inside = vec![0_u64; parameters.len()];
        for seed in 0..TRIALS {
            let fit = fit(&model, &made(&model, &parameters, 0.01, seed), &options).expect("a fit");
            for ((count, estimate), known) in inside.iter_mut().zip(&fit.parameters).zip(&parameters) {
                *count += u64::from(estimate.interval.is_some_and(|[low, high]| low <= *known && *known <= high));
            }
        }
        // Of 200 trials at 95 % 190 ± 3: intervals twice as wide or half as wide would be seen.
        let expected = TRIALS * 9 / 10..=TRIALS * 99 / 100;
        assert!(inside.iter().all(|count| expected.contains(count)), "{model}: {inside:?} of {TRIALS}");
    }
}

#[test]
fn criterion_chooses_the_law_that_made_the_data() {
    let model: AnyModel = "ogden:2".parse().expect("a model");
    let data = made(&model, &[0.01e6, 4.5, 0.5e6, 1.4], 0.01, 7);
    let aicc = |name: &str| {
        let other: AnyModel = name.parse().expect("a model");
        fit(&other, &data, &Options::default()).expect("a fit").criteria.aicc.expect("enough points")
    };
    let best = aicc("ogden:2");
    for other in ["neo-hookean", "mooney-rivlin", "yeoh", "gent", "arruda-boyce", "ogden:1", "ogden:3"] {
        assert!(best < aicc(other), "{other}");
    }
}

#[test]
fn fits_in_pascal_and_megapascal_agree() {
    let model: AnyModel = "ogden:2".parse().expect("a model");
    let [small, large] = [1.0, 1e6].map(|unit| {
        let data = made(&model, &[0.01 * unit, 4.5, 0.5 * unit, 1.4], 0.01, 3);
        fit(&model, &data, &Options::default()).expect("a fit")
    });
    let tolerance = Tol::stated(1e-6, "two searches for the same minimum");
    assert_close(
        "exponents",
        &[large.values()[1], large.values()[3]],
        &[small.values()[1], small.values()[3]],
        tolerance,
    );
    let [small, large] = [small, large].map(|found| found.criteria.bic.expect("more numbers than parameters"));
    assert_close("criterion", &[large], &[small], tolerance);
}

#[test]
fn two_runs_are_the_same_to_the_last_bit() {
    let model: AnyModel = "ogden:3".parse().expect("a model");
    let data = made(&model, &[0.63e6, 1.3, 1.2e3, 5.0, -1e4, -2.0], 0.01, 5);
    let run = || fit(&model, &data, &Options::default()).expect("a fit");
    assert_eq!(run(), run());
    assert_eq!(model.name(), "ogden:3");
}

/// W = c (λ₁ᵃ + λ₂ᵃ + λ₃ᵃ), a ≤ −½.
struct NegativePower;

impl Model for NegativePower {
    fn name(&self) -> String {
        "negative power".into()
    }
    fn parameters(&self, _largest_first_invariant: f64) -> Vec<Parameter> {
        vec![Parameter::factor("c"), Parameter::number("a", [f64::NEG_INFINITY, -0.5])]
    }
    fn energy<T: Real>(&self, stretches: [T; 3], parameters: &[T]) -> T {
        let [x, y, z] = stretches.map(|stretch| (parameters[1] * stretch.ln()).exp());
        parameters[0] * (x + y + z)
    }
    fn starts(&self, _largest_first_invariant: f64) -> Vec<Vec<f64>> {
        vec![vec![-1.0], vec![-6.0]]
    }
}

#[test]
fn a_number_with_an_upper_bound_alone_is_found() {
    let (factor, exponent) = (0.5, -2.5);
    // P = c a (λ^(a − 1) − λ^(−a/2 − 1)) of a bar.
    let stress = |x: f64| factor * exponent * (x.powf(exponent - 1.0) - x.powf(-0.5 * exponent - 1.0));
    let points = (1..=12).map(|k| 1.0 + 0.25 * f64::from(k)).map(|x| [x, stress(x)]).collect();
    let bar = Test::new("bar", Table::Uniaxial(points), Measure::FirstPiola).expect("a test");
    let options = Options { stability: Stability::Free, ..Options::default() };
    let fit = fit(&NegativePower, &Data::new(vec![bar]).expect("data"), &options).expect("a fit");
    assert!(fit.outcome.is_converged(), "{:?}", fit.outcome);
    assert_close(
        "c, a",
        &fit.values(),
        &[factor, exponent],
        Tol::stated(1e-8, "the root of the rounding of the squares"),
    );
    assert_eq!(fit.starts_that_agree, 2);
}
