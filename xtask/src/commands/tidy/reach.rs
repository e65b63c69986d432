//! The table of public modules in `docs/reference/reach.md` and the sources.

use std::collections::BTreeSet;

use crate::workspace::{Workspace, read};

const PAGE: &str = "docs/reference/reach.md";

pub(super) fn check(workspace: &Workspace) -> Vec<String> {
    let text = match read(&workspace.root.join(PAGE)) {
        Ok(text) => text,
        Err(error) => return vec![error],
    };
    let named = named(&text);
    let mut public = BTreeSet::new();
    // What is not published is used by tests alone; the Python package is published in its own way.
    let crates = workspace.crates.iter().filter(|member| member.is_published() || member.folder == "python");
    for member in crates {
        public.insert(member.folder.clone());
        match read(&member.path.join("src/lib.rs")) {
            Ok(source) => public.extend(modules(&source).map(|module| format!("{}::{module}", member.folder))),
            Err(error) => return vec![error],
        }
    }
    let missing = public.difference(&named).map(|name| format!("{PAGE}: `{name}` is missing"));
    missing.chain(named.difference(&public).map(|name| format!("{PAGE}: `{name}` is no public module"))).collect()
}

/// The public modules that a `lib.rs` declares, but for those that are only for our own crates.
fn modules(source: &str) -> impl Iterator<Item = &str> {
    let mut before = "";
    source.lines().filter_map(move |line| {
        let is_hidden = core::mem::replace(&mut before, line).contains("doc(hidden)");
        let name = line.strip_prefix("pub mod ")?.trim_end_matches([';', '{', ' ']);
        (!is_hidden && name != "internal").then_some(name)
    })
}

/// The names in the first column of the tables: `solids`, `solids::{batch, membrane}`.
fn named(page: &str) -> BTreeSet<String> {
    let cells = page.lines().filter_map(|line| line.strip_prefix("| `")?.split(" | ").next());
    let mut named = BTreeSet::new();
    for token in cells.flat_map(|cell| cell.trim_end_matches('`').split("`, `")) {
        match token.split_once("::{") {
            Some((folder, modules)) => {
                let modules = modules.trim_end_matches('}').split(", ");
                named.extend(modules.map(|module| format!("{folder}::{module}")));
            }
            None => drop(named.insert(token.to_owned())),
        }
    }
    named
}

#[cfg(test)]
mod tests {
    use super::{modules, named};

    #[test]
    fn public_modules_are_those_that_users_see() {
        let source =
            "mod private;\npub mod shown;\n#[doc(hidden)]\npub mod hidden;\npub mod internal {\n}\npub mod inline {\n";
        assert_eq!(modules(source).collect::<Vec<_>>(), ["shown", "inline"]);
    }

    #[test]
    fn a_first_column_names_crates_and_several_modules() {
        let page = "| module | by |\n|---|---|\n| `a`, `b::{c, d}`, `e::f` | `[g]` |\n";
        assert_eq!(named(page).into_iter().collect::<Vec<_>>(), ["a", "b::c", "b::d", "e::f"]);
    }
}
