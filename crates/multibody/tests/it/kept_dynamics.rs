//! Kept inverse and forward dynamics are the numbers of the plain passes, and compute what changed alone.

use piola_multibody::{
    BodyIndex, BodyInertia, DynamicsCounts, JointKind, KeptDynamics, MultibodyError, RigidTree, TreeJoint,
};
use piola_numerics::{Dual, Real};
use piola_testkit::allocations_in;
use piola_testkit::strategies::random_cases;
use proptest::prelude::*;

use crate::trees::{chain, mixed, state_of, tree_of, uniform};

/// Kinds of joints, by a number below nine.
fn kind(number: usize) -> JointKind {
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    [
        JointKind::Revolute { axis: x },
        JointKind::Revolute { axis: y },
        JointKind::Prismatic { axis: z },
        JointKind::Helical { axis: y, pitch: 0.2 },
        JointKind::Universal { first: x, second: z },
        JointKind::Planar,
        JointKind::Spherical,
        JointKind::Free,
        JointKind::Fixed,
    ][number]
}

/// Which of the arguments of a joint go to those of another state.
#[derive(Clone, Copy, Debug)]
struct Moves([bool; 3]);

/// Takes the arguments of some joints from another state.
fn moved<T: Real>(tree: &RigidTree, now: &mut [Vec<T>; 3], other: &[Vec<T>; 3], moves: &[Moves]) {
    for (place, Moves(moves)) in tree.joints().iter().zip(moves) {
        let kind = place.joint.kind;
        let own = [
            place.first_coordinate..place.first_coordinate + kind.coordinates(),
            place.first_freedom..place.first_freedom + kind.freedoms(),
            place.first_freedom..place.first_freedom + kind.freedoms(),
        ];
        for (k, own) in own.into_iter().enumerate() {
            if moves[k] {
                now[k][own.clone()].copy_from_slice(&other[k][own]);
            }
        }
    }
}

/// Values in full, with the signs of zeros, which `==` does not see.
fn bits<T: Real>(values: &[T]) -> Vec<String> {
    values.iter().map(|value| format!("{value:?}")).collect()
}

/// Every result of a series of states is that of the plain passes.
fn assert_same<T: Real>(tree: &RigidTree, start: [Vec<T>; 3], others: &[[Vec<T>; 3]], series: &[Vec<Moves>]) {
    let mut now = start;
    let (mut kept, mut work) = (KeptDynamics::new(tree), tree.workspace());
    let mut expected = vec![T::zero(); tree.freedoms()];
    for (step, moves) in series.iter().enumerate() {
        moved(tree, &mut now, &others[step % others.len()], moves);
        let [q, v, third] = &now;
        tree.inverse_dynamics(&mut work, q, v, third, &mut expected).unwrap();
        let found = kept.inverse_dynamics(q, v, third).unwrap();
        assert_eq!(bits(found), bits(&expected), "inverse dynamics, step {step}: {moves:?}");
        tree.forward_dynamics(&mut work, q, v, third, &mut expected).unwrap();
        let found = kept.forward_dynamics(q, v, third).unwrap();
        assert_eq!(bits(found), bits(&expected), "forward dynamics, step {step}: {moves:?}");
    }
}

fn arguments(tree: &RigidTree, seed: u64) -> [Vec<f64>; 3] {
    let state = state_of(tree, seed);
    [state.q, state.v, state.a]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(1_000)))]
    /// Random trees with random joints, of which random ones change in random arguments.
    #[test]
    fn kept_dynamics_equal_the_plain_passes_to_the_last_bit(
        (kinds, parents, seed) in (1_usize..8).prop_flat_map(|n| {
            let parents: Vec<_> = (0..n).map(|i| 0..=i).collect();
            (prop::collection::vec(0_usize..9, n), parents, 0_u64..1000)
        }),
        series in prop::collection::vec(prop::collection::vec(any::<[bool; 3]>(), 8), 1..6),
    ) {
        let kinds: Vec<_> = kinds.into_iter().map(kind).collect();
        let tree = tree_of(&kinds, &parents, seed);
        // Of three coins two must fall on their heads: an argument of a joint changes in one step of four.
        let rare = |moves: Vec<[bool; 3]>| moves.into_iter().map(|[a, b, c]| Moves([a && b, b && c, a && c])).collect();
        let series: Vec<Vec<Moves>> = series.into_iter().map(rare).collect();
        let others = [2, 3].map(|k| arguments(&tree, seed + k));
        assert_same(&tree, arguments(&tree, seed + 1), &others, &series);
    }
}

/// With derivatives, every joint alone, each of its arguments alone.
#[test]
fn kept_dynamics_keep_derivatives_too() {
    let tree = mixed();
    let mut next = uniform(9);
    let mut dual =
        |seed| arguments(&tree, seed).map(|x| x.into_iter().map(|x| Dual::new(x, next())).collect::<Vec<_>>());
    let (start, others) = (dual(1), [dual(2), dual(3)]);
    let joints = tree.joints().len();
    let series: Vec<Vec<Moves>> = (0..3 * joints)
        .map(|step| (0..joints).map(|i| Moves([0, 1, 2].map(|k| step / 3 == i && step % 3 == k))).collect())
        .collect();
    assert_same(&tree, start, &others, &series);
}

/// A trunk with a head of one joint and two arms of two: links 0, 1, 2–3 and 4–5.
fn trunk() -> RigidTree {
    let y = JointKind::Revolute { axis: [0.0, 1.0, 0.0] };
    tree_of(&[y; 6], &[0, 1, 1, 3, 1, 5], 4)
}

#[test]
fn only_what_changed_is_computed() {
    let tree = trunk();
    let mut kept = KeptDynamics::new(&tree);
    let [mut q, mut v, mut tau] = arguments(&tree, 3);
    let counts = |places, motions, inertias, forces, accelerations| DynamicsCounts {
        links: 6,
        places,
        motions,
        inertias,
        forces,
        accelerations,
    };
    kept.forward_dynamics(&q, &v, &tau).unwrap();
    assert_eq!(kept.counts(), counts(6, 6, 6, 6, 6));
    let (count, same) = allocations_in(|| kept.forward_dynamics(&q, &v, &tau).is_ok());
    assert_eq!((count, same, kept.counts()), (0, true, counts(0, 0, 0, 0, 0)));
    // A hand: it and the arm, the arm's inertia with it, the trunk.
    q[3] += 0.1;
    kept.forward_dynamics(&q, &v, &tau).unwrap();
    assert_eq!(kept.counts(), counts(1, 1, 3, 3, 6));
    // A velocity or a force reshapes nothing.
    v[2] += 0.1;
    kept.forward_dynamics(&q, &v, &tau).unwrap();
    assert_eq!(kept.counts(), counts(0, 2, 0, 3, 6));
    tau[1] += 0.1;
    kept.forward_dynamics(&q, &v, &tau).unwrap();
    assert_eq!(kept.counts(), counts(0, 0, 0, 2, 6));
    assert_eq!(
        kept.counts().to_string(),
        "of 6 links computed: 0 places, 0 motions, 0 articulated inertias, 2 forces, 6 accelerations"
    );
    // Inverse dynamics keeps its own.
    kept.inverse_dynamics(&q, &v, &tau).unwrap();
    assert_eq!(kept.counts(), counts(6, 6, 0, 6, 0));
    tau[4] += 0.1;
    kept.inverse_dynamics(&q, &v, &tau).unwrap();
    assert_eq!(kept.counts(), counts(0, 2, 0, 3, 0));
    kept.forward_dynamics(&q, &v, &tau).unwrap();
    assert_eq!(kept.counts(), counts(0, 0, 0, 2, 6));
    assert_eq!(tree.plan().moved, 1 + 2 + 2 + 3 + 2 + 3);
    let plan = tree.plan().to_string();
    assert!(
        plan.ends_with("moves 2.2 of 6 links in the mean: KeptMassMatrix keeps the rest, KeptDynamics their motions"),
        "{plan}"
    );
}

#[test]
fn after_wrong_values_nothing_is_kept() {
    let tree = chain(3);
    let mut kept = KeptDynamics::new(&tree);
    let [q, v, tau] = arguments(&tree, 3);
    let expected = kept.forward_dynamics(&q, &v, &tau).unwrap().to_vec();
    let refused = kept.forward_dynamics(&q[1..], &v, &tau).unwrap_err();
    assert_eq!(refused, MultibodyError::WrongLength { quantity: "q", expected: 3, found: 2 });
    let mut wrong = v.clone();
    wrong[2] = f64::NAN;
    let refused = kept.forward_dynamics(&q, &wrong, &tau).unwrap_err();
    assert!(matches!(refused, MultibodyError::NotFinite { quantity: "v", index: 2, .. }), "{refused}");
    assert_eq!(kept.forward_dynamics(&q, &v, &tau).unwrap(), expected);
    assert_eq!(kept.counts().places, 3);
    let refused = kept.inverse_dynamics(&q, &v, &wrong).unwrap_err();
    assert!(matches!(refused, MultibodyError::NotFinite { quantity: "a", index: 2, .. }), "{refused}");
    let mut builder = RigidTree::builder();
    let y = JointKind::Revolute { axis: [0.0, 1.0, 0.0] };
    // A particle on the axis has no inertia about it.
    let bob = BodyInertia::particle(1.0, [0.0, 2.0, 0.0]).unwrap();
    builder.attach(BodyIndex::GROUND, TreeJoint::new("idle", y), "bob", bob).unwrap();
    let tree = builder.build().unwrap();
    let refused = KeptDynamics::new(&tree).forward_dynamics(&[0.0], &[0.0], &[1.0]).unwrap_err();
    assert!(matches!(&refused, MultibodyError::NoInertia { joint, .. } if joint == "idle"), "{refused}");
}
