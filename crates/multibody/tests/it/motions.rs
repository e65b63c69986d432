//! Motions in time: energy, the variational method, free bodies.

use nalgebra::Vector3;
use piola_geometric::AdaptiveMuntheKaas;
use piola_integrators::{DormandPrince853, Order, State, Tolerance};
use piola_multibody::{BodyIndex, MultibodyError, RigidTree, VariationalTree};
use piola_testkit::{Tol, assert_close};

use crate::trees::{branched, chain, state_of, tree_of};

fn energy(tree: &RigidTree, q: &[f64], v: &[f64]) -> f64 {
    let energies = tree.tree_energies(&mut tree.workspace(), q, v).unwrap();
    energies.kinetic + energies.potential
}

/// A chain that falls from the horizontal.
fn horizontal(links: usize) -> (RigidTree, Vec<f64>, Vec<f64>) {
    let tree = chain(links);
    let mut q = vec![0.0; links];
    q[0] = core::f64::consts::FRAC_PI_2;
    (tree, q, vec![0.0; links])
}

#[test]
fn adaptive_method_keeps_the_energy_of_a_falling_chain() {
    let (tree, q, v) = horizontal(4);
    let start = energy(&tree, &q, &v);
    let mut motion = tree.motion(|_t, _q: &[f64], _v: &[f64], tau: &mut [f64]| tau.fill(0.0));
    let mut state = State::new(0.0, [q, v].concat()).unwrap();
    DormandPrince853::new(Tolerance::relative(1e-12).unwrap()).integrate_to(&mut motion, &mut state, 2.0).unwrap();
    let (q, v) = state.values.split_at(4);
    assert!((energy(&tree, q, v) - start).abs() < 1e-9 * 9.81);
}

#[test]
fn free_trees_keep_momentum_and_energy_without_gravity() {
    let mut tree = branched();
    tree.set_gravity([0.0; 3]).unwrap();
    let state = state_of(&tree, 4);
    let nq = tree.coordinates();
    let mut work = tree.workspace();
    let before = tree.centroidal_momentum(&mut work, &state.q, &state.v).unwrap();
    let start = energy(&tree, &state.q, &state.v);
    let mut motion = tree.motion(|_t, _q: &[f64], _v: &[f64], tau: &mut [f64]| tau.fill(0.0));
    let mut moving = State::new(0.0, [state.q, state.v].concat()).unwrap();
    DormandPrince853::new(Tolerance::relative(1e-12).unwrap()).integrate_to(&mut motion, &mut moving, 2.0).unwrap();
    let (q, v) = moving.values.split_at(nq);
    let after = tree.centroidal_momentum(&mut work, q, v).unwrap();
    let kept = Tol::stated(1e-10, "a hundred times the tolerance of a step");
    assert_close("momentum", &after.linear, &before.linear, kept);
    assert_close("angular momentum", &after.angular, &before.angular, kept);
    assert_close("energy", &[energy(&tree, q, v)], &[start], kept);
    // The same on the group of the configurations.
    let state = state_of(&tree, 4);
    let mut on_group = State::new(0.0, [state.q, state.v].concat()).unwrap();
    AdaptiveMuntheKaas::new(Tolerance::relative(1e-12).unwrap()).integrate_to(&mut motion, &mut on_group, 2.0).unwrap();
    assert_close("on the group", &on_group.values, &moving.values, kept.times(10.0));
}

#[test]
fn variational_method_has_its_orders() {
    let (tree, q, v) = horizontal(3);
    let mut motion = tree.motion(|_t, _q: &[f64], _v: &[f64], tau: &mut [f64]| tau.fill(0.0));
    let mut exact = State::new(0.0, [q.clone(), v.clone()].concat()).unwrap();
    DormandPrince853::new(Tolerance::relative(1e-13).unwrap()).integrate_to(&mut motion, &mut exact, 0.5).unwrap();
    for (order, steps) in [(Order::Two, [100, 1000]), (Order::Four, [25, 100]), (Order::Six, [25, 60])] {
        assert_order(order, steps, |steps| {
            let (mut q, mut v) = (q.clone(), v.clone());
            VariationalTree::new(&tree, order, 0.5 / steps as f64).unwrap().run(&mut q, &mut v, steps).unwrap();
            [q, v].concat().iter().zip(&exact.values).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()))
        });
    }
}

/// The error falls as the step to the power of the order, over two decades.
fn assert_order(order: Order, [few, many]: [usize; 2], error: impl Fn(usize) -> f64) {
    let fall = error(few) / error(many);
    let found = fall.ln() / (many as f64 / few as f64).ln();
    assert!((found - f64::from(order.value())).abs() < 0.1 && 95.0 < fall, "order {order:?}: {found}, by {fall}");
}

#[test]
fn variational_method_keeps_the_energy_of_a_chain_with_all_plain_joints() {
    use piola_multibody::JointKind::{Cylindrical, Helical, Planar, Revolute, Universal};
    let axis = [0.0, 0.6, 0.8];
    let kinds = [
        Planar,
        Revolute { axis },
        Helical { axis, pitch: 0.1 },
        Universal { first: [1.0, 0.0, 0.0], second: axis },
        Cylindrical { axis: [1.0, 0.0, 0.0] },
    ];
    let tree = tree_of(&kinds, &[0, 1, 2, 2, 4], 8);
    let state = state_of(&tree, 6);
    let (mut q, mut v) = (state.q, state.v);
    let start = energy(&tree, &q, &v);
    let mut method = VariationalTree::new(&tree, Order::Eight, 2e-3).unwrap();
    method.run(&mut q, &mut v, 250).unwrap();
    let scale = 9.81 * tree.total_mass();
    assert!((energy(&tree, &q, &v) - start).abs() < 1e-9 * scale, "{}", energy(&tree, &q, &v) - start);
}

#[test]
fn variational_method_refuses_what_it_cannot_do() {
    let socket = tree_of(&[piola_multibody::JointKind::Spherical], &[0], 3);
    let long = [1.1, 0.0, 0.0, 0.0];
    let error = VariationalTree::new(&socket, Order::Two, 1e-3).unwrap().run(&mut { long }, &mut [0.0; 3], 1);
    assert!(matches!(error, Err(MultibodyError::NotUnitQuaternion { joint, .. }) if joint == "joint 0"));
    let (tree, mut q, _) = horizontal(3);
    assert!(matches!(
        VariationalTree::new(&tree, Order::Two, 0.0).unwrap_err(),
        MultibodyError::NotFinite { quantity: "1/step", .. }
    ));
    let mut v = vec![300.0, -200.0, 500.0];
    let before = (q.clone(), v.clone());
    let error = VariationalTree::new(&tree, Order::Two, 0.5).unwrap().run(&mut q, &mut v, 1).unwrap_err();
    assert!(matches!(error, MultibodyError::NoConvergence { .. }));
    assert_eq!((q, v), before);
    assert_eq!(BodyIndex::GROUND.index(), 0);
}

/// A free body, a socket and a hinge beyond it, another socket beside it.
fn turning() -> RigidTree {
    use piola_multibody::JointKind::{Free, Revolute, Spherical};
    tree_of(&[Free, Spherical, Revolute { axis: [0.0, 0.6, 0.8] }, Spherical], &[0, 1, 2, 1], 5)
}

#[test]
fn variational_method_has_its_orders_with_spherical_and_free_joints() {
    let tree = turning();
    let state = state_of(&tree, 3);
    let nq = tree.coordinates();
    let mut motion = tree.motion(|_t, _q: &[f64], _v: &[f64], tau: &mut [f64]| tau.fill(0.0));
    let mut exact = State::new(0.0, [state.q.clone(), state.v.clone()].concat()).unwrap();
    DormandPrince853::new(Tolerance::relative(1e-13).unwrap()).integrate_to(&mut motion, &mut exact, 0.4).unwrap();
    for (order, steps) in [(Order::Two, [40, 400]), (Order::Four, [10, 40]), (Order::Six, [10, 25])] {
        assert_order(order, steps, |steps| {
            let (mut q, mut v) = (state.q.clone(), state.v.clone());
            VariationalTree::new(&tree, order, 0.4 / steps as f64).unwrap().run(&mut q, &mut v, steps).unwrap();
            let mut delta = vec![0.0; tree.freedoms()];
            tree.displacement(&exact.values[..nq], &q, &mut delta).unwrap();
            let rates = v.iter().zip(&exact.values[nq..]).map(|(a, b)| a - b);
            delta.iter().copied().chain(rates).fold(0.0_f64, |most, x| most.max(x.abs()))
        });
    }
}

/// Without gravity the Lagrangian is the same everywhere and in all directions: momenta stay to rounding at any step. The energy
/// swings within a bound and does not drift.
#[test]
fn variational_method_keeps_momenta_exactly_and_energy_without_drift() {
    let mut tree = turning();
    tree.set_gravity([0.0; 3]).unwrap();
    let state = state_of(&tree, 3);
    let (mut q, mut v) = (state.q, state.v);
    let mut work = tree.workspace();
    let momenta = |work: &mut _, q: &[f64], v: &[f64]| {
        let h = tree.centroidal_momentum(work, q, v).unwrap();
        let centre = tree.mass_centre(work, q, v).unwrap();
        let [r, p] = [centre.position, h.linear];
        let about_origin = [r[1] * p[2] - r[2] * p[1], r[2] * p[0] - r[0] * p[2], r[0] * p[1] - r[1] * p[0]];
        let angular = [0, 1, 2].map(|k| h.angular[k] + about_origin[k]);
        (h.linear, angular)
    };
    let start = (momenta(&mut work, &q, &v), energy(&tree, &q, &v));
    let mut method = VariationalTree::new(&tree, Order::Two, 0.01).unwrap();
    let mut swings = Vec::new();
    for _ in 0..4 {
        let mut most = 0.0_f64;
        for _ in 0..150 {
            method.run(&mut q, &mut v, 1).unwrap();
            most = most.max((energy(&tree, &q, &v) - start.1).abs());
        }
        swings.push(most);
    }
    let end = momenta(&mut work, &q, &v);
    let rounding = Tol::ulps_because(4096.0, "each of 600 steps ends within some ulp");
    assert_close("momentum", &end.0, &start.0.0, rounding);
    assert_close("angular momentum", &end.1, &start.0.1, rounding);
    assert!(swings[3] < 2.0 * swings[0] && 0.0 < swings[0], "{swings:?}");
    assert!(swings[3] < 0.01 * start.1.abs(), "{swings:?} of {}", start.1);
}

/// Steps forth and back end where they began: the method is symmetric.
#[test]
fn variational_steps_are_reversible() {
    let tree = turning();
    let state = state_of(&tree, 3);
    let (mut q, mut v) = (state.q.clone(), state.v.clone());
    VariationalTree::new(&tree, Order::Four, 0.01).unwrap().run(&mut q, &mut v, 20).unwrap();
    VariationalTree::new(&tree, Order::Four, -0.01).unwrap().run(&mut q, &mut v, 20).unwrap();
    let rounding = Tol::ulps_because(4096.0, "forty steps, each to some ulp");
    assert_close("q", &q, &state.q, rounding);
    assert_close("v", &v, &state.v, rounding);
}

/// The two-form δp·η' − δp'·η − p·[η, η'] of left-trivialised motions, of a free body and a socket on it, is the same before and
/// after a step.
#[test]
fn variational_steps_are_symplectic() {
    use piola_multibody::JointKind::{Free, Spherical};
    let tree = tree_of(&[Free, Spherical], &[0, 1], 9);
    let n = tree.freedoms();
    let state = state_of(&tree, 2);
    let mut work = tree.workspace();
    let mut momenta = |q: &[f64], v: &[f64]| {
        let mut matrix = vec![0.0; n * n];
        tree.mass_matrix(&mut work, q, &mut matrix).unwrap();
        (0..n).map(|i| (0..n).map(|j| matrix[i + j * n] * v[j]).sum::<f64>()).collect::<Vec<_>>()
    };
    let step = |q: &mut [f64], v: &mut [f64]| {
        VariationalTree::new(&tree, Order::Two, 0.05).unwrap().run(q, v, 1).unwrap();
    };
    let (mut q_end, mut v_end) = (state.q.clone(), state.v.clone());
    step(&mut q_end, &mut v_end);
    // Two tangents (η, δv) at the start, by central differences at both ends.
    let size = 1e-4;
    let mut tangents = [Vec::new(), Vec::new()];
    for seed in 0..2_usize {
        let eta: Vec<f64> = (0..n).map(|k| ((k * 7 + seed * 5 + 3) % 11) as f64 / 11.0 - 0.4).collect();
        let delta: Vec<f64> = (0..n).map(|k| ((k * 5 + seed * 3 + 1) % 7) as f64 / 7.0 - 0.5).collect();
        let [mut starts, mut ends] = [Vec::new(), Vec::new()];
        for sign in [-size, size] {
            let (mut q, mut v) = (state.q.clone(), state.v.clone());
            tree.move_configuration(&mut q, &eta.iter().map(|x| sign * x).collect::<Vec<_>>()).unwrap();
            for (v, delta) in v.iter_mut().zip(&delta) {
                *v += sign * delta;
            }
            for (list, (base, is_end)) in [(&mut starts, (&state.q, false)), (&mut ends, (&q_end, true))] {
                if is_end {
                    step(&mut q, &mut v);
                }
                let mut moved = vec![0.0; n];
                tree.displacement(base, &q, &mut moved).unwrap();
                list.push((moved, momenta(&q, &v)));
            }
        }
        for (tangents, list) in tangents.iter_mut().zip([starts, ends]) {
            let slope = |end: &[f64], start: &[f64]| {
                end.iter().zip(start).map(|(a, b)| (a - b) / (2.0 * size)).collect::<Vec<_>>()
            };
            tangents.push((slope(&list[1].0, &list[0].0), slope(&list[1].1, &list[0].1)));
        }
    }
    let form = |tangents: &[(Vec<f64>, Vec<f64>)], p: &[f64]| {
        let [(a, da), (b, db)] = [&tangents[0], &tangents[1]];
        let three = |values: &[f64], from: usize| Vector3::from_column_slice(&values[from..from + 3]);
        let plain: f64 = (0..n).map(|k| da[k] * b[k] - db[k] * a[k]).sum();
        // [η, η'] = (ω × ω', ω × v' + v × ω') of the free body, ω × ω' of the socket.
        let turns = [0, 6].map(|k| three(p, k).dot(&three(a, k).cross(&three(b, k))));
        let bracket = three(a, 0).cross(&three(b, 3)) + three(a, 3).cross(&three(b, 0));
        plain - turns[0] - turns[1] - three(p, 3).dot(&bracket)
    };
    let before = form(&tangents[0], &momenta(&state.q, &state.v));
    let after = form(&tangents[1], &momenta(&q_end, &v_end));
    assert!(0.01 < before.abs(), "{before}");
    assert_close("two-form", &[after], &[before], Tol::stated(1e-6, "differences of 10⁻⁴ to second order"));
}
