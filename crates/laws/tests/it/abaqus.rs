//! Batches of user materials against the one-point tangents, the polar decomposition and each other.

use core::error::Error;

use nalgebra::Matrix3;
use piola_batch::Components;
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::{Deformation, DeformationGradient};
use piola_laws::abaqus::{
    Abaqus, Corotated, Frame, Laboratory, Piola, VoigtOrder, jaumann, stress, stress_and_jaumann,
};
use piola_numerics::linear::matrix3::from_rows;
use piola_solids::isochoric::Gent;
use piola_solids::volumetric::Quadratic;
use piola_solids::{Compressible, Fibre, Hencky, Hyperelastic, ReinforcedNeoHookean, SolidsError, batch};
use piola_tensor::voigt::{StiffnessMatrix, StressVector};
use piola_testkit::spectral::{Random, with_stretches};
use piola_testkit::{Tol, allocations_in, assert_close_at_scale};

type Fallible = Result<(), Box<dyn Error>>;

const COUNT: usize = 21; // not a multiple of any number of lanes

fn deformations() -> Vec<DeformationGradient> {
    let mut random = Random::new(7);
    let one = |random: &mut Random| {
        let stretches = [0, 1, 2].map(|_| (0.3 * random.symmetric()).exp());
        let f = with_stretches(&random.rotation(), stretches, &random.rotation());
        DeformationGradient::from_rows(f).expect("0 < det F")
    };
    (0..COUNT).map(|_| one(&mut random)).collect()
}

/// What the requests should give: the one-point functions at a deformation.
fn expected<O: VoigtOrder>(law: &impl Hyperelastic, f: &DeformationGradient) -> ([f64; 6], [[f64; 6]; 6]) {
    let (stress, tangent) = law.cauchy_and_tangent(f);
    let entries = StiffnessMatrix::<f64, O>::of(&tangent.jaumann(&stress).0).entries;
    (StressVector::<f64, O>::of(&stress.0).components, entries)
}

fn check<O: VoigtOrder, F: Frame>(
    what: &str,
    law: &(impl Hyperelastic + Sync),
    frame: F,
    seen: impl Fn(&DeformationGradient) -> DeformationGradient,
) -> Fallible {
    let f = deformations();
    let (mut t, mut c) = (vec![[0.0_f64; 6]; COUNT], vec![[0.0_f64; 36]; COUNT]);
    let (count, result) = allocations_in(|| {
        batch::evaluate(&f[..], stress_and_jaumann::<O, _, _, _, _>(law, frame, &mut t[..], &mut c[..]))
    });
    assert_eq!((count, result?.points), (0, COUNT));
    let (mut alone, mut tangents) = (vec![[0.0_f64; 6]; COUNT], vec![[0.0_f64; 36]; COUNT]);
    let requests =
        (stress::<O, _, _, _>(law, frame, &mut alone[..]), jaumann::<O, _, _, _>(law, frame, &mut tangents[..]));
    batch::evaluate(&f[..], requests)?;
    let tol = Tol::ulps_because(256.0, "P and ∂P/∂F in lanes, then products with F, its inverse or U");
    for (k, f) in f.iter().enumerate() {
        let (six, rows) = expected::<O>(law, &seen(f));
        let scale = rows.as_flattened().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        assert_close_at_scale(&format!("{what}: T at {k}"), &t[k], &six, scale, tol);
        assert_close_at_scale(&format!("{what}: DDSDDE at {k}"), &c[k], rows.as_flattened(), scale, tol);
        assert_close_at_scale(&format!("{what}: T alone at {k}"), &alone[k], &six, scale, tol);
        assert_close_at_scale(&format!("{what}: DDSDDE alone at {k}"), &tangents[k], &c[k], scale, tol);
    }
    Ok(())
}

/// F = U, its rounding apart.
fn stretch(f: &DeformationGradient) -> DeformationGradient {
    DeformationGradient::from_rows(StretchAnalysis::of(f).right_stretch().rows()).expect("U is positive definite")
}

#[test]
fn batches_equal_the_one_point_tangents_in_both_orders_and_frames() -> Fallible {
    fn all(what: &str, law: &(impl Hyperelastic + Sync)) -> Fallible {
        check::<Abaqus, _>(what, law, Laboratory, |f| *f)?;
        check::<Piola, _>(what, law, Laboratory, |f| *f)?;
        check::<Abaqus, _>(what, law, Corotated, stretch)?;
        check::<Piola, _>(what, law, Corotated, stretch)
    }
    all("Gent", &Compressible::new(Gent::new(1.0, 50.0)?, Quadratic::new(20.0)?))?;
    all("Hencky", &Hencky::new(3.0, 1.0)?)?;
    all("reinforced", &ReinforcedNeoHookean::new(1.0, 2.0, 3.0, Fibre::new([0.6, 0.8, 0.0])?)?)
}

/// Rᵀ T R of the stress in the laboratory, also of a law with fibres.
#[test]
fn corotated_stress_equals_the_stress_turned_back() -> Fallible {
    let law = ReinforcedNeoHookean::new(1.0, 2.0, 3.0, Fibre::new([0.6, 0.8, 0.0])?)?;
    let f = deformations();
    let mut found = vec![[0.0; 6]; COUNT];
    batch::evaluate(&f[..], stress::<Piola, _, _, _>(&law, Corotated, &mut found[..]))?;
    for (f, found) in f.iter().zip(found) {
        let rotation: Matrix3<f64> = from_rows(StretchAnalysis::of(f).rotation());
        let turned = rotation.transpose() * law.cauchy(f).0.matrix() * rotation;
        let expected = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)].map(|place| turned[place]);
        let tol = Tol::ulps_because(256.0, "the polar decomposition and two products with R");
        assert_close_at_scale("Rᵀ T R", &found, &expected, 10.0, tol);
    }
    Ok(())
}

/// The blocks of VUMAT: each component an array.
#[test]
fn structures_of_arrays_hold_the_numbers_of_arrays_of_structures() -> Fallible {
    let law = Compressible::new(Gent::new(1.0, 50.0)?, Quadratic::new(20.0)?);
    let f = deformations();
    let mut rows = vec![[0.0; 6]; COUNT];
    batch::evaluate(&f[..], stress::<Piola, _, _, _>(&law, Corotated, &mut rows[..]))?;
    let mut columns = vec![vec![0.0; COUNT]; 6];
    let mut rest = columns.iter_mut();
    let arrays: [&mut [f64]; 6] = core::array::from_fn(|_| rest.next().expect("six").as_mut_slice());
    batch::evaluate(&f[..], stress::<Piola, _, _, _>(&law, Corotated, Components::new_mut(arrays)?))?;
    for (k, row) in rows.iter().enumerate() {
        let column: Vec<f64> = columns.iter().map(|column| column[k]).collect();
        assert_eq!(&row[..], &column[..], "{k}");
    }
    Ok(())
}

#[test]
fn refused_points_and_lengths_are_named() -> Fallible {
    let law = Compressible::new(Gent::new(1.0, 0.5)?, Quadratic::new(20.0)?);
    let mut f = vec![DeformationGradient::simple_shear(0.1)?; COUNT];
    f[13] = DeformationGradient::simple_shear(1.0)?; // I₁ − 3 = 1, beyond 0.5
    let (mut t, mut c) = (vec![[0.0_f64; 6]; COUNT], vec![[0.0_f64; 36]; COUNT]);
    let result =
        batch::evaluate(&f[..], stress_and_jaumann::<Abaqus, _, _, _, _>(&law, Laboratory, &mut t[..], &mut c[..]));
    let Err(SolidsError::BadPoints { points, count: COUNT, .. }) = result else {
        unreachable!("point 13 is beyond the limit: {result:?}")
    };
    assert_eq!(points.iter().map(|point| point.index).collect::<Vec<_>>(), [13]);
    assert!(t[13][0].is_nan() && c[13][35].is_nan() && t[12][3].is_finite() && 0.0 < f[13].jacobian());
    let result =
        batch::evaluate(&f[..], stress_and_jaumann::<Abaqus, _, _, _, _>(&law, Laboratory, &mut t[..], &mut c[1..]));
    assert!(matches!(result, Err(SolidsError::Batch(piola_batch::BatchError::WrongLength { .. }))), "{result:?}");
    Ok(())
}
