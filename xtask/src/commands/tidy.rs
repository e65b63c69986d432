//! `cargo xtask tidy`: the conventions that no compiler checks.

mod crates;
mod sources;
mod testdata;

use super::Command;
use crate::step::{Outcome, Step};

pub(super) const COMMAND: Command = Command {
    name: "tidy",
    usage: "",
    help: "check the conventions that no compiler checks
sources   a `//!` on top of every file; no test that is skipped or expects a panic; nothing left open; no panic in
          library code; no white space at the end of a line; no path of a developer's machine
crates    the arrows between the crates are those of ARCHITECTURE.md; internal dependencies name the workspace's entry,
          internal development dependencies only a path; README, LICENSE and metadata in each crate that is published
testdata  every reference value says where it came from",
    prepare: |_, workspace, _| {
        Ok(vec![
            Step::check(
                "tidy: sources",
                || report(sources::check(workspace), "sources are tidy"),
                "conventions of the sources: `cargo xtask tidy --help` lists them",
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
        ])
    },
};

fn report(problems: Vec<String>, line: &str) -> Outcome {
    if problems.is_empty() { Ok(line.to_owned()) } else { Err(problems) }
}
