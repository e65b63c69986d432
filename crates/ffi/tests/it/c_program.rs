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
    assert!(text.ends_with("all 18 checks passed\n"), "{text}");
}
