//! Batches give what single states give, to the last bit for any number of threads.

use piola_multibody::{BatchWorkspace, StateBlocks};
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
    for threads in [1, 3, 64] {
        let mut batch = BatchWorkspace::new(&tree, threads);
        let (mut tau, mut a) = (v.clone(), v.clone());
        tree.inverse_dynamics_of_states(&mut batch, &q, &v, &third, &mut tau).unwrap();
        tree.forward_dynamics_of_states(&mut batch, &q, &v, &third, &mut a).unwrap();
        for i in 0..states {
            let state = state_of(&tree, i as u64 + 1);
            tree.inverse_dynamics(&mut work, &state.q, &state.v, &state.a, &mut expected).unwrap();
            tau.get(i, &mut found).unwrap();
            let rounding = Tol::ulps_because(512.0, "sines in lanes round otherwise");
            assert_close("inverse dynamics", &found, &expected, rounding);
            tree.forward_dynamics(&mut work, &state.q, &state.v, &state.a, &mut expected).unwrap();
            a.get(i, &mut found).unwrap();
            assert_close("forward dynamics", &found, &expected, rounding.times(1e3));
        }
        outputs.push((tau, a));
    }
    assert!(outputs.windows(2).all(|pair| pair[0] == pair[1]));
}
