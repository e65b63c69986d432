//! Each command on good and bad scenes.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

const ORBIT: &str = "[central]\ngm = 1.0\n[[body]]\nname = 'comet'\nsemi_major_axis = 1.0\neccentricity = 0.5\n\
                     [time]\nrevolutions = 2\n[reference]\nclosed_form = 'kepler'\n";

/// A folder of its own for each test, removed at its end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("piola-cli-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap_or_else(|error| panic!("{error}"));
        Self(path)
    }

    fn scene(&self, text: &str) -> PathBuf {
        let path = self.0.join("orbit.toml");
        std::fs::write(&path, text).unwrap_or_else(|error| panic!("{error}"));
        path
    }

    fn piola(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap_or_else(|error| panic!("{error}"))
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_piola"));
        command.args(arguments).current_dir(&self.0).stdin(Stdio::null());
        command
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn out(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn err(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn run_writes_everything_that_the_plan_lists() {
    let folder = Folder::new("run");
    folder.scene(ORBIT);
    let plan = json(&out(&folder.piola(&["plan", "orbit.toml", "--json"])));
    let output = folder.piola(&["run", "orbit.toml"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert!(out(&output).contains("closed form") && out(&output).contains("comet"), "{}", out(&output));
    for file in plan["files"].as_array().into_iter().flatten() {
        let path = folder.0.join("out/orbit").join(file.as_str().unwrap_or_default());
        assert!(!read(&path).is_empty());
    }
    let summary = json(&read(&folder.0.join("out/orbit/summary.json")));
    assert_eq!(summary["status"], "completed");
}

#[test]
fn json_of_a_run_equals_the_summary_written() {
    let folder = Folder::new("json");
    folder.scene(ORBIT);
    let output = folder.piola(&["run", "orbit.toml", "--json", "--out", "results", "--set", "output.figures=false"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert_eq!(json(&out(&output)), json(&read(&folder.0.join("results/summary.json"))));
    assert!(!folder.0.join("results/trajectory.svg").exists());
}

#[test]
fn invalid_scene_exits_with_2_and_writes_nothing() {
    let folder = Folder::new("invalid");
    folder.scene(&ORBIT.replace("gm = 1.0", "gm = -1.0").replace("eccentricity", "excentricity"));
    for command in ["run", "plan", "check"] {
        let output = folder.piola(&[command, "orbit.toml"]);
        assert_eq!(output.status.code(), Some(2));
        let shown = err(&output);
        assert!(
            shown.contains("orbit.toml:2:6") && shown.contains("orbit.toml:6:1") && shown.contains("mistakes"),
            "{shown}"
        );
        assert!(out(&output).is_empty());
    }
    assert!(!folder.0.join("out").exists());
    let output = folder.piola(&["check", "orbit.toml", "--json"]);
    let report = json(&out(&output));
    assert_eq!((&report["valid"], &report["mistakes"][0]["line"]), (&false.into(), &2.into()), "{report}");
}

#[test]
fn mistake_in_a_setting_is_shown_in_the_argument() {
    let folder = Folder::new("setting");
    folder.scene(ORBIT);
    let output = folder.piola(&["run", "orbit.toml", "--set", "body.comet.mass=-1 kg"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("--set:1:17"), "{}", err(&output));
}

#[test]
fn unwritable_output_folder_exits_with_2_before_the_run() {
    let folder = Folder::new("unwritable");
    folder.scene(ORBIT);
    std::fs::write(folder.0.join("file"), "text").unwrap_or_else(|error| panic!("{error}"));
    let output = folder.piola(&["run", "orbit.toml", "--out", "file/results"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("cannot write to the output folder `file/results`"), "{}", err(&output));
}

#[test]
fn missing_file_folder_and_garbage_exit_with_2() {
    let folder = Folder::new("garbage");
    assert_eq!(folder.piola(&["run", "nothing.toml"]).status.code(), Some(2));
    assert_eq!(folder.piola(&["run", "."]).status.code(), Some(2));
    std::fs::write(folder.0.join("garbage.toml"), vec![b'x'; 10_000_000]).unwrap_or_else(|error| panic!("{error}"));
    let output = folder.piola(&["run", "garbage.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("has 10000000 bytes") && err(&output).len() < 2000, "{}", err(&output));
    assert_eq!(folder.piola(&["walk", "garbage.toml"]).status.code(), Some(2));
}

#[test]
fn failed_run_exits_with_1_and_writes_what_it_has() {
    let folder = Folder::new("failed");
    folder.scene(
        "[gravity]\n[[body]]\nname = 'a'\ngm = 1\nposition = [1, 0, 0]\nvelocity = [0, 0, 0]\n\
         [[body]]\nname = 'b'\ngm = 1\nposition = [-1, 0, 0]\nvelocity = [0, 0, 0]\n[time]\nend = 10\n",
    );
    let output = folder.piola(&["run", "orbit.toml"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("the run failed") && err(&output).contains("out/orbit"), "{}", err(&output));
    let summary = json(&read(&folder.0.join("out/orbit/summary.json")));
    assert_eq!(summary["status"], "failed");
    assert!(100 < read(&folder.0.join("out/orbit/trajectory.csv")).len());
}

#[test]
#[cfg(unix)]
fn signals_stop_a_run_which_writes_what_it_has() {
    for signal in ["-INT", "-TERM"] {
        let folder = Folder::new(&format!("signal{signal}"));
        folder.scene(&ORBIT.replace("revolutions = 2", "revolutions = 1e9"));
        let mut run = folder
            .command(&["run", "orbit.toml"])
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap_or_else(|error| panic!("{error}"));
        std::thread::sleep(Duration::from_millis(800));
        let kill = Command::new("kill").args([signal, &run.id().to_string()]).status();
        assert!(kill.is_ok_and(|status| status.success()));
        let begun = Instant::now();
        while run.try_wait().unwrap_or_else(|error| panic!("{error}")).is_none() {
            if Duration::from_secs(30) < begun.elapsed() {
                let _ = run.kill();
                panic!("the run did not stop");
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        let output = run.wait_with_output().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(output.status.code(), Some(1), "{}", err(&output));
        assert!(err(&output).contains("interrupted at"), "{}", err(&output));
        let summary = json(&read(&folder.0.join("out/orbit/summary.json")));
        assert_eq!(summary["status"], "interrupted");
    }
}

#[test]
fn plan_check_and_schema_are_printed() {
    let folder = Folder::new("print");
    folder.scene(ORBIT);
    let plan = folder.piola(&["plan", "orbit.toml"]);
    assert!(plan.status.success() && out(&plan).contains("skipped") && out(&plan).contains("dormand-prince-853"));
    let check = folder.piola(&["check", "orbit.toml"]);
    assert!(check.status.success() && out(&check).contains("is valid"), "{}", out(&check));
    let schema = folder.piola(&["schema"]);
    assert!(json(&out(&schema))["properties"]["central"].is_object());
    assert!(!folder.0.join("out").exists());
}

/// A table with errors in the third digit of a neo-Hookean bar and sheet.
const RUBBER: &str = "mode,stretch,stress_MPa\nuniaxial,1.5,0.423\nuniaxial,2,0.699\nuniaxial,3,1.157\nuniaxial,4,1.573\n\
                      planar,1.5,0.482\nplanar,2,0.752\nplanar,3,1.183\nplanar,4,1.596\n";

#[test]
fn fit_compares_laws_and_writes_summary_tables_and_figure() {
    let folder = Folder::new("fit");
    std::fs::write(folder.0.join("rubber.csv"), RUBBER).unwrap_or_else(|error| panic!("{error}"));
    let output = folder.piola(&["fit", "rubber.csv", "--law", "neo-hookean", "--law", "mooney-rivlin"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let shown = out(&output);
    assert!(shown.contains("neo-hookean") && shown.contains("AICc") && shown.contains("MPa"), "{shown}");
    let summary = json(&read(&folder.0.join("out/fit-rubber/summary.json")));
    assert_eq!(summary["best_by_aicc"], "neo-hookean");
    for file in ["curves.csv", "residuals.csv", "fit.svg"] {
        assert!(!read(&folder.0.join("out/fit-rubber").join(file)).is_empty());
    }
    let arguments =
        ["fit", "rubber.csv", "--law", "neo-hookean", "--law", "mooney-rivlin", "--json", "--out", "results"];
    let output = folder.piola(&arguments);
    assert_eq!(json(&out(&output)), json(&read(&folder.0.join("results/summary.json"))));
}

#[test]
fn fit_of_bad_tables_laws_or_bounds_exits_with_2_and_writes_nothing() {
    let folder = Folder::new("bad-fit");
    std::fs::write(folder.0.join("rubber.csv"), RUBBER).unwrap_or_else(|error| panic!("{error}"));
    std::fs::write(folder.0.join("bad.csv"), RUBBER.replace("1.157", "much")).unwrap_or_else(|error| panic!("{error}"));
    std::fs::write(folder.0.join("empty.csv"), "").unwrap_or_else(|error| panic!("{error}"));
    let cases: [(&[&str], &str); 8] = [
        (&["bad.csv"], "bad.csv:4: stress is `much`"),
        (&["empty.csv"], "empty.csv:1: the table is empty"),
        (&["none.csv"], "cannot read `none.csv`"),
        (&["rubber.csv", "--law", "odgen:3"], "no model is called `odgen:3`"),
        (&["rubber.csv", "--law", "gent", "--bound", "gent.Jm=0..5"], "no value of `Jm`"),
        (&["rubber.csv", "--law", "gent", "--bound", "gent.Jm"], "`gent.Jm` cannot be read"),
        (&["rubber.csv", "--law", "gent", "--mode-weights", "shear=2"], "no test is called `shear`"),
        (&["rubber.csv", "--law", "gent", "--confidence", "2"], "the confidence 2 is not between 0 and 1"),
    ];
    for (arguments, expected) in cases {
        let output = folder.piola(&[&["fit"], arguments].concat());
        assert!(err(&output).contains(expected), "{arguments:?}: {}", err(&output));
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
    assert!(!folder.0.join("out").exists());
    let report = json(&out(&folder.piola(&["fit", "bad.csv", "--json"])));
    assert_eq!((&report["valid"], &report["mistakes"][0]["line"]), (&false.into(), &4.into()), "{report}");
}

/// Discharges of a fluid of viscosity 2 in a pipe of radius 1, π c/16.
fn discharges() -> String {
    let row = |c: i32| format!("{c},{}\n", core::f64::consts::PI * f64::from(c) / 16.0);
    (1..=12).map(row).fold("# radius: 1 m\npressure_gradient,discharge\n".to_owned(), |text, row| text + &row)
}

#[test]
fn recover_and_fit_flow_write_summaries_tables_and_figures() {
    let folder = Folder::new("flow");
    std::fs::write(folder.0.join("pipe.csv"), discharges()).unwrap_or_else(|error| panic!("{error}"));
    let output = folder.piola(&["recover", "pipe.csv", "--flow", "pipe"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let summary = json(&read(&folder.0.join("out/recover-pipe/summary.json")));
    let rate = summary["flow_curve"][3]["shear_rate"].as_f64().unwrap_or_default();
    assert!((rate - 1.0).abs() < 1e-10, "{summary}"); // τ = c/2 = 2
    for file in ["flow-curve.csv", "residuals.csv", "flow-curve.svg"] {
        assert!(!read(&folder.0.join("out/recover-pipe").join(file)).is_empty());
    }
    let output =
        folder.piola(&["fit-flow", "pipe.csv", "--flow", "pipe", "--fluid", "newtonian", "--json", "--out", "fits"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let summary = json(&out(&output));
    assert_eq!(summary, json(&read(&folder.0.join("fits/summary.json"))));
    let viscosity = summary["fluids"][0]["parameters"][0]["value"].as_f64().unwrap_or_default();
    assert!((viscosity - 2.0).abs() < 1e-9, "{summary}");
}

#[test]
fn bad_flow_tables_fluids_or_geometries_exit_with_2_and_write_nothing() {
    let folder = Folder::new("bad-flow");
    std::fs::write(folder.0.join("pipe.csv"), discharges()).unwrap_or_else(|error| panic!("{error}"));
    let bad = discharges().replace("3,0.589", "3,-0.589");
    std::fs::write(folder.0.join("bad.csv"), bad).unwrap_or_else(|error| panic!("{error}"));
    let cases: [(&[&str], &str); 6] = [
        (&["recover", "bad.csv", "--flow", "pipe"], "bad.csv:5: discharge is -0.589"),
        (&["recover", "pipe.csv", "--flow", "hose"], "`hose` cannot be read; valid: pipe, channel, couette or curve"),
        (&["recover", "pipe.csv", "--flow", "channel"], "half_width is not given"),
        (&["recover", "pipe.csv", "--flow", "pipe", "--radius", "1kg"], "`radius = 1kg` cannot be read"),
        (&["recover", "pipe.csv", "--flow", "pipe", "--confidence", "2"], "the confidence 2"),
        (&["fit-flow", "pipe.csv", "--flow", "pipe", "--fluid", "water"], "`water` cannot be read; valid: newtonian"),
    ];
    for (arguments, expected) in cases {
        let output = folder.piola(arguments);
        assert!(err(&output).contains(expected), "{arguments:?}: {}", err(&output));
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
    assert!(!folder.0.join("out").exists());
}
