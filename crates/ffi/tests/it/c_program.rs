//! A program in C links the static library, includes the header and gets the right numbers.

use crate::programs::{compiled, crate_folder, has, printed};

#[test]
fn a_program_in_c_gets_stresses_tangents_flows_and_messages() {
    if !has("cc") {
        return;
    }
    let folder = crate_folder();
    let include = format!("-I{}", folder.join("include").display());
    let flags = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-pedantic", &include];
    let program = compiled("cc", "c", &flags, &[folder.join("tests/c/program.c")]);
    let text = printed(&program, &[]);
    assert!(text.ends_with("all 19 checks passed\n"), "{text}");
}

#[cfg(feature = "history")]
#[test]
fn a_program_in_c_advances_laws_with_history() {
    if !has("cc") {
        return;
    }
    let folder = crate_folder();
    let include = format!("-I{}", folder.join("include").display());
    let flags = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-pedantic", &include];
    let program = compiled("cc", "c_history", &flags, &[folder.join("tests/c/history.c")]);
    let text = printed(&program, &[]);
    assert!(text.ends_with("all 15 checks passed\n"), "{text}");
}

#[test]
fn the_program_of_the_guide_prints_what_it_says() {
    if !has("cc") {
        return;
    }
    let folder = crate_folder();
    let guide = std::fs::read_to_string(folder.join("../../docs/how-to/other-languages.md")).unwrap();
    let text = guide.split("```c\n").find(|block| block.contains("int main")).unwrap();
    let source = std::path::PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("example.c");
    std::fs::write(&source, text.split("```").next().unwrap()).unwrap();
    let include = format!("-I{}", folder.join("include").display());
    let program = compiled("cc", "guide", &["-Wall", "-Werror", &include], &[source]);
    assert_eq!(printed(&program, &[]), "T12 = 502513 Pa\n");
}
