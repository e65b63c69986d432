//! `--set path=value`: what it changes, and mistakes shown in the argument.

use piola_scene::{Document, Scene};

use crate::support::{PAIR, report_with};

fn with(settings: &[&str]) -> Scene {
    let mut document = Document::parse("test.toml", PAIR);
    for setting in settings {
        document.set(setting);
    }
    match Scene::from_document(&document) {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn values_are_toml_or_else_texts() {
    assert!((with(&["time.end=2 min"]).time.end - 120.0).abs() <= 0.0);
    assert!((with(&["time.end = \"2 min\""]).time.end - 120.0).abs() <= 0.0);
    assert!((with(&["time.end=120"]).time.end - 120.0).abs() <= 0.0);
    assert_eq!(with(&["integrator.method=composition-6"]).integrator.method, "composition-6");
}

#[test]
fn entries_of_lists_are_named_by_place_or_name() {
    let position = |scene: &Scene| match &scene.system {
        piola_scene::model::System::Gravitation(system) => system.bodies[1].position,
        _ => [f64::NAN; 3],
    };
    assert_eq!(
        position(&with(&["body[1].position=[0, 1, 0] km"])).map(f64::to_bits),
        [0.0, 1e3, 0.0].map(f64::to_bits)
    );
    assert_eq!(position(&with(&["body.other.position[2]=7"])).map(f64::to_bits), [-1.0, 0.0, 7.0].map(f64::to_bits));
}

#[test]
fn later_settings_win() {
    assert!((with(&["time.end=1", "time.end=2"]).time.end - 2.0).abs() <= 0.0);
}

#[test]
fn mistakes_point_at_the_argument() {
    let cases: [(&str, usize, &[&str]); 8] = [
        ("time.end=5 kg", 10, &["mass instead of time"]),
        ("body.sun.gm=1", 6, &["no entry of the list is named `sun`", "one, other"]),
        ("body[7].gm=1", 5, &["entry 7 of a list of 2", "0 to 1"]),
        ("time", 1, &["a setting without `=`"]),
        ("time.end=", 1, &["a setting without a value"]),
        ("time.end.more=1", 10, &["the path goes on"]),
        ("tme.end=1", 1, &["unknown key `tme`", "did you mean `time`"]),
        ("gravity.softness=1", 9, &["unknown key `softness` in [gravity]"]),
    ];
    for (setting, column, words) in cases {
        let report = report_with(PAIR, &[setting]);
        let mistake = &report.mistakes[0];
        assert_eq!((mistake.source.as_str(), mistake.line, mistake.column), ("--set", 1, column), "{report}");
        for word in words {
            assert!(report.to_string().contains(word), "`{word}` is not in\n{report}");
        }
    }
}
