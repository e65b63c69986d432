//! Uniform bodies: `<what>/<case>`.
//!
//! | part | what |
//! |---|---|
//! | `connection`, `torsion`, `curvature` `/<symmetry>` | one point: of a crystal, about an axis, of an isotropic solid |
//! | `connection_lanes`, `torsion_lanes`, `curvature_lanes` `/<symmetry>` | the same of eight points in lanes |
//! | `metric/geometry` | one point: metric, Christoffel symbols, Riemann, Ricci and scalar curvature |
//! | `density/point` | the density of dislocations at a point |
//! | `noll/divergence` | Div P of a neo-Hookean body by Noll's equations at a point |
//! | `transport/<tolerance>` | a frame around a circle; `error` is |holonomy − 1|, exactly zero for a crystal |
//! | `burgers/<tolerance>` | the Burgers vector of the same circle; `error` beside 1e-15 |
//! | `sampled_<spline>/<nodes>` | torsion at a point of samples on n³ nodes; `error` beside the formula |

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use nalgebra::{Matrix3, Vector3};
use piola_benches::notes::Notes;
use piola_fields::{Interpolation, Motion};
use piola_integrators::Tolerance;
use piola_numerics::{Kernel, Lanes, Real, dispatch};
use piola_solids::NeoHookeanLogarithmic;
use piola_uniformity::{
    AffineConnection, BurgersVector, CharacteristicMetric, DislocationDensity, LieAlgebra, MaterialConnection,
    MateriallyUniformBody, MetricGeometry, NollEquations, ReferenceCurve, RoundCircuit, SampledUniformityMap,
    TransportedFrame, UniformityMap,
};

type Group<'a> = BenchmarkGroup<'a, WallTime>;

/// A smooth lattice that is no gradient.
#[derive(Clone, Copy)]
struct Lattice;

impl UniformityMap for Lattice {
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
        let [x, y, z] = (*reference).into();
        let (l, n) = (T::one(), T::lit);
        Matrix3::new(
            n(0.125) * y.sin() + l,
            n(0.25) * x * z,
            n(0.125) * y,
            n(0.0625) * z * z,
            n(0.25) * x * y + l,
            n(-0.125) * x.cos(),
            n(0.125) * x,
            n(0.0625) * z.sin(),
            n(0.125) * z + l,
        )
    }
}

struct Bending;

impl Motion for Bending {
    fn place<T: Real>(&self, reference: &Vector3<T>, _t: T) -> Vector3<T> {
        let [x, y, z] = (*reference).into();
        Vector3::new(x + T::lit(0.1) * y * y, y + T::lit(0.1) * z * x, z)
    }
}

/// Lanes of the benches in lanes.
const LANES: usize = 8;

/// Eight points at which a connection is asked.
struct Points<'a> {
    connection: &'a MaterialConnection<Lattice>,
    places: Vector3<Lanes<f64, LANES>>,
}

macro_rules! in_lanes {
    ($($name:ident $method:ident $output:ident;)+) => { $(
        struct $name<'a>(Points<'a>);

        impl Kernel for $name<'_> {
            type Output = Option<piola_uniformity::$output<Lanes<f64, LANES>>>;

            #[inline(always)]
            fn run(self) -> Self::Output {
                self.0.connection.$method(&self.0.places).ok()
            }
        }
    )+ };
}

in_lanes! {
    Coefficients coefficients ConnectionCoefficients;
    Torsions torsion Torsion;
    Curvatures curvature ConnectionCurvature;
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("uniformity");
    group.sample_size(20).nresamples(1000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(300));
    group.throughput(Throughput::Elements(1));
    let mut notes = Notes::of("uniformity");
    points(&mut group)?;
    circuits(&mut group, &mut notes)?;
    samples(&mut group, &mut notes)?;
    group.finish();
    criterion.final_summary();
    notes.write()?;
    Ok(())
}

fn points(group: &mut Group<'_>) -> Result<(), Box<dyn Error>> {
    let place = Vector3::new(0.5, -0.25, 0.75);
    let algebras = [
        ("crystal", LieAlgebra::trivial()),
        ("about_axis", LieAlgebra::rotations_about(Vector3::z())?),
        ("isotropic", LieAlgebra::rotations()),
    ];
    for (name, algebra) in algebras {
        let connection = MaterialConnection::new(Lattice, algebra);
        group.bench_function(format!("connection/{name}"), |b| b.iter(|| connection.coefficients(black_box(&place))));
        group.bench_function(format!("torsion/{name}"), |b| b.iter(|| connection.torsion(black_box(&place))));
        group.bench_function(format!("curvature/{name}"), |b| b.iter(|| connection.curvature(black_box(&place))));
    }
    // Eight points around the one.
    let offsets = Lanes::<f64, LANES>::from(core::array::from_fn(|lane| 1e-3 * lane as f64));
    let places = place.map(|x| Lanes::splat(x) + offsets);
    group.throughput(Throughput::Elements(LANES as u64));
    for (name, algebra) in [("crystal", LieAlgebra::trivial()), ("isotropic", LieAlgebra::rotations())] {
        let connection = MaterialConnection::new(Lattice, algebra);
        let case = |what| format!("{what}_lanes/{name}");
        let at = || Points { connection: &connection, places: black_box(places) };
        group.bench_function(case("connection"), |b| b.iter(|| dispatch(Coefficients(at()))));
        group.bench_function(case("torsion"), |b| b.iter(|| dispatch(Torsions(at()))));
        group.bench_function(case("curvature"), |b| b.iter(|| dispatch(Curvatures(at()))));
    }
    group.throughput(Throughput::Elements(1));
    let metric = CharacteristicMetric(Lattice);
    group.bench_function("metric/geometry", |b| b.iter(|| MetricGeometry::of(&metric, black_box(&place))));
    group.bench_function("density/point", |b| b.iter(|| DislocationDensity::of(&Lattice, black_box(&place))));
    let body = MateriallyUniformBody { law: NeoHookeanLogarithmic::with_constants(1.0, 2.0)?, map: Lattice };
    let connection = MaterialConnection::of_crystal(Lattice);
    let equations = NollEquations { body: &body, connection: &connection };
    group.bench_function("noll/divergence", |b| b.iter(|| equations.divergence(&Bending, black_box(&place), 0.0)));
    Ok(())
}

fn circuits(group: &mut Group<'_>, notes: &mut Notes) -> Result<(), Box<dyn Error>> {
    let circle = RoundCircuit::new(Vector3::zeros(), Vector3::new(1.0, -2.0, 2.0), 0.6)?;
    let connection = MaterialConnection::of_crystal(Lattice);
    let start = Lattice.value(&circle.place(0, 0.0))?;
    let exact = BurgersVector::of(&Lattice, &circle, 1e-15)?.value;
    for exponent in [4, 6, 8, 10, 12] {
        let tolerance = 10.0_f64.powi(-exponent);
        let relative = Tolerance::relative(tolerance)?;
        let name = format!("transport/1e-{exponent}");
        let round = TransportedFrame::around(&connection, &circle, &start, relative)?;
        notes.error(&name, (round.holonomy() - Matrix3::identity()).norm());
        notes.number(&name, "evaluations", round.evaluations as f64);
        group.bench_function(&name, |b| {
            b.iter(|| TransportedFrame::around(&connection, black_box(&circle), &start, relative));
        });
        let name = format!("burgers/1e-{exponent}");
        let burgers = BurgersVector::of(&Lattice, &circle, tolerance)?.value;
        notes.error(&name, (burgers - exact).norm());
        group.bench_function(&name, |b| b.iter(|| BurgersVector::of(&Lattice, black_box(&circle), tolerance)));
    }
    Ok(())
}

fn samples(group: &mut Group<'_>, notes: &mut Notes) -> Result<(), Box<dyn Error>> {
    let place = Vector3::new(0.06, -0.11, 0.17);
    let exact = MaterialConnection::of_crystal(Lattice).torsion(&place)?;
    for (spline, interpolation) in [("cubic", Interpolation::Cubic), ("quintic", Interpolation::Quintic)] {
        for count in [9_usize, 17, 33] {
            let nodes: Vec<f64> = (0..count).map(|i| -1.0 + 2.0 * i as f64 / (count - 1) as f64).collect();
            let map = SampledUniformityMap::of(&Lattice, [nodes.clone(), nodes.clone(), nodes], interpolation)?;
            let connection = MaterialConnection::of_crystal(&map);
            let found = connection.torsion(&place)?;
            let pairs = found.components.as_flattened().as_flattened().iter();
            let pairs = pairs.zip(exact.components.as_flattened().as_flattened());
            let name = format!("sampled_{spline}/{count}");
            notes.error(&name, pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / exact.largest());
            group.bench_function(&name, |b| b.iter(|| connection.torsion(black_box(&place))));
        }
    }
    Ok(())
}
