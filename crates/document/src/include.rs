//! Files that a file includes: each is read and parsed as a source of its own, then merged below the file that names it.
//!
//! Tables are merged key by key, lists of tables concatenated, included ones first in the order of `include`. Otherwise the value
//! of the file that names the others holds, and of the files in one list that of the later one. A file that is reached
//! twice is merged once, at its first place.

use std::collections::{BTreeSet, HashMap};
use std::path::{Path, PathBuf};

use crate::{Entry, Mistake, Node, Place, Source, Value, parse, source};

/// The most files that one file can include, with those that these include.
const MOST_FILES: usize = 32;

/// The most files one within the other, below the first.
const MOST_DEPTH: usize = 8;

/// The key that names the files.
const KEY: &str = "include";

/// The key with the version of the format, which each file has for itself.
pub(crate) const FORMAT: &str = "format";

/// A file and all that it includes.
pub(crate) struct Including {
    /// The file, then those that it includes, in the order in which they were reached.
    pub(crate) sources: Vec<Source>,
    /// The mistakes of all of them.
    pub(crate) mistakes: Vec<Mistake>,
    /// The values of `format` in included files.
    pub(crate) formats: Vec<Node>,
    /// The folder of the first file.
    folder: PathBuf,
    /// The files from the first to the one that is read: names, and paths without links.
    chain: Vec<(String, PathBuf)>,
    /// Paths without links of all files.
    reached: BTreeSet<PathBuf>,
}

impl Including {
    /// Reads what a parsed file includes; gives the merged tree too.
    pub(crate) fn all(path: &Path, folder: &Path, source: Source, root: Node, mistakes: Vec<Mistake>) -> (Self, Node) {
        let real = real(path);
        let mut all = Self {
            chain: vec![(source.name.clone(), real.clone())],
            sources: vec![source],
            mistakes,
            formats: Vec::new(),
            folder: folder.to_path_buf(),
            reached: BTreeSet::from([real]),
        };
        let root = all.file(root, Path::new(""));
        (all, root)
    }

    /// The tree of a file with those that it includes. `folder` is the file's, relative to that of the first file.
    fn file(&mut self, mut root: Node, folder: &Path) -> Node {
        let Some(entry) = take(&mut root, KEY) else { return root };
        let Value::List(items) = entry.node.value else {
            self.wrong(entry.node.place, format!("`{KEY}` is {}", entry.node.value.describe()));
            return root;
        };
        let mut merged = Node { place: root.place.clone(), value: Value::Table(Vec::new()) };
        for item in items {
            match item.value {
                Value::Text(text) if !text.trim().is_empty() => {
                    if let Some(included) = self.open(&folder.join(text), item.place) {
                        merge(&mut merged, included);
                    }
                }
                other => self.wrong(item.place, format!("an entry of `{KEY}` is {}", other.describe())),
            }
        }
        merge(&mut merged, root);
        merged
    }

    /// The tree of an included file; none if it is merged already, or wrong as a whole. `relative` is its path from the folder
    /// of the first file, `place` that of the entry which names it.
    fn open(&mut self, relative: &Path, place: Place) -> Option<Node> {
        let path = self.folder.join(relative);
        let (name, real) = (path.display().to_string(), real(&path));
        let names = self.chain.iter().map(|(name, _)| name.as_str()).chain([name.as_str()]);
        let chain = names.collect::<Vec<_>>().join(" → ");
        if self.chain.iter().any(|(_, open)| *open == real) {
            self.refuse(place, format!("the file includes itself: {chain}"), "files that do not include each other");
            return None;
        }
        if self.reached.contains(&real) {
            return None;
        }
        if MOST_DEPTH < self.chain.len() {
            let valid = format!("files at most {MOST_DEPTH} deep");
            self.refuse(place, format!("files are included too deep: {chain}"), &valid);
            return None;
        }
        if MOST_FILES < self.sources.len() {
            let valid = format!("at most {MOST_FILES} files");
            self.refuse(place, format!("too many files are included: {chain}"), &valid);
            return None;
        }
        let text = match source::read(&path) {
            Ok(text) => text,
            Err(error) => {
                let mut mistake = Mistake::new(place, error.to_string());
                mistake.syntax = true;
                self.mistakes.push(mistake);
                return None;
            }
        };
        let folder = relative.parent().map(Path::to_path_buf).unwrap_or_default();
        let source = Source::new(&name, &text).in_folder(folder.clone());
        let (mut root, mut mistakes) = parse::parse(&source, self.sources.len());
        self.sources.push(source);
        self.mistakes.append(&mut mistakes);
        self.formats.extend(take(&mut root, FORMAT).map(|entry| entry.node));
        self.reached.insert(real.clone());
        self.chain.push((name, real));
        let root = self.file(root, &folder);
        self.chain.pop();
        Some(root)
    }

    fn wrong(&mut self, place: Place, found: String) {
        self.refuse(place, found, "a list of paths of files, as [\"materials.toml\", \"arm.toml\"]");
    }

    /// What the files hold is not known: nothing is missed in the document.
    fn refuse(&mut self, place: Place, found: String, valid: &str) {
        let mut mistake = Mistake::new(place, found).valid(valid);
        mistake.syntax = true;
        self.mistakes.push(mistake);
    }
}

/// Takes `include` out of a tree that is of no file: a mistake, if it is there.
pub(crate) fn refused(root: &mut Node) -> Option<Mistake> {
    let entry = take(root, KEY)?;
    let mut mistake = Mistake::new(entry.place, "only a file can include files")
        .valid(format!("no `{KEY}` in a setting or in a text without a file"));
    mistake.syntax = true;
    Some(mistake)
}

fn take(root: &mut Node, key: &str) -> Option<Entry> {
    let Value::Table(entries) = &mut root.value else { return None };
    let index = entries.iter().position(|entry| entry.key == key)?;
    Some(entries.remove(index))
}

/// The path without links and `..`; as it stands if there is no such file.
fn real(path: &Path) -> PathBuf {
    std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf())
}

/// Merges `over` into `under`: tables key by key, lists of tables one after the other; any other value of `over` holds.
fn merge(under: &mut Node, over: Node) {
    under.place = over.place;
    match (&mut under.value, over.value) {
        (Value::Table(entries), Value::Table(own)) => {
            let places: HashMap<String, usize> =
                entries.iter().enumerate().map(|(index, entry)| (entry.key.clone(), index)).collect();
            for entry in own {
                match places.get(&entry.key) {
                    Some(index) => {
                        entries[*index].place = entry.place;
                        merge(&mut entries[*index].node, entry.node);
                    }
                    None => entries.push(entry),
                }
            }
        }
        (Value::List(items), Value::List(own)) if are_tables(items) && are_tables(&own) => items.extend(own),
        (value, own) => *value = own,
    }
}

fn are_tables(items: &[Node]) -> bool {
    !items.is_empty() && items.iter().all(|item| matches!(item.value, Value::Table(_)))
}
