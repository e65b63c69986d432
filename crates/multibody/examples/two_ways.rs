//! Forward dynamics by articulated bodies and by the factorised mass matrix, in turn: which is faster at which size?
//!
//! ```sh
//! cargo run --release -p piola-multibody --example two_ways
//! ```
//!
//! Nanoseconds of a call, the least of two hundred measurements, and the largest difference of the accelerations over the largest of them.
#![expect(clippy::print_stdout, reason = "it prints its table")]

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use piola_multibody::{MultibodyError, RigidTree, TreeFactors};

#[path = "../tests/it/trees.rs"]
#[expect(dead_code, reason = "the tests need more trees")]
mod trees;

const ROUNDS: u32 = 200;
const CALLS: u32 = 20;

/// Nanoseconds of a call, or what was less before.
fn timed(least: f64, mut call: impl FnMut() -> Result<(), MultibodyError>) -> Result<f64, MultibodyError> {
    let start = Instant::now();
    for _ in 0..CALLS {
        call()?;
    }
    Ok(least.min(start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS)))
}

fn row(name: &str, tree: &RigidTree) -> Result<(), MultibodyError> {
    let n = tree.freedoms();
    let trees::State { q, v, a } = trees::state_of(tree, 1);
    let (mut work, mut factors) = (tree.workspace(), TreeFactors::new(tree));
    let (mut along, mut solved) = (vec![0.0; n], vec![0.0; n]);
    let (mut bodies, mut matrix) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..ROUNDS {
        bodies = timed(bodies, || tree.forward_dynamics(&mut work, black_box(&q), &v, &a, black_box(&mut along)))?;
        matrix = timed(matrix, || {
            let out = black_box(&mut solved);
            tree.forward_dynamics_by_mass_matrix(&mut work, &mut factors, black_box(&q), &v, &a, out)
        })?;
    }
    let largest = along.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let apart = along.iter().zip(&solved).fold(0.0, |apart: f64, (a, b)| apart.max((a - b).abs()));
    println!("| {name} | {n} | {bodies:.0} | {matrix:.0} | {:.2} | {:.0e} |", matrix / bodies, apart / largest);
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("| tree | freedoms | articulated bodies, ns | factorised mass matrix, ns | ratio | difference |");
    println!("|---|---|---|---|---|---|");
    for links in [1, 2, 3, 6, 10, 30, 100] {
        row(&format!("chain {links}"), &trees::chain(links))?;
    }
    row("UR5", &trees::ur5())?;
    row("quadruped", &trees::quadruped())?;
    row("humanoid", &trees::humanoid())?;
    Ok(())
}
