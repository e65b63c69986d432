//! The joints of a body as a series.

use nalgebra::Vector3;
use piola_kinematics::Attitude;

use super::element::Styled;
use super::place::Place;
use super::reader::Names;
use super::settings::Settings;
use crate::error::{FileFault, MultibodyError};
use crate::files::fault;
use crate::spatial::{dot, scaled, sub};
use crate::tree::{JointKind, TreeJoint};

const READ: [&str; 18] = [
    "name",
    "class",
    "type",
    "pos",
    "axis",
    "springdamper",
    "limited",
    "range",
    "actuatorfrclimited",
    "actuatorfrcrange",
    "ref",
    "stiffness",
    "springref",
    "springyield",
    "armature",
    "damping",
    "frictionloss",
    "align",
];
/// Attributes of the softness of limits and friction, and of compensated gravity, which is refused at bodies.
const IDLE: [&str; 8] =
    ["group", "solreflimit", "solimplimit", "solreffriction", "solimpfriction", "margin", "user", "actuatorgravcomp"];

/// The joints of a body from its parent to its frame, and the coordinates at which the file places it.
pub(super) struct Series {
    pub(super) joints: Vec<TreeJoint>,
    pub(super) home: Vec<f64>,
}

/// The kind of a joint.
fn kind_of<'a>(joint: &Styled<'a>) -> &'a str {
    let default = if joint.element().tag_name().name() == "freejoint" { "free" } else { "hinge" };
    joint.text("type").map_or(default, |(text, _)| text)
}

/// The series of a body that stands at `place` in its parent. Joints come with the frames in the body that they stand in.
pub(super) fn series(
    settings: &Settings,
    names: &mut Names,
    body: &str,
    place: &Place,
    is_on_ground: bool,
    joints: &[(Styled<'_>, Place)],
) -> Result<Series, MultibodyError> {
    let mut out = Series { joints: Vec::new(), home: Vec::new() };
    if let Some((free, _)) = joints.iter().find(|(joint, _)| kind_of(joint) == "free") {
        if 1 < joints.len() || !is_on_ground {
            let element = "free joint in a series or below another body".to_owned();
            return Err(fault(free.element(), FileFault::Unsupported { element }));
        }
        let mut joint = TreeJoint::new(name_of(free, names, body, 0), JointKind::Free);
        data(settings, free, &mut joint)?;
        let q = place.attitude;
        out.home.extend([q.w, q.x, q.y, q.z]);
        out.home.extend(place.origin);
        out.joints.push(joint);
        return Ok(out);
    }
    // Where the frame before the next joint stands in the body's frame, and its turn from the first joint's parent.
    let mut before = [0.0; 3];
    let mut outer = *place;
    for (index, (styled, frame)) in joints.iter().enumerate() {
        let anchor = frame.point(styled.numbers("pos")?.unwrap_or_default());
        let axis = axis_of(styled)?;
        let turned = axis.map(|axis| frame.turn(axis));
        let kind = match (kind_of(styled), turned) {
            ("hinge", Ok(axis)) => JointKind::Revolute { axis },
            ("slide", Ok(axis)) => JointKind::Prismatic { axis },
            ("ball", _) => JointKind::Spherical,
            ("hinge" | "slide", Err(wrong)) => return Err(wrong),
            (other, _) => return Err(styled.no_such_word("type", other, "hinge, slide, ball or free")),
        };
        // A coordinate is that of the file, which is `ref` where the body is placed.
        let unit = if kind_of(styled) == "hinge" { settings.angle } else { 1.0 };
        let reference = unit * styled.number("ref", 0.0)?;
        let mut stands = outer.then(&Place::at(sub(anchor, before)));
        match kind {
            JointKind::Revolute { axis } => {
                let back = Attitude::from_axis_angle(&Vector3::from(axis), -reference);
                stands =
                    stands.then(&Place { origin: [0.0; 3], attitude: back.unwrap_or_else(|_| Attitude::identity()) });
                out.home.push(reference);
            }
            JointKind::Prismatic { axis } => {
                stands = stands.then(&Place::at(scaled(-reference, axis)));
                out.home.push(reference);
            }
            _ => {
                styled.check_idle(&[("ref", &["0"])])?;
                out.home.extend([1.0, 0.0, 0.0, 0.0]);
            }
        }
        let name = name_of(styled, names, body, index);
        let mut joint = TreeJoint::new(name, kind).at(stands.origin).turned(stands.attitude);
        data(settings, styled, &mut joint)?;
        out.joints.push(joint);
        before = anchor;
        outer = Place::identity();
    }
    // The body's frame stands where the last joint does, less its anchor.
    let rest = outer.then(&Place::at(scaled(-1.0, before)));
    if joints.is_empty() || rest.origin.iter().any(|x| 0.0 < x.abs()) {
        let name = names.invent(&format!("frame of {body}"));
        out.joints.push(TreeJoint::new(name, JointKind::Fixed).at(rest.origin).turned(rest.attitude));
    }
    Ok(out)
}

fn name_of(joint: &Styled<'_>, names: &mut Names, body: &str, index: usize) -> String {
    let invented = || names.invent(&format!("{body} joint {}", index + 1));
    joint.text("name").map_or_else(invented, |(name, _)| name.to_owned())
}

/// The axis as a unit vector; the error of one without direction is for those joints that need it.
fn axis_of(joint: &Styled<'_>) -> Result<Result<[f64; 3], MultibodyError>, MultibodyError> {
    let axis: [f64; 3] = joint.numbers("axis")?.unwrap_or([0.0, 0.0, 1.0]);
    let length = dot(axis, axis).sqrt();
    if 1e-14 < length && length < f64::INFINITY {
        return Ok(Ok(scaled(1.0 / length, axis)));
    }
    let wrong = FileFault::OutOfRange { attribute: "axis", value: length, condition: "0 < length" };
    Ok(Err(joint.fault("axis", wrong)))
}

/// Data of stops, motor, spring and friction.
fn data(settings: &Settings, styled: &Styled<'_>, joint: &mut TreeJoint) -> Result<(), MultibodyError> {
    styled.check(&[&READ[..], &IDLE].concat())?;
    styled.check_idle(&[("springdamper", &["0"]), ("springyield", &["0"]), ("align", &["false", "auto"])])?;
    joint.armature = styled.not_negative("armature", 0.0)?;
    joint.damping = styled.not_negative("damping", 0.0)?;
    joint.friction = styled.not_negative("frictionloss", 0.0)?;
    let unit = if kind_of(styled) == "hinge" { settings.angle } else { 1.0 };
    if joint.kind.coordinates() != joint.kind.freedoms() {
        styled.check_idle(&[("stiffness", &["0"])])?;
        if joint.kind == JointKind::Free {
            styled.check_idle(&[("armature", &["0"])])?;
        }
        if styled.range("range", "limited", settings.autolimits)?.is_some() {
            let element = "range of a ball or free joint".to_owned();
            return Err(styled.fault("range", FileFault::Unsupported { element }));
        }
        return Ok(());
    }
    joint.stiffness = styled.not_negative("stiffness", 0.0)?;
    joint.rest = unit * styled.number("springref", 0.0)?;
    if let Some(range) = styled.range("range", "limited", settings.autolimits)? {
        joint.limits = range.map(|limit| unit * limit);
    }
    if let Some(range) = styled.range("actuatorfrcrange", "actuatorfrclimited", settings.autolimits)? {
        if 0.0 < (range[0] + range[1]).abs() {
            let element = "an actuatorfrcrange that is not symmetric".to_owned();
            return Err(styled.fault("actuatorfrcrange", FileFault::Unsupported { element }));
        }
        joint.largest_effort = range[1];
    }
    Ok(())
}
