//! The ledger as a page of the book.

use std::fmt::Write as _;

use super::rows::Row;

const HEAD: &str = "\
# The equation ledger

Every numbered equation of the sources has a row in [ledger.toml](ledger.toml): what it is, which crate states it, and, once
finished, the item that states it and the test that checks it. `cargo xtask ledger` compiles the items, looks the tests up
and reads in their text that they name the items, so that no row claims what is not there; `cargo xtask ledger --page` writes
this page.

An id is the source and the number of the equation, W(2.25) or B(4.33) (see [Notation](reference/notation.md#sources)); a word stands for
a group of formulas without a number of their own.
";

/// The page in Markdown: what is finished, then what is open, by crate.
pub(super) fn page(rows: &[Row]) -> String {
    let done = rows.iter().filter(|row| row.is_done).count();
    let mut text = format!("{HEAD}\n{done} of {} are finished.\n\n## Finished\n\n", rows.len());
    text.push_str("| equation | what | item |\n|---|---|---|\n");
    // Writing to a string cannot fail.
    for row in rows.iter().filter(|row| row.is_done) {
        let items: Vec<_> = row.items.iter().map(|item| format!("`{item}`")).collect();
        let _ = writeln!(text, "| {} | {} | {} |", row.id, row.what, items.join(", "));
    }
    text.push_str("\n## Open\n");
    let mut folders: Vec<&str> = Vec::new();
    for row in rows.iter().filter(|row| !row.is_done) {
        if !folders.contains(&row.folder.as_str()) {
            folders.push(&row.folder);
        }
    }
    for folder in folders {
        let _ = writeln!(text, "\n### {folder}\n");
        for row in rows.iter().filter(|row| !row.is_done && row.folder == folder) {
            let _ = writeln!(text, "- {}: {}", row.id, row.what);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::page;
    use crate::commands::ledger::rows::Row;

    #[test]
    fn every_row_stands_once_on_the_page() {
        let row = |id: &str, folder: &str, is_done: bool| Row {
            id: id.into(),
            folder: folder.into(),
            what: format!("what {id} is"),
            is_done,
            items: vec!["a::B".into()],
            tests: Vec::new(),
        };
        let text = page(&[row("W1", "a", true), row("W2", "a", false), row("W3", "b", false), row("W4", "a", false)]);
        for id in ["W1", "W2", "W3", "W4"] {
            assert_eq!(text.matches(&format!("what {id} is")).count(), 1, "{id}");
        }
        assert!(text.contains("1 of 4 are finished"));
    }
}
