//! Scenes of fields on a box from outside.

use std::process::{Command, Output, Stdio};

const BAR: &str = "[box]\ntype = 'motion'\nsides = '[1, 2] m'\nmodes = [2, 2]\nfirst_lame_parameter = '2 Pa'\n\
                   shear_modulus = '1 Pa'\ndensity = '1 kg/m^3'\nduration = '3 s'\ninterval = '0.5 s'\n\
                   [[start]]\ntype = 'mode'\nindices = [1, 0]\nvelocity = '[1, 0] m/s'\n";

/// Runs the program on the scene in a folder of its own, and says whether it left results there.
fn piola(name: &str, arguments: &[&str]) -> (Output, Option<String>) {
    let folder = std::env::temp_dir().join(format!("piola-cli-box-{}-{name}", std::process::id()));
    let failed = |error: std::io::Error| panic!("{error}");
    std::fs::create_dir_all(&folder).unwrap_or_else(failed);
    std::fs::write(folder.join("bar.toml"), BAR).unwrap_or_else(failed);
    let mut command = Command::new(env!("CARGO_BIN_EXE_piola"));
    let output = command.args(arguments).current_dir(&folder).stdin(Stdio::null()).output();
    let summary = std::fs::read_to_string(folder.join("out/bar/summary.json")).ok();
    std::fs::remove_dir_all(&folder).unwrap_or_else(|error| panic!("{error}"));
    (output.unwrap_or_else(|error| panic!("{error}")), summary)
}

#[test]
#[cfg(feature = "spectral")]
fn box_is_run_with_the_instants_that_were_set() {
    let (output, summary) = piola("run", &["run", "bar.toml", "--json", "--set", "box.interval=1 s"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(Some(String::from_utf8_lossy(&output.stdout).into_owned()), summary);
    let summary: serde_json::Value = serde_json::from_str(&summary.unwrap_or_default()).unwrap_or_default();
    assert_eq!((&summary["status"], &summary["results"]["instants"]), (&"completed".into(), &4.into()));
}

#[test]
fn mode_that_vanishes_exits_with_2_and_writes_nothing() {
    let (output, summary) = piola("refused", &["run", "bar.toml", "--set", "start[0].indices=[0, 1]"]);
    let shown = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!((output.status.code(), summary), (Some(2), None), "{shown}");
    let expected = if cfg!(feature = "spectral") { "the mode [0, 1] vanishes" } else { "needs the feature `spectral`" };
    assert!(shown.contains(expected), "{shown}");
}
