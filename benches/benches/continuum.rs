//! Nanoseconds a point of the functions of a deformation: `<function>/1`, `<function>/1k`, `<function>/1M`.
//!
//! `/1` is the one-point function; `/1k` (in cache) and `/1M` (in memory) are batches, an array of structures in and
//! one out. `copy_<function>/<batch>` copies so many bytes that together as many are read and written as the function
//! reads and writes: the floor that memory sets. `<function>_arrays/<batch>` reads and writes structures of arrays.
//! Peers have single points only.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use nalgebra::Matrix3;
use piola_batch as batch;
use piola_batch::{Components, Gradients};
use piola_benches::continuum::{methods, ordinary_deformations};
use piola_benches::notes::Notes;
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::strain::{GreenStrain, RightCauchyGreen};
use piola_continuum::stress::tangents::{LieTangent, MaterialTangent};
use piola_continuum::{CauchyStress, DeformationGradient, FirstPiola, Symmetric};
use piola_tensor::MajorSymmetric;

const BATCHES: [(&str, usize); 2] = [("1k", 1000), ("1M", 1_000_000)];

type Group<'a> = BenchmarkGroup<'a, WallTime>;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("continuum");
    group.sample_size(20).nresamples(2000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(300));
    let mut notes = Notes::of("continuum");
    single(&mut group)?;
    peers(&mut group, &mut notes);
    for (name, count) in BATCHES {
        kinematic(&mut group, name, count);
        stresses(&mut group, name, count);
        arrays(&mut group, name, count)?;
    }
    group.finish();
    criterion.final_summary();
    notes.write()?;
    Ok(())
}

/// One point: what the one-point functions cost.
fn single(group: &mut Group<'_>) -> Result<(), Box<dyn Error>> {
    group.throughput(Throughput::Elements(1));
    let f = ordinary_deformations(8)[7];
    let stress = CauchyStress::new(3.0, -1.0, 2.0, 0.5, 4.0, -2.0)?;
    let first_piola = stress.first_piola(&f);
    let tangent = MaterialTangent::<f64>(MajorSymmetric::isotropic(1.0, 2.0));
    group.bench_function("right_cauchy_green/1", |b| b.iter(|| RightCauchyGreen::of(black_box(&f))));
    group.bench_function("green_strain/1", |b| b.iter(|| GreenStrain::of(black_box(&f))));
    group.bench_function("right_stretch/1", |b| b.iter(|| StretchAnalysis::of(black_box(&f)).right_stretch()));
    group.bench_function("rotation/1", |b| b.iter(|| StretchAnalysis::of(black_box(&f)).rotation()));
    group.bench_function("hencky/1", |b| b.iter(|| StretchAnalysis::of(black_box(&f)).hencky_material()));
    group.bench_function("polar_hencky/1", |b| b.iter(|| methods::polar(black_box(&f))));
    group.bench_function("symmetric_eigen/1", |b| {
        let square = RightCauchyGreen::of(&f).0;
        b.iter(|| methods::pairs(black_box(&square)));
    });
    group.bench_function("cauchy_to_first_piola/1", |b| b.iter(|| black_box(&stress).first_piola(black_box(&f))));
    group.bench_function("first_piola_to_cauchy/1", |b| b.iter(|| black_box(&first_piola).cauchy(black_box(&f))));
    group.bench_function("push_forward_tangent/1", |b| b.iter(|| black_box(&tangent).lie(black_box(&f))));
    for (name, bytes) in [
        ("right_cauchy_green", 120),
        ("green_strain", 120),
        ("right_stretch", 120),
        ("rotation", 144),
        ("hencky", 120),
        ("polar_hencky", 240),
        ("cauchy_to_first_piola", 192),
        ("first_piola_to_cauchy", 192),
        ("push_forward_tangent", 408),
    ] {
        copy(group, name, ("1", 1), bytes);
    }
    Ok(())
}

fn peers(group: &mut Group<'_>, notes: &mut Notes) {
    let f = *ordinary_deformations(8)[7].matrix();
    let square = f.transpose() * f;
    group.bench_function("nalgebra_polar_hencky/1", |b| b.iter(|| methods::polar_by_svd(black_box(&f))));
    group.bench_function("nalgebra_svd/1", |b| b.iter(|| black_box(&f).svd(true, true)));
    group.bench_function("nalgebra_symmetric_eigen/1", |b| b.iter(|| methods::pairs_by_nalgebra(black_box(&square))));
    group.bench_function("trigonometric_eigen/1", |b| b.iter(|| methods::pairs_by_trigonometry(black_box(&square))));
    group.bench_function("trigonometric_polar_hencky/1", |b| b.iter(|| methods::polar_by_trigonometry(black_box(&f))));
    for name in ["nalgebra_polar_hencky/1", "nalgebra_svd/1", "nalgebra_symmetric_eigen/1"] {
        notes.peer(name, methods::NALGEBRA);
    }
    for name in ["trigonometric_eigen/1", "trigonometric_polar_hencky/1"] {
        notes.peer(name, "closed form by the arccosine");
    }
}

/// A batch with its outputs, which each iteration borrows anew, and the copy of as many bytes for each point.
macro_rules! batch_bench {
    ($group:ident, $name:literal, $size:expr, $bytes:expr, $f:ident, [$($output:ident = $element:expr),+], $requests:expr) => {{
        $(let mut $output = vec![$element; $size.1];)+
        $group.throughput(Throughput::Elements($size.1 as u64));
        $group.bench_function(format!("{}/{}", $name, $size.0), |b| {
            b.iter(|| batch::evaluate(black_box(&$f[..]), $requests).map(|report| report.slow_path));
        });
        copy($group, $name, $size, $bytes);
    }};
}

fn copy(group: &mut Group<'_>, name: &str, size: (&str, usize), bytes: usize) {
    let from = vec![1.0_f64; size.1 * bytes / 16];
    let mut to = vec![0.0_f64; size.1 * bytes / 16];
    group.bench_function(format!("copy_{name}/{}", size.0), |b| {
        b.iter(|| black_box(&mut to[..]).copy_from_slice(black_box(&from)));
    });
}

fn kinematic(group: &mut Group<'_>, name: &str, count: usize) {
    let (size, f) = ((name, count), ordinary_deformations(count));
    let (s, m) = (Symmetric::<f64>::zero(), Matrix3::<f64>::zeros());
    batch_bench!(group, "right_cauchy_green", size, 120, f, [c = s], batch::right_cauchy_green(&mut c[..]));
    batch_bench!(group, "green_strain", size, 120, f, [e = s], batch::green_strain(&mut e[..]));
    batch_bench!(group, "right_stretch", size, 120, f, [u = s], batch::right_stretch(&mut u[..]));
    batch_bench!(group, "rotation", size, 144, f, [r = m], batch::rotation(&mut r[..]));
    batch_bench!(group, "hencky", size, 120, f, [l = s], batch::hencky(&mut l[..]));
    batch_bench!(
        group,
        "polar_hencky",
        size,
        240,
        f,
        [r = m, u = s, l = s],
        (batch::rotation(&mut r[..]), batch::right_stretch(&mut u[..]), batch::hencky(&mut l[..]))
    );
}

fn stresses(group: &mut Group<'_>, name: &str, count: usize) {
    let (size, f) = ((name, count), ordinary_deformations(count));
    let t = vec![CauchyStress(Symmetric::new(3.0, -1.0, 2.0, 0.5, 4.0, -2.0)); count];
    let none = FirstPiola(Matrix3::<f64>::zeros());
    batch_bench!(
        group,
        "cauchy_to_first_piola",
        size,
        192,
        f,
        [p = none],
        batch::cauchy_to_first_piola(&t[..], &mut p[..])
    );
    let p: Vec<FirstPiola> = f.iter().zip(&t).map(|(f, t)| t.first_piola(f)).collect();
    batch_bench!(
        group,
        "first_piola_to_cauchy",
        size,
        192,
        f,
        [t = CauchyStress(Symmetric::<f64>::zero())],
        batch::first_piola_to_cauchy(&p[..], &mut t[..])
    );
    drop((t, p));
    let tangents = vec![MaterialTangent::<f64>(MajorSymmetric::isotropic(1.0, 2.0)); count];
    let none = LieTangent::<f64>(MajorSymmetric::zero());
    batch_bench!(
        group,
        "push_forward_tangent",
        size,
        408,
        f,
        [c = none],
        batch::push_forward_tangent(&tangents[..], &mut c[..])
    );
}

/// Structures of arrays in and out.
fn arrays(group: &mut Group<'_>, name: &str, count: usize) -> Result<(), Box<dyn Error>> {
    let f = ordinary_deformations(count);
    let columns: [Vec<f64>; 9] =
        core::array::from_fn(|k| f.iter().map(|f: &DeformationGradient| f.matrix()[(k / 3, k % 3)]).collect());
    let input = Gradients(Components::new(columns.each_ref().map(Vec::as_slice))?);
    let mut c: [Vec<f64>; 6] = core::array::from_fn(|_| vec![0.0; count]);
    let mut r: [Vec<f64>; 9] = core::array::from_fn(|_| vec![0.0; count]);
    let mut u = c.clone();
    group.throughput(Throughput::Elements(count as u64));
    group.bench_function(format!("right_cauchy_green_arrays/{name}"), |b| {
        b.iter(|| {
            let to = Components::new_mut(c.each_mut().map(Vec::as_mut_slice))?;
            batch::evaluate(black_box(input), batch::right_cauchy_green(to)).map(|report| report.slow_path)
        });
    });
    group.bench_function(format!("polar_hencky_arrays/{name}"), |b| {
        b.iter(|| {
            let requests = (
                batch::rotation(Components::new_mut(r.each_mut().map(Vec::as_mut_slice))?),
                batch::right_stretch(Components::new_mut(u.each_mut().map(Vec::as_mut_slice))?),
                batch::hencky(Components::new_mut(c.each_mut().map(Vec::as_mut_slice))?),
            );
            batch::evaluate(black_box(input), requests).map(|report| report.slow_path)
        });
    });
    Ok(())
}
