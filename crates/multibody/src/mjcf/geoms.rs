//! Geoms: what they weigh and what they look like.

use nalgebra::{Matrix3, Vector3};
use piola_kinematics::{Attitude, Inertia, Solid};

use super::element::Styled;
use super::place::{Place, turn_of_z};
use super::settings::Settings;
use crate::error::{FileFault, MultibodyError};
use crate::files::{Element, FileInertias, Visual, VisualShape, fault, invalid_inertia, turned};
use crate::spatial::{dot, scaled, sub};
use crate::tree::BodyInertia;

/// Attributes that say where a geom is, what it is and what it weighs.
const READ: [&str; 17] = [
    "name",
    "class",
    "type",
    "group",
    "size",
    "mass",
    "density",
    "shellinertia",
    "fromto",
    "pos",
    "quat",
    "axisangle",
    "xyaxes",
    "zaxis",
    "euler",
    "mesh",
    "hfield",
];
/// Attributes of contact, fluids and pictures.
const IDLE: [&str; 19] = [
    "contype",
    "conaffinity",
    "condim",
    "priority",
    "material",
    "friction",
    "solmix",
    "solref",
    "solimp",
    "margin",
    "gap",
    "surfacevel",
    "adhesion",
    "fitscale",
    "rgba",
    "castshadow",
    "fluidshape",
    "fluidcoef",
    "user",
];

/// A shape in its frame.
enum Shape {
    Solid(Solid),
    /// A plane or a field of heights: it belongs to what does not move, and weighs nothing.
    Surface,
    /// A mesh with the name of its asset.
    Mesh(String),
}

/// A geom as a part of its body.
pub(super) struct Geom<'a> {
    element: Element<'a>,
    place: Place,
    shape: Shape,
    /// Mass, kg; nothing for a mesh whose mass follows from its density.
    mass: Option<f64>,
    /// Whether its group is among those that have mass.
    pub(super) is_weighed: bool,
}

impl<'a> Geom<'a> {
    pub(super) fn read(settings: &Settings, geom: &Styled<'a>, frame: &Place) -> Result<Self, MultibodyError> {
        geom.check(&[&READ[..], &IDLE].concat())?;
        geom.check_idle(&[("shellinertia", &["false"])])?;
        let mut place = settings.place(geom)?;
        let (mut size, _) = geom.numbers_up_to::<3>("size")?;
        let kind = geom.text("type").map_or("sphere", |(text, _)| text);
        if let Some([a, b, c, d, e, f]) = geom.numbers("fromto")? {
            if !["capsule", "cylinder", "box", "ellipsoid"].contains(&kind) {
                let element = format!("fromto of a geom of type {kind}");
                return Err(geom.fault("fromto", FileFault::Unsupported { element }));
            }
            let along = sub([a, b, c], [d, e, f]);
            let length = dot(along, along).sqrt();
            if length < 1e-14 {
                let wrong = FileFault::OutOfRange { attribute: "fromto", value: length, condition: "0 < length" };
                return Err(geom.fault("fromto", wrong));
            }
            place = Place { origin: [0.5 * (a + d), 0.5 * (b + e), 0.5 * (c + f)], attitude: turn_of_z(along) };
            let half = 0.5 * length;
            size = if ["box", "ellipsoid"].contains(&kind) { [size[0], size[0], half] } else { [size[0], half, 0.0] };
        }
        let positive = |count: usize| match size[..count].iter().find(|size| **size <= 0.0) {
            Some(&value) => {
                Err(geom.fault("size", FileFault::OutOfRange { attribute: "size", value, condition: "0 < x" }))
            }
            None => Ok(()),
        };
        let shape = match kind {
            "sphere" => {
                positive(1)?;
                Shape::Solid(Solid::Sphere { radius: size[0] })
            }
            "capsule" => {
                positive(2)?;
                Shape::Solid(Solid::Capsule { radius: size[0], height: 2.0 * size[1] })
            }
            "cylinder" => {
                positive(2)?;
                Shape::Solid(Solid::Cylinder { radius: size[0], height: 2.0 * size[1] })
            }
            "box" => {
                positive(3)?;
                Shape::Solid(Solid::Cuboid { edges: scaled(2.0, size) })
            }
            "ellipsoid" => {
                positive(3)?;
                Shape::Solid(Solid::Ellipsoid { semi_axes: size })
            }
            "plane" | "hfield" => Shape::Surface,
            "mesh" => Shape::Mesh(geom.required("mesh")?.to_owned()),
            other => {
                let element = format!("geom of type {other}");
                return Err(geom.fault("type", FileFault::Unsupported { element }));
            }
        };
        let group = geom.number("group", 0.0)?;
        let mut mass = geom.numbers::<1>("mass")?.map(|[mass]| mass);
        let density = geom.number("density", 1000.0)?;
        for (attribute, value) in [("mass", mass.unwrap_or(0.0)), ("density", density)] {
            if value < 0.0 {
                return Err(geom.fault(attribute, FileFault::Negative { attribute, value }));
            }
        }
        match &shape {
            Shape::Solid(solid) => mass = mass.or(solid.volume().ok().map(|volume| density * volume)),
            Shape::Surface => mass = Some(0.0),
            Shape::Mesh(_) if density <= 0.0 => mass = mass.or(Some(0.0)),
            Shape::Mesh(_) => {}
        }
        let [first, last] = settings.groups;
        let (element, place) = (geom.element(), frame.then(&place));
        Ok(Self { element, place, shape, mass, is_weighed: first <= group && group <= last })
    }

    /// The shape for pictures: of capsules a cylinder and two spheres.
    pub(super) fn add_visuals(&self, body: &str, mesh_file: impl Fn(&str) -> String, out: &mut Vec<Visual>) {
        let mut add = |along: f64, shape| {
            let origin = self.place.point([0.0, 0.0, along]);
            out.push(Visual { body: body.to_owned(), origin, attitude: self.place.attitude, shape });
        };
        match &self.shape {
            Shape::Solid(Solid::Sphere { radius }) => add(0.0, VisualShape::Sphere { radius: *radius }),
            Shape::Solid(Solid::Cuboid { edges }) => add(0.0, VisualShape::Box { sides: *edges }),
            Shape::Solid(Solid::Cylinder { radius, height }) => {
                add(0.0, VisualShape::Cylinder { radius: *radius, length: *height });
            }
            Shape::Solid(Solid::Capsule { radius, height }) => {
                add(0.0, VisualShape::Cylinder { radius: *radius, length: *height });
                for end in [-0.5, 0.5] {
                    add(end * height, VisualShape::Sphere { radius: *radius });
                }
            }
            Shape::Mesh(mesh) => add(0.0, VisualShape::Mesh { file: mesh_file(mesh) }),
            Shape::Solid(_) | Shape::Surface => {}
        }
    }
}

/// The inertia of a body of its geoms together.
pub(super) fn together(body: &Styled<'_>, name: &str, geoms: &[Geom<'_>]) -> Result<BodyInertia, MultibodyError> {
    let (mut mass, mut first) = (0.0, [0.0; 3]);
    let mut parts: Vec<(f64, Inertia, [f64; 3], Attitude<f64>)> = Vec::new();
    for geom in geoms.iter().filter(|geom| geom.is_weighed) {
        match (geom.mass, &geom.shape) {
            (Some(part), Shape::Solid(solid)) if 0.0 < part => {
                let inertia = solid.inertia(part).map_err(|source| invalid_inertia(body.element(), name, source))?;
                parts.push((part, inertia, geom.place.origin, geom.place.attitude));
                mass += part;
                for (sum, x) in first.iter_mut().zip(geom.place.origin) {
                    *sum += part * x;
                }
            }
            (Some(part), _) if part <= 0.0 => {}
            _ => {
                let element = "inertia of a geom of type mesh".to_owned();
                return Err(fault(geom.element, FileFault::Unsupported { element }));
            }
        }
    }
    if parts.is_empty() {
        return Ok(BodyInertia::MASSLESS);
    }
    let centre = scaled(1.0 / mass, first);
    let about_centre: Matrix3<f64> = parts
        .iter()
        .map(|(part, inertia, origin, attitude)| {
            inertia.rotated(*attitude).about_offset_point(*part, &Vector3::from(sub(*origin, centre)))
        })
        .sum();
    BodyInertia::new(mass, centre, about_centre.into()).map_err(|source| invalid_inertia(body.element(), name, source))
}

/// The element `inertial`.
pub(super) fn inertial(
    settings: &Settings,
    inertial: &Styled<'_>,
    body: &str,
    inertias: FileInertias,
) -> Result<BodyInertia, MultibodyError> {
    inertial.check(&["pos", "quat", "axisangle", "xyaxes", "zaxis", "euler", "mass", "diaginertia", "fullinertia"])?;
    inertial.required("pos")?;
    inertial.required("mass")?;
    let place = settings.place(inertial)?;
    let mass = inertial.number("mass", 0.0)?;
    let matrix = match (inertial.numbers("diaginertia")?, inertial.numbers("fullinertia")?) {
        (Some(_), Some(_)) => {
            let (first, second) = ("diaginertia", "fullinertia");
            return Err(fault(
                inertial.element(),
                FileFault::TwoAttributes { element: "inertial".to_owned(), first, second },
            ));
        }
        (Some([x, y, z]), None) => [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]],
        (None, Some([xx, yy, zz, xy, xz, yz])) => [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
        (None, None) => [[0.0; 3]; 3],
    };
    inertias
        .body(mass, place.origin, turned(place.attitude, matrix))
        .map_err(|source| invalid_inertia(inertial.element(), body, source))
}
