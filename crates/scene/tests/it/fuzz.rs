//! The fuzz targets of scenes, units and robots over their corpus and over texts made from it. `fuzz/README.md` says more.

use std::path::Path;

use piola_testkit::repository;

#[path = "../../../../fuzz/bodies/mutation.rs"]
mod mutation;
#[path = "../../../../fuzz/bodies/scene.rs"]
mod scene;
#[path = "../../../../fuzz/bodies/units.rs"]
mod units;
#[cfg(feature = "robots")]
#[path = "../../../../fuzz/bodies/urdf.rs"]
mod urdf;

fn corpus(name: &str) -> Vec<Vec<u8>> {
    mutation::corpus(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(name))
}

#[test]
fn a_mutated_scene_is_refused_at_a_place_or_planned() {
    let shipped = repository::scenes();
    let shipped = shipped.into_iter().filter_map(|path| std::fs::read(path).ok());
    let corpus: Vec<_> = corpus("scene").into_iter().chain(shipped).collect();
    let tokens =
        ["[[body]]\n", "[[joint]]\n", "mass = 1\n", "'", "[", "type = 'fixed'\n", "1e308 m", "\u{0}", "parent = 'a'\n"];
    let (accepted, least) = (mutation::over(&corpus, 1000, &tokens, scene::run), 10);
    assert!(least <= accepted, "{accepted} accepted");
}

#[test]
fn a_mutated_quantity_or_expression_is_refused_or_has_finite_numbers() {
    let tokens =
        ["m", "kg", "/", " ", "^", "²", "(", ")", "[", "]", "rate(x)", "x", "k", "e308", "*", "-", ",", "pi", "atan2("];
    let (accepted, least) = (mutation::over(&corpus("units"), 20_000, &tokens, units::run), 10);
    assert!(least <= accepted, "{accepted} accepted");
}

#[cfg(feature = "robots")]
#[test]
fn a_mutated_robot_is_refused_or_is_a_tree() {
    let tokens = ["<link name=\"a\"/>", "<joint", "</joint>", "\"", "<mimic joint=\"x\"/>", "nan", "1e308", "-1"];
    let (accepted, least) = (mutation::over(&corpus("urdf"), 3000, &tokens, urdf::run), 10);
    assert!(least <= accepted, "{accepted} accepted");
}
