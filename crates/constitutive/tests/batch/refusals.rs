//! Points at which a law has no answer are reported by their index with the law's own error; all others are computed.

use nalgebra::Matrix3;
use piola_constitutive::ConstitutiveError;
use piola_constitutive::batch::{self, BadPoint};
use piola_constitutive::solids::{Compressible, Hyperelastic, isochoric::Gent, volumetric::Quadratic};
use piola_continuum::batch::Gradients;
use piola_continuum::{ContinuumError, DeformationGradient, FirstPiola};

#[test]
fn points_beyond_a_limit_and_inverted_ones_are_named_and_void() {
    let law = Compressible::new(Gent::new(1.0, 2.0).expect("μ, Jₘ"), Quadratic::new(10.0).expect("κ"));
    let mut f = vec![Matrix3::new(1.0, 0.25, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0); 41];
    f[6] = Matrix3::from_diagonal(&nalgebra::Vector3::new(9.0, 1.0, 1.0));
    f[7] = Matrix3::zeros();
    f[40] = Matrix3::from_diagonal(&nalgebra::Vector3::new(1.0, 1.0, 8.0));
    let mut p = vec![FirstPiola::<f64>::zero(); f.len()];
    let Err(ConstitutiveError::BadPoints { points, count: 41, .. }) =
        batch::evaluate(Gradients(&f[..]), batch::first_piola(&law, &mut p[..]))
    else {
        panic!("bad points are expected")
    };
    let indices: Vec<usize> = points.iter().map(|point| point.index).collect();
    assert_eq!(indices, [6, 7, 40]);
    for BadPoint { index, error } in points {
        match DeformationGradient::new(f[index]) {
            Ok(f) => assert!(
                matches!(error, ConstitutiveError::BeyondLimit { law: "Gent", limit: 2.0, .. })
                    && law.check(&f).is_err(),
                "{error}"
            ),
            Err(single) => {
                assert!(matches!(&error, ConstitutiveError::Continuum(ContinuumError::NonPositiveJacobian { .. })));
                assert_eq!(error.to_string(), single.to_string());
            }
        }
        assert!(p[index].0.iter().all(|x| x.is_nan()), "point {index}");
    }
    assert!((0..41).filter(|index| !indices.contains(index)).all(|index| p[index].0.iter().all(|x| x.is_finite())));
}
