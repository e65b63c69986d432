//! Laws by name: every row of the table makes the law of the same parameters by name.

use piola::solids::{AnySolid, AnyVolumetric};
use piola_ffi::named::{solid, solid_with_names};
use piola_ffi::text::{fluid_with_names, solid_from_fit, solid_from_json};

#[test]
fn numbers_in_order_make_the_law_of_the_same_numbers_by_name() {
    let rows = [
        (
            "mooney_rivlin",
            vec![0.5, 0.25, 1.0],
            r#"{"law": "mooney_rivlin", "c10": 0.5, "c01": 0.25, "square_coefficient": 1.0}"#,
        ),
        (
            "Blatz_Ko",
            vec![1.0, 0.25, 0.5],
            r#"{"law": "blatz_ko", "shear_modulus": 1.0, "poisson_ratio": 0.25, "solid_fraction": 0.5}"#,
        ),
        (
            "saint_venant_kirchhoff",
            vec![1.0, 2.0],
            r#"{"law": "saint_venant_kirchhoff", "first_lame_parameter": 1.0, "shear_modulus": 2.0}"#,
        ),
        (
            "linear_elastic",
            vec![2.0, 1.0],
            r#"{"law": "linear_elastic", "first_lame_parameter": 1.0, "shear_modulus": 2.0}"#,
        ),
        (
            "HENCKY-LAME",
            vec![2.0, 1.0],
            r#"{"law": "hencky", "shear_modulus": 2.0, "volumetric": {"law": "lame", "first_lame_parameter": 1.0}}"#,
        ),
        (
            "neo_hookean(quadratic)",
            vec![2.0, 1.0],
            r#"{"law": "neo_hookean", "shear_modulus": 2.0, "volumetric": {"law": "quadratic", "bulk_modulus": 1.0}}"#,
        ),
        (
            "compressible(yeoh, liu)",
            vec![0.5, 0.1, 0.01, 9.0],
            r#"{"law": "compressible", "isochoric": {"law": "yeoh", "c1": 0.5, "c2": 0.1, "c3": 0.01}, "volumetric": {"law": "liu", "bulk_modulus": 9.0}}"#,
        ),
        (
            "compressible-neo_hookean-ogden",
            vec![0.5, 9.0, -2.0],
            r#"{"law": "compressible", "isochoric": {"law": "neo_hookean", "shear_modulus": 0.5}, "volumetric": {"law": "ogden", "bulk_modulus": 9.0, "exponent": -2.0}}"#,
        ),
        (
            "incompressible arruda_boyce",
            vec![0.5, 9.0],
            r#"{"law": "incompressible", "isochoric": {"law": "arruda_boyce", "rubbery_modulus": 0.5, "links": 9.0}}"#,
        ),
        (
            "incompressible_ogden",
            vec![0.5, 2.0, -0.1, -2.0],
            r#"{"law": "incompressible_ogden", "terms": [{"modulus": 0.5, "exponent": 2.0}, {"modulus": -0.1, "exponent": -2.0}]}"#,
        ),
        (
            "isochoric_ogden-miehe",
            vec![0.5, 2.0, 7.0],
            r#"{"law": "isochoric_ogden", "terms": [{"modulus": 0.5, "exponent": 2.0}], "volumetric": {"law": "miehe", "bulk_modulus": 7.0}}"#,
        ),
        (
            "ogden-logarithmic",
            vec![0.5, 2.0, 7.0],
            r#"{"law": "ogden", "terms": [{"modulus": 0.5, "exponent": 2.0}], "volumetric": {"law": "logarithmic", "bulk_modulus": 7.0}}"#,
        ),
        (
            "holzapfel_gasser_ogden",
            vec![1.0, 20.0, 2.0, 0.8, 0.1, 0.6, 0.8, 0.0, 0.6, -0.8, 0.0],
            r#"{"law": "holzapfel_gasser_ogden", "shear_modulus": 1.0, "bulk_modulus": 20.0, "fibre_modulus": 2.0, "fibre_exponent": 0.8, "dispersion": 0.1, "fibres": [[0.6, 0.8, 0.0], [0.6, -0.8, 0.0]]}"#,
        ),
        (
            "reinforced_neo_hookean",
            vec![1.0, 2.0, 3.0, 0.6, 0.8, 0.0],
            r#"{"law": "reinforced_neo_hookean", "shear_modulus": 1.0, "first_lame_parameter": 2.0, "fibre_modulus": 3.0, "fibre": [0.6, 0.8, 0.0]}"#,
        ),
    ];
    for (name, values, json) in &rows {
        let expected: AnySolid = solid_from_json(json).unwrap_or_else(|error| unreachable!("{json}: {error}"));
        assert_eq!(solid(name, values).unwrap_or_else(|error| unreachable!("{name}: {error}")), expected);
        assert!(solid(name, &values[1..]).is_err(), "{name}: one number fewer");
        let mut more = values.clone();
        more.push(1.0);
        assert!(solid(name, &more).is_err(), "{name}: one number more");
    }
    for part in ["mooney_rivlin", "gent", "arruda_boyce_series"] {
        assert!(solid(&format!("compressible-{part}-quadratic"), &[0.5, 2.0, 9.0]).is_ok(), "{part}");
    }
    for part in ["quadratic_logarithmic", "simo_taylor", "hartmann_neff"] {
        assert!(solid(&format!("hencky-{part}"), &[0.5, 9.0]).is_ok(), "{part}");
    }
}

#[test]
fn parameters_by_name_come_in_any_order() {
    let names = ["volumetric.bulk_modulus", "limit", "shear_modulus"];
    let law = solid_with_names("compressible-gent-liu", &names, &[9.0, 50.0, 1.0]).unwrap();
    assert_eq!(law, solid("compressible-gent-liu", &[1.0, 50.0, 9.0]).unwrap());
    for (names, values, says) in [
        (
            vec!["limit", "shear_modulus"],
            vec![1.0, 2.0],
            "parameter `bulk_modulus` is missing; the parameters are shear_modulus, limit, bulk_modulus",
        ),
        (vec!["limit", "shear_modulus", "bulk_modulus", "colour"], vec![1.0; 4], "parameter `colour` is unknown"),
        (vec!["limit", "shear_modulus", "bulk_modulus", "limit"], vec![1.0; 4], "parameter `limit` is given twice"),
        (vec!["limit"], vec![1.0, 2.0], "`values` has length 2; length 1 is needed"),
    ] {
        let error = solid_with_names("compressible-gent-liu", &names, &values).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
}

#[test]
fn names_that_are_none_list_what_there_is() {
    for (name, says) in [
        ("", "`` is no law with parameters in order; there are compressible, "),
        ("cheese", "`cheese` is no law"),
        ("compressible", "`` is no isochoric part; there are neo_hookean, "),
        ("compressible-gent-cheese", "`cheese` is no volumetric part; there are quadratic, "),
        ("blatz_ko-quadratic", "`quadratic` is no part of this law"),
    ] {
        let error = solid(name, &[1.0]).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
    let error = solid("blatz_ko", &[1.0]).unwrap_err().to_string();
    assert_eq!(error, "law `blatz_ko` takes shear_modulus, poisson_ratio, solid_fraction; 1 numbers were given");
}

#[test]
fn a_fit_gives_its_best_law_or_the_one_that_is_named() {
    let summary = r#"{"best_by_aicc": "mooney-rivlin", "laws": [
        {"model": "neo-hookean", "parameters": [{"name": "mu", "value": 0.5}]},
        {"model": "mooney-rivlin", "parameters": [{"name": "C10", "value": 0.3}, {"name": "C01", "value": 0.1}]}]}"#;
    let best = solid_from_fit(summary, None, None).unwrap();
    assert_eq!(best, solid("incompressible-mooney_rivlin", &[0.3, 0.1]).unwrap());
    let volume: AnyVolumetric =
        piola_ffi::text::volumetric_from_json(r#"{"law": "liu", "bulk_modulus": 9.0}"#).unwrap();
    let named = solid_from_fit(summary, Some("neo-hookean"), Some(volume)).unwrap();
    assert_eq!(named, solid("compressible-neo_hookean-liu", &[0.5, 9.0]).unwrap());
    let error = solid_from_fit(summary, Some("yeoh"), None).unwrap_err().to_string();
    assert_eq!(error, "`yeoh` is no model of this fit; there are neo-hookean, mooney-rivlin");
    let own = r#"{"best_by_aicc": "carroll", "laws": [{"model": "carroll", "parameters": [
        {"name": "A", "value": 0.15}, {"name": "B", "value": 0.0}, {"name": "C", "value": 0.1}]}]}"#;
    let error = solid_from_fit(own, None, None).unwrap_err().to_string();
    assert!(error.contains("`carroll` is no law of this fit; there are neo-hookean"), "{error}");
    let failed = r#"{"laws": [{"model": "gent", "failure": "no start"}]}"#;
    let error = solid_from_fit(failed, Some("gent"), None).unwrap_err().to_string();
    assert!(error.contains("the fit of `gent` failed: no start"), "{error}");
    assert!(solid_from_fit("[]", None, None).is_err());
    assert!(solid_from_fit(r#"{"model": "yeoh", "parameters": [{"value": 1.0}]}"#, None, None).is_err());
}

#[test]
fn parameters_of_a_fit_are_converted_to_pascal() {
    let gent = |unit: &str| {
        format!(
            r#"{{"best_by_aicc": "gent", "stress_unit": "{unit}", "laws": [{{"model": "gent", "parameters": [
            {{"name": "mu", "is_stress": true, "value": 0.5}}, {{"name": "Jm", "is_stress": false, "value": 30.0}}]}}]}}"#
        )
    };
    let of = |modulus: f64| solid("incompressible-gent", &[modulus, 30.0]).unwrap();
    for (unit, modulus) in [("Pa", 0.5), ("kPa", 5e2), ("MPa", 5e5), ("bar", 5e4)] {
        assert_eq!(solid_from_fit(&gent(unit), None, None).unwrap(), of(modulus), "{unit}");
    }
    let psi = solid_from_fit(&gent("psi"), None, None).unwrap();
    assert_eq!(psi, of(0.5 * (4.448_221_615_260_5 / 0.000_645_16))); // lbf/in², both exact by definition
    // As instruments and spreadsheets write them.
    for (unit, modulus) in [("Mpa", 5e5), ("N/mm²", 5e5), ("dyn/cm2", 0.05), ("mbar", 50.0), ("kgf/cm2", 49_033.25)] {
        assert_eq!(solid_from_fit(&gent(unit), None, None).unwrap(), of(modulus), "{unit}");
    }
    for wrong in ["furlong", "kg"] {
        let error = solid_from_fit(&gent(wrong), None, None).unwrap_err().to_string();
        assert!(error.contains(&format!("`{wrong}` is no unit of stress; there are mPa, Pa, kPa")), "{error}");
    }
    let silent = gent("MPa").replace("\"is_stress\": true, ", "");
    let error = solid_from_fit(&silent, None, None).unwrap_err().to_string();
    assert!(error.contains("does not say whether it `is_stress`"), "{error}");
}

#[test]
fn fluids_by_name_are_those_of_their_text() {
    let names = ["yield_stress", "consistency", "exponent"];
    let fluid = fluid_with_names("HERSCHEL_BULKLEY", &names, &[1.0, 2.0, 0.5]).unwrap();
    assert_eq!(fluid.name(), "Herschel-Bulkley");
    let error = fluid_with_names("herschel_bulkley", &names[1..], &[2.0, 0.5]).unwrap_err().to_string();
    assert!(error.contains("yield_stress"), "{error}");
}
