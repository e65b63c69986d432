//! The files of the project, and their copy that the mutants stand in.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use xshell::{Shell, cmd};

use crate::draw::{HASH_OF_NOTHING, hash};

/// The text of a file, with its path in the error.
pub(crate) fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// The copy.
pub(crate) struct Copy {
    from: PathBuf,
    pub(crate) root: PathBuf,
    /// What git keeps or would keep, from the root.
    files: Vec<String>,
}

impl Copy {
    pub(crate) fn new(shell: &Shell, from: &Path, root: PathBuf) -> Result<Self, String> {
        let _place = shell.push_dir(from);
        let listed = cmd!(shell, "git ls-files -z --cached --others --exclude-standard").quiet().read();
        let listed = listed.map_err(|error| error.to_string())?;
        let mut files: Vec<_> = listed.split('\0').filter(|file| !file.is_empty()).map(str::to_owned).collect();
        files.retain(|file| from.join(file).is_file());
        files.sort();
        files.dedup();
        Ok(Self { from: from.to_path_buf(), root, files })
    }

    /// Numbers for all that the tests see (sources, tests, reference data, scenes, manifests), and for what mutants stand in.
    pub(crate) fn hashes(&self) -> Result<[u64; 2], String> {
        let folders = ["crates/", "testdata/", "data/", "scenes/", ".cargo/"];
        let (mut all, mut sources) = (HASH_OF_NOTHING, HASH_OF_NOTHING);
        for file in &self.files {
            let is_documentation = Path::new(file).extension().is_some_and(|extension| extension == "md");
            let is_seen = folders.iter().any(|folder| file.starts_with(folder)) && !is_documentation;
            let is_manifest = file.ends_with("Cargo.toml") || file == "Cargo.lock";
            if is_seen || is_manifest {
                let text = bytes(&self.from.join(file))?;
                all = hash(hash(all, file.as_bytes()), &text);
                if is_manifest || file.contains("/src/") {
                    sources = hash(hash(sources, file.as_bytes()), &text);
                }
            }
        }
        Ok([all, sources])
    }

    /// Makes the copy equal to the project with `changed` texts in place of some files.
    ///
    /// A file that is already right is left alone, so that cargo does not build it again.
    pub(crate) fn write(&self, changed: &BTreeMap<String, String>) -> Result<(), String> {
        let mut expected = BTreeSet::new();
        for file in &self.files {
            if !changed.contains_key(file) {
                put(&self.root.join(file), &bytes(&self.from.join(file))?)?;
                expected.insert(self.root.join(file));
            }
        }
        for (file, text) in changed {
            put(&self.root.join(file), text.as_bytes())?;
            expected.insert(self.root.join(file));
        }
        remove_others(&self.root, &expected)
    }
}

fn bytes(path: &Path) -> Result<Vec<u8>, String> {
    std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn put(path: &Path, bytes: &[u8]) -> Result<(), String> {
    if std::fs::read(path).is_ok_and(|present| present == bytes) {
        return Ok(());
    }
    let folder = path.parent().map_or(Ok(()), std::fs::create_dir_all);
    folder.and_then(|()| std::fs::write(path, bytes)).map_err(|error| format!("{}: {error}", path.display()))
}

/// What tests left in the copy, and what the project no longer has.
fn remove_others(folder: &Path, expected: &BTreeSet<PathBuf>) -> Result<(), String> {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            remove_others(&path, expected)?;
        } else if !expected.contains(&path) {
            std::fs::remove_file(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        }
    }
    Ok(())
}
