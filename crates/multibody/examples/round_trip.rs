//! Accelerations to forces and back, for chains: what is lost, over the condition number of the mass matrix.
//!
//! ```sh
//! cargo run --release -p piola-multibody --example round_trip
//! ```
//!
//! A chain of n rods of 1 m and 1 kg, axes y and x in turn, in random states: the largest error of a over the largest a, of
//! twenty states, by articulated bodies and by the factorised mass matrix. κ is that of the mass matrix, scaled to unit diagonal, in the 1-norm.
#![expect(clippy::print_stdout, reason = "it prints its table")]

use std::error::Error;

use nalgebra::DMatrix;
use piola_multibody::TreeFactors;
use piola_numerics::linear::ldlt::Ldlt;

#[path = "../tests/it/trees.rs"]
#[expect(dead_code, reason = "the tests need more trees")]
mod trees;

fn main() -> Result<(), Box<dyn Error>> {
    println!("| links | articulated bodies | mass matrix | κ | articulated bodies over κ |");
    println!("|---|---|---|---|---|");
    for links in [10, 30, 100, 300, 1000] {
        let tree = trees::chain(links);
        let mut work = tree.workspace();
        let mut factors = TreeFactors::new(&tree);
        let (mut tau, mut back) = (vec![0.0; links], vec![0.0; links]);
        let (mut by_bodies, mut by_matrix, mut condition) = (0.0_f64, 0.0_f64, 0.0_f64);
        let states = if links == 1000 { 3 } else { 20 };
        for seed in 1..=states {
            let state = trees::state_of(&tree, seed);
            let error = |found: &[f64]| {
                let largest = state.a.iter().fold(0.0_f64, |largest, a| largest.max(a.abs()));
                found.iter().zip(&state.a).fold(0.0_f64, |e, (x, y)| e.max((x - y).abs())) / largest
            };
            tree.inverse_dynamics(&mut work, &state.q, &state.v, &state.a, &mut tau)?;
            tree.forward_dynamics(&mut work, &state.q, &state.v, &tau, &mut back)?;
            by_bodies = by_bodies.max(error(&back));
            tree.forward_dynamics_by_mass_matrix(&mut work, &mut factors, &state.q, &state.v, &tau, &mut back)?;
            by_matrix = by_matrix.max(error(&back));
            if seed == 1 {
                let mut matrix = vec![0.0; links * links];
                tree.mass_matrix(&mut work, &state.q, &mut matrix)?;
                let roots: Vec<f64> = (0..links).map(|i| matrix[i * links + i].sqrt()).collect();
                for (i, entry) in matrix.iter_mut().enumerate() {
                    *entry /= roots[i % links] * roots[i / links];
                }
                let scaled = DMatrix::from_column_slice(links, links, &matrix);
                condition = condition.max(Ldlt::new(&scaled)?.condition_estimate(&matrix)?);
            }
        }
        println!("| {links} | {by_bodies:.1e} | {by_matrix:.1e} | {condition:.1e} | {:.1e} |", by_bodies / condition);
    }
    Ok(())
}
