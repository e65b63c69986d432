//! Nanoseconds a point of laws of solids: `<law>/<quantity>/<batch>`.
//!
//! | part | what |
//! |---|---|
//! | `first_piola`, `first_piola_tangent` | P; ∂P/∂F, its 45 entries in batches |
//! | `first_piola_and_tangent` | both, from what they share |
//! | `energy`, `energy_and_first_piola` | W, and W with P from what they share, of three laws |
//! | `first_piola_derivative` | (∂P/∂F) : δF |
//! | `incompressible_…`, `pressurised_…` | laws with a given pressure; `uniaxial`: the pressure of a bar with free sides |
//! | `membrane`, `thin_plate` | what is conjugate to ∇u and to ∇∇u: single calls, there are no batches |
//! | `1`, `1k`, `1M` | one call; batches in cache and in memory, in blocks of lanes |
//! | `…_arrays`, `…_matrices` | structures of arrays, and arrays of matrices, in and out instead |
//! | `mooney_rivlin_without_tangent` | the same law with its energy and P alone: what P costs where there is no tangent |
//! | `printed_mooney_rivlin` | the printed formula in the same lanes, which loses the digits that cancel |
//! | `nalgebra_<law>` | the same law from a textbook, in nalgebra: see [`naive`]; batches keep ∂P/∂F of the last 1000 points |
//! | `copy/<quantity>` | as many bytes copied as the quantity reads and writes |
//!
//! Before they are timed, formulas of nalgebra and ours must agree, see [`naive::AGREEMENT`]. Each stands right after ours.
//!
//! `error` is the largest relative error near the identity, see [`laws::errors_near_identity`]; of ours in batches it is that of
//! a batch with the same layout and request, see [`laws::batch_errors_near_identity`]. A textbook's formula answers point by
//! point, a batch as one call.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, SamplingMode, Throughput};
use nalgebra::Matrix3;
use piola_batch::{Components, Gradients, LaneBlocks};
use piola_benches::constitutive::laws::{self, Visit};
use piola_benches::constitutive::naive::{self, Naive, Tangent, Textbook};
use piola_benches::constitutive::{Printed, WithoutTangent};
use piola_benches::continuum::methods::NALGEBRA;
use piola_benches::continuum::ordinary_deformations;
use piola_benches::notes::Notes;
use piola_continuum::{DeformationGradient, FirstPiola};
use piola_solids::batch;
use piola_solids::{Hyperelastic, Membrane, MooneyRivlin, ThinPlate};
use piola_specimens::homogeneous::{IncompressibleState, Mode};

const BATCHES: [(&str, usize); 2] = [("1k", 1000), ("1M", 1_000_000)];

/// Points of a block.
const BLOCK: usize = 8;

type Group<'a> = BenchmarkGroup<'a, WallTime>;
type Blocks<const K: usize> = Vec<[[f64; BLOCK]; K]>;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("constitutive");
    group.sample_size(10).nresamples(1000);
    group.warm_up_time(Duration::from_millis(30)).measurement_time(Duration::from_millis(120));
    let mut notes = Notes::of("constitutive");
    let rubber = laws::mooney_rivlin()?;
    let printed = Printed {
        c10: rubber.c10(),
        c01: rubber.c01(),
        c: rubber.square_coefficient(),
        d: rubber.logarithm_coefficient(),
    };
    group.throughput(Throughput::Elements(1));
    let f = ordinary_deformations(8)[7];
    laws::each(&mut Single { group: &mut group, f, notes: &mut notes })?;
    laws::each_incompressible(&mut Single { group: &mut group, f: laws::unimodular(&f)?, notes: &mut notes })?;
    from_a_free_face(&mut group)?;
    thin_bodies(&mut group, &f)?;
    laws::each(&mut InBatches(&mut notes))?;
    laws::each_incompressible(&mut InBatches(&mut notes))?;
    notes_of_rubber(&mut notes, &rubber, &printed)?;
    for size in BATCHES {
        group.throughput(Throughput::Elements(size.1 as u64));
        group.sampling_mode(if size.1 < 10_000 { SamplingMode::Auto } else { SamplingMode::Flat });
        copies(&mut group, size);
        let mut memory = Memory::of(size.1, |f| Ok(*f))?;
        rubber_alone(&mut group, size, &rubber, &printed, &mut memory)?;
        laws::each(&mut Batch { group: &mut group, size, memory: &mut memory })?;
        energies(&mut group, "mooney_rivlin", size, &rubber, &mut memory)?;
        energies(&mut group, "mooney_rivlin_isochoric", size, &laws::mooney_rivlin_isochoric()?, &mut memory)?;
        energies(&mut group, "ogden_isochoric", size, &laws::ogden_isochoric()?, &mut memory)?;
        drop(memory);
        let mut memory = Memory::of(size.1, laws::unimodular)?;
        laws::each_incompressible(&mut Batch { group: &mut group, size, memory: &mut memory })?;
        drop(memory);
        other_layouts(&mut group, size, &rubber)?;
        matrices(&mut group, size, &rubber);
    }
    group.finish();
    criterion.final_summary();
    notes.write()?;
    Ok(())
}

/// One call of each law.
struct Single<'a, 'b> {
    group: &'a mut Group<'b>,
    f: DeformationGradient,
    notes: &'a mut Notes,
}

impl Visit for Single<'_, '_> {
    fn law<L: Hyperelastic + Textbook + Sync>(
        &mut self,
        name: &'static str,
        model: Option<&'static str>,
        law: &L,
    ) -> Result<(), Box<dyn Error>> {
        let (group, f) = (&mut *self.group, &self.f);
        group.bench_function(format!("{name}/first_piola/1"), |b| b.iter(|| black_box(law).first_piola(black_box(f))));
        group.bench_function(format!("{name}/first_piola_tangent/1"), |b| {
            b.iter(|| black_box(law).first_piola_tangent(black_box(f)));
        });
        group.bench_function(format!("{name}/first_piola_and_tangent/1"), |b| {
            b.iter(|| black_box(law).first_piola_and_tangent(black_box(f)));
        });
        let [stress, tangent] = laws::errors_near_identity(model, law)?;
        let both = stress.max(tangent);
        for (quantity, error) in
            [("first_piola", stress), ("first_piola_tangent", tangent), ("first_piola_and_tangent", both)]
        {
            self.notes.error(&format!("{name}/{quantity}/1"), error);
        }
        self.textbook(name, model, law)
    }
}

impl Single<'_, '_> {
    /// The same law from a textbook.
    fn textbook<L: Hyperelastic + Textbook>(
        &mut self,
        name: &str,
        model: Option<&str>,
        law: &L,
    ) -> Result<(), Box<dyn Error>> {
        let (theirs, f) = (law.textbook(), self.f.matrix());
        naive::agree(name, law, &theirs, &self.f)?;
        let name = format!("nalgebra_{name}");
        self.group.bench_function(format!("{name}/first_piola/1"), |b| {
            b.iter(|| black_box(&theirs).first_piola(black_box(f)));
        });
        self.group.bench_function(format!("{name}/first_piola_tangent/1"), |b| {
            b.iter(|| black_box(&theirs).first_piola_tangent(black_box(f)));
        });
        self.group.bench_function(format!("{name}/first_piola_and_tangent/1"), |b| {
            b.iter(|| black_box(&theirs).first_piola_and_tangent(black_box(f)));
        });
        let [stress, tangent] = laws::textbook_errors_near_identity(model, law, &theirs)?;
        let both = stress.max(tangent);
        let all: [(&str, f64, &[&str]); 3] = [
            ("first_piola", stress, &["1", "1k", "1M"]),
            ("first_piola_tangent", tangent, &["1"]),
            ("first_piola_and_tangent", both, &["1", "1k", "1M"]),
        ];
        for (quantity, error, sizes) in all {
            for size in sizes {
                self.notes.error(&format!("{name}/{quantity}/{size}"), error);
                self.notes.peer(&format!("{name}/{quantity}/{size}"), NALGEBRA);
            }
        }
        Ok(())
    }
}

/// What the errors of P and of ∂P/∂F near the identity must be below: what is measured is accurate.
const LARGEST_ERRORS: [f64; 2] = [1e-13, 1e-12];

/// The errors of batches of each law.
struct InBatches<'a>(&'a mut Notes);

impl Visit for InBatches<'_> {
    fn law<L: Hyperelastic + Textbook + Sync>(
        &mut self,
        name: &'static str,
        model: Option<&'static str>,
        law: &L,
    ) -> Result<(), Box<dyn Error>> {
        let [stress, both] = laws::batch_errors_near_identity(model, law)?;
        if !(stress < LARGEST_ERRORS[0] && both < LARGEST_ERRORS[1]) {
            return Err(format!("{name}: near the identity P is within {stress:e} only, with ∂P/∂F {both:e}").into());
        }
        for (batch, _) in BATCHES {
            self.0.error(&format!("{name}/first_piola/{batch}"), stress);
            self.0.error(&format!("{name}/first_piola_and_tangent/{batch}"), both);
        }
        Ok(())
    }
}

/// So many deformations in blocks and one by one, and room for P and ∂P/∂F.
struct Memory {
    gradients: Blocks<9>,
    stresses: Blocks<9>,
    tangents: Blocks<45>,
    matrices: Vec<Matrix3<f64>>,
    answers: Vec<Matrix3<f64>>,
    /// 81 entries a point: room for [`KEPT`] of them, used in turn.
    whole: Vec<Tangent>,
}

/// Points whose ∂P/∂F from a textbook is kept.
const KEPT: usize = 1000;

impl Memory {
    fn of(
        count: usize,
        each: impl Fn(&DeformationGradient) -> Result<DeformationGradient, Box<dyn Error>>,
    ) -> Result<Self, Box<dyn Error>> {
        let blocks = count.div_ceil(BLOCK);
        let f: Vec<_> = ordinary_deformations(blocks * BLOCK).iter().map(each).collect::<Result<_, _>>()?;
        let component = |b: usize, k: usize| core::array::from_fn(|lane| f[BLOCK * b + lane].matrix()[(k / 3, k % 3)]);
        Ok(Self {
            gradients: (0..blocks).map(|b| core::array::from_fn(|k| component(b, k))).collect(),
            stresses: vec![[[0.0; BLOCK]; 9]; blocks],
            tangents: vec![[[0.0; BLOCK]; 45]; blocks],
            matrices: f.iter().take(count).map(|f| *f.matrix()).collect(),
            answers: vec![Matrix3::zeros(); count],
            whole: vec![Tangent::zeros(); KEPT],
        })
    }
}

/// Each law in blocks.
struct Batch<'a, 'b> {
    group: &'a mut Group<'b>,
    size: (&'static str, usize),
    memory: &'a mut Memory,
}

impl Visit for Batch<'_, '_> {
    fn law<L: Hyperelastic + Textbook + Sync>(
        &mut self,
        name: &'static str,
        _model: Option<&'static str>,
        law: &L,
    ) -> Result<(), Box<dyn Error>> {
        first_piola(self.group, name, self.size, law, self.memory)?;
        let Self { group, size: (batch, count), memory: Memory { gradients, stresses, tangents, .. } } = self;
        let input = Gradients(LaneBlocks::new(gradients, *count)?);
        group.bench_function(format!("{name}/first_piola_and_tangent/{batch}"), |b| {
            b.iter(|| {
                let (p, a) = (LaneBlocks::new_mut(stresses, *count)?, LaneBlocks::new_mut(tangents, *count)?);
                batch::evaluate(black_box(input), batch::first_piola_and_tangent(law, p, a)).map(|report| report.points)
            });
        });
        self.textbook(name, &law.textbook());
        Ok(())
    }
}

impl Batch<'_, '_> {
    /// The same law from a textbook, point by point.
    fn textbook(&mut self, name: &str, law: &impl Naive) {
        let Self { group, size: (batch, _), memory: Memory { matrices, answers, whole, .. } } = self;
        group.bench_function(format!("nalgebra_{name}/first_piola/{batch}"), |b| {
            b.iter(|| {
                for (f, p) in black_box(&matrices[..]).iter().zip(answers.iter_mut()) {
                    *p = law.first_piola(f);
                }
            });
        });
        group.bench_function(format!("nalgebra_{name}/first_piola_and_tangent/{batch}"), |b| {
            b.iter(|| {
                for (f, p) in black_box(&matrices[..]).chunks(KEPT).zip(answers.chunks_mut(KEPT)) {
                    for ((f, p), a) in f.iter().zip(p).zip(black_box(&mut whole[..])) {
                        (*p, *a) = law.first_piola_and_tangent(f);
                    }
                }
            });
        });
    }
}

fn first_piola<L: Hyperelastic + Sync>(
    group: &mut Group<'_>,
    name: &str,
    (batch, count): (&str, usize),
    law: &L,
    Memory { gradients, stresses, .. }: &mut Memory,
) -> Result<(), Box<dyn Error>> {
    let input = Gradients(LaneBlocks::new(gradients, count)?);
    group.bench_function(format!("{name}/first_piola/{batch}"), |b| {
        b.iter(|| {
            let to = LaneBlocks::new_mut(stresses, count)?;
            batch::evaluate(black_box(input), batch::first_piola(law, to)).map(|report| report.points)
        });
    });
    Ok(())
}

/// W, and W with P from what they share.
fn energies<L: Hyperelastic + Sync>(
    group: &mut Group<'_>,
    name: &str,
    (batch, count): (&str, usize),
    law: &L,
    Memory { gradients, stresses, .. }: &mut Memory,
) -> Result<(), Box<dyn Error>> {
    let input = Gradients(LaneBlocks::new(gradients, count)?);
    let mut energies = vec![[[0.0; BLOCK]; 1]; gradients.len()];
    group.bench_function(format!("{name}/energy/{batch}"), |b| {
        b.iter(|| {
            let to = LaneBlocks::new_mut(&mut energies, count)?;
            batch::evaluate(black_box(input), batch::energy(law, to)).map(|report| report.points)
        });
    });
    group.bench_function(format!("{name}/energy_and_first_piola/{batch}"), |b| {
        b.iter(|| {
            let (w, p) = (LaneBlocks::new_mut(&mut energies, count)?, LaneBlocks::new_mut(stresses, count)?);
            batch::evaluate(black_box(input), batch::energy_and_first_piola(law, w, p)).map(|report| report.points)
        });
    });
    Ok(())
}

/// The same law without a tangent, its printed formula, the tangent alone and along a direction.
fn rubber_alone(
    group: &mut Group<'_>,
    size: (&str, usize),
    rubber: &MooneyRivlin,
    printed: &Printed,
    memory: &mut Memory,
) -> Result<(), Box<dyn Error>> {
    first_piola(group, "mooney_rivlin_without_tangent", size, &WithoutTangent(*rubber), memory)?;
    first_piola(group, "printed_mooney_rivlin", size, printed, memory)?;
    let (batch, count) = size;
    let Memory { gradients, stresses, tangents, .. } = memory;
    let directions = vec![core::array::from_fn(|k| [0.1 + 0.1 * k as f64; BLOCK]); gradients.len()];
    let input = Gradients(LaneBlocks::new(gradients, count)?);
    group.bench_function(format!("mooney_rivlin/first_piola_tangent/{batch}"), |b| {
        b.iter(|| {
            let to = LaneBlocks::new_mut(tangents, count)?;
            batch::evaluate(black_box(input), batch::first_piola_tangent(rubber, to)).map(|report| report.points)
        });
    });
    group.bench_function(format!("mooney_rivlin/first_piola_derivative/{batch}"), |b| {
        b.iter(|| {
            let (along, to) = (LaneBlocks::new(&directions, count)?, LaneBlocks::new_mut(stresses, count)?);
            let request = batch::first_piola_derivative(rubber, along, to);
            batch::evaluate(black_box(input), request).map(|report| report.points)
        });
    });
    Ok(())
}

/// Structures of arrays.
fn other_layouts(
    group: &mut Group<'_>,
    (batch, count): (&str, usize),
    rubber: &MooneyRivlin,
) -> Result<(), Box<dyn Error>> {
    let f = ordinary_deformations(count);
    let component = |k: usize| f.iter().map(|f| f.matrix()[(k / 3, k % 3)]).collect();
    let gradients: [Vec<f64>; 9] = core::array::from_fn(component);
    let input = Gradients(Components::new(gradients.each_ref().map(Vec::as_slice))?);
    let mut stresses: [Vec<f64>; 9] = core::array::from_fn(|_| vec![0.0; count]);
    group.bench_function(format!("mooney_rivlin/first_piola_arrays/{batch}"), |b| {
        b.iter(|| {
            let to = Components::new_mut(stresses.each_mut().map(Vec::as_mut_slice))?;
            batch::evaluate(black_box(input), batch::first_piola(rubber, to)).map(|report| report.points)
        });
    });
    drop(stresses);
    let mut tangents: [Vec<f64>; 45] = core::array::from_fn(|_| vec![0.0; count]);
    group.bench_function(format!("mooney_rivlin/first_piola_tangent_arrays/{batch}"), |b| {
        b.iter(|| {
            let to = Components::new_mut(tangents.each_mut().map(Vec::as_mut_slice))?;
            batch::evaluate(black_box(input), batch::first_piola_tangent(rubber, to)).map(|report| report.points)
        });
    });
    Ok(())
}

/// Arrays of matrices.
fn matrices(group: &mut Group<'_>, (batch, count): (&str, usize), rubber: &MooneyRivlin) {
    let f = ordinary_deformations(count);
    let mut p = vec![FirstPiola(Matrix3::zeros()); count];
    group.bench_function(format!("mooney_rivlin/first_piola_matrices/{batch}"), |b| {
        b.iter(|| batch::evaluate(black_box(&f[..]), batch::first_piola(rubber, &mut p[..])).map(|r| r.points));
    });
    drop(p);
    let mut a = vec![[0.0; 45]; count];
    group.bench_function(format!("mooney_rivlin/first_piola_tangent_matrices/{batch}"), |b| {
        b.iter(|| batch::evaluate(black_box(&f[..]), batch::first_piola_tangent(rubber, &mut a[..])).map(|r| r.points));
    });
}

/// As many bytes as P, ∂P/∂F and both read and write, together.
fn copies(group: &mut Group<'_>, (batch, count): (&str, usize)) {
    for (quantity, numbers) in [("first_piola", 18), ("first_piola_tangent", 54), ("first_piola_and_tangent", 63)] {
        let (from, mut to) = (vec![1.0_f64; count * numbers / 2], vec![0.0_f64; count * numbers / 2]);
        group.bench_function(format!("copy/{quantity}/{batch}"), |b| {
            b.iter(|| black_box(&mut to[..]).copy_from_slice(black_box(&from)));
        });
    }
}

/// A bar of an incompressible solid: the pressure follows from its free sides.
fn from_a_free_face(group: &mut Group<'_>) -> Result<(), Box<dyn Error>> {
    let rubber = laws::incompressible_mooney_rivlin()?;
    group.bench_function("incompressible_mooney_rivlin/uniaxial/1", |b| {
        b.iter(|| IncompressibleState::of(black_box(&rubber), Mode::Uniaxial, black_box(1.5)));
    });
    Ok(())
}

/// Membranes and thin plates.
fn thin_bodies(group: &mut Group<'_>, f: &DeformationGradient) -> Result<(), Box<dyn Error>> {
    let (membrane, gradient) = (Membrane::new(2.0)?, f.matrix() - Matrix3::identity());
    group.bench_function("membrane/stress/1", |b| b.iter(|| black_box(&membrane).stress(black_box(&gradient))));
    let (plate, second) = (ThinPlate::new(2.0)?, [gradient.data.0; 3]);
    group.bench_function("thin_plate/moment/1", |b| b.iter(|| black_box(&plate).moment(black_box(&second))));
    Ok(())
}

/// The errors of batches of [`rubber_alone`], [`other_layouts`] and [`matrices`].
fn notes_of_rubber(notes: &mut Notes, rubber: &MooneyRivlin, printed: &Printed) -> Result<(), Box<dyn Error>> {
    let model = Some("mooney_rivlin_compressible");
    let arrays = laws::array_errors_near_identity(model, rubber)?;
    let matrices = laws::matrix_errors_near_identity(model, rubber)?;
    let errors = [
        ("printed_mooney_rivlin/first_piola", laws::batch_stress_error_near_identity(model, printed)?),
        (
            "mooney_rivlin_without_tangent/first_piola",
            laws::batch_stress_error_near_identity(model, &WithoutTangent(*rubber))?,
        ),
        ("mooney_rivlin/first_piola_tangent", laws::batch_tangent_error_near_identity(model, rubber)?),
        ("mooney_rivlin/first_piola_arrays", arrays[0]),
        ("mooney_rivlin/first_piola_tangent_arrays", arrays[1]),
        ("mooney_rivlin/first_piola_matrices", matrices[0]),
        ("mooney_rivlin/first_piola_tangent_matrices", matrices[1]),
    ];
    for (name, error) in errors {
        for (batch, _) in BATCHES {
            notes.error(&format!("{name}/{batch}"), error);
        }
    }
    Ok(())
}
