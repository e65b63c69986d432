//! `cargo xtask features`

use xshell::{Cmd, cmd};

use super::Command;
use crate::step::{Outcome, Step};

pub(super) const COMMAND: Command = Command {
    name: "features",
    usage: "",
    help: "check the facade with no feature, with each feature alone, with the default ones and with all; the program with none",
    prepare: |shell, workspace, _| {
        let Some(facade) = workspace.member("piola") else { return Ok(Vec::new()) };
        let check = |name: &str, arguments: &[&str]| {
            let command = cmd!(shell, "cargo check --quiet --package piola").args(arguments);
            Step::check(
                &format!("features: {name}"),
                move || without_warnings(command),
                "the facade does not build with this set of features: a crate leans on a feature it does not ask for",
            )
        };
        let mut steps = vec![check("none", &["--no-default-features"])];
        for feature in facade.features() {
            steps.push(check(&feature, &["--no-default-features", "--features", &feature]));
        }
        steps.push(check("default", &[]));
        steps.push(check("all", &["--all-features"]));
        let command = cmd!(shell, "cargo check --quiet --package piola-cli --no-default-features");
        steps.push(Step::check(
            "features: piola-cli, none",
            move || without_warnings(command),
            "the program does not build without the studies of solids",
        ));
        Ok(steps)
    },
};

/// Runs a check that must be silent. Denied by `RUSTFLAGS`, warnings would make the compiler check everything anew that others wrote.
fn without_warnings(command: Cmd<'_>) -> Outcome {
    let output = command.ignore_status().quiet().output().map_err(|error| vec![error.to_string()])?;
    let text = String::from_utf8_lossy(&output.stderr);
    if output.status.success() && !text.lines().any(|line| line.starts_with("warning")) {
        return Ok("no warnings".to_owned());
    }
    Err(text.lines().map(str::to_owned).collect())
}
