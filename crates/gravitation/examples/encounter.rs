//! Two planets that meet at 0.04 Hill radii: time and errors by splitting and step.
//!
//! ```sh
//! cargo run --release -p piola-gravitation --example encounter
//! ```
//!
//! A star with three planets for twenty units of time, three revolutions of the inner one. Bodies and the places at the end, in 30
//! digits, are those of `testdata/reference/planet_encounter.json`. Errors are those at the end: of the energy, relative, and of the
//! place of a body, the largest. The time is that of the fastest of 20 runs.
#![expect(clippy::print_stdout, reason = "it prints its table")]

use std::time::Instant;

use piola_gravitation::Gravitation;
use piola_gravitation::hybrid::{HybridSymplectic, critical_radii};
use piola_gravitation::wisdom_holman::{Corrector, DemocraticHeliocentric, Splitting};
use piola_integrators::{GaussRadau15, State};

/// Gm of the star and of the planets.
const PARAMETERS: [f64; 4] = [1.0, 1.0 / 1024.0, 1.0 / 4096.0, 1.0 / 16384.0];
const POSITIONS: [[f64; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [0.106_445_312_5, 0.975_097_656_25, 0.0],
    [-1.146_728_515_625, -0.254_394_531_25, 0.005_615_234_375],
    [-1.434_082_031_25, -1.992_431_640_625, 0.002_685_546_875],
];
const VELOCITIES: [[f64; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [-1.012_939_453_125, 0.116_699_218_75, 0.0],
    [0.090_576_171_875, -0.920_410_156_25, -0.007_568_359_375],
    [0.495_117_187_5, -0.390_869_140_625, -0.012_451_171_875],
];
/// The places after twenty units of time.
const END: [[f64; 3]; 4] = [
    [-0.018_290_046_972_549_264, -0.002_472_304_373_143_657, -5.406_466_822_662_245_e-0_5],
    [-0.872_784_122_954_444_4, 0.489_451_960_015_360_7, 0.002_727_280_354_975_822_5],
    [1.172_027_677_101_317_2, 0.313_367_116_382_108_96, -0.006_340_892_160_783_680_5],
    [-2.369_493_736_637_008_6, -0.093_357_554_313_529_66, 0.038_176_904_063_503_81],
];
const TIME: f64 = 20.0;
const RUNS: usize = 20;

struct Outcome {
    milliseconds: f64,
    energy: f64,
    place: f64,
    note: String,
}

fn measure(
    bodies: &Gravitation,
    start: &[f64],
    mut run: impl FnMut(&mut State) -> Result<String, Box<dyn std::error::Error>>,
) -> Result<Outcome, Box<dyn std::error::Error>> {
    let mut outcome = Outcome { milliseconds: f64::INFINITY, energy: 0.0, place: 0.0, note: String::new() };
    for _ in 0..RUNS {
        let mut state = State::new(0.0, start.to_vec())?;
        let began = Instant::now();
        outcome.note = run(&mut state)?;
        outcome.milliseconds = outcome.milliseconds.min(1e3 * began.elapsed().as_secs_f64());
        outcome.energy = (bodies.invariants(&state.values).energy / bodies.invariants(start).energy - 1.0).abs();
        outcome.place = (0..4).fold(0.0, |largest: f64, body| {
            let found = bodies.position(&state.values, body);
            (0..3).fold(largest, |largest, axis| largest.max((found[axis] - END[body][axis]).abs()))
        });
    }
    Ok(outcome)
}

fn row(name: &str, step: f64, outcome: &Outcome) {
    let Outcome { milliseconds, energy, place, note } = outcome;
    println!("| {name} | {step} | {milliseconds:.2} | {energy:.1e} | {place:.1e} | {note} |");
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let bodies = Gravitation::new(PARAMETERS.to_vec())?;
    let start = bodies.state(&POSITIONS, &VELOCITIES)?;
    println!("| method | step | ms | error of the energy | error of a place | steps with an encounter |");
    println!("|---|---|---|---|---|---|");
    let outcome = measure(&bodies, &start, |state| {
        let report = GaussRadau15::to_rounding().integrate_to(&mut bodies.clone(), state, TIME)?;
        Ok(format!("{} steps", report.steps))
    })?;
    row("Gauss–Radau 15", 0.0, &outcome);
    let outcome = measure(&bodies, &start, |state| {
        let report = DemocraticHeliocentric::new(0.0125, Splitting::TenSixFour)?.integrate_to(&bodies, state, TIME)?;
        Ok(format!("0 of {}", report.steps))
    })?;
    row("(10, 6, 4) without encounters", 0.0125, &outcome);
    let splittings = [
        (Splitting::Leapfrog, [0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625]),
        (Splitting::Corrected(Corrector::Seventeen), [0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625]),
        (Splitting::TenSixFour, [0.4, 0.2, 0.1, 0.05, 0.025, 0.0125]),
    ];
    // One Hamiltonian for all steps: radii of three Hill radii alone.
    let radii = critical_radii(&bodies, &start, 3.0, 0.0)?;
    for (splitting, steps) in splittings {
        for step in steps {
            let method = HybridSymplectic::new(step, splitting)?.with_critical_radii(radii.clone())?;
            let outcome = measure(&bodies, &start, |state| {
                let report = method.integrate_to(&bodies, state, TIME)?;
                Ok(format!("{} of {}", report.encounter_steps, report.run.steps))
            })?;
            let name = match splitting {
                Splitting::Leapfrog => "leapfrog",
                Splitting::Corrected(_) => "corrector of order 17",
                Splitting::TenSixFour => "(10, 6, 4)",
            };
            row(name, step, &outcome);
        }
    }
    Ok(())
}
