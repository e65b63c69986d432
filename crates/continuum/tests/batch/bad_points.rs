//! All bad points are reported, with what is wrong with each; all others are computed.

use nalgebra::Matrix3;
use piola_continuum::batch::{self, BadPoint, Displacements, Gradients};
use piola_continuum::{ContinuumError, DeformationGradient, Symmetric};

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

fn points_of(result: Result<batch::Report, ContinuumError>) -> Vec<BadPoint> {
    match result {
        Err(ContinuumError::BadPoints { points, count: 1003, .. }) => points,
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
    let error = ContinuumError::NonPositiveJacobian { determinant: -1.0 };
    assert_eq!(points, [BadPoint { index: 77, error }]);
}

#[test]
fn stresses_that_are_not_finite_are_named_at_good_deformations() {
    let (f, mut t) = (deformations(1003), stresses(1003));
    t[1000].0.components[4] = f64::NEG_INFINITY;
    let mut p = vec![Matrix3::zeros(); f.len()];
    let points = points_of(batch::evaluate(&f[..], batch::cauchy_to_first_piola(&t[..], &mut p[..])));
    let error = ContinuumError::NotFinite { quantity: "CauchyStress", index: 4, value: f64::NEG_INFINITY };
    assert_eq!(points, [BadPoint { index: 1000, error }]);
    assert!(p[1000].iter().all(|x| x.is_nan()) && p[999].iter().all(|x| x.is_finite()));
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
    let Err(ContinuumError::BadPoints { points, .. }) = result else { panic!("bad points are expected") };
    assert_eq!(points.iter().map(|point| point.index).collect::<Vec<_>>(), bad);
}
