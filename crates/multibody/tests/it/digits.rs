//! A chain of three bodies against values of 30 digits, which were found from the placement alone.

use piola_multibody::{AccelerationDerivatives, BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
use piola_testkit::{Tol, assert_close};
use serde_json::Value;

const DATA: &str = include_str!("../../../../testdata/reference/tree_of_bodies.json");

/// The chain of `testdata/scripts/tree_of_bodies.py`.
fn tree() -> RigidTree {
    let joints = [
        TreeJoint::new("a", JointKind::Revolute { axis: [0.6, 0.0, 0.8] }).at([0.0, 0.125, 0.25]),
        TreeJoint::new("b", JointKind::Prismatic { axis: [0.0, -0.8, 0.6] }).at([0.5, 0.0, -0.25]),
        TreeJoint::new("c", JointKind::Revolute { axis: [0.0, 1.0, 0.0] }).at([-0.25, 0.375, 0.5]),
    ];
    let masses = [1.5, 0.75, 2.0];
    let centres = [[0.125, 0.0, -0.5], [0.0, 0.25, 0.125], [-0.375, 0.125, 0.25]];
    let moments = [[0.25, 0.375, 0.5], [0.125, 0.125, 0.1875], [0.5, 0.375, 0.25]];
    let mut builder = RigidTree::builder();
    let mut parent = BodyIndex::GROUND;
    for (i, joint) in joints.into_iter().enumerate() {
        let [x, y, z] = moments[i];
        let about_centre = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
        let inertia = BodyInertia::new(masses[i], centres[i], about_centre).unwrap();
        parent = builder.attach(parent, joint, format!("body {i}"), inertia).unwrap();
    }
    builder.build().unwrap()
}

/// Numbers, also those written as text, of lists in lists.
fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        Value::String(text) => vec![text.parse().unwrap()],
        other => vec![other.as_f64().unwrap()],
    }
}

#[test]
fn chain_of_three_bodies_has_the_thirty_digits() {
    let data: Value = serde_json::from_str(DATA).unwrap();
    let [q, v, tau] = ["q", "v", "tau"].map(|key| numbers(&data[key]));
    let tree = tree();
    let mut work = tree.workspace();
    let mut matrix = [0.0; 9];
    tree.mass_matrix(&mut work, &q, &mut matrix).unwrap();
    let rounding = Tol::ulps(64.0);
    assert_close("M", &matrix, &numbers(&data["mass_matrix"]), rounding);
    let mut out = AccelerationDerivatives::new(&tree);
    tree.forward_dynamics_derivatives(&mut work, &q, &v, &tau, &mut out).unwrap();
    assert_close("v̇", &out.acceleration, &numbers(&data["acceleration"]), rounding);
    assert_close("∂v̇/∂q", &out.by_q, &numbers(&data["by_q"]), rounding);
    assert_close("∂v̇/∂v", &out.by_v, &numbers(&data["by_v"]), rounding);
    assert_close("∂v̇/∂τ", &out.by_tau, &numbers(&data["by_tau"]), rounding);
}
