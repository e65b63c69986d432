//! `cargo xtask package`

use std::path::{Path, PathBuf};

use xshell::cmd;

use super::Command;
use crate::step::{Outcome, Step};
use crate::workspace::Workspace;

pub(super) const COMMAND: Command = Command {
    name: "package",
    usage: "",
    help: "package every published crate in dependency order and build each from its package",
    prepare: |shell, workspace, _| {
        // cargo sorts the crates by their dependencies and lets each see the packages of those before it.
        let mut command = cmd!(shell, "cargo package --allow-dirty --quiet");
        for member in workspace.crates.iter().filter(|member| member.is_published()) {
            command = command.args(["--package", &member.name]);
        }
        Ok(vec![
            Step::check("package: forget", || forget(workspace), "an unpacked package could not be removed"),
            Step::program(
                "package",
                command,
                "a crate does not build from what would be published: a file outside its folder, or a missing version",
            ),
        ])
    },
};

/// Removes our crates from what cargo has unpacked of local registries: it keeps them by version, and would build
/// against those of an earlier run, as long as the version is the same.
fn forget(workspace: &Workspace) -> Outcome {
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| std::env::home_dir().map(|home| home.join(".cargo")));
    let Some(home) = home else { return Ok("no folder of cargo's".to_owned()) };
    let folders = |path: &Path| -> Vec<PathBuf> {
        std::fs::read_dir(path).into_iter().flatten().flatten().map(|entry| entry.path()).collect()
    };
    let name_of = |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let mut removed = 0;
    // Registries without a host are folders of this machine.
    for registry in folders(&home.join("registry/src")).iter().filter(|path| name_of(path).starts_with('-')) {
        for package in folders(registry) {
            let name = name_of(&package);
            if workspace.crates.iter().any(|member| member.is_published() && name.starts_with(&member.name)) {
                std::fs::remove_dir_all(&package).map_err(|error| vec![format!("{}: {error}", package.display())])?;
                removed += 1;
            }
        }
    }
    Ok(format!("{removed} unpacked packages of an earlier run removed"))
}
