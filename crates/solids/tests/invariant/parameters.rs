//! Parameters: refused by name where they are impossible, written and read back.

use piola_solids::SolidsError;
use piola_solids::isochoric::{self, ArrudaBoyce, Gent, Rivlin, Yeoh};
use piola_solids::volumetric::{OgdenVolumetric, Quadratic};
use piola_solids::{BlatzKo, NeoHookeanLogarithmic, Polynomial, PolynomialTerm, SaintVenantKirchhoff};

fn refused<L: core::fmt::Debug>(result: Result<L, SolidsError>) -> (&'static str, &'static str, &'static str) {
    match result {
        Err(SolidsError::OutOfBounds { law, parameter, bound, .. }) => (law, parameter, bound),
        other => panic!("{other:?}"),
    }
}

#[test]
fn impossible_parameters_are_refused_by_name() {
    assert_eq!(refused(Gent::new(1.0, 0.0)), ("Gent", "limit", "0 < Jm"));
    assert_eq!(refused(ArrudaBoyce::new(1.0, 1.0)), ("Arruda–Boyce", "links", "1 < N"));
    assert_eq!(refused(Yeoh::new(-1.0, 0.0, 0.0)), ("Yeoh", "c1", "0 < C1"));
    assert_eq!(refused(isochoric::NeoHookean::new(0.0)), ("isochoric neo-Hookean", "shear_modulus", "0 < μ"));
    assert_eq!(refused(Rivlin::new(vec![])), ("Rivlin series", "C10 + C01", "0 < C10 + C01"));
    assert_eq!(refused(Quadratic::new(-1.0)), ("quadratic volumetric energy", "bulk_modulus", "0 ≤ κ"));
    assert_eq!(
        refused(OgdenVolumetric::new(1.0, 0.0)),
        ("Ogden volumetric energy", "exponent", "0 < |β|, κ/β² finite")
    );
    assert_eq!(refused(BlatzKo::new(1.0, 0.5, 0.5)), ("Blatz–Ko", "poisson_ratio", "0 ≤ ν < ½"));
    assert_eq!(
        refused(SaintVenantKirchhoff::new(-1.0, 1.0)),
        ("St. Venant–Kirchhoff", "first_lame_parameter", "0 < 3 λ + 2 μ")
    );
    assert_eq!(refused(NeoHookeanLogarithmic::with_constants(0.0, 1.0)), ("neo-Hookean", "shear_modulus", "0 < μ"));
    let constant = PolynomialTerm { first: 0, second: 0, third: 0, coefficient: 1.0 };
    assert_eq!(refused(Polynomial::new(vec![constant])), ("polynomial", "degree", "0 < r + s + t"));
    let stressed = PolynomialTerm { first: 1, second: 0, third: 0, coefficient: 1.0 };
    let bound = "C100 + 2 C010 + C001 = 0";
    assert_eq!(refused(Polynomial::stress_free(vec![stressed])), ("polynomial", "C100 + 2 C010 + C001", bound));
    assert!(matches!(
        Gent::new(f64::NAN, 1.0),
        Err(SolidsError::NotFinite { law: "Gent", parameter: "shear_modulus", .. })
    ));
}

#[cfg(feature = "serde")]
mod written {
    use core::fmt::Debug;

    use piola_solids::volumetric::SimoTaylor;
    use piola_solids::{Compressible, ElasticConstants, IncompressibleSolid, LinearElastic};
    use serde::Serialize;
    use serde::de::DeserializeOwned;

    use super::super::zoo;
    use super::*;

    fn read_back<L: Serialize + DeserializeOwned + PartialEq + Debug>(law: &L, expected: &str) {
        let text = serde_json::to_string(law).expect("written");
        assert_eq!(text, expected);
        assert_eq!(&serde_json::from_str::<L>(&text).expect("read"), law);
    }

    #[test]
    fn laws_that_are_read_equal_those_written() -> Result<(), SolidsError> {
        read_back(&Gent::new(1.0, 30.0)?, r#"{"shear_modulus":1.0,"limit":30.0}"#);
        let solid = Compressible::new(ArrudaBoyce::new(1.0, 9.0)?, SimoTaylor::new(5.0)?);
        read_back(&solid, r#"{"isochoric":{"rubbery_modulus":1.0,"links":9.0},"volumetric":{"bulk_modulus":5.0}}"#);
        let pressed = IncompressibleSolid::new(isochoric::NeoHookean::new(2.0)?).at_pressure(0.5)?;
        read_back(&pressed, r#"{"isochoric":{"shear_modulus":2.0},"pressure":{"whole":0.5}}"#);
        read_back(
            &NeoHookeanLogarithmic::with_constants(1.0, 2.0)?,
            r#"{"shear_modulus":1.0,"volumetric":{"bulk_modulus":2.0}}"#,
        );
        read_back(
            &LinearElastic::new(ElasticConstants::from_lame(1.0, 2.0)?)?,
            r#"{"shear_modulus":2.0,"first_lame_parameter":1.0}"#,
        );
        read_back(&ElasticConstants::incompressible(2.0)?, r#"{"shear_modulus":2.0}"#);
        let polynomial = zoo::polynomial()?;
        let text = serde_json::to_string(&polynomial).expect("written");
        assert_eq!(serde_json::from_str::<Polynomial>(&text).expect("read"), polynomial);
        let rivlin = zoo::rivlin()?;
        let text = serde_json::to_string(&rivlin).expect("written");
        assert_eq!(serde_json::from_str::<Rivlin>(&text).expect("read"), rivlin);
        Ok(())
    }

    #[test]
    fn impossible_or_unknown_parameters_are_refused_when_read() {
        let error = serde_json::from_str::<Gent>(r#"{"mu":1.0,"limit":-1.0}"#).expect_err("negative");
        assert!(error.to_string().contains("0 < Jm"), "{error}");
        assert!(serde_json::from_str::<Gent>(r#"{"mu":1.0,"limit":1.0,"extra":2.0}"#).is_err());
        assert!(serde_json::from_str::<LinearElastic>(r#"{"mu":2.0}"#).is_err());
    }
}
