//! The program `piola`.
//!
//! Results go to standard output; progress, notes and errors to standard error. Exit codes: 0 done, 1 failed or interrupted, 2 not valid.
#![forbid(unsafe_code)]

#[cfg(not(all(feature = "nonlinear", feature = "register", feature = "specimens")))]
mod absent;
mod arguments;
mod commands;
mod comparison;
mod explain;
mod fit_options;
mod fits;
mod flows;
mod help;
#[cfg(feature = "history")]
mod histories;
#[cfg(not(feature = "history"))]
#[path = "histories/absent.rs"]
mod histories;
mod html;
mod interrupt;
mod intervals;
#[cfg(feature = "nonlinear")]
mod nonlinear;
#[cfg(not(feature = "nonlinear"))]
#[path = "nonlinear/absent.rs"]
mod nonlinear;
mod progress;
#[cfg(feature = "register")]
mod register;
#[cfg(not(feature = "register"))]
#[path = "register/absent.rs"]
mod register;
mod report;
mod shell;
#[cfg(feature = "specimens")]
mod specimens;
#[cfg(not(feature = "specimens"))]
#[path = "specimens/absent.rs"]
mod specimens;
mod spectra;
mod sweeps;

use std::process::ExitCode;

use clap::{CommandFactory as _, Parser as _};
use piola_ensemble::Ranks;

use arguments::{Arguments, Command};

/// How the program ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Exit {
    /// 0: the command succeeded.
    Done,
    /// 1: the run failed or was interrupted, or a result could not be written. Partial results are written.
    Failed,
    /// 2: the arguments, the scene or the output folder are not valid. Nothing was run.
    Invalid,
}

/// Runs the program with the arguments of the command line, on the processes of one run or on one alone.
///
/// Only `sweep` uses several processes; every other command refuses them.
#[must_use]
pub fn program(ranks: &dyn Ranks) -> ExitCode {
    let command = match Arguments::try_parse() {
        Ok(arguments) => arguments.command,
        Err(error) => {
            if ranks.rank() == 0 && help::print(&error).is_err() {
                return ExitCode::from(1);
            }
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    if 1 < ranks.count() && !matches!(command, Command::Sweep(_)) {
        if ranks.rank() == 0 {
            let count = ranks.count();
            commands::note(&format!("error: {count} processes were started; only `sweep` takes more than one"));
        }
        return ExitCode::from(2);
    }
    let exit = match command {
        Command::Run(arguments) => commands::run(&arguments),
        Command::Plan(arguments) => commands::plan(&arguments),
        Command::Check(arguments) => commands::check(&arguments),
        Command::Sweep(arguments) => sweeps::sweep(&arguments, ranks),
        Command::Fit(arguments) => fits::fit(&arguments),
        Command::Recover(arguments) => flows::recover(&arguments),
        Command::FitFlow(arguments) => flows::fit(&arguments),
        Command::Flow(arguments) => flows::solve(&arguments),
        Command::Spectrum(arguments) => spectra::find(&arguments),
        Command::Nonlinear(arguments) => nonlinear::fit(&arguments),
        Command::Specimen(arguments) => specimens::load(&arguments),
        Command::Register(arguments) => register::register(&arguments),
        Command::Schema(arguments) => commands::schema(&arguments),
        Command::Completions(arguments) => shell::completions(&arguments, Arguments::command()),
        Command::Manual(arguments) => shell::manual(&arguments, Arguments::command()),
    };
    match commands::whole(exit) {
        Exit::Done => ExitCode::SUCCESS,
        Exit::Failed => ExitCode::from(1),
        Exit::Invalid => ExitCode::from(2),
    }
}
