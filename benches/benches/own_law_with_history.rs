//! Nanoseconds a point of a step of a law with history: `reese_govindjee/<way>/advance/1k`.
//!
//! The states of a thousand points are structures of arrays. `alone` advances point by point, `lanes` several points at once. One
//! implicit step with P and its consistent tangent is timed.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput};
use piola_benches::continuum::ordinary_deformations;
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{DeformationGradient, FirstPiola};
use piola_inelastic::{Evolution, ReeseGovindjee, StepControl, advance_components, advance_in_lanes};
use piola_solids::NeoHookeanCiarlet;
use piola_tensor::FourthOrder;

/// Points of a batch.
const COUNT: usize = 1000;

/// All points start as they were made.
fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("own_law_with_history");
    group.sample_size(20).nresamples(2000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(200));
    let (rest, spring) = (NeoHookeanCiarlet::with_constants(1.0, 5.0)?, NeoHookeanCiarlet::with_constants(2.0, 8.0)?);
    let law = ReeseGovindjee::new(rest, spring, 0.75)?;
    let (from, to) = (vec![DeformationGradient::identity(); COUNT], ordinary_deformations(COUNT));
    let mut stresses = vec![FirstPiola::zero(); COUNT];
    let mut tangents = vec![FirstPiolaTangent(FourthOrder::zero()); COUNT];
    let control = StepControl::one_step();
    let mut arrays: Vec<Vec<f64>> = law.initial().iter().map(|_| vec![0.0; COUNT]).collect();
    group.throughput(Throughput::Elements(COUNT as u64));
    for way in ["alone", "lanes"] {
        group.bench_function(format!("reese_govindjee/{way}/advance/1k"), |b| {
            b.iter(|| {
                for (array, value) in arrays.iter_mut().zip(law.initial()) {
                    array.fill(value);
                }
                let mut columns = arrays.iter_mut().map(Vec::as_mut_slice);
                let mut columns: [&mut [f64]; 9] = core::array::from_fn(|_| columns.next().unwrap_or_default());
                let path = black_box([&from[..], &to[..]]);
                if way == "lanes" {
                    advance_in_lanes(&law, &mut columns, path, 0.1, &mut stresses, &mut tangents)
                } else {
                    let step = (0.1, &control);
                    advance_components(|_| Ok(law), &mut columns, path, step, &mut stresses, &mut tangents)
                }
            });
        });
    }
    group.finish();
    criterion.final_summary();
    Ok(())
}
