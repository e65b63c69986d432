//! The commands for measured tables, from outside: exit codes, options, printed lines.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

/// A folder of its own for each test, removed at its end.
pub(super) struct Folder(pub(super) PathBuf);

impl Folder {
    pub(super) fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("piola-bench-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap_or_else(|error| panic!("{error}"));
        Self(path)
    }

    pub(super) fn write(&self, name: &str, text: &str) {
        std::fs::write(self.0.join(name), text).unwrap_or_else(|error| panic!("{error}"));
    }

    pub(super) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The exit code, standard output and standard error.
    pub(super) fn piola(&self, arguments: &[&str]) -> (Option<i32>, String, String) {
        let mut command = Command::new(env!("CARGO_BIN_EXE_piola"));
        command.args(arguments).current_dir(&self.0).stdin(Stdio::null());
        let Output { status, stdout, stderr } = command.output().unwrap_or_else(|error| panic!("{error}"));
        (status.code(), String::from_utf8_lossy(&stdout).into_owned(), String::from_utf8_lossy(&stderr).into_owned())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Errors of a percent that look like noise, and are the same in every run.
fn error(i: u32) -> f64 {
    0.01 * (f64::from(i * 61 % 97) / 48.0 - 1.0)
}

pub(super) fn curve(stress: impl Fn(f64) -> f64) -> String {
    (0..24_u32).map(|i| (0.3 * f64::from(i) - 3.0).exp()).zip(0..).fold(
        "shear_rate [1/s],shear_stress [Pa]\n".to_owned(),
        |mut text, (k, i)| {
            let _ = writeln!(text, "{k:?},{:?}", stress(k) * (1.0 + error(i)));
            text
        },
    )
}

#[test]
fn a_newtonian_table_is_fitted_by_the_usual_fluids_with_exit_code_zero() {
    let folder = Folder::new("newtonian");
    folder.write("oil.csv", &curve(|k| 0.9 * k));
    let (code, shown, told) = folder.piola(&["fit-flow", "oil.csv", "--flow", "curve"]);
    assert_eq!(code, Some(0), "{shown}{told}");
    assert!(shown.contains("newtonian has the least AICc.") && !shown.contains("papanastasiou"), "{shown}");
    assert!(shown.contains("least sum of squares of ln(model/measured)"), "{shown}");
    assert!(!shown.contains("[-") && !shown.contains("e25"), "{shown}");
    assert!(shown.contains("at its bound") || shown.contains("not determined"), "{shown}");
}

#[test]
fn a_regularisation_is_fitted_where_it_is_named_and_never_ranked() {
    let folder = Folder::new("regularised");
    folder.write("mud.csv", &curve(|k| 5.0 + 3.0 * k.sqrt()));
    let fluids = ["--fluid", "papanastasiou", "--fluid", "power-law"];
    let (_, shown, _) = folder.piola(&[["fit-flow", "mud.csv", "--flow", "curve"].as_slice(), &fluids].concat());
    assert!(shown.contains("power-law has the least AICc."), "{shown}");
    assert!(shown.contains("papanastasiou regularises herschel-bulkley for computations: it is not ranked"), "{shown}");
}

#[test]
fn a_card_of_ls_dyna_needs_a_density() {
    let folder = Folder::new("card");
    folder.write("bar.csv", "mode,stretch,stress\nuniaxial,2,1.75\nuniaxial,3,2.8888889\nuniaxial,1.5,1.0555556\n");
    let fit = ["fit", "bar.csv", "--law", "neo-hookean", "--bulk-modulus", "1000", "--card", "ls-dyna"];
    let (code, _, told) = folder.piola(&fit);
    assert_eq!(code, Some(2));
    assert!(told.contains("`a card of LS-DYNA without a density` is not accepted"), "{told}");
    let (code, shown, told) = folder.piola(&[fit.as_slice(), &["--density", "1.1e-9"]].concat());
    assert_eq!(code, Some(0), "{shown}{told}");
    assert!(folder.read("out/fit-bar/ls-dyna-neo-hookean.k").contains("1, 1.1e-9, "));
    // Cards and predictions stand beside the other results, and go with them.
    let (code, shown, _) = folder.piola(&[fit.as_slice(), &["--density", "1.1e-9", "--to", "5"]].concat());
    assert_eq!(code, Some(0));
    let files = ["summary.json", "curves.csv", "residuals.csv", "fit.svg", "predictions.csv", "ls-dyna-neo-hookean.k"];
    for file in files {
        assert!(shown.contains(file) && !folder.read(&format!("out/fit-bar/{file}")).is_empty(), "{file}: {shown}");
    }
    let (code, _, _) = folder.piola(&["fit", "bar.csv", "--law", "neo-hookean"]);
    assert_eq!(code, Some(0));
    assert!(
        !folder.read("out/fit-bar/summary.json").is_empty() && !folder.0.join("out/fit-bar/predictions.csv").exists()
    );
}

#[test]
fn a_spectrum_is_found_of_files_of_several_temperatures_with_its_card() {
    let folder = Folder::new("spectrum");
    let moduli = |w: f64| [2e3 * w * w / (1.0 + w * w), 2e3 * w / (1.0 + w * w)];
    for (name, temperature, shift) in [("cold.csv", 150, 2.0), ("warm.csv", 170, 1.0)] {
        let mut text = format!("# temperature: {temperature} °C\nomega [rad/s],G' [Pa],G'' [Pa]\n");
        for k in 0..17 {
            let w = 10.0_f64.powf(0.125 * f64::from(k) - 1.0);
            let [storage, loss] = moduli(shift * w);
            writeln!(text, "{w:?},{storage:?},{loss:?}").unwrap_or_else(|error| panic!("{error}"));
        }
        folder.write(name, &text);
    }
    let run = |arguments: &[&str]| folder.piola(&[&["spectrum", "cold.csv", "warm.csv"], arguments].concat());
    let (code, printed, told) = run(&["--reference-temperature", "170 °C", "--modes", "1", "--card", "abaqus"]);
    // A slow machine tells its progress after five seconds.
    let told: Vec<&str> = told.lines().filter(|line| !line.starts_with("cold: ")).collect();
    assert!(code == Some(0) && told.is_empty(), "{printed}{told:?}");
    assert!(printed.contains("shifted to 170.0 °C") && printed.contains("1 mode,"), "{printed}");
    assert!(folder.read("out/spectrum-cold/abaqus-prony.inp").contains("*VISCOELASTIC, TIME=PRONY\n1.0, 0.0, "));
    let summary: serde_json::Value =
        serde_json::from_str(&folder.read("out/spectrum-cold/summary.json")).unwrap_or_else(|error| panic!("{error}"));
    let modulus = summary["modes"][0]["modulus"].as_f64().unwrap_or(f64::NAN);
    assert!((modulus / 2e3 - 1.0).abs() < 0.01, "{modulus}");
    // What no number of modes would mend is refused before the search: nothing is written.
    for (card, reason) in
        [("ls-dyna", "--density"), ("calculix", "CalculiX reads no Prony series"), ("nastran", "abaqus")]
    {
        let (code, _, told) = run(&["--card", card, "--out", "none"]);
        assert_eq!(code, Some(2), "{card}: {told}");
        assert!(told.contains(reason) && !folder.0.join("none").exists(), "{card}: {told}");
    }
    // Too many modes for one program: the fit is written all the same, with the other card.
    let (code, _, told) = run(&["--modes", "7", "--card", "febio", "--card", "abaqus", "--out", "seven"]);
    assert_eq!(code, Some(1), "{told}");
    assert!(told.contains("error: `--card of FEBio with 7 modes` is not accepted"), "{told}");
    assert!(!folder.read("seven/summary.json").is_empty() && !folder.read("seven/abaqus-prony.inp").is_empty());
}

#[cfg(not(feature = "specimens"))]
#[test]
fn a_program_without_specimens_says_how_to_get_them() {
    let (code, _, told) = Folder::new("absent").piola(&["specimen", "uniaxial", "--solid", "x"]);
    assert_eq!(code, Some(2));
    assert!(told.contains("--features specimens"), "{told}");
}

#[cfg(feature = "specimens")]
#[test]
fn a_specimen_is_loaded_along_a_path_and_a_path_that_ends_is_told() {
    let folder = Folder::new("specimen");
    let rubber = ["--solid", "neo-hookean:mu=1 MPa"];
    let run = |arguments: &[&str]| folder.piola(&[&["specimen"], arguments, rubber.as_slice()].concat());
    let (code, shown, told) = run(&["uniaxial", "--path", "stretch=1..2"]);
    assert_eq!(code, Some(0), "{shown}{told}");
    assert!(shown.contains("P11 (Pa)") && shown.contains("1.750000e6"), "{shown}");
    let csv = folder.read("out/specimen-uniaxial/specimen.csv");
    assert!(csv.starts_with("stretch,F11,F12") && csv.lines().count() == 102, "{csv}");
    let (code, _, told) = run(&["uniaxial", "--path", "stretch"]);
    assert_eq!(code, Some(2));
    assert!(told.contains("`--path stretch` is not accepted; valid: NAME=VALUE"), "{told}");
    let gent = ["specimen", "uniaxial", "--solid", "gent:mu=1 MPa,jm=1", "--path", "stretch=1..2"];
    let (code, shown, told) = folder.piola(&gent);
    assert_eq!(code, Some(1), "{shown}{told}");
    assert!(shown.contains("The path ends before stretch") && told.contains("error: no state at stretch"), "{told}");
}

#[test]
fn noise_sizes_and_columns_that_cannot_be_are_refused_before_anything_is_fitted() {
    let folder = Folder::new("refused");
    folder.write("mud.csv", &curve(|k| 5.0 + 3.0 * k.sqrt()));
    let cases: [(&[&str], &str); 6] = [
        (&["--noise", "1e300"], "`--noise 1e300` is not accepted; valid: a share from 0 to 1, as 0.02 or 2%"),
        (&["--noise", "much"], "`--noise much` is not accepted"),
        (&["--noise", "-1"], "unexpected argument"),
        (&["--sweep", "sideways"], "`sideways` is not accepted; valid: rising, falling or all"),
        (&["--only", "conc"], "`--only conc` is not accepted; valid: COLUMN=VALUE"),
        (
            &["--only", "conc=4"],
            "mud.csv:1: no column is called `conc`; valid: one of `shear_rate [1/s]`, `shear_stress [Pa]`",
        ),
    ];
    for (arguments, expected) in cases {
        let (code, _, told) = folder.piola(&[&["fit-flow", "mud.csv", "--flow", "curve"], arguments].concat());
        assert!(code == Some(2) && told.contains(expected), "{arguments:?}: {told}");
    }
    let (code, shown, told) =
        folder.piola(&["fit-flow", "mud.csv", "--flow", "curve", "--noise", "2%", "--fluid", "casson"]);
    assert_eq!(code, Some(0), "{shown}{told}");
    folder.write("rubber.csv", RUBBER);
    let (code, _, told) = folder.piola(&["fit", "rubber.csv", "--law", "gent", "--bound", "gent.Jx=1..60"]);
    assert!(code == Some(2) && told.contains("gent has no parameter `Jx`"), "{told}");
    let (code, _, told) = folder.piola(&["fit", "rubber.csv", "--law", "gent", "--bound", "gent.Jm=200..60"]);
    assert!(code == Some(2) && told.contains("no value of `Jm`"), "{told}");
    assert!(!folder.0.join("out/fit-rubber").exists());
}

pub(super) const RUBBER: &str = "mode,stretch,stress_MPa\nuniaxial,1,0\nuniaxial,1.5,0.43\nuniaxial,2,0.68\nuniaxial,2.5,0.9\nuniaxial,3,1.15\n\
                      planar,1.5,0.52\nplanar,2,0.79\nplanar,2.5,1.01\nplanar,3,1.2\n";

#[test]
fn tests_are_held_out_left_out_and_predicted_beyond_the_data() {
    let folder = Folder::new("held-out");
    folder.write("rubber.csv", RUBBER);
    let laws = ["--law", "neo-hookean", "--law", "mooney-rivlin"];
    let arguments = ["fit", "rubber.csv", "--mode-weights", "planar=0", "--to", "5"];
    let (code, shown, told) = folder.piola(&[arguments.as_slice(), &laws].concat());
    assert_eq!(code, Some(0), "{shown}{told}");
    assert!(shown.contains("planar, held out: predicted to ") && shown.contains("1 of them at rest"), "{shown}");
    assert!(shown.contains("uniaxial: measured from 1 to 3; at 5 the law is a guess"), "{shown}");
    assert!(shown.contains("at rest: shear modulus ") && shown.contains("largest"), "{shown}");
    let predictions = std::fs::read_to_string(folder.0.join("out/fit-rubber/predictions.csv")).unwrap_or_default();
    assert!(
        predictions.starts_with("law,mode,stretch,stress_MPa,low,high,beyond the data\nneo-hookean,uniaxial,1.0,0.0,"),
        "{predictions}"
    );
    assert!(predictions.lines().last().is_some_and(|line| line.ends_with(",1")), "{predictions}");
    let (code, shown, _) =
        folder.piola(&[["fit", "rubber.csv", "--cross-validate", "--profile"].as_slice(), &laws].concat());
    assert!(code == Some(0) && shown.contains("left out"), "{shown}");
}

#[test]
fn long_names_of_tests_stay_apart() {
    let folder = Folder::new("names");
    let mut text = "mode,stretch,stress,specimen\n".to_owned();
    for specimen in ["corona_radiata_1", "corona_radiata_2"] {
        for stretch in [1.5_f64, 2.0, 3.0] {
            let _ = writeln!(text, "uniaxial,{stretch},{},{specimen}", stretch - stretch.powi(-2));
        }
    }
    folder.write("brain.csv", &text);
    let (_, shown, _) = folder.piola(&["fit", "brain.csv", "--law", "neo-hookean"]);
    assert!(shown.contains("uniaxial corona_radiata_1  uniaxial corona_radiata_2"), "{shown}");
}

#[test]
fn sweeps_are_chosen_and_their_difference_printed() {
    let folder = Folder::new("sweeps");
    let up = curve(|k| 5.0 * k.sqrt());
    let down = curve(|k| 4.0 * k.sqrt());
    let rows: Vec<&str> = down.lines().skip(1).collect();
    folder.write("loop.csv", &format!("{up}{}\n", rows.into_iter().rev().collect::<Vec<_>>().join("\n")));
    let fitted = |sweep: &str| {
        folder.piola(&["fit-flow", "loop.csv", "--flow", "curve", "--fluid", "power-law", "--sweep", sweep]).1
    };
    assert!(fitted("rising").contains("24 rows of rising and 24 of falling sweeps: the rising ones are used"));
    assert!(fitted("rising").contains("falling beside rising: -20.0 % on average"), "{}", fitted("rising"));
    assert!(fitted("falling").contains("the falling ones are used"), "{}", fitted("falling"));
}

#[test]
fn bands_of_a_fluid_that_yields_in_a_wide_gap_hold_its_curve() {
    // Bingham's fluid of 10 Pa between cylinders of 10 and 20 mm, from the stress 12 Pa on.
    let folder = Folder::new("yield");
    let mut text =
        "# inner_radius: 10 mm\n# outer_radius: 20 mm\ntorque_per_length [N],speed_difference [rad/s]\n".to_owned();
    for i in 0..25 {
        let wall = 12.0 * (0.12 * f64::from(i)).exp();
        let outer = (wall / 4.0).max(10.0);
        // ½ ∫ (τ − 10)/τ dτ, a viscosity of 1.
        let speed = 0.5 * (wall - outer - 10.0 * (wall / outer).ln());
        let _ = writeln!(text, "{:?},{:?}", 2.0 * core::f64::consts::PI * 1e-4 * wall, speed * (1.0 + error(i)));
    }
    folder.write("mud.csv", &text);
    for noise in [&["--noise", "0.01"][..], &[]] {
        let (code, shown, told) = folder.piola(&[&["recover", "mud.csv", "--flow", "couette"], noise].concat());
        assert_eq!(code, Some(0), "{shown}{told}");
        assert!(shown.contains("the fluid seems to yield") && shown.contains("band of the whole curve"), "{shown}");
        // The rows of the table: stress, rate, viscosity, band. The rate of the fluid is (τ − 10 Pa)/(1 Pa s).
        let numbers = |line: &str| -> Vec<f64> {
            line.split([' ', ',', '[', ']'])
                .filter(|word| !word.is_empty())
                .map_while(|word| word.parse().ok())
                .collect()
        };
        let rows: Vec<_> = shown.lines().map(numbers).filter(|row| row.len() == 5).collect();
        let held = rows.iter().filter(|row| (row[3]..=row[4]).contains(&(row[0] - 10.0))).count();
        assert!(rows.len() == 25 && 24 <= held, "{held} of {}: {shown}", rows.len());
        assert!(rows.iter().all(|row| row[4] < 1.5 * row[3]), "{shown}");
    }
    let (code, shown, _) = folder.piola(&["fit-flow", "mud.csv", "--flow", "couette", "--fluid", "bingham"]);
    assert!(code == Some(0) && shown.contains("yield_stress"), "{shown}");
}

#[test]
fn a_full_device_is_a_failure() {
    let folder = Folder::new("full");
    let Ok(full) = std::fs::OpenOptions::new().write(true).open("/dev/full") else { return };
    let mut command = Command::new(env!("CARGO_BIN_EXE_piola"));
    command.arg("schema").current_dir(&folder.0).stdin(Stdio::null()).stdout(full);
    let status = command.status().unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(status.code(), Some(1));
}

#[cfg(not(feature = "nonlinear"))]
#[test]
fn a_program_without_viscoelastic_fluids_says_how_to_get_them() {
    let (code, shown, told) = Folder::new("no-nonlinear").piola(&["nonlinear", "start.csv"]);
    assert_eq!((code, shown.as_str()), (Some(2), ""));
    assert!(told.contains("--features nonlinear"), "{told}");
}

#[cfg(feature = "nonlinear")]
#[test]
fn viscoelastic_fluids_are_fitted_to_flows_in_files_of_their_own_and_flow_again() {
    // Oldroyd's fluid B: ηₛ = 1, ηₚ = 2 Pa s, λ = 4 s; N₁ = 2 ηₚ λ k², and the start-up at 1/s.
    let folder = Folder::new("boger");
    let rates = [0.5_f64, 1.0, 2.0, 4.0];
    let steady = rates.iter().fold("shear rate [1/s],N1 [Pa]\n".to_owned(), |mut text, k| {
        let _ = writeln!(text, "{k},{}", 16.0 * k * k);
        text
    });
    folder.write("normal.csv", &steady);
    let mut start = "# shear rate: 60 1/min\ntime [s],shear stress [Pa]\n0,\n".to_owned();
    for t in [0.5_f64, 1.0, 2.0, 4.0, 8.0, 16.0] {
        let _ = writeln!(start, "{t},{:?}", 1.0 + 2.0 * (1.0 - (-t / 4.0).exp()));
    }
    folder.write("start.csv", &start);
    let files = ["nonlinear", "start.csv", "normal.csv"];
    let (code, shown, told) = folder.piola(&[&files[..], &["--fluid", "oldroyd-b", "--fluid", "giesekus"]].concat());
    assert_eq!(code, Some(0), "{shown}{told}");
    assert!(shown.contains("start: 10 rows in 2 flows"), "{shown}");
    assert!(shown.contains("written to out/nonlinear-start: summary.json, predictions.csv, residuals.csv, fit.svg"));
    let summary: serde_json::Value =
        serde_json::from_str(&folder.read("out/nonlinear-start/summary.json")).expect("JSON");
    for (parameter, exact) in [1.0, 2.0, 4.0].into_iter().enumerate() {
        let found = summary["fluids"][0]["parameters"][parameter]["value"].as_f64().expect("a number");
        assert!((found / exact - 1.0).abs() < 1e-8, "{found}");
    }
    assert!(folder.read("out/nonlinear-start/fit.svg").contains("start-up of shear"));
    // τ = 3 k at the wall: Q = π R⁴ G/(8 η) = π · 10⁻¹² · 1000/24.
    let fluid = "out/nonlinear-start/summary.json#oldroyd-b";
    let pipe = ["flow", "pipe", "--fluid", fluid, "--radius", "1 mm", "--given", "pressure_gradient=1000 Pa/m"];
    let (code, shown, told) = folder.piola(&[&pipe[..], &["--json"]].concat());
    assert_eq!(code, Some(0), "{shown}{told}");
    let solved: serde_json::Value = serde_json::from_str(&shown).expect("JSON");
    let answers = solved["answers"].as_array().expect("answers");
    let discharge = answers.iter().find(|answer| answer["name"] == "discharge").expect("a discharge");
    let discharge = discharge["value"].as_f64().expect("a number");
    assert!((discharge / (core::f64::consts::PI * 1e-9 / 24.0) - 1.0).abs() < 1e-8, "{discharge}");
    let (code, _, told) = folder.piola(&[&files[..], &["--fluid", "newtonian"]].concat());
    assert!(code == Some(2) && told.contains("kbkz-rational"), "{told}");
    let (code, _, told) = folder.piola(&[&files[..], &["--spectrum", "normal.csv"]].concat());
    assert!(code == Some(2) && told.contains("the summary.json of `piola spectrum`"), "{told}");
}

#[test]
fn laws_of_several_kinds_are_refused_and_laws_with_history_are_known_by_their_names() {
    let folder = Folder::new("kinds");
    folder.write("test.csv", "mode,stretch,stress [MPa]\nuniaxial,1.5,0.4\nuniaxial,2,0.6\n");
    for laws in [["yeoh", "ogden-roxburgh"], ["hyperfoam:1", "yeoh"], ["viscoplastic", "hyperfoam:1"]] {
        let (code, _, told) = folder.piola(&["fit", "test.csv", "--law", laws[0], "--law", laws[1]]);
        let what = format!("`--law {} --law {}` is not accepted; valid: laws of one kind", laws[0], laws[1]);
        assert!(code == Some(2) && told.contains(&what), "{told}");
    }
    // A name that is not known is refused as such.
    let (code, _, told) = folder.piola(&["fit", "test.csv", "--law", "ogden-roxburg"]);
    assert!(code == Some(2) && told.contains("no model is called `ogden-roxburg`"), "{told}");
    let missing = if cfg!(feature = "history") { "no column is a time" } else { "--features history" };
    #[cfg(feature = "history")]
    let names = piola_measured::history::AnyHistoryModel::ALL.map(|law| law.to_string());
    #[cfg(not(feature = "history"))]
    let names = ["ogden-roxburgh".to_owned()];
    for law in names {
        let (code, shown, told) = folder.piola(&["fit", "test.csv", "--law", &law]);
        assert!(code == Some(2) && told.contains(missing), "{law}: {told}");
        let (code, json, _) = folder.piola(&["fit", "test.csv", "--law", &law, "--json"]);
        let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
        assert!(code == Some(2) && json["valid"] == false && shown.is_empty(), "{json}");
    }
}
