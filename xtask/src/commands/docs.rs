//! `cargo xtask docs`

use xshell::cmd;

use super::Command;
use crate::links;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "docs",
    usage: "",
    help: "build the reference documentation with warnings denied and check the links between Markdown files",
    prepare: |shell, workspace, _| {
        Ok(vec![
            Step::program(
                "docs: rustdoc",
                cmd!(shell, "cargo doc --workspace --no-deps --all-features").env("RUSTDOCFLAGS", "-Dwarnings"),
                "documentation must build without warnings; most often a link names an item that moved",
            ),
            Step::check(
                "docs: links",
                || links::check(workspace).map(|count| format!("{count} relative links lead somewhere")),
                "a relative link in a Markdown file names a file or a heading that does not exist",
            ),
        ])
    },
};
