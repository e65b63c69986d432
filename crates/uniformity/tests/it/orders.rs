//! Orders of accuracy: sampled maps, and transport.

use nalgebra::{Matrix3, Vector3};
use piola_fields::Interpolation;
use piola_integrators::Tolerance;
use piola_testkit::assert_order;
use piola_uniformity::{
    AffineConnection, BurgersVector, CharacteristicMetric, LeviCivita, MaterialConnection, ReferenceCurve,
    RoundCircuit, SampledUniformityMap, TransportedFrame, UniformityMap,
};

use super::fixtures::Waves;

const SMOOTH: Waves =
    Waves { amplitude: [0.1, -0.12, 0.08, 0.14, 0.05, -0.1, 0.07, -0.13, 0.11], wave: [1.0, 1.2, -0.9], phase: 0.4 };

/// Places of one cell in the middle of the grid: the same shares of its edges at every spacing.
fn places(step: f64) -> [Vector3<f64>; 5] {
    [[0.21, 0.5, 0.73], [0.5, 0.5, 0.5], [0.85, 0.3, 0.1], [0.4, 0.9, 0.6], [0.07, 0.66, 0.97]]
        .map(|shares| Vector3::from(shares) * step)
}

fn sampled(count: usize, interpolation: Interpolation) -> SampledUniformityMap {
    let nodes: Vec<f64> = (0..=count).map(|i| -1.0 + 2.0 * i as f64 / count as f64).collect();
    SampledUniformityMap::of(&SMOOTH, [nodes.clone(), nodes.clone(), nodes], interpolation).expect("samples")
}

/// Largest errors of K, torsion and curvature of the metric over the places.
fn errors(count: usize, interpolation: Interpolation) -> [f64; 3] {
    let map = sampled(count, interpolation);
    let (ours, exact) = (MaterialConnection::of_crystal(&map), MaterialConnection::of_crystal(SMOOTH));
    let (metric, of_exact) = (LeviCivita(CharacteristicMetric(&map)), LeviCivita(CharacteristicMetric(SMOOTH)));
    let mut largest = [0.0_f64; 3];
    for place in places(2.0 / count as f64) {
        let k = (map.value(&place).expect("K") - SMOOTH.value(&place).expect("K")).amax();
        let (y, expected) = (ours.torsion(&place).expect("Y"), exact.torsion(&place).expect("Y"));
        let y =
            y.components.as_flattened().as_flattened().iter().zip(expected.components.as_flattened().as_flattened());
        let (r, expected) = (metric.curvature(&place).expect("R"), of_exact.curvature(&place).expect("R"));
        let r = (r.ricci() - expected.ricci()).amax();
        let found = [k, y.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max), r];
        largest = core::array::from_fn(|i| largest[i].max(found[i]));
    }
    largest
}

#[test]
fn sampled_maps_have_the_stated_orders() {
    for (interpolation, counts, orders) in
        [(Interpolation::Cubic, [16, 24, 36], [4.0, 3.0, 2.0]), (Interpolation::Quintic, [24, 32, 44], [6.0, 5.0, 4.0])]
    {
        let steps = counts.map(|count: usize| 2.0 / count as f64);
        let found = counts.map(|count| errors(count, interpolation));
        for (number, (what, order)) in ["K", "torsion", "curvature"].into_iter().zip(orders).enumerate() {
            let errors = found.map(|errors| errors[number]);
            assert_order(&format!("{interpolation:?} {what}"), &steps, &errors, order, 0.35);
        }
    }
}

#[test]
fn burgers_vector_of_samples_has_the_order_of_the_map() {
    let circle = RoundCircuit::new(Vector3::zeros(), Vector3::new(1.0, -2.0, 2.0), 0.6).expect("a circle");
    let exact = BurgersVector::of(&SMOOTH, &circle, 1e-13).expect("b").value;
    let counts = [8_usize, 12, 18];
    let errors = counts.map(|count| {
        let burgers = BurgersVector::of(&sampled(count, Interpolation::Cubic), &circle, 1e-9).expect("b").value;
        (burgers - exact).norm()
    });
    // The slope of a curl is one order less than the map's, and errors of either sign average around a circuit.
    assert_order("Burgers", &counts.map(|count| 2.0 / count as f64), &errors, 4.0, 1.0);
}

#[test]
fn error_of_transport_is_proportional_to_the_tolerance() {
    let connection = MaterialConnection::of_crystal(SMOOTH);
    let curve = RoundCircuit::new(Vector3::zeros(), Vector3::z(), 0.8).expect("a circle");
    let start = SMOOTH.value(&curve.place(0, 0.0)).expect("K");
    let mut evaluations = Vec::new();
    let tolerances = [1e-5, 1e-7, 1e-9, 1e-11];
    for tolerance in tolerances {
        let round =
            TransportedFrame::around(&connection, &curve, &start, Tolerance::relative(tolerance).expect("a tolerance"))
                .expect("around");
        let error = (round.holonomy() - Matrix3::identity()).norm();
        assert!(error <= 20.0 * tolerance, "{tolerance:e}: {error:e}");
        evaluations.push(round.evaluations);
    }
    assert!(evaluations.is_sorted() && evaluations[3] < 16 * evaluations[0], "{evaluations:?}");
}
