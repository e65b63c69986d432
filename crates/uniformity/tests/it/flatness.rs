//! Torsion and curvature vanish exactly where a body is locally homogeneous, W(28.26): both ways, with counterexamples.

use nalgebra::{Matrix3, Vector3};
use piola_fields::Motion as _;
use piola_integrators::Tolerance;
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close};
use piola_uniformity::{
    AffineConnection, CharacteristicMetric, CircuitDefects, Flatness, HomogeneousIn, LieAlgebra, MaterialConnection,
    MoebiusCrystal, NominalGroup, ReferenceCurve, TransportedFrame, UniformityMap, isomorphism,
};
use proptest::prelude::*;

use super::fixtures::{Golden, Turned, point, waves};

const TOLERANCE: f64 = 1e-12;

fn tight() -> Tolerance {
    Tolerance::relative(1e-13).expect("a tolerance")
}

fn is_flat(map: &impl UniformityMap, algebra: LieAlgebra, places: &[Vector3<f64>]) -> bool {
    Flatness::of_body(map, algebra, places, 1.0, TOLERANCE).expect("regular").is_flat()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn locally_homogeneous_bodies_are_flat_for_each_symmetry(
        motion in waves(), places in prop::collection::vec(point(), 3), rate in -2.0..2.0_f64
    ) {
        let axis = [2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0];
        let about = LieAlgebra::rotations_about(Vector3::from(axis))?;
        let gradient = HomogeneousIn(motion);
        for algebra in [LieAlgebra::trivial(), about.clone(), LieAlgebra::rotations()] {
            prop_assert!(is_flat(&gradient, algebra, &places));
        }
        // K H(X) with H about the axis is the same body for the symmetry about it, and no longer a gradient for a crystal.
        let turned = Turned { map: gradient, rate: rate + rate.signum(), axis };
        prop_assert!(is_flat(&turned, about, &places));
        prop_assert!(is_flat(&turned, LieAlgebra::rotations(), &places));
        prop_assert!(!is_flat(&turned, LieAlgebra::trivial(), &places));
        // A turn about another axis is felt by the transversely isotropic solid, not by the isotropic one.
        let aside = Turned { map: gradient, rate: rate + rate.signum(), axis: [0.6, 0.0, -0.8] };
        prop_assert!(!is_flat(&aside, LieAlgebra::rotations_about(Vector3::from(axis))?, &places));
        prop_assert!(is_flat(&aside, LieAlgebra::rotations(), &places));
    }

    #[test]
    fn flat_bodies_have_a_homogeneous_configuration(motion in waves(), x in point()) {
        // The other way: where torsion and curvature vanish, transport gives the configuration itself.
        let map = HomogeneousIn(motion);
        let connection = MaterialConnection::of_crystal(map);
        let places = [x, x + Vector3::new(0.5, 0.1, 0.0), x + Vector3::new(0.0, 0.5, 0.2), x + Vector3::new(0.2, 0.0, 0.5)];
        let defects = CircuitDefects::of(&connection, &map.value(&x)?, &places, tight())?;
        prop_assert!(defects.closure < 1e-11 && defects.holonomy < 1e-11 && defects.circuits == 3);
        // The development of a line is the difference of the places in it.
        let line = piola_uniformity::Segment { from: x, to: places[1] };
        let developed = TransportedFrame::along(&connection, &line, &map.value(&x)?, tight())?.development;
        let difference = motion.place(&places[1], 0.0) - motion.place(&x, 0.0);
        assert_close("y", developed.as_slice(), difference.as_slice(), Tol::stated(1e-11, "transport at 1e-13 a step"));
    }

    #[test]
    fn other_bodies_are_not_flat_and_do_not_close(map in waves(), x in point()) {
        // Random maps are not gradients, nor are their metrics flat.
        prop_assume!(map.amplitude.iter().any(|a| 0.05 < a.abs()) && map.wave.iter().all(|k| 0.2 < k.abs()));
        let places = [x, x + Vector3::x() * 0.5, x + Vector3::y() * 0.5, x + Vector3::z() * 0.5];
        prop_assert!(!is_flat(&map, LieAlgebra::trivial(), &places));
        prop_assert!(!is_flat(&map, LieAlgebra::rotations(), &places));
        let metric = Flatness::of_metric(&CharacteristicMetric(map), &places, 1.0, TOLERANCE)?;
        prop_assert!(!metric.is_flat() && metric.torsion.value < 1e-14 && 0.0 < metric.curvature.value);
        let connection = MaterialConnection::of_crystal(map);
        let defects = CircuitDefects::of(&connection, &map.value(&x)?, &places, tight())?;
        prop_assert!(1e-9 < defects.closure && defects.holonomy < 1e-10);
    }
}

#[test]
fn torsion_can_remain_where_the_metric_is_flat() {
    // The trap: edges of density ½ have torsion, and a Euclidean metric.
    let place = [Vector3::new(0.5, -0.25, 0.75)];
    for map in [Golden::Edges, Golden::Turning] {
        assert!(!is_flat(&map, LieAlgebra::trivial(), &place));
        assert!(is_flat(&map, LieAlgebra::rotations(), &place));
    }
    // Screws bend the metric, too; a single screw does neither away from its line.
    assert!(!is_flat(&Golden::Screws, LieAlgebra::rotations(), &place));
    for algebra in [LieAlgebra::trivial(), LieAlgebra::rotations()] {
        assert!(is_flat(&Golden::ScrewLine, algebra.clone(), &place));
        assert!(is_flat(&Golden::Gradient, algebra.clone(), &place));
        assert!(is_flat(&Golden::Constant, algebra, &place));
    }
}

#[test]
fn moebius_crystal_is_homogeneous_locally_and_not_globally() {
    let crystal = MoebiusCrystal::new(2.0).expect("a ring");
    let group = NominalGroup::generated(&[MoebiusCrystal::SEAM], 2).expect("a half turn");
    // 1. Uniform: maps with seams at other azimuths differ by the half turn alone, and the crystal does not feel it.
    let other = crystal.with_seam_at(0.5).expect("a seam");
    let behind = Vector3::new(2.0 * 1.5_f64.cos(), 2.0 * 1.5_f64.sin(), 0.25);
    let beyond = Vector3::new(2.0 * 0.25_f64.cos(), 2.0 * 0.25_f64.sin(), 0.25);
    let (mut same, mut turned) = (0, 0);
    for place in [behind, beyond] {
        let defect = isomorphism::freedom_defect(&crystal, &other, &group, &place).expect("regular");
        assert!(defect < 1e-14, "{defect}");
        let without = isomorphism::freedom_defect(&crystal, &other, &NominalGroup::trivial(), &place).expect("regular");
        if without < 1e-14 { same += 1 } else { turned += 1 }
    }
    assert_eq!((same, turned), (1, 1), "one place on either side of the seam");

    // 2. Locally homogeneous everywhere, and the connection does not see the seam.
    let places: Vec<_> = (0..12)
        .map(|i| f64::from(i) * 0.52)
        .map(|azimuth| Vector3::new(2.2 * azimuth.cos(), 2.2 * azimuth.sin(), 0.3))
        .collect();
    assert!(is_flat(&crystal, LieAlgebra::trivial(), &places));
    assert!(is_flat(&crystal, LieAlgebra::rotations(), &places));
    for place in &places {
        let [a, b] = [crystal, other].map(|map| MaterialConnection::of_crystal(map).coefficients(place).expect("Γ"));
        let flat = |gamma: &[[[f64; 3]; 3]; 3]| gamma.as_flattened().as_flattened().to_vec();
        piola_testkit::assert_close_at_scale("Γ", &flat(&a.components), &flat(&b.components), 1.0, Tol::ulps(32.0));
    }

    // 3. Not globally: once around the core a frame returns turned by H, and the development has the length of the bar.
    let connection = MaterialConnection::of_crystal(crystal);
    let start = crystal.value(&crystal.core().place(0, 0.0)).expect("K");
    let round = TransportedFrame::around(&connection, &crystal.core(), &start, tight()).expect("around");
    let tol = Tol::stated(1e-11, "transport at 1e-13 a step");
    assert_close("H", round.holonomy().as_slice(), MoebiusCrystal::SEAM.as_slice(), tol);
    assert_close("y", round.development.as_slice(), &[crystal.length(), 0.0, 0.0], tol);
    // Twice around the frame is the first again: the holonomy group has two elements, those of the crystal's group.
    let twice = TransportedFrame::around(&connection, &crystal.core(), &round.end, tight()).expect("around");
    assert_close("H²", twice.end.as_slice(), start.as_slice(), tol);
    assert!(group.defect(&round.holonomy()) < 1e-10);

    // 4. A small circuit beside the core closes: nothing is wrong locally.
    let circle = piola_uniformity::RoundCircuit::new(Vector3::new(2.0, 0.0, 0.0), Vector3::y(), 0.5).expect("a circle");
    let start = crystal.value(&circle.place(0, 0.0)).expect("K");
    let round = TransportedFrame::around(&connection, &circle, &start, tight()).expect("around");
    assert!(round.development.norm() < 1e-11 && (round.holonomy() - Matrix3::identity()).norm() < 1e-11);
}

#[test]
fn flatness_reports_where_and_how_much() {
    // Torsion that grows with X₁: the certificate names the place.
    struct Growing;
    impl UniformityMap for Growing {
        fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
            let mut k = Matrix3::identity();
            k[(0, 0)] = (T::one() + T::lit(1e-6) * reference.x * reference.y).recip();
            k
        }
    }
    let places = [Vector3::new(0.5, 0.0, 0.0), Vector3::new(2.0, 0.0, 0.0), Vector3::new(1.0, 0.0, 0.0)];
    let report = Flatness::of_body(&Growing, LieAlgebra::trivial(), &places, 10.0, 1e-9).expect("regular");
    assert!(!report.is_flat());
    assert_eq!((report.torsion.place, report.places), (places[1], 3));
    // K⁻¹₁₁ = 1 + 1e-6 X₁X₂: Y¹₁₂ = ∂₂ ln K⁻¹₁₁ = 2e-6 at X₂ = 0, and 1/L = 0.1.
    assert_close(
        "Y",
        &[report.torsion.value, report.torsion.relative],
        &[2e-6, 2e-5],
        Tol::stated(1e-5, "two entries"),
    );
    // A larger tolerance accepts it: a circuit in the body closes to that times its size.
    assert!(Flatness::of_body(&Growing, LieAlgebra::trivial(), &places, 10.0, 1e-4).expect("regular").is_flat());
}
