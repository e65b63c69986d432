//! The laws that are measured, with the parameters of the reference data where it has the law.

use std::error::Error;

use piola_constitutive::solids::{
    BlatzKo, Compressible, ElasticConstants, Fibre, Fung, Hencky, HolzapfelGasserOgden, Hyperelastic, IsochoricOgden,
    LinearElastic, MooneyRivlin, NeoHookeanCiarlet, NeoHookeanLogarithmic, Ogden, OgdenTerm, Polynomial,
    PolynomialTerm, ReinforcedNeoHookean, SaintVenantKirchhoff, Stiffness, isochoric, volumetric,
};
use piola_continuum::{Deformation, DeformationGradient, FirstPiola};
use piola_numerics::Real;
use piola_testkit::{DoubleDouble, golden, relative_error};

/// Something done with every law.
pub trait Visit {
    /// Called with each law, its name, and its name in the reference data where it is there.
    ///
    /// # Errors
    /// Its own.
    fn law<L: Hyperelastic + Sync>(
        &mut self,
        name: &'static str,
        model: Option<&'static str>,
        law: &L,
    ) -> Result<(), Box<dyn Error>>;
}

/// The compressible Mooney–Rivlin solid of the reference data.
///
/// # Errors
/// None: its parameters are within bounds.
pub fn mooney_rivlin() -> Result<MooneyRivlin, Box<dyn Error>> {
    Ok(MooneyRivlin::stress_free(0.5, 0.25, 1.25)?)
}

/// Visits all laws.
///
/// # Errors
/// Those of the visitor.
pub fn each(visit: &mut impl Visit) -> Result<(), Box<dyn Error>> {
    visit.law("mooney_rivlin", Some("mooney_rivlin_compressible"), &mooney_rivlin()?)?;
    visit.law("saint_venant_kirchhoff", Some("saint_venant_kirchhoff"), &SaintVenantKirchhoff::new(1.5, 0.75)?)?;
    visit.law("linear_elastic", None, &LinearElastic::new(ElasticConstants::from_lame(1.5, 0.75)?)?)?;
    let logarithmic = NeoHookeanLogarithmic::with_constants(0.8, 3.0)?;
    visit.law("neo_hookean_logarithmic", Some("neo_hookean_log"), &logarithmic)?;
    visit.law("neo_hookean_ciarlet", None, &NeoHookeanCiarlet::with_constants(0.8, 3.0)?)?;
    let bulk = volumetric::Quadratic::new(20.0)?;
    let isochoric = Compressible::new(isochoric::NeoHookean::new(0.8)?, bulk);
    visit.law("neo_hookean_isochoric", Some("neo_hookean_isochoric"), &isochoric)?;
    let rubber = Compressible::new(isochoric::MooneyRivlin::new(0.5, 0.25)?, bulk);
    visit.law("mooney_rivlin_isochoric", None, &rubber)?;
    visit.law("yeoh", None, &Compressible::new(isochoric::Yeoh::new(0.5, -0.02, 0.001)?, bulk))?;
    visit.law("gent", None, &Compressible::new(isochoric::Gent::new(1.0, 50.0)?, bulk))?;
    visit.law("arruda_boyce", None, &Compressible::new(isochoric::ArrudaBoyce::new(1.0, 8.0)?, bulk))?;
    let term = |first, second, third, coefficient| PolynomialTerm { first, second, third, coefficient };
    let terms =
        [(1, 0, 0, 0.5), (0, 1, 0, 0.25), (0, 0, 1, -1.0), (1, 1, 0, 0.125), (0, 0, 2, 0.75), (2, 0, 1, 0.0625)];
    let polynomial = Polynomial::stress_free(terms.map(|(r, s, t, c)| term(r, s, t, c)).to_vec())?;
    visit.law("polynomial", Some("polynomial"), &polynomial)?;
    visit.law("blatz_ko", None, &BlatzKo::new(1.0, 0.25, 0.5)?)?;
    let fibre = |x: f64, y: f64| Fibre::new([x, y, 0.0]);
    visit.law("reinforced_neo_hookean", None, &ReinforcedNeoHookean::new(1.0, 2.0, 3.0, fibre(0.6, 0.8)?)?)?;
    visit.law("fung", None, &Fung::new(1.0, Stiffness::isotropic(1.0, 2.0)?)?)?;
    let artery = HolzapfelGasserOgden::new(1.0, 20.0, 2.0, 0.8, 0.1, [fibre(0.6, 0.8)?, fibre(0.6, -0.8)?])?;
    visit.law("holzapfel_gasser_ogden", None, &artery)?;
    let term = |mu, alpha| OgdenTerm { mu, alpha };
    visit.law("ogden", Some("ogden_log"), &Ogden::new(&[term(1.2, 1.3), term(-0.3, -2.0)], 4.0)?)?;
    let three = IsochoricOgden::new(&[term(0.63, 1.3), term(0.0012, 5.0), term(-0.01, -2.0)], 10.0)?;
    visit.law("ogden_isochoric", Some("ogden_isochoric"), &three)?;
    visit.law("hencky", Some("hencky"), &Hencky::new(2.0, 0.9)?)
}

/// F and the expected P, by rows.
type Case = (DeformationGradient, Vec<f64>);

/// F and the expected P of the cases of a model near the identity.
///
/// # Errors
/// A case is no deformation.
pub fn near_identity(model: &str) -> Result<Vec<Case>, Box<dyn Error>> {
    let golden = golden::load("hyperelastic");
    let near = golden
        .cases
        .iter()
        .filter(|case| golden::text(&case["model"]) == model && golden::text(&case["id"]).contains("near_identity"));
    near.map(|case| {
        let rows = golden::matrix(&case["input"]["F"]);
        let f = DeformationGradient::from_rows(core::array::from_fn(|i| core::array::from_fn(|j| rows[i][j])))?;
        Ok((f, golden::matrix(&case["output"]["P"]).concat()))
    })
    .collect()
}

/// The largest relative error of P near the identity: to the reference data, or to 31 digits of the same law.
///
/// # Errors
/// As [`near_identity`].
pub fn error_near_identity<L: Hyperelastic>(model: Option<&str>, law: &L) -> Result<f64, Box<dyn Error>> {
    let mut largest = 0.0_f64;
    for (f, expected) in near_identity(model.unwrap_or("mooney_rivlin_compressible"))? {
        let expected = if model.is_some() {
            expected
        } else {
            let precise = law.first_piola(&f.lifted(|_, _, x| DoubleDouble::lit(x)));
            by_rows(&precise).iter().map(|x| x.primal(0)).collect()
        };
        largest = largest.max(relative_error(&by_rows(&law.first_piola(&f)), &expected));
    }
    Ok(largest)
}

fn by_rows<T: Real>(stress: &FirstPiola<T>) -> Vec<T> {
    stress.0.transpose().as_slice().to_vec()
}
