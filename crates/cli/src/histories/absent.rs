//! Laws with history of a program that is built without them.

use crate::Exit;
use crate::arguments::FitArguments;
use crate::commands::note;

pub(crate) fn fit(arguments: &FitArguments) -> Exit {
    note(&format!(
        "error: this program is built without laws with history; build it with the feature `history`:\n\
         cargo run --release --features history -- fit {} --law {}",
        arguments.data.display(),
        arguments.laws.join(" --law ")
    ));
    Exit::Invalid
}
