//! Compilers of other languages, where a machine has them, and the programs that they make of this library.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Whether a compiler is there; says so where it is not.
pub(crate) fn has(compiler: &str) -> bool {
    let found = Command::new(compiler).arg("--version").output().is_ok_and(|output| output.status.success());
    if !found {
        eprintln!("skipped: there is no `{compiler}` on this machine");
    }
    found
}

/// The folder of the crate.
pub(crate) fn crate_folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The static library that cargo built with this test, beside it.
fn library() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let folder = test.parent().unwrap();
    let newest = |path: &Path| path.metadata().and_then(|data| data.modified()).ok();
    let is_library = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        name.starts_with("libpiola_ffi") && path.extension().is_some_and(|extension| extension == "a")
    };
    let files = std::fs::read_dir(folder).unwrap().flatten().map(|entry| entry.path()).filter(is_library);
    files.max_by_key(|path| newest(path)).expect("cargo builds the static library beside the tests")
}

/// Compiles sources with the library and returns the program.
pub(crate) fn compiled(compiler: &str, name: &str, arguments: &[&str], sources: &[PathBuf]) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).unwrap();
    let program = folder.join("program");
    let output = Command::new(compiler)
        .current_dir(&folder)
        .args(arguments)
        .args(sources)
        .arg(library())
        .args(["-lpthread", "-ldl", "-lm", "-o"])
        .arg(&program)
        .output()
        .unwrap();
    assert!(output.status.success(), "{compiler}: {}", String::from_utf8_lossy(&output.stderr));
    program
}

/// Runs a program and returns what it printed.
pub(crate) fn printed(program: &Path, environment: &[(&str, &Path)]) -> String {
    let mut command = Command::new(program);
    for (name, value) in environment {
        command.env(name, value);
    }
    let output = command.output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{text}{}", String::from_utf8_lossy(&output.stderr));
    text
}
