//! `cargo xtask wheel`

use xshell::cmd;

use super::Command;
use crate::step::Step;
use crate::workspace::Workspace;

pub(super) const COMMAND: Command = Command {
    name: "wheel",
    usage: "[--test]",
    help: "build the wheel of the Python package, which needs maturin (`pip install maturin`)
The wheel goes to the folder `wheels` of cargo's target folder; it serves Python 3.10 and later.
--test    make a virtual environment there, install the wheel with NumPy and pytest, and run crates/python/tests",
    prepare: |shell, workspace, options| {
        let is_tested = options.flag("--test");
        let target = Workspace::target(shell)?;
        let (wheels, environment) = (target.join("wheels"), target.join("python"));
        let manifest = workspace.root.join("crates/python/Cargo.toml");
        let mut steps = vec![Step::program(
            "wheel",
            cmd!(shell, "maturin build --release --features rayon --manifest-path {manifest} --out {wheels}"),
            "maturin is missing (`pip install maturin`), or the package does not build",
        )];
        if is_tested {
            let python = environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
            let tests = workspace.root.join("crates/python/tests");
            steps.push(Step::program(
                "wheel: environment",
                cmd!(shell, "python3 -m venv {environment}"),
                "Python's module `venv` is missing",
            ));
            steps.push(Step::program(
                "wheel: NumPy and pytest",
                cmd!(shell, "{python} -m pip install --quiet numpy pytest"),
                "NumPy or pytest could not be installed",
            ));
            // From the folder alone: another package of this name may be on the index.
            let install = cmd!(shell, "{python} -m pip install --quiet --no-index --no-deps --force-reinstall");
            steps.push(Step::program(
                "wheel: install",
                install.arg("--find-links").arg(&wheels).arg("piola"),
                "the wheel could not be installed",
            ));
            steps.push(Step::program(
                "wheel: pytest",
                cmd!(shell, "{python} -m pytest --quiet {tests}"),
                "a test of the Python package failed",
            ));
        }
        Ok(steps)
    },
};
