//! The program `piola`. All of it is in the library of this crate, so that the program of the folder `mpi` is the same one.
#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    piola_cli::program(&piola_ensemble::OneProcess)
}
