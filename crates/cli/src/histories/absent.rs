//! Laws with history of a program that is built without them.

use piola_measured::MeasuredError;

use crate::Exit;
use crate::arguments::FitArguments;
use crate::commands::refused;

pub(crate) fn fit(arguments: &FitArguments) -> Exit {
    let error = MeasuredError::Argument {
        argument: format!("--law {}", arguments.laws.join(" --law ")),
        valid: "laws without history; for laws with history build the program with \
                `cargo install --path crates/cli --features history`",
    };
    refused(&error, arguments.json)
}
