//! Nanoseconds of one ordered pair of attracting bodies, and of one step of the outer solar system.
//!
//! `accelerations <n>` is what users call: pair by pair for few bodies, in lanes beyond, on the threads of
//! rayon's pool for many. `accelerations <n> scalar` is the same formula over any scalar, each pair once.
//! From the size on at which threads are used, `1 thread` and `2 threads` run in pools of that size; under
//! `cargo xtask bench`, which keeps to one core, threads cannot gain.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use piola_benches::problems;
use piola_gravitation::{Gravitation, PARALLEL_BODIES};
use piola_integrators::{Composition, Order, State};

const SIZES: [usize; 11] = [2, 3, 6, 11, 16, 32, 128, 512, 1024, 2048, 4096];
/// The scalar path is measured up to this size.
const LARGEST_SCALAR: usize = 2048;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("nbody");
    group.sample_size(20).nresamples(2000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(300));
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let two = rayon::ThreadPoolBuilder::new().num_threads(2).build()?;
    for bodies in SIZES {
        let mut gravitation = Gravitation::new((0..bodies).map(|i| 1.0 + i as f64 / bodies as f64).collect())?;
        let positions: Vec<f64> = (0..3 * bodies).map(|i| scattered(i, bodies)).collect();
        let mut out = vec![0.0; 3 * bodies];
        group.throughput(Throughput::Elements((bodies * (bodies - 1)) as u64));
        let name = format!("accelerations {bodies}");
        group.bench_function(&name, |bencher| {
            bencher.iter(|| {
                gravitation.accelerations_into(black_box(&positions), &mut out).expect("bodies in different places");
                black_box(&mut out);
            });
        });
        if bodies <= LARGEST_SCALAR {
            group.bench_function(format!("{name} scalar"), |bencher| {
                bencher.iter(|| {
                    gravitation
                        .accelerations_over(black_box(&positions), &mut out)
                        .expect("bodies in different places");
                    black_box(&mut out);
                });
            });
        }
        if PARALLEL_BODIES <= bodies {
            for (pool, threads) in [(&one, "1 thread"), (&two, "2 threads")] {
                group.bench_function(format!("{name} {threads}"), |bencher| {
                    bencher.iter(|| {
                        pool.install(|| gravitation.accelerations_into(black_box(&positions), &mut out))
                            .expect("bodies in different places");
                        black_box(&mut out);
                    });
                });
            }
        }
    }
    steps(&mut group)?;
    group.finish();
    criterion.final_summary();
    Ok(())
}

/// Bodies spread over a cube, two of them never in one place.
fn scattered(i: usize, bodies: usize) -> f64 {
    let (body, component) = (i % bodies, i / bodies);
    let stride = [0.618_033_988_749_895, 0.754_877_666_246_693, 0.569_840_290_998_053][component];
    (0.5 + body as f64 * stride).fract()
}

/// One step of the Sun and its outer planets, by Piola's own field.
fn steps(group: &mut BenchmarkGroup<'_, WallTime>) -> Result<(), Box<dyn Error>> {
    const STEPS: u32 = 1000;
    let problem = problems::outer_solar_system()?;
    let mut gravitation = Gravitation::new(problem.equations.parameters.to_vec())?;
    group.throughput(Throughput::Elements(u64::from(STEPS)));
    for order in Order::ALL {
        let mut method = Composition::new(order, 100.0)?;
        let mut state = State::new(0.0, problem.start.to_vec())?;
        group.bench_function(format!("step of the outer solar system, composition {}", order.value()), |bencher| {
            bencher.iter(|| {
                // There and back again: the state stays near its start however often this runs.
                let end = if 0.0 < state.time { 0.0 } else { 100.0 * f64::from(STEPS) };
                black_box(method.integrate_to(&mut gravitation, &mut state, end))
            });
        });
    }
    Ok(())
}
