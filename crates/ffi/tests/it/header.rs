//! The header agrees with the sources. With `PIOLA_HEADER=write` the test writes it: `cargo xtask header`.

use crate::programs::crate_folder;

#[test]
fn the_header_is_that_of_the_sources() {
    let folder = crate_folder();
    let config = cbindgen::Config::from_file(folder.join("cbindgen.toml")).unwrap();
    let mut builder = cbindgen::Builder::new().with_config(config);
    for file in ["status.rs", "solids.rs", "fluids.rs", "abaqus.rs", "history.rs"] {
        builder = builder.with_src(folder.join("src/c").join(file));
    }
    let mut made = Vec::new();
    builder.generate().unwrap().write(&mut made);
    let made = String::from_utf8(made).unwrap();
    // What concerns Rust alone is left out.
    let mut text = String::new();
    let mut lines = made.lines().map(str::trim_end).peekable();
    while let Some(line) = lines.next() {
        if line == "//" && lines.peek().is_some_and(|next| next.contains("# Safety")) {
            while lines.peek().is_some_and(|next| next.starts_with("//")) {
                lines.next();
            }
            continue;
        }
        text.push_str(line);
        text.push('\n');
    }
    let path = folder.join("include/piola.h");
    if std::env::var_os("PIOLA_HEADER").is_some_and(|value| value == "write") {
        std::fs::write(&path, &text).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(kept == text, "include/piola.h is not current: `cargo xtask header` writes it");
}
