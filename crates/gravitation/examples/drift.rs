//! The outer Solar System for a hundred million evaluations of its forces: how the error of the energy grows.
//!
//! ```sh
//! cargo run --release -p piola-gravitation --example drift
//! ```
//!
//! Columns are evaluations so far. The error is the root mean square of (E − E₀)/E₀ over some hundred looks since the column
//! before. The random error of rounding grows like the square root of the time; a drift of the energy grows like the time.
#![expect(clippy::print_stdout, reason = "it prints its table")]

mod outer_solar_system;

use std::error::Error;

use outer_solar_system::outer_solar_system;
use piola_gravitation::Gravitation;
use piola_integrators::{
    Composition, GaussLegendre16, GaussRadau15, Nystrom1210, Order, Report, State, Tolerance, Verner98,
};

/// Evaluations at the end of each column.
const COLUMNS: [u64; 7] = [100_000, 316_000, 1_000_000, 3_160_000, 10_000_000, 31_600_000, 100_000_000];
/// A year in days.
const YEAR: f64 = 365.25;

/// Integrates from column to column; `advance` integrates to a time. A trial run gives the evaluations in a year, by which some
/// hundred looks of a column are spaced.
fn row(
    name: &str,
    mut advance: impl FnMut(&mut Gravitation, &mut State, f64) -> Result<Report, Box<dyn Error>>,
) -> Result<(), Box<dyn Error>> {
    let (mut bodies, start) = outer_solar_system()?;
    let mut state = State::new(0.0, start)?;
    let start = bodies.invariants(&state.values).energy;
    let trial = advance(&mut bodies, &mut state.clone(), 1000.0 * YEAR)?;
    let per_day = trial.evaluations as f64 / (1000.0 * YEAR);
    let mut done = 0_u64;
    print!("| {name} |");
    for column in COLUMNS {
        let between = (column - done) as f64 / per_day / 100.0;
        let (mut squares, mut looks) = (0.0, 0.0);
        while done < column {
            let end = state.time + between;
            done += advance(&mut bodies, &mut state, end)?.evaluations;
            squares += (bodies.invariants(&state.values).energy / start - 1.0).powi(2);
            looks += 1.0;
        }
        print!(" {:.1e} |", f64::sqrt(squares / looks));
    }
    println!(" {:.1e} |", state.time / YEAR);
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("| method | {} years |", COLUMNS.map(|row| format!("{row:.0e} |")).join(" "));
    println!("|---|{}---|", "---|".repeat(COLUMNS.len()));
    let mut radau = GaussRadau15::to_rounding();
    row("Gauss–Radau 15, to rounding", |bodies, state, end| Ok(radau.integrate_to(bodies, state, end)?))?;
    let mut legendre = GaussLegendre16::with_step(400.0)?;
    row("Gauss–Legendre 16, 400 d", |bodies, state, end| Ok(legendre.integrate_to(bodies, state, end)?))?;
    let mut composition = Composition::new(Order::Eight, 100.0)?;
    row("composition 8, 100 d", |bodies, state, end| Ok(composition.integrate_to(bodies, state, end)?))?;
    let mut nystrom = Nystrom1210::new(Tolerance::relative(1e-15)?);
    row("Nyström 12(10), 1e-15", |bodies, state, end| Ok(nystrom.integrate_to(bodies, state, end)?))?;
    let mut verner = Verner98::new(Tolerance::relative(1e-15)?);
    row("Verner 9(8), 1e-15", |bodies, state, end| Ok(verner.integrate_to(bodies, state, end)?))?;
    Ok(())
}
