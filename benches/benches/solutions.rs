//! Exact solutions: `stress/<family>`, points a second; `load/<experiment>`, one load with its slope; `search/<experiment>`, limit
//! points and all states of a range; `period/<body>`.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use nalgebra::Matrix3;
use piola_solids::isochoric::MooneyRivlin;
use piola_solutions::LoadCurve;
use piola_solutions::dynamics::{RadialOscillation, RadialState};
use piola_solutions::families::{
    AzimuthalShearing, BlockBending, Datum, Family, IsochoricDeformation, Orientation, SectorStraightening,
    SphereDeformation, TubeDeformation,
};
use piola_solutions::loads::{Bending, Block, Ends, Shell, SphereInflation, Torsion, Tube, TubeInflation};

type Group<'a> = BenchmarkGroup<'a, WallTime>;

/// Particles of a bench of stresses.
const PARTICLES: usize = 64;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("solutions");
    group.sample_size(10).nresamples(1000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(200));
    let law = MooneyRivlin::new(0.5, 0.25)?;

    let shear = Matrix3::new(1.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    stresses(&mut group, "0", &IsochoricDeformation::new(shear, [0.0; 3])?, &law)?;
    stresses(&mut group, "1", &BlockBending::isochoric([0.5, 0.25, 0.5, 1.25])?, &law)?;
    stresses(&mut group, "2", &SectorStraightening::isochoric([2.0, 0.5, -1.0, 0.75])?, &law)?;
    stresses(&mut group, "3", &TubeDeformation::isochoric([0.25, 1.0, 0.5, 0.0, 2.0])?, &law)?;
    stresses(&mut group, "4", &SphereDeformation::new(Orientation::Kept, 1.5)?, &law)?;
    stresses(&mut group, "5", &AzimuthalShearing::isochoric([2.0, 0.5, 0.5])?, &law)?;

    let (shell, tube) = (Shell::new(1.0, 1.2)?, Tube::new(1.0, 1.2)?);
    let balloon = SphereInflation { shell, law: &law, orientation: Orientation::Kept };
    load(&mut group, "sphere", &balloon, 1.5);
    load(&mut group, "tube_closed", &TubeInflation { tube, law: &law, ends: Ends::Closed }, 1.5);
    load(&mut group, "torsion_free", &Torsion { tube: Tube::solid(1.0)?, law: &law, ends: Ends::Force(0.0) }, 0.5);
    load(&mut group, "bending", &Bending { block: Block::new(1.0, 2.0, 1.0)?, law: &law, axial_stretch: 1.0 }, 1.0);

    group.throughput(Throughput::Elements(1));
    group.bench_function("search/limit_points_of_a_sphere", |bencher| {
        bencher.iter(|| balloon.limit_points(black_box((1.0, 10.0))));
    });
    let free = RadialOscillation { body: balloon, density: 1.0, pressure: 0.0 };
    let start = RadialState { stretch: 1.2, rate: 0.0 };
    group.bench_function("period/sphere", |bencher| bencher.iter(|| free.orbit(black_box(start), (0.1, 10.0))));
    group.finish();
    criterion.final_summary();
    Ok(())
}

/// Stresses at places along the radius.
fn stresses(group: &mut Group<'_>, name: &str, family: &impl Family, law: &MooneyRivlin) -> Result<(), Box<dyn Error>> {
    let datum = Datum::free_at([2.0, 0.0, 1.0]);
    let particles: Vec<[f64; 3]> = (0..PARTICLES).map(|i| [1.0 + i as f64 / PARTICLES as f64, 0.1, 1.0]).collect();
    for &particle in &particles {
        family.stress(law, &datum, particle)?;
    }
    group.throughput(Throughput::Elements(PARTICLES as u64));
    group.bench_function(format!("stress/family_{name}"), |bencher| {
        bencher.iter(|| {
            for &particle in &particles {
                let _ = black_box(family.stress(law, &datum, black_box(particle)));
            }
        });
    });
    Ok(())
}

fn load(group: &mut Group<'_>, name: &str, curve: &impl LoadCurve, parameter: f64) {
    group.throughput(Throughput::Elements(1));
    group.bench_function(format!("load/{name}"), |bencher| bencher.iter(|| curve.point(black_box(parameter))));
}
