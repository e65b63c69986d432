//! Rules for the crates and the arrows between them.

use std::collections::BTreeSet;
use std::path::Path;

use toml::{Table, Value};

use crate::workspace::{Member, Workspace, read};

/// The arrows: each crate with those it may stand on. What a crate reaches through an arrow, it may name too.
///
/// A new entry is the rarest and most scrutinised change of all; ARCHITECTURE.md shows the same list.
const ARROWS: &[(&str, &[&str])] = &[
    ("numerics", &[]),
    ("tensor", &["numerics"]),
    ("kinematics", &["numerics"]),
    ("integrators", &["numerics"]),
    ("geometric", &["integrators"]),
    ("stiff", &["integrators"]),
    ("lagrangian", &["kinematics", "integrators"]),
    ("hamiltonian", &["lagrangian"]),
    // Nothing of Hamilton's is used there: characteristics of any equation of first order.
    ("characteristics", &["integrators"]),
    // kinematics: bodies go in and come out by its conversions to glam.
    ("gravitation", &["integrators"]),
    // lagrangian in its tests alone: trees against the placement path.
    ("multibody", &["kinematics", "geometric", "lagrangian"]),
    ("continuum", &["tensor"]),
    ("batch", &["continuum"]),
    ("fields", &["continuum"]),
    // batch, by feature: a law is compiled in lanes where it is defined.
    ("solids", &["continuum", "batch"]),
    // continuum and integrators for stresses in any motion, fields for the Navier-Stokes equations: by feature.
    ("fluids", &["tensor", "continuum", "integrators", "fields"]),
    ("viscometry", &["fluids"]),
    // Laws of one's own and sums of laws stand on the kernels of the built-in ones.
    ("laws", &["solids"]),
    // specimens in its tests alone: checks of laws with internal variables.
    ("inelastic", &["specimens"]),
    // fields, by feature: a body made of one law.
    ("specimens", &["solids", "fields"]),
    // laws: those of rubber and foam that a fit may find; inelastic: those with history.
    ("fit", &["laws", "specimens", "inelastic", "viscometry"]),
    ("spectra", &["fluids", "fit"]),
    ("solutions", &["solids", "fields", "integrators"]),
    ("uniformity", &["solids", "fields", "integrators"]),
    // integrators in its tests alone: modal motion against an adaptive integration.
    ("spectral", &["fields", "integrators"]),
    ("registration", &["spectral"]),
    ("images", &["registration"]),
    ("piola", MECHANICS),
    ("document", &[]),
    // document, by feature: expressions from text with units.
    ("expression", &["numerics", "document"]),
    ("simulation", &["hamiltonian", "gravitation", "expression"]),
    ("schema", &["document"]),
    ("charts", &[]),
    ("measured", &["document", "charts", "spectra"]),
    // solutions, by feature: twisted rods.
    ("forward", &["measured", "solutions"]),
    // solutions and uniformity, by feature: studies of solids; spectral, by feature: fields on a box; multibody, by feature:
    // robots.
    ("studies", &["simulation", "characteristics", "solutions", "uniformity", "spectral", "multibody"]),
    ("scene", &["schema", "charts", "studies"]),
    ("ensemble", &["scene"]),
    // charts: the folder of the results.
    // images, by feature: files of images, for the command `register` alone.
    ("cli", &["ensemble", "forward", "images"]),
    // The functions that other languages call. document: units of stress in the summary of a fit.
    ("ffi", &["piola", "document"]),
    // ffi: its safe half, laws at many points, compiled once for both. scene, by feature: motions run from a text.
    ("python", &["ffi", "scene"]),
    ("testkit", &["numerics"]),
];

/// Everything below the facade and the programs.
const MECHANICS: &[&str] = &[
    "numerics",
    "tensor",
    "kinematics",
    "integrators",
    "geometric",
    "stiff",
    "lagrangian",
    "hamiltonian",
    "characteristics",
    "gravitation",
    "multibody",
    "continuum",
    "batch",
    "fields",
    "solids",
    "laws",
    "specimens",
    "inelastic",
    "fluids",
    "viscometry",
    "fit",
    "spectra",
    "solutions",
    "uniformity",
    "spectral",
    "registration",
];

/// Arrows that exist only when a feature asks for them.
const BY_FEATURE: &[(&str, &str)] = &[
    ("fluids", "continuum"),
    ("fluids", "integrators"),
    ("fluids", "fields"),
    ("solids", "batch"),
    ("specimens", "fields"),
    ("solutions", "integrators"),
    ("fit", "inelastic"),
    ("fit", "laws"),
    ("fit", "specimens"),
    ("fit", "viscometry"),
    ("scene", "multibody"),
    ("scene", "solids"),
    ("scene", "solutions"),
    ("scene", "spectral"),
    ("scene", "uniformity"),
    ("studies", "multibody"),
    ("studies", "solids"),
    ("studies", "solutions"),
    ("studies", "spectral"),
    ("studies", "uniformity"),
    ("cli", "images"),
    ("cli", "registration"),
    ("python", "scene"),
];

/// No crate is larger, in lines of `src`: its users must take all of it.
const MOST_LINES: usize = 12_000;

/// Crates that are larger, with their limit: each is to be cut, none may grow.
const LARGER: &[(&str, usize)] = &[];

/// The crates that may contain `unsafe`: `numerics` for the dispatcher to wider lanes, records in lanes and prefetching, `ffi` for
/// pointers from C, `testkit` for the counting allocator.
const MAY_BE_UNSAFE: [&str; 3] = ["numerics", "ffi", "testkit"];

/// Every violation.
pub(super) fn check(workspace: &Workspace) -> Vec<String> {
    let mut problems = shared_dependencies(workspace);
    let license = read(&workspace.root.join("LICENSE")).unwrap_or_default();
    for member in &workspace.crates {
        let mut found = arrows(&member.folder, &member.manifest);
        found.extend(manner_of_dependencies(&member.manifest));
        found.extend(manifest(member));
        found.extend(files(member, &license));
        found.extend(not_by_feature(&member.folder, &member.manifest));
        found.extend(size(member));
        problems.extend(found.into_iter().map(|what| format!("crates/{}: {what}", member.folder)));
    }
    if let Some(facade) = workspace.member("piola") {
        let table = read(&facade.path.join("README.md")).unwrap_or_default();
        problems.extend(missing_features(&facade.features(), &table));
    }
    problems
}

/// The features of the facade that the table of its README does not name.
fn missing_features(features: &[String], table: &str) -> Vec<String> {
    let is_named =
        |feature: &String| table.lines().any(|line| line.starts_with('|') && line.contains(&format!("`{feature}`")));
    let missing = features.iter().filter(|feature| !is_named(feature));
    missing
        .map(|feature| format!("crates/piola: the table of README.md does not name the feature `{feature}`"))
        .collect()
}

fn size(member: &Member) -> Option<String> {
    let lines = lines_of(&member.path.join("src"));
    let larger = LARGER.iter().find(|(folder, _)| *folder == member.folder);
    let limit = larger.map_or(MOST_LINES, |(_, limit)| *limit);
    (limit < lines).then(|| format!("{lines} lines of src, the limit is {limit}: cut it, or make two crates of it"))
}

/// The lines of all Rust files in a folder.
pub(in crate::commands) fn lines_of(folder: &Path) -> usize {
    let mut lines = 0;
    for path in std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            lines += lines_of(&path);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            lines += read(&path).unwrap_or_default().lines().count();
        }
    }
    lines
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

/// Dependencies that should be optional and are not.
fn not_by_feature(folder: &str, manifest: &Table) -> Vec<String> {
    let is_optional = |entry: &Value| entry.get("optional").and_then(Value::as_bool) == Some(true);
    let always = entries(manifest, "dependencies").filter(|(_, entry)| !is_optional(entry));
    always
        .filter_map(|(package, _)| ours(package))
        .filter(|below| BY_FEATURE.contains(&(folder, below)))
        .map(|below| format!("the arrow to `{below}` must be optional"))
        .collect()
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
    use super::{ARROWS, MECHANICS, arrows, manner_of_dependencies, missing_features, not_by_feature, reach};

    #[test]
    fn an_arrow_grants_all_that_it_reaches_and_nothing_else() {
        let lagrangian = reach("lagrangian").into_iter().flatten().collect::<Vec<_>>();
        assert_eq!(lagrangian, ["integrators", "kinematics", "numerics"]);
        assert!(!reach("viscometry").is_some_and(|reached| reached.contains("solids")));
        assert!(!reach("solids").is_some_and(|reached| reached.contains("integrators")));
        assert!(reach("piola").is_some_and(|reached| MECHANICS.iter().all(|crate_| reached.contains(crate_))));
        assert!(!reach("scene").is_some_and(|reached| reached.contains("measured")));
        assert_eq!(reach("drawer"), None);
    }

    #[test]
    fn an_arrow_by_feature_is_optional() {
        let manifest =
            "[dependencies]\npiola-continuum.workspace = true\npiola-fields = { workspace = true, optional = true }";
        assert_eq!(not_by_feature("fluids", &manifest.parse().unwrap_or_default()).len(), 1);
    }

    #[test]
    fn every_feature_stands_in_the_table() {
        let features = ["solids".to_owned(), "fluids".to_owned()];
        assert_eq!(missing_features(&features, "| `solids` | `piola::solids` |\n`fluids`").len(), 1);
    }

    #[test]
    fn the_arrows_have_no_cycle() {
        for (folder, _) in ARROWS {
            assert!(!reach(folder).is_some_and(|reached| reached.contains(folder)), "{folder}");
        }
    }

    #[test]
    fn a_forbidden_arrow_is_found_in_every_table() {
        let manifest = "[dependencies]\npiola-lagrangian.workspace = true\n[dev-dependencies]\npiola-testkit = { path = \"p\" }\n[build-dependencies]\npiola-scene = \"1\"";
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
