//! Deformations beyond what a law can answer, at single points and in batches.

use piola_continuum::DeformationGradient;
use piola_solids::SolidsError;
use piola_solids::isochoric::{ArrudaBoyce, Gent};
use piola_solids::volumetric::Quadratic;
use piola_solids::{AnySolid, Compressible, Hyperelastic, IncompressibleOgden, IncompressibleSolid, OgdenTerm};

/// Both stop at Ī₁ − 3 = 3.
fn solids() -> Result<[(AnySolid, &'static str); 4], SolidsError> {
    let (gent, chains, bulk) = (Gent::new(1.0, 3.0)?, ArrudaBoyce::new(1.0, 2.0)?, Quadratic::new(10.0)?);
    Ok([
        (Compressible::new(gent, bulk).into(), "Gent"),
        (Compressible::new(chains, bulk).into(), "Arruda–Boyce"),
        (IncompressibleSolid::new(gent).into(), "Gent"),
        (IncompressibleSolid::new(chains).into(), "Arruda–Boyce"),
    ])
}

#[test]
fn shapes_beyond_the_limit_are_refused_and_have_no_stress() -> Result<(), SolidsError> {
    for (law, name) in solids()? {
        let shear = |k: f64| DeformationGradient::simple_shear(k).expect("finite");
        assert_eq!(law.check(&shear(1.7)), Ok(()), "{law:?}");
        for k in [3.0_f64.sqrt() * (1.0 + 1e-12), 2.0, 100.0] {
            let refused = law.check(&shear(k));
            let named = matches!(
                refused,
                Err(SolidsError::BeyondLimit { law, quantity: "I1 − 3", limit, .. }) if law == name && limit.to_bits() == 3.0_f64.to_bits()
            );
            assert!(named, "{refused:?}");
            assert!(law.energy(&shear(k)).is_nan());
            assert!(law.first_piola(&shear(k)).0.iter().any(|x| x.is_nan()));
            assert!(law.first_piola_tangent(&shear(k)).0.components.as_flattened().iter().any(|x| x.is_nan()));
        }
    }
    Ok(())
}

#[cfg(feature = "batch")]
#[test]
fn points_of_a_batch_beyond_the_limit_are_named_and_have_no_stress() -> Result<(), SolidsError> {
    use nalgebra::Matrix3;
    use piola_batch::Gradients;
    use piola_continuum::FirstPiola;
    use piola_solids::batch;

    fn check<L: Hyperelastic + Sync>(law: &L, name: &str) {
        let mut f = vec![Matrix3::new(1.0, 0.25, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0); 29];
        for index in [3, 17, 28] {
            f[index][(0, 1)] = 2.0;
        }
        let mut p = vec![FirstPiola::<f64>::zero(); f.len()];
        let Err(SolidsError::BadPoints { points, count: 29, .. }) =
            batch::evaluate(Gradients(&f[..]), batch::first_piola(law, &mut p[..]))
        else {
            panic!("bad points are expected")
        };
        assert_eq!(points.iter().map(|point| point.index).collect::<Vec<_>>(), [3, 17, 28]);
        for point in &points {
            let named = matches!(point.error, SolidsError::BeyondLimit { law, .. } if law == name);
            assert!(named && p[point.index].0.iter().all(|x| x.is_nan()), "{}", point.error);
        }
        assert!((0..29).filter(|k| ![3, 17, 28].contains(k)).all(|k| p[k].0.iter().all(|x| x.is_finite())));
    }
    check(&Compressible::new(ArrudaBoyce::new(1.0, 2.0)?, Quadratic::new(10.0)?), "Arruda–Boyce");
    check(&IncompressibleSolid::new(Gent::new(1.0, 3.0)?), "Gent");
    Ok(())
}

#[test]
fn change_of_volume_of_incompressible_laws_is_refused() -> Result<(), SolidsError> {
    let ball = DeformationGradient::dilatation(1.1).expect("positive");
    let ogden: AnySolid = IncompressibleOgden::new(&[OgdenTerm { modulus: 1.0, exponent: 2.0 }])?.into();
    for law in [ogden, IncompressibleSolid::new(Gent::new(1.0, 3.0)?).into()] {
        let refused = law.check(&ball);
        assert!(matches!(refused, Err(SolidsError::BeyondLimit { quantity: "|J − 1|", .. })), "{refused:?}");
    }
    Ok(())
}
