//! How far the time of a run is from that of its evaluations alone.
//!
//! ```text
//! cargo run --release -p piola-integrators --example floors
//! ```
//!
//! For four problems, and for errors from 1e-6 to 1e-12, the first table has each method that reaches the error: the time of its run, its
//! evaluations of the field, and the time of so many evaluations alone. A method with these evaluations cannot be faster than that. Times
//! are the least of many, points of a curve are interpolated.
//!
//! The second table adds to the evaluations of Gauss–Legendre collocation the products of its tableau alone: the floor of that method.
//!
//! The last table has Taylor's method with a recursion written by hand for Hénon and Heiles' potential, in five orders. It shows what Taylor's
//! method can gain on a field of polynomials, without the cost of a recorded formula.

#![expect(clippy::print_stdout, reason = "it prints its tables")]

mod tableau;

use std::convert::Infallible;
use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

use piola_integrators::{
    DormandPrince853, Field, GaussLegendre16, GaussRadau15, IntegratorsError, Nystrom86, Nystrom1210, Report,
    SecondOrder, State, Tolerance, Verner98,
};
use piola_numerics::{Kernel, Lanes, Real, dispatch};
use tableau::products;

/// Accelerations over any scalar, of two coordinates.
trait Motion: Copy {
    const VELOCITY_DEPENDENT: bool;
    fn acceleration<T: Real>(&self, q: [T; 2], v: [T; 2]) -> [T; 2];
}

#[derive(Clone, Copy)]
struct Equations<M>(M);

impl<T: Real, M: Motion> SecondOrder<T> for Equations<M> {
    type Error = Infallible;
    const VELOCITY_DEPENDENT: bool = M::VELOCITY_DEPENDENT;
    const FREEDOM: Option<usize> = Some(2);
    fn freedom(&self) -> usize {
        2
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration(&mut self, _t: T, q: &[T], v: &[T], out: &mut [T]) -> Result<(), Infallible> {
        // Without velocities theirs are not given.
        let v = if M::VELOCITY_DEPENDENT { [v[0], v[1]] } else { [T::zero(); 2] };
        [out[0], out[1]] = self.0.acceleration([q[0], q[1]], v);
        Ok(())
    }
}

impl<M: Motion> Field for Equations<M> {
    type Error = Infallible;
    const DIMENSION: Option<usize> = Some(4);
    fn dimension(&self) -> usize {
        4
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rate(&mut self, _t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
        [rate[0], rate[1]] = [y[2], y[3]];
        [rate[2], rate[3]] = self.0.acceleration([y[0], y[1]], [y[2], y[3]]);
        Ok(())
    }
    fn is_second_order(&self) -> bool {
        true
    }
}

#[derive(Clone, Copy)]
struct HenonHeiles;
impl Motion for HenonHeiles {
    const VELOCITY_DEPENDENT: bool = false;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration<T: Real>(&self, [x, y]: [T; 2], _v: [T; 2]) -> [T; 2] {
        [-x - (x + x) * y, y * y - y - x * x]
    }
}

#[derive(Clone, Copy)]
struct Kepler;
impl Motion for Kepler {
    const VELOCITY_DEPENDENT: bool = false;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration<T: Real>(&self, [x, y]: [T; 2], _v: [T; 2]) -> [T; 2] {
        let square = x * x + y * y;
        let factor = -T::one() / (square * square.sqrt());
        [factor * x, factor * y]
    }
}

/// The restricted problem of three bodies in the frame that turns with two of them.
#[derive(Clone, Copy)]
struct Arenstorf;
impl Motion for Arenstorf {
    const VELOCITY_DEPENDENT: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration<T: Real>(&self, [x, y]: [T; 2], [u, v]: [T; 2]) -> [T; 2] {
        let (moon, earth) = (T::lit(0.012_277_471), T::lit(1.0 - 0.012_277_471));
        let (from_earth, from_moon, height) = (x + moon, x - earth, y * y);
        let (r1, r2) = (from_earth * from_earth + height, from_moon * from_moon + height);
        let (d1, d2) = (earth / (r1 * r1.sqrt()), moon / (r2 * r2.sqrt()));
        [x + (v + v) - d1 * from_earth - d2 * from_moon, y - (u + u) - (d1 + d2) * y]
    }
}

/// Two unit masses on unit rods.
#[derive(Clone, Copy)]
struct DoublePendulum;
impl Motion for DoublePendulum {
    const VELOCITY_DEPENDENT: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration<T: Real>(&self, [a, b]: [T; 2], [u, v]: [T; 2]) -> [T; 2] {
        let (s1, c1) = a.sin_cos();
        let (s2, c2) = b.sin_cos();
        let (sine, cosine) = (s1 * c2 - c1 * s2, c1 * c2 + s1 * s2);
        let (g, two) = (T::lit(9.81), T::lit(2.0));
        let (first, second) = (-sine * v * v - two * g * s1, sine * u * u - g * s2);
        let inverse = (two - cosine * cosine).recip();
        [(first - cosine * second) * inverse, (two * second - cosine * first) * inverse]
    }
}

/// A run: tolerance, error at the end, evaluations, least time in seconds.
#[derive(Clone, Copy, Debug)]
struct Point {
    error: f64,
    evaluations: f64,
    steps: f64,
    seconds: f64,
}

const ROUNDS: usize = 200;

fn least(mut work: impl FnMut()) -> f64 {
    (0..ROUNDS).fold(f64::INFINITY, |least, _| {
        let start = Instant::now();
        work();
        least.min(start.elapsed().as_secs_f64())
    })
}

/// The curve of a method.
fn curve(
    reference: &[f64],
    start: [f64; 4],
    run: impl Fn(Tolerance, &mut State) -> Result<Report, IntegratorsError>,
) -> Result<Vec<Point>, IntegratorsError> {
    let mut points = Vec::new();
    for half_decade in 6..=30 {
        let tolerance = Tolerance::relative(10.0_f64.powf(-0.5 * f64::from(half_decade)))?;
        let mut state = State::new(0.0, start.to_vec())?;
        let report = run(tolerance, &mut state)?;
        let error = state.values.iter().zip(reference).map(|(a, b)| (a - b).abs()).fold(1e-16, f64::max);
        let mut work = State::new(0.0, start.to_vec())?;
        let seconds = least(|| {
            work.values.copy_from_slice(&start);
            work.carry.fill(0.0);
            work.time = 0.0;
            let _ = black_box(run(tolerance, black_box(&mut work)));
        });
        points.push(Point { error, evaluations: report.evaluations as f64, steps: report.steps as f64, seconds });
    }
    Ok(points)
}

/// Evaluations, steps and seconds at an error, on the straight line between neighbours in logarithms.
fn at(points: &[Point], error: f64) -> Option<Point> {
    points.windows(2).find(|pair| error <= pair[0].error && pair[1].error <= error).map(|pair| {
        let part = (pair[0].error / error).ln() / (pair[0].error / pair[1].error).ln().max(f64::MIN_POSITIVE);
        let between = |a: f64, b: f64| a * (b / a).powf(part.clamp(0.0, 1.0));
        let [a, b] = [pair[0], pair[1]];
        Point {
            error,
            evaluations: between(a.evaluations, b.evaluations),
            steps: between(a.steps, b.steps),
            seconds: between(a.seconds, b.seconds),
        }
    })
}

/// Many evaluations over a scalar, each of which begins from the one before.
struct Evaluations<M, T> {
    motion: M,
    y: [T; 4],
    count: u32,
}

impl<M: Motion, T: Real> Kernel for Evaluations<M, T> {
    type Output = T;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> T {
        let [mut a, mut b, u, v] = self.y;
        // So small a part that it is lost in rounding, which the compiler does not know.
        let tiny = T::lit(1e-30);
        for _ in 0..self.count {
            let [f, g] = self.motion.acceleration([a, b], [u, v]);
            a += tiny * f;
            b += tiny * g;
        }
        a + b
    }
}

/// The time of one evaluation over `f64`, and of one over eight lanes.
fn evaluation<M: Motion>(motion: M, start: [f64; 4]) -> (f64, f64) {
    const COUNT: u32 = 10_000;
    let one = least(|| {
        black_box(Evaluations { motion, y: black_box(start), count: COUNT }.run());
    });
    let lanes = black_box(start).map(Lanes::<f64, 8>::splat);
    let eight = least(|| {
        black_box(dispatch(Evaluations { motion, y: black_box(lanes), count: COUNT }));
    });
    (one / f64::from(COUNT), eight / f64::from(COUNT))
}

/// Prints the rows of a problem, and returns those of the table of the tableau.
fn table<M: Motion>(name: &str, motion: M, start: [f64; 4], end: f64) -> Result<Vec<String>, IntegratorsError> {
    let equations = Equations(motion);
    let mut reference = State::new(0.0, start.to_vec())?;
    GaussRadau15::to_rounding().integrate_to(&mut equations.clone(), &mut reference, end)?;
    let reference = reference.values;
    let mut curves = vec![
        (
            "Gauss–Legendre 16",
            curve(&reference, start, |tolerance, state| {
                GaussLegendre16::new(tolerance).integrate_to(&mut equations.clone(), state, end)
            })?,
        ),
        (
            "Dormand–Prince 8(5,3)",
            curve(&reference, start, |tolerance, state| {
                DormandPrince853::new(tolerance).integrate_to(&mut equations.clone(), state, end)
            })?,
        ),
        (
            "Verner 9(8)",
            curve(&reference, start, |tolerance, state| {
                Verner98::new(tolerance).integrate_to(&mut equations.clone(), state, end)
            })?,
        ),
    ];
    if !M::VELOCITY_DEPENDENT {
        curves.push((
            "Nyström 8(6)",
            curve(&reference, start, |tolerance, state| {
                Nystrom86::new(tolerance).integrate_to(&mut equations.clone(), state, end)
            })?,
        ));
        curves.push((
            "Nyström 12(10)",
            curve(&reference, start, |tolerance, state| {
                Nystrom1210::new(tolerance).integrate_to(&mut equations.clone(), state, end)
            })?,
        ));
    }
    let (one, eight) = evaluation(motion, start);
    let [sweep, begin] = products(2, M::VELOCITY_DEPENDENT);
    let mut rows = Vec::new();
    for error in [1e-6, 1e-8, 1e-10, 1e-12] {
        for (method, curve) in &curves {
            let Some(Point { evaluations, steps, seconds, .. }) = at(curve, error) else { continue };
            // Eight stages are one evaluation in lanes.
            let alone = if method.contains("16") { evaluations / 8.0 * eight } else { evaluations * one };
            println!(
                "| {name} | {error:.0e} | {method} | {:.1} | {evaluations:.0} | {:.1} | {:.2} |",
                seconds * 1e6,
                alone * 1e6,
                alone / seconds
            );
            if method.contains("16") {
                let sweeps = evaluations / 8.0;
                let products = sweeps * sweep + steps * begin;
                rows.push(format!(
                    "| {name} | {error:.0e} | {:.1} | {steps:.0} | {sweeps:.0} | {:.1} | {:.1} | {:.1} | {:.2} |",
                    seconds * 1e6,
                    alone * 1e6,
                    products * 1e6,
                    (alone + products) * 1e6,
                    (alone + products) / seconds
                ));
            }
        }
    }
    Ok(rows)
}

/// One step of Taylor's method of order P for Hénon and Heiles' potential, no longer than `rest`; returns its length.
#[cfg_attr(not(debug_assertions), inline(always))]
fn taylor_step<const P: usize>(state: &mut [f64; 4], tolerance: f64, rest: f64) -> f64 {
    let (mut x, mut y) = ([0.0; 32], [0.0; 32]);
    [x[0], y[0], x[1], y[1]] = *state;
    for n in 0..P - 1 {
        // The coefficients of degree n of xy, x² and y².
        let product = (0..=n).fold(0.0, |sum, k| sum + x[k] * y[n - k]);
        let (mut xx, mut yy) = (0.0, 0.0);
        for k in 0..n.div_ceil(2) {
            xx += x[k] * x[n - k];
            yy += y[k] * y[n - k];
        }
        (xx, yy) = (xx + xx, yy + yy);
        if n % 2 == 0 {
            xx += x[n / 2] * x[n / 2];
            yy += y[n / 2] * y[n / 2];
        }
        let factor = 1.0 / ((n + 1) * (n + 2)) as f64;
        x[n + 2] = (-x[n] - 2.0 * product) * factor;
        y[n + 2] = (yy - y[n] - xx) * factor;
    }
    let size = |k: usize| x[k].abs().max(y[k].abs());
    let allowed = tolerance * size(0).max(size(1));
    let radius = |k: usize| (allowed / size(k)).powf(1.0 / k as f64);
    let h = radius(P).min(radius(P - 1)).min(rest);
    let [mut a, mut b, mut u, mut v] = [x[P], y[P], 0.0, 0.0];
    for k in (0..P).rev() {
        (u, v) = (u * h + a, v * h + b);
        (a, b) = (a * h + x[k], b * h + y[k]);
    }
    *state = [a, b, u, v];
    h
}

fn taylor<const P: usize>(start: [f64; 4], end: f64, tolerance: f64) -> ([f64; 4], u32) {
    let (mut state, mut t, mut steps) = (start, 0.0, 0);
    while 1e-13 < end - t {
        t += taylor_step::<P>(&mut state, tolerance, end - t);
        steps += 1;
    }
    (state, steps)
}

fn row<const P: usize>(start: [f64; 4], end: f64) {
    let (reference, _) = taylor::<30>(start, end, 1e-17);
    let points: Vec<Point> = (6..=30)
        .map(|half_decade| {
            let tolerance = 10.0_f64.powf(-0.5 * f64::from(half_decade));
            let (state, steps) = taylor::<P>(start, end, tolerance);
            let error = state.iter().zip(&reference).map(|(a, b)| (a - b).abs()).fold(1e-16, f64::max);
            let seconds = least(|| {
                black_box(taylor::<P>(black_box(start), end, tolerance));
            });
            Point { error, evaluations: f64::from(steps), steps: f64::from(steps), seconds }
        })
        .collect();
    let cells = [1e-6, 1e-8, 1e-10, 1e-12]
        .map(|error| at(&points, error).map_or("–".into(), |point| format!("{:.1}", point.seconds * 1e6)));
    println!("| {P} | {} |", cells.join(" | "));
}

fn main() -> Result<(), IntegratorsError> {
    println!("| problem | error | method | run, µs | evaluations | evaluations alone, µs | part of the run |");
    println!("|---|---|---|---|---|---|---|");
    let henon = [0.0, 0.1, 0.490_577_889_167_25, 0.0];
    let mut rows = table("Hénon–Heiles", HenonHeiles, henon, 100.0)?;
    rows.extend(table("Kepler, e = 0.9", Kepler, [1.9, 0.0, 0.0, (0.1_f64 / 1.9).sqrt()], 10.0 * TAU)?);
    rows.extend(table("Arenstorf", Arenstorf, [0.994, 0.0, 0.0, -2.001_585_106_379_082_5], 17.065_216_560_157_964)?);
    rows.extend(table("double pendulum", DoublePendulum, [0.25 * TAU, 0.25 * TAU, 0.0, 0.0], 10.0)?);
    println!(
        "\n| problem | error | run, µs | steps | sweeps | evaluations, µs | products, µs | both, µs | part of the run |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for row in rows {
        println!("{row}");
    }
    println!("\n| order of Taylor's method, Hénon–Heiles | 1e-6, µs | 1e-8, µs | 1e-10, µs | 1e-12, µs |");
    println!("|---|---|---|---|---|");
    row::<12>(henon, 100.0);
    row::<16>(henon, 100.0);
    row::<20>(henon, 100.0);
    row::<24>(henon, 100.0);
    row::<28>(henon, 100.0);
    Ok(())
}
