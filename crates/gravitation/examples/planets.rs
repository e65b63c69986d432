//! The outer Solar System for ten thousand years: time and error of the energy by coordinates, splitting and step.
//!
//! ```sh
//! cargo run --release -p piola-gravitation --example planets
//! ```
//!
//! The error is the largest of 1000 times of the run, relative to the energy at the start. The time is that of the fastest of
//! 200 runs of 1000 steps, with one corrector at either end. Bodies as in Hairer, Lubich &
//! Wanner, *Geometric Numerical Integration*, I.2.4: `testdata/reference/outer_solar_system.json`.
#![expect(clippy::print_stdout, reason = "it prints its table")]

use std::ops::ControlFlow;
use std::time::Instant;

use piola_gravitation::Gravitation;
use piola_gravitation::hybrid::HybridSymplectic;
use piola_gravitation::wisdom_holman::{Corrector, DemocraticHeliocentric, Splitting, WisdomHolman};
use piola_integrators::{State, Step, unobserved};

/// G in AU³/(Sun's mass · day²).
const G: f64 = 2.959_122_082_86e-4;
/// Sun with inner planets, Jupiter, Saturn, Uranus, Neptune, Pluto.
const MASSES: [f64; 6] = [
    1.000_005_976_82,
    0.000_954_786_104_043,
    0.000_285_583_733_151,
    0.000_043_727_316_454_6,
    0.000_051_775_913_844_9,
    1.0 / 130_000_000.0,
];
const POSITIONS: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [-3.502_365_3, -3.816_984_7, -1.550_796_3],
    [9.075_531_4, -3.045_835_3, -1.648_370_8],
    [8.310_142_0, -16.290_108_6, -7.252_127_8],
    [11.470_766_6, -25.729_482_9, -10.816_945_6],
    [-15.538_735_7, -25.222_559_4, -3.190_238_2],
];
const VELOCITIES: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [0.005_654_29, -0.004_124_90, -0.001_905_89],
    [0.001_683_18, 0.004_835_25, 0.001_924_62],
    [0.003_541_78, 0.001_371_02, 0.000_550_29],
    [0.002_889_30, 0.001_145_27, 0.000_396_77],
    [0.002_767_25, -0.001_707_02, -0.001_365_04],
];
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
    let bodies = Gravitation::new(MASSES.map(|mass| G * mass).to_vec())?;
    // About the mass centre, which else takes all bodies away.
    let total: f64 = MASSES.iter().sum();
    let centred = |of: [[f64; 3]; 6]| {
        let centre = [0, 1, 2].map(|axis| of.iter().zip(MASSES).map(|(x, m)| m * x[axis]).sum::<f64>() / total);
        of.map(|x| [0, 1, 2].map(|axis| x[axis] - centre[axis]))
    };
    let start = bodies.state(&centred(POSITIONS), &centred(VELOCITIES))?;
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
    Ok(())
}
