//! `cargo xtask verification`: exact solutions as tables, for other programs.

use xshell::cmd;

use super::Command;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "verification",
    usage: "[--out FOLDER]",
    help: "write exact solutions as tables for finite-element programs (default: target/verification)
For each family of universal deformations and for three laws: nodes with displacement and stress, elements, faces with
tractions, and the resultant loads, as CSV and JSON, with a README that says what each column is.",
    prepare: |shell, _, options| {
        let out = options.value("--out")?.unwrap_or_else(|| "target/verification".into());
        let run = cmd!(shell, "cargo run --quiet --release --package piola-solutions --example verification -- {out}");
        Ok(vec![Step::program("verification", run, "the program names the file or the state that failed")])
    },
};
