//! Tables of exact solutions on meshes, to verify finite-element programs: `cargo xtask verification --out FOLDER`.
//!
//! For each family of universal deformations and for several laws a folder with nodes, elements, faces and loads, as CSV and
//! as JSON. The README that is written beside them says what each column is.

#![expect(clippy::print_stdout, reason = "an example prints")]

mod cases;
mod mesh;
mod tables;

use std::path::PathBuf;
use std::process::ExitCode;

fn main() -> ExitCode {
    let folder = std::env::args_os().nth(1).map_or_else(|| PathBuf::from("target/verification"), PathBuf::from);
    match tables::write_all(&folder) {
        Ok(count) => {
            println!("{count} cases in {}", folder.display());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("verification: {error}");
            ExitCode::FAILURE
        }
    }
}
