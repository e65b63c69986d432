//! Parameters that no law can have: each bound of each constructor, named by law, parameter and bound.

use nalgebra::{Matrix3, Matrix6};
use piola_solids::SolidsError;
use piola_solids::isochoric::{self, ArrudaBoyce, ArrudaBoyceSeries, Gent, Rivlin, RivlinTerm, Yeoh};
use piola_solids::memory::{Prony, PronyTerm, Scaled};
use piola_solids::volumetric::{
    HartmannNeff, Lame, Liu, Logarithmic, Miehe, OgdenVolumetric, Quadratic, QuadraticLogarithmic, SimoTaylor,
};
use piola_solids::{
    BlatzKo, Compressible, ElasticConstants, EngineeringConstants, Fibre, Fung, Hencky, HolzapfelGasserOgden,
    IncompressibleOgden, IncompressibleSolid, IsochoricOgden, LinearElastic, Membrane, MooneyRivlin, NeoHookean,
    NeoHookeanCiarlet, NeoHookeanLogarithmic, Ogden, OgdenTerm, Polynomial, PolynomialTerm, ReinforcedNeoHookean,
    SaintVenantKirchhoff, Stiffness, ThinPlate, TransverseConstants,
};

/// (law, parameter, bound) of a refusal.
fn refused<L>(result: Result<L, SolidsError>) -> (&'static str, &'static str, &'static str) {
    match result {
        Err(SolidsError::OutOfBounds { law, parameter, bound, .. }) => (law, parameter, bound),
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("accepted"),
    }
}

/// The parameter that is not finite.
fn infinite<L>(result: Result<L, SolidsError>) -> &'static str {
    match result {
        Err(SolidsError::NotFinite { parameter, .. }) => parameter,
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("accepted"),
    }
}

#[test]
fn bounds_of_energies_of_shape_are_named() {
    assert_eq!(refused(isochoric::NeoHookean::new(0.0)), ("isochoric neo-Hookean", "shear_modulus", "0 < μ"));
    let bound = "0 < C10 + C01";
    assert_eq!(refused(isochoric::MooneyRivlin::new(1.0, -1.0)), ("isochoric Mooney–Rivlin", "c10", bound));
    assert_eq!(refused(Yeoh::new(0.0, 1.0, 1.0)), ("Yeoh", "c1", "0 < C1"));
    assert_eq!(refused(Gent::new(0.0, 1.0)), ("Gent", "shear_modulus", "0 < μ"));
    assert_eq!(refused(Gent::new(1.0, 0.0)), ("Gent", "limit", "0 < Jm"));
    assert_eq!(refused(ArrudaBoyce::new(0.0, 2.0)), ("Arruda–Boyce", "rubbery_modulus", "0 < n"));
    assert_eq!(refused(ArrudaBoyce::new(1.0, 1.0)), ("Arruda–Boyce", "links", "1 < N"));
    assert_eq!(refused(ArrudaBoyceSeries::new(0.0, 2.0)), ("Arruda–Boyce series", "rubbery_modulus", "0 < n"));
    assert_eq!(refused(ArrudaBoyceSeries::new(1.0, 1.0)), ("Arruda–Boyce series", "links", "1 < N"));
    let term = |first, coefficient| RivlinTerm { first, second: 0, coefficient };
    assert_eq!(refused(Rivlin::new(vec![term(0, 1.0)])), ("Rivlin series", "degree", "0 < i + j"));
    assert_eq!(refused(Rivlin::new(vec![term(2, 1.0)])), ("Rivlin series", "C10 + C01", bound));
    assert_eq!(infinite(Rivlin::new(vec![term(1, f64::NAN)])), "coefficient");
    assert_eq!(infinite(Yeoh::new(1.0, f64::NAN, 0.0)), "c2");
    assert_eq!(infinite(Yeoh::new(1.0, 0.0, f64::INFINITY)), "c3");
}

#[test]
fn bounds_of_energies_of_volume_are_named() {
    let (parameter, bound) = ("bulk_modulus", "0 ≤ κ");
    assert_eq!(refused(Quadratic::new(-1.0)), ("quadratic volumetric energy", parameter, bound));
    assert_eq!(refused(Logarithmic::new(-1.0)), ("logarithmic volumetric energy", parameter, bound));
    let law = "quadratic–logarithmic volumetric energy";
    assert_eq!(refused(QuadraticLogarithmic::new(-1.0)), (law, parameter, bound));
    assert_eq!(refused(SimoTaylor::new(-1.0)), ("Simo–Taylor volumetric energy", parameter, bound));
    assert_eq!(refused(Liu::new(-1.0)), ("Liu volumetric energy", parameter, bound));
    assert_eq!(refused(Miehe::new(-1.0)), ("Miehe volumetric energy", parameter, bound));
    assert_eq!(refused(HartmannNeff::new(-1.0)), ("Hartmann–Neff volumetric energy", parameter, bound));
    assert_eq!(refused(OgdenVolumetric::new(-1.0, 1.0)), ("Ogden volumetric energy", parameter, bound));
    let bound = "0 < |β|, κ/β² finite";
    assert_eq!(refused(OgdenVolumetric::new(1.0, 0.0)), ("Ogden volumetric energy", "exponent", bound));
    assert_eq!(infinite(Lame::new(f64::NAN)), "first_lame_parameter");
}

#[test]
fn bounds_of_laws_of_invariants_are_named() {
    assert_eq!(refused(MooneyRivlin::new(1.0, -1.0, 1.0, 1.0)), ("Mooney–Rivlin", "C10", "0 < C10 + C01"));
    assert_eq!(refused(MooneyRivlin::stress_free(1.0, 1.0, -1.0)), ("Mooney–Rivlin", "square_coefficient", "0 ≤ c"));
    assert_eq!(infinite(MooneyRivlin::new(1.0, 1.0, 1.0, f64::NAN)), "logarithm_coefficient");
    assert_eq!(refused(NeoHookeanLogarithmic::with_constants(0.0, 1.0)), ("neo-Hookean", "shear_modulus", "0 < μ"));
    let negative = ("logarithmic volumetric energy", "bulk_modulus", "0 ≤ κ");
    assert_eq!(refused(NeoHookeanLogarithmic::with_constants(1.0, -1.0)), negative);
    let negative = ("Simo–Taylor volumetric energy", "bulk_modulus", "0 ≤ κ");
    assert_eq!(refused(NeoHookeanCiarlet::with_constants(1.0, -1.0)), negative);
    let soft = Lame::new(-1.0).expect("finite");
    let shape = isochoric::NeoHookean::new(1.0).expect("μ");
    assert_eq!(refused(Compressible::checked(shape, soft)), ("compressible", "U″(1)", "0 ≤ U″(1)"));
    assert_eq!(refused(NeoHookean::new(1.0, soft)), ("neo-Hookean", "U″(1)", "0 < U″(1) + ⅔ μ"));
    for nu in [-0.1, 0.5] {
        assert_eq!(refused(BlatzKo::new(1.0, nu, 0.5)), ("Blatz–Ko", "poisson_ratio", "0 ≤ ν < ½"));
    }
    assert_eq!(refused(BlatzKo::foam(0.0)), ("Blatz–Ko", "shear_modulus", "0 < μ"));
    for share in [-0.1, 1.1] {
        assert_eq!(refused(BlatzKo::new(1.0, 0.2, share)), ("Blatz–Ko", "solid_fraction", "0 ≤ f ≤ 1"));
    }
    let term = |first, coefficient| PolynomialTerm { first, second: 0, third: 0, coefficient };
    assert_eq!(refused(Polynomial::new(vec![term(0, 1.0)])), ("polynomial", "degree", "0 < r + s + t"));
    assert_eq!(infinite(Polynomial::new(vec![term(1, f64::NAN)])), "coefficient");
    assert_eq!(refused(Polynomial::new(vec![])), ("polynomial", "terms", "0 < number of terms"));
    let soft = ("polynomial", "C100 + C010", "0 < C100 + C010 (half the shear modulus)");
    assert_eq!(refused(Polynomial::saint_venant_kirchhoff(5.0, -1.0)), soft);
    let hollow = ("polynomial", "∂²W/∂J²", "0 ≤ ∂²W/∂J² of a dilatation");
    assert_eq!(refused(Polynomial::saint_venant_kirchhoff(-0.7, 1.0)), hollow); // λ + ⅔ μ < 0
    assert!(Polynomial::saint_venant_kirchhoff(-2.0 / 3.0, 1.0).is_ok());
    let bound = "C100 + 2 C010 + C001 = 0";
    assert_eq!(refused(Polynomial::stress_free(vec![term(1, 1.0)])), ("polynomial", "C100 + 2 C010 + C001", bound));
    assert_eq!(refused(SaintVenantKirchhoff::new(0.0, 0.0)).1, "first_lame_parameter");
    assert_eq!(refused(SaintVenantKirchhoff::new(1.0, 0.0)), ("St. Venant–Kirchhoff", "shear_modulus", "0 < μ"));
    let solid = IncompressibleSolid::new(Gent::new(1.0, 1.0).expect("bounds"));
    assert_eq!((infinite(solid.at_pressure(f64::NAN)), infinite(solid.at_excess_pressure(f64::INFINITY))), ("p", "q"));
}

/// A constructor from terms.
type Make = fn(&[OgdenTerm]) -> Result<(), SolidsError>;

#[test]
fn bounds_of_laws_of_stretches_are_named() {
    let term = |mu: f64, alpha: f64| OgdenTerm { modulus: mu, exponent: alpha };
    let volume = Lame::new(-10.0).expect("finite");
    let made: [(&str, Make); 3] = [
        ("Ogden", |terms| Ogden::new(terms, 1.0).map(|_| ())),
        ("isochoric Ogden", |terms| IsochoricOgden::new(terms, 1.0).map(|_| ())),
        ("incompressible Ogden", |terms| IncompressibleOgden::new(terms).map(|_| ())),
    ];
    for (law, make) in made {
        let bound = "1 ≤ number of terms ≤ 8";
        assert_eq!(refused(make(&[])), (law, "terms", bound));
        assert_eq!(refused(make(&[term(1.0, 2.0); 9])), (law, "terms", bound));
        assert_eq!(refused(make(&[term(1.0, 0.0)])), (law, "exponent", "α ≠ 0"));
        assert_eq!(refused(make(&[term(1.0, -2.0)])), (law, "½ Σ μ α", "0 < ½ Σ μ α"));
        assert_eq!(infinite(make(&[term(f64::NAN, 2.0)])), "modulus");
        assert_eq!(infinite(make(&[term(1.0, f64::INFINITY)])), "exponent");
    }
    let terms = [term(1.0, 2.0)];
    assert_eq!(refused(Ogden::new(&terms, -1.0)), ("Ogden", "first_lame_parameter", "0 < λ + ⅓ Σ μ α"));
    let bound = "0 < U″(1) + ⅓ Σ μ α";
    assert_eq!(refused(Ogden::with_volumetric(&terms, volume)), ("Ogden", "U″(1)", bound));
    assert_eq!(refused(IsochoricOgden::new(&terms, -1.0)), ("isochoric Ogden", "bulk_modulus", "0 ≤ κ"));
    let bound = "0 ≤ U″(1)";
    assert_eq!(refused(IsochoricOgden::with_volumetric(&terms, volume)), ("isochoric Ogden", "U″(1)", bound));
    let rubber = IncompressibleOgden::new(&terms).expect("bounds");
    assert_eq!((infinite(rubber.at_pressure(f64::NAN)), infinite(rubber.at_excess_pressure(f64::NAN))), ("p", "q"));
    assert_eq!(refused(Hencky::new(1.0, 0.0)), ("Hencky", "shear_modulus", "0 < μ"));
    assert_eq!(refused(Hencky::new(-1.0, 1.0)), ("Hencky", "first_lame_parameter", "0 < λ + ⅔ μ"));
    assert_eq!(refused(Hencky::with_volumetric(1.0, volume)), ("Hencky", "U″(1)", "0 < U″(1) + ⅔ μ"));
    assert_eq!(infinite(Hencky::with_volumetric(f64::NAN, volume)), "shear_modulus");
}

#[test]
fn bounds_of_laws_with_fibres_are_named() {
    let fibre = Fibre::new([1.0, 0.0, 0.0]).expect("direction");
    assert_eq!(refused(Fibre::new([0.0; 3])), ("fibre", "direction", "0 < |direction|"));
    assert_eq!(infinite(Fibre::new([f64::NAN, 0.0, 0.0])), "direction");
    assert_eq!(infinite(Fibre::in_plane(f64::INFINITY)), "angle");
    let law = "reinforced neo-Hookean";
    assert_eq!(refused(ReinforcedNeoHookean::new(0.0, 1.0, 1.0, fibre)), (law, "shear_modulus", "0 < μ"));
    assert_eq!(refused(ReinforcedNeoHookean::new(1.0, -1.0, 1.0, fibre)), (law, "first_lame_parameter", "0 < λ + ⅔ μ"));
    assert_eq!(refused(ReinforcedNeoHookean::new(1.0, 1.0, -1.0, fibre)), (law, "fibre_modulus", "0 ≤ k"));
    let law = "Holzapfel–Gasser–Ogden";
    let wall = |mu, kappa, k1, k2, d| HolzapfelGasserOgden::new(mu, kappa, k1, k2, d, [fibre; 2]);
    assert_eq!(refused(wall(0.0, 1.0, 1.0, 1.0, 0.0)), (law, "shear_modulus", "0 < μ"));
    assert_eq!(refused(wall(1.0, -1.0, 1.0, 1.0, 0.0)), (law, "bulk_modulus", "0 ≤ κ"));
    assert_eq!(refused(wall(1.0, 1.0, -1.0, 1.0, 0.0)), (law, "fibre_modulus", "0 ≤ k1"));
    assert_eq!(refused(wall(1.0, 1.0, 1.0, 0.0, 0.0)), (law, "fibre_exponent", "0 < k2"));
    for dispersion in [-0.1, 0.34] {
        assert_eq!(refused(wall(1.0, 1.0, 1.0, 1.0, dispersion)), (law, "dispersion", "0 ≤ dispersion ≤ 1/3"));
    }
    let stiffness = Stiffness::isotropic(1.0, 1.0).expect("bounds");
    assert_eq!(refused(Fung::new(0.0, stiffness)), ("Fung", "modulus", "0 < c"));
}

#[test]
fn bounds_of_stiffness_and_linear_laws_are_named() {
    let law = "stiffness";
    let axes = Matrix3::identity();
    assert_eq!(refused(Stiffness::isotropic(1.0, 0.0)), (law, "shear_modulus", "0 < μ"));
    assert_eq!(refused(Stiffness::isotropic(-1.0, 1.0)), (law, "first_lame_parameter", "0 < λ + ⅔ μ"));
    assert_eq!(refused(Stiffness::cubic(2.0, 1.0, 0.0, &axes)), (law, "c44", "0 < c44"));
    assert_eq!(refused(Stiffness::cubic(1.0, 1.0, 1.0, &axes)), (law, "c12", "c12 < c11"));
    assert_eq!(refused(Stiffness::cubic(1.0, -0.5, 1.0, &axes)), (law, "c11", "0 < c11 + 2 c12"));
    let wood = EngineeringConstants { young: [12.0, 1.0, 0.5], poisson: [0.3, 0.2, 0.25], shear: [0.8, 0.1, 0.7] };
    let orthotropic = |constants: &EngineeringConstants| refused(Stiffness::orthotropic(constants, &axes));
    for (k, parameter) in ["E1", "E2", "E3"].into_iter().enumerate() {
        let mut bad = wood;
        bad.young[k] = 0.0;
        assert_eq!(orthotropic(&bad), (law, parameter, "0 < E"));
    }
    for (k, parameter) in ["G12", "G23", "G13"].into_iter().enumerate() {
        let mut bad = wood;
        bad.shear[k] = -1.0;
        assert_eq!(orthotropic(&bad), (law, parameter, "0 < G"));
    }
    let names = [("nu12", "nu12² < E1/E2"), ("nu23", "nu23² < E2/E3"), ("nu13", "nu13² < E1/E3")];
    for (k, (parameter, bound)) in names.into_iter().enumerate() {
        let mut bad = wood;
        bad.poisson[k] = 5.0;
        assert_eq!(orthotropic(&bad), (law, parameter, bound));
    }
    let bad = EngineeringConstants { young: [1.0; 3], poisson: [0.6; 3], shear: [1.0; 3] };
    assert_eq!(orthotropic(&bad).1, "determinant of the compliance");
    let fibre = Fibre::new([0.0, 0.0, 1.0]).expect("direction");
    let ply = TransverseConstants {
        young_along: 8.0,
        young_across: 1.5,
        poisson_along: 0.3,
        poisson_across: 0.45,
        shear_along: 0.6,
    };
    let transverse = |constants: TransverseConstants| refused(Stiffness::transversely_isotropic(&constants, fibre));
    assert_eq!(transverse(TransverseConstants { young_along: 0.0, ..ply }), (law, "young_along", "0 < E_a"));
    assert_eq!(transverse(TransverseConstants { young_across: 0.0, ..ply }), (law, "young_across", "0 < E_t"));
    assert_eq!(transverse(TransverseConstants { shear_along: 0.0, ..ply }), (law, "shear_along", "0 < G_at"));
    let bound = "−1 < nu_tt < 1";
    assert_eq!(transverse(TransverseConstants { poisson_across: 1.0, ..ply }), (law, "poisson_across", bound));
    let bound = "2 nu_at² < (1 − nu_tt) E_a/E_t";
    assert_eq!(transverse(TransverseConstants { poisson_along: 2.0, ..ply }), (law, "poisson_along", bound));
    let soft = Matrix6::from_diagonal(&[1.0, 1.0, 1.0, 1.0, -1.0, 1.0].into());
    assert_eq!(refused(Stiffness::from_matrix(&soft)), (law, "pivot of C", "0 < A : C : A"));
    let rubber = ElasticConstants::incompressible(1.0).expect("bounds");
    assert_eq!(refused(LinearElastic::new(rubber)), ("linear elastic", "poisson_ratio", "ν < ½"));
    assert_eq!(refused(Membrane::new(0.0)), ("membrane", "tension", "0 < τ"));
    assert_eq!(refused(ThinPlate::new(-1.0)), ("thin plate", "stiffness", "0 < D"));
}

#[test]
fn bounds_of_series_of_relaxation_and_of_shares_are_named() {
    let term = |weight, time| Prony::new(vec![PronyTerm { weight, time }]);
    assert_eq!(refused(term(-0.1, 1.0)), ("Prony series", "weight", "0 ≤ weight"));
    assert_eq!(refused(term(0.1, 0.0)), ("Prony series", "time", "0 < time"));
    assert_eq!(infinite(term(f64::NAN, 1.0)), "weight");
    assert_eq!(infinite(term(0.1, f64::INFINITY)), "time");
    assert_eq!(refused(Scaled::new((), -1.0)), ("a share of a law", "factor", "0 ≤ factor"));
}
