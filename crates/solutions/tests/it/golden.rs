//! Values that independent tools computed in sixty digits.

use nalgebra::Matrix3;
use piola_solids::isochoric::{Gent, MooneyRivlin};
use piola_solutions::ResponseFunctions;
use piola_solutions::families::{
    AzimuthalShearing, BlockBending, Datum, Family, IsochoricDeformation, Orientation, SectorStraightening,
    SphereDeformation, TubeDeformation,
};
use piola_testkit::golden::{load, matrix, number, text, vector};
use piola_testkit::{Tol, assert_close};
use serde_json::Value;

/// The pressure is an integral to 1e-13 of ∫ |dT|; all else a few ulp.
const GOLDEN: Tol = Tol::stated(1e-12, "the accuracy that the reference data are compared to");

fn flat(value: &Value) -> Vec<f64> {
    matrix(value).concat()
}

fn array<const N: usize>(value: &Value) -> [f64; N] {
    vector(value).try_into().expect("a vector of the length")
}

fn compare(case: &Value, family: &impl Family, law: &impl ResponseFunctions) -> usize {
    let points = case["points"].as_array().expect("points");
    for point in points {
        let at = array::<3>(&point["ref_coords"]);
        let what = |name: &str| format!("{} at {at:?}: {name}", text(&case["id"]));
        let check = |name: &str, actual: &[f64]| {
            let expected = &point[name];
            let expected = match expected {
                Value::Array(list) if list[0].is_array() => flat(expected),
                Value::Array(_) => vector(expected),
                _ => vec![number(expected)],
            };
            assert_close(&what(name), actual, &expected, GOLDEN);
        };
        check("cur_coords", &family.place(at));
        let local = family.deformation(at).expect("deformation");
        check("F_phys", local.gradient.as_flattened());
        let determinant = Matrix3::from_fn(|i, j| local.gradient[i][j]).determinant();
        check("det_F_phys", &[determinant]);
        check("B_phys", local.left_cauchy_green.rows().as_flattened());
        check("I", &[local.first_minus_three + 3.0]);
        check("II", &[local.second_minus_three + 3.0]);
        let datum = match &case["ref_coords0"] {
            Value::Null => {
                let extra = local.extra_stress(law).components[0];
                Datum { reference: [0.0; 3], stress: extra - number(&case["p0"]) }
            }
            place => Datum::free_at(array(place)),
        };
        let stress = family.stress(law, &datum, at).expect("stress");
        check("p", &[stress.pressure]);
        check("T_phys", stress.cauchy.0.rows().as_flattened());
    }
    points.len()
}

fn of_family(case: &Value, law: &impl ResponseFunctions) -> usize {
    let of = |name: &str| number(&case["params"][name]);
    match text(&case["family"]) {
        "0" => {
            let rows = matrix(&case["params"]["G"]);
            let family = IsochoricDeformation::new(Matrix3::from_fn(|i, j| rows[i][j]), [0.0; 3]).expect("det 1");
            compare(case, &family, law)
        }
        "1" => compare(case, &BlockBending::new(["A", "B", "C", "D", "E"].map(of)).expect("constants"), law),
        "2" => compare(case, &SectorStraightening::new(["A", "B", "C", "D", "E"].map(of)).expect("constants"), law),
        "3" => compare(case, &TubeDeformation::new(["A", "B", "C", "D", "E", "F"].map(of)).expect("constants"), law),
        "4" => {
            let orientation = if of("sign") < 0.0 { Orientation::Everted } else { Orientation::Kept };
            compare(case, &SphereDeformation::new(orientation, of("A")).expect("A"), law)
        }
        "5" => compare(case, &AzimuthalShearing::new(["A", "B", "C", "D"].map(of)).expect("constants"), law),
        other => panic!("family {other}"),
    }
}

#[test]
fn placements_strains_and_stresses_of_all_families_equal_golden() {
    let (mut cases, mut points) = (0, 0);
    for case in &load("universal").cases {
        // Laminated bodies are those of another crate.
        if text(&case["kind"]) != "static" || text(&case["family"]).starts_with('L') {
            continue;
        }
        let model = &case["model"];
        let of = |name: &str| number(&model[name]);
        points += match text(&model["name"]) {
            "mooney_rivlin" => of_family(case, &MooneyRivlin::new(of("c10"), of("c01")).expect("law")),
            "gent" => of_family(case, &Gent::new(of("mu"), of("Jm")).expect("law")),
            other => panic!("law {other}"),
        };
        cases += 1;
    }
    assert_eq!((cases, points), (12, 22));
}
