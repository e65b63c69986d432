//! `cargo xtask errors`: every error that a user can meet, on one page.

use std::fmt::Write as _;

use super::Command;
use crate::step::{Outcome, Step};
use crate::workspace::{Workspace, read};

pub(super) const COMMAND: Command = Command {
    name: "errors",
    usage: "[--page]",
    help: "check that docs/reference/errors.md lists every error message of the crates
--page    write that page anew",
    prepare: |_, workspace, options| {
        let page = options.flag("--page");
        Ok(vec![Step::check(
            "errors",
            move || if page { write(workspace) } else { compare(workspace) },
            "docs/reference/errors.md is made by `cargo xtask errors --page`: read the messages there once, aloud",
        )])
    },
};

const PAGE: &str = "docs/reference/errors.md";

fn write(workspace: &Workspace) -> Outcome {
    let (text, count) = page(workspace);
    let file = workspace.root.join(PAGE);
    std::fs::write(&file, text).map_err(|error| vec![format!("{}: {error}", file.display())])?;
    Ok(format!("{count} errors in {PAGE}"))
}

fn compare(workspace: &Workspace) -> Outcome {
    let (text, count) = page(workspace);
    let found = read(&workspace.root.join(PAGE)).map_err(|error| vec![error])?;
    if found == text {
        Ok(format!("{count} errors, all in {PAGE}"))
    } else {
        Err(vec![format!("{PAGE} is not current")])
    }
}

/// The page, and how many errors it lists.
fn page(workspace: &Workspace) -> (String, usize) {
    let mut text = String::from(
        "# Errors\n\nEvery message that a crate can give, by its enum; words in braces are filled in. Written by\n`cargo xtask errors --page`.\n",
    );
    let mut count = 0;
    let mut files: Vec<_> = workspace.files();
    files.retain(|path| {
        let place = workspace.relative(path).to_string();
        place.starts_with("crates/")
            && place.contains("/src/")
            && path.extension().is_some_and(|extension| extension == "rs")
    });
    for path in files {
        for (name, errors) in enums(&read(&path).unwrap_or_default()) {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "\n## {name}\n\n| condition | message |\n|---|---|");
            for (variant, message) in &errors {
                let _ = writeln!(text, "| `{variant}` | {} |", message.replace('|', "\\|"));
            }
            count += errors.len();
        }
    }
    (text, count)
}

/// The enums and structs of a file that have messages: for each its variants with theirs.
fn enums(source: &str) -> Vec<(String, Vec<(String, String)>)> {
    let mut enums: Vec<(String, Vec<(String, String)>)> = Vec::new();
    let (mut name, mut message) = (String::new(), None);
    let mut lines = source.lines();
    while let Some(line) = lines.next() {
        let line = line.trim();
        if let Some(rest) = line.strip_prefix("pub enum ") {
            name = word(rest);
        } else if let Some(rest) = line.strip_prefix("pub struct ") {
            enums.extend(message.take().map(|message| (word(rest), vec![(word(rest), message)])));
        } else if let Some(rest) = line.strip_prefix("#[error(") {
            let mut attribute = rest.to_owned();
            while !attribute.ends_with(")]") {
                let Some(next) = lines.next() else { break };
                attribute.push('\n');
                attribute.push_str(next);
            }
            message = Some(said(attribute.trim_end_matches(")]")));
        } else if !line.starts_with("//")
            && !line.starts_with('#')
            && !line.is_empty()
            && let Some(message) = message.take()
        {
            match enums.last_mut().filter(|(last, _)| *last == name) {
                Some((_, errors)) => errors.push((word(line), message)),
                None => enums.push((name.clone(), vec![(word(line), message)])),
            }
        }
    }
    enums
}

fn word(text: &str) -> String {
    text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

/// The text of a message: the string alone, in one line.
fn said(attribute: &str) -> String {
    let Some(start) = attribute.find('"') else { return "the message of the wrapped error".into() };
    let rest = &attribute[start + 1..];
    let mut text = String::new();
    let mut characters = rest.chars().peekable();
    while let Some(c) = characters.next() {
        match c {
            '"' => break,
            // A line that goes on: the white space after it is not part of the text.
            '\\' if characters.peek() == Some(&'\n') => while characters.next_if(|c| c.is_whitespace()).is_some() {},
            '\\' => text.extend(characters.next()),
            '\n' => text.push(' '),
            c => text.push(c),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::enums;

    #[test]
    fn messages_are_found_with_their_variants() {
        let source = "pub enum AError {\n    /// Words.\n    #[error(\"`{x}` is \\\n             bad\")]\n    Bad {\n        /// X.\n        x: f64,\n    },\n    #[error(transparent)]\n    Other(#[from] B),\n}\n";
        let found = enums(source);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].0, "AError");
        assert_eq!(found[0].1[0], ("Bad".into(), "`{x}` is bad".into()));
        assert_eq!(found[0].1[1], ("Other".into(), "the message of the wrapped error".into()));
    }
}
