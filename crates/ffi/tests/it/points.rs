//! Stresses and tangents equal those of the library's own types.

use nalgebra::Matrix3;
use piola::continuum::DeformationGradient;
use piola::numerics::linear::matrix3::{from_rows, rows_of};
use piola::solids::isochoric::{Gent, MooneyRivlin as IsochoricMooneyRivlin};
use piola::solids::volumetric::SimoTaylor;
use piola::solids::{
    AnisotropicLinear, AnisotropicSaintVenantKirchhoff, AnySolid, BlatzKo, Compressible, Fung, Hyperelastic,
    MooneyRivlin, Polynomial, PolynomialTerm, SaintVenantKirchhoff, SolidsError, Stiffness,
};
use piola::tensor::voigt::{Abaqus, Classical, Piola, StiffnessMatrix};
use piola_ffi::FfiError;
use piola_ffi::points::{StressMeasure, TangentMeasure, VoigtNumbering, energy, stress, stress_and_tangent, tangent};
use piola_testkit::{Tol, assert_each_close_at_scales, strategies};
use proptest::prelude::*;

/// Laws of several kinds.
pub(crate) fn laws() -> Vec<AnySolid> {
    let volume = SimoTaylor::new(20.0).unwrap();
    vec![
        MooneyRivlin::stress_free(0.5, 0.25, 1.0).unwrap().into(),
        SaintVenantKirchhoff::new(1.0, 2.0).unwrap().into(),
        BlatzKo::new(1.0, 0.25, 0.5).unwrap().into(),
        Compressible::new(Gent::new(1.0, 500.0).unwrap(), volume).into(),
        Compressible::new(IsochoricMooneyRivlin::new(0.5, 0.25).unwrap(), volume).into(),
    ]
}

/// F = R U with stretches between 0.6 and 1.6.
pub(crate) fn deformation() -> impl Strategy<Value = Matrix3<f64>> {
    (strategies::rotation(), strategies::positive_definite(0.6..1.6)).prop_map(|(quaternion, stretch)| {
        from_rows(strategies::rotation_matrix(quaternion)) * from_rows::<f64>(stretch)
    })
}

fn numbers(f: &Matrix3<f64>) -> [f64; 9] {
    let [[a, b, c], [d, e, f], [g, h, i]] = rows_of(f);
    [a, b, c, d, e, f, g, h, i]
}

fn flat(matrix: &[[f64; 6]; 6]) -> [f64; 36] {
    *matrix.as_flattened().first_chunk().unwrap()
}

/// Scales of the entries of a tensor: the largest of them.
fn scale(numbers: &[f64]) -> f64 {
    numbers.iter().fold(f64::MIN_POSITIVE, |largest, x| largest.max(x.abs()))
}

fn close(found: &[f64], expected: &[f64], factor: f64) {
    let scales = vec![scale(expected) * factor; expected.len()];
    let tol = Tol::ulps_because(128.0, "P and dP/dF in lanes, then two to six products with F or its inverse");
    assert_each_close_at_scales("numbers", found, expected, &scales, tol);
}

proptest! {
    #[test]
    fn stresses_and_tangents_equal_those_of_the_law(f in deformation()) {
        let deformation = DeformationGradient::new(f).unwrap();
        let inverse = deformation.inverse().unwrap();
        let stretch = scale(&numbers(&f)) * scale(&numbers(inverse.matrix()));
        let condition = stretch.powi(4).max(1.0);
        for law in laws() {
            let f = [numbers(&f)];
            let mut found = [[0.0; 9]];
            stress(&law, StressMeasure::Cauchy, &f, &mut found).unwrap();
            let expected = numbers(&law.cauchy(&deformation).0.matrix());
            close(&found[0], &expected, condition);
            stress(&law, StressMeasure::FirstPiola, &f, &mut found).unwrap();
            close(&found[0], &numbers(&law.first_piola(&deformation).0), condition);
            stress(&law, StressMeasure::SecondPiola, &f, &mut found).unwrap();
            close(&found[0], &numbers(&law.second_piola(&deformation).0.matrix()), condition);

            let mut square = [0.0; 81];
            tangent(&law, TangentMeasure::FirstPiola, VoigtNumbering::Piola, &f, &mut square).unwrap();
            close(&square, law.first_piola_tangent(&deformation).0.components.as_flattened(), condition);
            let mut six = [0.0; 36];
            let (cauchy, truesdell) = law.cauchy_and_tangent(&deformation);
            let material = law.material_tangent(&deformation);
            tangent(&law, TangentMeasure::Material, VoigtNumbering::Classical, &f, &mut six).unwrap();
            close(&six, &flat(&StiffnessMatrix::<f64, Classical>::of(&material.0).entries), condition);
            tangent(&law, TangentMeasure::Truesdell, VoigtNumbering::Piola, &f, &mut six).unwrap();
            close(&six, &flat(&StiffnessMatrix::<f64, Piola>::of(&truesdell.0).entries), condition);
            tangent(&law, TangentMeasure::Jaumann, VoigtNumbering::Abaqus, &f, &mut six).unwrap();
            let jaumann = truesdell.jaumann(&cauchy);
            close(&six, &flat(&StiffnessMatrix::<f64, Abaqus>::of(&jaumann.0).entries), condition);
        }
    }
}

/// W of the library, bad points NaN and named, lengths refused.
#[test]
fn energies_equal_those_of_the_laws() {
    let mut f = [[1.1, 0.2, 0.0, -0.1, 0.9, 0.3, 0.05, 0.1, 1.02]; 3];
    f[1] = [0.0; 9];
    for law in laws() {
        let mut found = [0.0; 3];
        let result = energy(&law, &f, &mut found);
        assert!(matches!(result, Err(FfiError::BadPoints { bad: 1, count: 3, index: 1, .. })), "{result:?}");
        let deformation = DeformationGradient::<f64>::from_rows([[1.1, 0.2, 0.0], [-0.1, 0.9, 0.3], [0.05, 0.1, 1.02]]);
        let expected = law.energy(&deformation.unwrap());
        assert_eq!((found[0], found[2]), (expected, expected));
        assert!(found[1].is_nan() && 0.0 < expected);
        assert!(matches!(energy(&law, &f, &mut found[1..]), Err(FfiError::WrongLength { quantity: "energies", .. })));
    }
}

/// A law of each variant of the enum.
fn every_law() -> Vec<AnySolid> {
    let stiffness = Stiffness::isotropic(1.0, 2.0).unwrap();
    let fung = Fung::new(1.0, stiffness).unwrap();
    let mut laws = laws();
    laws.push(fung.into());
    laws.push(AnisotropicLinear::new(stiffness).into());
    laws.push(AnisotropicSaintVenantKirchhoff::new(stiffness).into());
    for (name, values) in [
        ("neo_hookean-lame", vec![2.0, 1.0]),
        ("hencky-quadratic", vec![2.0, 1.0]),
        ("linear_elastic", vec![2.0, 1.0]),
        ("ogden-lame", vec![0.5, 2.0, 1.0]),
        ("isochoric_ogden-quadratic", vec![0.5, 2.0, 1.0]),
        ("incompressible_ogden", vec![0.5, 2.0]),
        ("incompressible-yeoh", vec![0.5, 0.1, 0.01]),
        ("compressible-arruda_boyce-liu", vec![1.0, 8.0, 20.0]),
        ("compressible-arruda_boyce_series-miehe", vec![1.0, 8.0, 20.0]),
        ("compressible-neo_hookean-hartmann_neff", vec![1.0, 20.0]),
        ("holzapfel_gasser_ogden", vec![1.0, 20.0, 2.0, 0.8, 0.1, 0.6, 0.8, 0.0, 0.6, -0.8, 0.0]),
        ("reinforced_neo_hookean", vec![1.0, 2.0, 3.0, 0.6, 0.8, 0.0]),
    ] {
        laws.push(piola_ffi::named::solid(name, &values).unwrap());
    }
    let term = |[first, second, third]: [u8; 3], coefficient| PolynomialTerm { first, second, third, coefficient };
    let terms = vec![term([1, 0, 0], 0.5), term([0, 1, 0], 0.25), term([0, 0, 1], -1.0), term([0, 0, 2], 5.0)];
    laws.push(Polynomial::new(terms).unwrap().into());
    laws
}

#[test]
fn every_law_of_the_enum_is_offered() {
    let deformation = DeformationGradient::simple_shear(0.25).unwrap(); // keeps the volume
    let f = [numbers(deformation.matrix())];
    for law in every_law() {
        let (mut found, mut square) = ([[0.0; 9]], [0.0; 81]);
        let out = (&mut found[..], &mut square[..]);
        let measures = (StressMeasure::Cauchy, TangentMeasure::FirstPiola);
        stress_and_tangent(&law, measures, VoigtNumbering::Piola, &f, out).unwrap();
        close(&found[0], &numbers(&law.cauchy(&deformation).0.matrix()), 4.0);
        close(&square, law.first_piola_tangent(&deformation).0.components.as_flattened(), 4.0);
        let mut six = [0.0; 36];
        tangent(&law, TangentMeasure::Truesdell, VoigtNumbering::Piola, &f, &mut six).unwrap();
        let expected = StiffnessMatrix::<f64, Piola>::of(&law.truesdell_tangent(&deformation).0).entries;
        close(&six, &flat(&expected), 8.0);
        stress(&law, StressMeasure::SecondPiola, &f, &mut found).unwrap();
        close(&found[0], &numbers(&law.second_piola(&deformation).0.matrix()), 4.0);
    }
}

/// Stresses of strains of 1e-9, compared on the scale of their own size. In the frame of the reference they have all their digits. A
/// turned F loses the digits of its strain by the rounding of F itself, 1e-16/1e-9 of the stress.
#[test]
fn stresses_at_small_strain_keep_their_digits() {
    let turned = strategies::rotation_matrix([0.5, 0.5, -0.5, 0.5]);
    let mut compared = 0;
    for (turn, limit) in [([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], 1.0), (turned, 4e6)] {
        let small = Matrix3::new(1.0 + 2e-9, 1e-9, 0.0, -3e-9, 1.0 - 1e-9, 5e-10, 0.0, 1e-9, 1.0 - 1e-9);
        let f = from_rows::<f64>(turn) * small;
        let deformation = DeformationGradient::new(f).unwrap();
        for law in every_law() {
            if law.is_incompressible() || law.reference_stress().components.iter().any(|x| 0.0 < x.abs()) {
                continue; // a pressure, or a stress of the reference
            }
            let mut found = [[0.0; 9]];
            stress(&law, StressMeasure::FirstPiola, &[numbers(&f)], &mut found).unwrap();
            let expected = numbers(&law.first_piola(&deformation).0);
            if scale(&expected) < 1e-6 {
                close(&found[0], &expected, limit);
                compared += 1;
            }
        }
    }
    // Of linear elasticity a rotation is a strain, so that the stress is not small.
    assert_eq!(compared, 19 + 17);
}

/// A number that overflows is no answer, whichever component it is. The other points are written.
#[test]
fn points_whose_numbers_overflow_are_refused() {
    let law: AnySolid = SaintVenantKirchhoff::new(1.0, 2.0).unwrap().into();
    let mut f = [[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]; 11];
    f[9][1] = 1e110; // S₂₂ is 2.5e220, P₁₁ as large, P₁₂ = F₁₂ S₂₂ too large
    let is_refused = |result: &Result<(), FfiError>, expected: &str| {
        let Err(FfiError::BadPoints { bad: 1, index: 9, error: SolidsError::Overflow { answer }, .. }) = result else {
            return false;
        };
        *answer == expected
    };
    for (_, measure) in StressMeasure::ALL {
        let mut found = [[0.0; 9]; 11];
        let result = stress(&law, measure, &f, &mut found);
        assert!(is_refused(&result, "stress"), "{result:?}");
        assert!((0..11).all(|k| found[k].iter().all(|x| if k == 9 { x.is_nan() } else { x.abs() <= 0.0 })));
    }
    for (_, measure) in TangentMeasure::ALL {
        let n = measure.numbers();
        let mut found = vec![0.0; 11 * n];
        let result = tangent(&law, measure, VoigtNumbering::Piola, &f, &mut found);
        if measure == TangentMeasure::FirstPiola {
            result.unwrap(); // at most F₁₂² (λ + 2 μ)
            assert!(found.iter().all(|x| x.is_finite()));
        } else {
            assert!(is_refused(&result, "tangent"), "{result:?}");
            assert!(found.chunks(n).enumerate().all(|(k, point)| point.iter().all(|x| x.is_nan() == (k == 9))));
        }
    }
}

/// A large batch, which several threads share with feature `rayon`: bad points are counted and named, all others have their bits.
#[test]
fn parts_of_a_large_batch_have_the_bits_of_a_small_one() {
    let count = 20_011;
    let mut f: Vec<[f64; 9]> = (0..count)
        .map(|k| {
            let x = f64::from(k % 300) / 300.0;
            [1.0 + x, 0.2, -0.1, 0.3 * x, 1.0 - 0.3 * x, 0.1, 0.0, -0.2 * x, 1.1]
        })
        .collect();
    let (law, count) = (&laws()[3], f.len());
    (f[9_000], f[count - 1]) = ([0.0; 9], [f64::NAN; 9]);
    let (mut stresses, mut tangents) = (vec![[0.0; 9]; count], vec![0.0; 36 * count]);
    let measures = (StressMeasure::Cauchy, TangentMeasure::Jaumann);
    let out = (&mut stresses[..], &mut tangents[..]);
    let result = stress_and_tangent(law, measures, VoigtNumbering::Abaqus, &f, out);
    assert!(matches!(result, Err(FfiError::BadPoints { bad: 2, index: 9_000, .. })), "{result:?}");
    for bad in [9_000, count - 1] {
        assert!(stresses[bad].iter().chain(&tangents[36 * bad..36 * bad + 36]).all(|x| x.is_nan()));
    }
    let (mut few, mut six) = ([[0.0; 9]; 13], [0.0; 13 * 36]);
    for start in [0, 8_995 - 13, 9_001, 10_000, count - 14] {
        let out = (&mut few[..], &mut six[..]);
        stress_and_tangent(law, measures, VoigtNumbering::Abaqus, &f[start..start + 13], out).unwrap();
        assert_eq!((&few[..], &six[..]), (&stresses[start..start + 13], &tangents[36 * start..36 * (start + 13)]));
    }
}

#[test]
fn a_point_has_the_same_bits_anywhere_and_together_with_its_tangent() {
    let f: Vec<[f64; 9]> = (0..300)
        .map(|k| {
            let x = f64::from(k) / 300.0;
            [1.0 + x, 0.2, -0.1, 0.3 * x, 1.0 - 0.3 * x, 0.1, 0.0, -0.2 * x, 1.1]
        })
        .collect();
    for law in every_law().into_iter().filter(|law| !law.is_incompressible()) {
        let mut all = vec![[0.0; 9]; 300];
        stress(&law, StressMeasure::Cauchy, &f, &mut all).unwrap();
        let (mut together, mut tangents) = (vec![[0.0; 9]; 300], vec![0.0; 300 * 36]);
        let measures = (StressMeasure::Cauchy, TangentMeasure::Jaumann);
        let out = (&mut together[..], &mut tangents[..]);
        stress_and_tangent(&law, measures, VoigtNumbering::Abaqus, &f, out).unwrap();
        let mut alone = vec![0.0; 300 * 36];
        tangent(&law, TangentMeasure::Jaumann, VoigtNumbering::Abaqus, &f, &mut alone).unwrap();
        assert_eq!(tangents, alone);
        for k in [0, 127, 128, 299] {
            let (mut one, mut six) = ([[0.0; 9]], [0.0; 36]);
            let out = (&mut one[..], &mut six[..]);
            stress_and_tangent(&law, measures, VoigtNumbering::Abaqus, &f[k..=k], out).unwrap();
            assert_eq!((one[0], &six[..]), (together[k], &tangents[36 * k..36 * k + 36]));
            stress(&law, StressMeasure::Cauchy, &f[k..=k], &mut one).unwrap();
            assert_eq!(one[0], all[k]);
        }
        // P of both requests may differ in its last bits: one of them shares terms with the tangent.
        close(together.as_flattened(), all.as_flattened(), 8.0);
    }
}

#[test]
fn laws_without_elementary_functions_give_the_bits_of_a_single_point() {
    let law: AnySolid = SaintVenantKirchhoff::new(1.0, 2.0).unwrap().into();
    for k in 1..50 {
        let x = f64::from(k) / 40.0;
        let f = Matrix3::new(1.0 + x, 0.2, -0.1, 0.3 * x, 1.0, 0.1, 0.0, -0.2 * x, 1.1);
        let deformation = DeformationGradient::new(f).unwrap();
        let mut found = [[0.0; 9]];
        stress(&law, StressMeasure::Cauchy, &[numbers(&f)], &mut found).unwrap();
        let p = law.first_piola(&deformation);
        assert_eq!(found[0], numbers(&p.kirchhoff(&deformation).cauchy(&deformation).0.matrix()));
    }
}
