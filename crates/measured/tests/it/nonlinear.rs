//! Tables of viscoelastic fluids in start-up, extension and with normal stresses.

use core::fmt::Write as _;

use piola_fit::nonlinear::{Extension, NonlinearFlow, ShearResponse};
use piola_fluids::{AnyFluid, DifferentialFluid as _, Giesekus, Modes, ViscometricFluid as _};
use piola_measured::nonlinear::{
    NonlinearModel, NonlinearRequest, NonlinearTable, RelaxationModes, compare_nonlinear, modes_of_spectrum,
};
use piola_testkit::{Tol, assert_each_close};

const FOUND: Tol = Tol::stated(1e-8, "answers of start-up are integrated to 1e-12");

/// Where a test writes its files.
fn folder(name: &str) -> std::path::PathBuf {
    let path = std::env::temp_dir().join(format!("piola-nonlinear-{}-{name}", std::process::id()));
    std::fs::create_dir_all(&path).unwrap_or_else(|error| panic!("{error}"));
    path
}

#[test]
fn several_rates_of_a_column_are_several_flows_in_si() {
    let text = "time;shear rate [1/min];viscosity [mPa s];N1 [kPa];N2 [Pa]\ns;;;;\n0;60;;;\n0,5;60;2000;0,1;-3\n1;60;3000;0,4;\n\
                0,5;120;1500;;\n";
    let table = NonlinearTable::parse("melt.csv", text).unwrap_or_else(|error| panic!("{error}"));
    let flow = |shear_rate, response| NonlinearFlow::ShearStartUp { shear_rate, response };
    let found: Vec<(NonlinearFlow, &[[f64; 2]])> = table.flows.iter().map(|set| (set.flow(), set.rows())).collect();
    assert_eq!(
        found,
        [
            (flow(1.0, ShearResponse::ShearStress), &[[0.5, 2.0], [1.0, 3.0]][..]),
            (flow(1.0, ShearResponse::FirstNormalStressDifference), &[[0.5, 100.0], [1.0, 400.0]][..]),
            (flow(1.0, ShearResponse::SecondNormalStressDifference), &[[0.5, -3.0]][..]),
            (flow(2.0, ShearResponse::ShearStress), &[[0.5, 3.0]][..]),
        ]
    );
    assert!(table.notes.iter().any(|note| note.ends_with("are not used: 1")), "{:?}", table.notes);
    let text = "# extension: planar\nstrain rate [1/s],viscosity [kPa s]\n0.1,2\n";
    let table = NonlinearTable::parse("melt.csv", text).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(table.flows[0].flow(), NonlinearFlow::SteadyExtension(Extension::Planar));
    assert_eq!(table.flows[0].rows(), [[0.1, 200.0]]);
    // ψ₁ = N₁/k², ψ₂ = N₂/k².
    let text = "shear rate [1/s],psi1 [Pa s^2],psi2 [Pa s^2]\n3,2,-0.5\n";
    let table = NonlinearTable::parse("melt.csv", text).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((table.flows[0].rows(), table.flows[1].rows()), (&[[3.0, 18.0]][..], &[[3.0, -4.5]][..]));
    // A number in a comment is read as those of the rows.
    let text = "# shear rate: 0,5 1/s\ntime [s];stress [Pa]\n1,5;2\n";
    let table = NonlinearTable::parse("melt.csv", text).unwrap_or_else(|error| panic!("{error}"));
    let half = NonlinearFlow::ShearStartUp { shear_rate: 0.5, response: ShearResponse::ShearStress };
    assert_eq!(table.flows[0].flow(), half);
}

#[test]
fn measured_rates_within_a_percent_are_one_start_up_also_of_two_files() {
    let text = "time [s],shear rate [1/s],stress [Pa]\n1,0.9998,2\n2,1.0002,3\n3,1.5,4\n4,1,5\n";
    let table = NonlinearTable::parse("melt.csv", text).unwrap_or_else(|error| panic!("{error}"));
    let counts: Vec<usize> = table.flows.iter().map(|flow| flow.rows().len()).collect();
    assert_eq!(counts, [3, 1]);
    let NonlinearFlow::ShearStartUp { shear_rate, .. } = table.flows[0].flow() else { panic!("a start-up of shear") };
    assert!((shear_rate - 1.0).abs() < 1e-15, "{shear_rate}");
    let note = "rates within 1 % are one start-up: 0.9998 to 1.0002 1/s are read as 1.000000 1/s";
    assert!(table.notes.iter().any(|found| found == note), "{:?}", table.notes);
    let path = folder("rates");
    let files = [
        ("a.csv", "# shear rate: 2 1/s\ntime [s],stress [Pa]\n1,2\n"),
        ("b.csv", "# shear rate: 2.01 1/s\ntime [s],stress [Pa]\n2,3\n"),
    ];
    let files = files.map(|(name, text)| {
        std::fs::write(path.join(name), text).unwrap_or_else(|error| panic!("{error}"));
        path.join(name)
    });
    let both = NonlinearTable::load(&files).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((both.flows.len(), both.rows()), (1, 2));
    // Each rate would be a flow of its own.
    let many = (0..501).fold("time [s],shear rate [1/s],stress [Pa]\n".to_owned(), |mut text, k| {
        let _ = writeln!(text, "1,{:?},1", 1.02_f64.powi(k));
        text
    });
    let told = NonlinearTable::parse("melt.csv", &many).expect_err("501 rates").to_string();
    assert!(told.starts_with("`a table of 501 flows` is not accepted; valid: at most 500"), "{told}");
    let _ = std::fs::remove_dir_all(&path);
}

#[test]
fn invalid_modes_are_refused_before_anything_is_fitted_and_results_say_how_they_were_found() {
    let text = "shear rate [1/s],N1 [Pa],shear stress [Pa]\n1,16,3\n2,64,6\n3,144,9\n4,256,12\n";
    let table = NonlinearTable::parse("boger.csv", text).unwrap_or_else(|error| panic!("{error}"));
    let mut request = NonlinearRequest::default();
    request.fluids = vec![NonlinearModel::OldroydB];
    request.modes = RelaxationModes::Fitted(0);
    let told = compare_nonlinear(&table, &request).expect_err("no modes").to_string();
    assert_eq!(told, "the number of relaxation modes is 0; it must be at least 1, and at most 6 if they are fitted");
    request.modes = RelaxationModes::Given(vec![piola_fluids::Relaxation { viscosity: 2.0, time: 4.0 }]);
    let mut found = compare_nonlinear(&table, &request).unwrap_or_else(|error| panic!("{error}"));
    let summary: serde_json::Value = serde_json::from_str(&found.summary(&table)).expect("JSON");
    assert_eq!(summary["minimised"], "sum of squares of ln(model/measured)");
    let fluid = &summary["fluids"][0];
    assert_eq!(
        (&fluid["modes"]["given"][0]["time"], &fluid["flows"][0]["curve_stops"]),
        (&4.0.into(), &serde_json::Value::Null)
    );
    assert!(fluid["evaluations"].is_u64() && fluid["starts_that_agree"].is_u64(), "{fluid}");
    // A curve that cannot be computed is told.
    if let Ok(fit) = &mut found.candidates[0].fit {
        fit.modes = RelaxationModes::Given(Vec::new());
    }
    let shown = found.table(&table);
    assert!(shown.contains("  no curve of steady shear, N1: the number of relaxation modes is 0"), "{shown}");
}

/// Oldroyd's fluid B bears a steady extension below the rate 1/(2 λ) alone.
#[test]
fn a_curve_is_drawn_as_far_as_the_fluid_has_answers_and_says_where_it_stops() {
    let text = "extension rate [1/s],stress [Pa]\n0.1,0.91617458\n0.2,1.86984127\n0.4,3.92727273\n1,12.6\n";
    let table = NonlinearTable::parse("melt.csv", text).unwrap_or_else(|error| panic!("{error}"));
    let mut request = NonlinearRequest::default();
    request.fluids = vec![NonlinearModel::OldroydB];
    let mut found = compare_nonlinear(&table, &request).unwrap_or_else(|error| panic!("{error}"));
    assert!(!found.table(&table).contains("stops after"));
    if let Ok(fit) = &mut found.candidates[0].fit {
        fit.fit.parameters[2].value = 1.0; // λ: the curve ends before 0.5 1/s
    }
    let shown = found.table(&table);
    assert!(
        shown.contains("the curve of steady uniaxial extension stops after 0.4") && shown.contains("1/s: "),
        "{shown}"
    );
    let path = folder("stops");
    let out = piola_charts::Folder::prepare(&path.join("out")).unwrap_or_else(|error| panic!("{error}"));
    assert!(found.write(&out, &table).failures.is_empty());
    let read = |name: &str| std::fs::read_to_string(path.join("out").join(name)).unwrap_or_default();
    let figure = read("fit.svg");
    assert!(figure.contains("steady extension; curve ends at 0.4") && figure.contains("<polyline"), "{figure}");
    let lines = read("predictions.csv").lines().count();
    assert!(20 < lines && lines < 61, "{lines}");
    let _ = std::fs::remove_dir_all(&path);
}

#[test]
fn tables_that_cannot_be_read_are_refused_with_their_line() {
    for (text, message) in [
        ("time [s],shear stress [Pa]\n1,2\n", "f.csv:1: no column is a rate"),
        ("shear rate [1/s],time [s]\n1,2\n", "f.csv:1: no column is a response"),
        ("shear rate [1/s],extension rate [1/s],stress [Pa]\n1,2,3\n", "f.csv:1: a shear rate and a rate of extension"),
        ("shear rate [1/s],stress [Pa],viscosity [Pa s]\n1,2,3\n", "f.csv:1: `stress [Pa]` and `viscosity [Pa s]`"),
        ("shear rate [1/s],stress [Pa]\n1,-2\n", "f.csv:2: `stress [Pa]` is `-2`"),
        ("shear rate [1/s],N2 [Pa]\n1,2\n", "f.csv:2: `N2 [Pa]` is `2`; valid: a finite number less than zero"),
        ("shear rate [1/s],N1 [Pa s]\n1,2\n", "f.csv:1: `Pa s` is another unit; valid: one of mPa, Pa"),
        ("time [s],shear rate [1/s],stress [Pa]\n-1,1,2\n", "f.csv:2: `time [s]` is `-1`"),
        ("shear rate [1/s],stress [Pa]\n1,\n", "f.csv:2: a row without a response"),
        ("shear rate [1/s],stress [Pa]\n", "f.csv:1: the table has a header and no rows"),
        ("# shear rate: 1\nshear rate [1/s],stress [Pa]\n1,2\n", "f.csv:1: the shear rate is `1`"),
        ("# shear rate: 1 1/s\nshear rate [1/s],stress [Pa]\n1,2\n", "f.csv:1: the shear rate stands in a column and"),
        ("# shear rate: 1,000 1/s\ntime [s],stress [Pa]\n1,2\n", "f.csv:1: the shear rate is `1,000 1/s`"),
        (
            "shear rate [1/s],psi1 [Pa s^2]\n1,1\n1e-200,2\n",
            "f.csv:3: `psi1 [Pa s^2]` is `2`; valid: a number whose stress",
        ),
        ("# shear rate: two\ntime [s],stress [Pa]\n1,2\n", "f.csv:1: the shear rate is `two`"),
        ("# extension: radial\nstrain rate [1/s],stress [Pa]\n1,2\n", "f.csv:1: the extension is `radial`"),
    ] {
        let told = NonlinearTable::parse("f.csv", text).expect_err(message).to_string();
        assert!(told.starts_with(message), "{told}");
    }
}

/// Steady shear and steady extension of two modes of Giesekus' fluid.
fn melt() -> (Modes<Giesekus>, NonlinearTable) {
    let mode = |solvent, viscosity, time| Giesekus::new(solvent, viscosity, time, 0.3).expect("a mode");
    let fluid = Modes::new(vec![mode(0.2, 50.0, 0.1), mode(0.0, 400.0, 4.0)]).expect("modes");
    let mut shear = "shear rate [1/s],shear stress [Pa],N1 [Pa],N2 [Pa]\n".to_owned();
    let mut extension = "extension rate [1/s],extensional viscosity [Pa s]\n".to_owned();
    for k in 0..24 {
        let rate = 0.01 * 1.6_f64.powi(k);
        let (first, second) = (fluid.first_normal_stress_difference(rate), fluid.second_normal_stress_difference(rate));
        let _ = writeln!(shear, "{rate:?},{:?},{first:?},{second:?}", fluid.shear_stress(rate));
        let viscosity = fluid.extensional_viscosity(Extension::Uniaxial, rate).expect("bounded");
        let _ = writeln!(extension, "{rate:?},{viscosity:?}");
    }
    let mut table = NonlinearTable::parse("shear.csv", &shear).expect("a table");
    table.flows.extend(NonlinearTable::parse("extension.csv", &extension).expect("a table").flows);
    (fluid, table)
}

#[test]
fn modes_are_fitted_or_taken_from_a_spectrum_and_the_results_are_read_again() {
    let (fluid, table) = melt();
    let exact = [0.2, 50.0, 0.1, 400.0, 4.0, 0.3];
    let mut request = NonlinearRequest::default();
    request.modes = RelaxationModes::Fitted(2);
    let comparison = compare_nonlinear(&table, &request).unwrap_or_else(|error| panic!("{error}"));
    // Only Giesekus' fluid has an N₂.
    assert_eq!(comparison.best().map(|(model, _)| model), Some(NonlinearModel::Giesekus));
    assert_eq!(comparison.candidates.len(), 1);
    let (_, found) = comparison.fits().next().expect("a fit");
    let values: Vec<f64> = found.fit.parameters.iter().map(|parameter| parameter.value).collect();
    assert_each_close("two modes", &values, &exact, FOUND);
    let path = folder("modes");
    let out = piola_charts::Folder::prepare(&path.join("out")).unwrap_or_else(|error| panic!("{error}"));
    let written = comparison.write(&out, &table);
    assert!(written.failures.is_empty() && written.files.len() == 4, "{written:?}");
    let summary: serde_json::Value = serde_json::from_str(&comparison.summary(&table)).expect("JSON");
    let law: AnyFluid = serde_json::from_value(summary["fluids"][0]["law"].clone()).expect("a fluid");
    assert!((law.shear_stress(2.0_f64) / fluid.shear_stress(2.0_f64) - 1.0).abs() < 1e-8);
    let shown = comparison.table(&table);
    assert!(shown.contains("polymer_viscosity2") && shown.contains("steady shear, N2"), "{shown}");
    // The spectrum of `piola spectrum`.
    let modes: Vec<serde_json::Value> = fluid
        .modes()
        .iter()
        .map(|m: &Giesekus| serde_json::json!({ "modulus": m.polymer_viscosity() / m.time(), "relaxation_time": m.time() }))
        .collect();
    let file = path.join("summary.json");
    let text = serde_json::json!({ "modes": modes, "equilibrium_modulus": 0.0 }).to_string();
    std::fs::write(&file, text).unwrap_or_else(|error| panic!("{error}"));
    request.modes = modes_of_spectrum(&file).unwrap_or_else(|error| panic!("{error}"));
    let comparison = compare_nonlinear(&table, &request).unwrap_or_else(|error| panic!("{error}"));
    let (_, found) = comparison.fits().next().expect("a fit");
    let values: Vec<f64> = found.fit.parameters.iter().map(|parameter| parameter.value).collect();
    assert_each_close("ηₛ, α", &values, &[0.2, 0.3], FOUND);
    std::fs::write(&file, "{}").unwrap_or_else(|error| panic!("{error}"));
    let told = modes_of_spectrum(&file).expect_err("no modes").to_string();
    assert!(told.ends_with("valid: the summary.json of `piola spectrum`"), "{told}");
    std::fs::write(&file, "{\n  \"modes\": [,]\n}").unwrap_or_else(|error| panic!("{error}"));
    let told = modes_of_spectrum(&file).expect_err("no JSON").to_string();
    assert!(told.contains("at line 2 column 13"), "{told}");
    let _ = std::fs::remove_dir_all(&path);
}
