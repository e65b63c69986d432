//! What UMAT and VUMAT return equals the library's Jaumann tangent and its polar decomposition.

use nalgebra::Matrix3;
use piola::continuum::DeformationGradient;
use piola::continuum::polar::StretchAnalysis;
use piola::numerics::linear::matrix3::from_rows;
use piola::solids::{AnySolid, Hyperelastic};
use piola::tensor::voigt::{Abaqus, StiffnessMatrix, StressVector};
use piola_ffi::FfiError;
use piola_ffi::abaqus::{PointIncrement, Stretching, umat, vumat};
use piola_ffi::materials::{MaterialLaw, material};
use piola_testkit::{Tol, assert_each_close_at_scales};
use proptest::prelude::*;

fn by_columns(f: &Matrix3<f64>) -> [f64; 9] {
    *f.as_slice().first_chunk().unwrap()
}

fn close(found: &[f64], expected: &[f64], condition: f64) {
    let scale = expected.iter().fold(f64::MIN_POSITIVE, |largest, x| largest.max(x.abs()));
    let tol = Tol::ulps_because(256.0, "P and dP/dF in lanes, then products with F, its inverse or R");
    assert_each_close_at_scales("numbers", found, expected, &vec![scale * condition; expected.len()], tol);
}

/// UMAT of an elastic law, without a state.
pub(crate) fn umat_of(
    law: &AnySolid,
    components: [usize; 2],
    f: &[f64; 9],
    stress: &mut [f64],
    tangent: &mut [f64],
) -> Result<(), FfiError> {
    let increment = PointIncrement { f: [f, f], dt: 1.0, temperature: 0.0 };
    umat(&law.clone().into(), components, increment, &mut [], stress, tangent)
}

/// VUMAT of a law without a state, in solid elements.
fn vumat_of(law: &MaterialLaw, after: &[f64], added: f64, stresses: &mut [f64]) -> Result<(), FfiError> {
    let stretching = Stretching { before: &[], after, added, dt: 1.0, temperatures: &[] };
    vumat(law, [3, 3], stretching, (&[], &mut []), stresses)
}

proptest! {
    #[test]
    fn umat_gives_cauchys_stress_and_jaumanns_tangent_in_the_order_of_abaqus(f in crate::points::deformation()) {
        let deformation = DeformationGradient::new(f).unwrap();
        let stretches = StretchAnalysis::of(&deformation).principal_stretches();
        let condition = (stretches[0] / stretches[2]).powi(4);
        for law in crate::points::laws() {
            let (mut stress, mut tangent) = ([0.0; 6], [0.0; 36]);
            umat_of(&law, [3, 3], &by_columns(&f), &mut stress, &mut tangent).unwrap();
            let (cauchy, truesdell) = law.cauchy_and_tangent(&deformation);
            close(&stress, &StressVector::<f64, Abaqus>::of(&cauchy.0).components, condition);
            let expected = StiffnessMatrix::<f64, Abaqus>::of(&truesdell.jaumann(&cauchy).0).entries;
            close(&tangent, expected.as_flattened(), condition);
            for row in 0..6 {
                for column in 0..6 {
                    assert_eq!(tangent[6 * row + column].to_bits(), tangent[6 * column + row].to_bits());
                }
            }
        }
    }

    #[test]
    fn vumat_gives_the_stress_turned_back_by_the_rotation(f in crate::points::deformation()) {
        let deformation = DeformationGradient::new(f).unwrap();
        let analysis = StretchAnalysis::of(&deformation);
        let rotation: Matrix3<f64> = from_rows(analysis.rotation());
        let stretches = analysis.principal_stretches();
        let condition = (stretches[0] / stretches[2]).powi(4);
        let u = analysis.right_stretch().components; // 11, 22, 33, 12, 23, 13 is also the order of VUMAT
        for law in crate::points::laws() {
            let mut corotated = [0.0; 6];
            vumat_of(&law.clone().into(), &u, 0.0, &mut corotated).unwrap();
            let expected = rotation.transpose() * law.cauchy(&deformation).0.matrix() * rotation;
            let expected = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)].map(|place| expected[place]);
            close(&corotated, &expected, condition);
        }
    }
}

#[test]
fn plane_strain_takes_the_first_four_components() {
    let law = &crate::points::laws()[0];
    let f = by_columns(&Matrix3::new(1.2, 0.3, 0.0, 0.1, 0.9, 0.0, 0.0, 0.0, 1.0));
    let (mut all, mut square) = ([0.0; 6], [0.0; 36]);
    umat_of(law, [3, 3], &f, &mut all, &mut square).unwrap();
    let (mut four, mut sixteen) = ([0.0; 4], [0.0; 16]);
    umat_of(law, [3, 1], &f, &mut four, &mut sixteen).unwrap();
    assert_eq!(four, all[..4]);
    for row in 0..4 {
        assert_eq!(sixteen[4 * row..4 * row + 4], square[6 * row..6 * row + 4]);
    }
    let mut two = [0.0; 3];
    let plane_stress = umat_of(law, [2, 1], &f, &mut two, &mut [0.0; 9]);
    assert!(matches!(plane_stress, Err(FfiError::Components { direct: 2, shear: 1 })));
}

#[test]
fn vumat_takes_blocks_by_components_and_small_strains() {
    let law = material("saint_venant_kirchhoff", &[1.0, 2.0]).unwrap();
    let count = 300;
    let mut stretches = vec![0.0; 6 * count];
    for i in 0..count {
        for k in 0..3 {
            stretches[k * count + i] = 1.0;
        }
        stretches[i] = 1.0 + i as f64 / 100.0;
    }
    let mut stresses = vec![0.0; 6 * count];
    vumat_of(&law, &stretches, 0.0, &mut stresses).unwrap();
    for i in [0, 100, 128, 299] {
        let stretch = 1.0 + i as f64 / 100.0;
        let expected = stretch * 5.0 * 0.5 * (stretch * stretch - 1.0); // F₁₁² (λ + 2 μ) E₁₁/J
        assert!((stresses[i] - expected).abs() <= 8.0 * f64::EPSILON * expected.max(1.0), "{i}");
    }
    let strains = [1e-9, 0.0, 0.0, 0.0, 0.0, 0.0];
    let mut small = [0.0; 6];
    vumat_of(&law, &strains, 1.0, &mut small).unwrap();
    // F = 1 + ε has lost seven digits of ε to rounding, and is linear up to the first order.
    assert!((small[0] - 5e-9).abs() < 1e-15 && (small[1] - 1e-9).abs() < 1e-15);
    stretches[130] = 0.0;
    let Err(FfiError::BadPoints { bad: 1, count: 300, index: 130, .. }) =
        vumat_of(&law, &stretches, 0.0, &mut stresses)
    else {
        unreachable!("U₁₁ = 0 at point 130")
    };
    assert!(stresses[130].is_nan() && stresses[131].is_finite());
    stretches[280] = 0.0; // in another block
    let error = vumat_of(&law, &stretches, 0.0, &mut stresses).unwrap_err();
    assert!(matches!(error, FfiError::BadPoints { bad: 2, count: 300, index: 130, .. }), "{error}");
}

#[test]
fn materials_are_laws_with_properties_or_files() {
    let law = material("COMPRESSIBLE-GENT-LIU", &[1.0, 50.0, 9.0]).unwrap();
    assert_eq!(*law, piola_ffi::named::solid("compressible-gent-liu", &[1.0, 50.0, 9.0]).unwrap().into());
    let error = material("NO_SUCH_TREAD", &[]).unwrap_err().to_string();
    assert!(error.contains("no_such_tread.json") && error.contains("PIOLA_MATERIALS"), "{error}");
    // Far more than are kept: each is still its own law.
    for k in 1..200 {
        let modulus = f64::from(k);
        assert_eq!(
            *material("saint_venant_kirchhoff", &[1.0, modulus]).unwrap(),
            *material("saint_venant_kirchhoff", &[1.0, modulus]).unwrap()
        );
    }
}

/// An elastic law leaves a state of any length as it is: UMAT in its place, VUMAT from the old to the new one.
#[test]
fn elastic_laws_keep_the_state() {
    let law = material("saint_venant_kirchhoff", &[1.0, 2.0]).unwrap();
    let f = by_columns(&Matrix3::new(1.2, 0.3, 0.0, 0.1, 0.9, 0.0, 0.0, 0.0, 1.0));
    let (mut state, mut stress, mut tangent) = ([1.0, -2.0], [0.0; 6], [0.0; 36]);
    let increment = PointIncrement { f: [&f, &f], dt: 1.0, temperature: 0.0 };
    umat(&law, [3, 3], increment, &mut state, &mut stress, &mut tangent).unwrap();
    assert_eq!(state, [1.0, -2.0]);
    let stretching = Stretching { before: &[], after: &[1.0, 1.0, 1.0, 0.0], added: 0.0, dt: 1.0, temperatures: &[] };
    let mut new = [0.0; 2];
    vumat(&law, [3, 1], stretching, (&state, &mut new), &mut stress[..4]).unwrap();
    assert_eq!(new, state);
    // They belong to the user's other subroutines: what an elastic law does not use is not looked at.
    let stretching = Stretching { before: &[f64::NAN; 4], temperatures: &[f64::NAN], ..stretching };
    vumat(&law, [3, 1], stretching, (&[f64::NAN, 1.0], &mut new), &mut stress[..4]).unwrap();
    assert!(new[0].is_nan() && new[1].to_bits() == 1.0_f64.to_bits());
    assert!(stress[..4].iter().all(|x| x.is_finite()));
    let error = vumat(&law, [3, 1], stretching, (&state, &mut new[..1]), &mut stress[..4]).unwrap_err();
    assert!(matches!(error, FfiError::WrongLength { quantity: "stateNew", expected: 2, found: 1 }), "{error}");
}
