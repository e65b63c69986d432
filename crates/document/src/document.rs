//! A text: read with limits, parsed with recovery, edited by settings, every value with its place.
//!
//! [`Document`] holds the tree of [`Node`]s and the [`Source`]s that it came from: the file, those that it includes, and one
//! for each setting, so that a mistake in a setting is shown in the setting.

use std::path::{Path, PathBuf};

use crate::include::{self, Including};
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
    /// The values of `format` in included files.
    formats: Vec<Node>,
}

impl Document {
    /// Reads and parses a file, and the files that its key `include` names. Paths inside a text are relative to the folder of its
    /// file.
    ///
    /// `include = ["materials.toml", "arm.toml"]` merges files below the one that names them: tables key by key, lists of tables one
    /// after the other, included ones first; any other value of the file itself holds over an included one, and that of a later
    /// file over that of an earlier one. Included files can include files: at most 32 in all, at most 8 deep, each merged
    /// once. A file that cannot be read or includes itself is a mistake at the place that names it.
    ///
    /// # Errors
    /// [`DocumentError::Unreadable`], [`DocumentError::Folder`], [`DocumentError::TooLarge`] or [`DocumentError::NotText`] when there
    /// is no text to parse. Mistakes inside the text are collected instead.
    pub fn read(path: &Path) -> Result<Self, DocumentError> {
        let source = Source::new(&path.display().to_string(), &source::read(path)?);
        let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
        let (root, mistakes) = parse::parse(&source, 0);
        let (all, root) = Including::all(path, &folder, source, root, mistakes);
        Ok(Self { sources: all.sources, root, mistakes: all.mistakes, folder, formats: all.formats })
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

    /// Parses a text. `name` is shown in mistakes; paths inside the text are relative to the current folder. A text cannot include
    /// files.
    #[must_use]
    pub fn parse(name: &str, text: &str) -> Self {
        let source = Source::new(name, text);
        let (mut root, mut mistakes) = parse::parse(&source, 0);
        mistakes.extend(include::refused(&mut root));
        Self { sources: vec![source], root, mistakes, folder: PathBuf::new(), formats: Vec::new() }
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
        self.mistakes.extend(include::refused(&mut self.root));
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

    /// The versions of the format that included files name.
    pub(crate) fn formats(&self) -> &[Node] {
        &self.formats
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
