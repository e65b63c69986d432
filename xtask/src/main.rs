//! The project's only build tool: `cargo xtask COMMAND`.
//!
//! A command does not run anything: it *prepares* a list of [`Step`](step::Step)s, which one loop then runs, times and
//! reports. `ci` is the concatenation of the commands a developer runs alone, so nothing can pass here and fail there.
#![forbid(unsafe_code)]

mod commands;
mod links;
mod options;
mod source;
mod step;
mod workspace;

use std::process::ExitCode;

use options::Options;
use workspace::Workspace;
use xshell::Shell;

fn main() -> ExitCode {
    match run(std::env::args().skip(1).collect()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::from(2)
        }
    }
}

/// `Ok(false)` when a step failed, `Err` when nothing could be started.
fn run(arguments: Vec<String>) -> Result<bool, String> {
    let mut options = Options::new(arguments);
    let asks_for_help = options.flag("--help") || options.flag("-h");
    let Some(name) = options.word() else {
        eprint!("{}", commands::help());
        return if asks_for_help { Ok(true) } else { Err("no command given".into()) };
    };
    let command = commands::find(&name)
        .ok_or_else(|| format!("no command `{name}`; the commands are {}", commands::names().join(", ")))?;
    if asks_for_help {
        eprint!("{}", commands::help_of(command));
        return Ok(true);
    }
    let keep_going = options.flag("--keep-going");
    let shell = Shell::new().map_err(|error| error.to_string())?;
    let workspace = Workspace::open(&shell)?;
    shell.change_dir(&workspace.root);
    let steps = (command.prepare)(&shell, &workspace, &mut options)?;
    options.finish()?;
    Ok(step::run_all(steps, keep_going))
}
