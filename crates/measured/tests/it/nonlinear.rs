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
    // Ψ₁ = N₁/k².
    let text = "shear rate [1/s],psi1 [Pa s^2]\n3,2\n";
    let table = NonlinearTable::parse("melt.csv", text).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(table.flows[0].rows(), [[3.0, 18.0]]);
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
    let _ = std::fs::remove_dir_all(&path);
}
