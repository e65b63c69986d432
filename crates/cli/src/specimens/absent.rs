//! The command `specimen` of a program that is built without it.

use std::ffi::OsString;

use clap::Args;

use crate::Exit;
use crate::commands::note;

#[derive(Debug, Args)]
#[command(disable_help_flag = true)]
pub(crate) struct SpecimenArguments {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    _rest: Vec<OsString>,
}

pub(crate) fn load(_: &SpecimenArguments) -> Exit {
    note(
        "error: this program is built without specimens of solids; build it with the feature `specimens`:\n\
         cargo run --release --features specimens -- specimen uniaxial --solid SOLID --path stretch=1..3",
    );
    Exit::Invalid
}
