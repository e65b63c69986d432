//! Every kind of bad input is answered at its place, with what was found and what would be valid.

use std::path::Path;
use std::time::{Duration, Instant};

use piola_charts::ChartsError;
use piola_document::DocumentError;
use piola_scene::model::System;
use piola_scene::output::Folder;
use piola_scene::{Scene, SceneError};

use crate::support::{ORBIT, PAIR, TOP, assert_mistake, replaced, report, scene};

#[test]
fn unknown_key_is_answered_with_the_nearest_one() {
    let text = replaced(PAIR, "softening = 0.0", "softning = 0.0");
    assert_mistake(
        &text,
        "softning",
        &["unknown key `softning` in [gravity]", "did you mean `softening`?", "post_newtonian"],
    );
}

#[test]
fn key_of_another_table_is_sent_home() {
    let text = replaced(PAIR, "softening = 0.0", "samples = 10");
    assert_mistake(&text, "samples", &["unknown key `samples`", "it belongs in [output]"]);
}

#[test]
fn wrong_unit_is_answered_with_both_dimensions() {
    let text = replaced(PAIR, "\"10 s\"", "\"10 kg\"");
    assert_mistake(
        &text,
        "\"10 kg\"",
        &["`end` is \"10 kg\"", "the dimension mass instead of time", "time, for example in s"],
    );
}

#[test]
fn unknown_unit_is_answered_with_the_nearest_one() {
    let text = replaced(PAIR, "\"10 s\"", "\"10 KM\"");
    assert_mistake(&text, "\"10 KM\"", &["`KM` is not a unit", "did you mean `km`?"]);
}

#[test]
fn negative_mass_is_refused() {
    let text = replaced(PAIR, "gm = 1.0", "mass = -5.0");
    assert_mistake(&text, "-5.0", &["`mass` is negative: the number -5", "greater than zero"]);
}

#[test]
fn impossible_inertia_is_refused_by_the_triangle_inequality() {
    let text = replaced(TOP, "[0.75, 0.75, 0.25]", "[1.0, 0.25, 0.25]");
    assert_mistake(
        &text,
        "[1.0, 0.25, 0.25]",
        &["no body has this inertia", "triangle inequality", "none exceeds the sum of the other two"],
    );
}

#[test]
fn two_bodies_in_one_place_are_shown_both() {
    let text = replaced(PAIR, "[-1.0, 0.0, 0.0]", "[1.0, -0.0, 0.0]");
    assert_mistake(
        &text,
        "[1.0, -0.0, 0.0]",
        &["`one` and `other` are in one place", "`one` is here", "softening greater than zero"],
    );
}

#[test]
fn softened_bodies_may_be_in_one_place() {
    let text = replaced(PAIR, "[-1.0, 0.0, 0.0]", "[1.0, 0.0, 0.0]");
    let scene = scene(&replaced(&text, "softening = 0.0", "softening = '1 mm'"));
    let System::Gravitation(system) = &scene.system else { panic!("{:?}", scene.system) };
    assert_eq!((system.bodies[0].position, system.softening), (system.bodies[1].position, 0.001));
}

#[test]
fn nan_and_infinity_are_refused_by_name() {
    assert_mistake(&replaced(PAIR, "gm = 1.0", "gm = nan"), "nan", &["`gm` is nan, not a number"]);
    assert_mistake(&replaced(PAIR, "gm = 1.0", "gm = inf"), "inf", &["`gm` is inf, not finite"]);
    assert_mistake(
        &replaced(PAIR, "[-1.0, 0.0, 0.0]", "[-1.0, nan, 0.0]"),
        "nan",
        &["`position` is nan, not a number"],
    );
    assert_mistake(&replaced(PAIR, "\"10 s\"", "\"nan s\""), "\"nan s\"", &["NaN is not finite"]);
    assert_mistake(&replaced(PAIR, "\"10 s\"", "\"1e999 s\""), "\"1e999 s\"", &["inf is not finite"]);
}

#[test]
fn end_at_the_start_is_refused() {
    let text = replaced(PAIR, "end = \"10 s\"", "start = '1 h'\nend = '60 min'");
    assert_mistake(&text, "'60 min'", &["the end, 3600 s, is the start", "before it for a run backwards in time"]);
}

#[test]
fn missing_reference_file_is_refused() {
    let text = format!("{PAIR}[reference]\nfile = \"nowhere.csv\"\n");
    assert_mistake(&text, "\"nowhere.csv\"", &["`nowhere.csv` cannot be read", "relative to the scene's folder"]);
}

#[test]
fn dependent_coordinates_are_named() {
    let two = "type = \"revolute\"\naxis = [0, 0, 1]\n[[joint]]\nname = \"again\"\nparent = \"tip\"\ntype = \"revolute\"\naxis = [0, 0, 2]";
    let text = replaced(TOP, "type = \"spherical\"\nangles = \"[0, 30, 0] deg\"\nrates = \"[0, 0, 60] rad/s\"", two);
    let text = replaced(&text, "joint = \"tip\"", "joint = \"again\"");
    let text = replaced(&text, "[[joint]]\nname = \"again\"", "\n[[joint]]\nname = \"again\"");
    let report = report(&text);
    assert_eq!(report.mistakes.len(), 1, "{report}");
    assert!(report.mistakes[0].found.contains("`tip`, `again` are dependent"), "{report}");
}

#[test]
fn singular_angles_at_the_start_are_dependent_coordinates() {
    let report = report(&replaced(TOP, "[0, 30, 0] deg", "[0, 0, 0] deg"));
    assert!(report.mistakes[0].found.contains("`tip.angles[0]`, `tip.angles[2]` are dependent"), "{report}");
}

#[test]
fn joint_that_moves_nothing_with_mass_is_named() {
    let text = format!("{TOP}\n[[joint]]\nname = \"idle\"\ntype = \"revolute\"\naxis = [0, 1, 0]\n");
    let report = report(&text);
    assert!(report.mistakes[0].found.contains("nothing with mass moves with `idle`"), "{report}");
}

#[test]
fn joints_in_a_cycle_are_listed() {
    let text = replaced(TOP, "type = \"spherical\"", "parent = \"second\"\ntype = \"spherical\"");
    let text = format!("{text}\n[[joint]]\nname = \"second\"\nparent = \"tip\"\ntype = \"fixed\"\n");
    let report = report(&text);
    assert_eq!(report.mistakes.len(), 1, "{report}");
    assert!(report.mistakes[0].found.contains("cycle: tip on second on tip"), "{report}");
}

#[test]
fn duplicate_names_show_both_places() {
    let report = report(&replaced(PAIR, "\"other\"", "\"one\""));
    assert_eq!(report.mistakes.len(), 1, "{report}");
    assert_eq!((report.mistakes[0].line, report.mistakes[0].column), (12, 8), "{report}");
    let shown = report.to_string();
    assert!(
        shown.contains("the name `one` is taken") && shown.contains("first here") && shown.contains("6:8"),
        "{shown}"
    );
}

#[test]
fn reference_body_that_is_not_in_the_scene_is_refused() {
    let text = format!("{PAIR}[reference]\nfile = \"test.toml\"\nrelative_to = \"sun\"\n");
    let report = report(&text);
    assert!(report.to_string().contains("cannot be read"), "{report}");
    let text = replaced(ORBIT, "closed_form = \"kepler\"", "closed_form = \"kepler\"\nrelative_to = \"sun\"");
    assert_mistake(&text, "\"sun\"", &["no body is named `sun`", "one of comet"]);
}

#[test]
fn key_of_another_type_of_joint_is_refused() {
    let text = replaced(TOP, "angles = ", "axis = [0, 0, 1]\nangles = ");
    assert_mistake(&text, "axis", &["`axis` is no key of a spherical joint", "revolute, prismatic, universal"]);
}

#[test]
fn angular_rate_without_angle_is_refused() {
    let text = replaced(TOP, "[0, 0, 60] rad/s", "[0, 0, 60] 1/s");
    assert_mistake(&text, "\"[0, 0, 60] 1/s\"", &["the dimension 1/time instead of angle/time", "rad/s"]);
}

#[test]
fn all_mistakes_are_reported_at_once_in_the_order_of_the_text() {
    let text = replaced(PAIR, "softening = 0.0", "softening = '1 kg'");
    let text = replaced(&text, "gm = 1.0", "gm = -1.0");
    let text = replaced(&text, "velocity = [0.0, 0.5, 0.0]", "speed = 3");
    let text = replaced(&text, "\"10 s\"", "true");
    let report = report(&text);
    let lines: Vec<usize> = report.mistakes.iter().map(|mistake| mistake.line).collect();
    assert_eq!(lines, [3, 5, 9, 13, 18], "{report}");
    assert!(report.to_string().ends_with("5 mistakes"), "{report}");
}

#[test]
fn syntax_errors_and_wrong_values_are_reported_together() {
    let text = replaced(PAIR, "softening = 0.0", "softening = = 0.0");
    let text = replaced(&text, "\"10 s\"", "\"10 kg\"");
    let report = report(&text);
    assert_eq!(report.mistakes[0].line, 3, "{report}");
    assert!(report.mistakes[0].found.contains("not TOML"), "{report}");
    assert!(report.mistakes.iter().any(|mistake| mistake.found.contains("10 kg")), "{report}");
}

#[test]
fn system_that_is_missing_or_twice_there_is_a_mistake() {
    let missing = report("[time]\nend = 1.0\n");
    assert!(
        missing
            .to_string()
            .contains("exactly one of [gravity], [mechanism], [central], [hamiltonian], [wavefront], [room]"),
        "{missing}"
    );
    let twice = report(&format!("{PAIR}[central]\ngm = 1.0\n"));
    assert!(twice.to_string().contains("[gravity] and [central]"), "{twice}");
}

#[test]
fn more_samples_than_memory_holds_are_refused() {
    let body = |i: u32| format!("[[body]]\nname = 'b{i}'\ngm = 1\nposition = [{i}, 0, 0]\nvelocity = [0, 0, 0]\n");
    let bodies: String = (0..6).map(body).collect();
    let text = format!("[gravity]\n{bodies}[time]\nend = 1\n[output]\nsamples = 1000000\n");
    assert_mistake(&text, "1000000", &["1000000 samples of 36 numbers", "at most 833333"]);
}

#[test]
fn empty_scene_lacks_its_parts() {
    let shown = report("").to_string();
    assert!(shown.contains("lacks [time]") && shown.contains("no system"), "{shown}");
}

/// A folder of this test's own.
fn folder(name: &str) -> std::path::PathBuf {
    let folder = std::env::temp_dir().join(format!("piola-scene-{}-{name}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{error}"));
    folder
}

#[test]
fn output_folder_that_is_a_file_is_refused_before_the_run() {
    let folder = folder("unwritable");
    let file = folder.join("file");
    std::fs::write(&file, "text").unwrap_or_else(|error| panic!("{error}"));
    let error = Folder::prepare(&file.join("results"));
    assert!(matches!(&error, Err(ChartsError::UnwritableFolder { .. })), "{error:?}");
    assert!(error.is_err_and(|error| error.to_string().contains("cannot write to the output folder")));
    let _ = std::fs::remove_dir_all(folder);
}

#[test]
fn missing_file_folder_and_bytes_that_are_no_text_are_told_apart() {
    let folder = folder("files");
    let load = |path: &Path| match Scene::load(path, &[]) {
        Err(error) => error,
        Ok(_) => panic!("{} is no scene", path.display()),
    };
    assert!(matches!(load(&folder.join("nothing.toml")), SceneError::Document(DocumentError::Unreadable { .. })));
    assert!(matches!(load(&folder), SceneError::Document(DocumentError::Folder { .. })));
    let bytes = folder.join("bytes.toml");
    std::fs::write(&bytes, b"name = 'x'\nab\xff").unwrap_or_else(|error| panic!("{error}"));
    assert!(matches!(
        load(&bytes),
        SceneError::Document(DocumentError::NotText { line: 2, column: 3, byte: 0xff, .. })
    ));
    let _ = std::fs::remove_dir_all(folder);
}

#[test]
fn ten_megabytes_of_garbage_are_refused_at_once() {
    let folder = folder("garbage");
    let path = folder.join("garbage.toml");
    std::fs::write(&path, vec![b'['; 10_000_000]).unwrap_or_else(|error| panic!("{error}"));
    let begun = Instant::now();
    let error = Scene::load(&path, &[]);
    // The file is refused by its size: parsing it would take minutes, whatever else the machine does.
    assert!(begun.elapsed() < Duration::from_secs(60));
    assert!(
        matches!(&error, Err(SceneError::Document(DocumentError::TooLarge { bytes: 10_000_000, .. }))),
        "{error:?}"
    );
    let _ = std::fs::remove_dir_all(folder);
}

#[test]
fn largest_garbage_that_is_read_is_answered_shortly() {
    let size = 4 << 20;
    let pieces = ["[", "\"", "a=", "}{ ", "x = [\n", "\u{e4}=\n", "a.b.c = 1\n", "0"];
    for piece in pieces {
        let text = piece.repeat(size / piece.len());
        let begun = Instant::now();
        let report = report(&text);
        let shown = report.to_string();
        // A quadratic reader would take hours, a linear one takes a second on a machine that does nothing else.
        assert!(begun.elapsed() < Duration::from_secs(300), "{piece:?} took {:?}", begun.elapsed());
        assert!(report.mistakes.len() <= 20 && shown.len() < 20_000, "{piece:?}: {} bytes", shown.len());
    }
}
