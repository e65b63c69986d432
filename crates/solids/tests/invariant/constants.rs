//! Pairs of elastic constants: there and back, their bounds, and ν = ½.

use piola_continuum::strain::LinearStrain;
use piola_solids::SolidsError;
use piola_solids::{ElasticConstants, LinearElastic, MixedLinearElastic, PoissonSign};
use piola_tensor::voigt::{BroNielsen, Piola};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close};
use proptest::prelude::*;

type Result<T> = core::result::Result<T, SolidsError>;

/// What every pair makes of the constants of a compressible solid.
fn pairs(of: &ElasticConstants) -> Result<Vec<(&'static str, ElasticConstants)>> {
    let (mu, young, nu) = (of.shear_modulus(), of.young_modulus(), of.poisson_ratio());
    let [lambda, bulk, uniaxial] = [of.first_lame_parameter(), of.bulk_modulus(), of.uniaxial_modulus()]
        .map(|modulus| modulus.expect("compressible"));
    let sign = if nu < 0.0 { PoissonSign::Negative } else { PoissonSign::NonNegative };
    Ok(vec![
        ("λ μ", ElasticConstants::from_lame(lambda, mu)?),
        ("E ν", ElasticConstants::from_young_poisson(young, nu)?),
        ("G ν", ElasticConstants::from_shear_poisson(mu, nu)?),
        ("E G", ElasticConstants::from_young_shear(young, mu)?),
        ("K G", ElasticConstants::from_bulk_shear(bulk, mu)?),
        ("K ν", ElasticConstants::from_bulk_poisson(bulk, nu)?),
        ("K E", ElasticConstants::from_bulk_young(bulk, young)?),
        ("λ E", ElasticConstants::from_lame_young(lambda, young)?),
        ("λ ν", ElasticConstants::from_lame_poisson(lambda, nu)?),
        ("λ K", ElasticConstants::from_lame_bulk(lambda, bulk)?),
        ("λ M", ElasticConstants::from_lame_uniaxial(lambda, uniaxial)?),
        ("G M", ElasticConstants::from_shear_uniaxial(mu, uniaxial)?),
        ("K M", ElasticConstants::from_bulk_uniaxial(bulk, uniaxial)?),
        ("ν M", ElasticConstants::from_poisson_uniaxial(nu, uniaxial)?),
        ("E M", ElasticConstants::from_young_uniaxial(young, uniaxial, sign)?),
    ])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn constants_of_every_pair_equal_those_it_was_made_of(
        mu in 0.1..10.0_f64,
        size in 0.05..0.45_f64,
        auxetic: bool,
    ) {
        let nu = if auxetic { -size } else { size };
        let constants = ElasticConstants::from_shear_poisson(mu, nu).expect("bounds");
        let lambda = constants.first_lame_parameter().expect("compressible");
        for (pair, other) in pairs(&constants).expect("bounds") {
            // E and M hardly tell ν from 0; E and G, K and E hardly tell ν from ½.
            let condition = 1.0 / (nu * nu) / (1.0 - 2.0 * nu);
            let actual = [other.first_lame_parameter().expect("compressible"), other.shear_modulus()];
            assert_close(pair, &actual, &[lambda, mu], Tol::ulps(4.0).times(condition));
        }
    }
}

#[test]
fn every_constant_of_a_pair_equals_that_of_a_table() -> Result<()> {
    // ν = ¼: λ = μ, E = 5/2 μ, K = 5/3 μ, M = 3 μ.
    let constants = ElasticConstants::from_lame(2.0, 2.0)?;
    assert_eq!((constants.young_modulus(), constants.poisson_ratio()), (5.0, 0.25));
    assert_eq!((constants.bulk_modulus(), constants.uniaxial_modulus()), (Some(2.0 + 2.0 / 3.0 * 2.0), Some(6.0)));
    Ok(())
}

#[test]
fn half_of_poisson_equals_the_incompressible_solid() -> Result<()> {
    let rubber = ElasticConstants::incompressible(2.0)?;
    for same in [
        ElasticConstants::from_young_poisson(6.0, 0.5)?,
        ElasticConstants::from_shear_poisson(2.0, 0.5)?,
        ElasticConstants::from_young_shear(6.0, 2.0)?,
    ] {
        assert_eq!(same, rubber);
    }
    assert!(rubber.is_incompressible());
    assert_eq!((rubber.first_lame_parameter(), rubber.bulk_modulus(), rubber.uniaxial_modulus()), (None, None, None));
    assert_eq!((rubber.young_modulus(), rubber.poisson_ratio(), rubber.compressibility()), (6.0, 0.5, 0.0));
    assert!(matches!(LinearElastic::new(rubber), Err(SolidsError::OutOfBounds { bound: "ν < ½", .. })));
    // Towards ½ the mixed form turns into it without a jump.
    let strain = LinearStrain::new(2e-3, -1e-3, -1e-3, 5e-4, 0.0, 0.0).expect("finite");
    let exact = MixedLinearElastic::new(rubber);
    for k in 4..17 {
        let near = ElasticConstants::from_shear_poisson(2.0, 0.5 - 10.0_f64.powi(-k))?;
        let mixed = MixedLinearElastic::new(near);
        assert_close(
            "T",
            &mixed.stress(&strain, 3.0).0.components,
            &exact.stress(&strain, 3.0).0.components,
            Tol::ulps(1.0),
        );
        let compliance = |solid: &MixedLinearElastic| solid.compliance_matrix::<Piola>().entries;
        let tolerance = Tol::stated(4.0 * 10.0_f64.powi(-k) + 1e-15, "the distance from ½");
        assert_close("M⁻¹", compliance(&mixed).as_flattened(), compliance(&exact).as_flattened(), tolerance);
    }
    Ok(())
}

#[test]
fn compliance_equals_inverse_of_the_material_matrix() -> Result<()> {
    let law = LinearElastic::new(ElasticConstants::from_young_poisson(210.0, 0.3)?)?;
    let inverse = law.material_matrix::<BroNielsen>().compliance().expect("regular");
    assert_close(
        "M⁻¹",
        law.compliance_matrix::<BroNielsen>().entries.as_flattened(),
        inverse.entries.as_flattened(),
        Tol::ulps(16.0),
    );
    Ok(())
}

#[test]
fn impossible_constants_are_refused_by_name() {
    let refused = |result: Result<ElasticConstants>| match result {
        Err(SolidsError::OutOfBounds { parameter, bound, .. }) => (parameter, bound),
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(ElasticConstants::from_young_poisson(1.0, 0.6)), ("poisson_ratio", "−1 < ν ≤ ½"));
    assert_eq!(refused(ElasticConstants::from_young_poisson(-1.0, 0.3)), ("young_modulus", "0 < E"));
    assert_eq!(refused(ElasticConstants::from_bulk_poisson(1.0, 0.5)), ("poisson_ratio", "−1 < ν < ½"));
    assert_eq!(refused(ElasticConstants::from_young_shear(3.1, 1.0)), ("young_modulus", "0 < E ≤ 3 G"));
    assert_eq!(refused(ElasticConstants::from_bulk_young(1.0, 9.0)), ("young_modulus", "0 < E < 9 K"));
    assert_eq!(refused(ElasticConstants::from_lame(-1.0, 1.0)), ("first_lame_parameter", "0 < 3 λ + 2 μ"));
    assert_eq!(refused(ElasticConstants::from_lame_poisson(1.0, -0.1)), ("first_lame_parameter", "0 < λ/ν"));
    assert_eq!(refused(ElasticConstants::from_bulk_uniaxial(1.0, 1.0)), ("uniaxial_modulus", "K < M"));
    let infinite = ElasticConstants::from_young_poisson(f64::INFINITY, 0.3);
    assert!(matches!(infinite, Err(SolidsError::NotFinite { parameter: "young_modulus", .. })));
}
