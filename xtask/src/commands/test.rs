//! `cargo xtask test`

use xshell::cmd;

use super::Command;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "test",
    usage: "",
    help: "run every test and every example of the documentation, with every feature",
    prepare: |shell, _, _| {
        Ok(vec![Step::program(
            "test",
            // All of them even after a failure: one run should tell everything that is wrong.
            cmd!(shell, "cargo test --workspace --all-features --no-fail-fast"),
            "a test failed; its name states the two sides of the identity that does not hold",
        )])
    },
};
