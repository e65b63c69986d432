//! `cargo xtask tidy`: the conventions that no compiler checks.

pub(super) mod crates;
mod imports;
mod names;
mod reach;
mod sources;
mod testdata;

use super::{Command, gallery};
use crate::step::{Outcome, Step};

pub(super) const COMMAND: Command = Command {
    name: "tidy",
    usage: "",
    help: "check the conventions that no compiler checks
sources   a `//!` on top of every file; no test that is skipped or expects a panic; nothing left open; no panic in
          library code; no white space at the end of a line; no path of a developer's machine
names     one name for one thing: the conditions of errors, arguments, words that have a standard term, public types
          that share a name
imports   folders inside a crate have floors, and no two files import each other
crates    the arrows between the crates are those of ARCHITECTURE.md; internal dependencies name the workspace's entry,
          internal development dependencies only a path; README, LICENSE and metadata in each crate that is published;
          no crate is larger than its limit; the facade's table names its features
testdata  every reference value says where it came from
gallery   docs/gallery.md has every scene
reach     docs/reference/reach.md has every public module",
    prepare: |_, workspace, _| {
        Ok(vec![
            Step::check(
                "tidy: sources",
                || report(sources::check(workspace), "sources are tidy"),
                "conventions of the sources: `cargo xtask tidy --help` lists them",
            ),
            Step::check(
                "tidy: names",
                || report(names::check(workspace), "names are tidy"),
                "one name for one thing: docs/reference/naming.md",
            ),
            Step::check(
                "tidy: imports",
                || report(imports::check(workspace), "imports go down"),
                "what two files or two folders share moves to a third, lower one",
            ),
            Step::check(
                "tidy: crates",
                || report(crates::check(workspace), "crates are tidy"),
                "conventions of the manifests; a new arrow between crates also changes ARCHITECTURE.md and this check",
            ),
            Step::check(
                "tidy: testdata",
                || report(testdata::check(workspace), "reference data states its provenance"),
                "a reference value without a source is worth nothing",
            ),
            Step::check(
                "tidy: gallery",
                || report(gallery::missing(workspace), "the gallery has every scene"),
                "`cargo xtask gallery` writes the page and its figures",
            ),
            Step::check(
                "tidy: reach",
                || report(reach::check(workspace), "the table of what is reached has every public module"),
                "docs/reference/reach.md says which scene key or verb reaches each module, or why none does",
            ),
        ])
    },
};

fn report(problems: Vec<String>, line: &str) -> Outcome {
    if problems.is_empty() { Ok(line.to_owned()) } else { Err(problems) }
}
