//! The command `register` of a program that is built without it.

use std::ffi::OsString;

use clap::Args;

use crate::Exit;
use crate::commands::note;

#[derive(Debug, Args)]
#[command(disable_help_flag = true)]
pub(crate) struct RegisterArguments {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    _rest: Vec<OsString>,
}

pub(crate) fn register(_: &RegisterArguments) -> Exit {
    note(
        "error: this program is built without registration of images; build it with the feature `register`:\n\
         cargo run --release --features register -- register FIXED MOVING --out DIR",
    );
    Exit::Invalid
}
