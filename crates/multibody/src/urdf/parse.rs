//! The elements of a URDF text as bodies and joints.

use piola_kinematics::Attitude;

use super::{Mimic, Urdf, UrdfBase, UrdfOptions};
use crate::error::{FileFault, MultibodyError};
use crate::files::{
    Element, Visual, VisualShape, attribute, elements, fault, find, invalid_inertia, no_such_name, number, required,
    turned, vector,
};
use crate::tree::{BodyIndex, BodyInertia, JointKind, RigidTree, RigidTreeBuilder, TreeJoint};

/// Elements that move nothing, in a robot, a link or a joint.
const WITHOUT_MECHANICS: [&str; 7] =
    ["visual", "collision", "material", "transmission", "gazebo", "safety_controller", "calibration"];

struct Reader {
    options: UrdfOptions,
}

struct Tie<'a> {
    element: Element<'a>,
    parent: &'a str,
    child: &'a str,
}

/// The tree of a document's first element.
pub(super) fn parse(robot: Element<'_>, options: UrdfOptions) -> Result<Urdf, MultibodyError> {
    let reader = Reader { options };
    if robot.tag_name().name() != "robot" {
        return Err(fault(robot, FileFault::Unsupported { element: robot.tag_name().name().to_owned() }));
    }
    reader.robot(robot)
}

impl Reader {
    fn robot(&self, robot: Element<'_>) -> Result<Urdf, MultibodyError> {
        let (mut links, mut ties, mut mimics) = (Vec::new(), Vec::new(), Vec::new());
        for element in elements(robot) {
            match element.tag_name().name() {
                "link" => links.push((attribute(element, "name")?, element)),
                "joint" => ties.push(tie(element)?),
                other => check_is_known(element, other)?,
            }
        }
        for tie in &ties {
            for link in [tie.parent, tie.child] {
                if links.iter().all(|(name, _)| *name != link) {
                    return Err(no_such_name(tie.element, "link", link));
                }
            }
            let twice = ties.iter().filter(|other| other.child == tie.child).nth(1);
            if let Some(second) = twice {
                return Err(fault(second.element, FileFault::TwoParents { link: tie.child.to_owned() }));
            }
            mimics.extend(mimic(tie.element)?);
        }
        let mut roots = links.iter().filter(|(name, _)| ties.iter().all(|tie| tie.child != *name));
        let Some(&(root, element)) = roots.next() else {
            return Err(fault(robot, FileFault::NoRoot));
        };
        if let Some(&(second, element)) = roots.next() {
            return Err(fault(element, FileFault::TwoRoots { first: root.to_owned(), second: second.to_owned() }));
        }
        let mut builder = RigidTree::builder();
        let kind = match self.options.base {
            UrdfBase::Fixed => JointKind::Fixed,
            UrdfBase::Free => JointKind::Free,
        };
        let joint = TreeJoint::new(format!("ground to {root}"), kind);
        let base = builder.attach(BodyIndex::GROUND, joint, root, self.inertia(root, element)?)?;
        // Depth first, so that chains stay together. The stack holds bodies with the next of their ties to look at.
        let mut attached = 1;
        let mut stack = vec![(base, root, 0)];
        while let Some((parent, name, next)) = stack.pop() {
            let Some((index, tie)) = ties.iter().enumerate().skip(next).find(|(_, tie)| tie.parent == name) else {
                continue;
            };
            stack.push((parent, name, index + 1));
            let child = self.attach(&mut builder, parent, tie, &links)?;
            attached += 1;
            stack.push((child, tie.child, 0));
        }
        if attached < links.len() {
            // Every link but the root has a parent, so what was not reached goes round.
            return Err(fault(robot, FileFault::Cycle { links: links.len() - attached }));
        }
        let name = robot.attribute("name").unwrap_or_default().to_owned();
        let mut visuals = Vec::new();
        for &(link, element) in &links {
            for drawn in elements(element).filter(|element| element.tag_name().name() == "visual") {
                visuals.extend(visual(link, drawn)?);
            }
        }
        Ok(Urdf { name, tree: builder.build()?, mimics, visuals })
    }

    fn attach<'a>(
        &self,
        builder: &mut RigidTreeBuilder,
        parent: BodyIndex,
        tie: &Tie<'a>,
        links: &[(&'a str, Element<'a>)],
    ) -> Result<BodyIndex, MultibodyError> {
        let element = tie.element;
        let axis = match find(element, "axis") {
            Some(axis) => vector(axis, "xyz", [1.0, 0.0, 0.0])?,
            None => [1.0, 0.0, 0.0],
        };
        let kind = match attribute(element, "type")? {
            "revolute" | "continuous" => JointKind::Revolute { axis },
            "prismatic" => JointKind::Prismatic { axis },
            "fixed" => JointKind::Fixed,
            "floating" => JointKind::Free,
            other => {
                return Err(fault(element, FileFault::Unsupported { element: format!("joint of type {other}") }));
            }
        };
        let (origin, attitude) = origin(element)?;
        let mut joint = TreeJoint::new(attribute(element, "name")?, kind).at(origin).turned(attitude);
        if let Some(limit) = find(element, "limit") {
            if element.attribute("type") != Some("continuous") {
                joint.limits = [number(limit, "lower", Some(0.0))?, number(limit, "upper", Some(0.0))?];
            }
            joint.largest_rate = number(limit, "velocity", Some(f64::INFINITY))?;
            joint.largest_effort = number(limit, "effort", Some(f64::INFINITY))?;
        }
        if let Some(dynamics) = find(element, "dynamics") {
            joint.damping = number(dynamics, "damping", Some(0.0))?;
            joint.friction = number(dynamics, "friction", Some(0.0))?;
        }
        let Some(&(name, link)) = links.iter().find(|(name, _)| *name == tie.child) else {
            return Err(no_such_name(element, "link", tie.child));
        };
        builder.attach(parent, joint, name, self.inertia(name, link)?)
    }

    fn inertia(&self, name: &str, link: Element<'_>) -> Result<BodyInertia, MultibodyError> {
        for child in elements(link) {
            match child.tag_name().name() {
                "inertial" => {}
                other => check_is_known(child, other)?,
            }
        }
        let Some(inertial) = find(link, "inertial") else { return Ok(BodyInertia::MASSLESS) };
        let (centre, attitude) = origin(inertial)?;
        let mass = number(required(inertial, "mass")?, "value", None)?;
        let matrix = required(inertial, "inertia")?;
        let [xx, yy, zz] = [number(matrix, "ixx", None)?, number(matrix, "iyy", None)?, number(matrix, "izz", None)?];
        let off = |name| number(matrix, name, Some(0.0));
        let [xy, xz, yz] = [off("ixy")?, off("ixz")?, off("iyz")?];
        let rows = turned(attitude, [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
        self.options.inertias.body(mass, centre, rows).map_err(|source| invalid_inertia(inertial, name, source))
    }
}

fn tie(element: Element<'_>) -> Result<Tie<'_>, MultibodyError> {
    for child in elements(element) {
        match child.tag_name().name() {
            "parent" | "child" | "origin" | "axis" | "limit" | "dynamics" | "mimic" => {}
            other => check_is_known(child, other)?,
        }
    }
    let link = |name: &'static str| attribute(required(element, name)?, "link");
    Ok(Tie { element, parent: link("parent")?, child: link("child")? })
}

fn mimic(element: Element<'_>) -> Result<Option<Mimic>, MultibodyError> {
    let Some(mimic) = find(element, "mimic") else { return Ok(None) };
    Ok(Some(Mimic {
        joint: attribute(element, "name")?.to_owned(),
        follows: attribute(mimic, "joint")?.to_owned(),
        multiplier: number(mimic, "multiplier", Some(1.0))?,
        offset: number(mimic, "offset", Some(0.0))?,
    }))
}

/// The picture of a link; nothing where it has no shape, or one that is not known. Pictures are no mechanics.
fn visual(link: &str, visual: Element<'_>) -> Result<Option<Visual>, MultibodyError> {
    let Some(shape) = find(visual, "geometry").and_then(|geometry| elements(geometry).next()) else {
        return Ok(None);
    };
    let not_negative = |attribute, value| {
        if value < 0.0 { Err(fault(shape, FileFault::Negative { attribute, value })) } else { Ok(value) }
    };
    let number = |name| not_negative(name, number(shape, name, None)?);
    let shape = match shape.tag_name().name() {
        "box" => {
            attribute(shape, "size")?;
            let sides = vector(shape, "size", [0.0; 3])?;
            for side in sides {
                not_negative("size", side)?;
            }
            VisualShape::Box { sides }
        }
        "cylinder" => VisualShape::Cylinder { radius: number("radius")?, length: number("length")? },
        "sphere" => VisualShape::Sphere { radius: number("radius")? },
        "mesh" => VisualShape::Mesh { file: attribute(shape, "filename")?.to_owned() },
        _ => return Ok(None),
    };
    let (origin, attitude) = origin(visual)?;
    Ok(Some(Visual { body: link.to_owned(), origin, attitude, shape }))
}

/// The element `origin` of an element: its place and attitude.
fn origin(element: Element<'_>) -> Result<([f64; 3], Attitude<f64>), MultibodyError> {
    let Some(origin) = find(element, "origin") else { return Ok(([0.0; 3], Attitude::identity())) };
    let [roll, pitch, yaw] = vector(origin, "rpy", [0.0; 3])?;
    let attitude = Attitude::about_z(yaw).product(Attitude::about_y(pitch)).product(Attitude::about_x(roll));
    Ok((vector(origin, "xyz", [0.0; 3])?, attitude))
}

fn check_is_known(element: Element<'_>, name: &str) -> Result<(), MultibodyError> {
    if WITHOUT_MECHANICS.contains(&name) {
        return Ok(());
    }
    Err(fault(element, FileFault::Unsupported { element: name.to_owned() }))
}
