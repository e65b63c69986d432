//! A reader of figures: what is drawn, in coordinates of the drawing.

use std::path::PathBuf;

use piola_scene::output::{self, Folder, Summary};
use piola_scene::studies::{self, StudyPlan, StudyRun};
use piola_scene::{Plan, run};
use piola_testkit::svg::{Element, elements};

use crate::support::{scene, study};

/// Coordinates of the drawing in a pixel.
pub(crate) const FINE: f64 = 8.0;

/// A figure.
pub(crate) struct Svg(Vec<Element>);

impl Svg {
    fn of(text: &str) -> Self {
        Self(elements(text))
    }

    /// All elements of a kind.
    pub(crate) fn all<'s>(&'s self, tag: &'s str) -> impl Iterator<Item = &'s Element> {
        self.0.iter().filter(move |element| element.tag() == tag)
    }

    /// The points of all curves of a colour and a width in pixels.
    pub(crate) fn curves(&self, stroke: &str, width: f64) -> Vec<Vec<[f64; 2]>> {
        let is_such = |line: &&Element| {
            line.get("stroke") == stroke && (line.number::<f64>("stroke-width") - width * FINE).abs() < 0.5
        };
        self.all("polyline").filter(is_such).map(Element::points).collect()
    }
}

/// The least and the largest of some numbers.
pub(crate) fn extent(numbers: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    numbers.into_iter().fold(start, |[low, high], x| [low.min(x), high.max(x)])
}

fn folder(name: &str) -> (PathBuf, Folder) {
    let number = std::thread::current().id();
    let path = std::env::temp_dir().join(format!("piola-svg-{}-{number:?}-{name}", std::process::id()));
    let folder = Folder::prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    (path, folder)
}

fn read(path: PathBuf, name: &str) -> Svg {
    let text = std::fs::read_to_string(path.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    std::fs::remove_dir_all(path).unwrap_or_else(|error| panic!("{error}"));
    assert!(!text.contains("could not be drawn") && !text.contains("NaN") && !text.contains("inf"), "{name}");
    Svg::of(&text)
}

/// The figure of the paths of a motion.
pub(crate) fn trajectory(text: &str) -> Svg {
    let (path, folder) = folder("trajectory");
    let scene = scene(text);
    let plan = Plan::of(&scene);
    let run = run::run(&scene, &plan, |_| core::ops::ControlFlow::Continue(()));
    let written = output::write(&folder, &scene, &plan, &run, &Summary::of(&scene, &plan, &run));
    assert!(written.failures.is_empty(), "{written:?}");
    read(path, "trajectory.svg")
}

/// A study with a figure of its.
pub(crate) fn figure(text: &str, name: &str) -> (StudyRun, Svg) {
    let (path, folder) = folder(name);
    let study = study(text);
    let run = studies::run(&study, |_| core::ops::ControlFlow::Continue(()));
    let written = run.write(&folder, &study, &StudyPlan::of(&study));
    assert!(written.failures.is_empty(), "{written:?}");
    (run, read(path, name))
}
