//! Evaluations allocate nothing once their workspace is made.

use piola_integrators::Order;
use piola_multibody::{
    AccelerationDerivatives, BatchWorkspace, BodyIndex, BodyPoint, ClosedTree, DerivativeBlocks, INERTIAL_PARAMETERS,
    LoopClosure, StateBlocks, TreeFactors, VariationalTree,
};
use piola_testkit::allocations_in;

use crate::trees::{mixed, state_of};

#[test]
fn evaluations_allocate_nothing() {
    let tree = mixed();
    let (state, n) = (state_of(&tree, 2), tree.freedoms());
    let mut work = tree.workspace();
    let mut factors = TreeFactors::new(&tree);
    let mut out = vec![0.0; n];
    let [mut x, mut y, mut z] = [vec![0.0; n * n], vec![0.0; n * n], vec![0.0; n * n]];
    let mut jacobian = vec![0.0; 6 * n];
    let mut regressor = vec![0.0; n * tree.bodies() * INERTIAL_PARAMETERS];
    let mut derivatives = AccelerationDerivatives::new(&tree);
    let mut batch = BatchWorkspace::new(&tree, 1);
    // Not a multiple of eight: the last block is not full.
    let states = 21;
    let mut blocks = StateBlocks::new(n, states);
    let mut places = StateBlocks::new(tree.coordinates(), states);
    for i in 0..states {
        places.set(i, &state.q).unwrap();
    }
    let zeros = blocks.clone();
    let (mut matrices, mut all) = (StateBlocks::new(n * n, states), DerivativeBlocks::new(&tree, states));
    // The first call makes the memory for matrices.
    tree.forward_dynamics_derivatives_of_states(&mut batch, &places, &zeros, &zeros, &mut all).unwrap();
    let body = tree.body("body 10").unwrap();
    let (q, v, a) = (&state.q, &state.v, &state.a);
    let (count, ()) = allocations_in(|| {
        tree.inverse_dynamics(&mut work, q, v, a, &mut out).unwrap();
        tree.bias_forces(&mut work, q, v, &mut out).unwrap();
        tree.gravity_forces(&mut work, q, &mut out).unwrap();
        tree.forward_dynamics(&mut work, q, v, a, &mut out).unwrap();
        tree.forward_dynamics_by_mass_matrix(&mut work, &mut factors, q, v, a, &mut out).unwrap();
        tree.mass_matrix(&mut work, q, &mut x).unwrap();
        tree.coriolis_matrix(&mut work, q, v, &mut x).unwrap();
        tree.jacobian(&mut work, q, body, &mut jacobian).unwrap();
        tree.jacobian_rate(&mut work, q, v, body, &mut jacobian).unwrap();
        tree.forward_accelerations(&mut work, q, v, a).unwrap();
        tree.tree_energies(&mut work, q, v).unwrap();
        tree.centroidal_momentum_matrix(&mut work, q, &mut jacobian).unwrap();
        tree.centroidal_momentum_rate(&mut work, q, v, a).unwrap();
        tree.regressor(&mut work, q, v, a, &mut regressor).unwrap();
        tree.inverse_dynamics_derivatives(&mut work, q, v, a, &mut x, &mut y, &mut z).unwrap();
        tree.forward_dynamics_derivatives(&mut work, q, v, a, &mut derivatives).unwrap();
        tree.inverse_dynamics_of_states(&mut batch, &places, &zeros, &zeros, &mut blocks).unwrap();
        tree.forward_dynamics_of_states(&mut batch, &places, &zeros, &zeros, &mut blocks).unwrap();
        tree.mass_matrix_of_states(&mut batch, &places, &mut matrices).unwrap();
        tree.forward_dynamics_derivatives_of_states(&mut batch, &places, &zeros, &zeros, &mut all).unwrap();
    });
    assert_eq!(count, 0);
}

#[test]
fn closed_loops_and_steps_allocate_nothing() {
    let tree = crate::trees::chain(3);
    let mut closed = ClosedTree::new(tree.clone());
    let first = BodyPoint::new(tree.body("rod 2").unwrap(), [0.0, 0.0, -1.0]);
    let second = BodyPoint::new(BodyIndex::GROUND, [0.5, 0.0, -2.5]);
    closed.close("string", LoopClosure::Distance { first, second, length: 0.5 }).unwrap();
    let mut work = closed.workspace();
    let (mut q, mut v, mut out) = ([0.3, 0.1, -0.2], [0.1; 3], [0.0; 3]);
    let (count, ()) = allocations_in(|| {
        closed.project(&mut work, &mut q, &mut v, 0.0).unwrap();
        closed.accelerations(&mut work, &q, &v, &[0.0; 3], 0.0, &mut out).unwrap();
    });
    assert_eq!(count, 0);
    let mut method = VariationalTree::new(&tree, Order::Four, 1e-3).unwrap();
    let mut run = |steps| allocations_in(|| method.run(&mut q, &mut v, steps).unwrap()).0;
    // A run has one vector; steps have none.
    assert_eq!(run(1), run(50));
}
