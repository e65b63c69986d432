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
        let target = Workspace::target(shell)?;
        // cargo sorts the crates by their dependencies and lets each see the packages of those before it.
        // Packages are built in cargo's own profile; debug information would take a third of the time.
        let mut command = cmd!(shell, "cargo package --allow-dirty --quiet").env("CARGO_PROFILE_DEV_DEBUG", "false");
        for member in workspace.crates.iter().filter(|member| member.is_published()) {
            command = command.args(["--package", &member.name]);
        }
        Ok(vec![
            Step::check(
                "package: forget",
                move || forget(workspace, &target),
                "what is left of an earlier run could not be removed",
            ),
            Step::program(
                "package",
                command,
                "a crate does not build from what would be published: a file outside its folder, or a missing version",
            ),
        ])
    },
};

/// Removes our crates from what cargo has unpacked of local registries, and has compiled of them: it keeps both by version, and
/// would build against those of an earlier run as long as the version is the same.
fn forget(workspace: &Workspace, target: &Path) -> Outcome {
    let removed = remove(&unpacked(workspace))? + remove(&compiled(workspace, &target.join("debug/.fingerprint")))?;
    Ok(format!("{removed} folders of an earlier run removed"))
}

/// Our crates in registries without a host, which are folders of this machine.
fn unpacked(workspace: &Workspace) -> Vec<PathBuf> {
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let Some(home) = home.or_else(|| std::env::home_dir().map(|home| home.join(".cargo"))) else { return Vec::new() };
    let registries = folders(&home.join("registry/src"));
    let local = registries.iter().filter(|path| name_of(path).starts_with('-'));
    local.flat_map(|registry| folders(registry)).filter(|package| is_ours(workspace, package)).collect()
}

/// What says that our crates are compiled, of those that came from a registry: cargo calls their state precalculated.
fn compiled(workspace: &Workspace, fingerprints: &Path) -> Vec<PathBuf> {
    let precalculated = |unit: &PathBuf| {
        let files = folders(unit);
        let mut texts = files.iter().filter_map(|file| std::fs::read_to_string(file).ok());
        texts.any(|text| text.contains("\"Precalculated\""))
    };
    folders(fingerprints).into_iter().filter(|unit| is_ours(workspace, unit)).filter(precalculated).collect()
}

fn is_ours(workspace: &Workspace, path: &Path) -> bool {
    workspace.crates.iter().any(|member| member.is_published() && name_of(path).starts_with(&member.name))
}

fn folders(path: &Path) -> Vec<PathBuf> {
    std::fs::read_dir(path).into_iter().flatten().flatten().map(|entry| entry.path()).collect()
}

fn name_of(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

fn remove(folders: &[PathBuf]) -> Result<usize, Vec<String>> {
    for folder in folders {
        std::fs::remove_dir_all(folder).map_err(|error| vec![format!("{}: {error}", folder.display())])?;
    }
    Ok(folders.len())
}
