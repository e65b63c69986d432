//! Time and true error of profiles, discharges and torques, and of histories.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use super::history::{self, Point};
use super::problems::{Answers, PLACES, Problem, problems};

/// Samples of each time, one in every round over all ways.
const ROUNDS: usize = 21;
/// The least time of a sample, s: short ways are repeated.
const SAMPLE: f64 = 2e-5;
/// Decimal exponents of the tolerances of plain quadrature.
const TOLERANCES: [i32; 10] = [-3, -4, -5, -6, -7, -8, -9, -10, -11, -12];

/// A way to an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// The median time, s.
    pub seconds: f64,
    /// The true error, relative to the largest of the answers.
    pub error: f64,
}

/// All ways to the answer of a problem.
#[derive(Clone, Debug)]
pub struct Row {
    /// `profile`, `discharge` or `torque`.
    pub what: &'static str,
    /// The flow.
    pub flow: &'static str,
    /// The fluid.
    pub fluid: &'static str,
    /// Ours.
    pub ours: Measurement,
    /// The error that ours states.
    pub bound: f64,
    /// Plain quadrature, with the exponents of its tolerances.
    pub plain: Vec<(i32, Measurement)>,
    /// The closed form.
    pub closed: Option<Measurement>,
}

/// Everything measured.
#[derive(Clone, Debug)]
pub struct Chart {
    /// The problems.
    pub rows: Vec<Row>,
    /// Error against evaluations of a history.
    pub history: Vec<Point>,
}

/// One way, as something to run.
enum Way<'a> {
    Ours(&'a Problem),
    Plain(&'a Problem, f64),
    Closed(&'a Problem),
}

impl Way<'_> {
    fn run(&self, answers: &mut Answers) {
        match self {
            Self::Ours(problem) => (problem.ours)(answers),
            Self::Plain(problem, tolerance) => (problem.plain)(*tolerance, answers),
            Self::Closed(problem) => {
                if let Some(closed) = &problem.closed {
                    closed(answers);
                }
            }
        }
    }

    fn problem(&self) -> &Problem {
        match self {
            Self::Ours(problem) | Self::Plain(problem, _) | Self::Closed(problem) => problem,
        }
    }
}

/// Measures everything.
///
/// # Errors
/// None: fluids and flows are within bounds.
pub fn chart() -> Result<Chart, Box<dyn Error>> {
    let problems = problems()?;
    let rows = problems.iter().map(measure).collect();
    Ok(Chart { rows, history: history::points()? })
}

fn measure(problem: &Problem) -> Row {
    let mut ways = vec![Way::Ours(problem)];
    ways.extend(TOLERANCES.map(|power| Way::Plain(problem, 10.0_f64.powi(power))));
    if problem.closed.is_some() {
        ways.push(Way::Closed(problem));
    }
    let mut measured: Vec<_> = times(&ways)
        .into_iter()
        .zip(&ways)
        .map(|(seconds, way)| {
            let mut answers = [0.0; PLACES];
            way.run(&mut answers);
            Measurement { seconds, error: way.problem().error(&answers) }
        })
        .collect();
    let closed = problem.closed.as_ref().and_then(|_| measured.pop());
    let plain = TOLERANCES.into_iter().zip(measured.split_off(1)).collect();
    let Problem { what, flow, fluid, bound, .. } = *problem;
    Row { what, flow, fluid, ours: measured[0], bound, plain, closed }
}

/// The median times of all ways, which take turns.
fn times(ways: &[Way<'_>]) -> Vec<f64> {
    let mut answers = [0.0; PLACES];
    let mut sample = |way: &Way<'_>, count: u32| {
        let start = Instant::now();
        for _ in 0..count {
            way.run(black_box(&mut answers));
        }
        start.elapsed().as_secs_f64()
    };
    let counts: Vec<u32> = ways
        .iter()
        .map(|way| {
            let mut count = 1;
            while sample(way, count) < SAMPLE {
                count *= 2;
            }
            count
        })
        .collect();
    let mut samples = vec![Vec::with_capacity(ROUNDS); ways.len()];
    for _ in 0..ROUNDS {
        for ((way, count), samples) in ways.iter().zip(&counts).zip(&mut samples) {
            samples.push(sample(way, *count) / f64::from(*count));
        }
    }
    let median = |mut samples: Vec<f64>| {
        samples.sort_by(f64::total_cmp);
        samples[samples.len() / 2]
    };
    samples.into_iter().map(median).collect()
}

impl Row {
    /// The plain ways that are as fast as ours and as accurate.
    pub fn beaten_by(&self) -> impl Iterator<Item = i32> {
        let ours = self.ours;
        let better = move |plain: &Measurement| plain.seconds <= ours.seconds && plain.error <= ours.error;
        self.plain.iter().filter(move |(_, plain)| better(plain)).map(|(power, _)| *power)
    }
}
