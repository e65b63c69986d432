//! Springs, dampers and Coulomb friction in joints: closed forms and the balance of energy.

use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_multibody::{BodyIndex, BodyInertia, JointKind, MultibodyError, RigidTree, TreeJoint};
use piola_testkit::{Tol, allocations_in, assert_close};

use crate::trees::{mixed, state_of};

/// A rotor of 1 kg m² about a vertical axis.
fn rotor(joint: impl Fn(TreeJoint) -> TreeJoint) -> RigidTree {
    let mut builder = RigidTree::builder();
    let bearing = joint(TreeJoint::new("bearing", JointKind::Revolute { axis: [0.0, 0.0, 1.0] }));
    builder.attach(BodyIndex::GROUND, bearing, "rotor", BodyInertia::particle(1.0, [1.0, 0.0, 0.0]).unwrap()).unwrap();
    builder.build().unwrap()
}

/// v̇ = −f tanh(v/w) has the solution sinh(v/w) = sinh(v₀/w) exp(−f t/w).
#[test]
fn rotor_with_coulomb_friction_comes_to_rest_as_its_closed_form() {
    let (friction, slip_rate, start) = (0.5, 0.1, 1.0);
    let tree = rotor(|bearing| bearing.with_friction(0.0, friction));
    let mut motion = tree.motion(|_t, q: &[f64], v: &[f64], tau: &mut [f64]| {
        tree.joint_forces(q, v, slip_rate, tau).unwrap();
    });
    for end in [1.0, 1.9, 2.5] {
        let mut state = State::new(0.0, vec![0.0, start]).unwrap();
        DormandPrince853::new(Tolerance::relative(1e-12).unwrap()).integrate_to(&mut motion, &mut state, end).unwrap();
        let expected = slip_rate * ((start / slip_rate).sinh() * (-friction * end / slip_rate).exp()).asinh();
        let tolerance = Tol::stated(1e-10, "a hundred times the tolerance of a step");
        assert_close("rate", &[state.values[1]], &[expected], tolerance);
    }
}

/// Energy of the tree and its springs changes by the powers alone: Gauss's rule integrates the powers.
#[test]
fn energy_falls_by_the_powers_of_dampers_and_friction() {
    let mut builder = RigidTree::builder();
    let mut parent = BodyIndex::GROUND;
    for (i, axis) in [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]].into_iter().enumerate() {
        let joint = TreeJoint::new(format!("joint {i}"), JointKind::Revolute { axis })
            .at([0.0, 0.0, -(i as f64)])
            .with_friction(0.2, 0.7)
            .with_spring(3.0, 0.4);
        parent = builder.attach(parent, joint, format!("rod {i}"), crate::trees::rod()).unwrap();
    }
    let tree = builder.build().unwrap();
    let slip_rate = 0.2;
    let mut motion = tree.motion(|_t, q: &[f64], v: &[f64], tau: &mut [f64]| {
        tree.joint_forces(q, v, slip_rate, tau).unwrap();
    });
    let mut state = State::new(0.0, vec![1.2, -0.5, 0.3, 0.1]).unwrap();
    let total = |values: &[f64]| {
        let (q, v) = values.split_at(2);
        let energies = tree.tree_energies(&mut tree.workspace(), q, v).unwrap();
        let powers = tree.joint_powers(q, v, slip_rate).unwrap();
        let sum = energies.kinetic + energies.potential + powers.spring_energy;
        (sum, powers.damping_power + powers.friction_power)
    };
    let mut method = DormandPrince853::new(Tolerance::relative(1e-12).unwrap());
    let (start, _) = total(&state.values);
    // Gauss's rule with four points in each of a hundred intervals.
    let rule =
        [(0.069_431_844_202_973_71, 0.173_927_422_568_726_92), (0.330_009_478_207_571_87, 0.326_072_577_431_273_1)];
    let mut work = 0.0;
    for k in 0..100 {
        let (from, width) = (f64::from(k) * 0.01, 0.01);
        let nodes = [rule[0], rule[1], (1.0 - rule[1].0, rule[1].1), (1.0 - rule[0].0, rule[0].1)];
        for (node, weight) in nodes {
            method.integrate_to(&mut motion, &mut state, from + node * width).unwrap();
            work += weight * width * total(&state.values).1;
        }
        method.integrate_to(&mut motion, &mut state, from + width).unwrap();
    }
    let (end, _) = total(&state.values);
    assert!(work < -0.3, "{work}");
    assert_close("energy", &[end - start], &[work], Tol::stated(1e-9, "the integrator and the quadrature"));
}

#[test]
fn forces_are_checked_and_allocate_nothing() {
    let tree = mixed();
    let state = state_of(&tree, 2);
    let mut out = vec![0.0; tree.freedoms()];
    let (count, result) = allocations_in(|| tree.joint_forces(&state.q, &state.v, 0.1, &mut out));
    assert_eq!((count, result), (0, Ok(())));
    let refused = tree.joint_forces(&state.q, &state.v, 0.0, &mut out).unwrap_err();
    assert_eq!(refused, MultibodyError::InvalidSlipRate { slip_rate: 0.0 });
    let refused = tree.joint_powers(&state.q[1..], &state.v, 0.1).unwrap_err();
    let expected = tree.coordinates();
    assert_eq!(refused, MultibodyError::WrongLength { quantity: "q", expected, found: expected - 1 });
    let mut v = state.v.clone();
    v[3] = f64::NAN;
    let refused = tree.joint_powers(&state.q, &v, 0.1).unwrap_err();
    assert!(matches!(refused, MultibodyError::NotFinite { quantity: "v", index: 3, .. }));
    let socket = TreeJoint::new("socket", JointKind::Spherical).with_spring(1.0, 0.0);
    let refused = RigidTree::builder().attach(BodyIndex::GROUND, socket, "ball", crate::trees::rod()).unwrap_err();
    assert!(matches!(refused, MultibodyError::InvalidJointData { quantity: "stiffness", .. }));
}
