//! Rules for the crates and the arrows between them.

use std::collections::BTreeSet;

use toml::{Table, Value};

use crate::workspace::{Member, Workspace, read};

/// The arrows: each crate with those it may stand on. What a crate reaches through an arrow, it may name too.
///
/// A new entry is the rarest and most scrutinised change of all; ARCHITECTURE.md shows the same list.
const ARROWS: &[(&str, &[&str])] = &[
    ("numerics", &[]),
    ("kinematics", &["numerics"]),
    ("integrators", &["numerics"]),
    ("dynamics", &["kinematics", "integrators"]),
    ("multibody", &["dynamics", "integrators"]),
    ("continuum", &["numerics"]),
    ("constitutive", &["continuum", "integrators"]),
    ("viscometry", &["constitutive"]),
    ("solutions", &["constitutive", "integrators"]),
    ("uniformity", &["constitutive", "integrators"]),
    ("spectral", &["numerics", "continuum"]),
    ("piola", MECHANICS),
    ("scene", MECHANICS),
    ("cli", &["scene"]),
    ("testkit", &["numerics"]),
];

/// Everything below the facade and the scenes.
const MECHANICS: &[&str] = &[
    "numerics",
    "kinematics",
    "integrators",
    "dynamics",
    "multibody",
    "continuum",
    "constitutive",
    "viscometry",
    "solutions",
    "uniformity",
    "spectral",
];

/// The crates that may contain `unsafe`: the dispatcher to wider lanes, and the counting allocator.
const MAY_BE_UNSAFE: [&str; 2] = ["numerics", "testkit"];

/// Every violation.
pub(super) fn check(workspace: &Workspace) -> Vec<String> {
    let mut problems = shared_dependencies(workspace);
    let license = read(&workspace.root.join("LICENSE")).unwrap_or_default();
    for member in &workspace.crates {
        let mut found = arrows(&member.folder, &member.manifest);
        found.extend(manner_of_dependencies(&member.manifest));
        found.extend(manifest(member));
        found.extend(files(member, &license));
        problems.extend(found.into_iter().map(|what| format!("crates/{}: {what}", member.folder)));
    }
    problems
}

/// The folder that a dependency on one of our crates names.
fn ours(package: &str) -> Option<&str> {
    if package == "piola" { Some("piola") } else { package.strip_prefix("piola-") }
}

/// All that `folder` may stand on; `None` for a crate without a place in the list.
fn reach(folder: &str) -> Option<BTreeSet<&'static str>> {
    let (_, direct) = ARROWS.iter().find(|(name, _)| *name == folder)?;
    let mut reached = BTreeSet::new();
    for below in *direct {
        reached.insert(*below);
        reached.extend(reach(below).unwrap_or_default());
    }
    Some(reached)
}

fn arrows(folder: &str, manifest: &Table) -> Vec<String> {
    let Some(reach) = reach(folder) else { return vec!["has no place in the list of arrows".into()] };
    let mut problems = Vec::new();
    for (table, is_development) in [("dependencies", false), ("build-dependencies", false), ("dev-dependencies", true)]
    {
        for below in entries(manifest, table).filter_map(|(package, _)| ours(package)) {
            let is_allowed = reach.contains(below) || (is_development && below == "testkit");
            if !is_allowed {
                problems.push(format!("an arrow to `{below}`, which is not in the list"));
            }
        }
    }
    problems
}

/// Normal internal dependencies inherit; development ones are bare paths, so that publishing ignores them.
fn manner_of_dependencies(manifest: &Table) -> Vec<String> {
    let mut problems = Vec::new();
    for (package, entry) in entries(manifest, "dependencies").filter(|(package, _)| ours(package).is_some()) {
        if entry.get("workspace").and_then(Value::as_bool) != Some(true) {
            problems.push(format!("`{package}` must be `workspace = true`"));
        }
    }
    for (package, entry) in entries(manifest, "dev-dependencies").filter(|(package, _)| ours(package).is_some()) {
        if entry.get("path").is_none() || entry.get("version").is_some() {
            problems.push(format!("the development dependency `{package}` must be a path without a version"));
        }
    }
    problems
}

/// The root's entries for our crates: version and path, no features, so that turning a feature off removes code.
fn shared_dependencies(workspace: &Workspace) -> Vec<String> {
    let root: Result<Table, String> = read(&workspace.root.join("Cargo.toml"))
        .and_then(|text| text.parse().map_err(|error: toml::de::Error| error.to_string()));
    let root = match root {
        Ok(root) => root,
        Err(problem) => return vec![problem],
    };
    let Some(shared) = root.get("workspace").and_then(Value::as_table) else {
        return vec!["the root manifest has no `[workspace]`".into()];
    };
    let mut problems = Vec::new();
    for (package, entry) in entries(shared, "dependencies").filter(|(package, _)| ours(package).is_some()) {
        let is_bare = entry.get("default-features").and_then(Value::as_bool) == Some(false)
            && entry.get("version").is_some()
            && entry.get("path").is_some()
            && entry.get("features").is_none();
        if !is_bare {
            problems.push(format!(
                "Cargo.toml: `{package}` must have version, path, `default-features = false` and no features"
            ));
        }
    }
    problems
}

fn manifest(member: &Member) -> Vec<String> {
    let package = member.manifest.get("package").and_then(Value::as_table);
    let expected = if member.folder == "piola" { "piola".to_owned() } else { format!("piola-{}", member.folder) };
    let mut problems = Vec::new();
    if member.name != expected {
        problems.push(format!("the package is called `{}`, not `{expected}`", member.name));
    }
    let lints = member.manifest.get("lints").and_then(|lints| lints.get("workspace")).and_then(Value::as_bool);
    if lints != Some(true) {
        problems.push("`[lints] workspace = true` is missing".into());
    }
    if !member.is_published() {
        return problems;
    }
    for key in ["description", "version", "edition", "rust-version", "license", "repository", "readme"] {
        if package.is_none_or(|package| !package.contains_key(key)) {
            problems.push(format!("`package.{key}` is missing"));
        }
    }
    let docs = package.and_then(|package| package.get("metadata")?.get("docs")?.get("rs"));
    if docs.is_none() && member.path.join("src/lib.rs").is_file() {
        problems.push("`[package.metadata.docs.rs]` is missing".into());
    }
    problems
}

fn files(member: &Member, license: &str) -> Vec<String> {
    let mut problems = Vec::new();
    if member.is_published() {
        if !member.path.join("README.md").is_file() {
            problems.push("README.md is missing".into());
        }
        if read(&member.path.join("LICENSE")).unwrap_or_default() != license {
            problems.push("LICENSE is not the one of the root".into());
        }
    }
    if !MAY_BE_UNSAFE.contains(&member.folder.as_str()) {
        // A crate has a library, a binary or both: each root forbids it.
        for root in ["lib.rs", "main.rs"] {
            let path = member.path.join("src").join(root);
            if path.is_file() && !read(&path).unwrap_or_default().contains("#![forbid(unsafe_code)]") {
                problems.push(format!("src/{root} has no `#![forbid(unsafe_code)]`"));
            }
        }
    }
    problems
}

fn entries<'t>(table: &'t Table, key: &str) -> impl Iterator<Item = (&'t str, &'t Value)> {
    table.get(key).and_then(Value::as_table).into_iter().flatten().map(|(package, entry)| (package.as_str(), entry))
}

#[cfg(test)]
mod tests {
    use super::{ARROWS, MECHANICS, arrows, manner_of_dependencies, reach};

    #[test]
    fn an_arrow_grants_all_that_it_reaches_and_nothing_else() {
        let dynamics = reach("dynamics").into_iter().flatten().collect::<Vec<_>>();
        assert_eq!(dynamics, ["integrators", "kinematics", "numerics"]);
        assert!(!reach("viscometry").is_some_and(|reached| reached.contains("kinematics")));
        assert!(reach("cli").is_some_and(|reached| MECHANICS.iter().all(|crate_| reached.contains(crate_))));
        assert_eq!(reach("drawer"), None);
    }

    #[test]
    fn the_arrows_have_no_cycle() {
        for (folder, _) in ARROWS {
            assert!(!reach(folder).is_some_and(|reached| reached.contains(folder)), "{folder}");
        }
    }

    #[test]
    fn a_forbidden_arrow_is_found_in_every_table() {
        let manifest = "[dependencies]\npiola-dynamics.workspace = true\n[dev-dependencies]\npiola-testkit = { path = \"p\" }\n[build-dependencies]\npiola-scene = \"1\"";
        let manifest = manifest.parse().unwrap_or_default();
        assert_eq!(arrows("kinematics", &manifest).len(), 2);
        assert_eq!(arrows("scene", &manifest).len(), 1);
    }

    #[test]
    fn internal_dependencies_inherit_and_development_ones_are_paths() {
        let right = "[dependencies]\npiola-numerics.workspace = true\n[dev-dependencies]\npiola-testkit = { path = \"../testkit\" }";
        assert!(manner_of_dependencies(&right.parse().unwrap_or_default()).is_empty());
        let wrong = "[dependencies]\npiola-numerics = \"0.1\"\n[dev-dependencies]\npiola-testkit = { path = \"p\", version = \"1\" }";
        assert_eq!(manner_of_dependencies(&wrong.parse().unwrap_or_default()).len(), 2);
    }
}
