//! Tables of time, stretch and stress, and laws with history fitted to them.

use piola_fit::State;
use piola_fit::history::{HistoryFit, HistoryModel as _, HistoryTest, StepControl};
use piola_fit::sides::Loading;
use piola_measured::history::{AnyHistoryModel, HistoryMeasurements, HistoryRequest, compare_histories};
use piola_testkit::{Tol, assert_each_close};

/// A table of the stresses that a law computes along rows of time and deformation.
fn table(law: AnyHistoryModel, parameters: &[f64], loading: Loading, rows: &[[f64; 2]]) -> String {
    let path: Vec<[f64; 3]> = rows.iter().map(|[t, x]| [*t, *x, 0.0]).collect();
    let path = HistoryTest::new("path", loading, &path).expect("a path");
    let stresses = law.stresses(parameters, &path, &StepControl::default()).expect("stresses");
    let header = format!("# mode: {}\nmode,time [s],stretch,stress [MPa]\n", loading.name());
    rows.iter()
        .zip(stresses)
        .fold(header, |text, ([t, x], stress)| text + &format!("{},{t:?},{x:?},{stress:?}\n", loading.name()))
}

#[test]
fn a_hold_and_cycles_give_the_parameters_back_without_a_start() {
    const FOUND: Tol =
        Tol::stated(1e-7, "steps of the law are controlled to 1e-10, derivatives are differences over 1e-5");
    // Pulled within a second to half as long again and held.
    let rows = [[1.0, 1.5], [2.0, 1.5], [4.0, 1.5], [8.0, 1.5], [16.0, 1.5]];
    let made = [0.4, 60.0, 0.8, 60.0, 3.0];
    let law = AnyHistoryModel::ReeseGovindjee;
    let held =
        ["reese-govindjee.first_lame_parameter=60..60", "reese-govindjee.overstress_first_lame_parameter=60..60"];
    let found = fit_of(law, &table(law, &made, Loading::Uniaxial, &rows), &held).values();
    assert_each_close("reese-govindjee", &found, &made, FOUND);
    // Two cycles, the second further.
    let amounts = [0.5, 1.0, 0.5, 0.25, 0.75, 1.25, 1.5, 1.0, 0.5, 0.25];
    let rows: Vec<[f64; 2]> = amounts.iter().zip(1..).map(|(k, t)| [f64::from(t), *k]).collect();
    let made = [0.7, 70.0, 1.8, 0.2, 0.1];
    let law = AnyHistoryModel::OgdenRoxburgh;
    let held = ["ogden-roxburgh.first_lame_parameter=70..70"];
    let found = fit_of(law, &table(law, &made, Loading::SimpleShear, &rows), &held).values();
    assert_each_close("ogden-roxburgh", &found, &made, FOUND);
}

fn fit_of(law: AnyHistoryModel, text: &str, bounds: &[&str]) -> HistoryFit {
    let measurements = HistoryMeasurements::parse("test.csv", text).unwrap_or_else(|error| panic!("{error}"));
    let request = bounds.iter().try_fold(HistoryRequest::of(vec![law]), |request, text| request.with_bound(text));
    let request = request.unwrap_or_else(|error| panic!("{error}"));
    let found = compare_histories(&measurements, &request).unwrap_or_else(|error| panic!("{error}"));
    let (_, fit) = found.fits().next().expect("a fit");
    assert!(fit.outcome.is_converged(), "{:?}", fit.outcome);
    fit.clone()
}

/// The flow of each start, γ̇ = γ̇₀ (λ̄ − 1 + ξ)^c (τ/τ₀)^m at the largest stress and stretch, takes one of the times of the test.
#[test]
fn starts_of_bergstroms_and_boyces_rubber_flow_within_the_times_of_the_test() {
    let rows = [[1.0, 0.5, 2.0], [9.0, 0.5, 1.0]];
    let test = HistoryTest::new("hold", Loading::SimpleShear, &rows).expect("a test");
    // λ̄ = √(I₁/3), I₁ = 3 + k²; the only step is 8 s, the duration 9 s.
    let stretch = (3.25_f64 / 3.0).sqrt();
    let times = [24.0, 72.0_f64.sqrt(), 2.7];
    for (start, time) in AnyHistoryModel::BergstromBoyce.starts(&[test]).iter().zip(times) {
        let [rate, stress, power, slowing, perturbation] = start[4..] else { panic!("nine parameters") };
        let flow = rate * (stretch - 1.0 + perturbation).powf(slowing) * (2.0 / stress).powf(power);
        assert_each_close("γ̇ T", &[flow * time], &[1.0], Tol::ulps(256.0));
    }
}

/// λ is held at 1.5 times the μ that is found (ν = 0.3). μ alone is left to be found, so that the test is short.
#[test]
fn metal_keeps_poissons_ratio_whatever_modulus_is_found() {
    let made = [80.0, 120.0, 0.25, 0.5, 0.4, 20.0, 0.05];
    let law = AnyHistoryModel::Viscoplastic;
    let rows = [[1.0, 1.01], [2.0, 1.0095]];
    let held = [
        "yield_stress=0.25..0.25",
        "linear=0.5..0.5",
        "saturation=0.4..0.4",
        "saturation_exponent=20..20",
        "viscosity=0.05..0.05",
    ];
    let text = table(law, &made, Loading::Uniaxial, &rows);
    let measurements = HistoryMeasurements::parse("test.csv", &text).unwrap_or_else(|error| panic!("{error}"));
    let request = held.into_iter().fold(HistoryRequest::of(vec![law]), |request, bound| {
        request.with_bound(&format!("viscoplastic.{bound}")).unwrap_or_else(|error| panic!("{error}"))
    });
    let found = compare_histories(&measurements, &request).unwrap_or_else(|error| panic!("{error}"));
    // The law accepts its starts: it saturates above its yield stress.
    assert!(law.starts(&measurements.tests).iter().all(|start| start[2] <= start[4]));
    let (_, fit) = found.fits().next().expect("a fit");
    assert!(fit.outcome.is_converged(), "{:?}", fit.outcome);
    let values = fit.values();
    assert_each_close("λ", &[values[1]], &[1.5 * values[0]], Tol::ulps(1.0));
    assert_eq!(fit.parameters[1].state, State::Held);
    let shown = found.table(&measurements);
    let line =
        "  held: first_lame_parameter, yield_stress, linear, saturation, saturation_exponent, viscosity; --bound";
    assert!(shown.contains(line) && shown.contains("MPa  held\n") && !shown.contains("at its bound"), "{shown}");
}

#[test]
fn names_of_specimens_with_commas_are_quoted_and_groups_keep_their_order() {
    let text = "specimen;time [s];shear;stress [kPa]\n\"a,1\";1;0.5;1\nb;1;0.5;1\n\"a,1\";2;0.6;1.2\nb;2;0.6;1.2\n\"a,1\";3;0.3;0.5\n";
    let measurements = HistoryMeasurements::parse("f.csv", text).unwrap_or_else(|error| panic!("{error}"));
    let rows: Vec<(&str, usize)> = measurements.tests.iter().map(|test| (test.name(), test.rows().len())).collect();
    assert_eq!(rows, [("simple shear a,1", 3), ("simple shear b", 2)]);
    let held = ["energy=0.1..0.1", "share=0..0", "softening=2..2"];
    let request = held.into_iter().fold(HistoryRequest::of(vec![AnyHistoryModel::OgdenRoxburgh]), |request, bound| {
        request.with_bound(&format!("ogden-roxburgh.{bound}")).unwrap_or_else(|error| panic!("{error}"))
    });
    let found = compare_histories(&measurements, &request).unwrap_or_else(|error| panic!("{error}"));
    let path = std::env::temp_dir().join(format!("piola-history-names-{}", std::process::id()));
    let folder = piola_charts::Folder::prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    assert!(found.write(&folder, &measurements).failures.is_empty());
    let predictions = std::fs::read_to_string(path.join("predictions.csv")).unwrap_or_default();
    assert!(predictions.contains("\n\"simple shear a,1\",1.0,0.5,1.0,"), "{predictions}");
    let _ = std::fs::remove_dir_all(&path);
}

#[test]
fn specimens_are_tests_of_their_own_and_results_are_written() {
    let text = "specimen;mode;time [ms];strain [%];stress [kPa]\na;uniaxial;500;10;20\na;uniaxial;1000;20;35\n\
                a;uniaxial;3000;20;30\nb;planar;500;10;25\nb;planar;2000;10;22\nb;planar;9000;10;20\nb;planar;20000;10;19\n";
    let measurements = HistoryMeasurements::parse("gel.csv", text).unwrap_or_else(|error| panic!("{error}"));
    let names: Vec<&str> = measurements.tests.iter().map(HistoryTest::name).collect();
    assert_eq!((names, measurements.unit.as_deref()), (vec!["uniaxial a", "planar b"], Some("kPa")));
    assert_eq!(measurements.tests[0].rows()[2..], [[3.0, 1.2, 30.0]]);
    // One parameter is left.
    let held = ["first_lame_parameter=5e3..5e3", "overstress_first_lame_parameter=5e3..5e3"];
    let held = held.into_iter().chain(["overstress_shear_modulus=50..50", "viscosity=40..40"]);
    let request = held.fold(HistoryRequest::of(vec![AnyHistoryModel::ReeseGovindjee]), |request, bound| {
        request.with_bound(&format!("reese-govindjee.{bound}")).unwrap_or_else(|error| panic!("{error}"))
    });
    let found = compare_histories(&measurements, &request).unwrap_or_else(|error| panic!("{error}"));
    let shown = found.table(&measurements);
    assert!(shown.contains("planar b: RMS residual") && shown.contains("kPa s"), "{shown}");
    let path = std::env::temp_dir().join(format!("piola-history-{}", std::process::id()));
    let folder = piola_charts::Folder::prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    let written = found.write(&folder, &measurements);
    assert!(written.failures.is_empty() && written.files.len() == 3, "{written:?}");
    let predictions = std::fs::read_to_string(path.join("predictions.csv")).unwrap_or_default();
    assert!(predictions.starts_with("test,time [s],stretch,stress [kPa],reese-govindjee\nuniaxial a,0.5,1.1,20.0,"));
    let _ = std::fs::remove_dir_all(&path);
}

#[test]
fn histories_that_cannot_be_read_are_refused_with_their_line() {
    for (text, message) in [
        ("stretch,stress\n1.1,2\n", "f.csv:1: no column is a time"),
        ("time [s],stress\n1,2\n", "f.csv:1: no column is a stretch"),
        ("time [s],stretch\n1,2\n", "f.csv:1: no column is a stress"),
        (
            "time [s],stretch,stress,stress\n1,2,3,4\n",
            "f.csv:1: 2 columns are the stress: `stress`, `stress`; valid: one",
        ),
        ("time [m],stretch,stress\n1,2,3\n", "f.csv:1: `m` is another unit; valid: s, ms, min or h"),
        ("time [s],stretch,stress\n1,1.1,1\n0.5,1.2,2\n", "f.csv:3: test `uniaxial`, point 1: the time 0.5 s"),
        ("time [s],stretch,stress\n1,-1.1,1\n", "f.csv:2: test `uniaxial`, point 0: the stretch -1.1"),
        ("time [s],stretch,stress\n1,1.1,nan\n", "f.csv:2: `stress` is `nan`"),
        ("mode,time [s],stretch,stress\nvolumetric,1,1.1,2\n", "f.csv:2: test `volumetric`: laws with history"),
        ("time [s],stretch,stress\n", "f.csv:1: the table has a header and no rows"),
    ] {
        let told = HistoryMeasurements::parse("f.csv", text).expect_err(message).to_string();
        assert!(told.starts_with(message), "{told}");
    }
    let request = HistoryRequest::of(vec![AnyHistoryModel::OgdenRoxburgh]);
    for text in [
        "ogden-roxburgh.share",
        "share=0..1",
        "ogden-roxburgh.share=a..1",
        "ogden-roxburgh.share=0..inf",
        "gent.Jm=1..2",
    ] {
        assert!(request.clone().with_bound(text).is_err(), "{text}");
    }
    let other = request.with_bound("viscoplastic.viscosity=0..0").unwrap_or_else(|error| panic!("{error}"));
    let text = "time [s],stretch,stress\n1,1.1,2\n";
    let measurements = HistoryMeasurements::parse("f.csv", text).unwrap_or_else(|error| panic!("{error}"));
    let told = compare_histories(&measurements, &other).expect_err("another law").to_string();
    assert!(told.starts_with("`viscoplastic.viscosity` is not accepted"), "{told}");
}
