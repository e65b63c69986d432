//! What isochoric neo-Hookean stress costs at the least, step by step, beside the law: `<step>/1k`, in blocks of lanes.
//!
//! | step | what |
//! |---|---|
//! | `copy` | F read and written, in lanes |
//! | `cofactor` | J Cof F |
//! | `neo_hookean_isochoric` | P by the printed formula, without a test and without care near the reference |
//! | `law` | P of the law in a batch: accurate near the reference, every point tested |

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use piola_batch::{Gradients, LaneBlocks};
use piola_benches::constitutive::floor::{self, BLOCK, Cofactor, Copied, NeoHookean, Step};
use piola_benches::continuum::ordinary_deformations;
use piola_solids::batch;
use piola_solids::volumetric::Quadratic;
use piola_solids::{Compressible, isochoric};
use piola_testkit::relative_error;

type Blocks = Vec<[[f64; BLOCK]; 9]>;

const POINTS: usize = 1000;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("floor");
    group.sample_size(30).nresamples(1000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(300));
    group.throughput(Throughput::Elements(POINTS as u64));
    let f = ordinary_deformations(POINTS);
    let component = |b: usize, k: usize| core::array::from_fn(|lane| f[BLOCK * b + lane].matrix()[(k / 3, k % 3)]);
    let gradients: Blocks = (0..POINTS / BLOCK).map(|b| core::array::from_fn(|k| component(b, k))).collect();
    let (mut least, mut ours) = (gradients.clone(), gradients.clone());
    let (mu, kappa) = (0.8, 20.0);
    step(&mut group, &Copied, &gradients, &mut least);
    step(&mut group, &Cofactor, &gradients, &mut least);
    step(&mut group, &NeoHookean { mu, kappa }, &gradients, &mut least);
    let law = Compressible::new(isochoric::NeoHookean::new(mu)?, Quadratic::new(kappa)?);
    let input = Gradients(LaneBlocks::new(&gradients, POINTS)?);
    group.bench_function("law/1k", |b| {
        b.iter(|| {
            let to = LaneBlocks::new_mut(&mut ours, POINTS)?;
            batch::evaluate(black_box(input), batch::first_piola(&law, to)).map(|report| report.points)
        });
    });
    floor::run(&NeoHookean { mu, kappa }, &gradients, &mut least);
    batch::evaluate(input, batch::first_piola(&law, LaneBlocks::new_mut(&mut ours, POINTS)?))?;
    let difference = relative_error(ours.as_flattened().as_flattened(), least.as_flattened().as_flattened());
    assert!(difference < AGREEMENT, "P differs by {difference:e}");
    group.finish();
    criterion.final_summary();
    Ok(())
}

/// How far answers of the same formula at ordinary deformations may be from each other.
const AGREEMENT: f64 = 1e-12;

fn step<S: Step>(group: &mut BenchmarkGroup<'_, WallTime>, step: &S, from: &Blocks, to: &mut Blocks) {
    group.bench_function(format!("{}/1k", S::NAME), |b| b.iter(|| floor::run(step, black_box(from), black_box(to))));
}
