//! `cargo xtask test`

use xshell::cmd;

use super::Command;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "test",
    usage: "",
    help: "run every test and every example of the documentation, with every feature
Tests compile kernels for the least set of instructions only. Those of lanes then run again, compiled for every
set that the machine has.",
    prepare: |shell, _, _| {
        let why = "a test failed; its name states the two sides of the identity that does not hold";
        Ok(vec![
            // All of them even after a failure: one run should tell everything that is wrong.
            Step::program("test", cmd!(shell, "cargo test --workspace --all-features --no-fail-fast"), why),
            Step::program(
                "test, every set of instructions",
                cmd!(
                    shell,
                    "cargo test --profile levels --package piola-numerics --package piola-continuum --package piola-batch --all-features --no-fail-fast --test levels"
                ),
                why,
            ),
        ])
    },
};
