//! Wrong input is refused by name, and nothing is half done.

use piola_kinematics::KinematicsError;
use piola_multibody::{
    BatchWorkspace, BodyIndex, BodyInertia, JointKind, MultibodyError, RigidTree, StateBlocks, TreeJoint,
};

use piola_testkit::{Tol, assert_close};

use crate::trees::{branched, chain, rod, state_of};

const Y: JointKind = JointKind::Revolute { axis: [0.0, 1.0, 0.0] };

#[test]
fn states_that_are_not_finite_are_refused_by_name() {
    let tree = chain(3);
    let mut work = tree.workspace();
    let mut out = [0.0; 3];
    let zero = [0.0; 3];
    for index in 0..3 {
        let mut wrong = zero;
        wrong[index] = f64::NAN;
        let refused = |quantity: &'static str, error: MultibodyError| {
            assert!(matches!(error, MultibodyError::NotFinite { quantity: q, index: i, value }
                if q == quantity && i == index && value.is_nan()));
        };
        refused("q", tree.inverse_dynamics(&mut work, &wrong, &zero, &zero, &mut out).unwrap_err());
        refused("v", tree.inverse_dynamics(&mut work, &zero, &wrong, &zero, &mut out).unwrap_err());
        refused("a", tree.inverse_dynamics(&mut work, &zero, &zero, &wrong, &mut out).unwrap_err());
        refused("q", tree.forward_dynamics(&mut work, &wrong, &zero, &zero, &mut out).unwrap_err());
        refused("v", tree.forward_dynamics(&mut work, &zero, &wrong, &zero, &mut out).unwrap_err());
        refused("tau", tree.forward_dynamics(&mut work, &zero, &zero, &wrong, &mut out).unwrap_err());
        refused("q", tree.mass_matrix(&mut work, &wrong, &mut [0.0; 9]).unwrap_err());
        refused("v", tree.coriolis_matrix(&mut work, &zero, &wrong, &mut [0.0; 9]).unwrap_err());
    }
}

#[test]
fn lengths_and_workspaces_that_do_not_fit_are_refused() {
    let tree = chain(3);
    let mut work = tree.workspace();
    let error = tree.inverse_dynamics(&mut work, &[0.0; 2], &[0.0; 3], &[0.0; 3], &mut [0.0; 3]).unwrap_err();
    assert_eq!(error, MultibodyError::WrongLength { quantity: "q", expected: 3, found: 2 });
    let error = tree.mass_matrix(&mut work, &[0.0; 3], &mut [0.0; 3]).unwrap_err();
    assert_eq!(error, MultibodyError::WrongLength { quantity: "out", expected: 9, found: 3 });
    let mut other = chain(2).workspace();
    let error = tree.gravity_forces(&mut other, &[0.0; 3], &mut [0.0; 3]).unwrap_err();
    assert_eq!(error, MultibodyError::OtherWorkspace { expected: 3, found: 2 });
}

#[test]
fn quaternions_without_unit_length_are_refused() {
    let tree = branched();
    let mut state = state_of(&tree, 1);
    state.q[..4].iter_mut().for_each(|x| *x *= 2.0);
    let mut out = vec![0.0; tree.freedoms()];
    let error = tree.inverse_dynamics(&mut tree.workspace(), &state.q, &state.v, &state.a, &mut out).unwrap_err();
    assert!(matches!(error, MultibodyError::NotUnitQuaternion { joint, length }
        if joint == "joint 0" && (length - 2.0).abs() < 1e-12));
}

#[test]
fn names_axes_and_data_of_joints_are_checked() {
    let mut builder = RigidTree::builder();
    builder.attach(BodyIndex::GROUND, TreeJoint::new("a", Y), "one", rod()).unwrap();
    let error = builder.attach(BodyIndex::GROUND, TreeJoint::new("a", Y), "two", rod()).unwrap_err();
    assert_eq!(error, MultibodyError::DuplicateName { what: "joints", name: "a".into() });
    let error = builder.attach(BodyIndex::GROUND, TreeJoint::new("b", Y), "one", rod()).unwrap_err();
    assert_eq!(error, MultibodyError::DuplicateName { what: "bodies", name: "one".into() });
    let oblique = JointKind::Revolute { axis: [1.0, 1.0, 0.0] };
    let error = builder.attach(BodyIndex::GROUND, TreeJoint::new("b", oblique), "two", rod()).unwrap_err();
    assert!(matches!(error, MultibodyError::AxisNotUnit { joint, .. } if joint == "b"));
    let joint = TreeJoint::new("b", Y).with_armature(-1.0);
    let error = builder.attach(BodyIndex::GROUND, joint, "two", rod()).unwrap_err();
    assert!(matches!(error, MultibodyError::InvalidJointData { quantity: "reflected inertia", .. }));
    let joint = TreeJoint::new("b", JointKind::Free).with_armature(0.1);
    let error = builder.attach(BodyIndex::GROUND, joint, "two", rod()).unwrap_err();
    assert_eq!(error.to_string(), "the reflected inertia of joint `b` is 0.1; it must satisfy x = 0 for a free joint");
    let joint = TreeJoint::new("b", Y).at([0.0, f64::INFINITY, 0.0]);
    let error = builder.attach(BodyIndex::GROUND, joint, "two", rod()).unwrap_err();
    assert!(matches!(error, MultibodyError::InvalidJointData { quantity: "origin", .. }));
    // None of these left a trace.
    let tree = builder.build().unwrap();
    assert_eq!((tree.bodies(), tree.freedoms()), (1, 1));
}

#[test]
fn inertias_are_checked_or_taken_as_given() {
    let impossible = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 3.0]];
    let error = BodyInertia::new(1.0, [0.0; 3], impossible).unwrap_err();
    assert!(matches!(error, KinematicsError::InertiaTriangleInequality { .. }));
    assert!(BodyInertia::as_given(1.0, [0.0; 3], impossible).is_ok());
    let error = BodyInertia::new(1.0, [0.0; 3], [[0.0; 3]; 3]).unwrap_err();
    assert!(matches!(error, KinematicsError::InertiaNotPositiveDefinite { .. }));
    assert!(BodyInertia::as_given(0.0, [0.0; 3], [[0.0; 3]; 3]).is_ok());
    let error = BodyInertia::as_given(-1.0, [0.0; 3], impossible).unwrap_err();
    assert!(matches!(error, KinematicsError::NonPositiveMass { .. }));
    let skewed = [[1.0, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let error = BodyInertia::as_given(1.0, [0.0; 3], skewed).unwrap_err();
    assert!(matches!(error, KinematicsError::InertiaNotSymmetric { row: 0, column: 1, .. }));
}

#[test]
fn joints_that_move_no_inertia_are_named() {
    let mut builder = RigidTree::builder();
    builder.attach(BodyIndex::GROUND, TreeJoint::new("idle", Y), "nothing", BodyInertia::MASSLESS).unwrap();
    let error = builder.build().unwrap_err();
    assert!(matches!(error, MultibodyError::NoInertia { joint, .. } if joint == "idle"));
    // A particle on the axis has mass but no inertia about it.
    let mut builder = RigidTree::builder();
    let bob = BodyInertia::particle(1.0, [0.0, 2.0, 0.0]).unwrap();
    builder.attach(BodyIndex::GROUND, TreeJoint::new("idle", Y), "bob", bob).unwrap();
    let tree = builder.build().unwrap();
    let error = tree.forward_dynamics(&mut tree.workspace(), &[0.0], &[0.0], &[1.0], &mut [0.0]).unwrap_err();
    assert!(matches!(error, MultibodyError::NoInertia { joint, inertia } if joint == "idle" && inertia.abs() <= 0.0));
    // So has one on the second axis of a joint with two.
    let cross = JointKind::Universal { first: [1.0, 0.0, 0.0], second: [0.0, 1.0, 0.0] };
    let mut builder = RigidTree::builder();
    builder.attach(BodyIndex::GROUND, TreeJoint::new("cross", cross), "bob", bob).unwrap();
    let tree = builder.build().unwrap();
    let error =
        tree.forward_dynamics(&mut tree.workspace(), &[0.0; 2], &[0.0; 2], &[1.0; 2], &mut [0.0; 2]).unwrap_err();
    assert!(matches!(error, MultibodyError::NoInertia { joint, .. } if joint == "cross"));
    // An impossible inertia is told with its number.
    let impossible =
        BodyInertia::as_given(1.0, [0.0; 3], [[1.0, 0.0, 0.0], [0.0, -0.5, 0.0], [0.0, 0.0, 1.0]]).unwrap();
    let mut builder = RigidTree::builder();
    builder.attach(BodyIndex::GROUND, TreeJoint::new("float", JointKind::Free), "body", impossible).unwrap();
    let tree = builder.build().unwrap();
    let (q, mut out) = ([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 6]);
    let error = tree.forward_dynamics(&mut tree.workspace(), &q, &[0.0; 6], &[0.0; 6], &mut out).unwrap_err();
    let MultibodyError::NoInertia { joint, inertia } = error else { panic!("{error}") };
    assert_eq!(joint, "float");
    assert_close("inertia", &[inertia], &[-0.5], Tol::ulps(2.0));
    // The motor of the first has.
    let mut builder = RigidTree::builder();
    let joint = TreeJoint::new("geared", Y).with_armature(0.5);
    builder.attach(BodyIndex::GROUND, joint, "bob", bob).unwrap();
    let tree = builder.build().unwrap();
    let mut out = [0.0];
    tree.forward_dynamics(&mut tree.workspace(), &[0.0], &[0.0], &[1.0], &mut out).unwrap();
    assert_close("1/armature", &out, &[2.0], Tol::ulps(2.0));
}

#[test]
fn fixed_joints_become_parts_of_their_parents() {
    let mut builder = RigidTree::builder();
    let arm = builder.attach(BodyIndex::GROUND, TreeJoint::new("hinge", Y), "arm", rod()).unwrap();
    let joint = TreeJoint::new("weld", JointKind::Fixed).at([0.0, 0.0, -1.0]);
    let tip = builder.attach(arm, joint, "tip", BodyInertia::particle(1.0, [0.0; 3]).unwrap()).unwrap();
    let tree = builder.build().unwrap();
    assert_eq!((tree.links(), tree.bodies()), (1, 2));
    let mut matrix = [0.0_f64];
    tree.mass_matrix(&mut tree.workspace(), &[0.4], &mut matrix).unwrap();
    // 0.084 + ¼ of the rod, 1 of the particle.
    assert!((matrix[0] - 1.334).abs() < 4.0 * f64::EPSILON);
    let mut work = tree.workspace();
    tree.forward_kinematics(&mut work, &[0.0]).unwrap();
    assert_close("tip", &tree.place_of(&work, tip).unwrap().origin, &[0.0, 0.0, -1.0], Tol::ulps(2.0));
}

#[test]
fn wrong_state_of_a_batch_is_named() {
    let tree = chain(3);
    let mut work = BatchWorkspace::new(&tree, 1);
    let zeros = StateBlocks::new(3, 21);
    let mut wrong = zeros.clone();
    wrong.set(13, &[0.0, f64::INFINITY, 0.0]).unwrap();
    let mut out = zeros.clone();
    let error = tree.forward_dynamics_of_states(&mut work, &zeros, &wrong, &zeros, &mut out).unwrap_err();
    let source = MultibodyError::NotFinite { quantity: "v", index: 1, value: f64::INFINITY };
    assert_eq!(error, MultibodyError::InState { state: 13, source: Box::new(source) });
    let error = wrong.set(21, &[0.0; 3]).unwrap_err();
    assert!(matches!(error, MultibodyError::NoSuchIndex { what: "state", index: 21, count: 21 }));
}

/// In single precision rounding leaves more of a motion without inertia, and it is none either.
#[test]
fn massless_base_is_refused_in_single_precision_in_every_position() {
    let mut builder = RigidTree::builder();
    let free = TreeJoint::new("float", JointKind::Free);
    let base = builder.attach(BodyIndex::GROUND, free, "base", BodyInertia::MASSLESS).unwrap();
    let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.36, 0.48, 0.8] });
    builder.attach(base, hinge, "arm", rod()).unwrap();
    let tree = builder.build().unwrap();
    let mut work = tree.workspace();
    for k in 0..40_u8 {
        let (q, mut out) = ([1.0, 0.0, 0.0, 0.0, 0.1, 0.2, 0.3, 0.17 * f32::from(k)], [0.0; 7]);
        let result = tree.forward_dynamics(&mut work, &q, &[0.0; 7], &[1.0; 7], &mut out);
        let Err(MultibodyError::TooLightBody { body, .. }) = result else { panic!("{k}: {result:?} {out:?}") };
        assert_eq!(body, "base");
    }
}

/// A massless base that is free is at the mercy of the joints beyond it: closures do not hold it in the tree.
#[test]
fn massless_free_base_is_refused_by_its_name_with_the_reason() {
    use piola_multibody::{BodyPoint, ClosedTree, LoopClosure};
    let mut builder = RigidTree::builder();
    let free = TreeJoint::new("float", JointKind::Free);
    let base = builder.attach(BodyIndex::GROUND, free, "base", BodyInertia::MASSLESS).unwrap();
    let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
    let arm = rod();
    builder.attach(base, hinge, "arm", arm).unwrap();
    let tree = builder.build().unwrap();
    let mut closed = ClosedTree::new(tree.clone());
    let pin = [base, BodyIndex::GROUND].map(|body| BodyPoint::new(body, [0.0; 3]));
    closed.close("pin", LoopClosure::Point { first: pin[0], second: pin[1] }).unwrap();
    let q = [0.8, 0.6, 0.0, 0.0, 0.1, 0.2, 0.3, 0.4];
    let (zeros, mut out) = ([0.0; 7], [0.0; 7]);
    let error = closed.accelerations(&mut closed.workspace(), &q, &zeros, &zeros, 0.0, &mut out).unwrap_err();
    let MultibodyError::TooLightBody { body, joint, mass, inertia } = &error else { panic!("{error}") };
    assert_eq!((body.as_str(), joint.as_str()), ("base", "float"));
    assert!(*mass <= 0.0 && inertia.abs() < 1e-12, "{error}");
    assert!(error.to_string().contains("closures do not count here"), "{error}");
    // A joint with nothing beyond it keeps its own error.
    let mut builder = RigidTree::builder();
    let free = TreeJoint::new("float", JointKind::Free);
    builder.attach(BodyIndex::GROUND, free, "base", BodyInertia::MASSLESS).unwrap();
    assert!(matches!(builder.build().unwrap_err(), MultibodyError::NoInertia { joint, .. } if joint == "float"));
}
