//! Mistakes in tables, with their lines.

use core::fmt;
use std::path::PathBuf;

/// A mistake in a table.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
#[non_exhaustive]
pub struct TableMistake {
    /// The line, from 1.
    pub line: u64,
    /// The mistake in words.
    pub what: String,
    /// A valid value in words.
    pub valid: String,
}

impl TableMistake {
    pub(crate) fn new(line: u64, what: impl Into<String>, valid: impl Into<String>) -> Self {
        Self { line, what: what.into(), valid: valid.into() }
    }
}

/// All mistakes of a table, by line.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct TableReport {
    /// The file.
    pub path: PathBuf,
    /// The first of the mistakes.
    pub mistakes: Vec<TableMistake>,
    /// How many more there are.
    pub more: usize,
}

impl TableReport {
    pub(crate) fn new(path: PathBuf, mut mistakes: Vec<TableMistake>) -> Self {
        /// Mistakes beyond this are counted only.
        const SHOWN: usize = 20;
        let more = mistakes.len().saturating_sub(SHOWN);
        mistakes.truncate(SHOWN);
        Self { path, mistakes, more }
    }
}

impl fmt::Display for TableReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, TableMistake { line, what, valid }) in self.mistakes.iter().enumerate() {
            let end = if index == 0 { "" } else { "\n" };
            write!(f, "{end}{}:{line}: {what}; valid: {valid}", self.path.display())?;
        }
        if 0 < self.more { write!(f, "\nand {} more mistakes", self.more) } else { Ok(()) }
    }
}
