//! `cargo xtask ledger`: every numbered equation has a home.

mod binary;
mod items;
mod mentions;
mod page;
mod rows;
mod tests_of;

use std::collections::BTreeMap;

use serde_json::json;
use xshell::Shell;

use super::Command;
use crate::step::{Outcome, Step};
use crate::workspace::{Workspace, read};
use rows::Row;

pub(super) const COMMAND: Command = Command {
    name: "ledger",
    usage: "[--json | --text | --page]",
    help: "check docs/ledger.toml: each finished row names items that exist and tests that run and name the items
The items are compiled as `use` lines (methods as links of rustdoc) and the tests looked up in the lists of the test
binaries. That a test names an item, by itself or through its helpers, is read from its text.
--text   check only what is read from text, which compiles nothing
--json   print {done_ids, missing_ids}; a row whose check fails counts as missing
--page   write docs/ledger.md from the rows, and check nothing",
    prepare: |shell, workspace, options| {
        let as_json = options.flag("--json");
        let checks: &[Check] = if options.flag("--text") {
            &[mentions::missing]
        } else {
            &[mentions::missing, tests_of::missing, items::missing]
        };
        if options.flag("--page") {
            return Ok(vec![Step::check("ledger: page", || write_page(workspace), "the page could not be written")]);
        }
        Ok(vec![Step::check(
            "ledger",
            move || check(shell, workspace, checks, as_json),
            "a finished row of docs/ledger.toml names an item or a test that does not exist, or a test of something else",
        )])
    },
};

const PAGE: &str = "docs/ledger.md";

fn write_page(workspace: &Workspace) -> Outcome {
    let text = read(&workspace.root.join("docs/ledger.toml")).map_err(|problem| vec![problem])?;
    let (rows, problems) = rows::parse(&text);
    if !problems.is_empty() {
        return Err(problems);
    }
    std::fs::write(workspace.root.join(PAGE), page::page(&rows)).map_err(|error| vec![format!("{PAGE}: {error}")])?;
    Ok(format!("wrote {PAGE}"))
}

/// One way to look at the finished rows: what is wrong, each with the id of its row.
type Check = for<'r> fn(&Shell, &Workspace, &[&'r Row]) -> Result<Vec<(&'r str, String)>, String>;

fn check(shell: &Shell, workspace: &Workspace, checks: &[Check], as_json: bool) -> Outcome {
    let text = read(&workspace.root.join("docs/ledger.toml")).map_err(|problem| vec![problem])?;
    let (rows, mut problems) = rows::parse(&text);
    if read(&workspace.root.join(PAGE)).unwrap_or_default() != page::page(&rows) {
        problems.push(format!("{PAGE} is out of date: run `cargo xtask ledger --page`"));
    }
    let done: Vec<&Row> = rows.iter().filter(|row| row.is_done).collect();
    let mut could_not_check = false;
    // Problems by id: one row may have several, and counts as missing with any.
    let mut failed: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for check in checks {
        match check(shell, workspace, &done) {
            Ok(found) => {
                for (id, problem) in found {
                    failed.entry(id).or_default().push(problem);
                }
            }
            Err(problem) => {
                could_not_check = true;
                problems.push(problem);
            }
        }
    }
    let is_sound = |row: &&Row| row.is_done && !could_not_check && !failed.contains_key(row.id.as_str());
    let done_ids: Vec<_> = rows.iter().filter(is_sound).map(|row| &row.id).collect();
    let missing_ids: Vec<_> = rows.iter().filter(|row| !is_sound(row)).map(|row| &row.id).collect();
    let line = format!("{} of {} equations have a home", done_ids.len(), rows.len());
    if as_json {
        print(&json!({ "done_ids": done_ids, "missing_ids": missing_ids }).to_string());
    }
    problems.extend(failed.iter().flat_map(|(id, found)| found.iter().map(move |what| format!("{id}: {what}"))));
    if problems.is_empty() { Ok(line) } else { Err(problems) }
}

#[expect(clippy::print_stdout, reason = "the command's answer, for other programs to read")]
fn print(text: &str) {
    println!("{text}");
}
