//! Scenes to break, and readers of reports.

use piola_scene::{Document, Report, Scene, SceneError, SceneFile, Study};
use piola_testkit::{Tol, assert_close};

/// A valid scene of gravitation.
pub(crate) const PAIR: &str = r#"
[gravity]
softening = 0.0

[[body]]
name = "one"
gm = "1 m^3/s^2"
position = [1.0, 0.0, 0.0]
velocity = [0.0, 0.5, 0.0]

[[body]]
name = "other"
gm = 1.0
position = [-1.0, 0.0, 0.0]
velocity = [0.0, -0.5, 0.0]

[time]
end = "10 s"
"#;

/// A valid mechanism.
pub(crate) const TOP: &str = r#"
[mechanism]

[[joint]]
name = "tip"
type = "spherical"
angles = "[0, 30, 0] deg"
rates = "[0, 0, 60] rad/s"

[[rigid_body]]
name = "top"
joint = "tip"
mass = 1.0
inertia = [0.75, 0.75, 0.25]
at = [0.0, 0.0, 0.5]

[time]
end = "1 s"
"#;

/// A valid orbit.
pub(crate) const ORBIT: &str = r#"
[central]
gm = 1.0

[[body]]
name = "comet"
semi_major_axis = 1.0
eccentricity = 0.5

[time]
revolutions = 2

[reference]
closed_form = "kepler"
"#;

/// The scene of a text that has no mistakes.
pub(crate) fn scene(text: &str) -> Scene {
    match Scene::from_document(&Document::parse("test.toml", text)) {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    }
}

/// The study of a text that has no mistakes.
pub(crate) fn study(text: &str) -> Study {
    match SceneFile::from_document(&Document::parse("test.toml", text)) {
        Ok(SceneFile::Study(study)) => study,
        Ok(SceneFile::Motion(_)) => panic!("the scene is no study"),
        Err(error) => panic!("{error}"),
    }
}

/// The report on a text that has mistakes.
pub(crate) fn report(text: &str) -> Report {
    report_with(text, &[])
}

/// The report on a text with settings.
pub(crate) fn report_with(text: &str, settings: &[&str]) -> Report {
    let mut document = Document::parse("test.toml", text);
    for setting in settings {
        document.set(setting);
    }
    match SceneFile::from_document(&document) {
        Err(SceneError::Invalid(report)) => report,
        Err(error) => panic!("{error}"),
        Ok(_) => panic!("the scene has no mistakes"),
    }
}

/// Asserts that an error, or a number that should be zero, is within a tolerance.
#[track_caller]
pub(crate) fn assert_small(what: &str, error: f64, tolerance: Tol) {
    assert_close(what, &[error], &[0.0], tolerance);
}

/// A text with one piece replaced, which must be there.
pub(crate) fn replaced(text: &str, old: &str, new: &str) -> String {
    assert!(text.contains(old), "{old} is not in the text");
    text.replacen(old, new, 1)
}

/// Line and column of the first place of a piece of text, from 1.
pub(crate) fn place(text: &str, piece: &str) -> (usize, usize) {
    let at = text.find(piece).unwrap_or_else(|| panic!("{piece} is not in the text"));
    let line = text[..at].matches('\n').count() + 1;
    (line, at - text[..at].rfind('\n').map_or(0, |newline| newline + 1) + 1)
}

/// Asserts that a text has exactly one mistake, at a piece of it, whose rendering has all the words.
pub(crate) fn assert_mistake(text: &str, piece: &str, words: &[&str]) {
    let report = report(text);
    assert_eq!(report.mistakes.len(), 1, "{report}");
    let mistake = &report.mistakes[0];
    assert_eq!((mistake.line, mistake.column), place(text, piece), "{report}");
    let shown = report.to_string();
    for word in words {
        assert!(shown.contains(word), "`{word}` is not in\n{shown}");
    }
}
