//! Nanoseconds a point of laws of solids: `<law>/<quantity>/<batch>`.
//!
//! | part | what |
//! |---|---|
//! | `first_piola`, `first_piola_tangent` | P; ∂P/∂F, its 45 entries in batches |
//! | `first_piola_and_tangent` | both, from what they share |
//! | `first_piola_derivative` | (∂P/∂F) : δF |
//! | `1`, `1k`, `1M` | one call; batches in cache and in memory, structures of arrays in and out |
//! | `…_matrices` | arrays of matrices in and out instead |
//! | `nalgebra_mooney_rivlin` | the printed formula in nalgebra |
//! | `without_tangent` | the printed, cancelling formula in the same lanes, of a law that has no tangent |
//! | `copy_<quantity>` | as many bytes copied as the quantity reads and writes |
//!
//! `error` is the largest relative error of P over the reference cases near the identity.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use nalgebra::Matrix3;
use piola_benches::constitutive::Printed;
use piola_benches::continuum::methods::NALGEBRA;
use piola_benches::continuum::ordinary_deformations;
use piola_benches::notes::Notes;
use piola_constitutive::batch;
use piola_constitutive::solids::{
    Compressible, Hencky, Hyperelastic, MooneyRivlin, NeoHookeanLogarithmic, Ogden, OgdenTerm, SaintVenantKirchhoff,
    isochoric, volumetric,
};
use piola_continuum::batch::{Components, Gradients};
use piola_continuum::{DeformationGradient, FirstPiola};
use piola_testkit::{golden, relative_error};

const BATCHES: [(&str, usize); 2] = [("1k", 1000), ("1M", 1_000_000)];

type Group<'a> = BenchmarkGroup<'a, WallTime>;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("constitutive");
    group.sample_size(20).nresamples(2000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(300));
    let mut notes = Notes::of("constitutive");
    let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
    let printed = Printed { c10: 0.5, c01: 0.25, c: 1.0, d: rubber.d() };
    single_points(&mut group, &printed)?;
    notes_of_printed(&mut notes)?;
    for size in BATCHES {
        let mut arrays = Arrays::of(size.1);
        copies(&mut group, size);
        printed_in_lanes(&mut group, size, &printed, &mut arrays)?;
        mooney_rivlin(&mut group, size, &rubber, &mut arrays)?;
        law(
            &mut group,
            "neo_hookean_logarithmic",
            size,
            &NeoHookeanLogarithmic::with_constants(1.0, 2.0)?,
            &mut arrays,
        )?;
        law(&mut group, "saint_venant_kirchhoff", size, &SaintVenantKirchhoff::new(1.0, 2.0)?, &mut arrays)?;
        let bulk = volumetric::Quadratic::new(10.0)?;
        let soft = Compressible::new(isochoric::NeoHookean::new(1.0)?, bulk);
        law(&mut group, "neo_hookean_isochoric", size, &soft, &mut arrays)?;
        law(&mut group, "gent", size, &Compressible::new(isochoric::Gent::new(1.0, 50.0)?, bulk), &mut arrays)?;
        law(&mut group, "hencky", size, &Hencky::new(1.0, 2.0)?, &mut arrays)?;
        law(&mut group, "ogden", size, &ogden()?, &mut arrays)?;
    }
    group.finish();
    criterion.final_summary();
    notes.write()?;
    Ok(())
}

/// Three terms, those of vulcanised rubber.
fn ogden() -> Result<Ogden, Box<dyn Error>> {
    let term = |mu, alpha| OgdenTerm { mu, alpha };
    Ok(Ogden::new(&[term(0.63, 1.3), term(0.0012, 5.0), term(-0.01, -2.0)], 2.0)?)
}

/// Components of so many deformations, and room for P and ∂P/∂F.
struct Arrays {
    matrices: Vec<DeformationGradient>,
    gradients: [Vec<f64>; 9],
    stresses: [Vec<f64>; 9],
    tangents: [Vec<f64>; 45],
}

impl Arrays {
    fn of(count: usize) -> Self {
        let matrices = ordinary_deformations(count);
        let component = |k: usize| matrices.iter().map(|f| f.matrix()[(k / 3, k % 3)]).collect();
        Self {
            gradients: core::array::from_fn(component),
            matrices,
            stresses: core::array::from_fn(|_| vec![0.0; count]),
            tangents: core::array::from_fn(|_| vec![0.0; count]),
        }
    }

    fn input(gradients: &[Vec<f64>; 9]) -> Result<Gradients<Components<&[f64], 9>>, Box<dyn Error>> {
        Ok(Gradients(Components::new(gradients.each_ref().map(Vec::as_slice))?))
    }
}

/// Room for the components of a batch, borrowed anew.
macro_rules! room {
    ($arrays:expr) => {
        Components::new_mut($arrays.each_mut().map(Vec::as_mut_slice))?
    };
}

/// P and ∂P/∂F of a law in structures of arrays.
fn law<L: Hyperelastic + Sync>(
    group: &mut Group<'_>,
    name: &str,
    (batch, count): (&str, usize),
    law: &L,
    Arrays { gradients, stresses, tangents, .. }: &mut Arrays,
) -> Result<(), Box<dyn Error>> {
    let input = Arrays::input(gradients)?;
    group.throughput(Throughput::Elements(count as u64));
    group.bench_function(format!("{name}/first_piola/{batch}"), |b| {
        b.iter(|| {
            batch::evaluate(black_box(input), batch::first_piola(law, room!(stresses))).map(|report| report.points)
        });
    });
    group.bench_function(format!("{name}/first_piola_tangent/{batch}"), |b| {
        b.iter(|| {
            let request = batch::first_piola_tangent(law, room!(tangents));
            batch::evaluate(black_box(input), request).map(|report| report.points)
        });
    });
    Ok(())
}

fn mooney_rivlin(
    group: &mut Group<'_>,
    (batch, count): (&str, usize),
    rubber: &MooneyRivlin,
    arrays: &mut Arrays,
) -> Result<(), Box<dyn Error>> {
    law(group, "mooney_rivlin", (batch, count), rubber, arrays)?;
    let Arrays { matrices, gradients, stresses, tangents } = arrays;
    let input = Arrays::input(gradients)?;
    group.bench_function(format!("mooney_rivlin/first_piola_and_tangent/{batch}"), |b| {
        b.iter(|| {
            let request = batch::first_piola_and_tangent(rubber, room!(stresses), room!(tangents));
            batch::evaluate(black_box(input), request).map(|report| report.points)
        });
    });
    let mut p = vec![FirstPiola(Matrix3::zeros()); count];
    group.bench_function(format!("mooney_rivlin/first_piola_matrices/{batch}"), |b| {
        b.iter(|| batch::evaluate(black_box(&matrices[..]), batch::first_piola(rubber, &mut p[..])).map(|r| r.points));
    });
    let direction = vec![Matrix3::new(0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9); count];
    group.bench_function(format!("mooney_rivlin/first_piola_derivative/{batch}"), |b| {
        b.iter(|| {
            let request = batch::first_piola_derivative(rubber, &direction[..], &mut p[..]);
            batch::evaluate(black_box(&matrices[..]), request).map(|report| report.points)
        });
    });
    drop((p, direction));
    let mut a = vec![[0.0; 45]; count];
    group.bench_function(format!("mooney_rivlin/first_piola_tangent_matrices/{batch}"), |b| {
        b.iter(|| {
            let request = batch::first_piola_tangent(rubber, &mut a[..]);
            batch::evaluate(black_box(&matrices[..]), request).map(|report| report.points)
        });
    });
    Ok(())
}

fn printed_in_lanes(
    group: &mut Group<'_>,
    (batch, count): (&str, usize),
    printed: &Printed,
    Arrays { matrices, gradients, stresses, .. }: &mut Arrays,
) -> Result<(), Box<dyn Error>> {
    let input = Arrays::input(gradients)?;
    group.throughput(Throughput::Elements(count as u64));
    group.bench_function(format!("without_tangent/first_piola/{batch}"), |b| {
        b.iter(|| batch::evaluate(black_box(input), batch::first_piola(printed, room!(stresses))).map(|r| r.points));
    });
    let mut p = vec![Matrix3::zeros(); count];
    group.bench_function(format!("nalgebra_mooney_rivlin/first_piola/{batch}"), |b| {
        b.iter(|| {
            for (f, p) in black_box(&matrices[..]).iter().zip(&mut p) {
                *p = printed.first_piola(f.matrix());
            }
        });
    });
    Ok(())
}

/// As many bytes as P and ∂P/∂F read and write, together.
fn copies(group: &mut Group<'_>, (batch, count): (&str, usize)) {
    group.throughput(Throughput::Elements(count as u64));
    for (quantity, numbers) in [("first_piola", 18), ("first_piola_tangent", 54)] {
        let (from, mut to) = (vec![1.0_f64; count * numbers / 2], vec![0.0_f64; count * numbers / 2]);
        group.bench_function(format!("copy/{quantity}/{batch}"), |b| {
            b.iter(|| black_box(&mut to[..]).copy_from_slice(black_box(&from)));
        });
    }
}

/// One call a law, beside the printed formula in nalgebra.
fn single_points(group: &mut Group<'_>, printed: &Printed) -> Result<(), Box<dyn Error>> {
    group.throughput(Throughput::Elements(1));
    let f = ordinary_deformations(8)[7];
    let bulk = volumetric::Quadratic::new(10.0)?;
    single(group, "mooney_rivlin", &f, &MooneyRivlin::stress_free(0.5, 0.25, 1.0)?);
    single(group, "neo_hookean_logarithmic", &f, &NeoHookeanLogarithmic::with_constants(1.0, 2.0)?);
    single(group, "saint_venant_kirchhoff", &f, &SaintVenantKirchhoff::new(1.0, 2.0)?);
    single(group, "neo_hookean_isochoric", &f, &Compressible::new(isochoric::NeoHookean::new(1.0)?, bulk));
    single(group, "gent", &f, &Compressible::new(isochoric::Gent::new(1.0, 50.0)?, bulk));
    single(group, "hencky", &f, &Hencky::new(1.0, 2.0)?);
    single(group, "ogden", &f, &ogden()?);
    let matrix = *f.matrix();
    group.bench_function("nalgebra_mooney_rivlin/first_piola/1", |b| {
        b.iter(|| black_box(printed).first_piola(black_box(&matrix)));
    });
    group.bench_function("nalgebra_mooney_rivlin/first_piola_tangent/1", |b| {
        b.iter(|| black_box(printed).first_piola_tangent(black_box(&matrix)));
    });
    Ok(())
}

fn single<L: Hyperelastic>(group: &mut Group<'_>, name: &str, f: &DeformationGradient, law: &L) {
    group.bench_function(format!("{name}/first_piola/1"), |b| b.iter(|| black_box(law).first_piola(black_box(f))));
    group.bench_function(format!("{name}/first_piola_and_tangent/1"), |b| {
        b.iter(|| black_box(law).first_piola_and_tangent(black_box(f)));
    });
}

/// The errors of P over the reference cases near the identity, ours and the printed formula's.
fn notes_of_printed(notes: &mut Notes) -> Result<(), Box<dyn Error>> {
    let (mut ours, mut printed) = (0.0_f64, 0.0_f64);
    let golden = golden::load("hyperelastic");
    for case in golden.cases.iter().filter(|case| {
        golden::text(&case["model"]) == "mooney_rivlin_compressible"
            && golden::text(&case["id"]).contains("near_identity")
    }) {
        let [c10, c01, c, d] = ["c10", "c01", "c", "d"].map(|name| golden::number(&case["params"][name]));
        let rows = golden::matrix(&case["input"]["F"]);
        let f = DeformationGradient::new(Matrix3::from_fn(|i, j| rows[i][j]))?;
        let expected = golden::matrix(&case["output"]["P"]).concat();
        let error = |p: Matrix3<f64>| relative_error(p.transpose().as_slice(), &expected);
        ours = ours.max(error(MooneyRivlin::new(c10, c01, c, d)?.first_piola(&f).0));
        printed = printed.max(error(Printed { c10, c01, c, d }.first_piola(f.matrix())));
    }
    for size in ["1", "1k", "1M"] {
        notes.error(&format!("mooney_rivlin/first_piola/{size}"), ours);
        notes.error(&format!("nalgebra_mooney_rivlin/first_piola/{size}"), printed);
        notes.peer(&format!("nalgebra_mooney_rivlin/first_piola/{size}"), NALGEBRA);
    }
    for size in ["1k", "1M"] {
        notes.error(&format!("without_tangent/first_piola/{size}"), printed);
    }
    notes.peer("nalgebra_mooney_rivlin/first_piola_tangent/1", NALGEBRA);
    Ok(())
}
