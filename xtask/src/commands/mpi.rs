//! `cargo xtask mpi`

use std::path::Path;

use xshell::{Shell, cmd};

use super::Command;
use crate::step::Step;
use crate::workspace::{Workspace, read};

pub(super) const COMMAND: Command = Command {
    name: "mpi",
    usage: "",
    help: "build the program of the folder `mpi` and run its tests with several processes
It needs Open MPI (`mpicc`, `mpirun`) and libclang. Where one of them is missing the tests are skipped: their names are printed.",
    prepare: |shell, workspace, _| {
        let manifest = workspace.root.join("mpi/Cargo.toml");
        if let Some(program) = missing(shell) {
            let tests = workspace.root.join("mpi/tests/processes.rs");
            return Ok(vec![Step::check(
                "mpi",
                move || skipped(&tests, program).map_err(|error| vec![error]),
                "the tests of `mpi` cannot be read",
            )]);
        }
        let target = Workspace::target(shell)?.join("mpi");
        Ok(vec![Step::program(
            "mpi",
            cmd!(shell, "cargo test --release --manifest-path {manifest} --target-dir {target}"),
            "libclang is missing (`apt-get install libclang-dev`), or a sweep differs with the number of processes",
        )])
    },
};

/// A program of Open MPI that is not there.
fn missing(shell: &Shell) -> Option<&'static str> {
    let is_there = |program: &&str| cmd!(shell, "{program} --version").quiet().ignore_stderr().read().is_ok();
    ["mpicc", "mpirun"].into_iter().find(|program| !is_there(program))
}

/// Names what is not tested.
fn skipped(tests: &Path, program: &str) -> Result<String, String> {
    let text = read(tests)?;
    let names: Vec<&str> =
        text.split("#[test]\nfn ").skip(1).map(|test| test.split('(').next().unwrap_or_default()).collect();
    Ok(format!("{} tests skipped, because `{program}` is not installed: {}", names.len(), names.join(", ")))
}
