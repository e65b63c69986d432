//! Options of the command `fit` that not every kind of law has.

use piola_measured::MeasuredError;

use crate::arguments::FitArguments;

/// Refuses options that a kind of fit does not have; it has those that are named, --law, --intervals, --profile,
/// --confidence, --out and --json.
pub(crate) fn refuse_all_but(
    arguments: &FitArguments,
    used: &[&str],
    valid: &'static str,
) -> Result<(), MeasuredError> {
    let options = [
        (arguments.mode_weights.is_some(), "--mode-weights"),
        (arguments.equal_errors, "--equal-errors"),
        (arguments.allow_unstable, "--allow-unstable"),
        (!arguments.only.is_empty(), "--only"),
        (arguments.cross_validate, "--cross-validate"),
        (arguments.to.is_some(), "--to"),
        (!arguments.bounds.is_empty(), "--bound"),
        (!arguments.cards.is_empty(), "--card"),
    ];
    match options.iter().find(|(given, option)| *given && !used.contains(option)) {
        Some((_, option)) => Err(MeasuredError::Argument { argument: (*option).to_owned(), valid }),
        None => Ok(()),
    }
}
