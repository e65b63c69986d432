//! A chain of a hundred rods falls from the horizontal: what becomes of its energy.
//!
//! ```sh
//! cargo run --release -p piola-multibody --example falling_chain -- 100 10
//! ```
//!
//! Arguments: links, seconds. Rods of 1 m and 1 kg, all axes y, a step of 1 ms for the variational method. The error of the
//! energy is the largest of the run, over m g l of one rod.
#![expect(clippy::print_stdout, reason = "it prints its table")]

use std::error::Error;
use std::ops::ControlFlow;
use std::time::Instant;

use piola_integrators::{DormandPrince853, Order, State, Tolerance};
use piola_multibody::{BodyIndex, JointKind, RigidTree, TreeJoint, VariationalTree};

#[path = "../tests/it/trees.rs"]
#[expect(dead_code, reason = "the tests need more trees")]
mod trees;

fn chain(links: usize) -> Result<RigidTree, Box<dyn Error>> {
    let mut builder = RigidTree::builder();
    let mut parent = BodyIndex::GROUND;
    for i in 0..links {
        let joint = TreeJoint::new(format!("joint {i}"), JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
        let joint = if i == 0 { joint } else { joint.at([0.0, 0.0, -1.0]) };
        parent = builder.attach(parent, joint, format!("rod {i}"), trees::rod())?;
    }
    Ok(builder.build()?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1).filter_map(|argument| argument.parse::<usize>().ok());
    let (links, seconds) = (arguments.next().unwrap_or(20), arguments.next().unwrap_or(1));
    let tree = chain(links)?;
    let mut work = tree.workspace();
    let mut start = vec![0.0; links];
    start[0] = core::f64::consts::FRAC_PI_2;
    let zero = vec![0.0; links];
    let first = tree.tree_energies(&mut work, &start, &zero)?.potential;
    let mut error = |q: &[f64], v: &[f64]| {
        let now = tree.tree_energies(&mut work, q, v).map_or(f64::NAN, |now| now.kinetic + now.potential);
        (now - first).abs() / 9.81
    };
    println!("| method | largest error of the energy, m g l | time, s | |");
    println!("|---|---|---|---|");
    for order in [Order::Two, Order::Four, Order::Six, Order::Eight] {
        let (mut q, mut v, mut worst) = (start.clone(), zero.clone(), 0.0_f64);
        let clock = Instant::now();
        let mut method = VariationalTree::new(&tree, order, 1e-3)?;
        let outcome = method.run_under(
            &mut q,
            &mut v,
            1000 * seconds,
            |_, _, _, tau| tau.fill(0.0),
            |_, q, v| {
                worst = worst.max(error(q, v));
                ControlFlow::Continue(())
            },
        );
        let note = outcome.map_or_else(|error| error.to_string(), |()| format!("{} corrections", method.iterations()));
        println!(
            "| variational, order {} | {worst:.1e} | {:.1} | {note} |",
            order.value(),
            clock.elapsed().as_secs_f64()
        );
    }
    for relative in [1e-10, 1e-12, 1e-13] {
        let mut motion = tree.motion(|_t, _q: &[f64], _v: &[f64], tau: &mut [f64]| tau.fill(0.0));
        let mut state = State::new(0.0, [start.clone(), zero.clone()].concat())?;
        let mut worst = 0.0_f64;
        let clock = Instant::now();
        let mut method = DormandPrince853::new(Tolerance::relative(relative)?);
        let report = method.integrate(&mut motion, &mut state, seconds as f64, |step| {
            let (q, v) = step.values().split_at(links);
            worst = worst.max(error(q, v));
            ControlFlow::Continue(())
        })?;
        let time = clock.elapsed().as_secs_f64();
        println!("| adaptive, {relative:.0e} | {worst:.1e} | {time:.1} | {} steps |", report.steps);
    }
    Ok(())
}
