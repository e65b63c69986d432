//! Each command on good and bad scenes.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use piola_testkit::{Tol, assert_close};

/// Numbers recovered from tables without noise.
const TABLE: Tol = Tol::stated(1e-10, "interpolation between rows of whole numbers, written with all digits");

pub(crate) const ORBIT: &str = "[central]\ngm = 1.0\n[[body]]\nname = 'comet'\nsemi_major_axis = 1.0\neccentricity = 0.5\n\
                     [time]\nrevolutions = 2\n[reference]\nclosed_form = 'kepler'\n";

/// A folder of its own for each test, removed at its end.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    pub(crate) fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("piola-cli-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap_or_else(|error| panic!("{error}"));
        Self(path)
    }

    pub(crate) fn scene(&self, text: &str) -> PathBuf {
        let path = self.0.join("orbit.toml");
        std::fs::write(&path, text).unwrap_or_else(|error| panic!("{error}"));
        path
    }

    pub(crate) fn piola(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap_or_else(|error| panic!("{error}"))
    }

    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
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

pub(crate) fn out(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

pub(crate) fn err(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

pub(crate) fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

pub(crate) fn read(path: &Path) -> String {
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
            .command(&["run", "orbit.toml", "--yes"])
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
    assert!(plan.status.success() && out(&plan).contains("skipped") && out(&plan).contains("nystrom-1210"));
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
        (&["rubber.csv", "--law", "gent", "--bound", "gent.Jm"], "`gent.Jm` is not accepted"),
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

#[test]
fn fit_says_what_few_or_strange_data_do_not_tell() {
    let folder = Folder::new("few-fit");
    let run = |name: &str, rows: &str, laws: &[&str]| {
        let table = format!("mode,stretch,stress\n{rows}");
        std::fs::write(folder.0.join(name), table).unwrap_or_else(|error| panic!("{error}"));
        let output = folder.piola(&[&["fit", name], laws].concat());
        (output.status.code(), out(&output), err(&output))
    };
    let two = "uniaxial,1.5,0.4\nuniaxial,2,0.6\n";
    let (code, shown, _) = run("two.csv", two, &["--law", "mooney-rivlin"]);
    assert_eq!(code, Some(0));
    for expected in ["no degrees of freedom: 2 stresses", "no error: no degrees of freedom", "No law has an AICc"] {
        assert!(shown.contains(expected), "{shown}");
    }
    assert!(!shown.contains("not determined"), "{shown}");
    let opposed = "uniaxial,1.1,-0.1\nuniaxial,1.5,-0.2\nuniaxial,2,-0.3\nuniaxial,3,-0.2\n";
    let (code, shown, _) = run("opposed.csv", opposed, &["--law", "neo-hookean", "--law", "gent"]);
    assert_eq!(code, Some(1));
    assert!(shown.contains("stopped: no stiffness, all factors at their bound 0"), "{shown}");
    assert!(shown.contains("at its bound") && !shown.contains("not finite"), "{shown}");
    let (code, _, told) = run("rest.csv", "uniaxial,1,0\nuniaxial,1,0.1\nuniaxial,1,0\n", &[]);
    assert_eq!(code, Some(2));
    assert!(told.contains("all its stretches are 1") && told.contains("the data say nothing"), "{told}");
}

/// The report is well formed, needs nothing from elsewhere, and has every figure, the plan and the scene.
#[test]
fn a_report_is_one_file_with_figures_tables_plan_and_inputs() {
    let folder = Folder::new("report");
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/balloon.toml");
    let output = folder.piola(&["run", &scene.display().to_string(), "--report", "--out", "balloon"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert!(out(&output).contains("report.html"));
    let html = read(&folder.0.join("balloon/report.html"));
    let body = html.strip_prefix("<!DOCTYPE html>").unwrap_or_default();
    let page = roxmltree::Document::parse(body).unwrap_or_else(|error| panic!("{error}"));
    let count = |name: &str| page.descendants().filter(|node| node.has_tag_name(name)).count();
    let drawings = std::fs::read_dir(folder.0.join("balloon")).map_or(0, |files| {
        files.flatten().filter(|file| file.path().extension().is_some_and(|ending| ending == "svg")).count()
    });
    let figures = page.descendants().filter(|node| node.tag_name().name() == "svg").count();
    assert!(0 < drawings && figures == drawings, "{figures} of {drawings}");
    let names = |name: &'static str| page.descendants().any(|node| node.tag_name().name() == name);
    assert!(names("table") && !names("script") && !names("link") && !names("img"), "{}", count("table"));
    assert!(html.contains("shear_modulus") || html.contains("[balloon]"), "the scene");
    assert!(!html.contains("src=") && !html.contains("href="));
}

#[test]
fn help_of_every_verb_has_lines_of_at_most_80_columns() {
    let folder = Folder::new("help");
    let top = out(&folder.piola(&["--help"]));
    let (_, list) = top.split_once("Commands:").unwrap_or_default();
    let (list, _) = list.split_once("Options:").unwrap_or_default();
    let verbs = list.lines().filter_map(|line| line.strip_prefix("  "));
    let verbs: Vec<&str> = verbs.filter(|verb| !verb.starts_with(' ') && *verb != "help").collect();
    assert!(14 <= verbs.len() && verbs.contains(&"sweep"), "{verbs:?}");
    let absent = |verb: &str| match verb {
        "nonlinear" => cfg!(not(feature = "nonlinear")),
        "register" => cfg!(not(feature = "register")),
        "specimen" => cfg!(not(feature = "specimens")),
        _ => false,
    };
    for arguments in verbs.iter().map(|verb| vec![*verb]).chain([vec![]]) {
        for flag in ["--help", "-h"] {
            let output = folder.piola(&[&arguments[..], &[flag]].concat());
            // A program without a verb says which feature has it.
            let built = !arguments.iter().any(|verb| absent(verb));
            assert_eq!(output.status.code(), Some(if built { 0 } else { 2 }), "{arguments:?}: {}", err(&output));
            let text = out(&output);
            assert!(!built || text.contains("Usage: piola"), "{text}");
            let long = text.lines().find(|line| 80 < line.chars().count());
            assert_eq!(long, None, "{arguments:?} {flag}");
        }
    }
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
    let rate = summary["flow_curve"]["points"][3]["shear_rate"].as_f64().unwrap_or_default();
    assert_close("k at τ = c/2 = 2", &[rate], &[1.0], TABLE);
    for file in ["flow-curve.csv", "residuals.csv", "flow-curve.svg"] {
        assert!(!read(&folder.0.join("out/recover-pipe").join(file)).is_empty());
    }
    let output =
        folder.piola(&["fit-flow", "pipe.csv", "--flow", "pipe", "--fluid", "newtonian", "--json", "--out", "fits"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let summary = json(&out(&output));
    assert_eq!(summary, json(&read(&folder.0.join("fits/summary.json"))));
    let viscosity = summary["fluids"][0]["parameters"][0]["value"].as_f64().unwrap_or_default();
    assert_close("viscosity", &[viscosity], &[2.0], TABLE);
}

#[test]
fn recover_corrects_for_slip_and_ends_and_takes_thrusts() {
    let folder = Folder::new("corrections");
    let write = |name: &str, head: &str, row: &dyn Fn(f64) -> String| {
        let rows: Vec<String> = (1..=12).map(f64::from).map(row).collect();
        std::fs::write(folder.0.join(name), format!("{head}\n{}\n", rows.join("\n"))).unwrap_or_else(|e| panic!("{e}"));
    };
    let quarter = 0.25 * core::f64::consts::PI;
    for radius in [1.0_f64, 2.0, 4.0] {
        // A viscosity of 1 and a slip of τ/10.
        let head = format!("# radius: {radius} m\npressure_gradient,discharge");
        let row = |t: f64| format!("{},{}", 2.0 * t / radius, quarter * radius.powi(3) * (t + 0.4 * t / radius));
        write(&format!("pipe-{radius}.csv"), &head, &row);
    }
    let output = folder.piola(&["recover", "pipe-1.csv", "pipe-2.csv", "pipe-4.csv", "--flow", "pipe", "--slip"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let summary = json(&read(&folder.0.join("out/recover-pipe-1/summary.json")));
    let [rate, slip] = [&summary["flow_curve"]["points"][3]["shear_rate"], &summary["slip"][3]["slip_velocity"]];
    let found = [rate, slip].map(|value| value.as_f64().unwrap_or_default());
    assert_close("k and slip", &found, &[4.0, 0.4], TABLE);
    for file in ["flow-curve.csv", "slip.csv", "flow-curve.svg"] {
        assert!(!read(&folder.0.join("out/recover-pipe-1").join(file)).is_empty());
    }
    for length in [10.0, 20.0] {
        let head = format!("# radius: 1 m\n# length: {length} m\ndischarge,pressure_difference");
        write(&format!("capillary-{length}.csv"), &head, &|t| format!("{},{}", quarter * t, t * (2.0 * length + 3.0)));
    }
    let files = ["recover", "capillary-10.csv", "capillary-20.csv", "--flow", "capillary", "--json", "--out", "ends"];
    let output = folder.piola(&files);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let length = json(&out(&output))["ends"][3]["end_length"].as_f64().unwrap_or_default();
    assert_close("length of ends", &[length], &[1.5], TABLE);
    // N₁ = 2F/(πR²) and k = Ω/α.
    write("cone.csv", "angular_velocity,torque,thrust", &|w| format!("{w},{},{}", 4.0 * w, 2.0 * quarter * w * w));
    let output =
        folder.piola(&["recover", "cone.csv", "--flow", "cone", "--radius", "1m", "--angle", "0.1 rad", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let point = &json(&out(&output))["normal_stress"]["points"][3];
    let found = ["shear_rate", "first_normal_stress_difference"].map(|key| point[key].as_f64().unwrap_or_default());
    assert_close("k and N₁", &found, &[40.0, 16.0], TABLE);
}

#[test]
fn bad_flow_tables_fluids_or_geometries_exit_with_2_and_write_nothing() {
    let folder = Folder::new("bad-flow");
    std::fs::write(folder.0.join("pipe.csv"), discharges()).unwrap_or_else(|error| panic!("{error}"));
    let bad = discharges().replace("3,0.589", "3,-0.589");
    std::fs::write(folder.0.join("bad.csv"), bad).unwrap_or_else(|error| panic!("{error}"));
    let tables = [
        ("no-number.csv", discharges().replace("\n3,", "\n3,x")),
        ("falling.csv", discharges().replace("\n3,0.5", "\n3,0.2")),
        ("unit.csv", discharges().replace("discharge", "discharge [m^2/s]")),
        ("banding.csv", "shear_rate,shear_stress\n1,1\n2,3\n3,2\n4,4\n".to_owned()),
        ("gap.csv", "# inner_radius: 2 cm\n# outer_radius: 1 cm\ntorque_per_length,speed_difference\n1,1\n".to_owned()),
    ];
    for (name, text) in tables {
        std::fs::write(folder.0.join(name), text).unwrap_or_else(|error| panic!("{error}"));
    }
    let cases: [(&[&str], &str); 15] = [
        (&["recover", "bad.csv", "--flow", "pipe"], "bad.csv:5: discharge is -0.589"),
        (&["fit-flow", "no-number.csv", "--flow", "pipe"], "no-number.csv:5: discharge is x0.58"),
        (&["recover", "falling.csv", "--flow", "pipe", "--noise", "0"], "falling.csv:5: the response"),
        (&["fit-flow", "unit.csv", "--flow", "pipe"], "unit.csv:2: `m^2/s` is no unit of discharge"),
        (&["fit-flow", "falling.csv", "--flow", "pipe", "--noise", "0"], "falling.csv:5: the response"),
        (&["fit-flow", "banding.csv", "--flow", "curve"], "banding.csv:4: the response 2e0 is not above 3e0"),
        (
            &["recover", "gap.csv", "--flow", "couette"],
            "gap.csv:2: inner_radius = 0.02 m, outer_radius = 0.01 m; valid",
        ),
        (
            &["recover", "pipe.csv", "pipe.csv", "--flow", "pipe"],
            "`2 files` is not accepted; valid: one file, or several",
        ),
        (&["recover", "pipe.csv", "pipe.csv", "--flow", "pipe", "--slip"], "the radius is 1e0 m in all tables"),
        (&["fit-flow", "pipe.csv", "--flow", "capillary"], "length is not given"),
        (&["recover", "pipe.csv", "--flow", "hose"], "`hose` is not accepted; valid: pipe, capillary, channel"),
        (&["recover", "pipe.csv", "--flow", "channel"], "half_width is not given"),
        (&["recover", "pipe.csv", "--flow", "pipe", "--radius", "1kg"], "`--radius 1kg` is not accepted"),
        (&["recover", "pipe.csv", "--flow", "pipe", "--confidence", "2"], "the confidence 2"),
        (
            &["fit-flow", "pipe.csv", "--flow", "pipe", "--fluid", "water"],
            "no fluid that can be fitted is called `water`; they are newtonian",
        ),
    ];
    for (arguments, expected) in cases {
        let output = folder.piola(arguments);
        assert!(err(&output).contains(expected), "{arguments:?}: {}", err(&output));
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
    assert!(!folder.0.join("out").exists());
}

#[test]
fn study_is_planned_checked_and_run_like_any_scene() {
    let folder = Folder::new("study");
    folder.scene("[room]\ntype = 'ellipse'\nsemi_axes = [2, 1]\nspeed = 1\ngrid = 31\n");
    assert!(out(&folder.piola(&["check", "orbit.toml"])).contains("orbit.toml is valid: first arrival"));
    let plan = json(&out(&folder.piola(&["plan", "orbit.toml", "--json"])));
    let output = folder.piola(&["run", "orbit.toml", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let summary = json(&out(&output));
    assert_eq!(summary, json(&read(&folder.0.join("out/orbit/summary.json"))));
    let loss = &summary["results"]["first_loss_of_invertibility"]["time_s"];
    let tolerance = Tol::stated(1e-9, "tolerance of the characteristics, 1e-13, over the flat minimum");
    assert_close("b²/a", &[loss.as_f64().unwrap_or_default()], &[0.5], tolerance);
    for file in plan["files"].as_array().into_iter().flatten() {
        assert!(!read(&folder.0.join("out/orbit").join(file.as_str().unwrap_or_default())).is_empty());
    }
    let output = folder.piola(&["run", "orbit.toml", "--set", "room.speed=1 kg"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("--set:1:12"), "{}", err(&output));
}

#[test]
fn shells_get_completions_and_the_manual_its_pages() {
    let folder = Folder::new("shell");
    for (shell, sign) in [("bash", "complete -F _piola"), ("zsh", "#compdef piola"), ("fish", "complete -c piola")] {
        let found = folder.piola(&["completions", shell]);
        assert_eq!(found.status.code(), Some(0));
        assert!(out(&found).contains(sign) && out(&found).contains("spectrum"), "{shell}");
    }
    let pages = [folder.piola(&["manual"]), folder.piola(&["manual", "fit-flow"])].map(|page| out(&page));
    assert!(pages[0].contains(".TH piola 1") && pages[1].contains(".TH piola-fit-flow 1"), "{}", pages[1]);
    let none = folder.piola(&["manual", "fly"]);
    assert_eq!(none.status.code(), Some(2));
    assert!(err(&none).contains("no command is called `fly`; valid: run, plan"));
}
