//! The laws that are measured, with the parameters of the reference data where it has the law.

use std::error::Error;

use nalgebra::Matrix3;
use piola_batch::{Components, Gradients, LaneBlocks};
use piola_continuum::{Deformation, DeformationGradient, FirstPiola};
use piola_numerics::Real;
use piola_solids::batch;
use piola_solids::isochoric::RivlinTerm;
use piola_solids::{
    AnisotropicLinear, AnisotropicSaintVenantKirchhoff, BlatzKo, Compressible, ElasticConstants, EngineeringConstants,
    Fibre, Fung, Hencky, HolzapfelGasserOgden, Hyperelastic, IncompressibleOgden, IncompressibleSolid, IsochoricOgden,
    LinearElastic, MooneyRivlin, MooneyRivlinIsochoric, NeoHookeanCiarlet, NeoHookeanLogarithmic, Ogden, OgdenTerm,
    Polynomial, PolynomialTerm, Pressurised, ReinforcedNeoHookean, SaintVenantKirchhoff, Stiffness,
    TransverseConstants, isochoric, volumetric,
};
use piola_testkit::{DoubleDouble, golden, relative_error};

use super::naive::{Naive, Textbook};

/// Something done with every law.
pub trait Visit {
    /// Called with each law, its name, and its name in the reference data where it is there.
    ///
    /// # Errors
    /// Its own.
    fn law<L: Hyperelastic + Textbook + Sync>(
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

/// The Mooney–Rivlin solid of a change of shape.
///
/// # Errors
/// None: its parameters are within bounds.
pub fn mooney_rivlin_isochoric() -> Result<MooneyRivlinIsochoric, Box<dyn Error>> {
    Ok(Compressible::new(isochoric::MooneyRivlin::new(0.5, 0.25)?, volumetric::Quadratic::new(20.0)?))
}

/// Three terms of Ogden's for a change of shape.
///
/// # Errors
/// None: its parameters are within bounds.
pub fn ogden_isochoric() -> Result<IsochoricOgden, Box<dyn Error>> {
    let term = |modulus, exponent| OgdenTerm { modulus, exponent };
    Ok(IsochoricOgden::new(&[term(0.63, 1.3), term(0.0012, 5.0), term(-0.01, -2.0)], 10.0)?)
}

/// Visits all laws that take any change of volume.
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
    visit.law("mooney_rivlin_isochoric", None, &mooney_rivlin_isochoric()?)?;
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
    let term = |modulus, exponent| OgdenTerm { modulus, exponent };
    visit.law("ogden", Some("ogden_log"), &Ogden::new(&[term(1.2, 1.3), term(-0.3, -2.0)], 4.0)?)?;
    visit.law("ogden_isochoric", Some("ogden_isochoric"), &ogden_isochoric()?)?;
    visit.law("hencky", Some("hencky"), &Hencky::new(2.0, 0.9)?)?;
    let term = |first, second, coefficient| RivlinTerm { first, second, coefficient };
    let series = isochoric::Rivlin::new(vec![term(1, 0, 0.5), term(0, 1, 0.25), term(1, 1, 0.0125), term(2, 0, 0.01)])?;
    visit.law("rivlin", None, &Compressible::new(series, bulk))?;
    let wood = EngineeringConstants { young: [8.0, 4.0, 2.0], poisson: [0.3, 0.25, 0.2], shear: [1.5, 1.0, 0.75] };
    let orthotropic = Stiffness::orthotropic(&wood, &Matrix3::identity())?;
    visit.law("orthotropic_linear", None, &AnisotropicLinear::new(orthotropic))?;
    let ply = TransverseConstants {
        young_along: 8.0,
        young_across: 2.0,
        poisson_along: 0.3,
        poisson_across: 0.4,
        shear_along: 1.0,
    };
    let transverse = Stiffness::transversely_isotropic(&ply, fibre(0.6, 0.8)?)?;
    visit.law("transversely_isotropic_linear", None, &AnisotropicLinear::new(transverse))?;
    visit.law("orthotropic_saint_venant_kirchhoff", None, &AnisotropicSaintVenantKirchhoff::new(orthotropic))
}

/// Visits incompressible laws, whose pressure is given: their deformations keep the volume.
///
/// # Errors
/// Those of the visitor.
pub fn each_incompressible(visit: &mut impl Visit) -> Result<(), Box<dyn Error>> {
    visit.law("incompressible_mooney_rivlin", None, &incompressible_mooney_rivlin()?.at_excess_pressure(0.25)?)?;
    let term = |modulus, exponent| OgdenTerm { modulus, exponent };
    let three = IncompressibleOgden::new(&[term(0.63, 1.3), term(0.0012, 5.0), term(-0.01, -2.0)])?;
    visit.law("incompressible_ogden", None, &three.at_excess_pressure(0.25)?)?;
    visit.law("pressurised_hencky", None, &Pressurised::new(Hencky::new(2.0, 0.9)?).at_pressure(0.25)?)
}

/// The incompressible Mooney–Rivlin solid.
///
/// # Errors
/// None: its parameters are within bounds.
pub fn incompressible_mooney_rivlin() -> Result<IncompressibleSolid<isochoric::MooneyRivlin>, Box<dyn Error>> {
    Ok(IncompressibleSolid::new(isochoric::MooneyRivlin::new(0.5, 0.25)?))
}

/// det F^(−1/3) F, within rounding.
///
/// # Errors
/// None: it is a deformation as the given one is.
pub fn unimodular(deformation: &DeformationGradient) -> Result<DeformationGradient, Box<dyn Error>> {
    let f = deformation.matrix();
    Ok(DeformationGradient::new(f / f.determinant().cbrt())?)
}

/// F and the expected P and ∂P/∂F, by rows.
#[derive(Clone, Debug)]
pub struct Case {
    /// F.
    pub gradient: DeformationGradient,
    /// P, 9 entries.
    pub stress: Vec<f64>,
    /// ∂P/∂F, 81 entries.
    pub tangent: Vec<f64>,
}

/// The cases of a model near the identity that have the parameters of the first of them: those of [`each`].
///
/// # Errors
/// A case is no deformation.
pub fn near_identity(model: &str) -> Result<Vec<Case>, Box<dyn Error>> {
    let golden = golden::load("hyperelastic");
    let of_model = |case: &&serde_json::Value| {
        golden::text(&case["model"]) == model && golden::text(&case["id"]).contains("near_identity")
    };
    let first = golden.cases.iter().find(of_model).map(|case| &case["params"]);
    let near = golden.cases.iter().filter(of_model).filter(|case| Some(&case["params"]) == first);
    near.map(|case| {
        let rows = golden::matrix(&case["input"]["F"]);
        Ok(Case {
            gradient: DeformationGradient::from_rows(core::array::from_fn(|i| core::array::from_fn(|j| rows[i][j])))?,
            stress: golden::matrix(&case["output"]["P"]).concat(),
            tangent: golden::matrix(&case["output"]["dP_dF"]).concat(),
        })
    })
    .collect()
}

/// The cases near the identity with P and ∂P/∂F of the reference data, or of 31 digits of the same law; of an incompressible law
/// they keep the volume.
fn truths<L: Hyperelastic>(model: Option<&str>, law: &L) -> Result<Vec<Case>, Box<dyn Error>> {
    let mut cases = near_identity(model.unwrap_or("mooney_rivlin_compressible"))?;
    if model.is_none() {
        for case in &mut cases {
            if law.is_incompressible() {
                case.gradient = unimodular(&case.gradient)?;
            }
            let precise = case.gradient.lifted(|_, _, x| DoubleDouble::lit(x));
            let tangent = law.first_piola_tangent(&precise).0.components;
            case.stress = by_rows(&law.first_piola(&precise)).iter().map(|x| x.primal(0)).collect();
            case.tangent = tangent.as_flattened().iter().map(|x| x.primal(0)).collect();
        }
    }
    Ok(cases)
}

/// The largest relative errors of P and of ∂P/∂F near the identity: to the reference data, or to 31 digits of the same
/// law.
///
/// # Errors
/// As [`near_identity`].
pub fn errors_near_identity<L: Hyperelastic>(model: Option<&str>, law: &L) -> Result<[f64; 2], Box<dyn Error>> {
    answered_errors_near_identity(model, law, |f| {
        Ok([by_rows(&law.first_piola(f)), law.first_piola_tangent(f).0.components.concat()])
    })
}

/// The same of the law's formula from a textbook.
///
/// # Errors
/// As [`near_identity`].
pub fn textbook_errors_near_identity<L: Hyperelastic>(
    model: Option<&str>,
    law: &L,
    naive: &impl Naive,
) -> Result<[f64; 2], Box<dyn Error>> {
    answered_errors_near_identity(model, law, |f| {
        let (stress, tangent) = (naive.first_piola(f.matrix()), naive.first_piola_tangent(f.matrix()));
        Ok([stress.transpose().as_slice().to_vec(), tangent.transpose().as_slice().to_vec()])
    })
}

/// The same of P and ∂P/∂F, by rows, from anywhere.
///
/// # Errors
/// As [`near_identity`], and those of the answers.
pub fn answered_errors_near_identity<L: Hyperelastic>(
    model: Option<&str>,
    law: &L,
    answers: impl Fn(&DeformationGradient) -> Result<[Vec<f64>; 2], Box<dyn Error>>,
) -> Result<[f64; 2], Box<dyn Error>> {
    let mut largest = [0.0_f64; 2];
    for case in truths(model, law)? {
        let [stress, tangent] = answers(&case.gradient)?;
        let errors = [relative_error(&stress, &case.stress), relative_error(&tangent, &case.tangent)];
        largest = [largest[0].max(errors[0]), largest[1].max(errors[1])];
    }
    Ok(largest)
}

fn by_rows<T: Real>(stress: &FirstPiola<T>) -> Vec<T> {
    stress.0.transpose().as_slice().to_vec()
}

/// Points of a block of lanes.
const BLOCK: usize = 8;

/// The cases near the identity as a batch: each in all lanes of a block, then all beside one another.
fn batch_near_identity<L: Hyperelastic>(model: Option<&str>, law: &L) -> Result<Vec<Case>, Box<dyn Error>> {
    let cases = truths(model, law)?;
    let alike = cases.iter().flat_map(|case| std::iter::repeat_n(case, BLOCK));
    let mixed = cases.iter().cycle().take(BLOCK * cases.len());
    Ok(alike.chain(mixed).cloned().collect())
}

/// The largest relative errors near the identity in blocks of lanes, see [`errors_near_identity`]: of P alone, and the larger one
/// of P and ∂P/∂F from what they share.
///
/// # Errors
/// As [`near_identity`], and those of batches.
pub fn batch_errors_near_identity<L: Hyperelastic + Sync>(
    model: Option<&str>,
    law: &L,
) -> Result<[f64; 2], Box<dyn Error>> {
    let cases = batch_near_identity(model, law)?;
    let (gradients, points) = (blocks_of(&cases), cases.len());
    let (mut p, mut a) = (vec![[[0.0; BLOCK]; 9]; gradients.len()], vec![[[0.0; BLOCK]; 45]; gradients.len()]);
    let input = Gradients(LaneBlocks::new(&gradients, points)?);
    let to = (LaneBlocks::new_mut(&mut p, points)?, LaneBlocks::new_mut(&mut a, points)?);
    batch::evaluate(input, batch::first_piola_and_tangent(law, to.0, to.1))?;
    let both = [
        stress_error(&cases, |point, k| p[point / BLOCK][k][point % BLOCK]),
        tangent_error(&cases, |point, k| a[point / BLOCK][k][point % BLOCK]),
    ];
    Ok([batch_stress_error_near_identity(model, law)?, both[0].max(both[1])])
}

/// The error of P alone in blocks of lanes.
///
/// # Errors
/// As [`batch_errors_near_identity`].
pub fn batch_stress_error_near_identity<L: Hyperelastic + Sync>(
    model: Option<&str>,
    law: &L,
) -> Result<f64, Box<dyn Error>> {
    let cases = batch_near_identity(model, law)?;
    let (gradients, points) = (blocks_of(&cases), cases.len());
    let mut p = vec![[[0.0; BLOCK]; 9]; gradients.len()];
    let input = Gradients(LaneBlocks::new(&gradients, points)?);
    batch::evaluate(input, batch::first_piola(law, LaneBlocks::new_mut(&mut p, points)?))?;
    Ok(stress_error(&cases, |point, k| p[point / BLOCK][k][point % BLOCK]))
}

/// The error of ∂P/∂F alone in blocks of lanes.
///
/// # Errors
/// As [`batch_errors_near_identity`].
pub fn batch_tangent_error_near_identity<L: Hyperelastic + Sync>(
    model: Option<&str>,
    law: &L,
) -> Result<f64, Box<dyn Error>> {
    let cases = batch_near_identity(model, law)?;
    let (gradients, points) = (blocks_of(&cases), cases.len());
    let mut a = vec![[[0.0; BLOCK]; 45]; gradients.len()];
    let input = Gradients(LaneBlocks::new(&gradients, points)?);
    batch::evaluate(input, batch::first_piola_tangent(law, LaneBlocks::new_mut(&mut a, points)?))?;
    Ok(tangent_error(&cases, |point, k| a[point / BLOCK][k][point % BLOCK]))
}

/// The largest relative errors of P and of ∂P/∂F near the identity in structures of arrays.
///
/// # Errors
/// As [`batch_errors_near_identity`].
pub fn array_errors_near_identity<L: Hyperelastic + Sync>(
    model: Option<&str>,
    law: &L,
) -> Result<[f64; 2], Box<dyn Error>> {
    let cases = batch_near_identity(model, law)?;
    let component = |k: usize| cases.iter().map(|case| case.gradient.matrix()[(k / 3, k % 3)]).collect();
    let gradients: [Vec<f64>; 9] = core::array::from_fn(component);
    let input = Gradients(Components::new(gradients.each_ref().map(Vec::as_slice))?);
    let mut p: [Vec<f64>; 9] = core::array::from_fn(|_| vec![0.0; cases.len()]);
    let to = Components::new_mut(p.each_mut().map(Vec::as_mut_slice))?;
    batch::evaluate(input, batch::first_piola(law, to))?;
    let mut a: [Vec<f64>; 45] = core::array::from_fn(|_| vec![0.0; cases.len()]);
    let to = Components::new_mut(a.each_mut().map(Vec::as_mut_slice))?;
    batch::evaluate(input, batch::first_piola_tangent(law, to))?;
    Ok([stress_error(&cases, |point, k| p[k][point]), tangent_error(&cases, |point, k| a[k][point])])
}

/// The same in arrays of matrices.
///
/// # Errors
/// As [`batch_errors_near_identity`].
pub fn matrix_errors_near_identity<L: Hyperelastic + Sync>(
    model: Option<&str>,
    law: &L,
) -> Result<[f64; 2], Box<dyn Error>> {
    let cases = batch_near_identity(model, law)?;
    let gradients: Vec<_> = cases.iter().map(|case| case.gradient).collect();
    let (mut p, mut a) = (vec![FirstPiola(Matrix3::zeros()); cases.len()], vec![[0.0; 45]; cases.len()]);
    batch::evaluate(&gradients[..], batch::first_piola(law, &mut p[..]))?;
    batch::evaluate(&gradients[..], batch::first_piola_tangent(law, &mut a[..]))?;
    let entry = |point: usize, k: usize| p[point].0[(k / 3, k % 3)];
    Ok([stress_error(&cases, entry), tangent_error(&cases, |point, k| a[point][k])])
}

fn blocks_of(cases: &[Case]) -> Vec<[[f64; BLOCK]; 9]> {
    let component = |block: &[Case], k: usize, lane: usize| block[lane].gradient.matrix()[(k / 3, k % 3)];
    let (blocks, _) = cases.as_chunks::<BLOCK>();
    let of = |block| core::array::from_fn(|k| core::array::from_fn(|lane| component(block, k, lane)));
    blocks.iter().map(|block| of(block)).collect()
}

/// The largest relative error of what is found at each point: entry k of P by rows.
fn stress_error(cases: &[Case], found: impl Fn(usize, usize) -> f64) -> f64 {
    largest_error(cases, |case| case.stress.clone(), found)
}

/// The same of the upper triangle of ∂P/∂F by rows.
fn tangent_error(cases: &[Case], found: impl Fn(usize, usize) -> f64) -> f64 {
    let upper = |tangent: &[f64]| tangent.chunks(9).enumerate().flat_map(|(r, row)| &row[r..]).copied().collect();
    largest_error(cases, |case| upper(&case.tangent), found)
}

fn largest_error(cases: &[Case], expected: impl Fn(&Case) -> Vec<f64>, found: impl Fn(usize, usize) -> f64) -> f64 {
    let of_point = |(point, case): (usize, &Case)| {
        let expected = expected(case);
        let found: Vec<f64> = (0..expected.len()).map(|k| found(point, k)).collect();
        relative_error(&found, &expected)
    };
    cases.iter().enumerate().map(of_point).fold(0.0, f64::max)
}
