//! Tables of measured stresses, good and bad, and what a comparison writes.

use core::fmt::Write as _;
use std::path::{Path, PathBuf};

use piola_charts::Folder;
use piola_measured::MeasuredError;
use piola_measured::fitting::{self, Measurements, Request, Stability};
use piola_testkit::{Tol, assert_close};

use crate::newtonian::{numbers, written};

fn sentence(text: &str) -> String {
    Measurements::parse("rubber.csv", text).map_or_else(|error| error.to_string(), |_| String::new())
}

fn rubber(name: &str) -> Measurements {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/rubber").join(name);
    Measurements::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

fn components(rows: &[&str]) -> String {
    let header = "mode,stress_type,F11,F12,F13,F21,F22,F23,F31,F32,F33,S11,S12,S13,S21,S22,S23,S31,S32,S33";
    format!("# a comment\n# unit: kPa\n{header}\n{}\n", rows.join("\n"))
}

#[test]
fn every_mistake_of_a_table_is_named_with_its_line() {
    let text = "mode,stretch,stress\nuniaxial,1.1,0.1\nuniaxal,1.2,0.2\n\n# a comment\nplanar,x,0.3\nplanar,1.4\nplanar,-1,NaN\n";
    let report = sentence(text);
    let expected = [
        "rubber.csv:3: the mode is `uniaxal`; valid: uniaxial, equibiaxial, planar, simple shear",
        "rubber.csv:6: stretch is `x`; valid: a finite number",
        "rubber.csv:7: a row of 2 fields; valid: 3 fields",
        "rubber.csv:8: stress is `NaN`; valid: a finite number",
        "rubber.csv:8: the stretch is -1; valid: 0 < stretch",
    ];
    assert_eq!(report.lines().collect::<Vec<_>>(), expected);
}

#[test]
fn empty_and_unknown_tables_are_refused_with_their_line() {
    assert!(sentence("").starts_with("rubber.csv:1: the table is empty; valid: a header"));
    assert!(sentence("# nothing\n# at all\n").starts_with("rubber.csv:2: the table is empty"));
    assert!(sentence("mode,stretch,stress\n").starts_with("rubber.csv:1: the table has a header and no rows"));
    assert!(sentence("# table\na,b\n1,2\n").starts_with("rubber.csv:2: the header `a,b` is of no known layout"));
    let many: String = (0..40).map(|_| "planar,x,1\n").collect();
    assert!(sentence(&format!("mode,stretch,stress\n{many}")).ends_with("and 20 more mistakes"));
}

#[test]
fn mistakes_of_components_are_named_with_their_line() {
    let zeros = "0,0,0,0,0,0,0,0";
    let uniaxial = format!("UT,PK1,4,0,0,0,0.5,0,0,0,0.5,1.5,{zeros}");
    let good = Measurements::parse("rubber.csv", &components(&[&uniaxial])).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((good.unit.as_deref(), good.data.tests()[0].name()), (Some("kPa"), "uniaxial"));
    let line = |row: String| sentence(&components(&[&uniaxial, &row]));
    let wide = line(format!("UT,PK1,4,0,0,0,1,0,0,0,0.25,1.5,{zeros}"));
    assert!(wide.starts_with("rubber.csv:5: F is not that of the mode UT at F11 = 4"), "{wide}");
    let swollen = line(format!("BT,PK1,2,0,0,0,1,0,0,0,1,1.5,{zeros}"));
    assert!(swollen.starts_with("rubber.csv:5: det F is 2; valid: det F = 1"), "{swollen}");
    let pressed = line("BT,PK1,2,0,0,0,1,0,0,0,0.5,1.5,0,0,0,0,0,0,0,1".into());
    assert!(pressed.starts_with("rubber.csv:5: S33 is 1; valid: a third face without traction"), "{pressed}");
    let measure = line(format!("BT,PK7,2,0,0,0,1,0,0,0,0.5,1.5,{zeros}"));
    assert!(measure.starts_with("rubber.csv:5: stress_type is `pk7`"), "{measure}");
}

#[test]
fn stresses_on_sides_that_a_mode_leaves_free_are_refused_with_their_line() {
    let line = |row: &str| sentence(&components(&[row]));
    let sides = line("UT,PK1,4,0,0,0,0.5,0,0,0,0.5,1.5,0,0,0,0.3,0,0,0,0");
    assert_eq!(sides, "rubber.csv:4: S22 is 0.3, which the mode UT has not at S11 = 1.5; valid: S22 = 0");
    let shear = line("UT,PK1,4,0,0,0,0.5,0,0,0,0.5,1.5,0,0,0,0,0.2,0,0,0");
    assert!(shear.starts_with("rubber.csv:4: S23 is 0.2"), "{shear}");
    let unlike = line("ET,PK1,2,0,0,0,2,0,0,0,0.25,1.5,0,0,0,1.2,0,0,0,0");
    assert!(unlike.ends_with("S22 is 1.2, which the mode ET has not at S11 = 1.5; valid: S22 = 1.5"), "{unlike}");
    // A sheet whose width is kept has a stress across: it is fitted too.
    let across = components(&["PS,PK1,2,0,0,0,1,0,0,0,0.5,1.5,0,0,0,0.7,0,0,0,0"]);
    let sheet = Measurements::parse("rubber.csv", &across).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((sheet.data.tests()[0].name(), sheet.data.tests()[0].len()), ("PS", 2));
}

#[test]
fn stretches_out_of_range_are_named_with_their_line() {
    let short =
        "# a comment\nmode,stretch,stress\nuniaxial,1.1,0.1\n\nuniaxial,1e-40,0.3\nplanar,1.2,0.1\nuniaxial,1e40,0.3\n";
    let expected = [
        "rubber.csv:5: at the stretch 1e-40 no law has a stress; valid: a stretch or amount of shear of 1e-30 to 1e30",
        "rubber.csv:7: at the stretch 1e40 no law has a stress; valid: a stretch or amount of shear of 1e-30 to 1e30",
    ];
    assert_eq!(sentence(short).lines().collect::<Vec<_>>(), expected);
    let row = |label: &str, x: f64, measure: &str| {
        format!("{label},{measure},{x},0,0,0,{0},0,0,0,{0},0.5,0,0,0,0,0,0,0,0", 1.0 / x.sqrt())
    };
    let long = components(&[&row("UT", 2.0, "PK1"), &row("UT", 1e-40, "PK1"), &row("UT", 3.0, "PK1")]);
    let report = sentence(&long);
    assert!(report.starts_with("rubber.csv:5: at the stretch 1e-40 no law has a stress; valid: "), "{report}");
    assert_eq!((report.lines().count(), report.matches("valid:").count()), (1, 1), "{report}");
    let twice = sentence(&components(&[&row("UT", 2.0, "PK1"), &row("UT", 2.0, "cauchy")]));
    assert_eq!(
        twice,
        "rubber.csv:5: there is a test `uniaxial` already; valid: one stress_type and one label for each test"
    );
}

#[test]
fn deformations_without_an_inverse_and_tables_without_stress_are_named_with_their_line() {
    // det F overflows to no number.
    let wide = "BT,PK1,1e200,1e200,0,1e200,1e200,0,0,0,1e200,0.5,0,0,0,0,0,0,0,0";
    let good = "BT,PK1,2,0,0,0,1,0,0,0,0.5,0.5,0,0,0,0,0,0,0,0";
    let report = sentence(&components(&[good, wide]));
    assert!(report.starts_with("rubber.csv:5: det F is NaN"), "{report}");
    assert_eq!(report.lines().count(), 1, "{report}");
    let unloaded = sentence(&components(&["BT,PK1,2,0,0,0,1,0,0,0,0.5,0,0,0,0,0,0,0,0,0"]));
    assert!(unloaded.starts_with("rubber.csv:4: test `BT` has no points; valid: "), "{unloaded}");
}

#[test]
fn summary_of_as_many_stresses_as_parameters_has_no_errors_and_no_best() {
    let text = "mode,stretch,stress\nuniaxial,1.5,0.4\nuniaxial,2,0.6\n";
    let measurements = Measurements::parse("two.csv", text).unwrap_or_else(|error| panic!("{error}"));
    let laws = ["mooney-rivlin", "neo-hookean"].map(|name| name.parse().unwrap_or_else(|error| panic!("{error}")));
    let comparison =
        fitting::compare(&measurements, &Request::of(laws.into())).unwrap_or_else(|error| panic!("{error}"));
    assert!(comparison.best().is_none());
    let text = comparison.summary(&measurements);
    let summary: serde_json::Value = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}"));
    let law = &summary["laws"][0];
    assert_eq!(law["degrees_of_freedom"], 0);
    for missing in ["covariance", "correlation", "aicc_above_the_best"] {
        assert!(law[missing].is_null(), "{missing}: {text}");
    }
    for estimate in law["parameters"].as_array().into_iter().flatten() {
        assert_eq!(estimate["state"], "no_degrees_of_freedom");
    }
    assert!(summary["best_by_aicc"].is_null() && law["criteria"]["aic"].is_null());
    // One parameter has one degree of freedom, and an error with it.
    let other = &summary["laws"][1];
    assert_eq!((&other["degrees_of_freedom"], &other["parameters"][0]["state"]), (&1.into(), &"determined".into()));
    assert!(other["covariance"]["matrix"][0][0].is_f64() && other["correlation"][0][0].is_f64());
}

#[test]
fn two_units_of_a_table_are_refused() {
    let both = sentence("# unit: kPa\nmode,stretch,stress_MPa\nplanar,1.1,0.1\n");
    assert_eq!(both, "rubber.csv:2: the header says MPa and a comment kPa; valid: one unit");
}

#[test]
fn unreadable_files_are_refused_by_name() {
    let error = |path: &Path| Measurements::load(path).map(|_| ()).unwrap_err();
    assert!(matches!(error(Path::new("no-such-file.csv")), MeasuredError::Unreadable { .. }));
    let path = std::env::temp_dir().join(format!("piola-fitting-{}.csv", std::process::id()));
    std::fs::write(&path, b"mode,stretch,stress\nplanar,\xff,1\n").unwrap_or_else(|error| panic!("{error}"));
    let bytes = error(&path);
    assert!(matches!(bytes, MeasuredError::NotText { line: 2, column: 8, byte: 0xff, .. }));
    let place = format!("{}:2:8: the file is not a text file: byte 0xff; valid: UTF-8 text", path.display());
    assert_eq!(bytes.to_string(), place);
    let _ = std::fs::remove_file(&path);
}

#[test]
fn a_table_that_is_too_large_is_refused_with_its_size() {
    let path = std::env::temp_dir().join(format!("piola-large-{}.csv", std::process::id()));
    let most = 64 << 20;
    // A byte more than the 64 MiB that a table has at most, none of them written.
    let file = std::fs::File::create(&path).unwrap_or_else(|error| panic!("{error}"));
    file.set_len(most + 1).unwrap_or_else(|error| panic!("{error}"));
    let refused = Measurements::load(&path).map(|_| ());
    let _ = std::fs::remove_file(&path);
    assert_eq!(refused, Err(MeasuredError::TooLarge { path, bytes: most + 1, most }));
}

#[test]
fn curve_of_a_fitted_law_runs_evenly_over_the_stretches_of_its_test() -> Result<(), MeasuredError> {
    // S = μ (λ − λ⁻²), compressed to one half and stretched to the double; planar S = μ (λ − λ⁻³), stretched only.
    let modulus = 0.8;
    let stress = |mode: &str, x: f64| modulus * (x - x.powi(if mode == "planar" { -3 } else { -2 }));
    let rows = [("uniaxial", [0.5, 1.25, 2.0]), ("planar", [1.5, 2.0, 3.0])];
    let lines =
        rows.iter().flat_map(|(mode, stretches)| stretches.map(|x| format!("{mode},{x},{:?}\n", stress(mode, x))));
    let text = format!("mode,stretch,stress\n{}", lines.collect::<String>());
    let measurements = Measurements::parse("rubber.csv", &text)?;
    let comparison = fitting::compare(&measurements, &Request::of(vec!["neo-hookean".parse()?]))?;
    let [csv] = written("stretches", ["curves.csv"], |folder| comparison.write(folder, &measurements));
    for (mode, low, high) in [("uniaxial", 0.5, 2.0), ("planar", 1.0, 3.0)] {
        let of_mode: Vec<&str> = csv.lines().filter(|line| line.split(',').nth(1) == Some(mode)).collect();
        let curve: Vec<[f64; 2]> = numbers(&format!("\n{}", of_mode.join("\n")));
        let stretches: Vec<f64> = (0..=120).map(|k| low + (high - low) * f64::from(k) / 120.0).collect();
        let stresses: Vec<f64> = stretches.iter().map(|x| stress(mode, *x)).collect();
        let column = |k: usize| curve.iter().map(|row| row[k]).collect::<Vec<f64>>();
        assert_close(mode, &column(0), &stretches, Tol::ulps(2.0));
        let tolerance = Tol::stated(1e-10, "the search ends where the sum of squares is that of rounding");
        assert_close(mode, &column(1), &stresses, tolerance);
    }
    Ok(())
}

#[test]
fn both_layouts_give_the_same_fit() {
    let long = rubber("treloar-1944.csv");
    let mut text = String::from("mode,stretch,stress_MPa\n");
    for test in long.data.tests() {
        for (x, y) in test.abscissas().zip(test.stresses()) {
            let _ = writeln!(text, "{},{x:?},{y:?}", test.name());
        }
    }
    let short = Measurements::parse("rubber.csv", &text).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((&short.data, &short.unit), (&long.data, &long.unit));
}

#[test]
fn comparison_writes_summary_tables_and_figure() {
    let measurements = rubber("treloar-1944.csv");
    let laws = ["ogden:3", "yeoh", "mooney-rivlin"].map(|name| name.parse().unwrap_or_else(|error| panic!("{error}")));
    let mut request = Request::of(laws.into());
    request.stability = Stability::Free;
    let comparison = fitting::compare(&measurements, &request).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(comparison.fits().count(), 3);
    let path: PathBuf = std::env::temp_dir().join(format!("piola-fitting-{}", std::process::id()));
    let folder = Folder::prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    let written = comparison.write(&folder, &measurements);
    assert!(written.failures.is_empty() && written.files.len() == 4);
    let read = |name: &str| std::fs::read_to_string(path.join(name)).unwrap_or_else(|error| panic!("{error}"));
    let summary: serde_json::Value =
        serde_json::from_str(&read("summary.json")).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(summary["laws"][0]["model"], "ogden:3");
    assert_eq!(summary["stress_unit"], "MPa");
    for test in summary["laws"][0]["tests"].as_array().into_iter().flatten() {
        assert!(test["relative_rms"].as_f64().is_some_and(|rms| rms <= 0.03), "{test}");
    }
    assert!(read("curves.csv").starts_with("law,test,stretch,stress_MPa\nogden:3,equibiaxial,1.0,0.0\n"));
    assert_eq!(read("residuals.csv").lines().count(), 1 + measurements.data.len());
    let figure = read("fit.svg");
    assert!(figure.contains("planar") && figure.contains("ogden:3  1.6 %") && !figure.contains("could not be drawn"));
    let _ = std::fs::remove_dir_all(&path);
}

#[test]
fn weights_and_bounds_that_nothing_has_are_refused() {
    let measurements = rubber("kawabata-1981.csv");
    let mut request = Request::of(vec!["gent".parse().unwrap_or_else(|error| panic!("{error}"))]);
    request.weights = Request::weights("planar=2,shear=1").unwrap_or_else(|error| panic!("{error}"));
    let error = fitting::compare(&measurements, &request).unwrap_err().to_string();
    assert_eq!(error, "no test is called `shear`; the tests are: equibiaxial, planar, uniaxial");
    request.weights.clear();
    request.bounds = vec!["ogden:2.mu1=0..1".parse().unwrap_or_else(|error| panic!("{error}"))];
    assert!(fitting::compare(&measurements, &request).is_err());
    assert!(Request::weights("planar=-1").is_err() && Request::weights("planar").is_err());
}
