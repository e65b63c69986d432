//! Where decompositions go wrong: small strain, coalescence, large ratios, half turns, the ends of the range.

use nalgebra::Matrix3;
use piola_continuum::spectral::{StretchAnalysis, decompose};
use piola_continuum::{DeformationGradient, Symmetric};
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

/// Entries of 1e±150 and beyond neither overflow nor vanish.
#[test]
fn scaled_tensors_have_scaled_eigenvalues() {
    let mut random = Random::new(12);
    // About 1e±300, 1e±150, 1e±101 and 1e±99.
    for exponent in [-996, -498, -335, -328, 328, 335, 498, 996] {
        for _ in 0..50 {
            let a = symmetric(random.matrix());
            let scale = 2.0_f64.powi(exponent);
            let (plain, scaled) = (decompose(&a), decompose(&(a * scale)));
            let expected = plain.values.map(|x| x * scale);
            assert_close("values", &scaled.values, &expected, Tol::ulps(8.0));
            assert!(orthogonality(scaled.vectors) <= 4.0 * ULP);
        }
    }
    let mut big = with_stretches(&random.rotation(), [1.5, 1.0, 0.5], &random.rotation());
    let rotation = analysis(big).rotation();
    big = big.map(|row| row.map(|x| x * 1e150));
    let deformation = DeformationGradient::new(Matrix3::from_fn(|i, j| big[i][j]));
    if let Ok(deformation) = deformation {
        let scaled = StretchAnalysis::of(&deformation).rotation();
        assert_close("R", &scaled.concat(), &rotation.concat(), Tol::ulps(16.0));
    }
}

#[test]
fn eigenvectors_of_zero_and_of_multiples_of_one_are_orthonormal() {
    for value in [0.0, 1.0, -3.0, 1e-300, 1e300] {
        let decomposition = decompose(&Symmetric::diagonal([value; 3]));
        assert_close("values", &decomposition.values, &[value; 3], Tol::ulps(2.0));
        assert!(orthogonality(decomposition.vectors) <= 4.0 * ULP);
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

/// A tensor whose deviator is made of small integers, which a mean added to its diagonal leaves exact.
fn tensor_of_integers(random: &mut Random) -> Symmetric {
    let mut tensor = symmetric(random.matrix());
    // Zeros of one sign: an axis of an even tensor may point either way.
    tensor.components = tensor.components.map(|x| (x * 8.0).round() + 0.0);
    tensor
}

#[test]
fn axes_under_a_large_mean_equal_those_of_the_deviator() {
    let mut random = Random::new(13);
    for mean in [1e3, 1e9, -1e9, 1e12, 4.0e15] {
        for _ in 0..1000 {
            let tensor = tensor_of_integers(&mut random);
            let large = tensor + Symmetric::identity() * mean;
            let (alone, under_mean) = (decompose(&tensor), decompose(&large));
            // All differences of the diagonal are the same numbers: so are the axes, to the last bit.
            assert_eq!(alone.vectors, under_mean.vectors, "{tensor:?} under {mean:e}");
            // The stated 4 ulp, and one for the rounding of what is expected.
            let expected = alone.values.map(|x| x + mean);
            assert_close("values", &under_mean.values, &expected, Tol::ulps(5.0));
        }
    }
    // Pressed by 10⁹, sheared by 1: the axes of shear are at 45°, the third one is left alone.
    let shear = decompose(&Symmetric::new(-1e9, -1e9, -1e9, 1.0, 0.0, 0.0));
    let half = core::f64::consts::FRAC_1_SQRT_2;
    let products = [shear.vectors[0][0] * shear.vectors[0][1], shear.vectors[2][0] * shear.vectors[2][1]];
    assert_close("axes of shear", &products, &[half * half, -half * half], Tol::ulps(4.0));
    assert_close("axis across", &[shear.vectors[1][2].abs()], &[1.0], Tol::ulps(2.0));
}

#[test]
fn axes_of_a_tensor_rounded_under_a_large_mean_turn_no_further_than_its_rounding_over_the_gap() {
    let mut random = Random::new(14);
    for mean in [1e6, 1e9, 1e12] {
        for _ in 0..500 {
            let tensor = symmetric(random.matrix());
            let (alone, under_mean) = (decompose(&tensor), decompose(&(tensor + Symmetric::identity() * mean)));
            let [a, b, c] = alone.values;
            for (k, gap) in [(0, a - b), (1, (a - b).min(b - c)), (2, b - c)] {
                // Rounding of the diagonal by half an ulp of the mean turns an axis by no more than that over the gap
                // (Davis and Kahan), and twice that where the gap is no longer large beside it.
                let turn = ULP * mean / gap;
                if turn < 0.1 {
                    let (v, w) = (alone.vectors[k], under_mean.vectors[k]);
                    let cosine = v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
                    let w = w.map(|x| x * cosine.signum());
                    assert!(distance(&v, &w) <= turn + 16.0 * ULP * (1.0 + size(&flat(&tensor)) / gap), "{tensor:?}");
                }
            }
        }
    }
}

/// ½ det B = −0 has the separated eigenvalue −√3, not √3: its axis is the last.
#[test]
fn axes_of_a_tensor_with_negative_zeros_belong_to_their_values() {
    for zero in [0.0, -0.0] {
        for tensor in [
            Symmetric::new(1.0, 0.0, -1.0, zero, zero, zero),
            Symmetric::new(zero, 0.0, zero, zero, zero, 2.0),
            Symmetric::new(3.0, zero, -3.0, 4.0, zero, zero) + Symmetric::diagonal([-4.0, 4.0, 0.0]),
            Symmetric::new(1.0, zero, -1.0, zero, zero, 2.0),
            Symmetric::new(-2.0, zero, 2.0, zero, 0.0, 3.0),
        ] {
            let decomposition = decompose(&tensor);
            for (value, axis) in decomposition.values.into_iter().zip(decomposition.vectors) {
                let image = tensor.apply(axis);
                assert_close_at_scale("A v = λ v", &image, &axis.map(|x| value * x), 4.0, Tol::ulps(8.0));
            }
        }
    }
}

#[cfg(feature = "serde")]
#[test]
fn decompositions_are_read_as_written() {
    use piola_continuum::spectral::SpectralDecomposition;
    let read = |text: &str| serde_json::from_str::<SpectralDecomposition>(text);
    let mut random = Random::new(77);
    for _ in 0..100 {
        let found = decompose(&symmetric(random.matrix()));
        let text = serde_json::to_string(&found).expect("text");
        assert_eq!(read(&text).expect("as written"), found, "{text}");
    }
    let written =
        |values: &str, first: &str| format!(r#"{{"values":{values},"vectors":[{first},[0.0,1.0,0.0],[0.0,0.0,1.0]]}}"#);
    assert!(read(&written("[3.0,2.0,2.0]", "[1.0,0.0,0.0]")).is_ok());
    assert!(read(&written("[2.0,3.0,2.0]", "[1.0,0.0,0.0]")).is_err()); // they do not descend
    assert!(read(&written("[3.0,2.0,null]", "[1.0,0.0,0.0]")).is_err());
    assert!(read(&written("[3.0,2.0,2.0]", "[2.0,0.0,0.0]")).is_err());
    assert!(read(&written("[3.0,2.0,2.0]", "[-1.0,0.0,0.0]")).is_err()); // left-handed
}

#[cfg(feature = "serde")]
#[test]
fn polar_parts_and_functions_are_read_as_written() {
    use piola_continuum::spectral::{Exponential, Logarithm, PolarHencky, Power, SquareRoot, polar_hencky};
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

    let text = serde_json::to_string(&(SquareRoot, Logarithm, Exponential, Power(1.5))).expect("text");
    let functions: (SquareRoot, Logarithm, Exponential, Power) = serde_json::from_str(&text).expect("as written");
    assert_eq!(functions, (SquareRoot, Logarithm, Exponential, Power(1.5)));
    assert!(serde_json::from_str::<Power>("1e999").is_err() && Power::try_from(f64::NAN).is_err());
}
