//! Nanoseconds a point of laws of one's own beside the built-in ones: `<law>/<way>/<quantity>/<batch>`.
//!
//! | part | what |
//! |---|---|
//! | `invariants`, `stretches`, `general` | the law by its energy of invariants, of principal stretches, of Green's strain |
//! | `built_in` | the law of `piola-solids`, right after it |
//! | `per_point` | the energy of invariants with the parameters of each point in blocks of lanes |
//! | `first_piola`, `first_piola_and_tangent` | P; P and ∂P/∂F |
//! | `1`, `1k` | one call; a thousand points in blocks of lanes, in cache |

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use piola_batch::{Gradients, LaneBlocks};
use piola_benches::continuum::ordinary_deformations;
use piola_laws::Excesses;
use piola_laws::per_point::{self, Bound, EnergyOfParameters};
use piola_numerics::Real;
use piola_solids::{Hyperelastic, batch};

#[path = "../../crates/laws/tests/it/zoo.rs"]
mod zoo;

/// Points of a block.
const BLOCK: usize = 8;
/// Points of a batch.
const COUNT: usize = 1000;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("own_law");
    group.sample_size(20).nresamples(2000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(200));
    zoo::each(&mut Measured(&mut group))?;
    per_point(&mut group, "neo_hookean", GradedNeoHookean, [2.0, 3.0])?;
    per_point(&mut group, "mooney_rivlin", GradedMooneyRivlin, [0.5, 0.25, 1.0])?;
    group.finish();
    criterion.final_summary();
    Ok(())
}

struct Measured<'a, 'b>(&'a mut BenchmarkGroup<'b, WallTime>);

impl zoo::Visit for Measured<'_, '_> {
    fn pair<O: Hyperelastic + Sync, B: Hyperelastic + Sync>(
        &mut self,
        name: &'static str,
        way: &'static str,
        own: &O,
        built_in: &B,
    ) -> Result<(), Box<dyn Error>> {
        self.law(&format!("{name}/{way}"), own)?;
        if way == "general" && name == "neo_hookean" {
            return Ok(()); // its built-in law stands beside the energy of invariants
        }
        self.law(&format!("{name}/built_in"), built_in)
    }
}

impl Measured<'_, '_> {
    fn law<L: Hyperelastic + Sync>(&mut self, name: &str, law: &L) -> Result<(), Box<dyn Error>> {
        let group = &mut *self.0;
        let f = ordinary_deformations(8)[7];
        group.throughput(Throughput::Elements(1));
        group.bench_function(format!("{name}/first_piola/1"), |b| b.iter(|| black_box(law).first_piola(black_box(&f))));
        group.bench_function(format!("{name}/first_piola_and_tangent/1"), |b| {
            b.iter(|| black_box(law).first_piola_and_tangent(black_box(&f)));
        });
        let gradients = gradients();
        let mut stresses = vec![[[0.0; BLOCK]; 9]; COUNT / BLOCK];
        let mut tangents = vec![[[0.0; BLOCK]; 45]; COUNT / BLOCK];
        let input = Gradients(LaneBlocks::new(&gradients, COUNT)?);
        group.throughput(Throughput::Elements(COUNT as u64));
        group.bench_function(format!("{name}/first_piola/1k"), |b| {
            b.iter(|| {
                let to = LaneBlocks::new_mut(&mut stresses, COUNT)?;
                batch::evaluate(black_box(input), batch::first_piola(law, to)).map(|report| report.points)
            });
        });
        group.bench_function(format!("{name}/first_piola_and_tangent/1k"), |b| {
            b.iter(|| {
                let (p, a) = (LaneBlocks::new_mut(&mut stresses, COUNT)?, LaneBlocks::new_mut(&mut tangents, COUNT)?);
                batch::evaluate(black_box(input), batch::first_piola_and_tangent(law, p, a)).map(|report| report.points)
            });
        });
        Ok(())
    }
}

/// F of a thousand points in blocks of lanes.
fn gradients() -> Vec<[[f64; BLOCK]; 9]> {
    let mut gradients = vec![[[0.0; BLOCK]; 9]; COUNT / BLOCK];
    for (point, f) in ordinary_deformations(COUNT).iter().enumerate() {
        for (k, component) in gradients[point / BLOCK].iter_mut().enumerate() {
            component[point % BLOCK] = f.matrix()[(k / 3, k % 3)];
        }
    }
    gradients
}

/// W = ½ μ (I₁ − 3 − 2 ln J) + ½ λ (ln J)², μ and λ of each point.
#[derive(Clone, Copy)]
struct GradedNeoHookean;

impl EnergyOfParameters<2> for GradedNeoHookean {
    const PARAMETERS: [(&'static str, Bound); 2] =
        [("shear_modulus", Bound::Positive), ("first_lame_parameter", Bound::Finite)];
    const SECOND: bool = false;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, &[mu, lambda]: &[T; 2], at: &impl Excesses<T>) -> T {
        let volume = at.ln_jacobian();
        T::lit(0.5) * (mu * at.first_excess() + lambda * volume * volume)
    }
}

/// W = C₁₀ (I₁ − 3 − 2 ln J) + C₀₁ (I₂ − 3 − 4 ln J) + c (J² − 1 − 2 ln J), all three of each point.
#[derive(Clone, Copy)]
struct GradedMooneyRivlin;

impl EnergyOfParameters<3> for GradedMooneyRivlin {
    const PARAMETERS: [(&'static str, Bound); 3] =
        [("c10", Bound::Positive), ("c01", Bound::NotNegative), ("square_coefficient", Bound::Positive)];

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, &[c10, c01, c]: &[T; 3], at: &impl Excesses<T>) -> T {
        let change = at.volume_change();
        c10 * at.first_excess() + c01 * at.second_excess() + c * (change * change + T::lit(2.0) * at.volume_excess())
    }
}

fn per_point<E: EnergyOfParameters<N>, const N: usize>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    energy: E,
    mean: [f64; N],
) -> Result<(), Box<dyn Error>> {
    let gradients = gradients();
    let graded = |point: usize| mean.map(|mean| [0; BLOCK].map(|_: usize| mean * (1.0 + 1e-3 * point as f64)));
    let parameters: Vec<[[f64; BLOCK]; N]> = (0..COUNT / BLOCK).map(graded).collect();
    let mut stresses = vec![[[0.0; BLOCK]; 9]; COUNT / BLOCK];
    let mut tangents = vec![[[0.0; BLOCK]; 45]; COUNT / BLOCK];
    let input = Gradients(LaneBlocks::new(&gradients, COUNT)?);
    let parameters = LaneBlocks::new(&parameters, COUNT)?;
    group.throughput(Throughput::Elements(COUNT as u64));
    group.bench_function(format!("{name}/per_point/first_piola/1k"), |b| {
        b.iter(|| {
            let to = LaneBlocks::new_mut(&mut stresses, COUNT)?;
            let request = per_point::first_piola(energy, black_box(parameters), to);
            batch::evaluate(black_box(input), request).map(|report| report.points)
        });
    });
    group.bench_function(format!("{name}/per_point/first_piola_and_tangent/1k"), |b| {
        b.iter(|| {
            let (p, a) = (LaneBlocks::new_mut(&mut stresses, COUNT)?, LaneBlocks::new_mut(&mut tangents, COUNT)?);
            let request = per_point::first_piola_and_tangent(energy, black_box(parameters), p, a);
            batch::evaluate(black_box(input), request).map(|report| report.points)
        });
    });
    Ok(())
}
