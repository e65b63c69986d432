//! Energy error against evaluations of the force: compositions beside Runge–Kutta–Nyström splittings.
//!
//! ```text
//! cargo run --release -p piola-integrators --example splittings
//! ```
//!
//! Kepler's ellipse of eccentricity 0.3 over 200 revolutions, and Hénon and Heiles' potential at the energy 1/8 over 1000 s. Of each
//! scheme the table has the largest energy error at the end of any step, at as many forces for all; the forces of the processor do not count.

#![expect(clippy::print_stdout, reason = "it prints its table")]

use std::convert::Infallible;
use std::ops::ControlFlow;

use piola_integrators::{Composition, IntegratorsError, ProcessedSplitting, Separable, SplittingScheme, State, Step};

struct Kepler;
impl Separable for Kepler {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        2
    }
    fn force(&mut self, _t: f64, q: &[f64], force: &mut [f64]) -> Result<(), Infallible> {
        let square = q[0] * q[0] + q[1] * q[1];
        let factor = 1.0 / (square * square.sqrt());
        force.copy_from_slice(&[-q[0] * factor, -q[1] * factor]);
        Ok(())
    }
}

struct HenonHeiles;
impl Separable for HenonHeiles {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        2
    }
    fn force(&mut self, _t: f64, q: &[f64], force: &mut [f64]) -> Result<(), Infallible> {
        force.copy_from_slice(&[-q[0] - 2.0 * q[0] * q[1], -q[1] - q[0] * q[0] + q[1] * q[1]]);
        Ok(())
    }
}

/// The splittings of the table.
#[derive(Clone, Copy)]
enum Splitting {
    Scheme(SplittingScheme),
    Processed,
}

impl Splitting {
    fn name(self) -> String {
        match self {
            Self::Scheme(scheme) => scheme.to_string(),
            Self::Processed => "processed, order 6, 7 forces".into(),
        }
    }

    /// The largest energy error at the end of any step of a run with so many forces a second; those of a processor do not count.
    fn worst<F: Separable<Error = Infallible>>(
        self,
        field: &mut F,
        start: [f64; 4],
        (end, rate): (f64, f64),
        energy: fn(&[f64]) -> f64,
    ) -> Result<f64, IntegratorsError> {
        let mut state = State::new(0.0, start.to_vec())?;
        let before = energy(&start);
        let mut worst = 0.0_f64;
        let observer = |step: Step<'_>| {
            worst = worst.max((energy(step.values) - before).abs());
            ControlFlow::Continue(())
        };
        match self {
            Self::Scheme(scheme) => Composition::with_scheme(scheme, scheme.forces() as f64 / rate)?
                .integrate(field, &mut state, end, observer)?,
            Self::Processed => ProcessedSplitting::new(7.0 / rate)?.integrate(field, &mut state, end, 1, observer)?,
        };
        Ok(worst)
    }
}

fn main() -> Result<(), IntegratorsError> {
    let kepler = |y: &[f64]| 0.5 * (y[2] * y[2] + y[3] * y[3]) - 1.0 / y[0].hypot(y[1]);
    let henon = |y: &[f64]| {
        0.5 * (y[2] * y[2] + y[3] * y[3] + y[0] * y[0] + y[1] * y[1]) + y[0] * y[0] * y[1] - y[1].powi(3) / 3.0
    };
    let turn = std::f64::consts::TAU;
    println!("forces a revolution (Kepler, e = 0.3) or in 2π s (Hénon–Heiles); largest energy error");
    for (name, is_kepler) in [("Kepler", true), ("Hénon–Heiles", false)] {
        let rates = [100.0, 200.0, 400.0, 800.0, 1600.0];
        println!("\n| {name} | {} |", rates.map(|rate| rate.to_string()).join(" | "));
        println!("|---|{}", "---|".repeat(rates.len()));
        for splitting in SplittingScheme::ALL.into_iter().map(Splitting::Scheme).chain([Splitting::Processed]) {
            let mut row = Vec::new();
            for rate in rates.map(|rate| rate / turn) {
                let error = if is_kepler {
                    let start = [0.7, 0.0, 0.0, (1.3_f64 / 0.7).sqrt()];
                    splitting.worst(&mut Kepler, start, (200.0 * turn, rate), kepler)?
                } else {
                    splitting.worst(&mut HenonHeiles, [0.0, 0.1, 0.4877, 0.0], (1000.0, rate), henon)?
                };
                row.push(format!("{error:.1e}"));
            }
            println!("| {} | {} |", splitting.name(), row.join(" | "));
        }
    }
    Ok(())
}
