//! Models and laws, modes and components: two ways to the same stress.

use piola_constitutive::fit::{AnyModel, Component, Data, Fitted, Measure, Options, Table, Test, fit};
use piola_constitutive::homogeneous::{Mode, nominal_stress};
use piola_constitutive::solids::{self, Hyperelastic, OgdenTerm, isochoric};
use piola_testkit::{Tol, assert_close};

const ROUNDING: Tol = Tol::ulps(64.0);

fn check(name: &str, parameters: &[f64], law: &impl Hyperelastic) {
    let model: AnyModel = name.parse().expect("a model");
    let fitted = Fitted::new(&model, parameters.iter().copied()).expect("as many");
    for mode in Mode::ALL {
        for step in 1..=10 {
            let stretch = mode.rest() + 0.2 * f64::from(step);
            let (of_model, of_law) = (nominal_stress(mode, stretch, &fitted), nominal_stress(mode, stretch, law));
            assert_close(&format!("{name}, {}, {stretch}", mode.name()), &[of_model], &[of_law], ROUNDING);
        }
    }
}

#[test]
fn stresses_of_models_equal_those_of_the_laws() {
    use solids::IncompressibleSolid as Solid;
    let expect = "parameters";
    check("neo-hookean", &[0.4], &Solid::new(isochoric::NeoHookean::new(0.4).expect(expect)));
    check("mooney-rivlin", &[0.2, 0.05], &Solid::new(isochoric::MooneyRivlin::new(0.2, 0.05).expect(expect)));
    check("gent", &[0.3, 40.0], &Solid::new(isochoric::Gent::new(0.3, 40.0).expect(expect)));
    check("arruda-boyce", &[0.3, 12.0], &Solid::new(isochoric::ArrudaBoyce::new(0.3, 12.0).expect(expect)));
    let terms = [(0.63, 1.3), (0.0012, 5.0), (-0.01, -2.0)].map(|(mu, alpha)| OgdenTerm { mu, alpha });
    let ogden = solids::IsochoricOgden::new(&terms, 0.0).expect(expect);
    check("ogden:3", &[0.63, 1.3, 0.0012, 5.0, -0.01, -2.0], &ogden);
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
    assert!(run(bar, Measure::Nominal).values() != by_mode.values(), "other weights");
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
        let data = Data::new(vec![Test::new("block", table, Measure::Nominal).expect("a test")]).expect("data");
        fit(&model, &data, &Options::default()).expect("a fit")
    };
    assert_close(
        "parameters",
        &run(Table::General(components)).values(),
        &run(mode).values(),
        Tol::stated(1e-10, "linear least squares twice"),
    );
}
