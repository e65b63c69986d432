//! Models and laws, modes and components: two ways to the same stress.

use piola_fit::solids::{AnyModel, Component, Data, Fitted, Measure, Model, Options, Table, Test, fit};
use piola_solids::volumetric::SimoTaylor;
use piola_specimens::homogeneous::{IncompressibleState, Mode, first_piola};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

/// A model of each kind, with parameters.
fn models() -> Vec<(String, Vec<f64>)> {
    let mut models: Vec<(String, Vec<f64>)> = vec![
        ("neo-hookean".into(), vec![0.4]),
        ("mooney-rivlin".into(), vec![0.2, 0.05]),
        ("yeoh".into(), vec![0.17, -1e-3, 5e-5]),
        ("gent".into(), vec![0.3, 60.0]),
        ("arruda-boyce".into(), vec![0.28, 20.0]),
    ];
    for n in 1_i32..=6 {
        // Factors that fall with the degree, so that no term is lost beside another.
        let factors = (1..=n).flat_map(|degree| (0..=degree).map(move |j| (degree, j)));
        let factor = |(degree, j): (i32, i32)| 0.2 * 0.05_f64.powi(degree - 1) * if j % 2 == 0 { 1.0 } else { 0.3 };
        models.push((format!("polynomial:{n}"), factors.map(factor).collect()));
        let terms = [[0.63, 1.3], [0.0012, 5.0], [-0.01, -2.0], [0.1, 2.0], [-0.2, -0.7], [0.3, 0.5]];
        models.push((
            format!("ogden:{n}"),
            terms.iter().take(usize::try_from(n).expect("a count")).flatten().copied().collect(),
        ));
    }
    models
}

#[test]
fn terms_of_a_polynomial_are_all_of_its_degrees() {
    let model: AnyModel = "polynomial:3".parse().expect("a model");
    let names: Vec<_> = model.parameters(10.0).into_iter().map(|parameter| parameter.name).collect();
    assert_eq!(names, ["C10", "C01", "C20", "C11", "C02", "C30", "C21", "C12", "C03"]);
    // Σ Cᵢⱼ (I − 3)ⁱ (II − 3)ʲ at the stretches 2, 1, ½: I = II = 21/4.
    let factors = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
    let x: f64 = 2.25;
    let expected = 3.0 * x + 12.0 * x * x + 30.0 * x.powi(3);
    assert_close("W", &[model.energy([2.0, 1.0, 0.5], &factors)], &[expected], Tol::ulps(4.0));
}

#[test]
fn laws_of_every_model_answer_as_the_model() {
    let tolerance = Tol::stated(1e-12, "an energy of stretches and a closed form, of the moduli");
    for (name, parameters) in models() {
        let model: AnyModel = name.parse().expect("a model");
        let fitted = Fitted::new(&model, parameters.iter().copied()).expect("as many");
        let law = model.law(&parameters).expect("a law");
        let solid = model.compressible(&parameters, SimoTaylor::new(3.0).expect("κ")).expect("a law");
        for mode in Mode::ALL {
            for away in [-0.4, -1e-6, 1e-9, 1e-3, 0.3, 1.0, 2.5] {
                let stretch = mode.rest() + away;
                let expected = first_piola(mode, stretch, &fitted);
                let what = format!("{name}, {}, {stretch}", mode.name());
                for law in [&law, &solid] {
                    assert_close_at_scale(&what, &[first_piola(mode, stretch, law)], &[expected], 1.0, tolerance);
                }
                let state = IncompressibleState::of(&law, mode, stretch).expect("a state");
                let place = if mode == Mode::SimpleShear { (1, 0) } else { (0, 0) };
                assert_close_at_scale(&what, &[state.first_piola.0[place]], &[expected], 1.0, tolerance);
            }
        }
        let wrong = model.law(&parameters[1..]).expect_err("too few").to_string();
        assert!(wrong.contains("the number of parameter values is"), "{wrong}");
    }
}

#[test]
fn law_of_a_fit_answers_as_the_fit() {
    let stretches: Vec<f64> = (1..=12).map(|k| 1.0 + 0.25 * f64::from(k)).collect();
    let bar = Table::Uniaxial(stretches.iter().map(|&x| [x, 0.4 * (x - 1.0 / (x * x))]).collect());
    let data = Data::new(vec![Test::new("bar", bar, Measure::FirstPiola).expect("a test")]).expect("data");
    for name in AnyModel::NAMES.map(|name| name.replace(":n", ":2")) {
        let model: AnyModel = name.parse().expect("a model");
        let found = fit(&model, &data, &Options::default()).expect("a fit");
        let law = match found.law() {
            Ok(law) => law,
            // A term that the data do not need may have an exponent or modulus that a law refuses by name.
            Err(error) => panic!("{name}: {error} {:?}", found.values()),
        };
        let fitted = Fitted::new(&model, found.values()).expect("as many");
        for &stretch in &stretches {
            let expected = first_piola(Mode::Uniaxial, stretch, &fitted);
            let actual = first_piola(Mode::Uniaxial, stretch, &law);
            assert_close(&name, &[actual], &[expected], Tol::stated(1e-12, "an energy of stretches and a closed form"));
        }
    }
}

#[test]
fn fit_to_components_equals_fit_to_the_mode() {
    let stretches: Vec<f64> = (1..=12).map(|k| 1.0 + 0.25 * f64::from(k)).collect();
    let stress = |x: f64| 0.4 * (x - 1.0 / (x * x)) + 0.01 * (7.0 * x).sin();
    let bar = Table::Uniaxial(stretches.iter().map(|x| [*x, stress(*x)]).collect());
    // The same bar along the second axis, turned by 90° about the third, as Cauchy stress T₁₁ = λ P.
    let turned = stretches
        .iter()
        .map(|&x| {
            let across = 1.0 / x.sqrt();
            let deformation = [[0.0, -x, 0.0], [across, 0.0, 0.0], [0.0, 0.0, across]];
            Component { deformation, component: [0, 0], free: 2, stress: x * stress(x) }
        })
        .collect();
    let model: AnyModel = "ogden:1".parse().expect("a model");
    let run = |table, measure| {
        let data = Data::new(vec![Test::new("bar", table, measure).expect("a test")]).expect("data");
        fit(&model, &data, &Options::default()).expect("a fit")
    };
    let cauchy = Table::Uniaxial(stretches.iter().map(|x| [*x, x * stress(*x)]).collect());
    let (by_mode, by_component) = (run(cauchy, Measure::Cauchy), run(Table::General(turned), Measure::Cauchy));
    let tolerance = Tol::stated(1e-7, "two searches for the same minimum");
    assert_close("parameters", &by_component.values(), &by_mode.values(), tolerance);
    assert!(run(bar, Measure::FirstPiola).values() != by_mode.values(), "other weights");
}

#[test]
fn shear_of_a_component_equals_simple_shear() {
    let amounts: Vec<f64> = (1..=8).map(|k| 0.25 * f64::from(k)).collect();
    let stress = |k: f64| 0.8 * k + 0.02 * k * k * k;
    let model: AnyModel = "yeoh".parse().expect("a model");
    let mode = Table::SimpleShear(amounts.iter().map(|k| [*k, stress(*k)]).collect());
    // P₂₁ with F = 1 + k e₂ ⊗ e₁.
    let components = amounts
        .iter()
        .map(|&k| {
            let deformation = [[1.0, 0.0, 0.0], [k, 1.0, 0.0], [0.0, 0.0, 1.0]];
            Component { deformation, component: [1, 0], free: 2, stress: stress(k) }
        })
        .collect();
    let run = |table| {
        let data = Data::new(vec![Test::new("block", table, Measure::FirstPiola).expect("a test")]).expect("data");
        fit(&model, &data, &Options::default()).expect("a fit")
    };
    assert_close(
        "parameters",
        &run(Table::General(components)).values(),
        &run(mode).values(),
        Tol::stated(1e-10, "linear least squares twice"),
    );
}
