//! `cargo xtask viscometry-accuracy`

use xshell::cmd;

use super::Command;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "viscometry-accuracy",
    usage: "[--out FOLDER]",
    help: "measure time and true error of profiles, discharges and torques, ours and plain quadrature's (default: docs/measurements)
The figures are taken in cargo's own release profile, on one core where `taskset` exists. Close other programs.",
    prepare: |shell, _, options| {
        let out = options.value("--out")?.unwrap_or_else(|| "docs/measurements".into());
        let pinned = cmd!(shell, "taskset --version").quiet().ignore_stdout().ignore_stderr().run().is_ok();
        let last_core = std::thread::available_parallelism().map_or(0, |count| count.get() - 1).to_string();
        let command = if pinned { cmd!(shell, "taskset --cpu-list {last_core} cargo") } else { cmd!(shell, "cargo") };
        let run = command.args(["run", "--release", "--package", "piola-benches"]);
        let run = run.args(["--bin", "viscometry-accuracy", "--", "--out", &out]);
        Ok(vec![Step::program("viscometry-accuracy", run, "the runner names what failed")])
    },
};
