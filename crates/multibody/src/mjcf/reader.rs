//! What is read of a file so far.

use std::collections::HashSet;

use super::MjcfOptions;
use super::element::Classes;
use super::place::Place;
use super::settings::Settings;
use crate::files::{Element, Visual};
use crate::loops::BodyPoint;
use crate::tree::{BodyIndex, FrameIndex, RigidTreeBuilder};

/// A body that was attached, and where the file places it.
pub(super) struct Placed {
    pub(super) name: String,
    pub(super) index: BodyIndex,
    /// In space, in the configuration of the file.
    pub(super) place: Place,
}

/// What is read so far.
pub(super) struct Reader<'a> {
    pub(super) options: MjcfOptions,
    pub(super) settings: Settings,
    pub(super) classes: Classes<'a>,
    pub(super) builder: RigidTreeBuilder,
    /// The ground is the first.
    pub(super) bodies: Vec<Placed>,
    pub(super) sites: Sites,
    pub(super) home: Vec<f64>,
    pub(super) visuals: Vec<Visual>,
    pub(super) skipped: Vec<Element<'a>>,
    pub(super) names: Names,
    /// Names and files of meshes.
    pub(super) meshes: Vec<(String, String)>,
}

/// The names of a file, and those that were made up for what has none.
pub(super) struct Names(HashSet<String>);

impl Names {
    pub(super) fn of(root: Element<'_>) -> Self {
        Self(root.descendants().filter_map(|element| element.attribute("name")).map(str::to_owned).collect())
    }

    /// A name that nothing has yet: the one given, or that with a number behind it.
    pub(super) fn invent(&mut self, name: &str) -> String {
        let mut invented = name.to_owned();
        let mut count = 1;
        while !self.0.insert(invented.clone()) {
            count += 1;
            invented = format!("{name} ({count})");
        }
        invented
    }
}

/// The named sites.
#[derive(Default)]
pub(super) struct Sites {
    pub(super) sites: Vec<(String, BodyPoint, FrameIndex)>,
}

impl Sites {
    pub(super) fn add(&mut self, name: &str, body: BodyIndex, frame: FrameIndex, at: [f64; 3]) {
        self.sites.push((name.to_owned(), BodyPoint::new(body, at), frame));
    }
}
