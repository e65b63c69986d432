//! The kept mass matrix equals one that is computed anew, and counts what it keeps.

use piola_multibody::{KeptMassMatrix, MultibodyError};
use piola_testkit::{Tol, allocations_in, assert_close};

use crate::trees::{chain, mixed, state_of};

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
    kept.update(&tree, &start).unwrap();
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
            kept.update(&tree, &q).unwrap();
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
    kept.update(&tree, &q).unwrap();
    let (count, ()) = allocations_in(|| kept.update(&tree, &q).unwrap());
    assert_eq!(count, 0);
    assert_eq!((kept.counts().places, kept.counts().inertias, kept.counts().columns), (0, 0, 0));
    // The last three links move, and reshape the first seven. Columns of all change, because all inertias meet those.
    q[7] = 0.4;
    kept.update(&tree, &q).unwrap();
    assert_eq!((kept.counts().places, kept.counts().inertias, kept.counts().columns), (3, 7, 10));
    // The whole chain turns as one body: M stays.
    q[0] = 0.4;
    kept.update(&tree, &q).unwrap();
    assert_eq!((kept.counts().places, kept.counts().inertias, kept.counts().columns), (10, 0, 0));
    assert_eq!(
        kept.counts().to_string(),
        "of 10 links: 10 places computed, 0 kept; 0 composite inertias computed, 10 kept; columns of 0 computed, of 10 kept"
    );
    let before = kept.mass_matrix().to_vec();
    let mut wrong = q.clone();
    wrong[4] = f64::INFINITY;
    let refused = kept.update(&tree, &wrong).unwrap_err();
    assert!(matches!(refused, MultibodyError::NotFinite { quantity: "q", index: 4, .. }));
    assert_eq!(kept.mass_matrix(), before);
    let refused = kept.update(&chain(9), &q[..9]).unwrap_err();
    assert_eq!(refused, MultibodyError::OtherWorkspace { expected: 9, found: 10 });
}
