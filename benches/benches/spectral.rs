//! Fields on a box: `static/<precision>/<grid>/<points>`, points a second, with the number of threads in the group's name;
//! `flow/step`, `motion/step`.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use piola_spectral::{
    BoxGrid, BoxOperator, BoxSolver, LameParameters, ModalMotion, ModalSeries, Precision, SpectralError, ViscousFlow,
    Walls,
};

type Group<'a> = BenchmarkGroup<'a, WallTime>;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let lame = LameParameters::new(1.5, 0.75)?;
    let operator = BoxOperator::elastic(lame);
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        let mut group = criterion.benchmark_group(format!("spectral/threads_{threads}"));
        group.sample_size(10).nresamples(1000);
        group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_secs(1));
        for points in [32, 64, 96, 128, 256] {
            let spacing = 1.0 / points as f64;
            let cells = BoxGrid::cells([points; 3], [spacing; 3])?;
            statics::<f64>(&mut group, &pool, "f64/cells", cells, operator)?;
            statics::<f32>(&mut group, &pool, "f32/cells", cells, operator)?;
            statics::<f64>(&mut group, &pool, "f64/nodes", BoxGrid::nodes([points + 1; 3], [spacing; 3])?, operator)?;
        }
        // A length with a large prime factor goes to the library.
        statics::<f64>(&mut group, &pool, "f64/cells", BoxGrid::cells([127; 3], [1.0; 3])?, operator)?;
        group.finish();
    }

    let mut group = criterion.benchmark_group("spectral");
    group.sample_size(10).nresamples(1000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(500));
    let grid = BoxGrid::cells([64; 3], [1.0 / 64.0; 3])?;
    let solver = BoxSolver::<f64, 3>::new(grid, Walls::Sliding, operator)?;
    let mut flow = ViscousFlow::new(solver, 0.5)?;
    let still = vec![0.0; grid.len()];
    group.throughput(Throughput::Elements(grid.len() as u64));
    group.bench_function("flow/step", |bencher| {
        bencher.iter(|| flow.step([&still, &still, &still], black_box(1e-3)).map(|report| report.least_jacobian));
    });
    let rest = ModalSeries::<3>::zeros([1.0; 3], Walls::Sliding, [31; 3])?;
    let mut motion = ModalMotion::new(operator, 1.0, 0.1, rest.clone(), rest)?;
    group.throughput(Throughput::Elements(32 * 32 * 32));
    group.bench_function("motion/step", |bencher| bencher.iter(|| motion.step(black_box(1e-3), &[])));
    group.finish();
    criterion.final_summary();
    Ok(())
}

/// A static solution; its own result is the next force, and the values shrink without reaching zero.
fn statics<T: Precision>(
    group: &mut Group<'_>,
    pool: &rayon::ThreadPool,
    name: &str,
    grid: BoxGrid<3>,
    operator: BoxOperator,
) -> Result<(), SpectralError> {
    let mut solver = BoxSolver::<T, 3>::new(grid, Walls::Sliding, operator)?;
    let value = |component: usize, point: usize| T::lit((0.001 * (7 * point + component) as f64).sin());
    let start: [Vec<T>; 3] = std::array::from_fn(|c| (0..grid.len()).map(|point| value(c, point)).collect());
    let mut fields = start.clone();
    group.throughput(Throughput::Elements(grid.len() as u64));
    group.bench_function(format!("static/{name}/{}", grid.points()[0]), |bencher| {
        bencher.iter_custom(|count| {
            let mut spent = Duration::ZERO;
            for _ in 0..count {
                for (field, start) in fields.iter_mut().zip(&start) {
                    field.copy_from_slice(start);
                }
                let [x, y, z] = &mut fields;
                let begun = std::time::Instant::now();
                let _ = black_box(pool.install(|| solver.solve_in_place([x, y, z])));
                spent += begun.elapsed();
            }
            spent
        });
    });
    Ok(())
}
