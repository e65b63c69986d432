//! A text: read with limits, parsed with recovery, edited by settings, every value with its place.
//!
//! [`Document`] holds the tree of [`Node`]s and the [`Source`]s that it came from: the file, and one for each
//! setting, so that a mistake in a setting is shown in the setting.

use std::path::{Path, PathBuf};

use crate::{DocumentError, Mistake, Node, Report, Source, parse, settings, source};

/// A parsed file, before its meaning is checked.
///
/// # Example
/// ```
/// use piola_document::Document;
/// let mut document = Document::parse("example.toml", "name = \"example\"\n[time]\nend = \"1 h\"\n");
/// document.set("time.end=2 h");
/// assert!(document.mistakes().is_empty());
/// ```
#[derive(Debug, Clone)]
pub struct Document {
    sources: Vec<Source>,
    root: Node,
    mistakes: Vec<Mistake>,
    folder: PathBuf,
}

impl Document {
    /// Reads and parses a file. Paths inside the text are relative to the file's folder.
    ///
    /// # Errors
    /// [`DocumentError::Unreadable`], [`DocumentError::Folder`], [`DocumentError::TooLarge`] or [`DocumentError::NotText`] when there
    /// is no text to parse. Mistakes inside the text are collected instead.
    pub fn read(path: &Path) -> Result<Self, DocumentError> {
        let text = source::read(path)?;
        let mut document = Self::parse(&path.display().to_string(), &text);
        document.folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
        Ok(document)
    }

    /// Reads a file and applies settings to it, as [`set`](Self::set) does each.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_with(path: &Path, settings: &[String]) -> Result<Self, DocumentError> {
        let mut document = Self::read(path)?;
        for setting in settings {
            document.set(setting);
        }
        Ok(document)
    }

    /// Parses a text. `name` is shown in mistakes; paths inside the text are relative to the current folder.
    #[must_use]
    pub fn parse(name: &str, text: &str) -> Self {
        let source = Source::new(name, text);
        let (root, mistakes) = parse::parse(&source, 0);
        Self { sources: vec![source], root, mistakes, folder: PathBuf::new() }
    }

    /// Applies one `path=value`, as of `--set`.
    ///
    /// The path has dots between keys; an entry of a list is named by its place from 0, as `body[3].mass`, or by its
    /// name, as `body.earth.mass`. The value is TOML, and what is not TOML is taken as a text, so that
    /// `time.end=10 d` needs no quotation marks. Tables that do not exist yet are added.
    pub fn set(&mut self, setting: &str) {
        let id = self.sources.len();
        let source = Source::new("--set", setting);
        if let Err(mistake) = settings::apply(&mut self.root, &source, id) {
            self.mistakes.push(*mistake);
        }
        self.sources.push(source);
    }

    /// The tree.
    #[must_use]
    pub fn root(&self) -> &Node {
        &self.root
    }

    /// The mistakes so far: those of syntax, in the text and in the settings.
    #[must_use]
    pub fn mistakes(&self) -> &[Mistake] {
        &self.mistakes
    }

    /// The texts that places refer to.
    #[must_use]
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }

    /// The folder that paths inside the text are relative to.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The name of the text: the file's, or the one given to [`parse`](Self::parse).
    #[must_use]
    pub fn name(&self) -> &str {
        self.sources.first().map_or("", |source| &source.name)
    }

    /// A report of these mistakes in the order of their places.
    #[must_use]
    pub fn report(&self, mistakes: Vec<Mistake>) -> Report {
        Report::new(&self.sources, mistakes)
    }
}
