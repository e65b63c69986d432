//! The fuzz target of images over its corpus and over contents made from it. `fuzz/README.md` says more.

use std::path::Path;

#[path = "../../../../fuzz/bodies/images.rs"]
mod images;
#[path = "../../../../fuzz/bodies/mutation.rs"]
mod mutation;

#[test]
fn a_mutated_image_is_refused_in_words_or_has_finite_numbers() {
    let corpus = mutation::corpus(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/images"));
    let tokens = [
        "NRRD0004\n",
        "sizes: 2 2 2\n",
        "encoding: gzip\n",
        "\u{0}",
        "\u{7f}",
        "IHDR",
        "\n\n",
        "nan",
        "II*\u{0}",
        "n+1",
    ];
    let (accepted, least) = (mutation::over(&corpus, 3000, &tokens, images::run), 100);
    assert!(least <= accepted, "{accepted} accepted");
}
