//! Long runs: the energy of the outer Solar System over a hundred million evaluations, and a free top over ten million steps.
//!
//! ```sh
//! cargo run --release -p piola-benches --bin long-runs -- docs/measurements/figures
//! ```
//!
//! It prints two tables and writes `long-run-outer-solar-system.svg` and `long-run-free-top.svg` to the folder. With `free-top` after the
//! folder it makes the second part alone.
#![expect(clippy::print_stdout, reason = "it prints its tables")]

use std::error::Error;
use std::path::Path;

use nalgebra::Vector3;
use piola_benches::methods::TopOnGroup;
use piola_benches::problems::{self, Top};
use piola_charts::{TimeCurve, colour, time_figure};
use piola_geometric::MuntheKaas;
use piola_gravitation::Gravitation;
use piola_integrators::{Composition, GaussLegendre, GaussLegendre16, GaussRadau15, Order, Report, State};
use piola_kinematics::{Attitude, FreeRotation, Inertia, RigidBody};
use piola_lagrangian::rigid_motion::RigidRotation;

const DAY: f64 = 86_400.0;
/// Evaluations at the end of each part of a run, and steps of the top.
const COLUMNS: [u64; 7] = [100_000, 316_000, 1_000_000, 3_160_000, 10_000_000, 31_600_000, 100_000_000];
const STEPS: [u32; 9] = [1000, 3000, 10_000, 30_000, 100_000, 300_000, 1_000_000, 3_000_000, 10_000_000];

/// The root mean square of (E − E₀)/E₀ over a hundred looks in each part of a run, at the times of the ends of the parts.
fn energy_errors(
    mut advance: impl FnMut(&mut Gravitation, &mut State, f64) -> Result<Report, Box<dyn Error>>,
) -> Result<Vec<(f64, f64)>, Box<dyn Error>> {
    let problem = problems::outer_solar_system_long()?;
    let mut bodies = Gravitation::new(problem.equations.parameters.to_vec())?;
    let mut state = State::new(0.0, problem.start.to_vec())?;
    let start = bodies.invariants(&state.values).energy;
    let trial = advance(&mut bodies, &mut state.clone(), problem.end)?;
    let per_day = trial.evaluations as f64 / problem.end;
    let (mut done, mut points) = (0, Vec::new());
    for column in COLUMNS {
        let between = (column - done) as f64 / per_day / 100.0;
        let (mut squares, mut looks) = (0.0, 0.0);
        while done < column {
            let end = state.time + between;
            done += advance(&mut bodies, &mut state, end)?.evaluations;
            squares += (bodies.invariants(&state.values).energy / start - 1.0).powi(2);
            looks += 1.0;
        }
        points.push((state.time * DAY, f64::sqrt(squares / looks)));
    }
    Ok(points)
}

/// The straight line of slope one half through the first point of a curve.
fn walk(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let Some(&(t, error)) = points.first() else { return Vec::new() };
    points.iter().map(|point| (point.0, error * (point.0 / t).sqrt())).collect()
}

/// The slope of the logarithms by least squares: 0.5 for a random walk, 1 for a drift.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logarithms = || points.iter().map(|(t, error)| (t.ln(), error.ln()));
    let (x, y) = logarithms().fold((0.0, 0.0), |sum, point| (sum.0 + point.0 / n, sum.1 + point.1 / n));
    let products = logarithms()
        .fold((0.0, 0.0), |sum, point| (sum.0 + (point.0 - x) * (point.1 - y), sum.1 + (point.0 - x) * (point.0 - x)));
    products.0 / products.1
}

fn outer_solar_system(folder: &Path) -> Result<(), Box<dyn Error>> {
    let mut radau = GaussRadau15::to_rounding();
    let mut legendre = GaussLegendre16::with_step(400.0)?;
    let mut composition = Composition::new(Order::Eight, 100.0)?;
    let runs = [
        ("Gauss–Radau 15", energy_errors(|bodies, state, end| Ok(radau.integrate_to(bodies, state, end)?))?),
        ("Gauss–Legendre 16", energy_errors(|bodies, state, end| Ok(legendre.integrate_to(bodies, state, end)?))?),
        ("composition 8", energy_errors(|bodies, state, end| Ok(composition.integrate_to(bodies, state, end)?))?),
    ];
    println!("| method | {} slope |\n|---|{}---|", COLUMNS.map(|n| format!("{n:.0e} |")).join(" "), "---|".repeat(7));
    let mut curves = Vec::new();
    for (index, (name, points)) in runs.iter().enumerate() {
        let errors: Vec<String> = points.iter().map(|(_, error)| format!("{error:.1e}")).collect();
        println!("| {name} | {} | {:.2} |", errors.join(" | "), slope(points));
        curves.push(TimeCurve { name: (*name).into(), colour: colour(index), points: points.clone() });
    }
    let walk = walk(&runs[0].1);
    curves.push(TimeCurve { name: "root of the time".into(), colour: colour(3), points: walk });
    let title = "Outer Solar System: error of the energy, 10⁸ evaluations";
    std::fs::write(folder.join("long-run-outer-solar-system.svg"), time_figure(title, "relative error", curves, true))?;
    Ok(())
}

/// Errors of the energy and of the angular momentum in space, relative to themselves.
fn kept(top: &Top, state: &[f64], start: &[f64]) -> [f64; 2] {
    let of = |y: &[f64]| {
        let spin = Vector3::from([0, 1, 2].map(|i| top.inertia[i] * y[4 + i]));
        let energy: f64 = (0..3).map(|i| 0.5 * spin[i] * y[4 + i]).sum();
        (energy, Attitude { w: y[0], x: y[1], y: y[2], z: y[3] }.to_space(&spin))
    };
    let ((energy, momentum), (first_energy, first)) = (of(state), of(start));
    [(energy / first_energy - 1.0).abs(), (momentum - first).norm() / first.norm()]
}

fn free_top(folder: &Path) -> Result<(), Box<dyn Error>> {
    const STEP: f64 = 0.0625;
    let problem = problems::free_top()?;
    let (top, start) = (problem.equations, problem.start);
    let inertia = Inertia::principal(top.inertia)?;
    let [w, x, y, z, a, b, c] = start;
    let motion = FreeRotation::new(&inertia, Attitude::from_quaternion([w, x, y, z])?, [a, b, c].into())?;
    let body = RigidBody::new(1.0, inertia)?;
    let (mut free, mut on_group) = (RigidRotation::free(&body)?, TopOnGroup::new(top));
    let mut collocation = GaussLegendre::new(Order::Eight, STEP)?;
    let mut on_the_group = MuntheKaas::new(Order::Eight, STEP)?;
    let mut by_collocation = State::new(0.0, start.to_vec())?;
    let mut by_group = by_collocation.clone();
    let names = ["closed form", "Gauss–Legendre 8", "Munthe-Kaas 8"];
    println!("\n| steps of 1/16 s | {} |", names.map(|name| format!("{name}: energy | angular momentum")).join(" | "));
    println!("|---|{}", "---|".repeat(6));
    let mut points: [Vec<(f64, f64)>; 6] = Default::default();
    for steps in STEPS {
        let end = f64::from(steps) * STEP;
        collocation.integrate_to(&mut free, &mut by_collocation, end)?;
        on_the_group.integrate_to(&mut on_group, &mut by_group, end)?;
        let (attitude, omega) = motion.at(end);
        let closed = [attitude.w, attitude.x, attitude.y, attitude.z, omega.x, omega.y, omega.z];
        let errors = [&closed[..], &by_collocation.values, &by_group.values].map(|y| kept(&top, y, &start));
        for (points, &error) in points.iter_mut().zip(errors.as_flattened()) {
            points.push((end, error.max(1e-17)));
        }
        let cells: Vec<String> = errors.as_flattened().iter().map(|error| format!("{error:.1e}")).collect();
        println!("| {steps:.0e} | {} |", cells.join(" | "));
    }
    let curves = points.into_iter().enumerate().map(|(index, points)| {
        let what = if index % 2 == 0 { "energy" } else { "spin" };
        TimeCurve { name: format!("{}, {what}", names[index / 2]), colour: colour(index), points }
    });
    let title = "Free top: errors of energy and angular momentum, 10⁷ steps";
    let svg = time_figure(title, "relative error", curves.collect(), true);
    std::fs::write(folder.join("long-run-free-top.svg"), svg)?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    let folder = Path::new(&folder);
    match std::env::args().nth(2).as_deref() {
        None => outer_solar_system(folder)?,
        Some("free-top") => {}
        Some(part) => return Err(format!("there is no part `{part}`: say `free-top`, or nothing for all parts").into()),
    }
    free_top(folder)
}
