//! The elements of a URDF text as bodies and joints.

use nalgebra::Vector3;
use piola_kinematics::Attitude;
use roxmltree::{Document, Node};

use super::{Mimic, Urdf, UrdfBase, UrdfInertias, UrdfOptions, Visual, VisualShape};
use crate::error::{MultibodyError, UrdfFault};
use crate::tree::{BodyIndex, BodyInertia, JointKind, RigidTree, RigidTreeBuilder, TreeJoint};

type Element<'a> = Node<'a, 'a>;

/// Elements that move nothing, in a robot, a link or a joint.
const WITHOUT_MECHANICS: [&str; 7] =
    ["visual", "collision", "material", "transmission", "gazebo", "safety_controller", "calibration"];

struct Reader<'a> {
    document: &'a Document<'a>,
    options: UrdfOptions,
}

struct Tie<'a> {
    element: Element<'a>,
    parent: &'a str,
    child: &'a str,
}

pub(super) fn parse(text: &str, options: UrdfOptions) -> Result<Urdf, MultibodyError> {
    let document = Document::parse(text).map_err(|error| MultibodyError::Urdf {
        line: error.pos().row as usize,
        fault: UrdfFault::Syntax { reason: error.to_string() },
    })?;
    let reader = Reader { document: &document, options };
    let robot = document.root_element();
    if robot.tag_name().name() != "robot" {
        return Err(reader.fault(robot, UrdfFault::Unsupported { element: robot.tag_name().name().to_owned() }));
    }
    reader.robot(robot)
}

impl<'a> Reader<'a> {
    fn robot(&self, robot: Element<'a>) -> Result<Urdf, MultibodyError> {
        let (mut links, mut ties, mut mimics) = (Vec::new(), Vec::new(), Vec::new());
        for element in elements(robot) {
            match element.tag_name().name() {
                "link" => links.push((self.attribute(element, "name")?, element)),
                "joint" => ties.push(self.tie(element)?),
                other => self.check_is_known(element, other)?,
            }
        }
        for tie in &ties {
            for link in [tie.parent, tie.child] {
                if links.iter().all(|(name, _)| *name != link) {
                    return Err(self.fault(tie.element, UrdfFault::NoSuchLink { link: link.to_owned() }));
                }
            }
            let twice = ties.iter().filter(|other| other.child == tie.child).nth(1);
            if let Some(second) = twice {
                return Err(self.fault(second.element, UrdfFault::TwoParents { link: tie.child.to_owned() }));
            }
            mimics.extend(self.mimic(tie.element)?);
        }
        let mut roots = links.iter().filter(|(name, _)| ties.iter().all(|tie| tie.child != *name));
        let Some(&(root, element)) = roots.next() else {
            return Err(self.fault(robot, UrdfFault::NoRoot));
        };
        if let Some(&(second, element)) = roots.next() {
            return Err(self.fault(element, UrdfFault::TwoRoots { first: root.to_owned(), second: second.to_owned() }));
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
            return Err(self.fault(robot, UrdfFault::Cycle { links: links.len() - attached }));
        }
        let name = robot.attribute("name").unwrap_or_default().to_owned();
        let mut visuals = Vec::new();
        for &(link, element) in &links {
            for visual in elements(element).filter(|element| element.tag_name().name() == "visual") {
                visuals.extend(self.visual(link, visual)?);
            }
        }
        Ok(Urdf { name, tree: builder.build()?, mimics, visuals })
    }

    fn tie(&self, element: Element<'a>) -> Result<Tie<'a>, MultibodyError> {
        for child in elements(element) {
            match child.tag_name().name() {
                "parent" | "child" | "origin" | "axis" | "limit" | "dynamics" | "mimic" => {}
                other => self.check_is_known(child, other)?,
            }
        }
        let link = |name: &'static str| self.attribute(self.element(element, name)?, "link");
        Ok(Tie { element, parent: link("parent")?, child: link("child")? })
    }

    fn attach(
        &self,
        builder: &mut RigidTreeBuilder,
        parent: BodyIndex,
        tie: &Tie<'a>,
        links: &[(&'a str, Element<'a>)],
    ) -> Result<BodyIndex, MultibodyError> {
        let element = tie.element;
        let axis = match find(element, "axis") {
            Some(axis) => self.vector(axis, "xyz", [1.0, 0.0, 0.0])?,
            None => [1.0, 0.0, 0.0],
        };
        let kind = match self.attribute(element, "type")? {
            "revolute" | "continuous" => JointKind::Revolute { axis },
            "prismatic" => JointKind::Prismatic { axis },
            "fixed" => JointKind::Fixed,
            "floating" => JointKind::Free,
            other => {
                return Err(self.fault(element, UrdfFault::Unsupported { element: format!("joint of type {other}") }));
            }
        };
        let (origin, attitude) = self.origin(element)?;
        let mut joint = TreeJoint::new(self.attribute(element, "name")?, kind).at(origin).turned(attitude);
        if let Some(limit) = find(element, "limit") {
            if element.attribute("type") != Some("continuous") {
                joint.limits = [self.number(limit, "lower", Some(0.0))?, self.number(limit, "upper", Some(0.0))?];
            }
            joint.largest_rate = self.number(limit, "velocity", Some(f64::INFINITY))?;
            joint.largest_effort = self.number(limit, "effort", Some(f64::INFINITY))?;
        }
        if let Some(dynamics) = find(element, "dynamics") {
            joint.damping = self.number(dynamics, "damping", Some(0.0))?;
            joint.friction = self.number(dynamics, "friction", Some(0.0))?;
        }
        let Some(&(name, link)) = links.iter().find(|(name, _)| *name == tie.child) else {
            return Err(self.fault(element, UrdfFault::NoSuchLink { link: tie.child.to_owned() }));
        };
        builder.attach(parent, joint, name, self.inertia(name, link)?)
    }

    fn mimic(&self, element: Element<'a>) -> Result<Option<Mimic>, MultibodyError> {
        let Some(mimic) = find(element, "mimic") else { return Ok(None) };
        Ok(Some(Mimic {
            joint: self.attribute(element, "name")?.to_owned(),
            follows: self.attribute(mimic, "joint")?.to_owned(),
            multiplier: self.number(mimic, "multiplier", Some(1.0))?,
            offset: self.number(mimic, "offset", Some(0.0))?,
        }))
    }

    fn inertia(&self, name: &str, link: Element<'a>) -> Result<BodyInertia, MultibodyError> {
        for child in elements(link) {
            match child.tag_name().name() {
                "inertial" => {}
                other => self.check_is_known(child, other)?,
            }
        }
        let Some(inertial) = find(link, "inertial") else { return Ok(BodyInertia::MASSLESS) };
        let (centre, attitude) = self.origin(inertial)?;
        let mass = self.number(self.element(inertial, "mass")?, "value", None)?;
        let matrix = self.element(inertial, "inertia")?;
        let [xx, yy, zz] =
            [self.number(matrix, "ixx", None)?, self.number(matrix, "iyy", None)?, self.number(matrix, "izz", None)?];
        let off = |name| self.number(matrix, name, Some(0.0));
        let [xy, xz, yz] = [off("ixy")?, off("ixz")?, off("iyz")?];
        // Rows of R I Rᵀ, for the frame of the inertial turned against that of the link.
        let turn = nalgebra::Matrix3::from_columns(
            &[Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| attitude.to_space(&axis)),
        );
        let turned = turn * nalgebra::Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz) * turn.transpose();
        let rows = ((turned + turned.transpose()) * 0.5).into();
        let inertia = match self.options.inertias {
            UrdfInertias::Checked => BodyInertia::new(mass, centre, rows),
            UrdfInertias::AsGiven => BodyInertia::as_given(mass, centre, rows),
        };
        inertia.map_err(|source| {
            let wrong = MultibodyError::InvalidInertia { body: name.to_owned(), source };
            self.fault(inertial, UrdfFault::Invalid { source: Box::new(wrong) })
        })
    }

    /// The picture of a link; nothing where it has no shape, or one that is not known. Pictures are no mechanics.
    fn visual(&self, link: &str, visual: Element<'a>) -> Result<Option<Visual>, MultibodyError> {
        let Some(shape) = find(visual, "geometry").and_then(|geometry| elements(geometry).next()) else {
            return Ok(None);
        };
        let not_negative = |attribute, value| {
            if value < 0.0 { Err(self.fault(shape, UrdfFault::Negative { attribute, value })) } else { Ok(value) }
        };
        let number = |name| not_negative(name, self.number(shape, name, None)?);
        let shape = match shape.tag_name().name() {
            "box" => {
                self.attribute(shape, "size")?;
                let sides = self.vector(shape, "size", [0.0; 3])?;
                for side in sides {
                    not_negative("size", side)?;
                }
                VisualShape::Box { sides }
            }
            "cylinder" => VisualShape::Cylinder { radius: number("radius")?, length: number("length")? },
            "sphere" => VisualShape::Sphere { radius: number("radius")? },
            "mesh" => VisualShape::Mesh { file: self.attribute(shape, "filename")?.to_owned() },
            _ => return Ok(None),
        };
        let (origin, attitude) = self.origin(visual)?;
        Ok(Some(Visual { body: link.to_owned(), origin, attitude, shape }))
    }

    /// The element `origin` of an element: its place and attitude.
    fn origin(&self, element: Element<'a>) -> Result<([f64; 3], Attitude<f64>), MultibodyError> {
        let Some(origin) = find(element, "origin") else { return Ok(([0.0; 3], Attitude::identity())) };
        let [roll, pitch, yaw] = self.vector(origin, "rpy", [0.0; 3])?;
        let attitude = Attitude::about_z(yaw).product(Attitude::about_y(pitch)).product(Attitude::about_x(roll));
        Ok((self.vector(origin, "xyz", [0.0; 3])?, attitude))
    }

    fn element(&self, of: Element<'a>, name: &'static str) -> Result<Element<'a>, MultibodyError> {
        find(of, name)
            .ok_or_else(|| self.fault(of, UrdfFault::Missing { what: name, element: of.tag_name().name().to_owned() }))
    }

    fn attribute(&self, element: Element<'a>, name: &'static str) -> Result<&'a str, MultibodyError> {
        element.attribute(name).ok_or_else(|| {
            self.fault(element, UrdfFault::Missing { what: name, element: element.tag_name().name().to_owned() })
        })
    }

    /// A finite number, or what stands for it where it is missing.
    fn number(&self, element: Element<'a>, name: &'static str, default: Option<f64>) -> Result<f64, MultibodyError> {
        match (element.attribute(name), default) {
            (None, Some(default)) => Ok(default),
            _ => self.parsed(element, name, self.attribute(element, name)?),
        }
    }

    fn parsed(&self, element: Element<'a>, attribute: &'static str, text: &str) -> Result<f64, MultibodyError> {
        match text.trim().parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(self.fault(element, UrdfFault::NotNumbers { attribute, text: text.to_owned() })),
        }
    }

    fn vector(&self, element: Element<'a>, name: &'static str, default: [f64; 3]) -> Result<[f64; 3], MultibodyError> {
        let Some(text) = element.attribute(name) else { return Ok(default) };
        let mut out = [0.0; 3];
        let mut words = text.split_whitespace();
        for out in &mut out {
            *out = self.parsed(element, name, words.next().unwrap_or_default())?;
        }
        if words.next().is_some() {
            return Err(self.fault(element, UrdfFault::NotNumbers { attribute: name, text: text.to_owned() }));
        }
        Ok(out)
    }

    fn check_is_known(&self, element: Element<'a>, name: &str) -> Result<(), MultibodyError> {
        if WITHOUT_MECHANICS.contains(&name) {
            return Ok(());
        }
        Err(self.fault(element, UrdfFault::Unsupported { element: name.to_owned() }))
    }

    fn fault(&self, element: Element<'a>, fault: UrdfFault) -> MultibodyError {
        let line = self.document.text_pos_at(element.range().start).row as usize;
        MultibodyError::Urdf { line, fault }
    }
}

fn elements(of: Element<'_>) -> impl Iterator<Item = Element<'_>> {
    of.children().filter(Node::is_element)
}

fn find<'a>(of: Element<'a>, name: &str) -> Option<Element<'a>> {
    elements(of).find(|element| element.tag_name().name() == name)
}
