//! Texts and places in them.

use core::ops::Range;
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use crate::DocumentError;

/// The largest scene file that is read, in bytes (4 MiB): a hundred thousand bodies written out.
///
/// Larger data belong in a table that the scene names.
pub const LARGEST_SCENE: u64 = 4 << 20;

/// A text with a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// Name in messages: a path, or `--set`.
    pub name: String,
    /// The whole text.
    pub text: String,
    /// Where each line begins, in bytes.
    lines: Vec<usize>,
    /// The folder that paths in the text are relative to, as seen from that of the document.
    folder: PathBuf,
}

/// A stretch of one source.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Place {
    /// Index of the source in the document.
    pub source: usize,
    /// Bytes of its text.
    pub span: Range<usize>,
}

impl Source {
    /// A source with its lines indexed.
    #[must_use]
    pub fn new(name: &str, text: &str) -> Self {
        let starts = text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(at, _)| at + 1);
        let lines = core::iter::once(0).chain(starts).collect();
        Self { name: name.to_string(), lines, text: text.to_string(), folder: PathBuf::new() }
    }

    /// The source with its folder, as seen from that of the document.
    pub(crate) fn in_folder(self, folder: PathBuf) -> Self {
        Self { folder, ..self }
    }

    /// A path of this text, as seen from the folder of the document.
    pub(crate) fn path(&self, text: String) -> String {
        if self.folder.as_os_str().is_empty() { text } else { self.folder.join(text).display().to_string() }
    }

    /// Line and column of a byte, both from 1; the column counts characters.
    #[must_use]
    pub fn position(&self, byte: usize) -> (usize, usize) {
        let byte = self.boundary(byte);
        let line = self.lines.partition_point(|start| *start <= byte).max(1);
        let start = self.lines[line - 1];
        (line, self.text[start..byte].chars().count() + 1)
    }

    /// The text of a line counted from 1, without its end.
    #[must_use]
    pub fn line(&self, line: usize) -> &str {
        let start = self.lines.get(line.saturating_sub(1)).copied().unwrap_or(self.text.len());
        let end = self.lines.get(line).copied().unwrap_or(self.text.len());
        self.text[start..end].trim_end_matches(['\n', '\r'])
    }

    /// The nearest character boundary at or before a byte.
    fn boundary(&self, byte: usize) -> usize {
        let mut byte = byte.min(self.text.len());
        while !self.text.is_char_boundary(byte) {
            byte -= 1;
        }
        byte
    }
}

/// The text of a file.
pub(crate) fn read(path: &Path) -> Result<String, DocumentError> {
    let shown = || path.to_path_buf();
    let unreadable = |cause: std::io::Error| DocumentError::Unreadable { path: shown(), cause: cause.to_string() };
    let data = std::fs::metadata(path).map_err(unreadable)?;
    if data.is_dir() {
        return Err(DocumentError::Folder { path: shown() });
    }
    if LARGEST_SCENE < data.len() {
        return Err(DocumentError::TooLarge { path: shown(), bytes: data.len(), most: LARGEST_SCENE });
    }
    // The length of a pipe is not known beforehand: never read more than the limit.
    let mut bytes = Vec::new();
    File::open(path).map_err(unreadable)?.take(LARGEST_SCENE + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if LARGEST_SCENE < bytes.len() as u64 {
        return Err(DocumentError::TooLarge { path: shown(), bytes: bytes.len() as u64, most: LARGEST_SCENE });
    }
    let not_text = |at: usize, bytes: &[u8]| {
        let before = &bytes[..at];
        let line = before.split(|b| *b == b'\n').count();
        let column = at - before.iter().rposition(|b| *b == b'\n').map_or(0, |newline| newline + 1) + 1;
        DocumentError::NotText { path: shown(), line, column, byte: bytes[at] }
    };
    if let Some(at) = bytes.iter().position(|b| *b == 0) {
        return Err(not_text(at, &bytes));
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        not_text(at, error.as_bytes())
    })
}
