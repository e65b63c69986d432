//! The motion of a tree of rigid bodies from a URDF or MJCF file.

mod build;
mod checkpoint;
mod figure;
mod gltf;
mod results;
mod run;
mod sample;

use std::path::PathBuf;

use piola_multibody::{ClosedTree, TreeJoint, Visual};

use super::StudyPlan;
use crate::model::TimeSpan;
use piola_document::words;

pub(super) use checkpoint::RobotCheckpoint;
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

impl RobotStudy {
    /// Fills a plan; the tables and figures of this study.
    pub(super) fn plan(&self, plan: &mut StudyPlan) -> (&'static [&'static str], &'static [&'static str]) {
        let tree = self.closed.tree();
        let file = self.file.file_name().unwrap_or_default().display();
        plan.system = format!("robot of {} bodies with {} freedoms from {file}", tree.bodies(), tree.freedoms());
        plan.method = format!(
            "dormand-prince-853, relative and absolute tolerance {:e}, {} s to {} s, recorded at {} instants",
            self.tolerance,
            words::number(self.time.start),
            words::number(self.time.end),
            self.samples
        );
        plan.reason = "articulated bodies: each evaluation takes time in proportion to the joints".to_string();
        plan.compute("accelerations", format!("{} links behind elementary joints", tree.links()));
        let built = tree.plan();
        if !built.merged.is_empty() {
            plan.skip("fixed joints", format!("merged when the tree is built: {}", built.merged.len()));
        }
        if 0 < built.aligned {
            let what = format!("{} of {} turns are about a coordinate axis", built.aligned, built.turns);
            plan.skip("products of matrices", what);
        }
        if self.closed.conditions() == 0 {
            plan.skip("closures", "no [[closure]], mimic joint or locked joint");
        } else {
            let count = self.closed.conditions();
            let plural = if count == 1 { "" } else { "s" };
            let what = format!("{count} condition{plural}, by multipliers");
            plan.compute("closures", format!("{what}; coordinates move by at most {:.1e} to satisfy them", self.moved));
            let how = if self.stops { "the run stops before them" } else { "passed on the branch of the velocity" };
            plan.compute("singular positions", how);
        }
        self.plan_joint_forces(plan);
        plan.compute(
            "energy balance",
            "energies less the work of torques, damping and friction, at every recorded instant",
        );
        plan.skip("limits of joints", "not enforced: the summary names the joints that leave them");
        if !self.motors.is_empty() {
            let motors = self.motors.join(", ");
            plan.skip("motors of the file", format!("not driven, [[drive]] sets a torque or force: {motors}"));
        }
        plan.skip("contact", "bodies pass through each other");
        if self.animation {
            plan.files.push("motion.gltf".to_string());
        } else {
            plan.skip("animation", "robot.animation = false");
        }
        (&["coordinates.csv", "energies.csv"], &["coordinates.svg", "energies.svg"])
    }

    /// Which springs, dampers and friction act.
    fn plan_joint_forces(&self, plan: &mut StudyPlan) {
        let names = |has: fn(&TreeJoint) -> bool| -> Vec<&str> {
            let joints = self.closed.tree().joints().iter().map(|place| &place.joint);
            joints.filter(|joint| has(joint)).map(|joint| joint.name.as_str()).collect()
        };
        let (springs, dampers) = (names(|joint| 0.0 < joint.stiffness), names(|joint| 0.0 < joint.damping));
        let frictions = names(|joint| 0.0 < joint.friction);
        let slip = format!("friction, smoothed below {}", words::number(self.slip_rate));
        let kinds = [("springs".to_string(), springs), ("dampers".to_string(), dampers), (slip, frictions)];
        let acting = kinds.iter().filter(|(_, names)| !names.is_empty());
        let acting: Vec<String> = acting.map(|(kind, names)| format!("{kind}: {}", names.join(", "))).collect();
        if !acting.is_empty() {
            plan.compute("forces of joints", acting.join("; "));
        }
        let reflected = names(|joint| 0.0 < joint.armature);
        if !reflected.is_empty() {
            plan.compute("reflected inertias", reflected.join(", "));
        }
        if !self.has_joint_forces {
            plan.skip("springs, dampers and friction of the file", "robot.joint_forces = \"none\"");
        } else if acting.is_empty() {
            plan.skip("forces of joints", "neither the file nor a [[drive]] gives springs, dampers or friction");
        }
    }
}
