//! Bodies that attract each other: a circle kept for a hundred turns, and an ellipse after Kepler's third law.
#![expect(clippy::print_stdout, reason = "an example prints")]

use core::f64::consts::TAU;

use piola::gravitation::Gravitation;
use piola::integrators::{Composition, DormandPrince853, Order, State, Tolerance};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Two equal bodies, Gm = 1 each, 2 apart, on a circle: speed ½, period 4π. A symplectic method of order 8.
    let mut pair = Gravitation::new(vec![1.0, 1.0])?;
    let start = pair.state(&[[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]], &[[0.0, 0.5, 0.0], [0.0, -0.5, 0.0]])?;
    let energy = pair.invariants(&start).energy;
    let (mut state, period) = (State::new(0.0, start)?, 2.0 * TAU);
    Composition::new(Order::Eight, period / 100.0)?.integrate_to(&mut pair, &mut state, 100.0 * period)?;
    let drift = pair.invariants(&state.values).energy / energy - 1.0;
    let place = pair.position(&state.values, 0);
    println!("after 100 turns: x = {:.12}, change of the energy {drift:.1e}", place[0]);
    assert!((place[0] - 1.0).abs() < 1e-9 && drift.abs() < 1e-13);

    // A comet about a heavy body, from the aphelion 1 + e at √((1 − e)/(1 + e)): back after 2π, since a = 1.
    let eccentricity = 0.9_f64;
    let mut comet = Gravitation::new(vec![1.0, 0.0])?;
    let speed = ((1.0 - eccentricity) / (1.0 + eccentricity)).sqrt();
    let start = comet.state(&[[0.0; 3], [1.0 + eccentricity, 0.0, 0.0]], &[[0.0; 3], [0.0, speed, 0.0]])?;
    let mut state = State::new(0.0, start)?;
    DormandPrince853::new(Tolerance::relative(1e-13)?).integrate_to(&mut comet, &mut state, TAU)?;
    let place = comet.position(&state.values, 1);
    println!("after one turn:  x = {:.12}, y = {:.1e}", place[0], place[1]);
    assert!((place[0] - 1.9).abs() < 1e-11 && place[1].abs() < 1e-10);
    Ok(())
}
