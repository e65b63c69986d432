//! `cargo xtask stability`

use xshell::cmd;

use super::Command;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "stability",
    usage: "[--out FILE] [--steps N]",
    help: "measure rounding at adversarial inputs and write the sheet (default: docs/measurements/stability.md)
--steps N   follow the free top for N steps (default: 10 million)",
    prepare: |shell, _, options| {
        let out = options.value("--out")?.unwrap_or_else(|| "docs/measurements/stability.md".into());
        let steps = options.value("--steps")?.into_iter().flat_map(|steps| ["--steps".to_owned(), steps]);
        Ok(vec![Step::program(
            "stability",
            cmd!(shell, "cargo run --release --package piola-benches --bin stability -- --out {out} {steps...}"),
            "an error exceeds what is allowed: the sheet shows which",
        )])
    },
};
