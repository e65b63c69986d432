//! Trees from URDF files: links, joints, inertials, limits, mimic joints.
//!
//! | element | read as |
//! |---|---|
//! | `link`, `inertial` | a body; one without `inertial` is massless |
//! | `joint` of type revolute, continuous, prismatic, fixed, floating | the joint; planar joints are refused |
//! | `limit`, `dynamics` | data of the joint |
//! | `mimic` | a [`Mimic`], for a constraint |
//! | `visual` | a [`Visual`], for pictures, without the scale of a mesh; one without geometry or of another shape is left out |
//! | `collision`, `material`, `transmission`, `gazebo`, `safety_controller`, `calibration` | nothing: they move nothing |
//!
//! Any other element is refused with its line.

mod parse;

use std::path::Path;

use crate::error::MultibodyError;
use crate::files::{Element, FileInertias, Visual, document, read_text};
use crate::loops::{ClosedTree, LoopClosure};
use crate::tree::RigidTree;

/// How the root of a file stands on the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UrdfBase {
    /// Fixed to the ground.
    #[default]
    Fixed,
    /// Free to move.
    Free,
}

/// What the caller decides about a file.
///
/// # Example
/// ```
/// use piola_multibody::{UrdfBase, FileInertias, UrdfOptions};
/// let options = UrdfOptions { inertias: FileInertias::AsGiven, ..UrdfOptions::default() };
/// assert_eq!(options.base, UrdfBase::Fixed);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct UrdfOptions {
    /// How the root stands.
    pub base: UrdfBase,
    /// What to do with an inertia that is physically impossible.
    pub inertias: FileInertias,
}

/// A joint that a file ties to another: q = `multiplier` q' + `offset`.
#[derive(Clone, Debug, PartialEq)]
pub struct Mimic {
    /// The joint that follows.
    pub joint: String,
    /// The joint that it follows.
    pub follows: String,
    /// The ratio.
    pub multiplier: f64,
    /// The coordinate where the other's is zero.
    pub offset: f64,
}

/// A tree that was read, with what a tree does not hold.
///
/// # Example
/// A pendulum in ten lines.
/// ```
/// use piola_multibody::{Urdf, UrdfOptions};
/// let text = r#"<robot name="pendulum"><link name="wall"/>
///   <link name="bob"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
///     <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
///   <joint name="hinge" type="continuous"><parent link="wall"/><child link="bob"/><axis xyz="0 1 0"/></joint></robot>"#;
/// let robot = Urdf::parse(text, UrdfOptions::default())?;
/// let mut torque = [0.0];
/// robot.tree.gravity_forces(&mut robot.tree.workspace(), &[0.0], &mut torque)?;
/// assert_eq!((robot.name.as_str(), torque), ("pendulum", [-9.81]));
/// # Ok::<(), piola_multibody::MultibodyError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Urdf {
    /// The name of the robot.
    pub name: String,
    /// The tree.
    pub tree: RigidTree,
    /// Joints that follow others: the tree leaves them free.
    pub mimics: Vec<Mimic>,
    /// What the bodies look like.
    pub visuals: Vec<Visual>,
}

impl Urdf {
    /// Reads a tree from the text of a file.
    ///
    /// # Errors
    /// [`MultibodyError::InFile`] with the line, for all that the text violates; else as
    /// [`RigidTreeBuilder::attach`](crate::RigidTreeBuilder::attach) and
    /// [`build`](crate::RigidTreeBuilder::build).
    pub fn parse(text: &str, options: UrdfOptions) -> Result<Self, MultibodyError> {
        Self::of(document(text)?.root_element(), options)
    }

    /// The tree of the first element of a document.
    pub(crate) fn of(root: Element<'_>, options: UrdfOptions) -> Result<Self, MultibodyError> {
        parse::parse(root, options)
    }

    /// The tree with a gear for each mimic joint.
    ///
    /// # Errors
    /// [`MultibodyError::NoSuchName`] for a mimic of a joint that does not exist;
    /// [`MultibodyError::NoSuchIndex`] where one of the joints has no single coordinate.
    pub fn with_mimics(&self) -> Result<ClosedTree, MultibodyError> {
        let mut closed = ClosedTree::new(self.tree.clone());
        let freedom = |name: &str| {
            let place = self.tree.joints().iter().find(|place| place.joint.name == name);
            let missing = || MultibodyError::NoSuchName { what: "joint", name: name.to_owned() };
            place.map(|place| place.first_freedom).ok_or_else(missing)
        };
        for mimic in &self.mimics {
            let gear = LoopClosure::Gear {
                follower: freedom(&mimic.joint)?,
                leader: freedom(&mimic.follows)?,
                ratio: mimic.multiplier,
                offset: mimic.offset,
            };
            closed.close(format!("{} mimics {}", mimic.joint, mimic.follows), gear)?;
        }
        Ok(closed)
    }

    /// Reads a tree from a file.
    ///
    /// # Errors
    /// [`MultibodyError::UnreadableFile`], also for what is no file, as a directory or a device;
    /// [`MultibodyError::FileTooLong`] above 16 MiB; as [`parse`](Self::parse).
    pub fn read(path: &Path, options: UrdfOptions) -> Result<Self, MultibodyError> {
        Self::parse(&read_text(path)?, options)
    }
}
