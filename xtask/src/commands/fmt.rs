//! `cargo xtask fmt`

use xshell::cmd;

use super::Command;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "fmt",
    usage: "",
    help: "check the layout of the code (`cargo fmt` repairs it)",
    prepare: |shell, _, _| {
        Ok(vec![Step::program("fmt", cmd!(shell, "cargo fmt --all -- --check"), "run `cargo fmt --all`")])
    },
};
