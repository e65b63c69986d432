//! Laws of conspire, one call at one point: `conspire_<law>/<quantity>/1`, each right after ours of the same form, one call
//! and 10³ points in blocks of lanes (`/1k`; the tangent together with P, as lanes share what both need).
//!
//! conspire has P and ∂P/∂F of one point only. Its Mooney–Rivlin solid is the isochoric one, whose P is made of T; its Fung is an
//! exponential of Ī₁, not that of the strain, and stands beside an energy of a change of shape of our own, as its Carroll does.
//! Before they are timed the answers of both must agree.
//!
//! `error` is the largest relative error near the identity to 31 digits of our law: see [`laws::errors_near_identity`], and for
//! `/1k` [`laws::batch_errors_near_identity`]. Where conspire refuses one of these deformations it has none.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use conspire::constitutive::solid::elastic::Elastic;
use conspire::constitutive::solid::hyperelastic::{
    ArrudaBoyce, BlatzKo as TheirBlatzKo, Carroll, Fung, Gent, Hencky as TheirHencky, Isihara, MooneyRivlin,
    NeoHookean, Ogden, SaintVenantKirchhoff as Theirs, Yeoh,
};
use conspire::mechanics::DeformationGradient as Gradient;
use conspire::units::Stress;
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use piola_benches::constitutive::laws;
use piola_benches::notes::Notes;
use piola_solids::batch;
use piola_solids::isochoric::{Isochoric, RivlinTerm};
use piola_solids::{BlatzKo, Compressible, Hencky, Hyperelastic, IsochoricOgden, OgdenTerm, SaintVenantKirchhoff, isochoric, volumetric};
use piola_continuum::DeformationGradient;
use piola_batch::{Gradients, LaneBlocks};
use piola_peer_conspire::Exponential;

const CONSPIRE: &str = "conspire 0.8";

/// One of the deformations of our own benches, by rows.
const F: [[f64; 3]; 3] = [[1.19, 0.16, -0.28], [-0.15, 0.93, 0.2], [0.21, -0.07, 0.88]];

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("constitutive");
    group.sample_size(20).nresamples(1000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(150));
    group.throughput(Throughput::Elements(1));
    let mut notes = Notes::of("constitutive-peers");
    let bulk = volumetric::SimoTaylor::new(BULK)?;
    let pascals = Stress::pascals;
    let (bulk_modulus, shear_modulus) = (pascals(BULK), pascals(SHEAR));
    let ours = Compressible::new(isochoric::MooneyRivlin::new(1.0, 0.5)?, bulk);
    let theirs = MooneyRivlin { bulk_modulus, shear_modulus, extra_modulus: pascals(1.0) };
    beside(&mut group, &mut notes, ["mooney_rivlin_simo_taylor", "conspire_mooney_rivlin"], &ours, &theirs, ROUNDING)?;
    let ours = Compressible::new(isochoric::NeoHookean::new(3.0)?, bulk);
    let theirs = NeoHookean { bulk_modulus, shear_modulus };
    beside(&mut group, &mut notes, ["neo_hookean_simo_taylor", "conspire_neo_hookean"], &ours, &theirs, ROUNDING)?;
    let ours = Compressible::new(isochoric::Gent::new(3.0, 23.0)?, bulk);
    let theirs = Gent { bulk_modulus, shear_modulus, extensibility: 23.0 };
    beside(&mut group, &mut notes, ["gent_simo_taylor", "conspire_gent"], &ours, &theirs, ROUNDING)?;
    // Theirs is given the shear modulus of the reference, ours n k θ.
    let softer = 3.0 / isochoric::ArrudaBoyce::new(3.0, 8.0)?.shear_modulus();
    let ours = Compressible::new(isochoric::ArrudaBoyce::new(3.0 * softer, 8.0)?, bulk);
    let theirs = ArrudaBoyce { bulk_modulus, shear_modulus, number_of_links: 8.0 };
    beside(&mut group, &mut notes, ["arruda_boyce_simo_taylor", "conspire_arruda_boyce"], &ours, &theirs, ROUNDING)?;
    let (ours, theirs) = (SaintVenantKirchhoff::new(11.0, 3.0)?, Theirs { bulk_modulus, shear_modulus });
    let names = ["saint_venant_kirchhoff_rubber", "conspire_saint_venant_kirchhoff"];
    beside(&mut group, &mut notes, names, &ours, &theirs, ROUNDING)?;
    let (ours, theirs) = (Hencky::new(11.0, 3.0)?, TheirHencky { bulk_modulus, shear_modulus });
    beside(&mut group, &mut notes, ["hencky_rubber", "conspire_hencky"], &ours, &theirs, ROUNDING)?;
    let term = |modulus, exponent| OgdenTerm { modulus, exponent };
    let terms = [term(0.63, 1.3), term(0.0012, 5.0), term(-0.01, -2.0)];
    let ours = IsochoricOgden::with_volumetric(&terms, bulk)?;
    let theirs = Ogden {
        bulk_modulus,
        shear_moduli: terms.iter().map(|term| pascals(term.mu)).collect(),
        exponents: terms.iter().map(|term| term.alpha).collect(),
    };
    beside(&mut group, &mut notes, ["ogden_simo_taylor", "conspire_ogden"], &ours, &theirs, ROUNDING)?;
    series(&mut group, &mut notes)?;
    not_of_series(&mut group, &mut notes)?;
    group.finish();
    criterion.final_summary();
    notes.write()?;
    Ok(())
}

/// κ, Pa, of all of them.
const BULK: f64 = 13.0;
/// μ, Pa.
const SHEAR: f64 = 3.0;

/// Polynomials of Ī₁ and Ī₂.
fn series(group: &mut Group<'_>, notes: &mut Notes) -> Result<(), Box<dyn Error>> {
    let (pascals, bulk) = (Stress::pascals, volumetric::SimoTaylor::new(BULK)?);
    let (bulk_modulus, shear_modulus) = (pascals(BULK), pascals(SHEAR));
    // Their energy is half of a sum.
    let ours = Compressible::new(isochoric::Yeoh::new(0.5 * SHEAR, -0.02, 0.001)?, bulk);
    let theirs = Yeoh { bulk_modulus, shear_moduli: [SHEAR, -0.04, 0.002].map(pascals).to_vec() };
    beside(group, notes, ["yeoh_simo_taylor", "conspire_yeoh"], &ours, &theirs, ROUNDING)?;
    let term = |first, second, coefficient| RivlinTerm { first, second, coefficient };
    let ours =
        Compressible::new(isochoric::Rivlin::new(vec![term(1, 0, 1.0), term(0, 1, 0.5), term(2, 0, 0.01)])?, bulk);
    let (extra_modulus, quadratic_modulus) = (pascals(1.0), pascals(0.02));
    let theirs = Isihara { bulk_modulus, shear_modulus, extra_modulus, quadratic_modulus };
    beside(group, notes, ["rivlin_simo_taylor", "conspire_isihara"], &ours, &theirs, ROUNDING)
}

/// Powers of J, an exponential and a root.
fn not_of_series(group: &mut Group<'_>, notes: &mut Notes) -> Result<(), Box<dyn Error>> {
    let (pascals, bulk) = (Stress::pascals, volumetric::SimoTaylor::new(BULK)?);
    let (bulk_modulus, shear_modulus) = (pascals(BULK), pascals(SHEAR));
    // Their exponent is β = κ/(2 μ) − 1/3, ours ν/(1 − 2 ν).
    let beta = BULK / (2.0 * SHEAR) - 1.0 / 3.0;
    let ours = BlatzKo::new(SHEAR, beta / (1.0 + 2.0 * beta), 0.5)?;
    let theirs = TheirBlatzKo { bulk_modulus, shear_modulus, mixing_parameter: 0.5 };
    beside(group, notes, ["blatz_ko_rubber", "conspire_blatz_ko"], &ours, &theirs, ROUNDING)?;
    let ours = Compressible::new(Exponential { mu: SHEAR, extra: 1.0, exponent: 0.5 }, bulk);
    let theirs = Fung { bulk_modulus, shear_modulus, extra_modulus: pascals(1.0), exponent: 0.5 };
    beside(group, notes, ["own_exponential_simo_taylor", "conspire_fung"], &ours, &theirs, ROUNDING)?;
    let ours = piola_peer_conspire::Carroll { linear: 1.0, quartic: 0.001, root: 0.5 };
    let theirs = Carroll {
        bulk_modulus,
        linear_modulus: pascals(ours.linear),
        quartic_modulus: pascals(ours.quartic),
        second_invariant_modulus: pascals(ours.root),
    };
    let names = ["own_carroll_simo_taylor", "conspire_carroll"];
    beside(group, notes, names, &Compressible::new(ours, bulk), &theirs, ROUNDING)
}

type Group<'a> = BenchmarkGroup<'a, WallTime>;

/// How far the answers of both may be from each other, relative to their largest entry.
const ROUNDING: f64 = 1e-10;

/// Ours and theirs, once they agree.
fn beside<O: Hyperelastic + Sync, L: Elastic>(
    group: &mut Group<'_>,
    notes: &mut Notes,
    [our_name, their_name]: [&str; 2],
    ours: &O,
    theirs: &L,
    tolerance: f64,
) -> Result<(), Box<dyn Error>> {
    let f = DeformationGradient::from_rows(F)?;
    let (stress, tangent) = (stress_of(theirs, &f)?, tangent_of(theirs, &f)?);
    let by_rows = ours.first_piola(&f).0.transpose();
    let differences = [
        difference(by_rows.as_slice(), &stress),
        difference(ours.first_piola_tangent(&f).0.components.as_flattened(), &tangent),
    ];
    if differences.iter().any(|difference| !(*difference < tolerance)) {
        return Err(format!("{our_name} and {their_name} differ by {differences:?}").into());
    }
    group
        .bench_function(format!("{our_name}/first_piola/1"), |b| b.iter(|| black_box(ours).first_piola(black_box(&f))));
    group.bench_function(format!("{our_name}/first_piola_tangent/1"), |b| {
        b.iter(|| black_box(ours).first_piola_tangent(black_box(&f)));
    });
    peer(group, notes, their_name, theirs);
    in_lanes(group, our_name, ours)?;
    errors(notes, [our_name, their_name], ours, theirs)
}

/// P of theirs, by rows.
fn stress_of<L: Elastic>(theirs: &L, f: &DeformationGradient) -> Result<Vec<f64>, &'static str> {
    let stress: [[f64; 3]; 3] = theirs.first_piola_kirchhoff_stress(&given(f)).map_err(|_| "conspire has no P")?.into();
    Ok(stress.concat())
}

/// ∂P/∂F of theirs, by rows.
fn tangent_of<L: Elastic>(theirs: &L, f: &DeformationGradient) -> Result<Vec<f64>, &'static str> {
    let tangent = theirs.first_piola_kirchhoff_tangent_stiffness(&given(f));
    Ok(tangent.map_err(|_| "conspire has no tangent")?.into())
}

fn given(f: &DeformationGradient) -> Gradient {
    let rows: [[f64; 3]; 3] = f.matrix().transpose().into();
    Gradient::from(rows)
}

/// Notes the errors of both. Theirs has none where it refuses one of the deformations or has no finite answer: no number stands
/// for that.
fn errors<O: Hyperelastic + Sync, L: Elastic>(
    notes: &mut Notes,
    [our_name, their_name]: [&str; 2],
    ours: &O,
    theirs: &L,
) -> Result<(), Box<dyn Error>> {
    let [stress, tangent] = laws::errors_near_identity(None, ours)?;
    notes.error(&format!("{our_name}/first_piola/1"), stress);
    notes.error(&format!("{our_name}/first_piola_tangent/1"), tangent);
    let [stress, both] = laws::batch_errors_near_identity(None, ours)?;
    notes.error(&format!("{our_name}/first_piola/1k"), stress);
    notes.error(&format!("{our_name}/first_piola_and_tangent/1k"), both);
    let answered = |answer: Result<Vec<f64>, _>, entries| answer.unwrap_or_else(|_| vec![f64::NAN; entries]);
    let [stress, tangent] = laws::answered_errors_near_identity(None, ours, |f| {
        Ok([answered(stress_of(theirs, f), 9), answered(tangent_of(theirs, f), 81)])
    })?;
    for (quantity, error) in [("first_piola", stress), ("first_piola_tangent", tangent)] {
        if error.is_finite() {
            notes.error(&format!("{their_name}/{quantity}/1"), error);
        }
    }
    Ok(())
}

/// Points of a batch, and of a block of it.
const POINTS: usize = 1000;
const BLOCK: usize = 8;

/// Ours at many deformations around that of the single calls.
fn in_lanes<O: Hyperelastic + Sync>(group: &mut Group<'_>, name: &str, law: &O) -> Result<(), Box<dyn Error>> {
    // Entries move by up to 0.05, by multiples of the golden section: all different, none repeated.
    let moved = |k: usize, point: usize| {
        let share = (0.618_033_988_749_894_9 * (9 * point + k) as f64).fract();
        F[k / 3][k % 3] + 0.1 * (share - 0.5)
    };
    let blocks = POINTS / BLOCK;
    let gradients: Vec<[[f64; BLOCK]; 9]> =
        (0..blocks).map(|b| std::array::from_fn(|k| std::array::from_fn(|lane| moved(k, BLOCK * b + lane)))).collect();
    let (mut stresses, mut tangents) = (vec![[[0.0; BLOCK]; 9]; blocks], vec![[[0.0; BLOCK]; 45]; blocks]);
    let input = Gradients(LaneBlocks::new(&gradients, POINTS)?);
    batch::evaluate(input, batch::first_piola(law, LaneBlocks::new_mut(&mut stresses, POINTS)?))?;
    group.throughput(Throughput::Elements(POINTS as u64));
    group.bench_function(format!("{name}/first_piola/1k"), |b| {
        b.iter(|| -> Result<(), Box<dyn Error>> {
            let to = LaneBlocks::new_mut(&mut stresses, POINTS)?;
            batch::evaluate(black_box(input), batch::first_piola(black_box(law), to))?;
            Ok(())
        });
    });
    group.bench_function(format!("{name}/first_piola_and_tangent/1k"), |b| {
        b.iter(|| -> Result<(), Box<dyn Error>> {
            let (p, a) = (LaneBlocks::new_mut(&mut stresses, POINTS)?, LaneBlocks::new_mut(&mut tangents, POINTS)?);
            batch::evaluate(black_box(input), batch::first_piola_and_tangent(black_box(law), p, a))?;
            Ok(())
        });
    });
    group.throughput(Throughput::Elements(1));
    Ok(())
}

/// The largest difference, relative to the largest entry.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    let largest = b.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    if a.len() != b.len() {
        return f64::INFINITY;
    }
    a.iter().zip(b).fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs())) / largest
}

fn peer<L: Elastic>(group: &mut Group<'_>, notes: &mut Notes, name: &str, law: &L) {
    let f = Gradient::from(F);
    let (stress, tangent) = (format!("{name}/first_piola/1"), format!("{name}/first_piola_tangent/1"));
    notes.peer(&stress, CONSPIRE);
    notes.peer(&tangent, CONSPIRE);
    group.bench_function(stress, |b| b.iter(|| black_box(law).first_piola_kirchhoff_stress(black_box(&f))));
    group.bench_function(tangent, |b| b.iter(|| black_box(law).first_piola_kirchhoff_tangent_stiffness(black_box(&f))));
}
