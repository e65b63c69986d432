//! Whether the tests of a row speak of its items at all.
//!
//! A test speaks of an item if its code names it, or the code of a helper that it calls within the same test binary.
//!
//! | item | is named by |
//! |---|---|
//! | a type | its name |
//! | a trait | its name, or a call of one of its functions |
//! | a function | a call, or a path that ends in it |
//! | a method | a call; if several types have a method of this name, the name of its type besides |
//! | a constructor or operator (`OF_THE_TYPE`) | its type |

use std::collections::{BTreeSet, HashMap};

use xshell::Shell;

use super::binary::{Binary, Definition, Kind, follows, is_called, is_of_value};
use super::rows::Row;
use crate::workspace::Workspace;

/// What makes a value of a type without being written, as by `into` or by a sign.
const OF_THE_TYPE: [&str; 9] = ["new", "of", "from", "default", "add", "sub", "mul", "div", "neg"];

/// What tests do not speak of, each with the id of its row.
pub(super) fn missing<'r>(
    _shell: &Shell,
    workspace: &Workspace,
    rows: &[&'r Row],
) -> Result<Vec<(&'r str, String)>, String> {
    let mut library = Library::default();
    for member in &workspace.crates {
        library.add(&Binary::of_folder(&member.path.join("src"))?);
    }
    let mut binaries = HashMap::new();
    for test in rows.iter().flat_map(|row| &row.tests) {
        if let Some((folder, target, _)) = parts(test)
            && !binaries.contains_key(&(folder, target))
        {
            let path = workspace.root.join("crates").join(folder).join("tests").join(target);
            binaries.insert((folder, target), Binary::of_folder(&path)?);
        }
    }
    Ok(rows.iter().flat_map(|row| of_row(row, &binaries, &library).into_iter().map(|what| (&*row.id, what))).collect())
}

fn of_row(row: &Row, binaries: &HashMap<(&str, &str), Binary>, library: &Library) -> Vec<String> {
    let mut problems = Vec::new();
    let mut is_named = vec![false; row.items.len()];
    for test in &row.tests {
        let reach = parts(test).map_or(Vec::new(), |(folder, target, path)| binaries[&(folder, target)].reach(path));
        if reach.is_empty() {
            problems.push(format!("no test `{test}` is written"));
            continue;
        }
        let named: Vec<bool> = row.items.iter().map(|item| library.is_named(item, &reach)).collect();
        if !named.contains(&true) {
            problems.push(format!("`{test}` names no item of the row"));
        }
        is_named.iter_mut().zip(named).for_each(|(known, new)| *known |= new);
    }
    let unnamed = row.items.iter().zip(is_named).filter(|(_, is_named)| !is_named);
    problems.extend(unnamed.map(|(item, _)| format!("no test of the row names `{item}`")));
    problems
}

/// Folder of the crate, test binary and path of a test.
fn parts(test: &str) -> Option<(&str, &str, &str)> {
    let (folder, rest) = test.split_once("::")?;
    let (target, path) = rest.split_once("::")?;
    Some((folder, target, path))
}

/// What must be known of the crates to tell whether an item is named.
#[derive(Default)]
struct Library {
    /// The functions of each trait.
    traits: HashMap<String, BTreeSet<String>>,
    /// The types and traits that have a method of a name.
    owners: HashMap<String, BTreeSet<String>>,
}

impl Library {
    fn add(&mut self, sources: &Binary) {
        for found in sources.definitions().iter().filter(|found| found.kind == Kind::Trait) {
            self.traits.entry(found.name.clone()).or_default();
        }
        for found in sources.definitions().iter().filter(|found| found.kind == Kind::Method) {
            let Some(owner) = &found.owner else { continue };
            self.owners.entry(found.name.clone()).or_default().insert(owner.clone());
            if let Some(functions) = self.traits.get_mut(owner) {
                functions.insert(found.name.clone());
            }
        }
    }

    fn is_named(&self, item: &str, reach: &[&Definition]) -> bool {
        let mut path = item.rsplit("::");
        let (Some(name), Some(owner)) = (path.next(), path.next()) else { return false };
        if is_type(name) {
            let functions = self.traits.get(name).into_iter().flatten();
            return names_word(reach, name) || functions.into_iter().any(|function| names_method(reach, function));
        }
        if !is_type(owner) {
            return names_function(reach, name);
        }
        let of_one = self.owners.get(name).is_some_and(|owners| owners.len() == 1) || self.traits.contains_key(owner);
        let names_owner = names_word(reach, owner);
        if OF_THE_TYPE.contains(&name) { names_owner } else { (of_one || names_owner) && names_method(reach, name) }
    }
}

fn is_type(name: &str) -> bool {
    name.starts_with(char::is_uppercase)
}

fn names_word(reach: &[&Definition], name: &str) -> bool {
    some_place(reach, |code, at| code[at] == name)
}

fn names_function(reach: &[&Definition], name: &str) -> bool {
    some_place(reach, |code, at| {
        code[at] == name && !is_of_value(code, at) && (is_called(code, at) || follows(code, at, "::"))
    })
}

/// Called, or written for a type: a test that implements a trait runs its function through the library.
fn names_method(reach: &[&Definition], name: &str) -> bool {
    let is_written =
        |found: &&Definition| found.kind != Kind::Function && found.code.windows(2).any(|w| w == ["fn", name]);
    some_place(reach, |code, at| {
        code[at] == name && (is_of_value(code, at) && is_called(code, at) || follows(code, at, "::"))
    }) || reach.iter().any(is_written)
}

fn some_place(reach: &[&Definition], is_it: impl Fn(&[String], usize) -> bool) -> bool {
    reach.iter().any(|definition| (0..definition.code.len()).any(|at| is_it(&definition.code, at)))
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::{Library, of_row};
    use crate::commands::ledger::binary::Binary;
    use crate::commands::ledger::rows::Row;

    const SOURCES: &str = "
        pub trait Law { fn energy(&self) -> f64; }
        pub struct Rubber; impl Rubber { pub fn new() -> Self { Rubber } pub fn stress(&self) -> f64 { 1.0 } }
        pub struct Gas; impl Gas { pub fn stress(&self) -> f64 { 1.0 } pub fn density(&self) -> f64 { 1.0 } }
        pub fn mean(list: &[f64]) -> f64 { list[0] }";

    const TESTS: &str = "
        fn rubber() -> Rubber { Rubber::new() }
        fn helper(x: f64) { assert!(x < mean(&[2.0])); }
        struct Mine; impl Law for Mine { fn energy(&self) -> f64 { 1.0 } }
        macro_rules! law { ($name:ident, $law:expr) => { #[test] fn $name() { check($law.energy()); } }; }
        law!(made_by_a_macro, Mine);
        proptest! { #[test] fn stress_is_small(x in 0.0..1.0_f64) { helper(rubber().stress()); } }
        #[test] fn density_is_small() { helper(gas().density()); }
        #[test] fn other() { let mean = 1.0; /* mean(..) */ \"mean(1)\"; rows.mean(mean); gas().stress(); }";

    fn problems(item: &str, test: &str) -> Vec<String> {
        let (mut library, mut sources, mut tests) = (Library::default(), Binary::default(), Binary::default());
        sources.add_text(SOURCES, &[]);
        library.add(&sources);
        tests.add_text(TESTS, &["laws".into()]);
        let row = Row {
            id: "W1".into(),
            folder: "a".into(),
            what: "stress".into(),
            is_done: true,
            items: vec![item.into()],
            tests: vec![format!("a::it::laws::{test}")],
        };
        of_row(&row, &HashMap::from([(("a", "it"), tests)]), &library)
    }

    #[test]
    fn items_are_named_by_the_test_or_its_helpers() {
        for (item, test) in [
            ("a::Rubber", "stress_is_small"),
            ("a::Rubber::new", "stress_is_small"),
            ("a::Rubber::stress", "stress_is_small"),
            ("a::mean", "stress_is_small"),
            ("a::Gas::density", "density_is_small"),
            ("a::Law", "made_by_a_macro"),
            ("a::Law::energy", "made_by_a_macro"),
        ] {
            assert_eq!(problems(item, test), Vec::<String>::new(), "{item} {test}");
        }
    }

    #[test]
    fn what_a_test_does_not_name_is_found() {
        // A variable, a comment, a text and a method of the name are not the function; the type is needed where the
        // name of a method is not its own.
        for (item, test) in
            [("a::mean", "other"), ("a::Gas::stress", "other"), ("a::Rubber", "other"), ("a::Law", "density_is_small")]
        {
            assert_eq!(problems(item, test).len(), 2, "{item} {test}");
        }
        assert!(problems("a::Rubber", "absent")[0].contains("no test"));
    }
}
