//! What laws refuse at the ends of the range of numbers and of their validity, in each scalar.

use nalgebra::Matrix3;
use piola_continuum::DeformationGradient;
use piola_numerics::{Dual, Real};
use piola_solids::SolidsError;
use piola_solids::isochoric::{ArrudaBoyce, Gent, Isochoric, inverse_langevin};
use piola_solids::volumetric::{OgdenVolumetric, Quadratic};
use piola_solids::{
    AnisotropicLinear, BlatzKo, Compressible, ElasticConstants, Fibre, Fung, HolzapfelGasserOgden, Hyperelastic,
    IncompressibleOgden, IsochoricOgden, LinearElastic, MooneyRivlin, Ogden, OgdenTerm, Stiffness, derived,
};
use piola_testkit::{Tol, assert_close};

use super::once::Once;

fn shear(k: f64) -> DeformationGradient {
    DeformationGradient::simple_shear(k).expect("finite")
}

/// Beyond its limit no derivative of a law is a number, whatever it is derived from.
fn nowhere_a_number(name: &str, law: &impl Hyperelastic, deformation: &DeformationGradient) {
    let law = &Once(law);
    assert!(law.check(deformation).is_err(), "{name}");
    assert!(law.energy(deformation).is_nan(), "{name}: W");
    for (what, stress) in
        [("closed", law.first_piola(deformation)), ("derived", derived::first_piola(law, deformation))]
    {
        assert!(stress.0.iter().all(|x| x.is_nan()), "{name}: {what} P = {:?}", stress.0);
    }
    let tangent = derived::first_piola_tangent(law, deformation).0.components;
    assert!(tangent.as_flattened().iter().all(|x| x.is_nan()), "{name}: derived ∂P/∂F");
    let along = law.first_piola_derivative(deformation, &Matrix3::identity());
    assert!(along.0.iter().all(|x| x.is_nan()), "{name}: derivative of P");
}

#[test]
fn derivatives_beyond_a_limiting_stretch_are_no_numbers() {
    let bulk = Quadratic::new(10.0).expect("κ");
    let gent = Compressible::new(Gent::new(2.0, 4.0).expect("bounds"), bulk);
    let chains = ArrudaBoyce::new(2.0, 2.0).expect("bounds");
    let chains_in_a_solid = Compressible::new(chains, bulk);
    for k in [2.1, 3.0, 10.0] {
        nowhere_a_number("Gent", &gent, &shear(k));
        nowhere_a_number("Arruda–Boyce", &chains_in_a_solid, &shear(k));
    }
    let energy = chains.energy(Dual::variable(3.5), Dual::constant(0.0));
    assert!(energy.value.is_nan() && energy.tangent.is_nan());
    let beta = inverse_langevin(Dual::variable(1.5_f64));
    assert!(beta.value.is_nan() && beta.tangent.is_nan());
    // Below the limit nothing has changed.
    assert!(inverse_langevin(Dual::variable(0.5_f64)).tangent.is_finite());
}

/// Along a path of F that leaves every range: where `check` admits F, all answers are finite.
fn finite_where_admitted<T: Real>(name: &str, law: &impl Hyperelastic, stretch: T) -> bool {
    let o = T::zero();
    let rows = [[stretch, o, o], [o, T::one() / stretch, o], [o, o, T::one()]];
    let Ok(deformation) = DeformationGradient::from_rows(rows) else { return false };
    if law.check(&deformation).is_err() {
        return false;
    }
    let (stress, tangent) = law.first_piola_and_tangent(&deformation);
    let all = stress.0.iter().chain(tangent.0.components.as_flattened()).all(|x| x.primal(0).is_finite());
    let stretch = stretch.primal(0);
    assert!(all && law.energy(&deformation).primal(0).is_finite(), "{name} at {stretch}: {:?}", stress.0);
    true
}

fn range_ends(name: &str, law: &impl Hyperelastic, admitted: [f64; 2], refused: f64) {
    let law = &Once(law);
    let mut stretch = 1.0;
    while stretch < refused {
        // The end of each path is admitted or refused, but never infinite.
        finite_where_admitted::<f64>(name, law, stretch);
        #[expect(clippy::cast_possible_truncation, reason = "the same path in single precision")]
        finite_where_admitted::<f32>(name, law, stretch as f32);
        stretch *= 1.01;
    }
    assert!(finite_where_admitted::<f64>(name, law, admitted[0]), "{name}: {} in f64", admitted[0]);
    #[expect(clippy::cast_possible_truncation, reason = "the same path in single precision")]
    let single = finite_where_admitted::<f32>(name, law, admitted[1] as f32);
    assert!(single, "{name}: {} in f32", admitted[1]);
    assert!(!finite_where_admitted::<f64>(name, law, refused), "{name}: {refused}");
}

#[test]
fn exponentials_are_refused_before_they_leave_the_range_of_the_scalar() {
    let exponents = Stiffness::isotropic(0.0, 0.5).expect("definite");
    // Q = E : E; Q = 600 at λ = 7.06, 70 at 4.2.
    range_ends("Fung", &Fung::new(2.0, exponents).expect("c"), [6.5, 3.0], 9.0);
    range_ends("Fung, stiff", &Fung::new(1e9, exponents).expect("c"), [6.5, 3.0], 9.0);
    nowhere_a_number("Fung", &Fung::new(2.0, exponents).expect("c"), &shear(9.0));
    // Q = 1: the factor beside e^Q, not Q, leaves the range.
    let bar = DeformationGradient::diagonal([3.0_f64.sqrt(), 1.0, 1.0]).expect("positive");
    nowhere_a_number("Fung, rigid", &Fung::new(5e305, exponents).expect("c"), &bar);
    let fibres = [Fibre::new([1.0, 0.0, 0.0]).expect("fibre"), Fibre::new([0.0, 1.0, 0.0]).expect("fibre")];
    let wall = HolzapfelGasserOgden::new(1e4, 1e5, 1e5, 1.0, 0.0, fibres).expect("parameters");
    range_ends("wall", &wall, [4.5, 2.5], 6.0);
    let steep = [OgdenTerm { modulus: 1e-2, exponent: 400.0 }];
    range_ends("Ogden", &Ogden::new(&steep, 1.0).expect("terms"), [2.0, 1.05], 8.0);
    range_ends("isochoric Ogden", &IsochoricOgden::new(&steep, 1.0).expect("terms"), [2.0, 1.05], 8.0);
    range_ends("incompressible Ogden", &IncompressibleOgden::new(&steep).expect("terms"), [2.0, 1.05], 8.0);
    let usual = [OgdenTerm { modulus: 0.6, exponent: 1.3 }, OgdenTerm { modulus: -0.01, exponent: -2.0 }];
    let usual = Ogden::new(&usual, 1.0).expect("terms");
    assert!(
        finite_where_admitted::<f64>("Ogden", &Once(&usual), 1e6)
            && finite_where_admitted::<f32>("Ogden", &Once(&usual), 1e3)
    );
    let refused = Ogden::new(&steep, 1.0).expect("terms").check(&shear(8.0));
    assert!(matches!(refused, Err(SolidsError::BeyondLimit { law: "Ogden", .. })), "{refused:?}");
}

#[test]
fn nearly_incompressible_foam_is_refused_beyond_the_range() {
    let law = BlatzKo::new(2.0, 0.499_999_999_999_999_94, 0.5).expect("ν < ½");
    let swollen = DeformationGradient::dilatation(1.1_f64).expect("positive");
    let refused = law.check(&swollen);
    assert!(matches!(refused, Err(SolidsError::BeyondLimit { quantity: "2 β |ln J|", .. })), "{refused:?}");
    for j in [1.1_f64, 0.9] {
        nowhere_a_number("Blatz–Ko", &law, &DeformationGradient::dilatation(j).expect("positive"));
    }
    // A modulus of the range's size leaves less room for the power.
    let rigid = BlatzKo::new(1e300, 0.25, 0.5).expect("bounds");
    nowhere_a_number("rigid", &rigid, &DeformationGradient::dilatation(1e7).expect("positive"));
    assert!(finite_where_admitted::<f64>("rigid", &Once(&rigid), 2.0));
    assert_eq!(law.check(&shear(0.5)), Ok(()));
    assert!(law.first_piola(&shear(0.5)).0.iter().all(|x| x.is_finite()));
    assert_eq!(BlatzKo::foam(2.0).expect("μ").check(&swollen), Ok(()));
}

#[test]
fn unstable_references_are_refused() {
    let named = |law: Result<MooneyRivlin, SolidsError>| match law {
        Err(
            SolidsError::OutOfBounds { law: "compressible Mooney–Rivlin" | "Mooney–Rivlin", parameter, .. }
            | SolidsError::NotFinite { parameter, .. },
        ) => parameter,
        other => panic!("{other:?}"),
    };
    // λ = −6, μ = 1.
    assert_eq!(named(MooneyRivlin::stress_free(2.0, -1.5, 0.0)), "square_coefficient");
    // 0 < K = 4/3 + 0.4, but d = −0.2: W → −∞ as J → 0.
    assert_eq!(named(MooneyRivlin::stress_free(2.3, -1.3, 0.2 + 1.2 - 1.2)), "square_coefficient");
    assert_eq!(named(MooneyRivlin::stress_free(1.0, 1.0, 1e308)), "logarithm_coefficient");
    assert!(MooneyRivlin::stress_free(0.5, -0.1, 0.2).is_ok());
}

#[test]
fn constants_that_overflow_are_refused() {
    for refused in [
        ElasticConstants::from_young_poisson(1e300, 0.5 - 1e-16),
        ElasticConstants::from_shear_poisson(1e300, 0.5 - 1e-16),
        ElasticConstants::from_lame(1e308, 1e308),
    ] {
        assert!(matches!(refused, Err(SolidsError::NotFinite { .. })), "{refused:?}");
    }
    assert!(ElasticConstants::from_young_poisson(1e9, 0.5 - 1e-16).is_ok());
    assert!(OgdenVolumetric::new(1.0, 1e-200).is_err());
    assert!(OgdenVolumetric::new(1.0, 1e-3).is_ok());
}

#[test]
fn linear_elasticity_is_one_law_however_it_is_told() {
    let constants = ElasticConstants::from_lame(1.0, 1.0).expect("constants");
    let law = LinearElastic::new(constants).expect("ν < ½");
    let told = AnisotropicLinear::new(Stiffness::isotropic(1.0, 1.0).expect("definite"));
    let f = DeformationGradient::from_rows([[1.2, 0.1, 0.0], [0.0, 0.9, 0.0], [0.0, 0.0, 1.0]]).expect("F");
    let tolerance = Tol::ulps(16.0);
    let expected = told.cauchy(&f).0.components;
    assert_close("T₁₁ = (λ + 2μ) ε₁₁ + λ ε₂₂", &expected[..1], &[0.5], tolerance);
    assert_close("T", &law.cauchy(&f).0.components, &expected, tolerance);
    assert_close("τ", &law.kirchhoff(&f).0.components, &expected, tolerance);
    assert_close("S", &law.second_piola(&f).0.components, &expected, tolerance);
    assert_close("P", law.first_piola(&f).0.as_slice(), told.first_piola(&f).0.as_slice(), tolerance);
    let (one, other) = (law.material_tangent(&f).0, told.material_tangent(&f).0);
    assert_close("∂S/∂E", &one.components, &other.components, tolerance);
    let (one, other) = (law.truesdell_tangent(&f), told.truesdell_tangent(&f));
    for i in 0..3 {
        for j in 0..3 {
            assert_close("c/J", &[one.entry(i, i, j, j)], &[other.entry(i, i, j, j)], tolerance);
        }
    }
    // The stress of the golden file is the one that the law answers with.
    let strain = piola_continuum::strain::LinearStrain::of(&f);
    assert_close("T of ε", &law.stress(&strain).0.components, &law.cauchy(&f).0.components, tolerance);
}
