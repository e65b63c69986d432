//! The tests that rows name, looked up in what the test binaries list.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use serde_json::Value;
use xshell::{Shell, cmd};

use super::rows::Row;
use crate::workspace::Workspace;

/// The tests that no binary lists, each with the id of its row.
pub(super) fn missing<'r>(
    shell: &Shell,
    _workspace: &Workspace,
    rows: &[&'r Row],
) -> Result<Vec<(&'r str, String)>, String> {
    if rows.is_empty() {
        return Ok(Vec::new());
    }
    let listed = listed(shell, rows)?;
    let mut missing = Vec::new();
    for row in rows {
        for test in row.tests.iter().filter(|test| !listed.contains(*test)) {
            missing.push((row.id.as_str(), format!("no test `{test}`")));
        }
    }
    Ok(missing)
}

/// `folder::target::path` of every test in the binaries that the rows name.
fn listed(shell: &Shell, rows: &[&Row]) -> Result<HashSet<String>, String> {
    // The same selection as `cargo xtask test`, so that nothing is built again.
    let messages = cmd!(shell, "cargo test --workspace --all-features --no-run --quiet --message-format json")
        .quiet()
        .read()
        .map_err(|error| error.to_string())?;
    let wanted: HashSet<String> = rows.iter().flat_map(|row| &row.tests).filter_map(|test| binary_of(test)).collect();
    let mut listed = HashSet::new();
    for (binary, executable) in executables(&messages) {
        if wanted.contains(&binary) {
            let list = cmd!(shell, "{executable} --list --format terse").quiet().read();
            let list = list.map_err(|error| error.to_string())?;
            listed.extend(list.lines().filter_map(|line| Some(format!("{binary}::{}", line.strip_suffix(": test")?))));
        }
    }
    Ok(listed)
}

/// `kinematics::it` of `kinematics::it::laws::name`.
fn binary_of(test: &str) -> Option<String> {
    let mut parts = test.splitn(3, "::");
    Some(format!("{}::{}", parts.next()?, parts.next()?))
}

/// The test binaries that cargo built, by `folder::target`.
fn executables(messages: &str) -> HashMap<String, String> {
    let mut found = HashMap::new();
    for message in messages.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok()) {
        let (Some(executable), Some(manifest)) = (message["executable"].as_str(), message["manifest_path"].as_str())
        else {
            continue;
        };
        if message["profile"]["test"].as_bool() != Some(true) {
            continue;
        }
        let folder = Path::new(manifest).parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
        let is_library =
            message["target"]["kind"].as_array().is_some_and(|kinds| kinds.iter().any(|kind| kind == "lib"));
        let target = if is_library { "lib" } else { message["target"]["name"].as_str().unwrap_or_default() };
        found.insert(format!("{folder}::{target}"), executable.to_owned());
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{binary_of, executables};

    #[test]
    fn test_binaries_are_named_by_folder_and_target() {
        let line = |kind: &str, name: &str| {
            format!(
                "{{\"executable\":\"x/{name}\",\"manifest_path\":\"r/crates/kinematics/Cargo.toml\",\"profile\":{{\"test\":true}},\"target\":{{\"kind\":[\"{kind}\"],\"name\":\"{name}\"}}}}"
            )
        };
        let found = executables(&format!("{}\nnoise\n{}", line("lib", "piola_kinematics"), line("test", "it")));
        assert_eq!(found["kinematics::lib"], "x/piola_kinematics");
        assert_eq!(found["kinematics::it"], "x/it");
        assert_eq!(binary_of("kinematics::it::laws::a").as_deref(), Some("kinematics::it"));
    }
}
