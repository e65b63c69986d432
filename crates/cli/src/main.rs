//! The program `piola`.
//!
//! Results go to standard output; progress, notes and errors to standard error. Exit codes are those of [`Exit`].
#![forbid(unsafe_code)]

#[cfg(not(all(feature = "nonlinear", feature = "register", feature = "specimens")))]
mod absent;
mod arguments;
mod commands;
mod comparison;
mod fit_options;
mod fits;
mod flows;
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

fn main() -> ExitCode {
    let exit = match Arguments::parse().command {
        Command::Run(arguments) => commands::run(&arguments),
        Command::Plan(arguments) => commands::plan(&arguments),
        Command::Check(arguments) => commands::check(&arguments),
        Command::Sweep(arguments) => sweeps::sweep(&arguments),
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
