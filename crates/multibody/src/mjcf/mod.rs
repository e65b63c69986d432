//! Trees from MJCF files, the models of MuJoCo: their core.
//!
//! | element | read as |
//! |---|---|
//! | `compiler` | `angle`, `autolimits`, `eulerseq`, `inertiafromgeom`, `inertiagrouprange`; only local coordinates |
//! | `option` | `gravity`; a medium (`density`, `viscosity`) is refused |
//! | `default` | default attributes of a class |
//! | `worldbody`, `body`, `frame` | bodies, each in its parent's frame |
//! | `inertial`, or else the `geom`s of a body | its inertia: sphere, capsule, cylinder, box, ellipsoid |
//! | `joint`, `freejoint` | a joint; several of a body are in series |
//! | `asset` with `mesh` | names of files, for pictures: scale and pose of a mesh are not read |
//! | `site` with a name | a frame |
//! | `equality` with `connect`, `weld`, `joint` | closures, which hold exactly; a `joint` must be linear |
//! | `actuator` with `motor` at a hinge or slide | a [`FileMotor`] |
//!
//! Elements that move nothing are passed over with their attributes and listed in [`Mjcf::skipped`]. Any other element or
//! attribute is refused with its line: tendons, other actuators, pairs of contacts, mesh geoms whose mass is needed. Attributes
//! of contact, pictures and MuJoCo's solver have no effect. Contact between geoms is not modelled.
//!
//! Bodies, joints and closures without a name get one, as `body 3`, unlike any name of the file.
//!
//! Bodies, joints and coordinates stand in the order of the file. The configuration differs from MuJoCo's in free joints alone:
//! quaternion and then position here, velocities in the body's axes.
//!
//! # References
//! E. Todorov, T. Erez & Y. Tassa, *MuJoCo: a physics engine for model-based control*, IROS (2012); the format's reference at
//! <https://mujoco.readthedocs.io/en/stable/XMLreference.html>.

mod bodies;
mod element;
mod equality;
mod geoms;
mod joints;
mod place;
mod reader;
mod settings;

use std::path::Path;

use crate::error::MultibodyError;
use crate::files::{Element, FileInertias, Visual, document, read_text};
use crate::loops::{ClosedTree, LoopClosure};
use crate::tree::RigidTree;

/// What the caller decides about an MJCF file.
///
/// # Example
/// ```
/// use piola_multibody::{FileInertias, MjcfOptions};
/// assert_eq!(MjcfOptions::default().inertias, FileInertias::Checked);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MjcfOptions {
    /// What to do with an `inertial` that is physically impossible.
    pub inertias: FileInertias,
}

/// A motor of a file: the torque or force on its joint is `gear` times the control.
///
/// # Example
/// See [`Mjcf`].
#[derive(Clone, Debug, PartialEq)]
pub struct FileMotor {
    /// Its name; empty where the file gives none.
    pub name: String,
    /// The joint.
    pub joint: String,
    /// The ratio.
    pub gear: f64,
    /// Lower and upper limit of the control: infinite where there is none.
    pub controls: [f64; 2],
}

/// An element that was passed over because it moves nothing.
///
/// # Example
/// See [`Mjcf`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SkippedElement {
    /// Its line, from 1.
    pub line: usize,
    /// Its name.
    pub element: String,
}

/// A tree that was read, with what a tree does not hold.
///
/// # Example
/// A pendulum of 2 kg at 0.5 m.
/// ```
/// use piola_multibody::{Mjcf, MjcfOptions};
/// let text = r#"<mujoco model="pendulum"><worldbody><light pos="0 0 3"/>
///   <body name="bob"><joint name="hinge" axis="0 1 0"/><geom size="0.1" pos="0.5 0 0" mass="2"/></body></worldbody>
///   <actuator><motor joint="hinge" gear="20"/></actuator></mujoco>"#;
/// let pendulum = Mjcf::parse(text, MjcfOptions::default())?;
/// let mut torque = [0.0];
/// pendulum.tree.gravity_forces(&mut pendulum.tree.workspace(), &pendulum.home, &mut torque)?;
/// assert_eq!((torque, pendulum.motors[0].gear), ([-9.81], 20.0));
/// assert_eq!(pendulum.skipped[0].element, "light");
/// # Ok::<(), piola_multibody::MultibodyError>(())
/// ```
#[doc(alias("MuJoCo", "mujoco"))]
#[derive(Clone, Debug)]
pub struct Mjcf {
    /// The name of the model.
    pub name: String,
    /// The tree.
    pub tree: RigidTree,
    /// The configuration in which the file places the bodies.
    pub home: Vec<f64>,
    /// Closures by their names: the tree leaves them open.
    pub closures: Vec<(String, LoopClosure)>,
    /// Motors.
    pub motors: Vec<FileMotor>,
    /// What the bodies look like: boxes, cylinders, spheres and meshes. A capsule is given as one cylinder and two spheres.
    /// Ellipsoids and planes are left out.
    pub visuals: Vec<Visual>,
    /// What was passed over, in the order of the lines.
    pub skipped: Vec<SkippedElement>,
}

impl Mjcf {
    /// Reads a tree from the text of a file.
    ///
    /// # Errors
    /// [`MultibodyError::InFile`] with the line, for all that the text violates; else as
    /// [`RigidTreeBuilder::build`](crate::RigidTreeBuilder::build).
    pub fn parse(text: &str, options: MjcfOptions) -> Result<Self, MultibodyError> {
        Self::of(document(text)?.root_element(), options)
    }

    /// The tree of the first element of a document.
    pub(crate) fn of(root: Element<'_>, options: MjcfOptions) -> Result<Self, MultibodyError> {
        bodies::parse(root, options)
    }

    /// Reads a tree from a file.
    ///
    /// # Errors
    /// [`MultibodyError::UnreadableFile`], also for what is no file, as a directory or a device;
    /// [`MultibodyError::FileTooLong`] above 16 MiB; as [`parse`](Self::parse).
    pub fn read(path: &Path, options: MjcfOptions) -> Result<Self, MultibodyError> {
        Self::parse(&read_text(path)?, options)
    }

    /// The tree with the closures of the file.
    ///
    /// # Errors
    /// As [`ClosedTree::close`].
    pub fn with_closures(&self) -> Result<ClosedTree, MultibodyError> {
        let mut closed = ClosedTree::new(self.tree.clone());
        for (name, closure) in &self.closures {
            closed.close(name.clone(), *closure)?;
        }
        Ok(closed)
    }
}
