//! The tables of a reference, in Markdown.

use core::fmt::Write as _;

use super::{Absent, Key, Kind, Table};
use crate::units::{Dimension, UNITS};

/// Every table with its keys and choices, then the units, as a reference prints them.
#[must_use]
pub fn markdown(root: &Table) -> String {
    let mut text = String::new();
    table(&mut text, root, &format!("The {}", root.name));
    for key in root.keys {
        match key.kind {
            Kind::Table(inner) => table(&mut text, inner, &format!("`[{}]`", inner.name)),
            Kind::Tables(inner) => table(&mut text, inner, &format!("`[[{}]]`", inner.name)),
            _ => {}
        }
    }
    text.push_str("## Units\n\n| unit | meaning | dimension |\n|---|---|---|\n");
    for unit in UNITS {
        let _ = writeln!(text, "| `{}` | {} | {} |", unit.name, unit.doc, unit.unit.dimension);
    }
    text
}

fn table(text: &mut String, table: &Table, heading: &str) {
    let _ =
        write!(text, "## {heading}\n\n{}\n\n| key | value | when absent | meaning |\n|---|---|---|---|\n", table.doc);
    for key in table.keys {
        let _ = writeln!(text, "| `{}` | {} | {} | {} |", key.name, value(&key.kind), absent(key), meaning(key));
    }
    text.push('\n');
    for key in table.keys {
        if let Kind::Choice(words) = key.kind {
            let _ = write!(text, "| `{}` | |\n|---|---|\n", key.name);
            for word in words {
                let _ = writeln!(text, "| `\"{}\"` | {} |", word.name, cell(word.doc));
            }
            text.push('\n');
        }
    }
}

fn value(kind: &Kind) -> String {
    let unit = |dimension: &Dimension| {
        if *dimension == Dimension::NONE { String::new() } else { format!(", {}", dimension.si_unit()) }
    };
    match kind {
        Kind::Name => "name".to_string(),
        Kind::Text => "text".to_string(),
        Kind::Texts => "list of texts".to_string(),
        Kind::Path => "path".to_string(),
        Kind::Flag => "true or false".to_string(),
        Kind::Count { least, most } => format!("{least} … {most}"),
        Kind::Quantity(dimension, range) => format!("number{}{}", range.words(), unit(dimension)),
        Kind::Numbers(dimension, counts) => {
            let counts: Vec<String> = counts.iter().map(ToString::to_string).collect();
            format!("{} numbers{}", counts.join(" or "), unit(dimension))
        }
        Kind::Choice(_) => "see below".to_string(),
        Kind::Table(inner) => format!("table `[{}]`", inner.name),
        Kind::Tables(inner) => format!("tables `[[{}]]`", inner.name),
        Kind::Parameters => "names with numbers of any unit".to_string(),
    }
}

fn absent(key: &Key) -> String {
    match key.absent {
        Absent::Required => "**must be given**".to_string(),
        Absent::Optional => String::new(),
        Absent::Default(text) => format!("`{text}`"),
    }
}

/// Text in a cell of a table, where `|` would begin the next one.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

fn meaning(key: &Key) -> String {
    let doc = cell(key.doc);
    if key.only_for.is_empty() {
        return doc;
    }
    let types: Vec<String> = key.only_for.iter().map(|name| format!("`{name}`")).collect();
    format!("{doc} Only of type {}.", types.join(", "))
}
