//! Rules for the imports inside a crate: folders have floors, and no two files import each other.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::source::{code_only, without_tests};
use crate::workspace::{Workspace, read};

/// The floors of a crate, lowest first. A file imports from its own folder and from lower floors only; folders of one
/// floor do not import each other. Modules that are not listed (errors, shared helpers) stand below all floors.
const FLOORS: &[(&str, &[&[&str]])] = &[
    ("continuum", &[&["deformation"], &["polar"], &["strain"], &["rates"], &["stress"]]),
    ("batch", &[&["engine"], &["requests"]]),
    ("specimens", &[&["homogeneous", "checks"]]),
    ("hamiltonian", &[&["hamilton_jacobi"]]),
    ("lagrangian", &[&["anholonomic", "constraints", "small_motions"]]),
];

/// Pairs of files that import each other, each with its reason.
const CIRCLES: &[(&str, &str, &str)] = &[
    (
        "crates/continuum/src/deformation/displacement.rs",
        "crates/continuum/src/deformation/gradient.rs",
        "F and ∇u convert into each other",
    ),
    (
        "crates/continuum/src/rates/spins.rs",
        "crates/continuum/src/rates/stretch.rs",
        "the rates of the stretches hold the spins, and a spin is read from them",
    ),
    (
        "crates/fields/src/coordinates/basis.rs",
        "crates/fields/src/coordinates/frame.rs",
        "natural and physical components convert into each other",
    ),
    (
        "crates/fields/src/integral/quadrature.rs",
        "crates/fields/src/integral/region/mod.rs",
        "a rule integrates over regions, and a region lays out the points of a rule",
    ),
    (
        "crates/numerics/src/lanewise.rs",
        "crates/numerics/src/real.rs",
        "a computation in lanes is over scalars, and a scalar runs it",
    ),
    (
        "crates/measured/src/rheology/figure.rs",
        "crates/measured/src/rheology/fluids.rs",
        "a comparison writes its figure",
    ),
    (
        "crates/measured/src/rheology/figure.rs",
        "crates/measured/src/rheology/recovery_output.rs",
        "a recovered curve writes its figure",
    ),
    (
        "crates/document/src/units/names.rs",
        "crates/document/src/units/unit.rs",
        "a unit is read by its name, and the names are of units",
    ),
    (
        "crates/tensor/src/fourth/major.rs",
        "crates/tensor/src/fourth/symmetry.rs",
        "tensors of three symmetries convert into one another",
    ),
    (
        "crates/tensor/src/fourth/minor.rs",
        "crates/tensor/src/fourth/symmetry.rs",
        "tensors of three symmetries convert into one another",
    ),
];

/// Every violation.
pub(super) fn check(workspace: &Workspace) -> Vec<String> {
    let mut problems = Vec::new();
    for member in &workspace.crates {
        let Some(graph) = Graph::read(&member.path.join("src")) else { continue };
        let edges = graph.edges();
        let place = |file: &str| format!("crates/{}/src/{file}", member.folder);
        if let Some((_, floors)) = FLOORS.iter().find(|(folder, _)| *folder == member.folder) {
            for (from, to) in &edges {
                if !is_downward(floors, from, to) {
                    problems.push(format!("{}: imports from `{to}`, which does not stand lower", place(from)));
                }
            }
        }
        for (from, to) in edges.iter().filter(|(from, to)| from < to) {
            let is_excused = CIRCLES.iter().any(|(a, b, _)| *a == place(from) && *b == place(to));
            if edges.contains(&(to.clone(), from.clone())) && !is_excused {
                problems.push(format!("{} and {} import each other", place(from), place(to)));
            }
        }
    }
    problems
}

fn is_downward(floors: &[&[&str]], from: &str, to: &str) -> bool {
    let (from, to) = (top(from), top(to));
    let floor = |folder: &str| floors.iter().position(|names| names.contains(&folder));
    match (floor(from), floor(to)) {
        (Some(above), Some(below)) => below < above || from == to,
        _ => true,
    }
}

/// The folder below `src`, or the file that stands there.
fn top(file: &str) -> &str {
    file.split('/').next().unwrap_or(file).trim_end_matches(".rs")
}

/// The modules of a crate.
struct Graph {
    /// By path of the module, such as `strain::green`.
    modules: BTreeMap<String, Module>,
}

struct Module {
    /// Below `src`, such as `strain/green.rs`.
    file: String,
    /// Imported and named paths.
    paths: Vec<String>,
    /// What the module re-exports: name and path.
    exports: BTreeMap<String, String>,
}

impl Graph {
    fn read(folder: &Path) -> Option<Self> {
        let mut files = Vec::new();
        collect(folder, &mut files);
        let mut modules = BTreeMap::new();
        for path in files {
            let file = path.strip_prefix(folder).ok()?.to_str()?.replace('\\', "/");
            let text = read(&path).unwrap_or_default();
            modules.insert(module_of(&file), Module::of(file, &without_tests(&code_only(&text))));
        }
        (!modules.is_empty()).then_some(Self { modules })
    }

    /// From file to file; a module and those inside it do not count.
    fn edges(&self) -> BTreeSet<(String, String)> {
        let mut edges = BTreeSet::new();
        for (name, module) in &self.modules {
            for path in &module.paths {
                let Some(target) = self.resolve(name, path, 0) else { continue };
                if !is_inside(name, &target) && !is_inside(&target, name) {
                    edges.insert((module.file.clone(), self.modules[&target].file.clone()));
                }
            }
        }
        edges
    }

    /// The module that holds what `path` names, seen from `module`.
    fn resolve(&self, module: &str, path: &str, depth: usize) -> Option<String> {
        let mut at = module.to_owned();
        let mut is_first = true;
        for part in path.split("::") {
            match part {
                "crate" if is_first => at = String::new(),
                "self" => {}
                "super" => at = at.rsplit_once("::").map_or_else(String::new, |(above, _)| above.to_owned()),
                name => {
                    let inner = if at.is_empty() { name.to_owned() } else { format!("{at}::{name}") };
                    if self.modules.contains_key(&inner) {
                        at = inner;
                    } else if let Some(exported) = self.modules.get(&at).and_then(|module| module.exports.get(name)) {
                        return if depth < 8 { self.resolve(&at, exported, depth + 1) } else { None };
                    } else if is_first {
                        return None; // another crate's
                    } else {
                        break;
                    }
                }
            }
            is_first = false;
        }
        self.modules.contains_key(&at).then_some(at)
    }
}

impl Module {
    fn of(file: String, code: &str) -> Self {
        let (mut paths, mut exports) = (Vec::new(), BTreeMap::new());
        let mut rest = String::new();
        for statement in code.split_inclusive(';') {
            let Some(start) = use_of(statement) else {
                rest.push_str(statement);
                continue;
            };
            rest.push_str(&statement[..start]);
            let is_public = statement[..start].trim_end().ends_with("pub");
            let mut named = Vec::new();
            expand("", statement[start + 4..].trim_end_matches(';'), &mut named);
            for (name, path) in named {
                if is_public {
                    exports.insert(name, path);
                } else {
                    paths.push(path);
                }
            }
        }
        for start in ["crate::", "super::"] {
            for (at, _) in rest.match_indices(start) {
                let is_whole = !rest[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':' || c == '$');
                let is_visibility = rest[..at].trim_end().ends_with("pub(in");
                if is_whole && !is_visibility {
                    let end = rest[at..].find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
                    paths.push(rest[at..end.map_or(rest.len(), |end| at + end)].trim_end_matches(':').to_owned());
                }
            }
        }
        Self { file, paths, exports }
    }
}

/// Where the `use` of a statement begins.
fn use_of(statement: &str) -> Option<usize> {
    let at = statement.rfind("use ")?;
    let before = statement[..at].trim_end();
    let is_start =
        before.is_empty() || before.ends_with(['}', ']', ';', '{']) || before.ends_with("pub") || before.ends_with(')');
    is_start.then_some(at)
}

/// The paths of a tree of imports, each with the name by which it is known.
fn expand(prefix: &str, tree: &str, named: &mut Vec<(String, String)>) {
    let tree = tree.trim();
    if let Some((head, inner)) = tree.split_once('{') {
        let inner = inner.trim_end().trim_end_matches('}');
        let prefix = format!("{prefix}{}", head.trim());
        let (mut depth, mut start) = (0_usize, 0);
        for (at, c) in inner.char_indices() {
            match c {
                '{' => depth += 1,
                '}' => depth = depth.saturating_sub(1),
                ',' if depth == 0 => {
                    expand(&prefix, &inner[start..at], named);
                    start = at + 1;
                }
                _ => {}
            }
        }
        if !inner[start..].trim().is_empty() {
            expand(&prefix, &inner[start..], named);
        }
    } else if !tree.is_empty() {
        let (path, name) = tree.split_once(" as ").map_or((tree, None), |(path, name)| (path, Some(name)));
        let path = format!("{prefix}{}", path.trim());
        let path = path.trim_end_matches("::self").trim_end_matches("::*").to_owned();
        let name = name.unwrap_or_else(|| path.rsplit("::").next().unwrap_or(&path)).trim().to_owned();
        named.push((name, path));
    }
}

/// `strain::green` of `strain/green.rs`; nothing for the root.
fn module_of(file: &str) -> String {
    let name = file.trim_end_matches(".rs").trim_end_matches("/mod").replace('/', "::");
    if matches!(&*name, "lib" | "main") { String::new() } else { name }
}

fn is_inside(inner: &str, outer: &str) -> bool {
    outer.is_empty() || inner == outer || inner.strip_prefix(outer).is_some_and(|rest| rest.starts_with("::"))
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.filter_map(|entry| entry.ok().map(|entry| entry.path())) {
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Graph, Module, expand, is_downward, module_of};

    fn graph(files: &[(&str, &str)]) -> Graph {
        let modules =
            files.iter().map(|(file, code)| (module_of(file), Module::of((*file).to_owned(), code))).collect();
        Graph { modules }
    }

    #[test]
    fn a_tree_of_imports_is_its_paths() {
        let mut named = Vec::new();
        expand("", "crate::{a::{B, self}, c::D as E}", &mut named);
        let paths: Vec<_> = named.iter().map(|(name, path)| (name.as_str(), path.as_str())).collect();
        assert_eq!(paths, [("B", "crate::a::B"), ("a", "crate::a"), ("E", "crate::c::D")]);
    }

    #[test]
    fn two_files_that_import_each_other_are_found_through_what_their_folder_exports() {
        let circle = graph(&[
            ("lib.rs", "mod a;"),
            ("a/mod.rs", "mod b; mod c; pub use b::B;"),
            ("a/b.rs", "use super::c::C;\npub struct B;"),
            ("a/c.rs", "use crate::a::B;\npub struct C;"),
        ]);
        let edges = circle.edges();
        assert!(edges.contains(&("a/b.rs".into(), "a/c.rs".into())));
        assert!(edges.contains(&("a/c.rs".into(), "a/b.rs".into())));
        assert_eq!(edges.len(), 2);
    }

    #[test]
    fn a_path_in_an_expression_is_an_import_and_a_part_of_a_name_is_not() {
        let paths = graph(&[
            ("lib.rs", "mod a; mod b;"),
            ("a.rs", "fn f() { crate::b::g() }"),
            ("b.rs", "pub(in crate::a) fn g() { my_crate::a::f() }"),
        ]);
        assert_eq!(paths.edges().into_iter().collect::<Vec<_>>(), [("a.rs".to_owned(), "b.rs".to_owned())]);
    }

    #[test]
    fn imports_go_down() {
        let floors: &[&[&str]] = &[&["low", "also_low"], &["high"]];
        assert!(is_downward(floors, "high/a.rs", "low/b.rs"));
        assert!(is_downward(floors, "low/a.rs", "low/b.rs"));
        assert!(is_downward(floors, "low/a.rs", "error.rs"));
        assert!(!is_downward(floors, "low/a.rs", "high.rs"));
        assert!(!is_downward(floors, "low/a.rs", "also_low/b.rs"));
    }
}
