//! `cargo xtask package`

use std::fmt::Write as _;
use std::path::Path;

use xshell::{Shell, cmd};

use super::Command;
use crate::step::{Outcome, Step};
use crate::workspace::{Workspace, read};

pub(super) const COMMAND: Command = Command {
    name: "package",
    usage: "",
    help: "package every published crate and check it as it comes out of its package, with its default features
The packages are unpacked side by side, where each sees the others and nothing else of the repository. Libraries are
checked one by one, the facade and the programs together.",
    prepare: |shell, workspace, _| {
        let packages = Workspace::target(shell)?.join("package");
        let apart = packages.join("apart");
        let published: Vec<&str> =
            workspace.crates.iter().filter(|member| member.is_published()).map(|member| member.name.as_str()).collect();
        let mut make = cmd!(shell, "cargo package --allow-dirty --no-verify --quiet");
        for name in &published {
            make = make.args(["--package", name]);
        }
        let (from, to, names) = (packages.clone(), apart.clone(), published.clone());
        let mut steps = vec![
            Step::program(
                "package",
                make,
                "a crate cannot be packaged: a missing version, or a file that is not there",
            ),
            Step::check(
                "package: unpack",
                move || unpack(shell, workspace, &names, &from, &to),
                "a package could not be unpacked",
            ),
        ];
        // In the target folder of the repository: what others wrote is checked there already.
        let (manifest, target) = (apart.join("Cargo.toml"), Workspace::target(shell)?);
        // A library alone, so that none leans on a feature that another one asks for; the programs, which ask for much, together.
        let facade = workspace.member("piola").and_then(|facade| facade.manifest.get("dependencies"));
        let is_library = |name: &&str| facade.is_some_and(|dependencies| dependencies.get(name).is_some());
        let (libraries, programs): (Vec<&str>, Vec<&str>) = published.into_iter().partition(is_library);
        for names in libraries.iter().map(core::slice::from_ref).chain([programs.as_slice()]) {
            let mut command = cmd!(shell, "cargo check --quiet --manifest-path {manifest} --target-dir {target}");
            for name in names {
                command = command.args(["--package", name]);
            }
            let name = if let [library] = names { library } else { "facade and programs" };
            steps.push(Step::program(
                &format!("package: {name}"),
                command,
                "a crate does not build from what would be published: a file outside its folder, or a feature it does not ask for",
            ));
        }
        Ok(steps)
    },
};

/// Unpacks the packages beside each other, as members of a workspace in which each is found in the folder of its package.
fn unpack(shell: &Shell, workspace: &Workspace, names: &[&str], packages: &Path, apart: &Path) -> Outcome {
    let fail = |error: xshell::Error| vec![error.to_string()];
    for name in names {
        shell.remove_path(apart.join(name)).map_err(fail)?;
        let folder = shell.create_dir(apart.join(name)).map_err(fail)?;
        let package = newest(packages, name).map_err(|error| vec![error])?;
        cmd!(shell, "tar -xzmf {package} -C {folder} --strip-components 1").quiet().run().map_err(fail)?;
    }
    let mut manifest = String::from("[workspace]\nresolver = \"3\"\n");
    let list: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
    let _ = write!(manifest, "members = [{}]\n\n[patch.crates-io]\n", list.join(", "));
    for name in names {
        let _ = writeln!(manifest, "{name} = {{ path = {name:?} }}");
    }
    // The profiles, too: with others all that others wrote would be checked again.
    let root: toml::Table = read(&workspace.root.join("Cargo.toml"))
        .and_then(|text| text.parse().map_err(|error: toml::de::Error| error.to_string()))
        .map_err(|error| vec![error])?;
    if let Some(profiles) = root.get("profile") {
        let table = toml::Table::from_iter([("profile".to_owned(), profiles.clone())]);
        let _ = write!(manifest, "\n{table}");
    }
    shell.write_file(apart.join("Cargo.toml"), manifest).map_err(fail)?;
    // The versions of other crates are those of the repository.
    shell.copy_file(workspace.root.join("Cargo.lock"), apart.join("Cargo.lock")).map_err(fail)?;
    Ok(format!("{} packages unpacked", names.len()))
}

/// The package of a crate: the name is followed by a version, `piola-fit-0.1.0.crate`.
fn newest(packages: &Path, name: &str) -> Result<std::path::PathBuf, String> {
    let is_its = |path: &std::path::PathBuf| {
        let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
        let version = stem.strip_prefix(name).and_then(|rest| rest.strip_prefix('-'));
        let is_version = version.is_some_and(|version| version.starts_with(|c: char| c.is_ascii_digit()));
        is_version && path.extension().is_some_and(|ending| ending == "crate")
    };
    let entries = std::fs::read_dir(packages).map_err(|error| format!("{}: {error}", packages.display()))?;
    let found = entries.flatten().map(|entry| entry.path()).filter(is_its);
    let age = |path: &std::path::PathBuf| path.metadata().and_then(|data| data.modified()).ok();
    found.max_by_key(age).ok_or_else(|| format!("there is no package of {name} in {}", packages.display()))
}
