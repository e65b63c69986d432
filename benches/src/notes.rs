//! What a bench knows beside its time: the error of its result, and whether it is a peer's.
//!
//! The notes of a group go to `<folder>/<group>.json`, an object from names of benches to
//! `{"error": …, "peer": …}`, where the folder is named by the environment variable `PIOLA_BENCH_NOTES`;
//! without it they go nowhere.

use std::path::PathBuf;

use serde_json::{Map, Value, json};

/// The environment variable that names the folder.
const FOLDER: &str = "PIOLA_BENCH_NOTES";

/// The notes of one group of benches.
#[derive(Clone, Debug)]
pub struct Notes {
    group: &'static str,
    notes: Map<String, Value>,
}

impl Notes {
    /// The notes of a group, still empty.
    #[must_use]
    pub fn of(group: &'static str) -> Self {
        Self { group, notes: Map::new() }
    }

    /// Notes the relative error of the result of a bench.
    pub fn error(&mut self, bench: &str, error: f64) {
        self.note(bench, "error", json!(error));
    }

    /// Notes the peer that runs in a bench, with its version.
    pub fn peer(&mut self, bench: &str, peer: &str) {
        self.note(bench, "peer", json!(peer));
    }

    /// Notes any other number of a bench.
    pub fn number(&mut self, bench: &str, key: &str, number: f64) {
        self.note(bench, key, json!(number));
    }

    fn note(&mut self, bench: &str, key: &str, value: Value) {
        let notes = self.notes.entry(bench).or_insert_with(|| json!({}));
        if let Some(notes) = notes.as_object_mut() {
            notes.insert(key.into(), value);
        }
    }

    /// Writes the notes where the environment wants them.
    ///
    /// # Errors
    /// The folder or the file cannot be written.
    pub fn write(self) -> std::io::Result<()> {
        let Some(folder) = std::env::var_os(FOLDER).map(PathBuf::from) else { return Ok(()) };
        std::fs::create_dir_all(&folder)?;
        std::fs::write(folder.join(self.group).with_extension("json"), Value::Object(self.notes).to_string())
    }
}
