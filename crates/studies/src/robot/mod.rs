//! The motion of a tree of rigid bodies from a URDF or MJCF file.

mod checkpoint;
mod run;
mod sample;

use std::path::PathBuf;

use piola_multibody::{ClosedTree, Visual};

use piola_simulation::motion::TimeSpan;

pub use checkpoint::RobotCheckpoint;
pub use run::RobotMotion;
pub use sample::RobotSample;

/// A tree with all that starts and drives it.
///
/// # Example
/// ```no_run
/// use piola_scene::studies::Subject;
/// use piola_scene::SceneFile;
/// let file = SceneFile::load("scenes/two-link-arm.toml".as_ref(), &[])?;
/// let SceneFile::Study(study) = file else { panic!() };
/// let Subject::Robot(robot) = study.subject else { panic!() };
/// assert_eq!(robot.closed.tree().freedoms(), 2);
/// # Ok::<(), piola_scene::SceneError>(())
/// ```
#[derive(Debug, Clone)]
pub struct RobotStudy {
    /// The file.
    pub file: PathBuf,
    /// The tree with its closures: mimic joints, locked joints and loops.
    pub closed: ClosedTree,
    /// What the bodies look like.
    pub visuals: Vec<Visual>,
    /// The span of time.
    pub time: TimeSpan,
    /// Tolerance of a step: relative, and absolute in SI units.
    pub tolerance: f64,
    /// Instants that are recorded.
    pub samples: u32,
    /// Whether the motion is written for viewers.
    pub animation: bool,
    /// Whether the run stops before singular positions.
    pub stops: bool,
    /// By how much the closures move a coordinate of the start at most, rad or m.
    pub moved: f64,
    /// Coordinates and rates at the start, on the closures.
    pub start: (Vec<f64>, Vec<f64>),
    /// What drives each freedom.
    pub drives: Vec<JointDrive>,
    /// The names of the coordinates, and of the rates.
    pub names: [Vec<String>; 2],
    /// Rate below which Coulomb friction is smoothed, rad/s or m/s.
    pub slip_rate: f64,
    /// Whether the springs, dampers and friction of the file act.
    pub has_joint_forces: bool,
    /// The joints that have a motor in the file.
    pub motors: Vec<String>,
}

/// What drives a freedom, besides the springs, dampers and friction of the tree's joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointDrive {
    /// The coordinate of a freedom that is the rate of one.
    pub coordinate: Option<usize>,
    /// Constant torque or force, N m or N.
    pub effort: f64,
    /// Lower and upper limit of the coordinate.
    pub limits: [f64; 2],
}
