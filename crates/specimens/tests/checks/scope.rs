//! What the checks look at: nothing is passed that was not tested, nothing refuted where the law has no answer.

use nalgebra::Matrix3;
use piola_continuum::{Deformation, DeformationGradient};
use piola_solids::isochoric::{ArrudaBoyce, Gent, MooneyRivlin};
use piola_solids::volumetric::Quadratic;
use piola_solids::{
    Compressible, ElasticConstants, Hencky, Hyperelastic, IncompressibleOgden, IncompressibleSolid, LinearElastic,
    OgdenTerm, Pressurised, SaintVenantKirchhoff,
};
use piola_specimens::checks::{
    Elastic, Kinematics, Report, Sampler, Search, Stored, SymmetryGroup, Verdict, baker_ericksen, drucker,
    drucker_path, ellipticity_scan, first_loss, frame_indifference, hyperelasticity, material_symmetry, noll,
    potential,
};
use piola_specimens::homogeneous::Mode;
use piola_testkit::{Tol, assert_close};

fn mooney() -> MooneyRivlin {
    MooneyRivlin::new(0.37, 0.11).expect("parameters")
}

fn gent(limit: f64) -> Compressible<Gent, Quadratic> {
    Compressible::new(Gent::new(0.8, limit).expect("parameters"), Quadratic::new(5.0).expect("κ"))
}

fn tested<C: core::fmt::Debug>(what: &str, report: &Report<C>, samples: usize) {
    assert!(report.passes() && 0 < report.samples, "{what}: {report:?}");
    assert_eq!(report.samples + report.refused, samples, "{what}");
}

/// All checks of an isotropic law pass, and each sample was either compared or refused.
fn isotropic_law_passes(what: &str, law: &impl Hyperelastic, search: &Search) {
    let report = noll(law, search);
    assert!(report.agrees() && report.passes(), "{what}: {report:?}");
    tested(what, &report.energy, search.samples);
    tested(what, &report.response, search.samples);
    tested(what, &report.symmetry, search.samples);
    tested(what, &material_symmetry(&Stored(law), &SymmetryGroup::isotropic(), search), search.samples);
    tested(what, &hyperelasticity(&Stored(law), &Search { strain: 0.5 * search.strain, ..*search }), search.samples);
    let report = baker_ericksen(law, search);
    assert!(report.passes() && report.samples + report.refused == search.samples, "{what}: {report:?}");
    let report = ellipticity_scan(law, &Search { samples: 10, ..*search }, Kinematics::Free);
    assert!(report.passes() && report.samples + report.refused == 10, "{what}: {report:?}");
}

#[test]
fn incompressible_laws_are_tested_at_deformations_that_they_can_have() {
    let search = Search { samples: 40, strain: 0.35, ..Search::default() };
    let terms = [OgdenTerm { modulus: 0.6, exponent: 1.3 }, OgdenTerm { modulus: -0.02, exponent: -2.0 }];
    isotropic_law_passes("Mooney–Rivlin", &IncompressibleSolid::new(mooney()), &search);
    let pressed = IncompressibleSolid::new(mooney()).at_pressure(0.7).expect("p");
    let report = noll(&pressed, &search);
    assert!(report.passes() && report.energy.refused == 0, "{report:?}");
    isotropic_law_passes("Ogden", &IncompressibleOgden::new(&terms).expect("terms"), &search);
    isotropic_law_passes("Hencky", &Pressurised::new(Hencky::new(1.5, 0.75).expect("parameters")), &search);
    // A law that depends on the observer is refuted as before.
    let constants = ElasticConstants::from_lame(1.5, 0.75).expect("constants");
    let bad = Pressurised::new(LinearElastic::new(constants).expect("law"));
    let report = noll(&bad, &search);
    assert!(report.agrees() && !report.passes(), "{report:?}");
    assert_eq!(report.energy.verdict(), Verdict::Refuted);
}

#[test]
fn potential_of_an_incompressible_law_equals_its_energy() {
    let law = IncompressibleSolid::new(mooney());
    let mut sampler = Sampler::new(3);
    for _ in 0..10 {
        let gradient = sampler.gradient(0.4);
        let volume = DeformationGradient::new(gradient).expect("F").jacobian();
        let f = DeformationGradient::new(gradient / volume.cbrt()).expect("F");
        let found = potential(&Stored(&law), &f);
        let tolerance = Tol::stated(1e-12, "quadrature to 1e-13 of the work without signs, which is some W");
        assert_close("W", &[found.energy], &[law.energy(&f)], tolerance);
    }
}

#[test]
fn samples_beyond_the_limit_of_a_law_are_counted_and_not_held_against_it() {
    let search = Search { samples: 60, ..Search::default() };
    for limit in [0.2, 1.0] {
        isotropic_law_passes("Gent", &gent(limit), &search);
        let report = frame_indifference(&Stored(&gent(limit)), &search);
        assert!(0 < report.refused, "J_m = {limit}: some are beyond");
    }
    let chains = ArrudaBoyce::new(0.8, 1.2).expect("parameters");
    let law = Compressible::new(chains, Quadratic::new(5.0).expect("κ"));
    assert!(0 < frame_indifference(&Stored(&law), &search).refused);
    isotropic_law_passes("Arruda–Boyce", &law, &search);
    isotropic_law_passes("incompressible Gent", &IncompressibleSolid::new(Gent::new(0.8, 0.4).expect("J_m")), &search);
    // NaN without refusal is a counterexample still.
    let blind = |f: &Matrix3<f64>| if 1.0 < f[(0, 0)] { Matrix3::from_element(f64::NAN) } else { *f * f.transpose() };
    let report = frame_indifference(&blind, &search);
    assert!(report.size.is_infinite() && report.verdict() == Verdict::Refuted && report.refused == 0);
}

#[test]
fn nothing_tested_does_not_pass() {
    let law = gent(5.0);
    let nothing = Search { samples: 0, ..Search::default() };
    assert_eq!(frame_indifference(&Stored(&law), &nothing).verdict(), Verdict::NothingTested);
    assert_eq!(hyperelasticity(&Stored(&law), &nothing).verdict(), Verdict::NothingTested);
    let report = noll(&law, &nothing);
    assert!(!report.passes() && !report.agrees());
    assert!(!material_symmetry(&Stored(&law), &SymmetryGroup::isotropic(), &nothing).passes());
    assert!(!baker_ericksen(&law, &nothing).passes());
    assert!(!ellipticity_scan(&law, &nothing, Kinematics::Free).passes());
    // A finite group is gone through at least once.
    assert_eq!(material_symmetry(&Stored(&law), &SymmetryGroup::orthotropic(), &nothing).samples, 4);
    // Every sample is beyond the limit: none is compared.
    let all = Search { samples: 20, strain: 1.0, ..Search::default() };
    let report = frame_indifference(&Stored(&gent(1e-9)), &all);
    assert!(!report.passes() && report.verdict() == Verdict::NothingTested && report.refused == 20, "{report:?}");
    let report = baker_ericksen(&gent(1e-9), &all);
    assert!(!report.passes() && report.samples == 0 && report.refused == 20, "{report:?}");
    // No two stretches differ: nothing is compared either.
    assert!(!baker_ericksen(&law, &Search { strain: 0.0, ..all }).passes());
}

#[test]
fn path_of_drucker_ends_at_the_limiting_stretch_and_loses_nothing_there() {
    let law = IncompressibleSolid::new(Gent::new(0.8, 0.2).expect("parameters"));
    let path = |stretch: f64| Mode::Uniaxial.elongations(stretch).map(|x| 1.0 + x);
    let report = drucker_path(&law, path, 1.0, 2.0, 10, Kinematics::Isochoric);
    assert!(report.passes() && report.first_loss.is_none(), "{report:?}");
    let end = report.end.expect("the path ends");
    // λ² + 2/λ − 3 = J_m.
    assert_close("end", &[end * end + 2.0 / end - 3.0], &[0.2], Tol::ulps(64.0));
    assert!(drucker(&law, path(1.5), Kinematics::Isochoric).modulus.is_nan());
    let outside = drucker_path(&law, path, 1.5, 2.0, 10, Kinematics::Isochoric);
    assert!(!outside.passes() && outside.end == Some(1.5) && outside.first_loss.is_none());
    // A loss before the end is found: C₀₁ < 0 softens, far below the limit of the stretches.
    let soft = IncompressibleSolid::new(MooneyRivlin::new(0.5, -0.1).expect("0 < C₁₀ + C₀₁"));
    let path = |stretch: f64| Mode::Equibiaxial.elongations(stretch).map(|x| 1.0 + x);
    let report = drucker_path(&soft, path, 1.0, 3.0, 40, Kinematics::Free);
    assert!(report.first_loss.is_some() && report.end.is_none(), "{report:?}");
    // Ellipticity along a path of an incompressible law: of isochoric waves, whatever is asked for.
    let along = |stretch: f64| DeformationGradient::diagonal(path(stretch)).ok();
    assert_eq!(
        first_loss(&soft, along, 1.0, 3.0, 10, Kinematics::Free),
        first_loss(&soft, along, 1.0, 3.0, 10, Kinematics::Isochoric)
    );
}

#[test]
fn potential_after_a_half_turn_equals_the_energy() {
    // An energy that depends on the observer: the turn does work.
    let law = LinearElastic::new(ElasticConstants::from_lame(1.5, 0.75).expect("constants")).expect("law");
    let axis = nalgebra::Vector3::new(0.48, 0.6, 0.64);
    let about = axis * axis.transpose() * 2.0 - Matrix3::identity();
    let stretch = Matrix3::new(1.2, 0.1, 0.0, 0.1, 0.9, 0.0, 0.0, 0.0, 1.1);
    for turn in
        [Matrix3::from_diagonal(&[-1.0, -1.0, 1.0].into()), Matrix3::from_diagonal(&[1.0, -1.0, -1.0].into()), about]
    {
        for stretch in [stretch, Matrix3::from_diagonal(&[1.2, 1.0, 1.0].into())] {
            let f = DeformationGradient::new(turn * stretch).expect("F");
            let found = potential(&Stored(&law), &f);
            let tolerance = Tol::stated(1e-12, "quadrature to 1e-13 of the work without signs");
            assert_close("W", &[found.energy], &[law.energy(&f)], tolerance);
        }
    }
    // No answer on the way: no energy.
    let f = DeformationGradient::diagonal([1.5, 1.0, 1.0]).expect("F");
    assert!(potential(&Stored(&gent(0.2)), &f).energy.is_nan());
    assert!(Stored(&SaintVenantKirchhoff::new(1.0, 1.0).expect("law")).answers(f.matrix()));
}
