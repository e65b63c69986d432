//! When it pays to keep results from call to call: nanoseconds of kept and plain dynamics, and how many links each call moves.
//!
//! ```sh
//! cargo run --release -p piola-multibody --example kept_dynamics
//! ```
//!
//! Kept and plain calls take turns; of each the least time of two hundred measurements. In every call the named arguments change.
#![expect(clippy::print_stdout, reason = "it prints its table")]

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use piola_multibody::{KeptDynamics, MultibodyError, RigidTree};

#[path = "../tests/it/trees.rs"]
#[expect(dead_code, reason = "the tests need more trees")]
mod trees;

/// Calls in one measurement.
const CALLS: u32 = 50;

fn nanoseconds(mut call: impl FnMut() -> Result<(), MultibodyError>) -> Result<f64, MultibodyError> {
    let start = Instant::now();
    for _ in 0..CALLS {
        call()?;
    }
    Ok(start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS))
}

/// A row of the table: what changes, and the components of q, v and the third argument that do.
fn row(name: &str, tree: &RigidTree, what: &str, changes: [&[usize]; 3]) -> Result<(), MultibodyError> {
    let trees::State { q, v, a } = trees::state_of(tree, 1);
    let mut kept = KeptDynamics::new(tree);
    let (mut work, mut out) = (tree.workspace(), vec![0.0; tree.freedoms()]);
    let mut best = [f64::INFINITY; 4];
    let mut counts = [kept.counts(); 2];
    for (forward, counts) in counts.iter_mut().enumerate() {
        let mut arguments = [q.clone(), v.clone(), a.clone()];
        let change = |arguments: &mut [Vec<f64>; 3]| {
            for (arguments, changes) in arguments.iter_mut().zip(changes) {
                for &k in changes {
                    arguments[k] += 1e-9;
                }
            }
        };
        for _ in 0..200 {
            let time = nanoseconds(|| {
                change(&mut arguments);
                let [q, v, a] = black_box(&arguments);
                let found = if forward == 1 { kept.forward_dynamics(q, v, a) } else { kept.inverse_dynamics(q, v, a) };
                found.map(|found| {
                    black_box(found);
                })
            })?;
            best[2 * forward] = best[2 * forward].min(time);
            let time = nanoseconds(|| {
                change(&mut arguments);
                let [q, v, a] = black_box(&arguments);
                let out = black_box(&mut out);
                if forward == 1 {
                    tree.forward_dynamics(&mut work, q, v, a, out)
                } else {
                    tree.inverse_dynamics(&mut work, q, v, a, out)
                }
            })?;
            best[2 * forward + 1] = best[2 * forward + 1].min(time);
        }
        // The plain calls changed the arguments too: once more, so that one change is counted.
        let [q, v, a] = &arguments;
        kept.forward_dynamics(q, v, a)?;
        kept.inverse_dynamics(q, v, a)?;
        change(&mut arguments);
        let [q, v, a] = &arguments;
        if forward == 1 {
            kept.forward_dynamics(q, v, a)?;
        } else {
            kept.inverse_dynamics(q, v, a)?;
        }
        *counts = kept.counts();
    }
    let [inverse, plain_inverse, forward, plain_forward] = best;
    println!(
        "| {name} | {what} | {} of {} | {inverse:.0} of {plain_inverse:.0} | {:.2} | {} | {forward:.0} of {plain_forward:.0} | {:.2} |",
        counts[0].motions,
        counts[0].links,
        inverse / plain_inverse,
        counts[1].inertias,
        forward / plain_forward
    );
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("| tree | changes | motions | inverse, ns | kept over plain | inertias | forward, ns | kept over plain |");
    println!("|---|---|---|---|---|---|---|---|");
    for (name, tree) in [("humanoid, nv 50", trees::humanoid()), ("chain 30", trees::chain(30))] {
        let (last, n) = (tree.coordinates() - 1, tree.freedoms());
        // The first joint after a free base.
        let (base, of_q, of_v) = if tree.coordinates() == n { (0, 0, 0) } else { (4, 7, 6) };
        let middle = n / 2;
        let (every_q, every_v): (Vec<_>, Vec<_>) = ((of_q..=last).collect(), (of_v..n).collect());
        row(name, &tree, "the force of the last joint", [&[], &[], &[n - 1]])?;
        row(name, &tree, "q of the last joint", [&[last], &[], &[]])?;
        row(name, &tree, "q, v of the last joint and its force", [&[last], &[n - 1], &[n - 1]])?;
        row(name, &tree, "q of a joint in the middle", [&[last + 1 - n + middle], &[], &[]])?;
        row(name, &tree, "all forces", [&[], &[], &every_v])?;
        row(name, &tree, "all v", [&[], &every_v, &[]])?;
        row(name, &tree, "q of the base", [&[base], &[], &[]])?;
        row(name, &tree, "all q, v and forces", [&every_q, &every_v, &every_v])?;
    }
    Ok(())
}
