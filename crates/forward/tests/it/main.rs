//! Tests of flows and specimens that are named in text.

mod flows;
#[cfg(feature = "specimens")]
mod solids;
#[cfg(feature = "specimens")]
mod specimens;

use piola_charts::{Folder, Written};

/// The text of files that `write` leaves in a folder.
fn written<const N: usize>(name: &str, files: [&str; N], write: impl Fn(&Folder) -> Written) -> [String; N] {
    let path = std::env::temp_dir().join(format!("piola-forward-{name}-{}", std::process::id()));
    let folder = Folder::prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    let written = write(&folder);
    assert!(written.failures.is_empty(), "{:?}", written.failures);
    let texts = files.map(|file| std::fs::read_to_string(path.join(file)).unwrap_or_else(|error| panic!("{error}")));
    let _ = std::fs::remove_dir_all(path);
    texts
}
