//! Mistakes in a document and their presentation.

use core::fmt;

use serde::Serialize;

use crate::{Place, Source};

/// One thing that is wrong: where, what was found, and what would be valid.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mistake {
    /// Where.
    pub place: Place,
    /// The text or value that is wrong.
    pub found: String,
    /// A valid value in words, if one can be named.
    pub valid: Option<String>,
    /// A second place that belongs to it, with a word on why.
    pub see: Option<(Place, String)>,
    /// Whether the text at this place could not be read: it is not TOML, or it names files that cannot be included.
    pub syntax: bool,
}

impl Mistake {
    /// A mistake at a place.
    #[must_use]
    pub fn new(place: Place, found: impl Into<String>) -> Self {
        Self { place, found: found.into(), valid: None, see: None, syntax: false }
    }
    /// Adds what would be valid.
    #[must_use]
    pub fn valid(mut self, valid: impl Into<String>) -> Self {
        self.valid = Some(valid.into());
        self
    }
    /// Adds a second place.
    #[must_use]
    pub fn see(mut self, place: Place, why: impl Into<String>) -> Self {
        self.see = Some((place, why.into()));
        self
    }
}

/// A mistake with its place worked out, as it is shown and as `check --json` prints it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Located {
    /// The file, or `--set`.
    pub source: String,
    /// Line from 1.
    pub line: usize,
    /// Column from 1, in characters.
    pub column: usize,
    /// The text or value that is wrong.
    pub found: String,
    /// A valid value in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub valid: Option<String>,
    /// The text of the line.
    #[serde(skip)]
    excerpt: Excerpt,
    #[serde(skip)]
    see: Option<(String, Excerpt)>,
}

/// The line of a place and the part of it to be marked.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Excerpt {
    source: String,
    line: usize,
    column: usize,
    text: String,
    before: usize,
    marked: usize,
}

/// All mistakes of a document, in the order of the text.
///
/// At most [`SHOWN`](Self::SHOWN) are kept; the rest are counted.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Report {
    /// The first mistakes.
    pub mistakes: Vec<Located>,
    /// How many more there are.
    pub more: usize,
}

impl Report {
    /// How many mistakes are shown.
    pub const SHOWN: usize = 20;

    pub(crate) fn new(sources: &[Source], mut mistakes: Vec<Mistake>) -> Self {
        // Stable: mistakes at one place stay in the order in which they were found.
        mistakes.sort_by_key(|mistake| (mistake.place.source, mistake.place.span.start));
        mistakes.dedup_by(|a, b| a.place == b.place && a.found == b.found);
        let more = mistakes.len().saturating_sub(Self::SHOWN);
        mistakes.truncate(Self::SHOWN);
        let located = mistakes.into_iter().map(|mistake| {
            let excerpt = excerpt(sources, &mistake.place);
            Located {
                source: excerpt.source.clone(),
                line: excerpt.line,
                column: excerpt.column,
                found: mistake.found,
                valid: mistake.valid,
                see: mistake.see.map(|(place, why)| (why, self::excerpt(sources, &place))),
                excerpt,
            }
        });
        Self { mistakes: located.collect(), more }
    }
}

/// The longest piece of a line that is shown, in characters.
const WIDTH: usize = 100;

fn excerpt(sources: &[Source], place: &Place) -> Excerpt {
    let Some(source) = sources.get(place.source) else {
        return Excerpt { source: String::new(), line: 1, column: 1, text: String::new(), before: 0, marked: 1 };
    };
    let (line, column) = source.position(place.span.start);
    let (end_line, end_column) = source.position(place.span.end);
    let whole: Vec<char> = source.line(line).chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let marked = if end_line == line { end_column - column } else { whole.len().saturating_sub(column - 1) };
    // A long line is shown from a little before the place.
    let start = if column + marked.min(40) <= WIDTH { 0 } else { column.saturating_sub(30) };
    let text: String = whole.iter().skip(start).take(WIDTH).collect();
    let before = column - 1 - start;
    let marked = marked.clamp(1, WIDTH.saturating_sub(before).max(1));
    Excerpt { source: source.name.clone(), line, column, text, before, marked }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for mistake in &self.mistakes {
            writeln!(f, "{mistake}\n")?;
        }
        match (self.mistakes.len(), self.more) {
            (1, 0) => write!(f, "1 mistake"),
            (shown, 0) => write!(f, "{shown} mistakes"),
            (shown, more) => write!(f, "{shown} mistakes and {more} more"),
        }
    }
}

impl fmt::Display for Located {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error: {}", self.found)?;
        self.excerpt.write(f, '^', "")?;
        if let Some((why, excerpt)) = &self.see {
            excerpt.write(f, '-', why)?;
        }
        if let Some(valid) = &self.valid {
            let margin = " ".repeat(self.excerpt.margin());
            write!(f, "\n{margin} = valid: {valid}")?;
        }
        Ok(())
    }
}

impl Excerpt {
    /// Width of the line numbers.
    fn margin(&self) -> usize {
        self.line.to_string().len() + 1
    }

    fn write(&self, f: &mut fmt::Formatter<'_>, mark: char, label: &str) -> fmt::Result {
        let Self { source, line, column, text, before, marked } = self;
        let margin = " ".repeat(self.margin());
        write!(f, "\n{margin}--> {source}:{line}:{column}\n{margin} |\n {line} | {text}\n{margin} | ")?;
        write!(f, "{}{}", " ".repeat(*before), mark.to_string().repeat(*marked))?;
        if label.is_empty() { Ok(()) } else { write!(f, " {label}") }
    }
}
