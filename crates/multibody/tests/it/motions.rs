//! Motions in time: energy, the variational method, free bodies.

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
    for (order, steps) in [(Order::Two, 100), (Order::Four, 25), (Order::Six, 25)] {
        let errors: Vec<(f64, f64)> = [steps, 2 * steps]
            .into_iter()
            .map(|steps| {
                let step = 0.5 / steps as f64;
                let (mut q, mut v) = (q.clone(), v.clone());
                VariationalTree::new(&tree, order, step).unwrap().run(&mut q, &mut v, steps).unwrap();
                let found = [q, v].concat();
                let error = found.iter().zip(&exact.values).fold(0.0_f64, |e, (a, b)| e.max((a - b).abs()));
                (step, error)
            })
            .collect();
        let found = (errors[0].1 / errors[1].1).log2();
        let expected = f64::from(order.value());
        assert!(expected - 0.3 < found && found < expected + 0.7, "order {expected}: {found}");
    }
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
    let error = VariationalTree::new(&branched(), Order::Two, 1e-3).unwrap_err();
    assert!(matches!(error, MultibodyError::NeedsPlainCoordinates { joint } if joint == "joint 0"));
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
