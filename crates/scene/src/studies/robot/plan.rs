//! The plan.

use piola_document::words;
use piola_multibody::TreeJoint;

use super::RobotStudy;
use crate::studies::StudyPlan;

/// Fills a plan; the tables and figures of this study.
pub(in crate::studies) fn plan(
    asked: &RobotStudy,
    plan: &mut StudyPlan,
) -> (&'static [&'static str], &'static [&'static str]) {
    let tree = asked.closed.tree();
    let file = asked.file.file_name().unwrap_or_default().display();
    plan.system = format!("robot of {} bodies with {} freedoms from {file}", tree.bodies(), tree.freedoms());
    plan.method = format!(
        "dormand-prince-853, relative and absolute tolerance {:e}, {} s to {} s, recorded at {} instants",
        asked.tolerance,
        words::number(asked.time.start),
        words::number(asked.time.end),
        asked.samples
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
    if asked.closed.conditions() == 0 {
        plan.skip("closures", "no [[closure]], mimic joint or locked joint");
    } else {
        let count = asked.closed.conditions();
        let plural = if count == 1 { "" } else { "s" };
        let what = format!("{count} condition{plural}, by multipliers");
        plan.compute("closures", format!("{what}; coordinates move by at most {:.1e} to satisfy them", asked.moved));
        let how = if asked.stops { "the run stops before them" } else { "passed on the branch of the velocity" };
        plan.compute("singular positions", how);
    }
    plan_joint_forces(asked, plan);
    plan.compute(
        "energy balance",
        "energies less the work of torques, damping and friction, at every recorded instant",
    );
    plan.skip("limits of joints", "not enforced: the summary names the joints that leave them");
    if !asked.motors.is_empty() {
        let motors = asked.motors.join(", ");
        plan.skip("motors of the file", format!("not driven, [[drive]] sets a torque or force: {motors}"));
    }
    plan.skip("contact", "bodies pass through each other");
    if asked.animation {
        plan.files.push("motion.gltf".to_string());
    } else {
        plan.skip("animation", "robot.animation = false");
    }
    (&["coordinates.csv", "energies.csv"], &["coordinates.svg", "energies.svg"])
}

/// Which springs, dampers and friction act.
fn plan_joint_forces(asked: &RobotStudy, plan: &mut StudyPlan) {
    let names = |has: fn(&TreeJoint) -> bool| -> Vec<&str> {
        let joints = asked.closed.tree().joints().iter().map(|place| &place.joint);
        joints.filter(|joint| has(joint)).map(|joint| joint.name.as_str()).collect()
    };
    let (springs, dampers) = (names(|joint| 0.0 < joint.stiffness), names(|joint| 0.0 < joint.damping));
    let frictions = names(|joint| 0.0 < joint.friction);
    let slip = format!("friction, smoothed below {}", words::number(asked.slip_rate));
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
    if !asked.has_joint_forces {
        plan.skip("springs, dampers and friction of the file", "robot.joint_forces = \"none\"");
    } else if acting.is_empty() {
        plan.skip("forces of joints", "neither the file nor a [[drive]] gives springs, dampers or friction");
    }
}
