//! `cargo xtask clippy`

use xshell::cmd;

use super::Command;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "clippy",
    usage: "",
    help: "lint every target with every feature, warnings denied",
    prepare: |shell, _, _| {
        Ok(vec![Step::program(
            "clippy",
            cmd!(shell, "cargo clippy --workspace --all-targets --all-features -- -D warnings"),
            "the lints are those of the root manifest; an `allow` needs a reason",
        )])
    },
};
