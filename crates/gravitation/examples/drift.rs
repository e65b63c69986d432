//! The outer Solar System for a hundred million evaluations of its forces: how the error of the energy grows.
//!
//! ```sh
//! cargo run --release -p piola-gravitation --example drift
//! ```
//!
//! Rows are evaluations so far. The error is the root mean square of (E − E₀)/E₀ over the looks since the row before, one look in
//! each hundredth of it. Rounding that is random grows like the root of the time; a method that loses energy like the time itself.
//! Bodies as in Hairer, Lubich & Wanner, *Geometric Numerical Integration*, I.2.4.
#![expect(clippy::print_stdout, reason = "it prints its table")]

use std::array::from_fn;
use std::error::Error;

use piola_gravitation::Gravitation;
use piola_integrators::{
    Composition, GaussLegendre16, GaussRadau15, Nystrom1210, Order, Report, State, Tolerance, Verner98,
};

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
/// Evaluations of each row.
const ROWS: [u64; 7] = [100_000, 316_000, 1_000_000, 3_160_000, 10_000_000, 31_600_000, 100_000_000];
/// A year in days.
const YEAR: f64 = 365.25;

/// Runs from row to row: `advance` integrates to a time. Evaluations in a day tell when a row is full.
fn rows(
    name: &str,
    mut advance: impl FnMut(&mut Gravitation, &mut State, f64) -> Result<Report, Box<dyn Error>>,
) -> Result<(), Box<dyn Error>> {
    let mut bodies = Gravitation::new(MASSES.map(|mass| G * mass).to_vec())?;
    // About the centre of mass, at rest: far from the origin positions would be rounded more and more coarsely.
    let centred = |values: &[[f64; 3]; 6]| {
        let total: f64 = MASSES.iter().sum();
        let mean: [f64; 3] = from_fn(|k| MASSES.iter().zip(values).map(|(mass, x)| mass * x[k]).sum::<f64>() / total);
        values.map(|x| from_fn(|k| x[k] - mean[k]))
    };
    let mut state = State::new(0.0, bodies.state(&centred(&POSITIONS), &centred(&VELOCITIES))?)?;
    let start = bodies.invariants(&state.values).energy;
    let trial = advance(&mut bodies, &mut state.clone(), 1000.0 * YEAR)?;
    let per_year = trial.evaluations as f64 / 1000.0;
    let mut done = 0_u64;
    print!("| {name} |");
    for row in ROWS {
        let span = (row - done) as f64 / per_year * YEAR;
        done = row;
        let from = state.time;
        let mut squares = 0.0;
        for look in 1..=100 {
            advance(&mut bodies, &mut state, from + span * f64::from(look) / 100.0)?;
            squares += (bodies.invariants(&state.values).energy / start - 1.0).powi(2);
        }
        print!(" {:.1e} |", (squares / 100.0).sqrt());
    }
    println!(" {:.1e} |", state.time / YEAR);
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("| method | {} years |", ROWS.map(|row| format!("{row:.0e} |")).join(" "));
    println!("|---|{}---|", "---|".repeat(ROWS.len()));
    let mut radau = GaussRadau15::to_rounding();
    rows("Gauss–Radau 15, to rounding", |bodies, state, end| Ok(radau.integrate_to(bodies, state, end)?))?;
    let mut legendre = GaussLegendre16::with_step(400.0)?;
    rows("Gauss–Legendre 16, 400 d", |bodies, state, end| Ok(legendre.integrate_to(bodies, state, end)?))?;
    let mut composition = Composition::new(Order::Eight, 100.0)?;
    rows("composition 8, 100 d", |bodies, state, end| Ok(composition.integrate_to(bodies, state, end)?))?;
    let mut nystrom = Nystrom1210::new(Tolerance::relative(1e-15)?);
    rows("Nyström 12(10), 1e-15", |bodies, state, end| Ok(nystrom.integrate_to(bodies, state, end)?))?;
    let mut verner = Verner98::new(Tolerance::relative(1e-15)?);
    rows("Verner 9(8), 1e-15", |bodies, state, end| Ok(verner.integrate_to(bodies, state, end)?))?;
    Ok(())
}
