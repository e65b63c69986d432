//! Commands of a program that is built without them: named in the help, refused when they are called.

use std::ffi::OsString;

use clap::Args;

use crate::Exit;
use crate::commands::note;

/// Any arguments.
#[derive(Debug, Args)]
#[command(disable_help_flag = true)]
pub(crate) struct AnyArguments {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    _rest: Vec<OsString>,
}

/// Says which feature has the command, and how to call it then.
pub(crate) fn refuse(what: &str, feature: &str, call: &str) -> Exit {
    note(&format!(
        "error: this program is built without {what}; build it with the feature `{feature}`:\n\
         cargo run --release --features {feature} -- {call}"
    ));
    Exit::Invalid
}
