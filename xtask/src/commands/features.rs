//! `cargo xtask features`

use xshell::cmd;

use super::Command;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "features",
    usage: "",
    help: "check the facade with no feature, with each feature alone, with the default ones and with all; the program with none",
    prepare: |shell, workspace, _| {
        let Some(facade) = workspace.member("piola") else { return Ok(Vec::new()) };
        let check = |name: &str, arguments: &[&str]| {
            let command = cmd!(shell, "cargo check --quiet --package piola").args(arguments);
            Step::program(
                &format!("features: {name}"),
                command.env("RUSTFLAGS", "-Dwarnings"),
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
        steps.push(Step::program(
            "features: piola-cli, none",
            command.env("RUSTFLAGS", "-Dwarnings"),
            "the program does not build without the studies of solids",
        ));
        Ok(steps)
    },
};
