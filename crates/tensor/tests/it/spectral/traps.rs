//! Where decompositions go wrong: coalescence, large means, signed zeros, the ends of the range.

use piola_tensor::Symmetric;
use piola_tensor::spectral::decompose;
use piola_testkit::spectral::Random;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use super::cases::{distance, flat, orthogonality, size, symmetric};

const ULP: f64 = f64::EPSILON;

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
}

#[test]
fn eigenvectors_of_zero_and_of_multiples_of_one_are_orthonormal() {
    for value in [0.0, 1.0, -3.0, 1e-300, 1e300] {
        let decomposition = decompose(&Symmetric::diagonal([value; 3]));
        assert_close("values", &decomposition.values, &[value; 3], Tol::ulps(2.0));
        assert!(orthogonality(decomposition.vectors) <= 4.0 * ULP);
    }
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
    use piola_tensor::spectral::SpectralDecomposition;
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
fn functions_are_read_as_written() {
    use piola_tensor::spectral::{Exponential, Logarithm, Power, SquareRoot};
    let text = serde_json::to_string(&(SquareRoot, Logarithm, Exponential, Power(1.5))).expect("text");
    let functions: (SquareRoot, Logarithm, Exponential, Power) = serde_json::from_str(&text).expect("as written");
    assert_eq!(functions, (SquareRoot, Logarithm, Exponential, Power(1.5)));
    assert!(serde_json::from_str::<Power>("1e999").is_err() && Power::try_from(f64::NAN).is_err());
}
