//! A pendulum in ten lines: its period beside that of small swings.
#![expect(clippy::print_stdout, reason = "an example prints")]

use nalgebra::Vector3;
use piola::integrators::{Crossing, DormandPrince853, Event, EventAction, State, Tolerance};
use piola::lagrangian::{Holonomic, Lagrangian, Placement};
use piola::numerics::Real;
use std::ops::ControlFlow::Continue;

struct Pendulum;

impl Holonomic for Pendulum {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let (s, c) = q[0].sin_cos();
        bodies.particle(1.0, Vector3::new(s, T::zero(), -c));
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pendulum = Lagrangian::of(Pendulum).with_gravity(9.80665);
    let small = std::f64::consts::TAU / 9.80665_f64.sqrt();
    for degrees in [1.0_f64, 30.0, 90.0, 150.0] {
        let mut state = State::new(0.0, vec![degrees.to_radians(), 0.0])?;
        let mut bottom = [Event::new(Crossing::Falling, EventAction::Stop, |_t, y| y[0])];
        let mut method = DormandPrince853::new(Tolerance::relative(1e-13)?);
        method.integrate_with_events(
            &mut pendulum.motion(1),
            &mut state,
            60.0,
            &mut bottom,
            |_| Continue(()),
            |_| Continue(()),
        )?;
        let period = 4.0 * state.time;
        println!("swing of {degrees:5}°: period {period:.12} s, {:.12} of small swings", period / small);
        // Gauss: the ratio is 1/agm(1, cos(φ/2)), the arithmetic-geometric mean.
        let (mut a, mut b) = (1.0, (0.5 * degrees.to_radians()).cos());
        for _ in 0..6 {
            (a, b) = (0.5 * (a + b), (a * b).sqrt());
        }
        assert!((period / small * a - 1.0).abs() < 1e-11);
    }
    Ok(())
}
