//! The measured curves as a table of Rust, out of which `piola_integrators::advise` chooses.

use std::fmt::Write;
use std::hint::black_box;
use std::time::Instant;

use crate::problems::{Equations, Problem};
use crate::work_precision::{Curve, Family};

/// What the table says of one problem.
#[derive(Clone, Debug)]
pub struct Entry {
    name: &'static str,
    end: f64,
    turns: f64,
    uneven: bool,
    velocity_dependent: bool,
    evaluation: f64,
    curves: Vec<Curve>,
}

/// Arenstorf's orbit in the frame at rest: forces of positions alone, and so a problem of its own.
const AT_REST: &str = "arenstorf, frame at rest";

/// The entries of a problem: one for its equations, and one for those in the frame at rest where methods have such curves.
#[must_use]
pub fn entries<E: Equations<D>, const D: usize>(problem: &Problem<E, D>, curves: &[Curve]) -> Vec<Entry> {
    let (at_rest, others): (Vec<Curve>, Vec<Curve>) =
        curves.iter().cloned().partition(|curve| curve.name.contains("frame at rest"));
    let others = entry(problem, problem.name, others);
    let at_rest = if at_rest.is_empty() { None } else { entry(problem, AT_REST, at_rest) };
    others.into_iter().chain(at_rest).collect()
}

/// Turns (revolutions, swings) to the end of a problem, whether its steps must vary, and whether forces depend on velocities.
fn character(name: &str, end: f64) -> Option<(f64, bool, bool)> {
    let tau = std::f64::consts::TAU;
    Some(match name {
        "double-pendulum" => (end / (tau / 9.81_f64.sqrt()), false, true),
        "henon-heiles" => (end / tau, false, false),
        "kepler-03" => (10.0, false, false),
        "kepler" | "kepler-099" => (10.0, true, false),
        // Three loops and the way around.
        "arenstorf" => (4.0, true, true),
        // The same in the frame at rest, by `TurningFrame`.
        AT_REST => (4.0, true, false),
        // A body crosses the cluster in a unit of time.
        "pleiades" => (end, true, false),
        // Jupiter's year.
        "outer-solar-system" | "outer-solar-system-long" => (end / 4332.6, false, false),
        // Mercury's year.
        "inner-solar-system" => (end / 87.97, false, true),
        // Times in which a body crosses the cluster.
        "cluster" => (end / 2.83, true, false),
        _ => return None,
    })
}

/// The entry of a name, with the time of one evaluation of the problem's equations.
fn entry<E: Equations<D>, const D: usize>(
    problem: &Problem<E, D>,
    name: &'static str,
    curves: Vec<Curve>,
) -> Option<Entry> {
    const ROUNDS: usize = 20;
    const EVALUATIONS: u32 = 20_000;
    let (turns, uneven, velocity_dependent) = character(name, problem.end)?;
    let mut evaluation = f64::INFINITY;
    let (y, mut rate) = (black_box(problem.start), [0.0; D]);
    for _ in 0..ROUNDS {
        let start = Instant::now();
        for _ in 0..EVALUATIONS {
            problem.equations.rate(black_box(&y), &mut rate);
            black_box(&mut rate);
        }
        evaluation = evaluation.min(start.elapsed().as_secs_f64() / f64::from(EVALUATIONS));
    }
    Some(Entry { name, end: problem.end, turns, uneven, velocity_dependent, evaluation, curves })
}

/// The name of a method in the table, if it has a place there.
fn method(curve: &Curve) -> Option<&'static str> {
    let by_hand = !curve.name.contains("by placement") && !curve.name.contains("Gravitation");
    Some(match curve.family {
        Family::DormandPrince => "DormandPrince853",
        Family::Verner => "Verner98",
        Family::Nystrom86 if by_hand => "Nystrom86",
        Family::Nystrom1210 if by_hand => "Nystrom1210",
        Family::GaussLegendre16 if by_hand => "GaussLegendre16",
        Family::GaussRadau15 if by_hand => "GaussRadau15",
        Family::Composition if curve.order == 8 => "Composition8",
        _ => return None,
    })
}

/// The text of the table.
#[must_use]
pub fn table(entries: &[Entry]) -> String {
    let mut text = String::from(
        "//! Error against time, measured: written by `cargo xtask work-precision`.\n\n\
         use super::table::{Curve, Measured};\nuse super::AdvisedMethod::{\n    Composition8, DormandPrince853, GaussLegendre16, GaussRadau15, Nystrom86, Nystrom1210, Verner98,\n};\n\n\
         pub(super) const MEASURED: &[Measured] = &[\n",
    );
    for entry in entries {
        let Entry { name, end, turns, uneven, velocity_dependent, evaluation, curves } = entry;
        let _ = writeln!(
            text,
            "    Measured {{ problem: \"{name}\", turns: {turns:.3}, uneven: {uneven}, velocity_dependent: \
             {velocity_dependent}, evaluation: {evaluation:.3e}, curves: &["
        );
        for curve in curves {
            let Some(method) = method(curve) else { continue };
            let _ = writeln!(text, "        Curve {{ method: {method}, points: &[");
            for point in &curve.points {
                // A tolerance, or steps in a turn.
                let fixed = curve.family.is_fixed();
                let parameter = if fixed { end / turns / point.parameter } else { point.parameter };
                let _ = writeln!(
                    text,
                    "            [{parameter:.3e}, {:.2e}, {:.3e}, {}.0],",
                    point.error, point.seconds, point.evaluations
                );
            }
            text.push_str("        ] },\n");
        }
        text.push_str("    ] },\n");
    }
    text.push_str("];\n");
    text
}
