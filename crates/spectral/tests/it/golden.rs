//! Reference data of the eigenbasis: eigenvalues, norms, coefficients and displacements on the unit square and cube.

use std::f64::consts::PI;

use piola_spectral::{BoxOperator, Eigenbasis, ModalSeries, Polarisation, SpectralError, Walls};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, golden};
use serde_json::Value;

use super::fixtures::lame;

/// The specification's tolerance of the reference data.
const REFERENCE: Tol = Tol::stated(1e-12, "the specification's tolerance of the reference data");

fn family(value: &Value) -> Polarisation {
    match value.as_u64() {
        Some(1) => Polarisation::Longitudinal,
        Some(2) => Polarisation::Horizontal,
        Some(3) => Polarisation::Vertical,
        _ => panic!("no family {value}"),
    }
}

fn whole(value: &Value) -> usize {
    value.as_u64().and_then(|value| value.try_into().ok()).expect("a whole number")
}

fn indices<const D: usize>(value: &Value) -> [usize; D] {
    let numbers: Vec<usize> = value.as_array().expect("indices").iter().map(whole).collect();
    numbers.try_into().expect("D indices")
}

fn modes<const D: usize>(case: &Value) -> usize {
    let basis = Eigenbasis::<D>::new([1.0; D], lame()).expect("basis");
    let modes = case["output"]["modes"].as_array().expect("modes");
    for mode in modes {
        let (family, indices) = (family(&mode["family"]), indices::<D>(&mode["idx"]));
        let vanishes = mode["vanishes"] == true;
        assert_eq!(basis.vanishes(family, indices), vanishes, "{mode}");
        if vanishes {
            let refused = Err(SpectralError::VanishingMode {
                indices: std::array::from_fn(|axis| indices.get(axis).copied().unwrap_or(0)),
                family: family.family(),
            });
            assert_eq!(basis.normalisation(family, indices), refused);
            assert_eq!(basis.eigenvalue(family, indices), refused);
            continue;
        }
        let close = |what: &str, actual: f64| assert_close(what, &[actual], &[golden::number(&mode[what])], REFERENCE);
        close("norm_factor_a", basis.normalisation(family, indices).expect("α"));
        close("kappa", basis.eigenvalue(family, indices).expect("κ"));
    }
    modes.len()
}

/// Every index up to three (two in space), every family, vanishing ones too.
#[test]
fn eigenvalues_and_norms_equal_reference() {
    let cases = golden::load("eigenbasis").cases;
    let of = |id: &str| cases.iter().find(|case| case["id"] == id).expect("case");
    assert_eq!(modes::<2>(of("modes_2d")), 32, "four by four indices, two families");
    assert_eq!(modes::<3>(of("modes_3d")), 81, "three cubed indices, three families");
}

/// A force as a sum of products of functions of one coordinate.
fn force<const D: usize>(case: &Value, place: [f64; D]) -> [f64; D] {
    std::array::from_fn(|component| {
        let terms = case["force"][component].as_array().expect("terms");
        let term = |term: &Value| {
            let factors = term["factors"].as_array().expect("factors");
            factors.iter().zip(place).fold(golden::number(&term["amp"]), |product, (factor, x)| {
                product
                    * match golden::text(&factor[0]) {
                        "poly" => golden::vector(&factor[1]).iter().rev().fold(0.0, |sum, c| sum * x + c),
                        "gauss" => {
                            let (centre, width) = (golden::number(&factor[1]), golden::number(&factor[2]));
                            (-((x - centre) / width).powi(2)).exp()
                        }
                        "sin" => (golden::number(&factor[1]) * PI * x).sin(),
                        "cos" => (golden::number(&factor[1]) * PI * x).cos(),
                        other => panic!("no factor {other}"),
                    }
            })
        };
        terms.iter().map(term).sum()
    })
}

fn displacements<const D: usize>(case: &Value) -> usize {
    let id = golden::text(&case["id"]);
    let basis = Eigenbasis::<D>::new([1.0; D], lame()).expect("basis");
    let mut compared = 0;
    for truncation in case["output"]["truncations"].as_array().expect("truncations") {
        let highest = whole(&truncation["N"]);
        // Gauss's rule resolves the product of the narrowest bell with the highest wave.
        let nodes = highest + 48;
        let function = |place| force::<D>(case, place);
        let series =
            ModalSeries::of_function([1.0; D], Walls::Sliding, [highest; D], nodes, function).expect("projection");
        let solution = series.solved(&BoxOperator::elastic(lame()));
        // Coefficients are listed for the first truncation; they do not depend on it.
        let rows = truncation["low_coefficients"].as_array().map_or(&[][..], Vec::as_slice);
        for (key, series) in [("f_coef", &series), ("u_coef", &solution)] {
            let scale = rows.iter().map(|row| golden::number(&row[key]).abs()).fold(0.0, f64::max);
            for row in rows {
                let (family, indices) = (family(&row["family"]), indices::<D>(&row["idx"]));
                let actual = series.coefficient(&basis, family, indices).expect("coefficient");
                let what = format!("{id} {highest} {indices:?} {key}");
                assert_close_at_scale(&what, &[actual], &[golden::number(&row[key])], scale, REFERENCE);
                compared += 1;
            }
        }
        let points = case["input"]["points"].as_array().expect("points");
        let expected = golden::matrix(&truncation["u"]);
        let actual: Vec<f64> = points
            .iter()
            .flat_map(|point| {
                let place = golden::vector(point).try_into().expect("place");
                solution.value(place).expect("u")
            })
            .collect();
        assert_close(&format!("{id} {highest}"), &actual, &expected.concat(), REFERENCE);
        compared += points.len();
    }
    compared
}

#[test]
fn truncated_displacements_and_coefficients_equal_reference() {
    let (mut cases, mut compared) = (0, 0);
    for case in golden::load("eigenbasis").cases.iter().filter(|case| case["kind"] == "force") {
        compared += if case["dim"] == 2 { displacements::<2>(case) } else { displacements::<3>(case) };
        cases += 1;
    }
    assert_eq!(cases, 8);
    assert!(100 < compared, "{compared} numbers and places");
}
