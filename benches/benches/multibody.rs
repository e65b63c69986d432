//! Nanoseconds of the dynamics of trees of rigid bodies.
//!
//! An item is one joint of one state for inverse and forward dynamics, and one state for mass matrices and derivatives. Chains
//! are of rods of 1 m and 1 kg with axes y and x in turn; the arm UR5 is that of the reference data. The other robots are made of the
//! same rods: an arm of seven joints with a gripper of two slides (9 freedoms), a quadruped (18), a humanoid with hands (50). `lanes` are batches of 64
//! states on one core. The kept mass matrix follows a tree of which the last joint alone moves,
//! and so do the kept dynamics.

use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use piola_multibody::{
    AccelerationDerivatives, BatchWorkspace, DerivativeBlocks, KeptDynamics, KeptMassMatrix, RigidTree, StateBlocks,
};

#[path = "../../crates/multibody/tests/it/trees.rs"]
#[expect(dead_code, reason = "the tests need more trees")]
mod trees;

/// States of a batch.
const STATES: usize = 64;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("multibody");
    group.sample_size(20).nresamples(2000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(300));
    single(&mut group, "ur5", &trees::ur5());
    batch(&mut group, "ur5", &trees::ur5());
    let robots =
        [("gripper_arm", trees::gripper_arm()), ("quadruped", trees::quadruped()), ("humanoid", trees::humanoid())];
    for (name, tree) in &robots {
        single(&mut group, name, tree);
        batch(&mut group, name, tree);
    }
    for links in [10, 30, 100, 300, 1000] {
        let (name, tree) = (format!("chain_{links}"), trees::chain(links));
        single(&mut group, &name, &tree);
        batch(&mut group, &name, &tree);
    }
    group.finish();
    criterion.final_summary();
}

fn single(group: &mut BenchmarkGroup<'_, WallTime>, name: &str, tree: &RigidTree) {
    let n = tree.freedoms();
    let trees::State { q, v, a } = trees::state_of(tree, 1);
    let mut work = tree.workspace();
    let mut out = vec![0.0; n];
    group.throughput(Throughput::Elements(n as u64));
    group.bench_function(format!("inverse_dynamics/{name}"), |bencher| {
        bencher.iter(|| {
            let _ = black_box(tree.inverse_dynamics(&mut work, black_box(&q), &v, &a, &mut out));
            black_box(&mut out);
        });
    });
    group.bench_function(format!("forward_dynamics/{name}"), |bencher| {
        bencher.iter(|| {
            let _ = black_box(tree.forward_dynamics(&mut work, black_box(&q), &v, &a, &mut out));
            black_box(&mut out);
        });
    });
    group.throughput(Throughput::Elements(1));
    let mut matrix = vec![0.0; n * n];
    group.bench_function(format!("mass_matrix/{name}"), |bencher| {
        bencher.iter(|| {
            let _ = black_box(tree.mass_matrix(&mut work, black_box(&q), &mut matrix));
            black_box(&mut matrix);
        });
    });
    let (mut kept, mut moved, last) = (KeptMassMatrix::new(tree), q.clone(), q.len() - 1);
    group.bench_function(format!("kept_mass_matrix/{name}"), |bencher| {
        bencher.iter(|| {
            moved[last] += 1e-3;
            let _ = black_box(kept.update(black_box(&moved)));
        });
    });
    let (mut kept, mut rates) = (KeptDynamics::new(tree), v.clone());
    for (name_of, forward) in [("kept_inverse_dynamics", false), ("kept_forward_dynamics", true)] {
        group.bench_function(format!("{name_of}/{name}"), |bencher| {
            bencher.iter(|| {
                rates[n - 1] += 1e-9;
                let rates = black_box(&rates);
                let found =
                    if forward { kept.forward_dynamics(&q, rates, &a) } else { kept.inverse_dynamics(&q, rates, &a) };
                let _ = black_box(found);
            });
        });
    }
    let mut derivatives = AccelerationDerivatives::new(tree);
    group.bench_function(format!("forward_dynamics_derivatives/{name}"), |bencher| {
        bencher.iter(|| {
            let _ = black_box(tree.forward_dynamics_derivatives(&mut work, black_box(&q), &v, &a, &mut derivatives));
            black_box(&mut derivatives);
        });
    });
}

fn batch(group: &mut BenchmarkGroup<'_, WallTime>, name: &str, tree: &RigidTree) {
    let n = tree.freedoms();
    let blocks = |components: usize, of: fn(trees::State) -> Vec<f64>| {
        let mut blocks = StateBlocks::new(components, STATES);
        for state in 0..STATES {
            let _ = blocks.set(state, &of(trees::state_of(tree, state as u64 + 1)));
        }
        blocks
    };
    let q = blocks(tree.coordinates(), |state| state.q);
    let (v, a) = (blocks(n, |state| state.v), blocks(n, |state| state.a));
    let mut out = a.clone();
    let mut work = BatchWorkspace::new(tree, 1);
    group.throughput(Throughput::Elements((n * STATES) as u64));
    group.bench_function(format!("inverse_dynamics/{name}/lanes"), |bencher| {
        bencher.iter(|| {
            let _ = black_box(tree.inverse_dynamics_of_states(&mut work, black_box(&q), &v, &a, &mut out));
            black_box(&mut out);
        });
    });
    group.bench_function(format!("forward_dynamics/{name}/lanes"), |bencher| {
        bencher.iter(|| {
            let _ = black_box(tree.forward_dynamics_of_states(&mut work, black_box(&q), &v, &a, &mut out));
            black_box(&mut out);
        });
    });
    if 100 < n {
        return; // their matrices leave the caches
    }
    group.throughput(Throughput::Elements(STATES as u64));
    let (mut matrices, mut derivatives) = (StateBlocks::new(n * n, STATES), DerivativeBlocks::new(tree, STATES));
    group.bench_function(format!("mass_matrix/{name}/lanes"), |bencher| {
        bencher.iter(|| {
            let _ = black_box(tree.mass_matrix_of_states(&mut work, black_box(&q), &mut matrices));
            black_box(&mut matrices);
        });
    });
    group.bench_function(format!("forward_dynamics_derivatives/{name}/lanes"), |bencher| {
        bencher.iter(|| {
            let q = black_box(&q);
            let _ = black_box(tree.forward_dynamics_derivatives_of_states(&mut work, q, &v, &a, &mut derivatives));
            black_box(&mut derivatives);
        });
    });
}
