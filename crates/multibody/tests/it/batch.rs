//! Batches give what single states give, to the last bit for any number of threads.

use piola_multibody::{AccelerationDerivatives, BatchWorkspace, DerivativeBlocks, MultibodyError, StateBlocks};
use piola_testkit::{Tol, assert_close};

use crate::trees::{mixed, state_of};

#[test]
fn batches_equal_single_states_for_any_number_of_threads() {
    let tree = mixed();
    let (n, states) = (tree.freedoms(), 37);
    let mut q = StateBlocks::new(tree.coordinates(), states);
    let mut v = StateBlocks::new(n, states);
    let mut third = v.clone();
    for i in 0..states {
        let state = state_of(&tree, i as u64 + 1);
        q.set(i, &state.q).unwrap();
        v.set(i, &state.v).unwrap();
        third.set(i, &state.a).unwrap();
    }
    let mut work = tree.workspace();
    let (mut expected, mut found) = (vec![0.0; n], vec![0.0; n]);
    let mut outputs = Vec::new();
    let (mut matrix, mut found_matrix) = (vec![0.0; n * n], vec![0.0; n * n]);
    let mut derivatives = AccelerationDerivatives::new(&tree);
    for threads in [1, 3, 64] {
        let mut batch = BatchWorkspace::new(&tree, threads);
        let (mut tau, mut a) = (v.clone(), v.clone());
        tree.inverse_dynamics_of_states(&mut batch, &q, &v, &third, &mut tau).unwrap();
        tree.forward_dynamics_of_states(&mut batch, &q, &v, &third, &mut a).unwrap();
        let (mut matrices, mut all) = (StateBlocks::new(n * n, states), DerivativeBlocks::new(&tree, states));
        tree.mass_matrix_of_states(&mut batch, &q, &mut matrices).unwrap();
        tree.forward_dynamics_derivatives_of_states(&mut batch, &q, &v, &third, &mut all).unwrap();
        for i in 0..states {
            let state = state_of(&tree, i as u64 + 1);
            tree.inverse_dynamics(&mut work, &state.q, &state.v, &state.a, &mut expected).unwrap();
            tau.get(i, &mut found).unwrap();
            let rounding = Tol::ulps_because(512.0, "sines in lanes round otherwise");
            assert_close("inverse dynamics", &found, &expected, rounding);
            tree.forward_dynamics(&mut work, &state.q, &state.v, &state.a, &mut expected).unwrap();
            a.get(i, &mut found).unwrap();
            assert_close("forward dynamics", &found, &expected, rounding.times(1e3));
            tree.mass_matrix(&mut work, &state.q, &mut matrix).unwrap();
            matrices.get(i, &mut found_matrix).unwrap();
            assert_close("mass matrix", &found_matrix, &matrix, rounding);
            tree.forward_dynamics_derivatives(&mut work, &state.q, &state.v, &state.a, &mut derivatives).unwrap();
            for (quantity, found, expected) in [
                ("by q", &all.by_q, &derivatives.by_q),
                ("by v", &all.by_v, &derivatives.by_v),
                ("by tau", &all.by_tau, &derivatives.by_tau),
            ] {
                found.get(i, &mut found_matrix).unwrap();
                assert_close(quantity, &found_matrix, expected, rounding.times(1e3));
            }
        }
        // Forward dynamics and its derivatives take the same passes to the accelerations.
        assert!(all.acceleration == a);
        outputs.push((tau, a, matrices, all));
    }
    assert!(outputs.windows(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn first_wrong_state_of_a_batch_is_named() {
    let tree = mixed();
    let (n, states) = (tree.freedoms(), 21);
    let mut q = StateBlocks::new(tree.coordinates(), states);
    for i in 0..states {
        q.set(i, &state_of(&tree, 1).q).unwrap();
    }
    let mut wrong = state_of(&tree, 1).q;
    wrong[0] = f64::NAN;
    for i in [13, 19] {
        q.set(i, &wrong).unwrap();
    }
    let zeros = StateBlocks::new(n, states);
    for threads in [1, 2] {
        let mut batch = BatchWorkspace::new(&tree, threads);
        let mass_matrices = tree.mass_matrix_of_states(&mut batch, &q, &mut StateBlocks::new(n * n, states));
        let mut out = DerivativeBlocks::new(&tree, states);
        let derivatives = tree.forward_dynamics_derivatives_of_states(&mut batch, &q, &zeros, &zeros, &mut out);
        for error in [mass_matrices.unwrap_err(), derivatives.unwrap_err()] {
            let MultibodyError::InState { state: 13, source } = error else { panic!("{error}") };
            assert!(matches!(*source, MultibodyError::NotFinite { quantity: "q", index: 0, .. }), "{source}");
        }
    }
    let mut batch = BatchWorkspace::new(&tree, 1);
    let short = tree.mass_matrix_of_states(&mut batch, &q, &mut StateBlocks::new(n, states)).unwrap_err();
    assert_eq!(short, MultibodyError::WrongLength { quantity: "out", expected: n * n, found: n });
}
