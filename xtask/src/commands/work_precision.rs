//! `cargo xtask work-precision`

use xshell::cmd;

use super::Command;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "work-precision",
    usage: "[--out FOLDER] [--filter PROBLEM] [--table]",
    help: "measure error against time, our methods and the peers', as JSON and SVG (default: docs/measurements/figures)
The figures are taken in cargo's own release profile. Close other programs: all methods of a problem are run in turn,
several times, and the median counts, but a busy machine still widens the spread. With --table it also writes the data
out of which `piola_integrators::advise` chooses, crates/integrators/src/advice/measured.rs.",
    prepare: |shell, _, options| {
        let out = options.value("--out")?.unwrap_or_else(|| "docs/measurements/figures".into());
        let filter = options.value("--filter")?.into_iter().flat_map(|problem| ["--filter".to_owned(), problem]);
        let asked = options.flag("--table");
        let table = asked.then_some(["--table", "crates/integrators/src/advice/measured.rs"]).into_iter().flatten();
        let mut steps = vec![Step::program(
            "work-precision",
            cmd!(
                shell,
                "cargo run --release --package piola-benches --bin work-precision -- --out {out} {filter...} {table...}"
            ),
            "the runner names the problem and the method that failed",
        )];
        if asked {
            steps.push(Step::program(
                "fmt",
                cmd!(shell, "cargo fmt --package piola-integrators"),
                "the table is no Rust",
            ));
        }
        Ok(steps)
    },
};
