//! Completions of shells, and pages of the manual.

use clap::{Args, Command};
use clap_complete::Shell;

use crate::Exit;
use crate::commands::{note, print};

#[derive(Debug, Args)]
pub(crate) struct CompletionsArguments {
    /// The shell.
    pub(crate) shell: Shell,
}

pub(crate) fn completions(arguments: &CompletionsArguments, mut program: Command) -> Exit {
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut program, "piola", &mut text);
    print(&String::from_utf8_lossy(&text));
    Exit::Done
}

#[derive(Debug, Args)]
pub(crate) struct ManualArguments {
    /// The command whose page is printed, as `fit`; without it, the page of the program.
    pub(crate) command: Option<String>,
}

pub(crate) fn manual(arguments: &ManualArguments, mut program: Command) -> Exit {
    program.build();
    let page = match arguments.command.as_deref() {
        None => program,
        Some(name) => {
            let Some(command) = program.find_subcommand(name) else {
                let names: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
                note(&format!("error: no command is called `{name}`; valid: {}", names.join(", ")));
                return Exit::Invalid;
            };
            command.clone()
        }
    };
    let mut text = Vec::new();
    // Nothing that is written to memory can fail.
    let _ = clap_mangen::Man::new(page).render(&mut text);
    print(&String::from_utf8_lossy(&text));
    Exit::Done
}
