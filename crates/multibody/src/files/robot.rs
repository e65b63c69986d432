//! Robots from files of either kind.

use std::path::Path;

use super::{Visual, document, fault, read_text};
use crate::error::{FileFault, MultibodyError};
use crate::loops::ClosedTree;
use crate::mjcf::{FileMotor, Mjcf, MjcfOptions, SkippedElement};
use crate::tree::RigidTree;
use crate::urdf::{Urdf, UrdfBase, UrdfOptions};

/// A robot that was read from a URDF or an MJCF file, whichever it is. It needs the features `urdf` and `mjcf`.
///
/// # Example
/// ```
/// use piola_multibody::{RobotFile, UrdfOptions};
/// let text = r#"<mujoco><worldbody><body name="arm"><joint name="hinge" axis="0 1 0" ref="90"/>
///   <geom size="0.1" pos="0.5 0 0" mass="2"/></body></worldbody></mujoco>"#;
/// let robot = RobotFile::parse(text, UrdfOptions::default())?;
/// assert_eq!((robot.closed.tree().freedoms(), robot.home[0]), (1, std::f64::consts::FRAC_PI_2));
/// # Ok::<(), piola_multibody::MultibodyError>(())
/// ```
#[derive(Clone, Debug)]
pub struct RobotFile {
    /// The name in the file.
    pub name: String,
    /// The tree with the closures of the file: mimic joints of URDF, equalities of MJCF.
    pub closed: ClosedTree,
    /// The configuration in which the file places the bodies.
    pub home: Vec<f64>,
    /// What the bodies look like.
    pub visuals: Vec<Visual>,
    /// Gravity of an MJCF file, m/s², which the tree has too; a URDF file says nothing of it.
    pub gravity: Option<[f64; 3]>,
    /// Motors of an MJCF file. Nothing drives them.
    pub motors: Vec<FileMotor>,
    /// What was passed over in an MJCF file.
    pub skipped: Vec<SkippedElement>,
}

impl RobotFile {
    /// Reads a robot from a text: MJCF where the first element is `mujoco`, else URDF.
    ///
    /// An MJCF file says itself which bodies are free: `options.base` must be fixed.
    ///
    /// # Errors
    /// As [`Urdf::parse`], [`Urdf::with_mimics`], [`Mjcf::parse`] and [`Mjcf::with_closures`].
    pub fn parse(text: &str, options: UrdfOptions) -> Result<Self, MultibodyError> {
        let document = document(text)?;
        let root = document.root_element();
        if root.tag_name().name() != "mujoco" {
            let urdf = Urdf::of(root, options)?;
            let mut home = vec![0.0; urdf.tree.coordinates()];
            urdf.tree.neutral_configuration(&mut home)?;
            let closed = urdf.with_mimics()?;
            let Urdf { name, visuals, .. } = urdf;
            return Ok(Self { name, closed, home, visuals, gravity: None, motors: Vec::new(), skipped: Vec::new() });
        }
        if options.base == UrdfBase::Free {
            let element = "a free base besides the free joints of the file".to_owned();
            return Err(fault(root, FileFault::Unsupported { element }));
        }
        let mjcf = Mjcf::of(root, MjcfOptions { inertias: options.inertias })?;
        let closed = mjcf.with_closures()?;
        let Mjcf { name, tree, home, motors, visuals, skipped, .. } = mjcf;
        Ok(Self { name, closed, home, visuals, gravity: Some(tree.gravity()), motors, skipped })
    }

    /// Reads a robot from a file.
    ///
    /// # Errors
    /// [`MultibodyError::UnreadableFile`], [`MultibodyError::FileTooLong`]; as [`parse`](Self::parse).
    pub fn read(path: &Path, options: UrdfOptions) -> Result<Self, MultibodyError> {
        Self::parse(&read_text(path)?, options)
    }

    /// The tree without closures.
    #[must_use]
    pub const fn tree(&self) -> &RigidTree {
        self.closed.tree()
    }
}
