//! Where decompositions go wrong: small strain, coalescence, large ratios, half turns, the ends of the range.

use piola_continuum::polar::StretchAnalysis;
use piola_continuum::{ContinuumError, DeformationGradient};
use piola_numerics::Real;
use piola_testkit::spectral::{
    Random, adversarial_set, polar_reference, polar_reference_of_displacement, with_stretches,
};
use piola_testkit::{DoubleDouble, Tol, assert_close, assert_close_at_scale};

use super::cases::{analysis, distance, flat, gradient, of_displacement, orthogonality, size, symmetric};

const ULP: f64 = f64::EPSILON;

/// The largest entry of R U − F over that of F, with the product in 31 digits.
fn backward_error(stretch: &StretchAnalysis, f: &[[f64; 3]; 3]) -> f64 {
    let (r, u) = (stretch.rotation(), stretch.right_stretch().rows());
    let entry = |i: usize, j: usize| {
        let mut sum = DoubleDouble::lit(-f[i][j]);
        for k in 0..3 {
            sum += DoubleDouble::lit(r[i][k]) * DoubleDouble::lit(u[k][j]);
        }
        sum.primal(0)
    };
    let defect: Vec<f64> = (0..9).map(|place| entry(place / 3, place % 3)).collect();
    size(&defect) / size(&f.concat())
}

#[test]
fn rotation_times_stretch_equals_gradient_within_8_ulp_over_the_adversarial_set() {
    for case in adversarial_set() {
        let stretch = analysis(case.gradient);
        let error = backward_error(&stretch, &case.gradient);
        assert!(error <= 8.0 * ULP, "{}: backward error {:.1} ulp", case.kind, error / ULP);
        let error = orthogonality(stretch.rotation());
        assert!(error <= 8.0 * ULP, "{}: orthogonality {:.1} ulp", case.kind, error / ULP);
    }
}

#[test]
fn rotation_and_logarithm_are_as_accurate_as_their_conditioning_over_the_adversarial_set() {
    for case in adversarial_set() {
        let stretch = analysis(case.gradient);
        let reference = polar_reference(case.gradient);
        let [a, b, c] = reference.stretches;
        let error = distance(&stretch.rotation().concat(), &reference.rotation.concat());
        assert!(error <= 8.0 * ULP * (a / (b + c)).max(1.0), "{}: R is off by {error:e}", case.kind);
        for (actual, expected) in [
            (stretch.hencky_material(), reference.hencky_material),
            (stretch.hencky_spatial(), reference.hencky_spatial),
        ] {
            let error = distance(&flat(&actual), &expected.concat());
            let scale = size(&expected.concat()).max(1.0);
            assert!(error <= 8.0 * ULP * (a / c) * scale, "{}: a logarithm is off by {error:e}", case.kind);
        }
        let expected = reference.right_stretch.concat();
        assert_close(case.kind, &flat(&stretch.right_stretch()), &expected, Tol::ulps(8.0));
        assert_close(case.kind, &flat(&stretch.left_stretch()), &reference.left_stretch.concat(), Tol::ulps(8.0));
    }
}

#[test]
fn logarithm_of_displacement_is_within_1e_15_of_its_own_norm() {
    let tol = Tol::stated(1e-15, "ln U from the displacement gradient");
    let mut random = Random::new(6);
    for exponent in 6..=14 {
        for _ in 0..200 {
            let h = random.matrix().map(|row| row.map(|x| x * 10.0_f64.powi(-exponent)));
            let reference = polar_reference_of_displacement(h);
            let stretch = of_displacement(h);
            assert_close("ln U", &flat(&stretch.hencky_material()), &reference.hencky_material.concat(), tol);
            assert_close("ln V", &flat(&stretch.hencky_spatial()), &reference.hencky_spatial.concat(), tol);
            let biot = reference.right_stretch_less_one.concat();
            assert_close("U − 1", &flat(&stretch.right_stretch_less_one()), &biot, tol);
        }
    }
}

/// Down to 1e-300 second-order terms are below rounding: ln U is the symmetric part of ∇u.
#[test]
fn logarithm_of_tiny_displacement_equals_linear_strain() {
    let mut random = Random::new(7);
    for exponent in [20, 60, 99, 100, 101, 120, 150, 160, 200, 250, 300] {
        for _ in 0..50 {
            let h = random.matrix().map(|row| row.map(|x| x * 10.0_f64.powi(-exponent)));
            let linear = flat(&symmetric(h));
            assert_close("ln U", &flat(&of_displacement(h).hencky_material()), &linear, Tol::ulps(2.0));
            assert_close("V − 1", &flat(&of_displacement(h).left_stretch_less_one()), &linear, Tol::ulps(2.0));
        }
    }
}

#[test]
fn rotations_have_no_logarithm_beyond_4e_16() {
    let mut random = Random::new(8);
    for _ in 0..10_000 {
        let r = random.rotation();
        let reference = polar_reference(r);
        let stretch = analysis(r);
        let tol = Tol::stated(4e-16, "absolute, for rounded rotations");
        let logarithm = flat(&stretch.hencky_material());
        assert_close_at_scale("ln U", &logarithm, &reference.hencky_material.concat(), 1.0, tol);
        assert_close_at_scale("R", &stretch.rotation().concat(), &reference.rotation.concat(), 1.0, tol);
        assert_close_at_scale("U", &flat(&stretch.right_stretch()), &reference.right_stretch.concat(), 1.0, tol);
    }
}

fn check_random_stretch(random: &mut Random, stretches: [f64; 3]) {
    let (p, q) = (random.rotation(), random.rotation());
    let f = with_stretches(&p, stretches, &q);
    let stretch = analysis(f);
    assert!(backward_error(&stretch, &f) <= 8.0 * ULP && orthogonality(stretch.rotation()) <= 8.0 * ULP);
    // exp and ln of the measured stretch agree, and its eigenvalues are those of the construction.
    let expected = {
        let mut sorted = stretches;
        sorted.sort_by(|a, b| b.total_cmp(a));
        sorted
    };
    let largest = expected[0];
    assert_close_at_scale("λ", &stretch.principal_stretches(), &expected, largest, Tol::ulps(16.0));
    let logs = expected.map(f64::ln);
    assert_close_at_scale("ln λ", &stretch.log_principal_stretches(), &logs, 1.0, Tol::ulps(32.0));
}

#[test]
fn near_isotropic_stretches_in_random_frames_are_decomposed_without_one_error() {
    let mut random = Random::new(9);
    for _ in 0..20_000 {
        let base = random.symmetric().exp();
        let gap = 10.0_f64.powf(-9.0 + 7.0 * random.symmetric());
        let stretches = core::array::from_fn(|_| base * (1.0 + gap * random.symmetric()));
        check_random_stretch(&mut random, stretches);
    }
}

#[test]
fn near_uniaxial_stretches_in_random_frames_are_decomposed_without_one_error() {
    let mut random = Random::new(10);
    for _ in 0..20_000 {
        let (base, other) = (random.symmetric().exp(), random.symmetric().exp());
        let gap = 10.0_f64.powf(-9.0 + 7.0 * random.symmetric());
        check_random_stretch(&mut random, [base, base * (1.0 + gap), other]);
    }
}

#[test]
fn stretch_gaps_of_1e_10_leave_all_digits() {
    let mut random = Random::new(11);
    for gap in [1e-6, 1e-8, 1e-10, 1e-13, 1e-15, 0.0] {
        for _ in 0..200 {
            let (p, q) = (random.rotation(), random.rotation());
            let f = with_stretches(&p, [1.5 * (1.0 + gap), 1.5, 0.7], &q);
            let reference = polar_reference(f);
            let hencky = flat(&analysis(f).hencky_material());
            assert_close("ln U", &hencky, &reference.hencky_material.concat(), Tol::ulps(16.0));
        }
    }
}

#[test]
fn the_slow_path_is_taken_at_large_stretch_ratios_only() {
    for case in adversarial_set() {
        let slow = analysis(case.gradient).slow_path();
        assert!(!slow || 1e3 < case.condition, "{} at {:e}", case.kind, case.condition);
    }
    let identity = gradient([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert!(!StretchAnalysis::of(&identity).slow_path());
}

#[test]
fn gradients_of_size_1e100_have_their_rotation_and_those_without_a_determinant_are_refused() {
    let mut random = Random::new(12);
    let ordinary = with_stretches(&random.rotation(), [1.5, 1.0, 0.5], &random.rotation());
    let rotation = analysis(ordinary).rotation();
    let scaled = |size: f64| DeformationGradient::from_rows(ordinary.map(|row| row.map(|x| x * size)));
    for size in [1e100, 1e-100] {
        let analysis = StretchAnalysis::of(&scaled(size).expect("det F = 1e±300"));
        assert_close("R", &analysis.rotation().concat(), &rotation.concat(), Tol::ulps(16.0));
        let [longest, ..] = analysis.principal_stretches();
        assert_close("λ₁", &[longest], &[1.5 * size], Tol::ulps(16.0));
    }
    // det F = 1e±450.
    assert!(matches!(scaled(1e150), Err(ContinuumError::NotFinite { quantity: "det F", .. })));
    assert!(scaled(1e-150).is_err());
}

#[cfg(feature = "serde")]
#[test]
fn polar_parts_are_read_as_written() {
    use piola_continuum::polar::{PolarHencky, polar_hencky};
    let read = |text: &str| serde_json::from_str::<PolarHencky>(text);
    let mut random = Random::new(78);
    for _ in 0..100 {
        let f = with_stretches(&random.rotation(), [1.5, 1.25, 0.75], &random.rotation());
        let polar = polar_hencky(&DeformationGradient::from_rows(f).expect("a deformation"));
        let text = serde_json::to_string(&polar).expect("text");
        assert_eq!(read(&text).expect("as written"), polar, "{text}");
    }
    let written = |first: &str, stretch: &str, logarithm: &str| {
        let rotation = format!("[{first},[0.0,1.0,0.0],[0.0,0.0,1.0]]");
        format!(
            r#"{{"rotation":{rotation},"right_stretch":[{stretch},1.0,1.0,0.0,0.0,0.0],"hencky":[{logarithm},0,0,0,0,0]}}"#
        )
    };
    assert!(read(&written("[1.0,0.0,0.0]", "2.0", "0.5")).is_ok());
    assert!(read(&written("[-1.0,0.0,0.0]", "2.0", "0.5")).is_err()); // left-handed
    assert!(read(&written("[1.0,0.0,0.0]", "-2.0", "0.5")).is_err()); // no stretch
    assert!(read(&written("[1.0,0.0,0.0]", "2.0", "null")).is_err());
}
