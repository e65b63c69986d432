//! The option `--intervals` of every command that has it, from outside.

use core::fmt::Write as _;

use super::measurements::{Folder, RUBBER, curve};

/// Errors of a percent, the same in every run.
fn error(i: u32) -> f64 {
    0.01 * (f64::from(i * 37 % 89) / 44.0 - 1.0)
}

/// A foam with μ = 0.4 `MPa`, α = 6, ν = 0.2 and errors: P = (2 μ/α)(λ^α − λₜ^α)/λ, λₜ = λ^(−ν).
fn foam() -> String {
    let mut text = "mode,stretch,stress [MPa],lateral stretch\n".to_owned();
    for (x, i) in [0.4_f64, 0.5, 0.6, 0.7, 0.8, 0.9, 1.1, 1.2].into_iter().zip(0..) {
        let side = x.powf(-0.2) * (1.0 + 0.1 * error(i + 20));
        let stress = 0.8 / 6.0 * (x.powi(6) - x.powf(-1.2)) / x * (1.0 + error(i));
        let _ = writeln!(text, "uniaxial,{x:?},{stress:?},{side:?}");
    }
    text
}

/// A neo-Hookean bar, μ = 0.4 `MPa`, with errors of a percent of a middling stress.
fn bar() -> String {
    (0..12_u32).fold("mode,stretch,stress [MPa]\n".to_owned(), |mut text, i| {
        let x = 1.2 + 0.2 * f64::from(i);
        let _ = writeln!(text, "uniaxial,{x:?},{:?}", 0.4 * (x - x.powi(-2)) + 0.6 * error(i));
        text
    })
}

/// G′ and G″ of one mode.
fn moduli() -> String {
    let mut text = "omega [rad/s],G' [Pa],G'' [Pa]\n".to_owned();
    for (w, i) in [0.1_f64, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0].into_iter().zip(0..) {
        let [storage, loss] = [w * w, w].map(|x| 2e3 * x / (1.0 + w * w));
        let _ = writeln!(text, "{w:?},{:?},{:?}", storage * (1.0 + error(i)), loss * (1.0 + error(i + 30)));
    }
    text
}

/// Ends of the interval of the parameter `name` of the first law or fluid.
fn ends(json: &str, list: &str, name: &str) -> [f64; 2] {
    let summary: serde_json::Value = serde_json::from_str(json).unwrap_or_else(|error| panic!("{error}: {json}"));
    let parameters = summary[list][0]["parameters"].as_array().unwrap_or_else(|| panic!("{json}"));
    let found = parameters.iter().find(|parameter| parameter["name"] == name).unwrap_or_else(|| panic!("{json}"));
    [0, 1].map(|k| found["interval"][k].as_f64().unwrap_or_else(|| panic!("{found}")))
}

#[test]
fn linear_profile_and_bootstrap_intervals_of_one_parameter_nearly_agree() {
    let folder = Folder::new("kinds-of-intervals");
    folder.write("bar.csv", &bar());
    folder.write("foam.csv", &foam());
    folder.write("oil.csv", &curve(|k| 0.9 * k));
    let commands: [(&[&str], &str, &str); 3] = [
        (&["fit", "bar.csv", "--law", "neo-hookean"], "laws", "mu"),
        (&["fit", "foam.csv", "--law", "hyperfoam:1"], "laws", "alpha1"),
        (&["fit-flow", "oil.csv", "--flow", "curve", "--fluid", "newtonian"], "fluids", "viscosity_coefficient"),
    ];
    for (command, list, name) in commands {
        let of = |kind: &[&str]| {
            let (code, shown, told) = folder.piola(&[command, &["--json"], kind].concat());
            assert_eq!(code, Some(0), "{kind:?}: {shown}{told}");
            ends(&shown, list, name)
        };
        let linear = of(&[]);
        assert_eq!(linear.map(f64::to_bits), of(&["--intervals", "linear"]).map(f64::to_bits));
        let profile = of(&["--intervals", "profile"]);
        assert_eq!(profile.map(f64::to_bits), of(&["--profile"]).map(f64::to_bits));
        let bootstrap = of(&["--intervals", "bootstrap:200"]);
        assert_ne!(linear.map(f64::to_bits), bootstrap.map(f64::to_bits), "{command:?}");
        let [low, high] = linear;
        for (other, share) in [(profile, 0.05), (bootstrap, 0.2)] {
            // These parameters are well determined; of 200 samples an end is told to a tenth of the width.
            let within = |(a, b): (&f64, f64)| (a - b).abs() < share * (high - low);
            assert!(low < high && other.iter().zip(linear).all(within), "{command:?}: {linear:?} {other:?}");
        }
    }
}

#[test]
fn intervals_of_no_known_kind_and_bootstraps_of_too_few_samples_are_refused_before_a_fit() {
    let folder = Folder::new("nonsense");
    folder.write("rubber.csv", RUBBER);
    folder.write("foam.csv", &foam());
    folder.write("oil.csv", &curve(|k| 0.9 * k));
    folder.write("melt.csv", &moduli());
    let commands: [&[&str]; 4] = [
        &["fit", "rubber.csv"],
        &["fit", "foam.csv", "--law", "hyperfoam:1"],
        &["fit-flow", "oil.csv", "--flow", "curve"],
        &["spectrum", "melt.csv"],
    ];
    for command in commands {
        for kind in ["exact", "bootstrap:", "bootstrap:199", "bootstrap:100001", "bootstrap:-200", "profile:3", ""] {
            let (code, shown, told) = folder.piola(&[command, &["--intervals", kind]].concat());
            let what = format!("no intervals are called `{kind}`; they are linear, profile, bootstrap");
            assert!(code == Some(2) && shown.is_empty() && told.contains(&what), "{command:?} {kind}: {shown}{told}");
        }
    }
    let (code, _, told) = folder.piola(&["fit", "rubber.csv", "--intervals", "linear", "--profile"]);
    assert!(code == Some(2) && told.contains("--profile"), "{told}");
    assert!(!folder.0.join("out").exists());
}

#[test]
fn spectra_have_linear_intervals_and_refuse_others_with_the_reason() {
    let folder = Folder::new("spectra-intervals");
    folder.write("melt.csv", &moduli());
    let run = |kind: &[&str]| folder.piola(&[&["spectrum", "melt.csv", "--modes", "1", "--json"], kind].concat());
    let (code, linear, told) = run(&["--intervals", "linear"]);
    assert_eq!(code, Some(0), "{told}");
    assert_eq!(linear, run(&[]).1);
    for kind in ["profile", "bootstrap:500"] {
        let (code, shown, told) = run(&["--intervals", kind]);
        let what = format!(
            "`--intervals {kind}` is not accepted; valid: linear for a spectrum: modes that are fitted anew exchange"
        );
        assert!(code == Some(2) && (told.contains(&what) || shown.contains(&what)), "{shown}{told}");
    }
}

#[test]
#[cfg(unix)]
fn a_signal_ends_a_bootstrap_of_a_foam_whose_fit_is_written_with_linear_intervals() {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};
    let folder = Folder::new("foam-signal");
    folder.write("foam.csv", &foam());
    let arguments = ["fit", "foam.csv", "--law", "hyperfoam:1", "--intervals", "bootstrap:100000", "--out", "stopped"];
    let mut run = Command::new(env!("CARGO_BIN_EXE_piola"))
        .args(arguments)
        .current_dir(&folder.0)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap_or_else(|error| panic!("{error}"));
    std::thread::sleep(Duration::from_secs(1));
    let sent = Command::new("kill").args(["-INT", &run.id().to_string()]).status();
    assert!(sent.is_ok_and(|status| status.success()));
    let begun = Instant::now();
    while run.try_wait().unwrap_or_else(|error| panic!("{error}")).is_none() {
        if Duration::from_secs(30) < begun.elapsed() {
            let _ = run.kill();
            panic!("the signal was not heard");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let output = run.wait_with_output().unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("interrupted: what was fitted until then is written"));
    let stopped = folder.read("stopped/summary.json");
    assert!(stopped.contains("\"interrupted\": true"), "{stopped}");
    let (_, linear, _) = folder.piola(&["fit", "foam.csv", "--law", "hyperfoam:1", "--json"]);
    let [found, linear] = [&stopped, &linear].map(|json| ends(json, "laws", "alpha1").map(f64::to_bits));
    assert_eq!(found, linear);
}
