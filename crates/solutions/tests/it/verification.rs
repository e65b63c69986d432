//! The tables for finite-element programs: files read back, stresses by hand, forces in balance.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use nalgebra::{Matrix3, Vector3};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use serde_json::Value;

#[path = "../../examples/verification/cases.rs"]
mod cases;
#[path = "../../examples/verification/mesh.rs"]
mod mesh;
#[path = "../../examples/verification/tables.rs"]
mod tables;

/// A folder that is removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        Self(std::env::temp_dir().join(format!("piola-verification-{name}-{}", std::process::id())))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// One row by the names of its columns.
type Row = BTreeMap<String, String>;

fn csv(path: &Path) -> Vec<Row> {
    let text = fs::read_to_string(path).expect("written");
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let row = |line: &str| {
        let values: Vec<&str> = line.split(',').collect();
        assert_eq!(values.len(), names.len(), "{}: {line}", path.display());
        names.iter().map(|name| (*name).to_owned()).zip(values.iter().map(|x| (*x).to_owned())).collect()
    };
    lines.map(row).collect()
}

fn numbers<const N: usize>(row: &Row, names: [&str; N]) -> [f64; N] {
    names.map(|name| row[name].parse().expect("a number"))
}

fn tensor(row: &Row, letter: &str) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| row[&format!("{letter}{}{}", i + 1, j + 1)].parse().expect("a number"))
}

fn cauchy(row: &Row) -> Matrix3<f64> {
    let [a, b, c, d, e, f] = numbers(row, ["T11", "T22", "T33", "T12", "T23", "T13"]);
    Matrix3::new(a, d, f, d, b, e, f, e, c)
}

/// Cases and laws as folders.
fn folders(root: &Path) -> Vec<PathBuf> {
    let inside = |folder: &Path| -> Vec<PathBuf> {
        let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
        entries.filter(|path| path.is_dir()).collect()
    };
    let mut all: Vec<PathBuf> = inside(root).iter().flat_map(|case| inside(case)).collect();
    all.sort();
    all
}

/// g₁ and g₋₁ by hand, from the parameters in the document.
fn response(law: &Value, first: f64) -> [f64; 2] {
    let of = |name: &str| law["parameters"][name].as_f64().expect("a parameter");
    match law["name"].as_str().expect("a name") {
        "neo-hookean" => [of("mu_Pa"), 0.0],
        "mooney-rivlin" => [2.0 * of("C10_Pa"), -2.0 * of("C01_Pa")],
        _ => [of("mu_Pa") * of("Jm") / (of("Jm") - (first - 3.0)), 0.0],
    }
}

#[test]
fn tables_are_read_back_and_their_stresses_are_those_of_response_functions_by_hand() {
    let folder = Folder::new("stress");
    assert_eq!(tables::write_all(&folder.0).expect("written"), 21);
    let mut compared = 0;
    let all = folders(&folder.0);
    assert_eq!(all.len(), 21);
    for case in &all {
        let name = case.display();
        let text = fs::read_to_string(case.join("case.json")).expect("written");
        let document: Value = serde_json::from_str(&text).expect("JSON");
        let rows = csv(&case.join("nodes.csv"));
        assert_eq!(rows.len(), 125, "{name}");
        for (row, values) in rows.iter().zip(document["nodes"].as_array().expect("rows")) {
            // Both files hold the same numbers to the last bit.
            let values = values.as_array().expect("a row").iter().map(|x| x.as_f64().expect("a number").to_bits());
            assert!(values.eq(numbers(row, tables::NODE_COLUMNS).map(f64::to_bits)), "{name}");
            let (f, t, p) = (tensor(row, "F"), cauchy(row), numbers(row, ["p"])[0]);
            let b = f * f.transpose();
            let inverse = b.try_inverse().expect("regular");
            let [direct, reciprocal] = response(&document["law"], b.trace());
            let expected = b * direct + inverse * reciprocal - Matrix3::identity() * p;
            let scale = direct * b.norm() + p.abs() + reciprocal.abs() * inverse.norm();
            let tol = Tol::ulps_because(256.0, "an inverse, and rotations to Cartesian components");
            assert_close("det F", &[f.determinant()], &[1.0], Tol::ulps(64.0));
            assert_close_at_scale("T", t.as_slice(), expected.as_slice(), scale, tol);
            let first = tensor(row, "P") * f.transpose();
            assert_close_at_scale("P Fᵀ", first.as_slice(), t.as_slice(), scale, tol);
            compared += 1;
        }
    }
    assert_eq!(compared, 21 * 125);
}

#[test]
fn displacements_are_those_of_the_formulas_of_torsion_and_of_the_balloon() {
    let folder = Folder::new("displacement");
    tables::write_all(&folder.0).expect("written");
    let mut compared = 0;
    for law in cases::LAWS {
        // A twisted tube: (R, Θ, Z) → (r(R), Θ + 20 Z, Z).
        for row in csv(&folder.0.join("family-3-torsion").join(law).join("nodes.csv")) {
            let [radius, angle, height] = numbers(&row, ["Q1", "Q2", "Q3"]);
            let place = numbers(&row, ["X", "Y", "Z"]);
            let moved = numbers(&row, ["ux", "uy", "uz"]);
            let (s, c) = (angle + 20.0 * height).sin_cos();
            let [r] = numbers(&row, ["q1"]);
            let expected = [r * c, r * s, height];
            let found = [0, 1, 2].map(|i| place[i] + moved[i]);
            assert_close_at_scale("x", &found, &expected, 0.04, Tol::ulps(32.0));
            assert_close_at_scale(
                "X",
                &place,
                &[radius * angle.cos(), radius * angle.sin(), height],
                0.04,
                Tol::ulps(8.0),
            );
            compared += 1;
        }
        // r³ = R³ + A, radially.
        for row in csv(&folder.0.join("family-4-balloon").join(law).join("nodes.csv")) {
            let place = Vector3::from(numbers(&row, ["X", "Y", "Z"]));
            let moved = Vector3::from(numbers(&row, ["ux", "uy", "uz"]));
            let radius = place.norm();
            let inflated = (radius.powi(3) + 0.07_f64.powi(3) - 0.05_f64.powi(3)).cbrt();
            let expected = place * (inflated / radius - 1.0);
            assert_close_at_scale("u", moved.as_slice(), expected.as_slice(), 0.06, Tol::ulps(32.0));
            compared += 1;
        }
    }
    assert_eq!(compared, 3 * 2 * 125);
}

/// The pressure of an inflated neo-Hookean shell, μ (2/λ + ½/λ⁴) between the faces.
#[test]
fn pressures_of_the_balloon_are_those_of_the_closed_form_and_tractions_are_in_balance() {
    let folder = Folder::new("loads");
    tables::write_all(&folder.0).expect("written");
    let text = fs::read_to_string(folder.0.join("family-4-balloon/neo-hookean/case.json")).expect("written");
    let document: Value = serde_json::from_str(&text).expect("JSON");
    let outer = (0.06_f64.powi(3) + 0.07_f64.powi(3) - 0.05_f64.powi(3)).cbrt() / 0.06;
    let of = |stretch: f64| 2.0 / stretch + 0.5 / stretch.powi(4);
    let expected = 4.0e5 * (of(outer) - of(1.4));
    let pressure = document["loads"]["pressure_Pa"].as_f64().expect("a load");
    assert_close("p", &[pressure], &[expected], Tol::ulps(64.0));
    // ∫ P N dA = 0 by the rule of midpoints: an error of second order, of the area of a quadrilateral too.
    let mut compared = 0;
    for case in folders(&folder.0) {
        let places: Vec<Vector3<f64>> =
            csv(&case.join("nodes.csv")).iter().map(|row| Vector3::from(numbers(row, ["X", "Y", "Z"]))).collect();
        let (mut sum, mut size) = (Vector3::zeros(), 0.0);
        let faces = csv(&case.join("faces.csv"));
        assert_eq!(faces.len(), 6 * 16);
        for row in &faces {
            let [a, b, c, d] = ["n1", "n2", "n3", "n4"].map(|n| places[row[n].parse::<usize>().expect("a node")]);
            let area = (c - a).cross(&(d - b)) * 0.5;
            let normal = Vector3::from(numbers(row, ["N1", "N2", "N3"]));
            // Sides of spherical coordinates (r, azimuth, colatitude) are left-handed: seen from inside.
            assert!(0.95 * area.norm() < area.dot(&normal).abs(), "{}", case.display());
            let force = Vector3::from(numbers(row, ["t1", "t2", "t3"])) * area.norm();
            sum += force;
            size += force.norm();
        }
        assert!(sum.norm() < 0.02 * size, "{}: {} of {size}", case.display(), sum.norm());
        compared += 1;
    }
    assert_eq!(compared, 21);
}
