//! Nanoseconds a point of a law at many points, as C, Fortran and Python call it: the figures beside those of
//! `crates/python/tests/throughput.py`, on one thread.
//!
//! ```sh
//! cargo build --release -p piola-ffi --features history,rayon --example throughput
//! taskset -c 1 target/release/examples/throughput
//! ```

#![expect(clippy::print_stdout, reason = "a table for the page of measurements")]

use std::hint::black_box;
use std::time::Instant;

use piola::solids::{AnySolid, MooneyRivlin};
use piola_ffi::FfiError;
use piola_ffi::points::{StressMeasure, TangentMeasure, VoigtNumbering, stress, stress_and_tangent};

/// The shortest of some passes, ns a point.
fn shortest(count: usize, mut call: impl FnMut() -> Result<(), FfiError>) -> Result<f64, FfiError> {
    let calls = if count < 10 { 100 } else { 1 };
    let mut least = f64::INFINITY;
    for _ in 0..50 {
        let begin = Instant::now();
        for _ in 0..calls {
            call()?;
        }
        least = least.min(begin.elapsed().as_secs_f64() * 1e9 / (calls * count) as f64);
    }
    Ok(least)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let law = AnySolid::from(MooneyRivlin::stress_free(0.5, 0.25, 1.0)?);
    println!("| points | quantity | ns a point |\n|---|---|---|");
    for count in [1, 1000, 100_000] {
        let entry = |k: usize| 0.2 * (k as f64 * 1.618).sin();
        let f: Vec<[f64; 9]> = (0..count)
            .map(|i| core::array::from_fn(|k| entry(9 * i + k) + if k % 4 == 0 { 1.0 } else { 0.0 }))
            .collect();
        let (mut stresses, mut square, mut six) = (vec![[0.0; 9]; count], vec![0.0; 81 * count], vec![0.0; 36 * count]);
        let row = |what: &str, time: f64| println!("| {count} | {what} | {time:.1} |");
        let mut alone = |measure| shortest(count, || stress(&law, measure, black_box(&f), &mut stresses));
        row("P", alone(StressMeasure::FirstPiola)?);
        row("T", alone(StressMeasure::Cauchy)?);
        for (what, measures, tangents) in [
            ("P and ∂P/∂F", (StressMeasure::FirstPiola, TangentMeasure::FirstPiola), &mut square),
            ("T and DDSDDE", (StressMeasure::Cauchy, TangentMeasure::Jaumann), &mut six),
        ] {
            let order = VoigtNumbering::Abaqus;
            let time = shortest(count, || {
                stress_and_tangent(&law, measures, order, black_box(&f), (&mut stresses, &mut tangents[..]))
            })?;
            row(what, time);
        }
    }
    Ok(())
}
