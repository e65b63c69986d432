//! All bad points are reported, with what is wrong with each; all others are computed.

use nalgebra::Matrix3;
use piola_batch as batch;
use piola_batch::{AllEntries, BadPoint, BatchError, Displacements, Gradients};
use piola_continuum::{CauchyStress, ContinuumError, DeformationGradient, FirstPiola, SecondPiola, Symmetric};
use piola_tensor::TensorError;
use piola_testkit::spectral::{Random, with_stretches};
use piola_testkit::{Tol, assert_close};

use super::cases::{deformations, stresses};

/// Points that are spoilt: singular, inverted, not finite, and three of a block.
const SPOILT: [(usize, f64); 6] = [(0, 0.0), (9, -1.0), (10, f64::NAN), (11, f64::INFINITY), (500, 0.0), (1002, -1.0)];

fn spoilt() -> (Vec<DeformationGradient>, Vec<Matrix3<f64>>) {
    let good = deformations(1003);
    let mut f: Vec<Matrix3<f64>> = good.iter().map(|f| *f.matrix()).collect();
    for (index, factor) in SPOILT {
        f[index].row_mut(0).scale_mut(factor);
    }
    (good, f)
}

fn points_of(result: Result<batch::Report, BatchError>) -> Vec<BadPoint> {
    match result {
        Err(BatchError::BadPoints { points, count: 1003, .. }) => points,
        other => panic!("bad points are expected, not {other:?}"),
    }
}

#[test]
fn every_bad_point_is_named_as_a_single_point_would_be() {
    let (_, f) = spoilt();
    let mut u = vec![Symmetric::zero(); f.len()];
    let points = points_of(batch::evaluate(Gradients(&f[..]), batch::right_stretch(&mut u[..])));
    assert_eq!(points.iter().map(|point| point.index).collect::<Vec<_>>(), SPOILT.map(|(index, _)| index));
    for BadPoint { index, error } in points {
        let single = DeformationGradient::new(f[index]).expect_err("a bad point");
        // NaN differs from itself: compared in words.
        assert_eq!(error.to_string(), single.to_string(), "point {index}");
    }
}

#[test]
fn good_points_beside_bad_ones_are_computed_and_bad_ones_are_void() {
    let (good, f) = spoilt();
    let (mut u, mut l) = (vec![Symmetric::zero(); f.len()], vec![Symmetric::zero(); f.len()]);
    let (mut expected_u, mut expected_l) = (u.clone(), l.clone());
    let requests = (batch::right_stretch(&mut u[..]), batch::hencky(&mut l[..]));
    assert!(batch::evaluate(Gradients(&f[..]), requests).is_err());
    let requests = (batch::right_stretch(&mut expected_u[..]), batch::hencky(&mut expected_l[..]));
    batch::evaluate(&good[..], requests).expect("deformations");
    for index in 0..f.len() {
        if SPOILT.iter().any(|(bad, _)| *bad == index) {
            assert!(u[index].components.iter().chain(&l[index].components).all(|x| x.is_nan()));
        } else {
            assert_eq!((u[index], l[index]), (expected_u[index], expected_l[index]), "point {index}");
        }
    }
}

#[test]
fn displacements_that_turn_the_body_inside_out_are_named() {
    let mut h = vec![Matrix3::from_diagonal_element(1e-9); 1003];
    h[77] = Matrix3::from_diagonal_element(-2.0);
    let mut e = vec![Symmetric::zero(); h.len()];
    let points = points_of(batch::evaluate(Displacements(&h[..]), batch::green_strain(&mut e[..])));
    let error = BatchError::Continuum(ContinuumError::NonPositiveJacobian { determinant: -1.0 });
    assert_eq!(points, [BadPoint { index: 77, error }]);
}

#[test]
fn stresses_that_are_not_finite_are_named_at_good_deformations() {
    let (f, mut t) = (deformations(1003), stresses(1003));
    t[1000].0.components[4] = f64::NEG_INFINITY;
    let mut p = vec![Matrix3::zeros(); f.len()];
    let points = points_of(batch::evaluate(&f[..], batch::cauchy_to_first_piola(&t[..], &mut p[..])));
    let error = BatchError::NotFinite { quantity: "CauchyStress", index: 4, value: f64::NEG_INFINITY };
    assert_eq!(points, [BadPoint { index: 1000, error }]);
    assert!(p[1000].iter().all(|x| x.is_nan()) && p[999].iter().all(|x| x.is_finite()));
}

#[test]
fn stresses_whose_double_would_overflow_are_finite() {
    // At F = 1 all stresses are the same.
    let f = [Matrix3::identity(); 9];
    let stress = [CauchyStress(Symmetric { components: [1.5e308, -1.5e308, 1e308, 1.7e308, -1e308, 0.0] }); 9];
    let mut p = [FirstPiola::zero(); 9];
    batch::evaluate(Gradients(&f[..]), batch::cauchy_to_first_piola(&stress[..], &mut p[..])).expect("finite");
    assert_eq!(p.map(|p| p.0), stress.map(|t| t.0.matrix()));
}

#[test]
fn tensors_that_are_not_symmetric_are_named_and_the_others_computed() {
    let (f, t) = (deformations(1003), stresses(1003));
    let mut all: Vec<Matrix3<f64>> = t.iter().map(|t| t.0.matrix()).collect();
    // Rounding is no asymmetry, twice as much as is allowed is.
    all[3][(2, 1)] += 8.0 * f64::EPSILON * all[3].amax();
    all[8][(2, 1)] += 64.0 * f64::EPSILON * all[8].amax();
    all[1002][(0, 2)] = -all[1002][(0, 2)] - 1.0;
    all[500][(1, 1)] = f64::NAN;
    let (mut p, mut expected) = (vec![Matrix3::zeros(); f.len()], vec![Matrix3::zeros(); f.len()]);
    let points = points_of(batch::evaluate(&f[..], batch::cauchy_to_first_piola(AllEntries(&all[..]), &mut p[..])));
    batch::evaluate(&f[..], batch::cauchy_to_first_piola(&t[..], &mut expected[..])).expect("good points");
    assert_eq!(points.iter().map(|point| point.index).collect::<Vec<_>>(), [8, 500, 1002]);
    assert!(
        matches!(
            points[0].error,
            BatchError::Continuum(ContinuumError::Tensor(TensorError::NotSymmetric { row: 1, column: 2, .. }))
        ),
        "{}",
        points[0].error
    );
    assert!(matches!(points[1].error, BatchError::NotFinite { index: 4, .. }), "{}", points[1].error);
    assert!(
        matches!(
            points[2].error,
            BatchError::Continuum(ContinuumError::Tensor(TensorError::NotSymmetric { row: 0, column: 2, .. }))
        ),
        "{}",
        points[2].error
    );
    for index in (0..f.len()).filter(|index| ![3, 8, 500, 1002].contains(index)) {
        assert_eq!(p[index], expected[index], "point {index}");
    }
    let tolerance = Tol::stated(1e-12, "4 ulp of the largest entry, through F of the adversarial set");
    assert_close("a rounding", p[3].as_slice(), expected[3].as_slice(), tolerance);
}

/// P of balanced stresses at deformations of stretches between ½ and 2, one of them spoilt by a moment.
fn first_piola(count: usize, spoilt: &[usize]) -> (Vec<DeformationGradient>, Vec<FirstPiola>) {
    let mut random = Random::new(22);
    let f: Vec<_> = (0..count)
        .map(|_| {
            let stretches = [(); 3].map(|()| (0.69 * random.symmetric()).exp());
            let f = with_stretches(&random.rotation(), stretches, &random.rotation());
            DeformationGradient::from_rows(f).expect("a deformation")
        })
        .collect();
    let mut p: Vec<_> = stresses(count).iter().zip(&f).map(|(t, f)| t.first_piola(f)).collect();
    for &index in spoilt {
        p[index].0[(0, 1)] += 1e-10;
    }
    (f, p)
}

#[test]
fn first_piola_stresses_with_a_moment_are_named_and_the_others_computed() {
    let (f, p) = first_piola(1003, &[0, 8, 500, 1002]);
    let s = Symmetric::zero();
    let (mut t, mut second) = (vec![s; 1003], vec![s; 1003]);
    let alone = points_of(batch::evaluate(&f[..], batch::first_piola_to_cauchy(&p[..], &mut t[..])));
    let material = points_of(batch::evaluate(&f[..], batch::first_piola_to_second_piola(&p[..], &mut second[..])));
    assert_eq!(alone, material);
    assert_eq!(alone.iter().map(|point| point.index).collect::<Vec<_>>(), [0, 8, 500, 1002]);
    for BadPoint { index, error } in &alone {
        // The single point refuses it by the same name.
        let single = p[*index].check_moment(&f[*index]).expect_err("a moment");
        let (
            BatchError::Continuum(ContinuumError::Tensor(TensorError::NotSymmetric { quantity, .. })),
            ContinuumError::Tensor(TensorError::NotSymmetric { quantity: expected, .. }),
        ) = (error, &single)
        else {
            panic!("{error} and {single}")
        };
        assert_eq!(quantity, expected);
    }
    for index in 0..1003 {
        if [0, 8, 500, 1002].contains(&index) {
            assert!(t[index].components.iter().all(|x| x.is_nan()), "point {index}");
        } else {
            assert_eq!(t[index], p[index].cauchy(&f[index]).0, "point {index}");
        }
    }
}

#[test]
fn first_piola_stresses_that_roundings_of_others_made_are_no_moments() {
    // Up to stretch ratios of 1e8: P as the library makes it of T and of S.
    let (f, t) = (deformations(1003), stresses(1003));
    let (mut p, mut back) = (vec![FirstPiola::zero(); 1003], vec![Symmetric::zero(); 1003]);
    batch::evaluate(&f[..], batch::cauchy_to_first_piola(&t[..], &mut p[..])).expect("deformations");
    batch::evaluate(&f[..], batch::first_piola_to_cauchy(&p[..], &mut back[..])).expect("no moments");
    let s: Vec<_> = t.iter().map(|t| SecondPiola(t.0)).collect();
    batch::evaluate(&f[..], batch::second_piola_to_first_piola(&s[..], &mut p[..])).expect("deformations");
    batch::evaluate(&f[..], batch::first_piola_to_second_piola(&p[..], &mut back[..])).expect("no moments");
    // And what the single point accepts to the last digit is accepted.
    let (f, mut p) = first_piola(1003, &[]);
    for (index, p) in p.iter_mut().enumerate() {
        p.0[(index % 3, index / 3 % 3)] *= 1.0 + 4.0 * f64::EPSILON;
    }
    batch::evaluate(&f[..], batch::first_piola_to_cauchy(&p[..], &mut back[..])).expect("no moments");
}

#[cfg(feature = "rayon")]
#[test]
fn first_piola_stresses_with_a_moment_are_named_from_any_number_of_threads() {
    let count = batch::PARALLEL_POINTS + 5000;
    let bad = [3, 4095, 4096, 8191, 8192, count - 1];
    let (f, p) = first_piola(count, &bad);
    let mut t = vec![CauchyStress::zero(); count];
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().expect("threads");
    let result = pool.install(|| batch::evaluate(&f[..], batch::first_piola_to_cauchy(&p[..], &mut t[..])));
    let Err(BatchError::BadPoints { points, .. }) = result else { panic!("bad points are expected") };
    assert_eq!(points.iter().map(|point| point.index).collect::<Vec<_>>(), bad);
    assert!(points.iter().all(|point| matches!(
        point.error,
        BatchError::Continuum(ContinuumError::Tensor(TensorError::NotSymmetric { quantity: "P F^T", .. }))
    )));
    for index in 0..count {
        assert!(bad.contains(&index) || t[index] == p[index].cauchy(&f[index]), "point {index}");
    }
}

#[cfg(feature = "rayon")]
#[test]
fn bad_points_come_in_order_from_any_number_of_threads() {
    let count = batch::PARALLEL_POINTS + 5000;
    let mut f = vec![Matrix3::identity(); count];
    let bad: Vec<usize> = (3..count).step_by(997).collect();
    for &index in &bad {
        f[index] = Matrix3::zeros();
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().expect("threads");
    let mut j = vec![0.0; count];
    let result = pool.install(|| batch::evaluate(Gradients(&f[..]), batch::jacobian(&mut j[..])));
    let Err(BatchError::BadPoints { points, .. }) = result else { panic!("bad points are expected") };
    assert_eq!(points.iter().map(|point| point.index).collect::<Vec<_>>(), bad);
}

#[cfg(feature = "rayon")]
#[test]
fn inputs_that_are_not_finite_are_named_from_any_number_of_threads_and_the_rest_is_computed() {
    let count = batch::PARALLEL_POINTS + 5000;
    let (f, mut stress) = (deformations(count), stresses(count));
    let mut velocity = vec![[0.0, 1.0, 0.0, -2.0, 0.5, 0.0, 0.0, 0.0, 0.25]; count];
    let (bad_stress, bad_velocity) = ([5, 4100, count - 1], [6, 4100, 8191, 8192]);
    for index in bad_stress {
        stress[index].0.components[2] = f64::NAN;
    }
    for index in bad_velocity {
        velocity[index][8] = f64::INFINITY;
    }
    let (mut rate, mut first_piola) = (vec![[0.0; 6]; count], vec![[0.0; 9]; count]);
    let mut expected = vec![[0.0; 6]; count];
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().expect("threads");
    let result = pool.install(|| {
        let requests = (
            batch::rate_of_deformation(&velocity[..], &mut rate[..]),
            batch::cauchy_to_first_piola(&stress[..], &mut first_piola[..]),
        );
        batch::evaluate(&f[..], requests)
    });
    let Err(BatchError::BadPoints { points, .. }) = result else { panic!("bad points are expected") };
    let found: Vec<_> = points.iter().map(|point| point.index).collect();
    assert_eq!(found, [5, 6, 4100, 8191, 8192, count - 1]);
    let good = batch::rate_of_deformation(&velocity[..], &mut expected[..]);
    assert!(batch::evaluate(&f[..], good).is_err());
    for index in 0..count {
        if found.contains(&index) {
            assert!(rate[index].iter().all(|x| x.is_nan()) && first_piola[index][0].is_nan(), "point {index}");
        } else {
            assert_close("rate", &rate[index], &expected[index], Tol::ulps(0.0));
        }
    }
}
