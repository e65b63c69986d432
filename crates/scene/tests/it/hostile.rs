//! Every value of every scene of the repository replaced by absurd ones: a scene is refused at a place or planned, and a motion
//! that is accepted starts or says why not. Nothing panics.

use std::panic::{AssertUnwindSafe, catch_unwind};

use piola_scene::studies::StudyPlan;
use piola_scene::{Document, Plan, SceneError, SceneFile, run};
use piola_testkit::repository;

/// Values of the wrong size, sign, kind, unit or length; texts with terminal escapes, and paths outside the folder.
const VALUES: [&str; 24] = [
    "0",
    "-1",
    "1e308",
    "-1e308",
    "5e-324",
    "nan",
    "-inf",
    "9223372036854775807",
    "true",
    "1979-05-27T07:32:00Z",
    "[]",
    "[1]",
    "[1e308, -1e308, 1e308]",
    "[[1, 2], [3]]",
    "{}",
    "{ a = 1 }",
    "''",
    "'1e300 m'",
    "'-1 kg'",
    "'1 furlong'",
    "'((((((((((1'",
    "'../../../../etc/hostname'",
    "\"\\u001b[31m\\u0000\\u202e\"",
    "'name with \u{1d4d5} and `backquotes`'",
];

/// A scene that is accepted is tried once in so many times: a trial takes some hundredths of a second.
const TRIED: usize = 20;

/// The texts of the scenes, each with its folder; none where the package stands alone.
fn scenes() -> Vec<(String, String)> {
    repository::scenes()
        .into_iter()
        .filter_map(|path| Some((path.to_str()?.to_owned(), std::fs::read_to_string(&path).ok()?)))
        .collect()
}

/// The text with the value of each line replaced by one of the absurd ones, or with the line twice.
fn broken(text: &str) -> impl Iterator<Item = String> {
    let lines: Vec<String> = text.lines().map(str::to_owned).collect();
    (0..lines.len()).flat_map(move |number| {
        let lines = lines.clone();
        let key = lines[number].split_once(" = ").map(|(key, _)| key.to_owned());
        let with = move |line: String| {
            let mut lines = lines.clone();
            lines[number] = line;
            lines.join("\n")
        };
        let key = key.filter(|key| !key.starts_with('#'));
        let twice = key.clone().map(|key| format!("{key} = 1\n{key} = 2"));
        let replaced = key.into_iter().flat_map(|key| VALUES.map(|value| format!("{key} = {value}")));
        replaced.chain(twice).map(with)
    })
}

/// How often scenes were refused, planned and tried.
#[derive(Default)]
struct Counts {
    refused: usize,
    planned: usize,
    tried: usize,
}

fn attempt(path: &str, text: &str, counts: &mut Counts) {
    match SceneFile::from_document(&Document::parse(path, text)) {
        Err(SceneError::Invalid(report)) => {
            assert!(!report.mistakes.is_empty());
            assert!(report.mistakes.iter().all(|mistake| 0 < mistake.line && 0 < mistake.column), "{report}");
            counts.refused += 1;
        }
        Err(error) => panic!("{error}"),
        Ok(SceneFile::Study(study)) => {
            assert!(!StudyPlan::of(&study).to_string().is_empty());
            counts.planned += 1;
        }
        Ok(SceneFile::Motion(scene)) => {
            let plan = Plan::of(&scene);
            assert!(!plan.to_string().is_empty());
            counts.planned += 1;
            if counts.planned.is_multiple_of(TRIED) {
                match run::trial(&scene, &plan) {
                    Ok(cost) => assert!(0.0 <= cost.seconds, "{cost}"),
                    Err(why) => assert!(!why.is_empty()),
                }
                counts.tried += 1;
            }
        }
    }
}

#[test]
fn absurd_values_of_every_key_are_refused_at_a_place_or_planned() {
    let mut counts = Counts::default();
    let mut broke = Vec::new();
    let scenes = scenes();
    for (path, text) in &scenes {
        for text in broken(text) {
            let attempted = catch_unwind(AssertUnwindSafe(|| attempt(path, &text, &mut counts)));
            if attempted.is_err() {
                let lines =
                    text.lines().filter(|line| VALUES.iter().any(|value| line.ends_with(&format!("= {value}"))));
                broke.push(format!("{path}: {}", lines.collect::<Vec<_>>().join(", ")));
            }
        }
    }
    assert!(broke.is_empty(), "these broke, for the reasons above:\n{}", broke.join("\n"));
    let Counts { refused, planned, tried } = counts;
    assert!(
        scenes.is_empty() || (550 <= refused && 50 <= planned && 2 <= tried),
        "{refused} refused, {planned} planned, {tried} tried"
    );
}
