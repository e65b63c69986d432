//! Laws that are written and read.

use piola_solids::AnySolid;

use super::laws::all;

#[test]
fn every_law_written_and_read_equals_itself() {
    for (law, _) in all() {
        let text = serde_json::to_string(&law).expect("written");
        assert_eq!(serde_json::from_str::<AnySolid>(&text).expect("read"), law, "{text}");
        let text = toml::to_string(&law).expect("written");
        assert_eq!(toml::from_str::<AnySolid>(&text).expect("read"), law, "{text}");
    }
}

#[test]
fn names_and_parameters_are_written_as_the_documentation_says() {
    let mut names: Vec<String> = all()
        .iter()
        .map(|(law, _)| serde_json::to_value(law).expect("written")["law"].as_str().expect("a name").to_owned())
        .collect();
    names.dedup();
    names.sort();
    names.dedup();
    let expected = [
        "anisotropic_linear",
        "anisotropic_saint_venant_kirchhoff",
        "blatz_ko",
        "compressible",
        "fung",
        "hencky",
        "holzapfel_gasser_ogden",
        "incompressible",
        "incompressible_ogden",
        "isochoric_ogden",
        "linear_elastic",
        "mooney_rivlin",
        "neo_hookean",
        "ogden",
        "polynomial",
        "reinforced_neo_hookean",
        "saint_venant_kirchhoff",
    ];
    assert_eq!(names, expected);
    let read = |text: &str| toml::from_str::<AnySolid>(text);
    // Whole numbers are numbers, and what has a natural value may be left out.
    for text in [
        "law = 'mooney_rivlin'\nc10 = 1\nc01 = 0\nc = 2",
        "law = 'incompressible'\nisochoric = { law = 'gent', mu = 1, limit = 30 }",
        "law = 'incompressible_ogden'\nterms = [{ mu = 1.0, alpha = 2 }]\npressure = { whole = 1 }",
        "law = 'ogden'\nterms = [{ mu = 1.0, alpha = 2.0 }]\nvolumetric = { law = 'lame', lambda = -0.1 }",
        "law = 'polynomial'\nterms = [{ first = 1, second = 0, third = 0, coefficient = 1.0 }]",
        "law = 'compressible'\nvolumetric = { law = 'ogden', kappa = 1.0, beta = 9.0 }\n\
         isochoric = { law = 'rivlin', terms = [{ first = 1, second = 0, coefficient = 1.0 }] }",
    ] {
        assert!(read(text).is_ok(), "{text}: {:?}", read(text));
    }
    for (text, sentence) in [
        ("law = 'neo_hook'\nmu = 1.0", "unknown variant `neo_hook`"),
        (
            "law = 'compressible'\nisochoric = { law = 'neo_hookean', mu = 1.0 }\nvolumetric = { law = 'lame', lambda = -50.0 }",
            "compressible: U″(1) = -5e1 violates 0 ≤ U″(1)",
        ),
        ("law = 'polynomial'\nterms = []", "0 < number of terms"),
        ("mu = 1.0", "missing field `law`"),
        ("law = 'blatz_ko'\nmu = 1.0\nnu = 0.2\nshare = 0.5\nextra = 1.0", "unknown field `extra`"),
        ("law = 'fung'\nc = 1.0", "missing field `exponents`"),
        ("law = 'hencky'\nmu = 1.0\nvolumetric = { law = 'lame', lambda = -1.0 }", "0 < U″(1) + ⅔ μ"),
        ("law = 'incompressible_ogden'\nterms = []", "1 ≤ number of terms ≤ 8"),
        ("law = 'linear_elastic'\nmu = 1.0", "ν < ½"),
    ] {
        let error = read(text).expect_err(text).to_string();
        assert!(error.contains(sentence), "{text}: {error}");
    }
}

/// Every number of the table, one after the other, as another.
fn changed(value: &toml::Value, to: f64) -> Vec<(String, toml::Value)> {
    match value {
        toml::Value::Float(_) => vec![(String::new(), toml::Value::Float(to))],
        toml::Value::Table(table) => table
            .iter()
            .flat_map(|(key, inner)| {
                changed(inner, to).into_iter().map(move |(path, inner)| {
                    let mut table = table.clone();
                    table.insert(key.clone(), inner);
                    (format!("{key} {path}"), toml::Value::Table(table))
                })
            })
            .collect(),
        toml::Value::Array(entries) => entries
            .iter()
            .enumerate()
            .flat_map(|(index, inner)| {
                changed(inner, to).into_iter().map(move |(path, inner)| {
                    let mut entries = entries.clone();
                    entries[index] = inner;
                    (format!("{index} {path}"), toml::Value::Array(entries))
                })
            })
            .collect(),
        _ => Vec::new(),
    }
}

#[test]
fn no_parameter_of_any_law_may_be_infinite_or_no_number() {
    let mut count = 0;
    for (law, _) in all() {
        let table = toml::Value::try_from(&law).expect("written");
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for (path, table) in changed(&table, bad) {
                let error = table.try_into::<AnySolid>().expect_err(&format!("{law:?} with {path}")).to_string();
                assert!(error.contains("not finite"), "{law:?} with {path}: {error}");
                count += 1;
            }
        }
    }
    assert!(300 < count, "{count} parameters");
}
