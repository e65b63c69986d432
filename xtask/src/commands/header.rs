//! `cargo xtask header`

use xshell::cmd;

use super::Command;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "header",
    usage: "",
    help: "write crates/ffi/include/piola.h from the sources
A test of piola-ffi compares the header with the sources; this runs it so that it writes instead.",
    prepare: |shell, _, _| {
        let test = cmd!(shell, "cargo test --quiet --package piola-ffi --test it the_header_is_that_of_the_sources");
        Ok(vec![Step::program(
            "header",
            test.env("PIOLA_HEADER", "write"),
            "the sources of crates/ffi/src/c are not what cbindgen reads",
        )])
    },
};
