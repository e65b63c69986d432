//! One law of each kind in lanes and on all cores: the numbers of single points.

use piola_constitutive::solids::isochoric::{ArrudaBoyce, Gent};
use piola_constitutive::solids::volumetric::{Miehe, SimoTaylor};
use piola_constitutive::solids::{
    Compressible, EngineeringConstants, Fibre, Fung, Hencky, HolzapfelGasserOgden, Hyperelastic, IsochoricOgden,
    OgdenTerm, Stiffness,
};
use piola_constitutive::{ConstitutiveError, batch};
use piola_continuum::batch::BatchScalar;
use piola_continuum::{DeformationGradient, FirstPiola};
use piola_numerics::Real;
use piola_testkit::spectral::Random;
use piola_testkit::{Tol, assert_close_at_scale};

/// From 8192 points on a batch goes to all cores.
const MANY: usize = 8192 + 17;

/// Near the reference and far from it in turn, so that blocks of lanes hold both.
fn deformations<T: Real>(count: usize) -> Vec<DeformationGradient<T>> {
    let mut random = Random::new(5);
    let mut entry = |size: f64, r: usize, c: usize| if r == c { 1.0 } else { 0.0 } + size * random.symmetric();
    (0..count)
        .map(|i| {
            let size = [1e-3, 0.1, 0.3][i % 3];
            let matrix = nalgebra::Matrix3::from_fn(|r, c| T::lit(entry(size, r, c)));
            DeformationGradient::new(matrix).expect("0 < det F")
        })
        .collect()
}

/// Elementary functions of lanes are others than those of single values, within 2 ulp: stresses differ by some ulp of the
/// moduli.
fn compare<T: BatchScalar, L: Hyperelastic + Sync>(name: &str, law: &L, f: &[DeformationGradient<T>], tolerance: Tol) {
    let mut p = vec![FirstPiola::zero(); f.len()];
    batch::evaluate(f, batch::first_piola(law, &mut p[..])).expect("deformations of the law");
    for (i, (f, p)) in f.iter().zip(&p).enumerate() {
        let numbers = |p: &FirstPiola<T>| p.0.iter().map(|x| x.primal(0)).collect::<Vec<_>>();
        let alone = numbers(&law.first_piola(f));
        let size = alone.iter().fold(10.0_f64, |size, x| size.max(x.abs())); // the moduli are about 10
        assert_close_at_scale(&format!("P of {name}, point {i}"), &numbers(p), &alone, size, tolerance);
    }
}

#[test]
fn laws_of_each_kind_on_all_cores_equal_themselves_at_their_points() -> Result<(), ConstitutiveError> {
    let f = deformations::<f64>(MANY);
    let ulps = Tol::ulps(8.0);
    let terms = [(0.63, 1.3), (0.0012, 5.0), (-0.01, -2.0)].map(|(mu, alpha)| OgdenTerm { mu, alpha });
    let tissue = EngineeringConstants { young: [0.9, 0.5, 0.4], poisson: [0.3, 0.2, 0.25], shear: [0.2, 0.15, 0.3] };
    let fibres = [Fibre::in_plane(0.6)?, Fibre::in_plane(-0.6)?];
    compare("Gent", &Compressible::new(Gent::new(0.8, 30.0)?, SimoTaylor::new(5.0)?), &f, ulps);
    compare("Arruda–Boyce", &Compressible::new(ArrudaBoyce::new(0.8, 9.0)?, Miehe::new(5.0)?), &f, ulps);
    compare("Ogden", &IsochoricOgden::new(&terms, 10.0)?, &f, ulps);
    compare("Hencky", &Hencky::new(2.0, 0.9)?, &f, ulps);
    compare("Fung", &Fung::new(1.7, Stiffness::orthotropic(&tissue, &nalgebra::Matrix3::identity())?)?, &f, ulps);
    compare("wall", &HolzapfelGasserOgden::new(1.5, 20.0, 2.4, 0.8, 0.2, fibres)?, &f, ulps);
    Ok(())
}

#[test]
fn laws_of_single_precision_in_lanes_equal_themselves_at_their_points() -> Result<(), ConstitutiveError> {
    let f = deformations::<f32>(203);
    compare("Gent", &Compressible::new(Gent::new(0.8, 30.0)?, SimoTaylor::new(5.0)?), &f, Tol::ulps32(8.0));
    compare("Hencky", &Hencky::new(2.0, 0.9)?, &f, Tol::ulps32(8.0));
    Ok(())
}
