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
/// `piola-scene` makes one of a scene with `[robot]`.
///
/// # Example
/// A pendulum of 1 kg and 1 m swings from the horizontal for a second.
/// ```
/// use piola_multibody::{BodyIndex, BodyInertia, ClosedTree, JointKind, RigidTree, TreeJoint};
/// use piola_simulation::motion::TimeSpan;
/// use piola_studies::Outcome;
/// use piola_studies::robot::{JointDrive, RobotStudy};
/// use std::{f64::consts::PI, ops::ControlFlow};
/// let hinge = JointKind::Revolute { axis: [0.0, 1.0, 0.0] };
/// let bob = BodyInertia::new(1.0, [0.0, 0.0, -1.0], [[1e-3, 0.0, 0.0], [0.0, 1e-3, 0.0], [0.0, 0.0, 1e-3]])?;
/// let mut builder = RigidTree::builder();
/// builder.attach(BodyIndex::GROUND, TreeJoint::new("hinge", hinge), "bob", bob)?;
/// let drive = JointDrive { coordinate: Some(0), effort: 0.0, limits: [-PI, PI] };
/// let pendulum = RobotStudy {
///     file: "pendulum.urdf".into(),
///     closed: ClosedTree::new(builder.build()?),
///     visuals: vec![],
///     time: TimeSpan { start: 0.0, end: 1.0 },
///     tolerance: 1e-10,
///     samples: 11,
///     animation: false,
///     stops: false,
///     moved: 0.0,
///     start: (vec![PI / 2.0], vec![0.0]),
///     drives: vec![drive],
///     names: [vec!["hinge".into()], vec!["hinge".into()]],
///     slip_rate: 1e-3,
///     has_joint_forces: true,
///     motors: vec![],
/// };
/// let (found, outcome) = pendulum.run(None, None, &mut |_| ControlFlow::Continue(()));
/// assert_eq!(outcome, Outcome::Completed);
/// assert!(found.samples.len() == 11 && found.energy_error < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
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
    /// Instants that are recorded, at least two.
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
///
/// # Example
/// See [`RobotStudy`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointDrive {
    /// The coordinate of a freedom that is the rate of one.
    pub coordinate: Option<usize>,
    /// Constant torque or force, N m or N.
    pub effort: f64,
    /// Lower and upper limit of the coordinate.
    pub limits: [f64; 2],
}
