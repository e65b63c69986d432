//! Circuits over kinks and jumps of the stress: refuted is what has no energy, and left open what the quadrature cannot tell.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::DeformationGradient;
use piola_solids::{Fibre, HolzapfelGasserOgden, Hyperelastic};
use piola_specimens::checks::{Circuit, Elastic, Search, Stored, Verdict, hyperelasticity, potential};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

/// Two families of fibres that answer in tension only.
fn wall() -> HolzapfelGasserOgden {
    let fibres = [Fibre::in_plane(0.6).expect("fibre"), Fibre::in_plane(-0.6).expect("fibre")];
    HolzapfelGasserOgden::new(1.0, 50.0, 2.0, 1.0, 0.1, fibres).expect("parameters")
}

/// T = share · I₁ ⟨λ² − 1⟩ Fa ⊗ Fa of fibres a that answer in tension only: P = J T F⁻ᵀ ∥ Fa ⊗ a has no energy, as it depends
/// on more than Fa.
fn taut(share: f64, f: &Matrix3<f64>) -> Matrix3<f64> {
    let fibre = f * Vector3::new(0.48, 0.6, 0.64);
    fibre * fibre.transpose() * (share * f.norm_squared() * (fibre.norm_squared() - 1.0).max(0.0))
}

/// ∮ P : dF by the middles of equal parts, whose error is of second order at a kink too.
fn work_by_middles(law: &impl Elastic, circuit: &Circuit) -> f64 {
    const PARTS: u32 = 4096;
    let corners = &circuit.corners;
    let mut work = 0.0;
    for (k, from) in corners.iter().enumerate() {
        let step = corners[(k + 1) % corners.len()] - from;
        for part in 0..PARTS {
            let f = from + step * ((f64::from(part) + 0.5) / f64::from(PARTS));
            let inverse = f.try_inverse().expect("F⁻¹");
            let stress = law.cauchy(&f) * inverse.transpose() * f.determinant();
            work += stress.dot(&step) / f64::from(PARTS);
        }
    }
    work
}

#[test]
fn fibres_that_slacken_keep_their_energy() {
    for strain in [0.1, 0.5] {
        let report = hyperelasticity(&Stored(&wall()), &Search { strain, samples: 200, ..Search::default() });
        assert!(report.passes() && report.samples == 200 && report.unresolved == 0, "{strain}: {report:?}");
        let worst = report.worst.expect("a circuit");
        assert!(worst.quadrature <= report.tolerance * worst.scale, "{worst:?}");
    }
    let report = hyperelasticity(&Stored(&wall()), &Search::default());
    assert_eq!(report.verdict(), Verdict::Passed, "{report:?}");
}

#[test]
fn potential_across_the_kink_equals_the_energy() {
    // From the reference the fibres are pressed; then one family is pulled.
    for (stretches, turn) in [([1.1, 0.95, 0.9], 0.3), ([0.9, 1.2, 1.0], 1.2), ([1.05, 1.05, 0.8], 2.0)] {
        let turn = Matrix3::from(nalgebra::Rotation3::new(Vector3::new(0.2, -0.3, 1.0) * turn));
        let stretch = turn * Matrix3::from_diagonal(&Vector3::from(stretches)) * turn.transpose();
        let f = DeformationGradient::new(turn * stretch).expect("0 < det F");
        let found = potential(&Stored(&wall()), &f);
        // Of W itself, and no further off than is stated.
        let expected = wall().energy(&f);
        let tolerance = Tol::stated(1e-12, "quadrature to 1e-13 of the work without signs, which is some W");
        assert_close("W", &[found.energy], &[expected], tolerance);
        let off = (found.energy - expected).abs();
        assert!(off <= found.error + Tol::ulps(16.0).value() * expected, "{off:e} of {found:?}");
        assert_close_at_scale("stated error", &[found.error], &[0.0], expected, tolerance.times(10.0));
    }
}

#[test]
fn law_with_a_kink_and_no_energy_is_refuted_by_its_worst_circuit() {
    let search = Search { samples: 100, ..Search::default() };
    let law = |f: &Matrix3<f64>| taut(1.0, f);
    let report = hyperelasticity(&law, &search);
    assert_eq!(report.verdict(), Verdict::Refuted);
    assert!(0.01 < report.size && report.unresolved == 0, "{}", report.size);
    let worst = report.worst.expect("a circuit");
    let middles = Tol::order(1.0 / 4096.0, 2).times(16.0);
    assert_close_at_scale("∮ P : dF", &[worst.work], &[work_by_middles(&law, &worst)], worst.scale, middles);
    // The size is that of this circuit, and no part of the search has a larger one.
    let own = (worst.work.abs() - worst.quadrature) / worst.scale;
    assert_close_at_scale("size", &[own], &[report.size], 1.0, Tol::ulps(4.0));
    for samples in [10, 30, 60] {
        assert!(hyperelasticity(&law, &Search { samples, ..search }).size <= report.size);
    }
}

#[test]
fn work_far_below_the_kinks_share_is_told_from_quadrature() {
    let search = Search { samples: 100, ..Search::default() };
    for (share, verdict) in [(1e-4, Verdict::Refuted), (1e-6, Verdict::Refuted), (1e-14, Verdict::Passed)] {
        let law = |f: &Matrix3<f64>| Stored(&wall()).cauchy(f) + taut(share, f);
        let report = hyperelasticity(&law, &search);
        assert_eq!(report.verdict(), verdict, "{share}: {report:?}");
        assert!(report.size <= share.max(report.tolerance), "{share}: {report:?}");
    }
}

/// P = φ(|F|) F is the derivative of ∫ φ(r) r dr, whatever φ.
fn of_size(phi: impl Fn(f64) -> f64) -> impl Elastic {
    move |f: &Matrix3<f64>| f * f.transpose() * (phi(f.norm()) / f.determinant())
}

#[test]
fn jumps_of_the_stress_are_found() {
    let jumps = of_size(|size| if size < 1.8 { 1.0 } else { 2.0 });
    let report = hyperelasticity(&jumps, &Search { samples: 60, ..Search::default() });
    assert!(report.passes() && report.samples == 60, "{report:?}");
}

#[test]
fn what_the_quadrature_cannot_tell_is_unresolved() {
    // 10⁶ jumps in each side.
    let rough = of_size(|size| if (1e7 * size).sin() < 0.0 { 1.0 } else { 2.0 });
    let report = hyperelasticity(&rough, &Search { samples: 4, ..Search::default() });
    assert_eq!(report.verdict(), Verdict::Unresolved, "{report:?}");
    assert!(!report.passes() && report.unresolved == 4 && report.size <= report.tolerance, "{report:?}");
    let worst = report.worst.expect("a circuit");
    assert!(worst.work.abs() <= worst.quadrature && 1e-10 * worst.scale < worst.quadrature, "{worst:?}");
    // An exactness beyond rounding cannot be had.
    let report = hyperelasticity(&Stored(&wall()), &Search { samples: 4, tolerance: 0.0, ..Search::default() });
    assert_eq!(report.verdict(), Verdict::Unresolved, "{report:?}");
}

#[test]
fn the_circuit_that_stays_open_does_not_depend_on_the_unit_of_stress() {
    let open = |unit: f64| {
        // Powers of two leave all digits as they are.
        let rough = of_size(move |size| if (1e7 * size).sin() < 0.0 { unit } else { 2.0 * unit });
        let report = hyperelasticity(&rough, &Search { samples: 4, ..Search::default() });
        assert_eq!(report.verdict(), Verdict::Unresolved, "{report:?}");
        report.worst.expect("a circuit")
    };
    let expected = open(1.0);
    for power in [-20, 20] {
        let unit = 2.0_f64.powi(power);
        let found = open(unit);
        assert_eq!(found.corners, expected.corners, "in units of 2^{power}");
        assert_close("quadrature", &[found.quadrature], &[unit * expected.quadrature], Tol::ulps(4.0));
    }
}
