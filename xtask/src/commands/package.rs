//! `cargo xtask package`

use xshell::cmd;

use super::Command;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "package",
    usage: "",
    help: "package every published crate in dependency order and build each from its package",
    prepare: |shell, workspace, _| {
        // cargo sorts the crates by their dependencies and lets each see the packages of those before it.
        let mut command = cmd!(shell, "cargo package --allow-dirty --quiet");
        for member in workspace.crates.iter().filter(|member| member.is_published()) {
            command = command.args(["--package", &member.name]);
        }
        Ok(vec![Step::program(
            "package",
            command,
            "a crate does not build from what would be published: a file outside its folder, or a missing version",
        )])
    },
};
