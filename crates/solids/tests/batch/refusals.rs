//! Points at which a law has no answer are reported by their index with the law's own error; all others are computed.

use nalgebra::Matrix3;
use piola_batch::Gradients;
use piola_continuum::{ContinuumError, DeformationGradient, FirstPiola, SecondPiola};
use piola_solids::SolidsError;
use piola_solids::batch::{self, BadPoint};
use piola_solids::isochoric::{Gent, Yeoh};
use piola_solids::volumetric::Quadratic;
use piola_solids::{Compressible, Hyperelastic, MooneyRivlin, SaintVenantKirchhoff};

#[test]
fn points_beyond_a_limit_and_inverted_ones_are_named_and_void() {
    let law = Compressible::new(Gent::new(1.0, 2.0).expect("μ, Jₘ"), Quadratic::new(10.0).expect("κ"));
    let mut f = vec![Matrix3::new(1.0, 0.25, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0); 41];
    f[6] = Matrix3::from_diagonal(&nalgebra::Vector3::new(9.0, 1.0, 1.0));
    f[7] = Matrix3::zeros();
    f[40] = Matrix3::from_diagonal(&nalgebra::Vector3::new(1.0, 1.0, 8.0));
    let mut p = vec![FirstPiola::<f64>::zero(); f.len()];
    let Err(SolidsError::BadPoints { points, count: 41, .. }) =
        batch::evaluate(Gradients(&f[..]), batch::first_piola(&law, &mut p[..]))
    else {
        panic!("bad points are expected")
    };
    let indices: Vec<usize> = points.iter().map(|point| point.index).collect();
    assert_eq!(indices, [6, 7, 40]);
    for BadPoint { index, error } in points {
        match DeformationGradient::new(f[index]) {
            Ok(f) => assert!(
                matches!(error, SolidsError::BeyondLimit { law: "Gent", limit: 2.0, .. }) && law.check(&f).is_err(),
                "{error}"
            ),
            Err(single) => {
                assert!(matches!(&error, SolidsError::Continuum(ContinuumError::NonPositiveJacobian { .. })));
                assert_eq!(error.to_string(), single.to_string());
            }
        }
        assert!(p[index].0.iter().all(|x| x.is_nan()), "point {index}");
    }
    assert!((0..41).filter(|index| !indices.contains(index)).all(|index| p[index].0.iter().all(|x| x.is_finite())));
}

#[test]
fn gradients_of_no_deformation_are_named_whatever_is_asked_of_a_law_without_a_limit() {
    let law = MooneyRivlin::stress_free(0.5, 0.25, 1.0).expect("parameters");
    let mut f = vec![Matrix3::new(1.0, 0.25, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0); 41];
    f[3] = Matrix3::from_diagonal_element(3.0);
    f[5] = Matrix3::from_diagonal(&nalgebra::Vector3::new(-1.0, 1.0, 1.0));
    f[18] = Matrix3::zeros();
    f[20][(2, 1)] = f64::NAN;
    f[35][(0, 1)] = f64::INFINITY;
    let expected = [5, 18, 20, 35];
    let mut p = vec![FirstPiola::<f64>::zero(); f.len()];
    let (mut a, mut b) = (vec![[0.0_f64; 45]; f.len()], vec![[0.0_f64; 45]; f.len()]);
    let named = |result| {
        let Err(SolidsError::BadPoints { points, .. }) = result else { panic!("bad points are expected") };
        assert_eq!(points.iter().map(|point: &BadPoint| point.index).collect::<Vec<_>>(), expected);
    };
    named(batch::evaluate(Gradients(&f[..]), batch::first_piola(&law, &mut p[..])));
    assert!((0..f.len()).all(|index| p[index].0.iter().all(|x| x.is_nan() == expected.contains(&index))));
    named(batch::evaluate(Gradients(&f[..]), batch::first_piola_tangent(&law, &mut a[..])));
    named(batch::evaluate(Gradients(&f[..]), batch::first_piola_and_tangent(&law, &mut p[..], &mut b[..])));
    for tangents in [a, b] {
        assert!((0..f.len()).all(|index| tangents[index].iter().all(|x| x.is_nan() == expected.contains(&index))));
    }
}

#[test]
fn points_whose_answer_leaves_the_range_of_numbers_are_named() {
    let f = [1.0, 1e70].map(|x: f64| Matrix3::from_diagonal(&nalgebra::Vector3::new(x, x.powf(-0.5), x.powf(-0.5))));
    let yeoh = Yeoh::new(0.5, 0.1, 0.01).expect("parameters");
    let law = Compressible::new(yeoh, Quadratic::new(10.0).expect("κ"));
    let (mut w, mut p, mut s) = ([0.0_f64; 2], [FirstPiola::<f64>::zero(); 2], [SecondPiola::<f64>::zero(); 2]);
    let named = |result, answer: &str| {
        let Err(SolidsError::BadPoints { points, .. }) = result else { panic!("a bad point is expected") };
        assert_eq!(points.len(), 1, "{points:?}");
        assert_eq!(points[0].index, 1);
        assert!(matches!(points[0].error, SolidsError::Overflow { answer: found } if found == answer), "{points:?}");
    };
    named(batch::evaluate(Gradients(&f[..]), batch::energy(&law, &mut w[..])), "energy");
    named(batch::evaluate(Gradients(&f[..]), batch::first_piola(&law, &mut p[..])), "first_piola");
    assert!(p[0].0.iter().all(|x| x.is_finite()) && p[1].0.iter().all(|x| x.is_nan()));
    let stiff = SaintVenantKirchhoff::new(1.0, 1.0).expect("parameters");
    let far = [1.0, 1e160].map(|x: f64| Matrix3::from_diagonal(&nalgebra::Vector3::new(x, x.powf(-0.5), x.powf(-0.5))));
    named(batch::evaluate(Gradients(&far[..]), batch::second_piola(&stiff, &mut s[..])), "second_piola");
}
