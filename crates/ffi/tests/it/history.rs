//! Laws with history: made by name, from text and from a fit; evaluated at many points in both layouts; failures and refusals.

use piola::continuum::DeformationGradient;
use piola::inelastic::{AnyInelastic, StepControl};
use piola_ffi::FfiError;
use piola_ffi::c::PiolaStatus;
use piola_ffi::history::text::{history_from_fit, history_from_json};
use piola_ffi::history::{DeformationIncrement, StateLayout, States, advance, initial_states};
use piola_ffi::named::{history, history_with_names, state_length};
use piola_ffi::points::{StressMeasure, TangentMeasure, VoigtNumbering};
use piola_testkit::allocations_in;

/// Laws of each kind by name, with numbers in their order.
pub(crate) const LAWS: [(&str, &[f64]); 10] = [
    (
        "bergstrom_boyce-neo_hookean-simo_taylor-compressible-gent-liu",
        &[1.0, 20.0, 2.0, 30.0, 40.0, 0.25, 0.5, 3.0, -0.5, 0.0625],
    ),
    ("reese_govindjee-mooney_rivlin-hencky-lame", &[0.5, 0.25, 2.0, 2.0, 8.0, 0.75, 0.125]),
    ("in_series-neo_hookean-lame-hencky-lame", &[1.0, 2.0, 3.0, 4.0, 0.5]),
    ("viscoplastic-hencky-lame", &[2.0, 3.0, 0.25, 0.125, 0.5, 4.0, 0.5]),
    ("viscoplastic-hencky-lame", &[2.0, 3.0, 0.25, 0.125, 0.5, 4.0, 0.0]),
    ("kinematic-hencky-lame-neo_hookean-simo_taylor", &[2.0, 3.0, 0.25, 0.5, 0.25, 0.125, 0.5, 4.0, 1.5, 0.0]),
    ("mullins-compressible-yeoh-quadratic", &[1.0, 0.125, 0.0, 20.0, 2.0, 0.25, 0.125]),
    ("driven_growth-neo_hookean-simo_taylor", &[1.0, 5.0, 0.5, 0.5, 2.0, 2.0]),
    ("given_growth-saint_venant_kirchhoff", &[1.0, 2.0]),
    ("thermal-neo_hookean-lame", &[1.0, 2.0, 1e-4, 300.0]),
];

/// All of them.
pub(crate) fn laws() -> Vec<AnyInelastic> {
    LAWS.iter().map(|(name, values)| history(name, values).unwrap()).collect()
}

const STILL: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// Deformations of many points.
fn deformations(count: usize) -> Vec<[f64; 9]> {
    let one = |i: usize| {
        let x = i as f64;
        let s = |k: f64| 0.2 * (1.7 * x + k).sin();
        [1.0 + s(0.0), s(1.0), s(2.0), s(3.0), 1.0 + s(4.0), s(5.0), s(6.0), s(7.0), 1.0 + s(8.0)]
    };
    (0..count).map(one).collect()
}

fn gradient(f: &[f64; 9]) -> DeformationGradient {
    DeformationGradient::from_rows([[f[0], f[1], f[2]], [f[3], f[4], f[5]], [f[6], f[7], f[8]]]).unwrap()
}

#[test]
fn names_texts_and_names_of_parameters_make_the_same_law() {
    for ((name, values), law) in LAWS.iter().zip(laws()) {
        let text = serde_json::to_string(&law).unwrap();
        assert_eq!(history_from_json(&text).unwrap(), law, "{text}");
        let mut lengths = name.split('-');
        assert_eq!(state_length(name).unwrap(), law.state_length());
        assert_eq!(law.name(), lengths.next().unwrap());
        assert_eq!(history(&name.to_uppercase(), values).unwrap(), law);
        let Err(FfiError::WrongCount { expected, .. }) = history(name, &values[1..]) else {
            unreachable!("a number is missing")
        };
        let names: Vec<&str> = expected.split(", ").collect();
        let mut pairs: Vec<(&str, f64)> = names.into_iter().zip(values.iter().copied()).collect();
        pairs.reverse();
        let (names, numbers): (Vec<&str>, Vec<f64>) = pairs.into_iter().unzip();
        assert_eq!(history_with_names(name, &names, &numbers).unwrap(), law);
    }
}

/// The best law of a fit has the springs of the models of `piola-fit`.
#[test]
fn laws_of_a_fit_are_those_of_their_models() {
    let parameter = |(name, value): &(&str, f64)| format!(r#"{{"name": "{name}", "value": {value:?}}}"#);
    let entry = |model: &str, parameters: &[(&str, f64)]| {
        let parameters: Vec<String> = parameters.iter().map(parameter).collect();
        format!(r#"{{"model": "{model}", "parameters": [{}]}}"#, parameters.join(", "))
    };
    let spring = [("shear_modulus", 1.0), ("first_lame_parameter", 5.0)];
    let two = [spring[0], spring[1], ("overstress_shear_modulus", 2.0), ("overstress_first_lame_parameter", 8.0)];
    let flow = [
        ("rate", 0.25),
        ("stress", 0.5),
        ("stress_exponent", 3.0),
        ("stretch_exponent", -0.5),
        ("perturbation", 0.0625),
    ];
    let hardening = [("yield_stress", 0.25), ("linear", 0.125), ("saturation", 0.5), ("saturation_exponent", 4.0)];
    let laws = [
        entry("bergstrom-boyce", &[&two[..], &flow].concat()),
        entry("reese-govindjee", &[&two[..], &[("viscosity", 0.75)]].concat()),
        entry("ogden-roxburgh", &[&spring[..], &[("softening", 2.0), ("energy", 0.25), ("share", 0.125)]].concat()),
        entry("viscoplastic", &[&spring[..], &hardening, &[("viscosity", 0.5)]].concat()),
    ];
    let summary = format!(r#"{{"best_by_aicc": "reese-govindjee", "laws": [{}]}}"#, laws.join(", "));
    let expected: [(&str, &[f64]); 4] = [
        (
            "bergstrom_boyce-neo_hookean-simo_taylor-neo_hookean-simo_taylor",
            &[1.0, 5.0, 2.0, 8.0, 0.25, 0.5, 3.0, -0.5, 0.0625],
        ),
        ("reese_govindjee-neo_hookean-simo_taylor-neo_hookean-simo_taylor", &[1.0, 5.0, 2.0, 8.0, 0.75, 0.0]),
        ("mullins-neo_hookean-simo_taylor", &[1.0, 5.0, 2.0, 0.25, 0.125]),
        ("viscoplastic-hencky-lame", &[1.0, 5.0, 0.25, 0.125, 0.5, 4.0, 0.5]),
    ];
    for (model, (name, values)) in
        ["bergstrom-boyce", "reese-govindjee", "ogden-roxburgh", "viscoplastic"].into_iter().zip(expected)
    {
        assert_eq!(history_from_fit(&summary, Some(model)).unwrap(), history(name, values).unwrap());
    }
    assert_eq!(history_from_fit(&summary, None).unwrap().name(), "reese_govindjee");
    let missing = history_from_fit(&summary.replace("\"viscosity\"", "\"fluidity\""), None).unwrap_err().to_string();
    assert!(missing.contains("`viscosity` is missing"), "{missing}");
    let unknown = history_from_fit(&entry("yeoh", &[]), None).unwrap_err();
    assert_eq!(unknown.status(), PiolaStatus::UnknownChoice);
}

/// A law read from a fit has the stresses of the model that was fitted, in pascal where the table was in megapascal.
#[test]
fn laws_read_from_a_fit_have_the_stresses_of_the_fitted_model() {
    use piola::fit::history::{AnyHistoryModel, HistoryModel, HistoryOptions, HistoryTest, fit_history};
    use piola::fit::sides::Loading;
    let rows = [[0.25, 0.25, 0.0], [0.5, 0.5, 0.0], [1.0, 0.5, 0.0], [1.5, -0.25, 0.0]];
    let path = HistoryTest::new("shear", Loading::SimpleShear, &rows).unwrap();
    let one_step = StepControl::one_step();
    for model in AnyHistoryModel::ALL {
        let values: &[f64] = match model {
            AnyHistoryModel::BergstromBoyce => &[1.0, 5.0, 2.0, 8.0, 0.25, 0.5, 3.0, -0.5, 0.0625],
            AnyHistoryModel::ReeseGovindjee => &[1.0, 5.0, 2.0, 8.0, 0.75],
            AnyHistoryModel::OgdenRoxburgh => &[1.0, 5.0, 2.0, 0.25, 0.125],
            _ => &[1.0, 5.0, 0.25, 0.125, 0.5, 4.0, 0.5],
        };
        let expected = model.stresses(values, &path, &one_step).unwrap();
        // The fit holds all parameters but the first and begins at the answer.
        let measured: Vec<[f64; 3]> =
            rows.iter().zip(&expected).map(|(row, stress)| [row[0], row[1], *stress]).collect();
        let test = HistoryTest::new("shear", Loading::SimpleShear, &measured).unwrap();
        let mut options = HistoryOptions::default().with_control(one_step);
        for ((name, _, _), value) in model.parameters().iter().zip(values).skip(1) {
            options = options.with_bounds(name, [*value; 2]);
        }
        let fit = serde_json::to_value(fit_history(&model, &[test], values, &options).unwrap()).unwrap();
        let summary = serde_json::json!({ "stress_unit": "MPa", "best_by_aicc": model.name(), "laws": [fit] });
        let law = history_from_fit(&summary.to_string(), None).unwrap();
        let mut state = vec![0.0; law.state_length()];
        law.initial_into(&mut state).unwrap();
        let (mut from, mut before) = (gradient(&STILL), 0.0);
        for ([t, amount, _], expected) in rows.into_iter().zip(expected) {
            let to = DeformationGradient::simple_shear(amount).unwrap();
            let found = law.advance(&mut state, [&from, &to], t - before, &one_step).unwrap().first_piola.0[(1, 0)];
            // Newton's method ends at a residual of 1e-15 of a strain; the first parameter is found to the same order.
            assert!((1e-6 * found - expected).abs() <= 1e-9, "{model}: {found} Pa, {expected} MPa");
            (from, before) = (to, t);
        }
    }
}

/// A point has the same bits alone and in a batch, in either layout, on any number of threads.
#[test]
fn points_of_batches_in_both_layouts_are_those_of_the_library() {
    const COUNT: usize = 1100;
    let (from, to) = (vec![STILL; COUNT], deformations(COUNT));
    for law in laws() {
        let length = law.state_length();
        let (mut rows, mut components) = (vec![0.0; length * COUNT], vec![0.0; length * COUNT]);
        initial_states(&law, StateLayout::Rows, &mut rows).unwrap();
        initial_states(&law, StateLayout::Components, &mut components).unwrap();
        let (mut after, mut others) = (rows.clone(), components.clone());
        let (mut p, mut t, mut a) = (vec![[0.0; 9]; COUNT], vec![[0.0; 9]; COUNT], vec![0.0; 81 * COUNT]);
        let increment = DeformationIncrement { from: &from, to: &to, dt: 0.25, tolerance: None };
        let states = States { layout: StateLayout::Rows, before: &rows, after: &mut after };
        let wanted = (TangentMeasure::FirstPiola, VoigtNumbering::Piola, &mut a[..]);
        advance(&law, increment, states, StressMeasure::FirstPiola, &mut p, Some(wanted)).unwrap();
        let states = States { layout: StateLayout::Components, before: &components, after: &mut others };
        advance(&law, increment, states, StressMeasure::Cauchy, &mut t, None).unwrap();
        for index in (0..COUNT).step_by(97).chain([COUNT - 1]) {
            let mut state = rows[..length].to_vec();
            let path = [&gradient(&STILL), &gradient(&to[index])];
            let alone = law.advance(&mut state, path, 0.25, &StepControl::one_step()).unwrap();
            assert_eq!(state, after[length * index..][..length], "{}", law.name());
            assert_eq!(alone.first_piola.0.transpose().as_slice(), p[index]);
            assert_eq!(alone.tangent.0.components.as_flattened(), &a[81 * index..][..81]);
            // Without tangents.
            let mut state = rows[..length].to_vec();
            let (stress, _) = law.advance_stress(&mut state, path, 0.25, &StepControl::one_step()).unwrap();
            let columns: Vec<f64> = (0..length).map(|k| others[COUNT * k + index]).collect();
            assert_eq!(state, columns);
            assert_eq!(stress.kirchhoff(path[1]).cauchy(path[1]).0.rows().as_flattened(), t[index]);
        }
    }
}

/// 36 numbers of each measure are those of ∂P/∂F in the library, by way of ∂S/∂E.
#[test]
fn tangents_of_all_measures_are_conversions_of_the_consistent_one() {
    let to = deformations(8);
    let from = [STILL; 8];
    for law in laws() {
        let mut before = vec![0.0; law.state_length() * 8];
        initial_states(&law, StateLayout::Rows, &mut before).unwrap();
        let mut after = before.clone();
        let mut compute = |measure: TangentMeasure| {
            let (mut p, mut c) = ([[0.0; 9]; 8], vec![0.0; 8 * measure.numbers()]);
            let states = States { layout: StateLayout::Rows, before: &before, after: &mut after };
            let increment = DeformationIncrement { from: &from, to: &to, dt: 0.25, tolerance: Some(1e-6) };
            let wanted = (measure, VoigtNumbering::Piola, &mut c[..]);
            advance(&law, increment, states, StressMeasure::FirstPiola, &mut p, Some(wanted)).unwrap();
            (p, c)
        };
        let (p, a) = compute(TangentMeasure::FirstPiola);
        let found = [TangentMeasure::Material, TangentMeasure::Truesdell, TangentMeasure::Jaumann].map(&mut compute);
        for (index, f) in to.iter().enumerate() {
            use piola::continuum::FirstPiola;
            use piola::continuum::stress::tangents::FirstPiolaTangent;
            let f = gradient(f);
            let stress = FirstPiola(nalgebra::Matrix3::from_row_slice(&p[index]));
            let components = core::array::from_fn(|r| core::array::from_fn(|s| a[81 * index + 9 * r + s]));
            let tangent = FirstPiolaTangent(piola::tensor::FourthOrder { components });
            let material = tangent.material(&stress.second_piola(&f), &f);
            let truesdell = material.truesdell(&f);
            let jaumann = truesdell.jaumann(&stress.kirchhoff(&f).cauchy(&f)).0;
            for ((_, found), expected) in found.iter().zip([material.0, truesdell.0, jaumann]) {
                let scale = expected.components.as_flattened().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
                for (x, y) in found[36 * index..].iter().zip(expected.components.as_flattened()) {
                    assert!((x - y).abs() <= 1e-12 * scale, "{}: {x} {y}", law.name());
                }
            }
        }
    }
}

#[test]
fn points_that_fail_are_named_and_keep_their_state() {
    let law =
        history("viscoplastic-compressible-gent-quadratic", &[1.0, 2.0, 10.0, 0.25, 0.125, 0.5, 4.0, 0.5]).unwrap();
    let mut before = vec![0.0; 30];
    initial_states(&law, StateLayout::Rows, &mut before).unwrap();
    let mut to = deformations(3);
    to[1] = [9.0, 0.0, 0.0, 0.0, 9.0, 0.0, 0.0, 0.0, 1.0 / 81.0]; // far beyond the limit of Gent's chains, in no time
    let (mut after, mut t) = (vec![7.0; 30], [[0.0; 9]; 3]);
    let increment = DeformationIncrement { from: &[STILL; 3], to: &to, dt: 1e-9, tolerance: None };
    let states = States { layout: StateLayout::Rows, before: &before, after: &mut after };
    let error = advance(&law, increment, states, StressMeasure::Cauchy, &mut t, None).unwrap_err();
    let text = error.to_string();
    assert!(matches!(error, FfiError::BadIncrements { bad: 1, count: 3, index: 1, .. }), "{text}");
    assert_eq!(error.status(), PiolaStatus::BadPoints);
    assert!(text.contains("1 of 3 points failed: at point 1, "), "{text}");
    assert!(t[1].iter().all(|x| x.is_nan()) && t[0].iter().chain(&t[2]).all(|x| x.is_finite()));
    assert_eq!(after[10..20], before[10..20], "the state of a point beyond the limit is that before");
    assert!(after[..10] != before[..10] && after[20..] != before[20..]);
    to[1] = [0.0; 9];
    let increment = DeformationIncrement { from: &[STILL; 3], to: &to, dt: 0.5, tolerance: None };
    let states = States { layout: StateLayout::Rows, before: &before, after: &mut after };
    let error = advance(&law, increment, states, StressMeasure::Cauchy, &mut t, None).unwrap_err();
    assert!(matches!(error, FfiError::BadIncrements { bad: 1, index: 1, .. }), "{error}");
    assert_eq!(after[10..20], before[10..20], "the state of a point that could not start is that before");
}

/// An increment that can be followed up to a share: the message says so, and the state is the one before.
#[test]
fn a_failed_newton_iteration_names_its_last_share_and_keeps_the_state() {
    // Turned by 180° in a straight line: half of the way det F = 0.
    let law = history("reese_govindjee-hencky-lame-hencky-lame", &[1.0, 1.0, 1.0, 1.0, 0.5, 0.0]).unwrap();
    let to = [[-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0]];
    let mut before = [0.0; 9];
    initial_states(&law, StateLayout::Rows, &mut before).unwrap();
    let (mut after, mut t) = ([0.0; 9], [[0.0; 9]]);
    let increment = DeformationIncrement { from: &[STILL], to: &to, dt: 1.0, tolerance: Some(1e-8) };
    let states = States { layout: StateLayout::Rows, before: &before, after: &mut after };
    let text = advance(&law, increment, states, StressMeasure::Cauchy, &mut t, None).unwrap_err().to_string();
    assert!(text.contains("at point 0") && text.contains("share 0."), "{text}");
    assert_eq!(after, before);
    assert!(t[0][0].is_nan());
}

#[test]
fn wrong_lengths_and_numbers_are_refused_before_anything_is_written() {
    let law = history("mullins-neo_hookean-lame", &[1.0, 2.0, 2.0, 0.25, 0.0]).unwrap();
    let (f, before) = ([STILL; 2], [0.0; 2]);
    let run = |to: &[[f64; 9]], dt: f64, tolerance: Option<f64>, before: &[f64], after: &mut [f64]| {
        let mut t = [[7.0; 9]; 2];
        let increment = DeformationIncrement { from: &f, to, dt, tolerance };
        let states = States { layout: StateLayout::Rows, before, after };
        let result = advance(&law, increment, states, StressMeasure::Cauchy, &mut t, None);
        assert!(result.is_ok() || t == [[7.0; 9]; 2]);
        result.err().map(|error| (error.status(), error.to_string()))
    };
    let mut after = [0.0; 2];
    assert_eq!(run(&f, 1.0, None, &before, &mut after), None);
    let refused = |found: Option<(PiolaStatus, String)>, status: PiolaStatus, says: &str| {
        let (code, text) = found.expect("refused");
        assert!(code == status && text.contains(says), "{code:?}: {text}");
    };
    refused(
        run(&f[..1], 1.0, None, &before, &mut after),
        PiolaStatus::WrongLength,
        "`deformations after` has length 1",
    );
    refused(run(&f, 1.0, None, &before[..1], &mut after), PiolaStatus::WrongLength, "`states before` has length 1");
    refused(run(&f, 1.0, None, &before, &mut []), PiolaStatus::WrongLength, "`states after` has length 0");
    refused(run(&f, f64::NAN, None, &before, &mut after), PiolaStatus::NotFinite, "`dt`, entry 0: NaN is not finite");
    refused(run(&f, 1.0, Some(-1.0), &before, &mut after), PiolaStatus::BadLaw, "1e-14 ≤ tolerance");
    refused(run(&f, 1.0, None, &[0.0, f64::INFINITY], &mut after), PiolaStatus::NotFinite, "`states before`, entry 1");
    refused(run(&f, -1.0, None, &before, &mut after), PiolaStatus::BadLaw, "0 ≤ dt");
}

#[test]
fn laws_that_cannot_be_parts_are_refused_by_name() {
    let says = |name: &str, values: &[f64], says: &str| {
        let text = history(name, values).unwrap_err().to_string();
        assert!(text.contains(says), "{text}");
    };
    says("in_series-linear_elastic-hencky-lame", &[1.0, 2.0, 1.0, 2.0, 0.5], "`first` is linear elasticity");
    says("mullins-incompressible-neo_hookean", &[1.0, 2.0, 0.25, 0.0], "`elastic` is incompressible");
    for (name, part) in [("kinematic-cheese", "cheese"), ("viscoplastic-hencky-lame-lame", "lame")] {
        let error = state_length(name).unwrap_err();
        assert!(error.status() == PiolaStatus::UnknownChoice && error.to_string().contains(part), "{error}");
    }
    says("cheese-hencky-lame", &[], "`cheese` is no law with history; there are bergstrom_boyce");
    says("mullins-cheese", &[], "`cheese` is no law");
    says("mullins-hencky-lame-lame", &[], "no further parts of `mullins`");
    says("mullins-ogden-lame", &[], "make the law from JSON");
    says("mullins-hencky-lame", &[1.0, 2.0, 0.5, 0.25, 0.0], "violates 1 ≤ r");
    let fibres = r#"{"law": "reinforced_neo_hookean", "shear_modulus": 1.0, "first_lame_parameter": 2.0,
        "fibre_modulus": 3.0, "fibre": [1.0, 0.0, 0.0]}"#;
    let text = format!(r#"{{"law": "in_series", "first": {fibres}, "second": {fibres}, "viscosity": 0.5}}"#);
    let error = history_from_json(&text).unwrap_err().to_string();
    assert!(
        error.contains("`first` is anisotropic; an isotropic, compressible law of finite strain is needed"),
        "{error}"
    );
    let softens =
        format!(r#"{{"law": "mullins", "elastic": {fibres}, "softening": 2.0, "energy": 0.5, "share": 0.0}}"#);
    assert!(history_from_json(&softens).is_ok());
}

/// A file of a material names a fit and a model, and nothing else; the length of its state is known by its name.
#[test]
fn files_of_materials_with_unknown_keys_are_refused() {
    use piola_ffi::materials::{material, material_state_length};
    let folder = std::env::temp_dir().join(format!("piola_materials_{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = |name: &str, text: &str| {
        std::fs::write(folder.join(format!("{name}.json")), text).unwrap();
        folder.join(name).display().to_string()
    };
    let softens = r#"{"model": "ogden-roxburgh", "stress_unit": "MPa", "parameters": [
        {"name": "shear_modulus", "is_stress": true, "value": 1.0},
        {"name": "first_lame_parameter", "is_stress": true, "value": 5.0},
        {"name": "softening", "is_stress": false, "value": 2.0},
        {"name": "energy", "is_stress": true, "value": 0.25}, {"name": "share", "is_stress": false, "value": 0.125}]}"#;
    let fit = format!("{}.json", file("summary", softens));
    let good = file("good", &format!(r#"{{"fit": "{fit}", "model": "ogden-roxburgh"}}"#));
    let law = history("mullins-neo_hookean-simo_taylor", &[1e6, 5e6, 2.0, 0.25e6, 0.125]).unwrap();
    assert_eq!(*material(&good, &[]).unwrap(), law.into());
    assert_eq!(material_state_length(&good).unwrap(), 1);
    let misspelt = file("misspelt", &format!(r#"{{"fit": "{fit}", "modle": "ogden-roxburgh"}}"#));
    let volumetric = file("volumetric", &format!(r#"{{"fit": "{fit}", "volumetric": {{}}}}"#));
    let number = file("number", &format!(r#"{{"fit": "{fit}", "model": 1}}"#));
    for (name, says) in [(&misspelt, "`modle`"), (&volumetric, "`volumetric`"), (&number, "`model` is 1")] {
        let error = material(name, &[]).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
    let error = material(&misspelt, &[]).unwrap_err().to_string();
    assert!(error.contains("unknown key `modle`; with `fit` there can be fit, model, volumetric"), "{error}");
    let spring =
        r#"{"law": "hencky", "shear_modulus": 2.0, "volumetric": {"law": "lame", "first_lame_parameter": 3.0}}"#;
    let elastic = file("elastic", spring);
    assert_eq!(*material(&elastic, &[]).unwrap(), *material("hencky-lame", &[2.0, 3.0]).unwrap());
    assert_eq!((material_state_length(&elastic).unwrap(), material_state_length("hencky-lame").unwrap()), (0, 0));
    let error = material_state_length("hencky-nonsense").unwrap_err();
    assert!(error.to_string().contains("nonsense"), "{error}");
    let grown = file("grown", &format!(r#"{{"law": "given_growth", "elastic": {spring}}}"#));
    assert_eq!(*material(&grown, &[]).unwrap(), *material("given_growth-hencky-lame", &[2.0, 3.0]).unwrap());
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn increments_allocate_nothing() {
    let (from, to) = ([STILL; 20], deformations(20));
    for law in laws() {
        let mut before = vec![0.0; law.state_length() * 20];
        initial_states(&law, StateLayout::Components, &mut before).unwrap();
        let (mut after, mut t, mut c) = (before.clone(), [[0.0; 9]; 20], [0.0; 36 * 20]);
        let (counted, ()) = allocations_in(|| {
            let increment = DeformationIncrement { from: &from, to: &to, dt: 0.5, tolerance: None };
            let states = States { layout: StateLayout::Components, before: &before, after: &mut after };
            let wanted = (TangentMeasure::Jaumann, VoigtNumbering::Abaqus, &mut c[..]);
            advance(&law, increment, states, StressMeasure::Cauchy, &mut t, Some(wanted)).unwrap();
        });
        assert_eq!(counted, 0, "{}", law.name());
    }
}

/// Stresses and states along the paths that another program integrated, from one state array to the other and back.
#[test]
fn laws_by_name_follow_the_reference_paths() {
    use piola_testkit::golden::{self, matrix, number, text, vector};
    use piola_testkit::{Tol, assert_close};
    let two = "neo_hookean-simo_taylor-neo_hookean-simo_taylor";
    let laws: [(&str, &str, String, &[f64]); 8] = [
        (
            "inelastic_paths",
            "bergstrom_boyce",
            format!("bergstrom_boyce-{two}"),
            &[1.0, 5.0, 2.0, 8.0, 0.25, 0.5, 3.0, -0.5, 0.0625],
        ),
        (
            "inelastic_paths",
            "reese_govindjee",
            format!("reese_govindjee-{two}"),
            &[1.0, 5.0, 2.0, 8.0, 0.75, 1.0 / 3.0],
        ),
        ("inelastic_paths", "viscoplastic", LAWS[3].0.to_owned(), LAWS[3].1),
        ("inelastic_paths", "driven_growth", LAWS[7].0.to_owned(), LAWS[7].1),
        ("inelastic_paths", "mullins", "mullins-neo_hookean-simo_taylor".to_owned(), &[1.0, 5.0, 2.0, 0.25, 0.125]),
        ("kinematic_paths", "kinematic", LAWS[5].0.to_owned(), LAWS[5].1),
        ("kinematic_paths", "kinematic_crossing", LAWS[5].0.to_owned(), LAWS[5].1),
        (
            "kinematic_paths",
            "kinematic_viscous",
            LAWS[5].0.to_owned(),
            &[2.0, 3.0, 0.25, 0.5, 0.25, 0.125, 0.5, 4.0, 1.5, 0.5],
        ),
    ];
    let mut legs = 0;
    for (file, name, law, values) in laws {
        let law = history(&law, values).unwrap();
        let mut before = vec![0.0; law.state_length()];
        initial_states(&law, StateLayout::Rows, &mut before).unwrap();
        let golden = golden::load(file);
        for leg in golden.cases.iter().filter(|case| text(&case["law"]) == name) {
            let rows = |which: &str| [*matrix(&leg["input"][which]).concat().first_chunk::<9>().unwrap()];
            let (mut after, mut stress) = (before.clone(), [[0.0; 9]]);
            let dt = number(&leg["input"]["duration"]);
            let increment = DeformationIncrement { from: &rows("from"), to: &rows("to"), dt, tolerance: Some(1e-12) };
            let states = States { layout: StateLayout::Rows, before: &before, after: &mut after };
            advance(&law, increment, states, StressMeasure::FirstPiola, &mut stress, None).unwrap();
            let stated = Tol::stated(1e-10, "the error of an increment is controlled to 1e-12");
            let what = text(&leg["id"]);
            assert_close(&format!("{what}: P"), &stress[0], &vector(&leg["output"]["P"]), stated);
            if leg["output"]["state"].is_array() {
                assert_close(&format!("{what}: state"), &after, &vector(&leg["output"]["state"]), stated);
            }
            before = after;
            legs += 1;
        }
    }
    assert_eq!(legs, 17);
}
