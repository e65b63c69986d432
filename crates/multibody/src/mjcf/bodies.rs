//! The bodies of a file, one after the other.

use super::element::{Classes, Styled, unsupported};
use super::equality::ties;
use super::geoms::{Geom, inertial, together};
use super::joints::series;
use super::place::Place;
use super::reader::{Names, Placed, Reader, Sites};
use super::settings::{FromGeoms, Settings};
use super::{Mjcf, MjcfOptions, SkippedElement};
use crate::error::{FileFault, MultibodyError};
use crate::files::{Element, elements, fault};
use crate::tree::{BodyIndex, BodyInertia, RigidTree};

/// Sections that move nothing.
const SECTIONS: [&str; 6] = ["size", "visual", "statistic", "custom", "sensor", "keyframe"];

/// Of a mesh: its file, and what only pictures and masses need.
const MESH: [&str; 17] = [
    "name",
    "class",
    "content_type",
    "file",
    "scale",
    "refpos",
    "refquat",
    "inertia",
    "smoothnormal",
    "maxhullvert",
    "octreemaxdepth",
    "vertex",
    "normal",
    "texcoord",
    "face",
    "material",
    "user",
];
/// Of a site: its place, and what only pictures need.
const SITE: [&str; 15] = [
    "name",
    "class",
    "pos",
    "quat",
    "axisangle",
    "xyaxes",
    "zaxis",
    "euler",
    "fromto",
    "type",
    "group",
    "size",
    "material",
    "rgba",
    "user",
];

/// An element of a body, in the frames around it.
struct Part<'a> {
    element: Element<'a>,
    frame: Place,
    class: Option<&'a str>,
}

/// A body to be attached to a parent.
struct Pending<'a> {
    part: Part<'a>,
    parent: usize,
}

pub(super) fn parse(root: Element<'_>, options: MjcfOptions) -> Result<Mjcf, MultibodyError> {
    if root.tag_name().name() != "mujoco" {
        return Err(unsupported(root));
    }
    Styled::plain(root).check(&["model"])?;
    let ground = Placed { name: "world".to_owned(), index: BodyIndex::GROUND, place: Place::identity() };
    let mut reader = Reader {
        options,
        settings: Settings::default(),
        classes: Classes::default(),
        builder: RigidTree::builder(),
        bodies: vec![ground],
        sites: Sites::default(),
        home: Vec::new(),
        visuals: Vec::new(),
        skipped: Vec::new(),
        names: Names::of(root),
        meshes: Vec::new(),
    };
    let (mut worlds, mut equalities, mut actuators) = (Vec::new(), Vec::new(), Vec::new());
    for section in elements(root) {
        match section.tag_name().name() {
            "compiler" => reader.settings.compiler(section)?,
            "option" => reader.settings.option(section)?,
            "default" => reader.classes.add(section)?,
            "asset" => reader.assets(section)?,
            "worldbody" => worlds.push(section),
            "equality" => equalities.push(section),
            "actuator" => actuators.push(section),
            "contact" => reader.contact(section)?,
            name if SECTIONS.contains(&name) => reader.skipped.push(section),
            _ => return Err(unsupported(section)),
        }
    }
    for world in worlds {
        reader.world(world)?;
    }
    let name = root.attribute("model").unwrap_or_default().to_owned();
    let gravity = reader.settings.gravity;
    let ties = ties(&mut reader, &equalities, &actuators)?;
    let Reader { builder, home, visuals, skipped, .. } = reader;
    let tree = builder.with_gravity(gravity)?.build()?;
    let (closures, motors) = ties.on(&tree, &home)?;
    Ok(Mjcf { name, tree, home, closures, motors, visuals, skipped: with_lines(skipped) })
}

/// Elements with their lines, which one pass over the text counts.
fn with_lines(mut elements: Vec<Element<'_>>) -> Vec<SkippedElement> {
    elements.sort_by_key(|element| element.range().start);
    let (mut line, mut counted) = (1, 0);
    elements
        .into_iter()
        .map(|element| {
            let start = element.range().start;
            line += element.document().input_text()[counted..start].matches('\n').count();
            counted = start;
            SkippedElement { line, element: element.tag_name().name().to_owned() }
        })
        .collect()
}

impl<'a> Reader<'a> {
    fn assets(&mut self, section: Element<'a>) -> Result<(), MultibodyError> {
        for asset in elements(section) {
            if asset.tag_name().name() != "mesh" {
                self.skipped.push(asset);
                continue;
            }
            Styled::plain(asset).check(&MESH)?;
            let file = asset.attribute("file").unwrap_or_default();
            let stem = std::path::Path::new(file).file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
            self.meshes.push((asset.attribute("name").unwrap_or(stem).to_owned(), file.to_owned()));
        }
        Ok(())
    }

    /// `exclude` has no effect, because contact is not modelled.
    fn contact(&mut self, section: Element<'a>) -> Result<(), MultibodyError> {
        for element in elements(section) {
            match element.tag_name().name() {
                "exclude" => self.skipped.push(element),
                _ => return Err(unsupported(element)),
            }
        }
        Ok(())
    }

    /// Attaches all bodies, parents before children and in the order of the file. Files nest as deep as chains are long, so that
    /// the bodies wait on a stack.
    fn world(&mut self, world: Element<'a>) -> Result<(), MultibodyError> {
        let mut stack = Vec::new();
        Styled::plain(world).check(&[])?;
        let parts = self.parts(world, None)?;
        self.sites_of(0, &parts)?;
        for part in parts {
            match part.element.tag_name().name() {
                "body" => stack.push(Pending { part, parent: 0 }),
                "geom" => {
                    let styled = self.classes.styled(part.element, part.class, &["geom"])?;
                    Geom::read(&self.settings, &styled, &part.frame)?;
                }
                "site" => {}
                "camera" | "light" => self.skipped.push(part.element),
                _ => return Err(unsupported(part.element)),
            }
        }
        stack.reverse();
        while let Some(pending) = stack.pop() {
            let first = stack.len();
            self.body(&pending, &mut stack)?;
            stack[first..].reverse();
        }
        Ok(())
    }

    /// The elements in a body or in the ground, those in frames too.
    fn parts(&self, of: Element<'a>, class: Option<&'a str>) -> Result<Vec<Part<'a>>, MultibodyError> {
        let mut out = Vec::new();
        let part = |frame: Place, class: Option<&'a str>| move |element| Part { element, frame, class };
        let mut stack: Vec<_> = elements(of).rev().map(part(Place::identity(), class)).collect();
        while let Some(next) = stack.pop() {
            if next.element.tag_name().name() != "frame" {
                out.push(next);
                continue;
            }
            let frame = Styled::plain(next.element);
            frame.check(&["name", "childclass", "pos", "quat", "axisangle", "euler", "xyaxes", "zaxis"])?;
            let place = next.frame.then(&self.settings.place(&frame)?);
            let class = next.element.attribute("childclass").or(next.class);
            stack.extend(elements(next.element).rev().map(part(place, class)));
        }
        Ok(out)
    }

    fn body(&mut self, pending: &Pending<'a>, stack: &mut Vec<Pending<'a>>) -> Result<(), MultibodyError> {
        let Pending { part, parent } = pending;
        let body = Styled::plain(part.element);
        body.check(&[
            "name",
            "childclass",
            "pos",
            "quat",
            "axisangle",
            "xyaxes",
            "zaxis",
            "euler",
            "mocap",
            "gravcomp",
            "sleep",
            "user",
        ])?;
        body.check_idle(&[("mocap", &["false"]), ("gravcomp", &["0"])])?;
        let number = self.bodies.len();
        let invented = || self.names.invent(&format!("body {number}"));
        let name = part.element.attribute("name").map_or_else(invented, str::to_owned);
        let class = part.element.attribute("childclass").or(part.class);
        let place = part.frame.then(&self.settings.place(&body)?);
        let parts = self.parts(part.element, class)?;
        let (mut joints, mut geoms, mut given) = (Vec::new(), Vec::new(), None);
        for part in &parts {
            let styled = |kind| self.classes.styled(part.element, part.class, &[kind]);
            match part.element.tag_name().name() {
                "joint" => joints.push((styled("joint")?, part.frame)),
                "freejoint" => joints.push((Styled::plain(part.element), part.frame)),
                "geom" => geoms.push(Geom::read(&self.settings, &styled("geom")?, &part.frame)?),
                "inertial" => given = Some(Styled::plain(part.element)),
                "body" | "site" => {}
                "camera" | "light" => self.skipped.push(part.element),
                _ => return Err(unsupported(part.element)),
            }
        }
        let is_any_weighed = geoms.iter().any(|geom| geom.is_weighed);
        let inertia = match (&given, self.settings.from_geoms) {
            (Some(_), FromGeoms::Always) if is_any_weighed => together(&body, &name, &geoms)?,
            (Some(given), _) => inertial(&self.settings, given, &name, self.options.inertias)?,
            (None, FromGeoms::Auto | FromGeoms::Always) => together(&body, &name, &geoms)?,
            (None, FromGeoms::Never) => BodyInertia::MASSLESS,
        };
        let series = series(&self.settings, &mut self.names, &name, &place, *parent == 0, &joints)?;
        self.home.extend(series.home);
        let index = self
            .builder
            .attach_in_series(self.bodies[*parent].index, series.joints, name.clone(), inertia)
            .map_err(|source| fault(part.element, FileFault::Invalid { source: Box::new(source) }))?;
        let meshes = &self.meshes;
        let file = |mesh: &str| {
            meshes.iter().find(|(name, _)| name == mesh).map_or_else(|| mesh.to_owned(), |(_, file)| file.clone())
        };
        for geom in &geoms {
            geom.add_visuals(&name, file, &mut self.visuals);
        }
        let place = self.bodies[*parent].place.then(&place);
        self.bodies.push(Placed { name, index, place });
        self.sites_of(number, &parts)?;
        stack.extend(
            parts
                .into_iter()
                .filter(|part| part.element.tag_name().name() == "body")
                .map(|part| Pending { part, parent: number }),
        );
        Ok(())
    }

    /// Frames for the named sites of a body.
    fn sites_of(&mut self, body: usize, parts: &[Part<'a>]) -> Result<(), MultibodyError> {
        for part in parts.iter().filter(|part| part.element.tag_name().name() == "site") {
            let styled = self.classes.styled(part.element, part.class, &["site"])?;
            styled.check(&SITE)?;
            let Some(name) = part.element.attribute("name") else { continue };
            let place = match styled.numbers("fromto")? {
                None => self.settings.place(&styled)?,
                Some([a, b, c, d, e, f]) => {
                    let along = [a - d, b - e, c - f];
                    let attitude = super::place::turn_of_z(along);
                    Place { origin: [0.5 * (a + d), 0.5 * (b + e), 0.5 * (c + f)], attitude }
                }
            };
            let place = part.frame.then(&place);
            let index = self.bodies[body].index;
            let frame = self
                .builder
                .add_frame(index, name, place.origin, place.attitude)
                .map_err(|source| fault(part.element, FileFault::Invalid { source: Box::new(source) }))?;
            self.sites.add(name, index, frame, place.origin);
        }
        Ok(())
    }
}
