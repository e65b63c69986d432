//! Planets for the tests of several methods.

use piola_gravitation::Gravitation;
use piola_gravitation::kepler::Elements;
use piola_gravitation::wisdom_holman::{Corrector, Splitting};
use piola_testkit::golden;

pub(crate) const SPLITTINGS: [Splitting; 4] = [
    Splitting::Leapfrog,
    Splitting::Corrected(Corrector::Five),
    Splitting::Corrected(Corrector::Seventeen),
    Splitting::TenSixFour,
];

/// A central body of Gm = 1 with planets of Gm = `mass` on ellipses of a = 1, 1.5, 2.25, …
pub(crate) fn planets(count: usize, mass: f64) -> (Gravitation, Vec<f64>) {
    let mut parameters = vec![1.0];
    let (mut positions, mut velocities) = (vec![[0.0; 3]], vec![[0.0; 3]]);
    for planet in 0..count {
        let order = planet as f64;
        let elements = Elements {
            semi_major_axis: 1.5_f64.powf(order),
            eccentricity: 0.05,
            inclination: 0.02 * order,
            ascending_node: order,
            argument_of_pericentre: 2.0 * order,
            mean_anomaly: 1.0 + 2.5 * order,
        };
        let (position, velocity) = elements.state(1.0 + mass);
        parameters.push(mass);
        positions.push(position);
        velocities.push(velocity);
    }
    let bodies = Gravitation::new(parameters).unwrap();
    let state = bodies.state(&positions, &velocities).unwrap();
    (bodies, state)
}

/// A file of reference data.
pub(crate) fn reference(name: &str) -> serde_json::Value {
    let text = std::fs::read_to_string(format!("../../testdata/reference/{name}.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

pub(crate) fn triples(of: &serde_json::Value) -> Vec<[f64; 3]> {
    golden::matrix(of).into_iter().map(|row| row.try_into().unwrap()).collect()
}

/// The outer planets, and where they are after 548 years, by a solution of 30 digits.
pub(crate) fn outer_solar_system() -> (Gravitation, Vec<f64>, Vec<f64>) {
    let data = reference("outer_solar_system");
    let constant = golden::number(&data["G"]);
    let masses = data["masses"].as_array().unwrap().iter().map(|mass| match mass.as_str().unwrap() {
        "1/130000000" => 1.0 / 130_000_000.0,
        _ => golden::number(mass),
    });
    let bodies = Gravitation::new(masses.map(|mass| constant * mass).collect()).unwrap();
    let start = bodies.state(&triples(&data["positions"]), &triples(&data["velocities"])).unwrap();
    let reference = golden::vector(&data["own_reference_T200000days"]["state"]);
    (bodies, start, reference[..18].to_vec())
}
