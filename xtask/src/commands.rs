//! The commands: a name, a line of help, and the steps each prepares.

mod bench;
mod ci;
mod clippy;
mod continuum_accuracy;
mod docs;
mod errors;
mod features;
mod fmt;
mod gallery;
mod header;
mod ledger;
mod mpi;
mod mutants;
mod package;
mod scenes;
mod stability;
mod test;
mod tidy;
mod verification;
mod viscometry_accuracy;
mod weight;
mod wheel;
mod work_precision;

use xshell::Shell;

use crate::options::Options;
use crate::step::Step;
use crate::workspace::Workspace;

/// A command of `cargo xtask`.
pub(crate) struct Command {
    pub(crate) name: &'static str,
    pub(crate) usage: &'static str,
    pub(crate) help: &'static str,
    pub(crate) prepare: Prepare,
}

/// Takes the command's options and returns its steps.
pub(crate) type Prepare = for<'a> fn(&'a Shell, &'a Workspace, &mut Options) -> Result<Vec<Step<'a>>, String>;

const COMMANDS: &[Command] = &[
    ci::COMMAND,
    fmt::COMMAND,
    tidy::COMMAND,
    clippy::COMMAND,
    test::COMMAND,
    docs::COMMAND,
    features::COMMAND,
    package::COMMAND,
    scenes::COMMAND,
    gallery::COMMAND,
    ledger::COMMAND,
    errors::COMMAND,
    bench::COMMAND,
    work_precision::COMMAND,
    stability::COMMAND,
    continuum_accuracy::COMMAND,
    verification::COMMAND,
    viscometry_accuracy::COMMAND,
    weight::COMMAND,
    header::COMMAND,
    wheel::COMMAND,
    mpi::COMMAND,
    mutants::COMMAND,
];

pub(crate) fn find(name: &str) -> Option<&'static Command> {
    COMMANDS.iter().find(|command| command.name == name)
}

pub(crate) fn names() -> Vec<&'static str> {
    COMMANDS.iter().map(|command| command.name).collect()
}

pub(crate) fn help() -> String {
    let lines: Vec<_> = COMMANDS
        .iter()
        .map(|command| format!("  {:<20} {}", command.name, command.help.lines().next().unwrap_or_default()))
        .collect();
    format!(
        "usage: cargo xtask COMMAND [OPTIONS]

commands:
{}

options of every command:
  --keep-going    run all steps, also after one has failed
  --help          more about a command
",
        lines.join(
            "
"
        )
    )
}

pub(crate) fn help_of(command: &Command) -> String {
    format!("usage: cargo xtask {} {}\n\n{}\n", command.name, command.usage, command.help)
}

#[cfg(test)]
mod tests {
    use super::{COMMANDS, help};

    #[test]
    fn every_command_is_in_the_help_once() {
        let text = help();
        for command in COMMANDS {
            assert_eq!(text.matches(&format!("\n  {} ", command.name)).count(), 1, "{}", command.name);
            assert!(!command.help.ends_with('\n'), "{}", command.name);
        }
    }
}
