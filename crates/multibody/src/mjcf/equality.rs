//! Equalities as closures, and motors.

use piola_kinematics::Attitude;

use super::FileMotor;
use super::element::{Styled, unsupported};
use super::place::Place;
use super::reader::{Placed, Reader};
use crate::error::{FileFault, MultibodyError};
use crate::files::{Element, elements, fault, no_such_name};
use crate::loops::{BodyPoint, LoopClosure};
use crate::tree::{FrameIndex, JointKind, JointPlace, RigidTree};

type NamedClosures = Vec<(String, LoopClosure)>;

/// Equalities and motors; those of joints wait for the tree.
#[derive(Default)]
pub(super) struct Ties<'a> {
    closures: NamedClosures,
    joints: Vec<(String, Styled<'a>)>,
    motors: Vec<(Styled<'a>, Option<[f64; 2]>)>,
}

pub(super) fn ties<'a>(
    reader: &mut Reader<'a>,
    equalities: &[Element<'a>],
    actuators: &[Element<'a>],
) -> Result<Ties<'a>, MultibodyError> {
    let mut ties = Ties::default();
    for (index, element) in equalities.iter().copied().flat_map(elements).enumerate() {
        let kind = element.tag_name().name();
        if !["connect", "weld", "joint"].contains(&kind) {
            return Err(unsupported(element));
        }
        let styled = reader.classes.styled(element, None, &["equality"])?;
        styled.check(&[
            "name",
            "class",
            "active",
            "solref",
            "solimp",
            "body1",
            "body2",
            "site1",
            "site2",
            "anchor",
            "relpose",
            "torquescale",
            "joint1",
            "joint2",
            "polycoef",
        ])?;
        if styled.flag("active")? == Some(false) {
            continue;
        }
        let invented = || reader.names.invent(&format!("{kind} {index}"));
        let name = element.attribute("name").map_or_else(invented, str::to_owned);
        match kind {
            "connect" => ties.closures.push((name, reader.connect(&styled)?)),
            "weld" => {
                let closure = reader.weld(&styled, &name)?;
                ties.closures.push((name, closure));
            }
            _ => ties.joints.push((name, styled)),
        }
    }
    for element in actuators.iter().copied().flat_map(elements) {
        if element.tag_name().name() != "motor" {
            return Err(unsupported(element));
        }
        let styled = reader.classes.styled(element, None, &["motor", "general"])?;
        styled.check(&["name", "class", "group", "user", "joint", "gear", "ctrlrange", "ctrllimited"])?;
        let range = styled.range("ctrlrange", "ctrllimited", reader.settings.autolimits)?;
        ties.motors.push((styled, range));
    }
    Ok(ties)
}

impl Reader<'_> {
    fn connect(&self, styled: &Styled<'_>) -> Result<LoopClosure, MultibodyError> {
        if let Some([first, second]) = self.sites_of_tie(styled)? {
            return Ok(LoopClosure::Point { first: first.0, second: second.0 });
        }
        let [first, second] = self.bodies_of_tie(styled)?;
        styled.required("anchor")?;
        let at: [f64; 3] = styled.numbers("anchor")?.unwrap_or_default();
        let in_second = second.place.seen(&first.place.then(&Place::at(at))).origin;
        let [first, second] = [BodyPoint::new(first.index, at), BodyPoint::new(second.index, in_second)];
        Ok(LoopClosure::Point { first, second })
    }

    /// Without a scale for torques a weld turns freely: it is a point.
    fn weld(&mut self, styled: &Styled<'_>, name: &str) -> Result<LoopClosure, MultibodyError> {
        let holds_attitude = 0.0 < styled.not_negative("torquescale", 1.0)?;
        if let Some([first, second]) = self.sites_of_tie(styled)? {
            return Ok(if holds_attitude {
                LoopClosure::Frame { first: first.1, second: second.1 }
            } else {
                LoopClosure::Point { first: first.0, second: second.0 }
            });
        }
        let [first, second] = self.bodies_of_tie(styled)?;
        let anchor = Place::at(styled.numbers("anchor")?.unwrap_or_default());
        let relative = match styled.numbers("relpose")? {
            Some([x, y, z, a, b, c, d]) if [a, b, c, d].iter().any(|q: &f64| 0.0 < q.abs()) => {
                let attitude = Attitude::from_quaternion([a, b, c, d]).unwrap_or_else(|_| Attitude::identity());
                Place { origin: [x, y, z], attitude }
            }
            _ => first.place.seen(&second.place.then(&anchor)),
        };
        let (first, second) = (first.index, second.index);
        if !holds_attitude {
            let [first, second] = [BodyPoint::new(first, relative.origin), BodyPoint::new(second, anchor.origin)];
            return Ok(LoopClosure::Point { first, second });
        }
        let mut frame = |body, end: &str, place: &Place| {
            let name = self.names.invent(&format!("{name} {end}"));
            self.builder
                .add_frame(body, name, place.origin, place.attitude)
                .map_err(|source| fault(styled.element(), FileFault::Invalid { source: Box::new(source) }))
        };
        let first = frame(first, "on the first body", &relative)?;
        let second = frame(second, "on the second body", &anchor)?;
        Ok(LoopClosure::Frame { first, second })
    }

    fn sites_of_tie(&self, styled: &Styled<'_>) -> Result<Option<[(BodyPoint, FrameIndex); 2]>, MultibodyError> {
        if styled.text("site1").is_none() && styled.text("site2").is_none() {
            return Ok(None);
        }
        let site = |attribute| {
            let name = styled.required(attribute)?;
            let found = self.sites.sites.iter().find(|(other, ..)| other == name);
            found.map(|(_, point, frame)| (*point, *frame)).ok_or_else(|| no_such_name(styled.element(), "site", name))
        };
        Ok(Some([site("site1")?, site("site2")?]))
    }

    fn bodies_of_tie(&self, styled: &Styled<'_>) -> Result<[&Placed; 2], MultibodyError> {
        let body = |name: &str| {
            let found = self.bodies.iter().find(|body| body.name == name);
            found.ok_or_else(|| no_such_name(styled.element(), "body", name))
        };
        let second = styled.text("body2").map_or("world", |(name, _)| name);
        Ok([body(styled.required("body1")?)?, body(second)?])
    }
}

/// The joint of a name, which must have one coordinate, and its coordinate where the file places it.
fn joint_of<'t>(
    tree: &'t RigidTree,
    home: &[f64],
    styled: &Styled<'_>,
    attribute: &'static str,
) -> Result<(&'t JointPlace, f64), MultibodyError> {
    let name = styled.required(attribute)?;
    let found = tree.joints().iter().find(|place| place.joint.name == name);
    let place = found.ok_or_else(|| no_such_name(styled.element(), "joint", name))?;
    match place.joint.kind {
        JointKind::Revolute { .. } | JointKind::Prismatic { .. } => Ok((place, home[place.first_coordinate])),
        _ => {
            let element = format!("{} at a joint that is no hinge and no slide", styled.element().tag_name().name());
            Err(styled.fault(attribute, FileFault::Unsupported { element }))
        }
    }
}

impl Ties<'_> {
    /// Closures and motors on a tree that stands in the configuration `home`.
    pub(super) fn on(
        mut self,
        tree: &RigidTree,
        home: &[f64],
    ) -> Result<(NamedClosures, Vec<FileMotor>), MultibodyError> {
        for (name, styled) in self.joints {
            let (follower, at) = joint_of(tree, home, &styled, "joint1")?;
            let (coefficients, count) = styled.numbers_up_to::<5>("polycoef")?;
            // Coefficients that are not written are 0 1 0 0 0.
            let [constant, ratio, higher @ ..] = coefficients;
            let ratio = if count < 2 { 1.0 } else { ratio };
            let follower = follower.first_freedom;
            let closure = if styled.text("joint2").is_some() {
                if let Some(&value) = higher.iter().find(|x| 0.0 < x.abs()) {
                    let condition = "x = 0 from the third coefficient on";
                    return Err(
                        styled.fault("polycoef", FileFault::OutOfRange { attribute: "polycoef", value, condition })
                    );
                }
                let (leader, leads_at) = joint_of(tree, home, &styled, "joint2")?;
                let offset = at + constant - ratio * leads_at;
                LoopClosure::Gear { follower, leader: leader.first_freedom, ratio, offset }
            } else {
                LoopClosure::Gear { follower, leader: follower, ratio: 0.0, offset: at + constant }
            };
            self.closures.push((name, closure));
        }
        let mut motors = Vec::new();
        for (styled, range) in self.motors {
            let (place, _) = joint_of(tree, home, &styled, "joint")?;
            let (gear, count) = styled.numbers_up_to::<6>("gear")?;
            motors.push(FileMotor {
                name: styled.element().attribute("name").unwrap_or_default().to_owned(),
                joint: place.joint.name.clone(),
                gear: if count == 0 { 1.0 } else { gear[0] },
                controls: range.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]),
            });
        }
        Ok((self.closures, motors))
    }
}
