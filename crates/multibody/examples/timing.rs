//! Nanoseconds of the dynamics of chains, and how they grow: a quick look; the bench `multibody` measures with more care.
//!
//! ```sh
//! cargo run --release -p piola-multibody --example timing
//! ```
//!
//! The least time of thirty measurements. Inverse and forward dynamics: nanoseconds a joint, single and in lanes (64 states).
//! Mass matrix and derivatives: nanoseconds a state, in lanes too.
#![expect(clippy::print_stdout, reason = "it prints its table")]

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use piola_multibody::{
    AccelerationDerivatives, BatchWorkspace, DerivativeBlocks, MultibodyError, RigidTree, StateBlocks,
};

#[path = "../tests/it/trees.rs"]
#[expect(dead_code, reason = "the tests need more trees")]
mod trees;

/// The least nanoseconds of a call.
fn least(mut call: impl FnMut() -> Result<(), MultibodyError>) -> Result<f64, MultibodyError> {
    let (mut best, mut repeats) = (f64::INFINITY, 1);
    for _ in 0..30 {
        let start = Instant::now();
        for _ in 0..repeats {
            call()?;
        }
        let time = start.elapsed().as_secs_f64();
        best = best.min(time / f64::from(repeats));
        if time < 2e-3 {
            repeats *= 2;
        }
    }
    Ok(best * 1e9)
}

/// A row of the table: inverse and forward dynamics a joint.
fn row(name: &str, tree: &RigidTree) -> Result<[f64; 2], MultibodyError> {
    let n = tree.freedoms();
    let trees::State { q, v, a } = trees::state_of(tree, 1);
    let (mut work, mut out, mut matrix) = (tree.workspace(), vec![0.0; n], vec![0.0; n * n]);
    let inverse = least(|| tree.inverse_dynamics(&mut work, black_box(&q), &v, &a, black_box(&mut out)))? / n as f64;
    let forward = least(|| tree.forward_dynamics(&mut work, black_box(&q), &v, &a, black_box(&mut out)))? / n as f64;
    let mass = least(|| tree.mass_matrix(&mut work, black_box(&q), black_box(&mut matrix)))?;
    let upper = least(|| tree.mass_matrix_upper(&mut work, black_box(&q), black_box(&mut matrix)))?;
    let mut derivatives = AccelerationDerivatives::new(tree);
    let by_state =
        least(|| tree.forward_dynamics_derivatives(&mut work, black_box(&q), &v, &a, black_box(&mut derivatives)))?;
    let [mut by_v, mut by_a] = [matrix.clone(), matrix.clone()];
    let by_forces = least(|| {
        let (q, by_q) = (black_box(&q), black_box(&mut matrix));
        tree.inverse_dynamics_derivatives(&mut work, q, &v, &a, by_q, &mut by_v, &mut by_a)
    })?;
    let (mut states, mut batch) = (StateBlocks::new(tree.coordinates(), 64), BatchWorkspace::new(tree, 1));
    let mut rates = StateBlocks::new(n, 64);
    for i in 0..64 {
        let state = trees::state_of(tree, i as u64 + 1);
        states.set(i, &state.q)?;
        rates.set(i, &state.v)?;
    }
    let mut outputs = rates.clone();
    let each = 64.0 * n as f64;
    let inverse_lanes = least(|| {
        tree.inverse_dynamics_of_states(&mut batch, black_box(&states), &rates, &rates, black_box(&mut outputs))
    })? / each;
    let forward_lanes = least(|| {
        tree.forward_dynamics_of_states(&mut batch, black_box(&states), &rates, &rates, black_box(&mut outputs))
    })? / each;
    // Matrices of large trees leave the caches whatever computes them.
    let [mass_lanes, by_state_lanes] = if n <= 100 {
        matrices_in_lanes(tree, [&states, &rates], &mut batch)?
    } else {
        ["–", "–"].map(str::to_owned)
    };
    println!(
        "| {name} | {inverse:.1} | {forward:.1} | {inverse_lanes:.1} | {forward_lanes:.1} | {mass:.0} | {upper:.0} | {by_forces:.0} | {by_state:.0} | {mass_lanes} | {by_state_lanes} |"
    );
    Ok([inverse, forward])
}

/// Mass matrix and derivatives, a state.
fn matrices_in_lanes(
    tree: &RigidTree,
    [states, rates]: [&StateBlocks; 2],
    batch: &mut BatchWorkspace,
) -> Result<[String; 2], MultibodyError> {
    let (n, count) = (tree.freedoms(), states.states());
    let mut matrices = StateBlocks::new(n * n, count);
    let mut derivatives = DerivativeBlocks::new(tree, count);
    let mass = least(|| tree.mass_matrix_of_states(batch, black_box(states), black_box(&mut matrices)))?;
    let by_state = least(|| {
        let states = black_box(states);
        tree.forward_dynamics_derivatives_of_states(batch, states, rates, rates, black_box(&mut derivatives))
    })?;
    Ok([mass, by_state].map(|time| format!("{:.0}", time / count as f64)))
}

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "| tree | inverse | forward | inverse, lanes | forward, lanes | M | M, upper triangle | ∂τ | ∂v̇ | M, lanes | ∂v̇, lanes |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    row("ur5", &trees::ur5())?;
    row("arm with gripper, nv 9", &trees::gripper_arm())?;
    row("quadruped, nv 18", &trees::quadruped())?;
    row("humanoid, nv 50", &trees::humanoid())?;
    let mut ends = Vec::new();
    for links in [10, 30, 100, 300, 1000] {
        ends.push(row(&format!("chain {links}"), &trees::chain(links))?);
    }
    if let [first, .., last] = ends[..] {
        let exponent = |k: usize| 1.0 + (last[k] / first[k]).log10() / 2.0;
        println!("\nGrowth from 10 to 1000 links: n^{:.3} and n^{:.3}.", exponent(0), exponent(1));
    }
    Ok(())
}
