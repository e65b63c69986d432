//! The outer Solar System for ten thousand years: time and error of the energy by coordinates, splitting and step.
//!
//! ```sh
//! cargo run --release -p piola-gravitation --example planets
//! ```
//!
//! The error is the largest of 1000 times of the run, relative to the energy at the start. The time is that of the fastest of
//! 200 runs of 1000 steps, with one corrector at either end. Collocation at Radau's nodes to rounding, the method of IAS15, has the
//! last row: its step is the mean, its time that of the fastest of 20 runs of 10⁵ days.
#![expect(clippy::print_stdout, reason = "it prints its table")]

mod outer_solar_system;

use std::ops::ControlFlow;
use std::time::Instant;

use outer_solar_system::outer_solar_system;
use piola_gravitation::Gravitation;
use piola_gravitation::hybrid::HybridSymplectic;
use piola_gravitation::wisdom_holman::{Corrector, DemocraticHeliocentric, Splitting, WisdomHolman};
use piola_integrators::{GaussRadau15, State, Step, unobserved};

/// 10⁴ years in days.
const END: f64 = 3_652_500.0;
/// Runs that are timed, and the steps of each: short ones, so that some run without a disturbance.
const RUNS: usize = 200;
const STEPS: f64 = 1000.0;

#[derive(Clone, Copy)]
enum Coordinates {
    Jacobi,
    Heliocentric,
    /// Heliocentric, with a look for close encounters in every motion.
    Hybrid,
}

impl Coordinates {
    const fn name(self) -> &'static str {
        match self {
            Self::Jacobi => "Jacobi",
            Self::Heliocentric => "heliocentric",
            Self::Hybrid => "heliocentric, hybrid",
        }
    }

    /// Integrates to a time and shows every so many steps.
    fn integrate(
        self,
        (step, splitting): (f64, Splitting),
        bodies: &Gravitation,
        state: &mut State,
        end: f64,
        shown: u64,
        observer: impl FnMut(Step<'_>) -> ControlFlow<()>,
    ) -> Result<(), Box<dyn std::error::Error>> {
        match self {
            Self::Jacobi => WisdomHolman::new(step, splitting)?.integrate(bodies, state, end, shown, observer)?,
            Self::Heliocentric => {
                DemocraticHeliocentric::new(step, splitting)?.integrate(bodies, state, end, shown, observer)?
            }
            Self::Hybrid => HybridSymplectic::new(step, splitting)?.integrate(bodies, state, end, shown, observer)?.run,
        };
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (bodies, start) = outer_solar_system()?;
    let energy = bodies.invariants(&start).energy;
    println!("| coordinates | splitting | step, d | ns a step | ns a day | error of the energy |");
    println!("|---|---|---|---|---|---|");
    let splittings = [
        Splitting::Leapfrog,
        Splitting::Corrected(Corrector::Three),
        Splitting::Corrected(Corrector::Seventeen),
        Splitting::TenSixFour,
    ];
    for coordinates in [Coordinates::Jacobi, Coordinates::Heliocentric, Coordinates::Hybrid] {
        for splitting in splittings {
            let steps: &[f64] = match splitting {
                Splitting::TenSixFour => &[1600.0, 800.0, 400.0, 200.0],
                _ => &[200.0, 100.0, 50.0, 25.0],
            };
            for &step in steps {
                let method = (step, splitting);
                let mut seconds = f64::INFINITY;
                for _ in 0..RUNS {
                    let mut state = State::new(0.0, start.clone())?;
                    let began = Instant::now();
                    coordinates.integrate(method, &bodies, &mut state, STEPS * step, 0, unobserved)?;
                    seconds = seconds.min(began.elapsed().as_secs_f64());
                }
                let (mut state, mut largest) = (State::new(0.0, start.clone())?, 0.0_f64);
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "a number of steps, 2 to 146"
                )]
                let shown = (END / step / 1000.0) as u64;
                coordinates.integrate(method, &bodies, &mut state, END, shown.max(1), |step| {
                    largest = largest.max((bodies.invariants(step.values).energy / energy - 1.0).abs());
                    ControlFlow::Continue(())
                })?;
                let each = 1e9 * seconds / STEPS;
                let name = coordinates.name();
                println!("| {name} | {splitting:?} | {step} | {each:.0} | {:.2} | {largest:.1e} |", each / step);
            }
        }
    }
    gauss_radau()
}

/// The row of collocation at Radau's nodes.
fn gauss_radau() -> Result<(), Box<dyn std::error::Error>> {
    const SPAN: f64 = 100_000.0;
    let (mut bodies, start) = outer_solar_system()?;
    let reader = bodies.clone();
    let energy = reader.invariants(&start).energy;
    let (mut seconds, mut steps) = (f64::INFINITY, 0.0);
    for _ in 0..20 {
        let mut state = State::new(0.0, start.clone())?;
        let began = Instant::now();
        let report = GaussRadau15::to_rounding().integrate_to(&mut bodies, &mut state, SPAN)?;
        seconds = seconds.min(began.elapsed().as_secs_f64());
        steps = report.steps as f64;
    }
    let (mut state, mut largest) = (State::new(0.0, start)?, 0.0_f64);
    for part in 1..=1000 {
        GaussRadau15::to_rounding().integrate_to(&mut bodies, &mut state, END * f64::from(part) / 1000.0)?;
        largest = largest.max((reader.invariants(&state.values).energy / energy - 1.0).abs());
    }
    let (step, each, day) = (SPAN / steps, 1e9 * seconds / steps, 1e9 * seconds / SPAN);
    println!("| barycentric | GaussRadau15, to rounding | {step:.0} | {each:.0} | {day:.2} | {largest:.1e} |");
    Ok(())
}
