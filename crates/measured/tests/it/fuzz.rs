//! The fuzz target of tables over its corpus and over texts made from it. `fuzz/README.md` says more.

use std::path::Path;

#[path = "../../../../fuzz/bodies/csv.rs"]
mod csv;
#[path = "../../../../fuzz/bodies/mutation.rs"]
mod mutation;

#[test]
fn a_mutated_table_is_refused_in_words_or_read() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let layouts = mutation::corpus(&root.join("data/layouts"));
    let corpus: Vec<_> = mutation::corpus(&root.join("fuzz/corpus/csv")).into_iter().chain(layouts).collect();
    let tokens =
        [",", ";", "\t", "\n", "\"", "# radius: 1 mm\n", "sep=;\n", "1,5", "[Pa]", "\u{feff}", "stretch", "stress"];
    let (accepted, least) = (mutation::over(&corpus, 3000, &tokens, csv::run), 20);
    assert!(least <= accepted, "{accepted} accepted");
}
