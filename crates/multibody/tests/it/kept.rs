//! The kept mass matrix equals one that is computed anew, and counts what it keeps.

use piola_multibody::{BodyIndex, JointKind, KeptMassMatrix, MultibodyError, RigidTree, TreeJoint};
use piola_testkit::{Tol, allocations_in, assert_close};

use crate::trees::{chain, mixed, rod, state_of};

/// Every joint alone, then pairs, in a tree of all kinds of joints with branches.
#[test]
fn kept_mass_matrix_equals_one_computed_anew_whichever_joints_change() {
    let tree = mixed();
    let n = tree.freedoms();
    let [start, other] = [1, 2].map(|seed| state_of(&tree, seed).q);
    let (mut kept, mut work, mut expected) = (KeptMassMatrix::new(&tree), tree.workspace(), vec![0.0; n * n]);
    let mut fresh = tree.workspace();
    let joints = tree.joints();
    let mut compared = 0;
    kept.update(&start).unwrap();
    assert_eq!((kept.counts().places, kept.counts().inertias, kept.counts().columns), {
        let links = tree.links();
        (links, links, links)
    });
    for first in 0..joints.len() {
        for second in 0..joints.len() {
            let mut q = start.clone();
            for joint in [&joints[first], &joints[second]] {
                let own = joint.first_coordinate..joint.first_coordinate + joint.joint.kind.coordinates();
                q[own.clone()].copy_from_slice(&other[own]);
            }
            kept.update(&q).unwrap();
            tree.mass_matrix(&mut work, &q, &mut expected).unwrap();
            let rounding = Tol::ulps_because(512.0, "kept entries were computed elsewhere in space");
            assert_close("mass matrix", kept.mass_matrix(), &expected, rounding);
            tree.forward_kinematics(&mut fresh, &q).unwrap();
            let place = |work| tree.place_of(work, joints[first].child).unwrap();
            assert_close("origin", &place(kept.workspace()).origin, &place(&fresh).origin, Tol::ulps(64.0));
            compared += 1;
        }
    }
    assert_eq!(compared, joints.len() * joints.len());
}

#[test]
fn only_what_joints_change_is_computed() {
    let tree = chain(10);
    let mut q = vec![0.1; 10];
    let mut kept = KeptMassMatrix::new(&tree);
    kept.update(&q).unwrap();
    let (count, ()) = allocations_in(|| kept.update(&q).unwrap());
    assert_eq!(count, 0);
    assert_eq!((kept.counts().places, kept.counts().inertias, kept.counts().columns), (0, 0, 0));
    // The last three links move, and reshape the first seven. Columns of all change, because all inertias meet those.
    q[7] = 0.4;
    kept.update(&q).unwrap();
    assert_eq!((kept.counts().places, kept.counts().inertias, kept.counts().columns), (3, 7, 10));
    // The whole chain turns as one body: M stays.
    q[0] = 0.4;
    kept.update(&q).unwrap();
    assert_eq!((kept.counts().places, kept.counts().inertias, kept.counts().columns), (10, 0, 0));
    assert_eq!(
        kept.counts().to_string(),
        "of 10 links: 10 places computed, 0 kept; 0 composite inertias computed, 10 kept; columns of 0 links computed, of 10 kept"
    );
    let before = kept.mass_matrix().to_vec();
    let mut wrong = q.clone();
    wrong[4] = f64::INFINITY;
    let refused = kept.update(&wrong).unwrap_err();
    assert!(matches!(refused, MultibodyError::NotFinite { quantity: "q", index: 4, .. }));
    assert_eq!(kept.mass_matrix(), before);
    let refused = kept.update(&q[..9]).unwrap_err();
    assert_eq!(refused, MultibodyError::WrongLength { quantity: "q", expected: 10, found: 9 });
}

/// A slide so far away that M overflows, at the entry that is named; then all is computed again.
#[test]
fn after_an_overflow_nothing_is_kept() {
    let mut builder = RigidTree::builder();
    let y = JointKind::Revolute { axis: [0.0, 1.0, 0.0] };
    let x = JointKind::Prismatic { axis: [1.0, 0.0, 0.0] };
    let base = builder.attach(BodyIndex::GROUND, TreeJoint::new("hinge", y), "base", rod()).unwrap();
    builder.attach(base, TreeJoint::new("slide", x), "bob", rod()).unwrap();
    let tree = builder.build().unwrap();
    let mut kept = KeptMassMatrix::new(&tree);
    kept.update(&[0.0, 1.0]).unwrap();
    let refused = kept.update(&[0.0, 1e200]).unwrap_err();
    assert!(matches!(refused, MultibodyError::NotFinite { quantity: "mass matrix", index: 0, .. }), "{refused}");
    kept.update(&[0.0, 1e200]).unwrap_err();
    kept.update(&[0.0, 1.0]).unwrap();
    assert_eq!((kept.counts().places, kept.counts().inertias, kept.counts().columns), (2, 2, 2));
    let mut expected = [0.0; 4];
    tree.mass_matrix(&mut tree.workspace(), &[0.0, 1.0], &mut expected).unwrap();
    assert_close("mass matrix", kept.mass_matrix(), &expected, Tol::ulps(4.0));
}

#[test]
fn upper_triangle_is_that_of_the_mass_matrix_and_the_rest_stays() {
    for tree in [mixed(), chain(9), crate::trees::humanoid()] {
        let (n, q) = (tree.freedoms(), state_of(&tree, 3).q);
        let (mut whole, mut upper, mut work) = (vec![0.0; n * n], vec![-7.0; n * n], tree.workspace());
        tree.mass_matrix(&mut work, &q, &mut whole).unwrap();
        tree.mass_matrix_upper(&mut work, &q, &mut upper).unwrap();
        for j in 0..n {
            for i in 0..n {
                let expected: f64 = if i <= j { whole[i + j * n] } else { -7.0 };
                assert_eq!(upper[i + j * n].to_bits(), expected.to_bits(), "({i}, {j}) of {n}");
            }
        }
    }
}
