//! Hamilton–Jacobi theory: Hamilton's field with its variations, one geodetic distance, and a front per step.
//!
//! `front <n> rays` is one step of order six of all rays of a front through a graded medium, with their Jacobians, on
//! one thread and on two; under `cargo xtask bench`, which keeps to one core, the second cannot gain.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput};
use piola_hamiltonian::PhaseFunction;
use piola_hamiltonian::hamilton_jacobi::{Event, GeodeticDistance, InitialFront, RayField, WaveFront};
use piola_integrators::Field;
use piola_numerics::Real;

/// A particle in the plane, V = r²/2 + r⁴/4.
#[derive(Debug)]
struct Bowl;

impl PhaseFunction for Bowl {
    #[inline(always)]
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let square = q[0] * q[0] + q[1] * q[1];
        T::lit(0.5) * (p[0] * p[0] + p[1] * p[1] + square) + T::lit(0.25) * square * square
    }
}

/// Waves of the speed 1 + 0.3 x + 0.2 y².
#[derive(Debug)]
struct Graded;

impl PhaseFunction for Graded {
    #[inline(always)]
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let speed = T::one() + T::lit(0.3) * q[0] + T::lit(0.2) * q[1] * q[1];
        (p[0] * p[0] + p[1] * p[1]).sqrt() * speed
    }
}

#[derive(Debug)]
struct Parabola;

impl InitialFront<2, 1> for Parabola {
    fn at<T: Real>(&self, [a]: [T; 1]) -> [T; 2] {
        [a, T::lit(0.2) * a * a]
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("hamilton_jacobi");
    group.sample_size(20).nresamples(2000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(300));
    let state = [0.3, -0.2, 0.5, 0.1, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0];
    for variations in [0, 2] {
        let mut field = RayField::new(&Bowl, 2, variations);
        let length = 5 + 4 * variations;
        let mut rate = vec![0.0; length];
        group.bench_function(format!("field with {variations} variations"), |bencher| {
            bencher.iter(|| {
                field.rate(0.0, black_box(&state[..length]), &mut rate).expect("a field without singularities");
                black_box(&mut rate);
            });
        });
    }
    let (from, to) = (Event::new(&[0.3, -0.2], 0.0), Event::new(&[0.6, 0.5], 0.8));
    group.bench_function("geodetic distance", |bencher| {
        bencher.iter(|| {
            GeodeticDistance::new(&Bowl).between(black_box(&from), &to, &[0.0, 0.0]).map(|found| found.distance)
        });
    });
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let two = rayon::ThreadPoolBuilder::new().num_threads(2).build()?;
    for rays in [1_000, 10_000, 100_000] {
        let mut front = WaveFront::open(&Graded, &Parabola, 1.0, 1.0, (-1.0, 1.0), rays)?;
        group.throughput(Throughput::Elements(rays as u64));
        for (pool, threads) in [(&one, "1 thread"), (&two, "2 threads")] {
            // To and fro, so that the front stays where it is.
            let mut action = 1e-3;
            group.bench_function(format!("front {rays} rays {threads}"), |bencher| {
                bencher.iter(|| {
                    action = -action;
                    pool.install(|| front.advance(action, 1)).expect("a medium without singularities")
                });
            });
        }
    }
    group.finish();
    criterion.final_summary();
    Ok(())
}
