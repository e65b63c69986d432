//! Laws of conspire, one call at one point: `conspire_<law>/<quantity>/1`, each right after ours of the same form.
//!
//! conspire has P and ∂P/∂F of one point only. Its Mooney–Rivlin solid is the isochoric one, whose P is made of T.

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use conspire::constitutive::solid::elastic::Elastic;
use conspire::constitutive::solid::hyperelastic::{
    ArrudaBoyce, Gent, Hencky as TheirHencky, MooneyRivlin, NeoHookean, Ogden, SaintVenantKirchhoff as Theirs,
};
use conspire::mechanics::DeformationGradient as Gradient;
use conspire::units::Stress;
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use piola_constitutive::solids::{
    Compressible, Hencky, Hyperelastic, IsochoricOgden, OgdenTerm, SaintVenantKirchhoff, isochoric, volumetric,
};
use piola_continuum::DeformationGradient;
use piola_peer_conspire::notes::Notes;

const CONSPIRE: &str = "conspire 0.8";

/// One of the deformations of our own benches.
const F: [[f64; 3]; 3] = [[1.19, 0.16, -0.28], [-0.15, 0.93, 0.2], [0.21, -0.07, 0.88]];

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("constitutive");
    group.sample_size(20).nresamples(1000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(150));
    group.throughput(Throughput::Elements(1));
    let mut notes = Notes::of("constitutive-peers");
    let bulk = volumetric::SimoTaylor::new(13.0)?;
    let pascals = Stress::pascals;
    let (bulk_modulus, shear_modulus) = (pascals(13.0), pascals(3.0));
    ours(&mut group, "mooney_rivlin_simo_taylor", &Compressible::new(isochoric::MooneyRivlin::new(1.0, 0.5)?, bulk))?;
    let theirs = MooneyRivlin { bulk_modulus, shear_modulus, extra_modulus: pascals(1.0) };
    peer(&mut group, &mut notes, "conspire_mooney_rivlin", &theirs);
    ours(&mut group, "neo_hookean_simo_taylor", &Compressible::new(isochoric::NeoHookean::new(3.0)?, bulk))?;
    peer(&mut group, &mut notes, "conspire_neo_hookean", &NeoHookean { bulk_modulus, shear_modulus });
    ours(&mut group, "gent_simo_taylor", &Compressible::new(isochoric::Gent::new(3.0, 23.0)?, bulk))?;
    peer(&mut group, &mut notes, "conspire_gent", &Gent { bulk_modulus, shear_modulus, extensibility: 23.0 });
    ours(&mut group, "arruda_boyce_simo_taylor", &Compressible::new(isochoric::ArrudaBoyce::new(3.0, 8.0)?, bulk))?;
    let theirs = ArrudaBoyce { bulk_modulus, shear_modulus, number_of_links: 8.0 };
    peer(&mut group, &mut notes, "conspire_arruda_boyce", &theirs);
    ours(&mut group, "saint_venant_kirchhoff", &SaintVenantKirchhoff::new(11.0, 3.0)?)?;
    peer(&mut group, &mut notes, "conspire_saint_venant_kirchhoff", &Theirs { bulk_modulus, shear_modulus });
    ours(&mut group, "hencky", &Hencky::new(11.0, 3.0)?)?;
    peer(&mut group, &mut notes, "conspire_hencky", &TheirHencky { bulk_modulus, shear_modulus });
    let term = |mu, alpha| OgdenTerm { mu, alpha };
    let terms = [term(0.63, 1.3), term(0.0012, 5.0), term(-0.01, -2.0)];
    ours(&mut group, "ogden_simo_taylor", &IsochoricOgden::with_volumetric(&terms, bulk)?)?;
    let theirs = Ogden {
        bulk_modulus,
        shear_moduli: terms.iter().map(|term| pascals(term.mu)).collect(),
        exponents: terms.iter().map(|term| term.alpha).collect(),
    };
    peer(&mut group, &mut notes, "conspire_ogden", &theirs);
    group.finish();
    criterion.final_summary();
    notes.write()?;
    Ok(())
}

type Group<'a> = BenchmarkGroup<'a, WallTime>;

fn ours<L: Hyperelastic>(group: &mut Group<'_>, name: &str, law: &L) -> Result<(), Box<dyn Error>> {
    let f = DeformationGradient::from_rows(F)?;
    group.bench_function(format!("{name}/first_piola/1"), |b| b.iter(|| black_box(law).first_piola(black_box(&f))));
    group.bench_function(format!("{name}/first_piola_tangent/1"), |b| {
        b.iter(|| black_box(law).first_piola_tangent(black_box(&f)));
    });
    Ok(())
}

fn peer<L: Elastic>(group: &mut Group<'_>, notes: &mut Notes, name: &str, law: &L) {
    let f = Gradient::from(F);
    let (stress, tangent) = (format!("{name}/first_piola/1"), format!("{name}/first_piola_tangent/1"));
    notes.peer(&stress, CONSPIRE);
    notes.peer(&tangent, CONSPIRE);
    group.bench_function(stress, |b| b.iter(|| black_box(law).first_piola_kirchhoff_stress(black_box(&f))));
    group.bench_function(tangent, |b| b.iter(|| black_box(law).first_piola_kirchhoff_tangent_stiffness(black_box(&f))));
}
