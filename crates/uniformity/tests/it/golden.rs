//! Reference data of material geometry: connections, torsion, metric, curvature, Burgers vectors.

use nalgebra::Vector3;
use piola_continuum::Symmetric;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, golden};
use piola_uniformity::{
    AffineConnection, BurgersVector, CharacteristicMetric, DislocationDensity, LieAlgebra, MaterialConnection,
    MetricGeometry, RoundCircuit, UniformityMap,
};
use serde_json::Value;

use super::fixtures::Golden;

/// The specification's tolerance of the reference data.
const REFERENCE: Tol = Tol::stated(1e-12, "the specification's tolerance of the reference data");

/// All numbers of nested lists.
fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(entries) => entries.iter().flat_map(flat).collect(),
        number => vec![golden::number(number)],
    }
}

fn rows(symmetric: &Symmetric) -> Vec<f64> {
    symmetric.rows().as_flattened().to_vec()
}

#[test]
fn geometry_of_uniform_bodies_equals_reference() {
    let mut compared = 0;
    for case in golden::load("material_geometry").cases.iter().filter(|case| case["points"].is_array()) {
        let id = golden::text(&case["id"]);
        let map = Golden::named(id).expect("a map for every case");
        let points = case["points"].as_array().expect("points");
        for point in points {
            let place = Vector3::from_vec(golden::vector(&point["X"]));
            let close = |what: &str, actual: &[f64], scale: f64| {
                assert_close_at_scale(&format!("{id}: {what}"), actual, &flat(&point[what]), scale, REFERENCE);
            };
            let value = map.value(&place).expect("K");
            close("K", value.transpose().as_slice(), 0.0);
            let connection = MaterialConnection::of_crystal(map);
            let gamma = connection.coefficients(&place).expect("Γ");
            close("Gamma", gamma.components.as_flattened().as_flattened(), 0.0);
            let torsion = connection.torsion(&place).expect("torsion");
            close("torsion", torsion.components.as_flattened().as_flattened(), torsion.scale);
            assert_eq!(point["curvature_of_Gamma_is_zero"], true);
            let own = connection.curvature(&place).expect("curvature");
            assert_close_at_scale("curvature of Γ", &[own.largest()], &[0.0], own.scale, Tol::ulps(64.0));

            // Where the crystal turns, the metric's derivatives are differences of those of K.
            let size = own.scale.max(1.0);
            let geometry = MetricGeometry::of(&CharacteristicMetric(map), &place).expect("metric");
            close("metric", &rows(&geometry.metric), 0.0);
            close("christoffel", geometry.christoffel.components.as_flattened().as_flattened(), size);
            let scale = geometry.riemann.scale.max(size);
            let riemann = geometry.riemann.components.as_flattened().as_flattened().as_flattened();
            close("riemann", riemann, scale);
            close("ricci", geometry.ricci.transpose().as_slice(), scale);
            close("scalar_curvature", &[geometry.scalar], scale);

            // An isotropic solid's material connection is that of its metric.
            let isotropic = MaterialConnection::new(map, LieAlgebra::rotations());
            let levi_civita = isotropic.coefficients(&place).expect("Γ");
            close("christoffel", levi_civita.components.as_flattened().as_flattened(), size);

            // The density of dislocations is the torsion in the crystal.
            let density = DislocationDensity::of(&map, &place).expect("density");
            let of_torsion = DislocationDensity::of_torsion(&torsion, &value).expect("density");
            let tol = Tol::ulps(64.0);
            assert_close_at_scale("α", density.value.as_slice(), of_torsion.value.as_slice(), density.scale, tol);
            compared += 1;
        }
    }
    assert_eq!(compared, 14, "points of seven bodies");
}

#[test]
fn burgers_vectors_equal_reference() {
    let mut compared = 0;
    for case in golden::load("material_geometry").cases.iter().filter(|case| case["kind"] == "burgers_circuit") {
        let id = golden::text(&case["id"]);
        let map = Golden::named(id).expect("a map for every case");
        let centre = golden::vector(&case["center"]);
        let centre = Vector3::new(centre[0], centre[1], 0.25);
        let circle = RoundCircuit::new(centre, Vector3::z(), golden::number(&case["radius"])).expect("circle");
        let burgers = BurgersVector::of(&map, &circle, 1e-12).expect("b");
        let expected = golden::vector(&case["output"]["burgers"]);
        assert_close(id, burgers.value.as_slice(), &expected, REFERENCE);
        compared += 1;
    }
    assert_eq!(compared, 3, "circuits");
}
